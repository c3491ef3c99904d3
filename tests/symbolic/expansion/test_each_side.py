"""Forces that are analytic on each side of rest: series, certified balls and plain quadrature, three routes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U

COEFFICIENTS = st.fractions(Fraction(-1, 2), Fraction(1, 2), max_denominator=6)
STIFF = st.fractions(Fraction(1, 2), 4, max_denominator=4)


def integrated(force: sympy.Expr, peak: float) -> float:
    """omega0 of the integrated motion: from the peak to u = 0, and on to the trough, by located events."""
    f = sympy.lambdify(U, force, "math")

    def leg(state: tuple[float, float], part: int, side: float) -> tuple[float, tuple[float, float]]:
        def stop(t: float, y: np.ndarray) -> float:
            return float(y[part]) if t > 0 else side

        stop.terminal = True  # type: ignore[attr-defined]

        def slope(_: float, y: np.ndarray) -> tuple[float, float]:
            return y[1], -f(max(y[0], 0.0) if side > 0 else min(y[0], 0.0))  # the force of its own side

        run = solve_ivp(slope, (0.0, 1e4), state, "DOP853", events=stop, rtol=1e-12, atol=1e-14 * peak)
        return float(run.t_events[0][0]), (0.0, float(run.y_events[0][0][1]))

    near, middle = leg((peak, 0.0), 0, 1.0)
    far, _ = leg(middle, 1, -1.0)
    return math.pi / (near + far)


def force_text(a: Fraction, b: Fraction, k1: Fraction, k2: Fraction) -> str:
    return f"u'' + ({k1})*max(u, 0) + ({k2})*min(u, 0) + ({a})*u*abs(u) + ({b})*u**3"


def test_the_first_term_of_the_issue_is_exact() -> None:
    eps = sympy.Symbol("eps", real=True)
    assert energy_on_each_side("u'' + u + eps*u*abs(u) = 0", 1).frequency == (1, 4 * eps / (3 * sympy.pi))
    assert energy_integral("u'' + u + eps*u*abs(u) = 0", 1).frequency == (1, 4 * eps / (3 * sympy.pi))


@pytest.mark.parametrize("name", ["pendulum", "duffing", "helmholtz-duffing"])
def test_an_analytic_force_has_the_series_of_the_whole_well(name: str) -> None:
    found = energy_on_each_side(name, 9)
    assert isinstance(found, Expansion)
    assert found.frequency == lindstedt(name, 9).frequency
    trough = energy_on_each_side(name, 5, amplitude="trough")
    assert trough.frequency == energy_integral(name, 5, amplitude="trough").frequency


@settings(deadline=None, max_examples=6)
@given(COEFFICIENTS, COEFFICIENTS, STIFF, STIFF)
def test_random_kinked_springs_agree_by_three_routes(a: Fraction, b: Fraction, k1: Fraction, k2: Fraction) -> None:
    own = as_oscillator(force_text(a, b, k1, k2))
    place = Fraction(1, 16)
    ball = enclose(own, place, bits=90)
    series = energy_on_each_side(own, 8)
    with ctx.workprec(120):
        assert abs(series.in_balls(arb(rational(place))) / ball.omega - 1) < 1e-8
    assert integrated(own.substituted_force, float(place)) == pytest.approx(float(ball.middle), rel=1e-10)


@settings(deadline=None, max_examples=5)
@given(st.fractions(0, 4, max_denominator=3), st.fractions(Fraction(1, 3), 3, max_denominator=4), st.integers(1, 5))
def test_a_power_has_its_gamma_functions(p: Fraction, factor: Fraction, amplitude: int) -> None:
    """A quarter of a cycle of V = c s |u|^(1/s), s = 1/(p + 1), by Euler's beta function (DLMF 5.12.1)."""
    own = as_oscillator(f"u'' + ({factor})*sign(u)*abs(u)**({p}) = 0" if p else f"u'' + ({factor})*sign(u) = 0")
    s = mpmath.mpf(1) / (1 + mpmath.mpf(p.numerator) / p.denominator)
    size, c = mpmath.mpf(amplitude), mpmath.mpf(factor.numerator) / factor.denominator
    quarter = mpmath.sqrt(1 / (2 * c * s)) * s * mpmath.beta(s, 0.5) * size ** (1 - 1 / (2 * s))
    expected = mpmath.pi / (2 * quarter)
    assert mpmath.almosteq(mpmath.mpf(enclose(own, amplitude, bits=64).omega.str(18, radius=False)), expected, 1e-13)
    series = energy_on_each_side(own, 1)
    assert float(series(float(amplitude))) == pytest.approx(float(expected), rel=1e-13)


