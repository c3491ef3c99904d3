"""Limits read off the coefficients, against singularities that are known in closed form or were published."""

import cmath
import math
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product

import mpmath
import pytest
import sympy
from flint import acb, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.mapping import padded, power
from ridgeback.symbolic.singularities.darboux import Estimate, Point, nearest_singularities
from ridgeback.symbolic.singularities.dlog_pade import dlog_singularities
from ridgeback.symbolic.singularities.limits import TOLERANCE, TRUSTED, Limits, limits
from ridgeback.symbolic.singularities.stripped import DIGITS, stripped
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@cache
def expansion(name: str, order: int) -> Expansion:
    return (lindstedt if name == "van-der-pol" else energy_integral)(find(name), order)


def own(equation: str, order: int) -> Expansion:
    return energy_integral(Oscillator.from_equation(equation), order)


def place(found: Limits, index: int = 0) -> complex:
    s = found.singularities[index]
    return cmath.rect(s.modulus, s.argument)


def assert_covers(found: Limits, truth: complex, exponent: float) -> None:
    s = found.singularities[0]
    assert abs(s.modulus - abs(truth)) <= s.modulus_uncertainty
    assert abs(abs(s.argument) - abs(cmath.phase(truth))) <= max(s.argument_uncertainty, 1e-12)
    assert abs(s.exponent - exponent) <= s.exponent_uncertainty


# Where V'(A) = 0 the period is analytic times a logarithm, so its exponent is 0 (Landau and Lifshitz, section 12).
@pytest.mark.parametrize("order", [24, 30, 40, 60])
def test_the_pendulum_series_ends_at_the_separatrix(order: int) -> None:
    found = limits(expansion("pendulum", order))
    assert_covers(found, math.pi**2, 0.0)
    assert found.step == 2
    assert found.singularities[0].of == "period"
    assert abs(found.radius - math.pi) <= found.uncertainty < 0.2
    if order >= 40:
        assert found.singularities[0].kind == "logarithm"
        assert found.uncertainty < 5e-3


@pytest.mark.parametrize(("name", "sign"), [("duffing-hardening", -1), ("duffing-softening", 1)])
def test_duffing_has_its_logarithm_at_the_saddle_and_another_singularity_twice_as_far(name: str, sign: int) -> None:
    # K(m), m = e A^2 / (2 (1 + e A^2)), is singular at m = infinity, e A^2 = -1, and at m = 1, e A^2 = -2.
    found = limits(expansion(name, 40))
    assert place(found, 0) == pytest.approx(sign, abs=1e-14)
    assert place(found, 1) == pytest.approx(2 * sign, abs=1e-14)
    assert [s.kind for s in found.singularities] == ["logarithm", "logarithm"]
    assert found.radius == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("order", [12, 16, 20, 24, 28])
def test_few_duffing_terms_give_a_wide_but_true_answer(order: int) -> None:
    found = limits(expansion("duffing-hardening", order))
    if found.radius is not None:
        assert_covers(found, -1.0, 0.0)


def helmholtz_duffing_pair() -> complex:
    # V(A) = V(s) at the complex saddle s = exp(2 pi i/3); its double root s is left out: A^2 + p A + q = 0.
    s = cmath.exp(2j * cmath.pi / 3)
    height = s**2 / 2 + s**3 / 3 + s**4 / 4
    p, q = 4 / 3 + 2 * s, -4 * height / s**2
    root = cmath.sqrt(p * p - 4 * q)
    return min(((-p + root) / 2, (-p - root) / 2), key=abs)


@pytest.mark.parametrize("order", [40, 48, 64])
def test_helmholtz_duffing_has_a_pair_at_the_energy_of_its_complex_saddles(order: int) -> None:
    found = limits(expansion("helmholtz-duffing", order))
    assert found.step == 1
    assert_covers(found, helmholtz_duffing_pair(), 0.0)
    assert len(found.singularities) == 2


@pytest.mark.parametrize(
    ("equation", "step", "truth"),
    [
        ("u'' + u + u**2", 1, 0.5),  # the potential is as high at A = 1/2 as at the saddle u = -1
        ("u'' + sinh(u)", 2, -(math.pi**2)),  # saddle at i pi
        ("u'' + u + u**5", 4, -1.0),  # saddles where u^4 = -1
    ],
)
def test_other_saddles(equation: str, step: int, truth: float) -> None:
    found = limits(own(equation, 48))
    assert found.step == step
    assert_covers(found, truth, 0.0)


