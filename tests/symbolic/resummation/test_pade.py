"""Padé approximants and changes of variable: exact identities, certified poles, observed order."""

from fractions import Fraction
from functools import cache

import pytest
import sympy
from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball, polynomial_at
from ridgeback.symbolic.arithmetic.rational_function import approximant, first_positive_zero, zeros
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.mapping import CutPlane, Euler, Identity, Mapping, Pair
from ridgeback.symbolic.resummation.pade import mapped, mapping_for, pade
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.limits import limits
from ridgeback.symbolic.systems.catalogue import find

HALF = Fraction(1, 2)


@cache
def expansion(name: str, order: int) -> Expansion:
    return (lindstedt if name == "van-der-pol" else energy_integral)(find(name), order)


def duffing(A: arb, e: int = 1) -> arb:
    return (1 + e * A * A).sqrt().agm((1 + e * A * A / 2).sqrt())


def error(form: Resummation, A: arb, exact: arb) -> float:
    with ctx.workprec(200):
        return float(form.error_against(A, exact))


# Padé approximants.

small = st.fractions(min_value=-4, max_value=4, max_denominator=5)


def series_of(numerator: list[fmpq], denominator: list[fmpq], length: int) -> list[fmpq]:
    result: list[fmpq] = []
    for n in range(length):
        value = numerator[n] if n < len(numerator) else fmpq(0)
        result.append(
            value - sum((denominator[j] * result[n - j] for j in range(1, min(n, len(denominator) - 1) + 1)), fmpq(0))
        )
    return result


def rationals(values: list[Fraction]) -> list[fmpq]:
    return [fmpq(v.numerator, v.denominator) for v in values]


@settings(deadline=None, max_examples=50)
@given(top=st.lists(small, min_size=1, max_size=4), bottom=st.lists(small, min_size=0, max_size=3))
def test_a_rational_function_is_its_own_approximant(top: list[Fraction], bottom: list[Fraction]) -> None:
    p, q = rationals(top), [fmpq(1), *rationals(bottom)]
    m, n = len(p) - 1, len(q) - 1
    found_p, found_q = approximant(series_of(p, q, m + n + 1), m, n)
    assert fmpq_poly(list(found_p)) * fmpq_poly(q) == fmpq_poly(p) * fmpq_poly(list(found_q))


@pytest.mark.parametrize(("m", "n"), [(0, 0), (3, 0), (0, 3), (2, 3), (5, 4), (6, 6)])
@pytest.mark.parametrize("name", ["pendulum", "duffing"])
def test_approximants_agree_with_the_linear_equations_that_define_them(name: str, m: int, n: int) -> None:
    c = list(expansion(name, 24).coefficients[::2])
    numerator, denominator = approximant(c, m, n)
    if n:  # the slow twin: sum_j q_j c_(k-j) = 0 for m < k <= m + n
        rows = [[c[k - j] if k >= j else fmpq(0) for j in range(1, n + 1)] for k in range(m + 1, m + n + 1)]
        solved = fmpq_mat(rows).solve(fmpq_mat([[-c[k]] for k in range(m + 1, m + n + 1)]))
        assert [solved[j, 0] for j in range(n)] == list(denominator[1:])
    rest = fmpq_poly(list(denominator)) * fmpq_poly(c) - fmpq_poly(list(numerator))
    assert all(rest[k] == 0 for k in range(m + n + 1))
    assert rest[m + n + 1] != 0


def test_an_approximant_that_does_not_exist_is_refused() -> None:
    with pytest.raises(InputError, match=r"\[0/1\] .* does not exist"):
        approximant([fmpq(0), fmpq(1)], 0, 1)
    with pytest.raises(InputError, match="needs 6 coefficients and 5 are known"):
        pade(expansion("pendulum", 8), 3, 2)