@pytest.mark.parametrize(
    ("equation", "at_one", "power"),
    [
        ("u'' + sign(u) = 0", 1.110721, sympy.Rational(-1, 2)),
        ("u'' + u**(1/3) = 0", 1.070451, sympy.Rational(-1, 3)),
        ("u'' + u*abs(u) = 0", 0.914681, sympy.Rational(1, 2)),
        ("u'' + u**3 = 0", 0.847213, sympy.Integer(1)),
    ],
)
def test_forces_without_a_linear_part(equation: str, at_one: float, power: sympy.Rational) -> None:
    series = energy_on_each_side(equation, 2)
    assert isinstance(series, PowerExpansion)
    assert series.is_power_law
    assert series.growth == power
    assert float(enclose(equation, 1).middle) == pytest.approx(at_one, abs=6e-7)
    assert series(1.0) == pytest.approx(at_one, abs=6e-7)
    assert series.to_dict()["frequency"][0]["powers"] == {"A": 1 if power == 1 else str(power)}  # type: ignore[index]


@pytest.mark.parametrize(
    "equation",
    [
        "u'' + u - sin(u) = 0",
        "u'' + u**3 + u**5 = 0",
        "u'' + sqrt(2)*u**3 + u**4 = 0",
        "u'' + u + abs(u)**(3/2)*sign(u)/5 = 0",
        "u'' + u**(1/3) + u = 0",
        "u'' + 2*max(u, 0) + min(u, 0) + u**2*exp(-abs(u)) = 0",
        "u'' + k1*max(u, 0) + k2*min(u, 0) + b*u**3 = 0",
        "u'' + log(1 + abs(u))*sign(u) + c*u**2 = 0",
    ],
)
def test_the_certificate_holds_and_tells_a_wrong_coefficient(equation: str) -> None:
    own, series = as_oscillator(equation), energy_on_each_side(equation, 3)
    (check,) = certify(own, series)
    assert check.passed, check.statement
    if not series.symbolic_names:
        place = Fraction(1, 32)
        found = integrated(own.substituted_force, float(place))
        assert found == pytest.approx(float(enclose(own, place, bits=80).middle), rel=1e-9)


def test_a_wrong_coefficient_fails_the_certificate() -> None:
    own = as_oscillator("u'' + u + u*abs(u)/3 = 0")
    series = energy_on_each_side(own, 3)
    wrong = replace(series, coefficients=(*series.coefficients[:3], series.coefficients[3] + 1))
    assert certify(own, wrong)[0].passed is False


def test_bilinear_springs_take_half_a_period_on_each_side() -> None:
    k1, k2 = (sympy.Symbol(name, positive=True) for name in ("k1", "k2"))
    found = energy_on_each_side("u'' + k1*max(u, 0) + k2*min(u, 0) = 0", 3)
    root = {sympy.Symbol(n, real=True): s for n, s in (("k1", k1), ("k2", k2))}
    expected = 2 / (1 / sympy.sqrt(k1) + 1 / sympy.sqrt(k2))
    assert sympy.simplify(found.frequency[0].subs(root) - expected) == 0
    assert found.frequency[1:] == (0, 0, 0)
    own = enclose("u'' + 4*max(u, 0) + min(u, 0) = 0", 3, bits=80)
    assert own.omega.overlaps(arb(4) / 3)
    assert own.trough.overlaps(arb(-6))  # energy: 4 A^2 = B^2
    assert enclose("u'' + 4*max(u, 0) + min(u, 0) = 0", 6, definition="trough", bits=80).peak.overlaps(arb(3))


