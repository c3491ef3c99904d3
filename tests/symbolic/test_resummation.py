"""Resummations against closed forms, exact identities, and limit cycles integrated numerically."""

import json
import math
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy
from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from symbolic.energy_integral import energy_integral
from symbolic.errors import InputError
from symbolic.expansion import Expansion
from symbolic.lindstedt import lindstedt
from symbolic.mapping import CutPlane, Euler, Identity, Mapping, Pair
from symbolic.nome import nome, nome_series, theta_3
from symbolic.oscillator import Oscillator
from symbolic.pade import RationalForm, mapped, mapping_for, pade
from symbolic.rational_function import approximant, at, zeros
from symbolic.resummation import Resummation, relative_error
from symbolic.singularity import limits
from symbolic.systems import find

HALF = Fraction(1, 2)


@cache
def expansion(name: str, order: int) -> Expansion:
    return (lindstedt if name == "van-der-pol" else energy_integral)(find(name), order)


def pendulum(A: arb) -> arb:
    return arb(1).agm((A / 2).cos())


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
    assert at(denominator, (place - arb(10) ** -12) ** 2) * at(denominator, (place + arb(10) ** -12) ** 2) < 0
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


@settings(deadline=None, max_examples=40)
@given(mapping=mappings, length=st.integers(min_value=3, max_value=16))
def test_the_series_of_the_inverse_is_that_of_the_preimage(mapping: Mapping, length: int) -> None:
    assume(not isinstance(mapping, Identity))
    series = mapping.series(length)
    assert len(series) == length
    with ctx.workprec(900):
        errors = [abs(at(tuple(series), w) - mapping.preimage(w)) for w in (arb(2) ** -20, arb(2) ** -21)]
        following = mapping.series(length + 2)
        order = length if following[length] != 0 else length + 1
        assert abs(float((errors[0] / errors[1]).log() / arb(2).log()) - order) < 1e-3


@pytest.mark.parametrize(
    "mapping",
    [Euler(Fraction(1)), Euler(Fraction(2), Fraction(2, 3)), CutPlane(Fraction(-1)), Pair(Fraction(2), Fraction(-1))],
)
@pytest.mark.parametrize(("growth", "n"), [(Fraction(0), 0), (HALF, 0), (Fraction(-1, 2), 3)])
def test_a_mapped_series_is_the_same_series_through_its_order(mapping: Mapping, growth: Fraction, n: int) -> None:
    series = expansion("duffing", 16)
    form = mapped(series, mapping, growth=growth, n=n)
    assert form.order == 16
    with ctx.workprec(1200):
        gaps = [abs(form.in_balls(A) - duffing(A)) for A in (arb(2) ** -20, arb(2) ** -21)]
        assert float((gaps[0] / gaps[1]).log() / arb(2).log()) == pytest.approx(18, abs=1e-2)


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


# The elliptic nome.


def test_the_nome_series_is_the_published_one() -> None:
    # DLMF 19.5.5, and OEIS A005797 for the terms beyond
    assert nome_series(7) == (0, 1, 8, 84, 992, 12514, 164688, 2232200)
    assert theta_3(9) == (1, 2, 0, 0, 2, 0, 0, 0, 0, 2)


def test_the_nome_series_inverts_the_quotient_of_the_periods() -> None:
    with mpmath.workdps(40):
        m = mpmath.mpf("0.01")
        q = mpmath.exp(-mpmath.pi * mpmath.ellipk(1 - m) / mpmath.ellipk(m))
        total = sum(mpmath.mpf(int(c)) * (m / 16) ** n for n, c in enumerate(nome_series(16)))
        assert abs(total / q - 1) < 1e-28