def test_exponents_other_than_zero() -> None:
    # (1 + u^2) u'' + u u'^2 + u = 0 has T = 4 E(-A^2), singular like (1 + A^2) log(1 + A^2);  with - u u'^2 the period
    # is 2 pi sqrt(1 + A^2) (Mathews and Lakshmanan, Q. Appl. Math. 32 (1974) 215).
    for sign, exponent, kind in (("+", 1.0, "logarithm"), ("-", 0.5, "square-root branch point")):
        found = limits(lindstedt(Oscillator.from_equation(f"(1+u**2)*u'' {sign} u*u'**2 + u"), 24))
        first = found.singularities[0]
        assert (first.kind, first.exponent) == (kind, pytest.approx(exponent, abs=1e-10))
        assert place(found) == pytest.approx(-1.0, abs=1e-12)


@pytest.mark.parametrize("order", [32, 40, 48])
def test_van_der_pol_has_a_pair_of_square_root_branch_points(order: int) -> None:
    # Andersen and Geer (1982): |eps^2| about 3.42.  More digits, by the same fits of the coefficients to eps^120, whose
    # changes are 6e-7: 3.420188 exp(+-1.792289 i), exponent 1/2.
    found = limits(expansion("van-der-pol", order))
    assert_covers(found, cmath.rect(3.420188, 1.792289), 0.5)
    assert abs(found.radius - math.sqrt(3.42)) <= found.uncertainty + 1e-3
    assert found.singularities[0].argument == -found.singularities[1].argument


def test_more_terms_narrow_the_van_der_pol_pair_consistently() -> None:
    coarse, fine = (limits(expansion("van-der-pol", order)).singularities[0] for order in (32, 48))
    assert fine.modulus_uncertainty < coarse.modulus_uncertainty / 2
    assert abs(fine.modulus - coarse.modulus) <= fine.modulus_uncertainty + coarse.modulus_uncertainty


def test_the_radius_is_in_the_printed_variable() -> None:
    one, two = (limits(lindstedt(find("van-der-pol").with_parameters({"k": k}), 32)) for k in (1, 2))
    assert two.radius == pytest.approx(2 * one.radius, rel=1e-12)  # eps/k is what the series runs in
    assert two.range_of_use == pytest.approx(2 * one.range_of_use, rel=1e-12)


def test_the_action_series_covers_the_action_of_the_separatrix() -> None:
    # 2 J = 16/pi on the separatrix of the pendulum; J itself is singular there, and the estimate allows for it.
    for order in (24, 40):
        found = limits(energy_integral(find("pendulum"), order, amplitude="action"))
        assert_covers(found, 16 / math.pi, 0.0)


def polynomial() -> Expansion:
    zeros = (fmpq(0),) * 28
    return replace(expansion("pendulum", 30), coefficients=(fmpq(1), fmpq(0), fmpq(-1, 3), *zeros))


@pytest.mark.parametrize(
    ("series", "words"),
    [
        (lambda: expansion("linear", 40), "constant through this order"),
        (lambda: expansion("pendulum", 6), "do not settle"),
        (lambda: energy_integral(find("helmholtz").with_parameters({"alpha2": None}), 6), "alpha2 as symbols"),
        (polynomial, "a polynomial so far"),
    ],
)
def test_what_is_not_settled_is_not_claimed(series, words: str) -> None:
    found = limits(series())
    assert found.radius is None
    assert found.range_of_use is None
    assert found.singularities == ()
    assert words in found.sentence()


def test_random_coefficients_settle_nothing() -> None:
    noise = tuple(fmpq(int(digit) * 2 - 9) for digit in "14142135623730950488016887242096980785696718753769480")
    assert limits(replace(expansion("helmholtz-duffing", 52), coefficients=noise)).radius is None


def test_a_longer_series_settles_the_limits_of_a_short_one() -> None:
    short = expansion("pendulum", 8)
    found = limits(short, longer=expansion("pendulum", 40))
    assert found.order == 8
    assert abs(found.radius - math.pi) <= found.uncertainty
    assert found.range_of_use < limits(expansion("pendulum", 40)).range_of_use