def test_a_pole_inside_the_range_is_refused_with_its_place() -> None:
    series = expansion("van-der-pol", 48)
    with pytest.raises(InputError, match=r"Pade \[12/12\] of van-der-pol has a pole at eps = 0\.259037.*1\.849"):
        pade(series)
    place = pade(
        series, up_to=Fraction(1, 10)
    ).pole  # allowed below the pole; the place is where the denominator is zero
    denominator = pade(series, up_to=Fraction(1, 10)).denominator
    assert (
        polynomial_at(denominator, (place - arb(10) ** -12) ** 2)
        * polynomial_at(denominator, (place + arb(10) ** -12) ** 2)
        < 0
    )
    assert pade(series, 11, 12).pole is None


def test_nothing_is_evaluated_at_or_beyond_a_pole() -> None:
    form = pade(expansion("pendulum", 8))
    assert 3.5173 < float(form.pole) < 3.5174
    assert form(3.5) < 0.2
    for A in (3.5173041519007, 3.6, 10.0):
        with pytest.raises(InputError, match=r"does not hold at A = .*pole at A = 3\.5173"):
            form(A)


def test_the_pole_is_in_the_printed_variable() -> None:
    one, two = (pade(lindstedt(find("van-der-pol").with_parameters({"k": k}), 16), 3, 4, up_to=1) for k in (1, 2))
    assert float(two.pole) == pytest.approx(2 * float(one.pole), rel=1e-14)
    assert two(1.0) == pytest.approx(2 * one(0.5), rel=1e-15)


def test_zeros_are_isolated_and_certified() -> None:
    # (x - 1)^2 (x + 1/2) (x^2 + 1): a double zero, a negative one and a pair
    p = fmpq_poly([-1, 1]) ** 2 * fmpq_poly([fmpq(1, 2), 1]) * fmpq_poly([1, 0, 1])
    found = zeros(tuple(p.coeffs()))
    assert len(found) == 4
    assert sorted(round(float(z.real), 9) for z in found if z.imag == 0) == [-0.5, 1.0]


def test_zero_itself_is_no_positive_zero() -> None:
    assert first_positive_zero((fmpq(0), fmpq(1))) is None
    assert first_positive_zero((fmpq(0), fmpq(-2), fmpq(1))) == 2


def test_an_approximant_says_how_many_coefficients_it_needs() -> None:
    series = [fmpq(1, n + 1) for n in range(4)]
    assert len(approximant(series, 2, 1)[0]) == 3
    with pytest.raises(InputError, match=r"\[3/1\] needs 5 coefficients and 4 are known"):
        approximant(series, 3, 1)


# Changes of variable.

mappings = st.sampled_from(
    [
        Identity(),
        Euler(Fraction(1)),
        Euler(Fraction(7, 3), Fraction(2, 3)),
        CutPlane(Fraction(-3, 2)),
        CutPlane(Fraction(5)),
        Pair(Fraction(171, 50), Fraction(-3, 4)),
        Pair(Fraction(2), Fraction(0)),
    ]
)


@settings(deadline=None, max_examples=60)
@given(mapping=mappings, share=st.integers(min_value=1, max_value=999))
def test_image_and_preimage_are_inverse_and_the_image_stays_below_one(mapping: Mapping, share: int) -> None:
    with ctx.workprec(120):
        x = arb(fmpq(share, 200))  # below 5, where the cut of one of them begins
        w = mapping.image(x)
        assert mapping.preimage(w).overlaps(x)
        assert isinstance(mapping, Identity) or 0 < w < 1
        assert number_ball(mapping.expression(sympy.Rational(share, 200))).overlaps(w)