@pytest.mark.parametrize("steps", [0, 1, 2, 3])
@pytest.mark.parametrize("order", [0, 6, 16, 33])
@pytest.mark.parametrize(("name", "exact"), [("pendulum", pendulum), ("duffing", duffing)])
def test_the_nome_form_agrees_with_the_exact_frequency_through_its_order(
    name: str, exact, order: int, steps: int
) -> None:
    form = nome(find(name), order, steps=steps)
    with ctx.workprec(4000):
        gaps = [abs(form.in_balls(A) / exact(A) - 1) for A in (arb(2) ** -20, arb(2) ** -21)]
        observed = float((gaps[0] / gaps[1]).log() / arb(2).log())
    assert observed == pytest.approx(2 ** (steps + 1) * (order // 2 ** (steps + 1) + 1), abs=1e-3)
    assert observed > order


@pytest.mark.parametrize(("order", "bound"), [(8, 2e-3), (16, 1e-4), (40, 5e-8), (80, 4e-13)])
def test_near_the_separatrix_the_nome_is_far_better_than_series_and_pade(order: int, bound: float) -> None:
    with ctx.workprec(200):
        A = arb.pi() * arb(fmpq(95, 100))
        by_nome, by_pade = (
            error(nome(find("pendulum"), order), A, pendulum(A)),
            error(pade(expansion("pendulum", order)), A, pendulum(A)),
        )
        plain = float(relative_error(expansion("pendulum", order).in_balls(A), pendulum(A)))
    assert by_nome < bound
    assert by_nome < by_pade < plain


def test_the_nome_is_recognised_by_the_force() -> None:
    swing = Oscillator.from_equation("x'' + 12*sin(3*x/2) = 0")  # k^2 = 18, c = 3/2
    A = arb(1)
    with ctx.workprec(200):
        exact = arb(18).sqrt() * arb(1).agm((A * 3 / 4).cos())
    assert error(nome(swing, 48), A, exact) < 1e-24
    stiff = Oscillator.from_equation("y'' + 4*y - y**3/2 = 0")
    with ctx.workprec(200):
        exact = 2 * (1 - A / 8).sqrt().agm((1 - A / 16).sqrt())
    assert error(nome(stiff, 24), A, exact) < 1e-24
    for equation in ("u'' + u + u**2", "u'' + u + u**5", "u'' + sin(u) + u**3", "u'' + tan(u)", "u'' + u"):
        with pytest.raises(InputError, match="neither k\\^2 sin"):
            nome(Oscillator.from_equation(equation), 8)


def test_the_nome_form_ends_with_the_oscillation() -> None:
    for name, beyond in (("pendulum", 3.1416), ("pendulum", 6.0), ("duffing-softening", 1.01)):
        with pytest.raises(InputError, match="does not hold at A"):
            nome(find(name), 16)(beyond)
    assert nome(find("pendulum"), 16)(3.1415) > 0


# Limit cycles.


@cache
def van_der_pol_period(eps: float) -> float:
    """Time between maxima on the limit cycle, by an eighth-order integrator."""
    maximum = lambda _, y: y[1]  # noqa: E731
    maximum.direction = -1
    run = solve_ivp(
        lambda _, y: [y[1], eps * (1 - y[0] ** 2) * y[1] - y[0]],
        (0.0, 100.0 + 12 * eps),
        [2.0, 0.0],
        method="DOP853",
        rtol=1e-11,
        atol=1e-12,
        events=maximum,
    )
    last = run.t_events[0][-2:]
    return float(last[1] - last[0])


def test_the_reference_periods_are_the_published_ones() -> None:
    assert van_der_pol_period(1.0) == pytest.approx(6.66328686, abs=1e-8)
    assert van_der_pol_period(10.0) == pytest.approx(19.0783696, abs=1e-7)


def van_der_pol_error(form: Resummation, eps: float) -> float:
    return abs(form(eps) * van_der_pol_period(eps) / (2 * math.pi) - 1)


# (order, mapping, [m/n], bounds at eps = 1, 3, 10): measured, then rounded up by a factor of at most two.
VAN_DER_POL = [
    (24, Identity(), 6, (1e-9, 6e-4, 0.4)),
    (46, Identity(), 12, (1e-9, 3e-6, 0.1)),
    (24, Pair(Fraction(171, 50), Fraction(-3, 4)), 6, (1e-9, 8e-4, 0.12)),
    (48, Pair(Fraction(171, 50), Fraction(-3, 4)), 12, (1e-9, 2e-6, 0.02)),
    (48, Euler(Fraction(171, 50), Fraction(2, 3)), 12, (1e-9, 5e-7, 4e-3)),
]


@pytest.mark.parametrize(("order", "mapping", "n", "bounds"), VAN_DER_POL)
def test_van_der_pol_beyond_its_radius(order: int, mapping: Mapping, n: int, bounds: tuple[float, ...]) -> None:
    # T ~ (3 - 2 log 2) eps at infinity (Dorodnitsyn 1947), so omega0 ~ x^(-1/2) in x = eps^2
    growth = Fraction(0) if mapping == Identity() else -HALF
    form = mapped(expansion("van-der-pol", order), mapping, growth=growth, n=n)
    for eps, bound in zip((1.0, 3.0, 10.0), bounds, strict=True):
        assert van_der_pol_error(form, eps) < bound
    assert abs(float(expansion("van-der-pol", order)(3.0))) > 10  # the series has diverged


def test_the_andersen_geer_map_alone_converges_beyond_the_radius() -> None:
    pair = Pair(Fraction(171, 50), Fraction(-3, 4))
    errors = [
        van_der_pol_error(mapped(expansion("van-der-pol", order), pair, growth=-HALF), 3.0) for order in (8, 16, 32, 48)
    ]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 2e-3


def test_relaxation_oscillations_are_reached_at_infinity() -> None:
    # T/eps -> 3 - 2 log 2 as eps grows; the mapped form has a finite limit there, the truncated series has none.
    form = mapped(expansion("van-der-pol", 48), Euler(Fraction(171, 50), Fraction(2, 3)), growth=-HALF, n=12)
    assert 2 * math.pi / form(1e6) / 1e6 == pytest.approx(3 - 2 * math.log(2), rel=0.05)


# One interface.


def forms() -> list[Resummation]:
    vdp = lindstedt(find("van-der-pol").with_parameters({"k": 2}), 16)
    return [
        pade(expansion("pendulum", 8)),
        pade(expansion("helmholtz-duffing", 5), 3, 2),
        mapped(expansion("duffing", 8), Euler(Fraction(3, 2), Fraction(2, 3)), growth=HALF, n=1),
        mapped(expansion("duffing", 8), CutPlane(Fraction(-1)), growth=HALF),
        mapped(vdp, Pair(Fraction(171, 50), Fraction(-3, 4)), growth=-HALF, n=3),
        nome(find("pendulum").with_parameters({"k": "3/2"}), 16),
        nome(find("duffing").with_parameters({"eps": "1/3"}), 16, steps=1),
    ]


@pytest.mark.parametrize("form", forms(), ids=lambda form: f"{form.system} {form.method}")
class TestInterface:
    def test_the_printed_expression_is_what_is_evaluated(self, form: Resummation) -> None:
        expression = form.expression()
        (symbol,) = expression.free_symbols
        assert symbol == sympy.Symbol(form.variable, real=True)
        for value in (Fraction(1, 7), Fraction(3, 4)):
            with ctx.workprec(120):
                ball = form.in_balls(arb(fmpq(value.numerator, value.denominator)))
            printed = expression.subs(symbol, sympy.Rational(value)).evalf(25)
            assert abs(sympy.Float(str(ball.mid().str(30, radius=False)), 30) - printed) < sympy.Float("1e-22")

    def test_numbers_and_arrays(self, form: Resummation) -> None:
        values = np.array([[0.1, 0.5], [0.9, 0.25]])
        result = form(values)
        assert result.shape == (2, 2)
        assert values.tolist() == [[0.1, 0.5], [0.9, 0.25]]
        assert result[1, 0] == form(0.9) == form(np.float64(0.9))
        assert isinstance(form(0.9), float)
        assert form(Fraction(1, 4)) == form(0.25) == form(sympy.Rational(1, 4)) == result[1, 1]

    def test_mpmath_numbers_keep_their_precision(self, form: Resummation) -> None:
        with mpmath.workdps(50):
            value = form(mpmath.mpf("0.3"))
            with ctx.workprec(250):
                ball = form.in_balls(arb("0.3"))
            assert abs(value - mpmath.mpf(ball.str(60, radius=False))) < mpmath.mpf(10) ** -48

    def test_the_public_form(self, form: Resummation) -> None:
        public = json.loads(json.dumps(form.to_dict()))
        assert public["method"] == form.method
        assert public["amplitude"] == form.amplitude == "peak"
        assert public["variables"] == [form.variable]
        assert form.latex().startswith(r"\omega_0(")
        assert form.mathml().startswith("<math")

    def test_text_is_not_a_number(self, form: Resummation) -> None:
        with pytest.raises(InputError, match="is a str, not a real number"):
            form("0.3")


@settings(deadline=None, max_examples=30)
@given(A=st.floats(min_value=0.0, max_value=3.1))
def test_floats_are_the_exact_value_rounded_once(A: float) -> None:
    form = nome(find("pendulum"), 40)
    with ctx.workprec(300):
        assert form(A) == float(form.in_balls(arb(A)).mid())


def test_balls_enclose_a_whole_range_of_amplitudes() -> None:
    form: RationalForm = pade(expansion("pendulum", 16))
    wide = form.in_balls(arb(1, 0.01))
    for A in (0.991, 1.0, 1.009):
        assert wide.contains(arb(form(A)))
    for around_zero in (form, nome(find("pendulum"), 16)):
        assert around_zero.in_balls(arb(0, 0.01)).contains(1)


def test_error_statements() -> None:
    assert float(relative_error(arb(3), arb(2))) == 0.5
    with pytest.raises(InputError, match="not positive"):
        relative_error(arb(1), arb(0, 1))
    A = arb(1)
    with ctx.workprec(200):
        bound = pade(expansion("pendulum", 16)).error_against(A, pendulum(A))
        assert 0 < bound < 1e-12


def test_an_expansion_is_enclosed_like_a_resummation() -> None:
    series = lindstedt(find("van-der-pol").with_parameters({"k": 2}), 8)
    assert float(series.in_balls(arb(1)).mid()) == pytest.approx(series(1.0), rel=1e-15)
    with pytest.raises(InputError, match="alpha2 as symbols"):
        energy_integral(find("helmholtz").with_parameters({"alpha2": None}), 4).in_balls(arb(1))