def test_roots_and_signs_are_read_in_text_and_from_sympy() -> None:
    x = sympy.Symbol("x")
    forms = ("u'' + u + abs(u)*u = 0", as_oscillator(x + x * sympy.Abs(x)))
    assert len({energy_on_each_side(form, 3).frequency for form in forms}) == 1
    text = as_oscillator("u'' + 3*max(u, 0) + min(u, 0) = 0")
    assert as_oscillator(3 * sympy.Max(x, 0) + sympy.Min(x, 0), unknown="x").force == text.force
    assert as_oscillator("u'' + u**(1/3) = 0").force == as_oscillator("u'' + sign(u)*abs(u)**(1/3) = 0").force
    assert as_oscillator("u'' + u*abs(u) = 0").potential == sympy.Abs(U) ** 3 / 3


@pytest.mark.parametrize(
    ("equation", "why"),
    [
        ("u'' + max(u, 0) + min(u, 0)**3 = 0", "begins like"),
        ("u'' + u + u*abs(u) + u'*u**2 = 0", "terms in u'"),
    ],
)
def test_what_has_no_series_is_refused(equation: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        energy_on_each_side(equation, 2)


QUADRATIC = "u'' + u*abs(u) - u**3 = 0"


def test_a_series_in_broken_powers_has_one_value_in_every_form() -> None:
    """As float, ball and expression; the headline, the formula and the picture are of the same series."""
    series = energy_on_each_side(QUADRATIC, 2)
    value = float(series(0.04))
    assert series.in_balls(arb("0.04")).overlaps(arb(value) + arb(0, 1e-15))
    assert float(series.expression().subs(sympy.Symbol("A", real=True), sympy.Rational(1, 25))) == pytest.approx(value)
    assert series.in_balls(arb("0.04")).overlaps(enclose(QUADRATIC, "0.04").omega + arb(0, 1e-4))
    rows = series.rows()
    assert value == pytest.approx(sum(row["decimal"] * 0.04 ** float(row["power"]) for row in rows))
    assert [row["power"] for row in rows] == [sympy.Rational(n, 2) for n in (1, 3, 5)]
    stroke = series.picture().strokes[0]
    assert stroke.y[-1] == pytest.approx(float(series(1.0)))
    assert series.formulas()[0].startswith(r"\omega_0(A) = ")
    assert "omega0 = sqrt(6)" in series.headline()


@pytest.mark.parametrize(
    ("call", "why"),
    [
        (lambda: energy_on_each_side("u'' + c*u**3 = 0", 2).in_balls(arb(1)), "hold c as symbols"),
        (lambda: energy_on_each_side("u'' + c*u**3 = 0", 2).picture(), "without a value; set them to draw"),
        (lambda: energy_on_each_side(QUADRATIC, 2).truncated(3), r"order 3 is not within 0..2"),
    ],
)
def test_what_a_series_in_broken_powers_cannot_do_it_says(call: Callable[[], object], why: str) -> None:
    with pytest.raises(InputError, match=why):
        call()
    assert energy_on_each_side(QUADRATIC, 2).truncated(1) == energy_on_each_side(QUADRATIC, 1)


def test_another_power_on_each_side_has_a_frequency_all_the_same() -> None:
    """A quarter of a linear cycle twice and half a cycle of the cubic force at the same energy."""
    found = enclose("u'' + max(u, 0) + min(u, 0)**3 = 0", 1, bits=64)
    depth = 2 ** Fraction(1, 4)  # V = u^2/2 and u^4/4
    half = math.pi / (math.gamma(0.75) / math.gamma(1.25) * math.sqrt(math.pi / 8) * float(depth))
    assert float(found.middle) == pytest.approx(2 * math.pi / (math.pi + half), rel=1e-14)


def test_oscillators_keep_what_they_are() -> None:
    own = Oscillator.from_equation("u'' + u + c*abs(u')*u' + F*sign(u') = 0")
    assert (own.kind, own.is_kinked, own.by_sides) == ("damped", False, False)
    assert Oscillator.from_equation("u'' + u + 0.02*u' + 0.1*sign(u') = 0").parameters == {"mu": sympy.Rational(1, 100)}
