"""Equations as textbooks write them: every symbol left symbolic, parameters in denominators, losses as numbers."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.arithmetic.tidy import tidy
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import small_parameters
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

CONSERVATIVE = (
    "m*x'' + k*x + k3*x**3 = 0",
    "u'' + k2/alpha*sinh(alpha*u) = 0",
    "theta'' + g/L*sin(theta) = 0",
    "u'' + sin(u) + w0**2*u = 0",
    "u'' + alpha*u/(beta + u) = 0",
    "u'' + k*u*(9 - l0/sqrt(l**2 + u**2)) = 0",
    "u'' + exp(alpha*u) - 1 = 0",
    "theta'' + sin(theta) - w**2*sin(theta)*cos(theta) = 0",
)
LOSSY = (
    "m*x'' + c*x' + k*x + k3*x**3 = 0",
    "u'' + u'/Q + u + u**3 = 0",
    "u'' + 0.02*u' + u + u**3 = 0",
    "u'' + eps*(u' + u**3) + u = 0",
    "u'' + 2*mu*u' + mu*u**2 + u = 0",
    "u'' + 2*mu*u' + alpha*(exp(u) - 1) = 0",
    "u'' + 2*mu*u' + exp(alpha*u) - 1 = 0",
    "u'' + 2*mu*u' + sin(u) + w0**2*u = 0",
    "u'' + 2*mu*u' + 2*u + pi*u**3 = 0",
)
VALUES = st.fractions(min_value=Fraction(1, 5), max_value=Fraction(4, 5), max_denominator=7)


def own(equation: str, **values: object) -> Oscillator:
    return Oscillator.from_equation(equation, parameters=values)  # type: ignore[arg-type]


def symbol(name: str) -> sympy.Symbol:
    return sympy.Symbol(name, real=True)


def equal(first: sympy.Expr, second: sympy.Expr) -> bool:
    return bool(abs(sympy.N(first - second, 40)) < 1e-30)


def test_the_first_equation_of_every_textbook() -> None:
    """omega0 = sqrt(k/m) (1 + 3 k3 A^2/(8 k) - 21 k3^2 A^4/(256 k^2)) (Nayfeh and Mook 1979, 4.1, in units)."""
    m, k, k3 = sympy.symbols("m k k3", positive=True)
    found = [c.subs({symbol(str(s)): s for s in (m, k, k3)}) for c in lindstedt(own(CONSERVATIVE[0]), 4).frequency]
    expected = [1, 0, 3 * k3 / (8 * k), 0, -21 * k3**2 / (256 * k**2)]
    assert all(sympy.simplify(c - sympy.sqrt(k / m) * e) == 0 for c, e in zip(found, expected, strict=True))


def test_its_damped_twin() -> None:
    """phi' through a^2 and c^2, and a'/a = -c/(2 m) + 3 c k3 a^2/(16 k m)."""
    flow = multiple_scales(own(LOSSY[0]), 4)
    c, m, k, k3, a = (symbol(name) for name in ("c", "m", "k", "k3", "a"))
    growth = -c / (2 * m) + 3 * c * k3 * a**2 / (16 * k * m)
    assert sympy.simplify(flow.growth_rate_expression() - growth) == 0
    assert flow.small_parameters == ("c",)


@pytest.mark.parametrize("equation", CONSERVATIVE)
def test_every_certificate_holds_with_symbols(equation: str) -> None:
    oscillator = own(equation)
    checks = certify(oscillator, lindstedt(oscillator, 5))
    assert {check.name for check in checks if check.passed} >= {"residual", "normalisation", "energy integral"}
    assert all(check.passed is not False for check in checks)


@pytest.mark.parametrize("equation", LOSSY)
def test_every_slow_flow_holds_with_symbols(equation: str) -> None:
    oscillator = own(equation)
    checks = certify(oscillator, multiple_scales(oscillator, 5))
    assert all(check.passed is not False for check in checks)
    assert checks[0].passed is True


@pytest.mark.parametrize("equation", CONSERVATIVE)
@settings(max_examples=2, deadline=None)
@given(data=st.data())
def test_numbers_may_be_inserted_before_or_after_the_series(equation: str, data: st.DataObject) -> None:
    symbolic = own(equation)
    chosen = {name: sympy.Rational(data.draw(VALUES)) for name in symbolic.parameters}
    values = {symbol(name): value for name, value in chosen.items()}
    after = [coefficient.subs(values) for coefficient in lindstedt(symbolic, 4).frequency]
    before = lindstedt(own(equation, **chosen), 4).frequency
    assert all(equal(x, y) for x, y in zip(after, before, strict=True))


@pytest.mark.parametrize("equation", [text for text in LOSSY if "0.02" not in text])
@settings(max_examples=2, deadline=None)
@given(data=st.data())
def test_numbers_may_be_inserted_before_or_after_the_flow(equation: str, data: st.DataObject) -> None:
    symbolic = own(equation)
    small = small_parameters(symbolic)
    chosen = {name: sympy.Rational(data.draw(VALUES)) for name in symbolic.parameters if name not in small}
    values = {symbol(name): value for name, value in chosen.items()}
    flows = multiple_scales(symbolic, 4), multiple_scales(symbolic.with_parameters(chosen), 4)
    point = {symbol(name): sympy.Rational(1, 7) for name in ("a", *small)}
    for side in ("frequency_expression", "growth_rate_expression"):
        first, second = (getattr(flow, side)().subs(values).subs(point) for flow in flows)
        assert equal(first, second)


def test_a_numeric_loss_gets_a_name_and_a_small_value() -> None:
    found = own("u'' + 0.02*u' + u + u**3 = 0")
    assert (found.parameters, found.damping, found.kind) == ({"mu": sympy.Rational(1, 100)}, "mu", "damped")
    assert own(found.equation, mu="0.01").force == found.force
    assert found.with_parameters({"mu": 0}).is_conservative


def test_a_numeric_excitation_gets_a_name_too() -> None:
    found = own("u'' - 0.1*(1 - u**2)*u' + u = 0")
    assert (found.parameters, found.small, found.kind) == ({"eps": sympy.Rational(1, 10)}, "eps", "limit-cycle")
    assert lindstedt(found, 4).frequency == (1, 0, -sympy.Rational(1, 16), 0, sympy.Rational(17, 3072))


def test_names_that_are_taken_are_not_taken_again() -> None:
    assert set(own("u'' + 0.02*u' + u + mu*u**3 = 0").parameters) == {"mu", "mu1"}


def test_nonlinear_losses_as_numbers_stay_numbers() -> None:
    assert own("u'' + u + u'**3 = 0").parameters == {}


def test_a_quality_factor_is_set_by_its_own_name() -> None:
    found = own("u'' + u'/Q + u = 0", Q=50)
    assert found.parameters == {"inv_Q": sympy.Rational(1, 50)}
    assert found.with_parameters({"Q": 20}).parameters == {"inv_Q": sympy.Rational(1, 20)}
    assert own("u'' + u'/Q + u = 0").with_parameters({"Q": 20}) == own("u'' + u'/Q + u = 0").with_parameters(
        {"inv_Q": "0.05"}
    )
    assert found.force == U + symbol("inv_Q") * V


def test_coefficients_come_in_their_shortest_form() -> None:
    series = lindstedt(own(CONSERVATIVE[-1]), 2).frequency
    assert str(series[2]) == "(4*w**2 - 1)/(16*sqrt(1 - w**2))"
    assert str(lindstedt(own("u'' + sin(u) + w0**2*u = 0"), 4).frequency[4]) == (
        "(8*w0**2 + 1)/(3072*(w0**2 + 1)**(3/2))"
    )


@settings(max_examples=8, deadline=None)
@given(st.integers(-3, 3), st.lists(st.integers(-3, 3), min_size=3, max_size=3), VALUES)
def test_the_short_form_has_the_same_value(power: int, c: list[int], value: Fraction) -> None:
    w = symbol("w")
    k, rational = sympy.sqrt(1 - w**2), (c[0] + c[1] * w) / (1 - w**2) + c[2] * w / (1 + w)
    at = sympy.Rational(value)
    assert equal(tidy(rational, k, power).subs(w, at), (rational * k**power).subs(w, at))