@settings(deadline=None, max_examples=40)
@given(mapping=mappings, length=st.integers(min_value=3, max_value=16))
def test_the_series_of_the_inverse_is_that_of_the_preimage(mapping: Mapping, length: int) -> None:
    assume(not isinstance(mapping, Identity))
    series = mapping.series(length)
    assert len(series) == length
    with ctx.workprec(900):
        errors = [abs(polynomial_at(tuple(series), w) - mapping.preimage(w)) for w in (arb(2) ** -20, arb(2) ** -21)]
        following = mapping.series(length + 2)
        order = length if following[length] != 0 else length + 1
        assert abs(float((errors[0] / errors[1]).log() / arb(2).log()) - order) < 1e-3


@pytest.mark.parametrize(
    "mapping",
    [Euler(Fraction(1)), Euler(Fraction(2), Fraction(2, 3)), CutPlane(Fraction(-1)), Pair(Fraction(2), Fraction(-1))],
)
@pytest.mark.parametrize(("growth", "n"), [(Fraction(0), 0), (HALF, 0), (Fraction(-1, 2), 3), (Fraction(1), 2)])
def test_a_mapped_series_is_the_same_series_through_its_order(mapping: Mapping, growth: Fraction, n: int) -> None:
    series = expansion("duffing", 16)
    form = mapped(series, mapping, growth=growth, n=n)
    assert form.order == 16
    with ctx.workprec(1200):
        gaps = [abs(form.in_balls(A) - duffing(A)) for A in (arb(2) ** -20, arb(2) ** -21)]
        assert float((gaps[0] / gaps[1]).log() / arb(2).log()) == pytest.approx(18, abs=1e-2)
        printed = form.expression().subs(sympy.Symbol("A", real=True), sympy.Rational(1, 7))
        assert number_ball(printed).overlaps(form.in_balls(arb(fmpq(1, 7))))


def test_a_mapping_without_its_singularity_is_refused() -> None:
    for build, words in (
        (lambda: Euler(Fraction(0)), "x0 = 0"),
        (lambda: Euler(Fraction(1), Fraction(-1)), "rate = -1"),
        (lambda: CutPlane(Fraction(0)), "origin"),
        (lambda: Pair(Fraction(1), Fraction(1, 2)), "left half plane"),
        (lambda: mapping_for(limits(expansion("linear", 20))), "every coefficient beyond the first is zero"),
        (lambda: mapped(expansion("duffing", 8), Identity(), growth=HALF), "needs a mapping"),
    ):
        with pytest.raises(InputError, match=words):
            build()


def test_the_mapping_is_chosen_by_the_singularity() -> None:
    assert mapping_for(limits(expansion("duffing", 24))) == Euler(Fraction(1))
    assert mapping_for(limits(expansion("duffing", 24)), cut=True) == CutPlane(Fraction(-1))
    assert mapping_for(limits(expansion("duffing-softening", 24))) == CutPlane(Fraction(1))
    pair = mapping_for(limits(expansion("van-der-pol", 48)))
    assert isinstance(pair, Pair)
    assert abs(float(pair.modulus) - 3.42) < 0.01
    assert abs(float(pair.half_sum) + 0.7513) < 0.01


def test_eulers_transformation_serves_duffing_at_every_amplitude() -> None:
    # omega0 grows like A = x^(1/2); with that taken out the series in w converges on all of 0 <= w <= 1.
    for order, bound in ((8, 1e-3), (16, 2e-5), (32, 1e-7)):
        form = mapped(expansion("duffing", order), Euler(Fraction(1)), growth=HALF)
        for A in (arb(1), arb(3), arb(30), arb(3000)):
            assert error(form, A, duffing(A)) < (bound if A < 10 else 10 * bound)
    assert abs(float(expansion("duffing", 32)(3.0))) > 1e9  # what the series itself makes of it


def test_the_cut_plane_reaches_close_to_the_saddle_of_the_softening_duffing_oscillator() -> None:
    A = arb(fmpq(95, 100))
    exact = duffing(A, -1)
    series = expansion("duffing-softening", 40)
    assert error(mapped(series, CutPlane(Fraction(1))), A, exact) < 0.1 * abs(float(series(0.95)) / float(exact) - 1)
