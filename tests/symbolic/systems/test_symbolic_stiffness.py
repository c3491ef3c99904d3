"""A natural frequency left symbolic: the coefficients hold for every value of its parameters."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.naming import argument_name
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.oscillator import Oscillator

POSITIVE = st.fractions(min_value=Fraction(1, 9), max_value=9, max_denominator=9)
ANY = st.fractions(min_value=-5, max_value=5, max_denominator=7)

EQUATIONS = (
    "u'' + k**2*u + b*u**3 = 0",
    "u'' + k**2*u + b*u**2 + c*k**2*u**3 = 0",
    "u'' + a*u + b*u**3 = 0",
    "u'' + (a + c)*u + b*u**2 = 0",
    "u'' + a*sin(u) + c*sinh(2*u) = 0",
)


def own(equation: str, **values: Fraction) -> Oscillator:
    return Oscillator.from_equation(equation, parameters={n: sympy.Rational(v) for n, v in values.items()})


@pytest.mark.parametrize("equation", EQUATIONS)
@settings(max_examples=6, deadline=None)
@given(k=POSITIVE, a=POSITIVE, c=POSITIVE, b=ANY)
def test_numbers_may_be_inserted_before_or_after(
    equation: str, k: Fraction, a: Fraction, b: Fraction, c: Fraction
) -> None:
    symbolic = own(equation)
    chosen = {name: value for name, value in {"k": k, "a": a, "b": b, "c": c}.items() if name in symbolic.parameters}
    values = {sympy.Symbol(name, real=True): sympy.Rational(value) for name, value in chosen.items()}
    after = [coefficient.subs(values) for coefficient in lindstedt(symbolic, 4).frequency]
    before = lindstedt(own(equation, **chosen), 4).frequency
    assert all(sympy.expand(x - y) == 0 for x, y in zip(after, before, strict=True))


def test_duffing_by_hand() -> None:
    """u'' + a u + b u^3: with time in 1/sqrt(a) it is Duffing's equation with b/a (Nayfeh and Mook, 1979, 2.3)."""
    a, b = sympy.symbols("a b", real=True)
    found = lindstedt(own(EQUATIONS[2]), 4).frequency
    expected = (sympy.sqrt(a), 0, 3 * b / (8 * sympy.sqrt(a)), 0, -21 * b**2 / (256 * a ** sympy.Rational(3, 2)))
    assert all(sympy.expand(x - y) == 0 for x, y in zip(found, expected, strict=True))


@pytest.mark.parametrize("equation", EQUATIONS)
def test_certificate_holds(equation: str) -> None:
    oscillator = own(equation)
    expansion = lindstedt(oscillator, 5)
    assert all(check.passed is not False for check in certify(oscillator, expansion))
    assert sum(check.passed is True for check in certify(oscillator, expansion)) >= 3
    assert not any(expansion.difference(energy_integral(oscillator, 5)))


@pytest.mark.parametrize("equation", EQUATIONS)
def test_code_takes_the_natural_frequency_as_an_argument(equation: str) -> None:
    """The code with k for an argument is the exact series with the same numbers in it."""
    series = lindstedt(own(equation), 4)
    form = form_of(series)
    numbers = {"k": Fraction(5, 4), "a": Fraction(9, 4), "b": Fraction(1, 8), "c": Fraction(1, 2)}
    values = {sympy.Symbol(n, real=True): sympy.Rational(v) for n, v in numbers.items()}
    natural = float(series.scale.subs(values))
    given = {argument_name(name): float(v) for name, v in numbers.items()} | {"A": 0.5, "k": natural}
    made = form.functions[0]
    found = value_at(form, made, tuple(given[argument.name] for argument in made.arguments))
    exact = series.expression().subs(values).subs(sympy.Symbol("A", real=True), sympy.Rational(1, 2))
    assert found == pytest.approx(float(exact), rel=2e-15)