@pytest.mark.parametrize("order", [8, 16, 24, 40])
@pytest.mark.parametrize("name", ["pendulum", "duffing-hardening", "duffing-softening"])
def test_the_range_of_use_is_where_the_series_errs_by_the_tolerance(name: str, order: int) -> None:
    series = expansion(name, order)
    edge = limits(series, longer=expansion(name, 60)).range_of_use
    for share, low, high in ((1.0, 0.05, 2.0), (0.9, 0.0, 1.0)):
        error = abs(float(series(share * edge)) / exact(name, share * edge) - 1)
        assert low * TOLERANCE <= error <= high * TOLERANCE


def exact(name: str, A: float) -> float:
    if name == "pendulum":
        return float(mpmath.agm(1, mpmath.cos(A / 2)))
    e = 1 if name == "duffing-hardening" else -1
    return float(mpmath.agm(mpmath.sqrt(1 + e * A * A), mpmath.sqrt(1 + e * A * A / 2)))


@pytest.mark.parametrize("name", ["pendulum", "duffing-softening", "van-der-pol"])
def test_both_routes_meet(name: str) -> None:
    found = limits(expansion(name, 40))
    for first, second in zip(found.singularities[:1], found.second_route, strict=False):
        assert abs(first.modulus - second.modulus) <= 0.02 * first.modulus
        assert abs(first.argument - second.argument) <= 0.02
        assert abs(first.exponent - second.exponent) <= 0.12


def test_the_sentence_is_one_line_with_every_number_in_it() -> None:
    assert limits(expansion("van-der-pol", 48)).sentence() == (
        "The series converges for |eps| < 1.849 ± 0.005 (estimated: square-root branch point of the frequency at "
        "|eps²| = 3.42 ± 0.02, arg = ±1.792 ± 0.006); truncated at order 48 it errs by less than about 0.1 % up to "
        "eps = 1.76 or further."
    )


# The fits themselves.

fractions = st.fractions(min_value=-3, max_value=3, max_denominator=7)


@settings(deadline=None, max_examples=25)
@given(
    p=fractions,
    x_c=st.fractions(min_value=Fraction(1, 5), max_value=5, max_denominator=9),
    sign=st.sampled_from([1, -1]),
)
def test_a_pure_power_is_found_exactly(p: Fraction, x_c: Fraction, sign: int) -> None:
    assume(not (p >= 0 and p.denominator == 1))  # a polynomial
    x = fmpq(sign * x_c.numerator, x_c.denominator)
    series = power([fmpq(1), -1 / x, *[fmpq(0)] * 14], p)
    found = nearest_singularities(series, 1)
    assert found is not None
    assert abs(float(found.points[0].place.real) - float(sign * x_c)) < 1e-12
    assert abs(float(found.points[0].exponent.real) - float(p)) < 1e-9
    assert found.place_error < 1e-12


@settings(deadline=None, max_examples=15)
@given(
    p=st.sampled_from([Fraction(1, 2), Fraction(-1, 2), Fraction(-1), Fraction(1, 3), Fraction(-5, 4)]),
    cosine=st.fractions(min_value=Fraction(-4, 5), max_value=Fraction(4, 5), max_denominator=10),
    R=st.fractions(min_value=Fraction(1, 2), max_value=3, max_denominator=4),
)
def test_a_pure_pair_is_found_exactly(p: Fraction, cosine: Fraction, R: Fraction) -> None:
    # Gegenbauer's generating function (1 - 2 x cos/R + x^2/R^2)^p, DLMF 18.12.4
    b, c = (
        fmpq(-2) * cosine.numerator / cosine.denominator * R.denominator / R.numerator,
        fmpq(R.denominator, R.numerator) ** 2,
    )
    found = nearest_singularities(power(padded([fmpq(1), b, c], 24), p), 2)
    assert found is not None
    for point in found.points:
        assert abs(abs(complex(float(point.place.real), float(point.place.imag))) - float(R)) < 1e-9
        assert abs(float(point.place.real) - float(R * cosine)) < 1e-9
        assert abs(float(point.exponent.real) - float(p)) < 1e-6


