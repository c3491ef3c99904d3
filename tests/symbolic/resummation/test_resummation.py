"""Resummations against closed forms, exact identities, and limit cycles integrated numerically."""

import json
import math
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.accuracy import accuracy, certified_error, resummations
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.resummation.mapping import CutPlane, Euler, Identity, Mapping, Pair
from ridgeback.symbolic.resummation.pade import RationalForm, mapped, pade
from ridgeback.symbolic.resummation.resummation import Resummation, relative_error
from ridgeback.symbolic.systems.catalogue import find

HALF = Fraction(1, 2)


@cache
def expansion(name: str, order: int) -> Expansion:
    return (lindstedt if name == "van-der-pol" else energy_integral)(find(name), order)


def pendulum(A: arb) -> arb:
    return arb(1).agm((A / 2).cos())


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


# Certified errors of conservative oscillators.


def test_certified_errors_are_those_against_the_closed_form() -> None:
    for form in resummations(find("pendulum"), 16):
        certified = certified_error(find("pendulum"), form, 1)
        with ctx.workprec(200):
            direct = form.in_balls(arb(1)) / pendulum(arb(1)) - 1
        assert certified.overlaps(direct)
        assert certified.rad() < 1e-30
        assert not certified.contains(0)  # the sign of the error is proved


def test_resummations_that_do_not_apply_are_left_out() -> None:
    methods = [form.method for form in resummations(find("helmholtz-duffing"), 10)]
    assert methods[0] == "energy-integral"
    assert not any("nome" in method for method in methods)
    assert [form.method for form in resummations(find("linear"), 10)] == ["energy-integral"]


def test_the_table_has_a_gap_where_a_formula_does_not_hold() -> None:
    rows = accuracy(find("pendulum"), 8, [Fraction(1), Fraction(3)])
    series, by_pade, _, by_nome = (row.errors for row in rows)
    assert abs(by_nome[1]) < abs(by_pade[1]) < abs(series[1])
    assert accuracy(find("pendulum"), 8, [Fraction(4)])[0].errors == (None,)


def test_the_formula_of_another_oscillator_has_no_certified_error() -> None:
    with pytest.raises(InputError, match="of pendulum in A has no certified error against duffing-hardening"):
        certified_error(find("duffing"), nome(find("pendulum"), 8), 1)
    with pytest.raises(InputError, match="peak in eps"):
        certified_error(find("van-der-pol"), expansion("van-der-pol", 8), 1)