def test_the_claimed_errors_cover_the_truth_beside_a_further_singularity() -> None:
    # (1 - x)^p + size (1 - x/x_far)^q over a grid: every estimate that would be handed out covers 1 and p.
    settled = 0
    for p, q, far, size, terms in product(
        (Fraction(1, 2), Fraction(-3, 2), Fraction(1, 3)),
        (Fraction(-1, 2), Fraction(1, 2)),
        (Fraction(5, 4), Fraction(-5, 4), Fraction(-2)),
        (1, 5),
        (12, 17, 25, 40),
    ):
        near = power(padded([fmpq(1), fmpq(-1)], terms), p)
        rest = power(padded([fmpq(1), fmpq(-far.denominator, far.numerator)], terms), q)
        found = nearest_singularities([a + size * b for a, b in zip(near, rest, strict=True)], 1)
        if found is not None and found.place_error <= TRUSTED:
            settled += 1
            assert abs(float(found.points[0].place.real) - 1) <= found.place_error
            assert abs(float(found.points[0].exponent.real) - float(p)) <= found.exponent_error
    assert settled > 50


@pytest.mark.parametrize(
    ("unit", "radius", "square"),
    [
        ("1e15", "(3.142 ± 0.002)e-15", "(9.87 ± 0.02)e-30"),
        ("1e-7", "(3.142 ± 0.002)e+07", "(9.87 ± 0.02)e+14"),
        ("1e3", "0.003142 ± 0.000002", "(9.87 ± 0.02)e-06"),
        ("1e90*1e90", None, None),
        ("1e-90*1e-90", None, None),
    ],
)
def test_the_sentence_keeps_its_digits_in_any_unit(unit: str, radius: str | None, square: str | None) -> None:
    """The pendulum with its angle measured in other units: the same digits, the point moved."""
    found = limits(own(f"u'' + sin({unit}*u)/({unit})", 40))
    if radius is None:
        assert found.sentence() == (
            "The range of convergence is not known: the nearest singularity is beyond the range of floats; "
            "scale the unknown."
        )
    else:
        assert f"for |A| < {radius} (estimated: logarithm of the period at A² = {square})" in found.sentence()


def test_two_opposite_singularities_of_different_exponents() -> None:
    left, right = power(padded([1, -1], 40), Fraction(1, 2)), power(padded([1, 1], 40), Fraction(-1, 3))
    found = nearest_singularities([a + b for a, b in zip(left, right, strict=True)], 2)
    assert found is not None
    exponents = {round(float(p.place.real)): float(p.exponent.real) for p in found.points}
    assert exponents == pytest.approx({1: 0.5, -1: -1 / 3}, abs=1e-4)
    assert found.place_error < 1e-4


def test_too_few_or_vanishing_terms_give_no_estimate() -> None:
    assert nearest_singularities([fmpq(1), fmpq(1), fmpq(2)], 1) is None
    assert nearest_singularities([fmpq(1)] + [fmpq(0)] * 30, 1) is None


def test_dlog_pade_finds_a_power_and_never_claims_more_than_the_routes_agree() -> None:
    start = Estimate((Point(acb(2.01), acb(0.3)),), 0.0, 0.0, 2)
    exponential = [fmpq(1, math.factorial(n)) for n in range(30)]
    for background, tolerance in ((0, 1e-12), (1, 5e-3)):
        root = power(padded([1, fmpq(-1, 2)], 30), Fraction(-1, 2))
        found = dlog_singularities([a + background * b for a, b in zip(root, exponential, strict=True)], start)
        assert found is not None
        assert abs(float(found.points[0].place.real) - 2) < tolerance
        assert abs(float(found.points[0].exponent.real) + 1 / 2) < 30 * tolerance
        assert found.place_error >= abs(float(found.points[0].place.real) - 2.01) / 2.02


def test_irrational_coefficients_are_their_exact_values_to_many_digits() -> None:
    """By balls, beside sympy's own evaluation."""
    series = energy_on_each_side("u'' + u + u*abs(u) = 0", 8)
    assert isinstance(series, Expansion)
    step, found = stripped(series)
    assert step == 1
    for value, exact in zip(found, series.frequency, strict=True):
        near = sympy.Rational(int(value.p), int(value.q))
        assert abs((near / exact - 1).evalf(30, maxn=2 * DIGITS)) < 10.0 ** (1 - DIGITS)
