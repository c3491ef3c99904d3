"""Irrational numbers in an equation: exact coefficients, held against the same equation in decimals."""

from __future__ import annotations

import pytest
import sympy

from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.description import from_text
from ridgeback.symbolic.systems.natural_units import in_natural_units
from ridgeback.symbolic.systems.oscillator import Oscillator, U

DIGITS = 40
CASES = (
    ("u'' - 2*u + u**3 = 0", "sqrt(2)"),
    ("u'' + sqrt(2)*u + u**3 = 0", "0"),
    ("u'' + sin(u) - 1/2 = 0", "pi/6"),
    ("u'' + exp(u) - 2 = 0", "log(2)"),
    ("u'' + sqrt(3)*u + pi*u**2 - u**3/sqrt(2) = 0", "0"),
    ("u'' - 3*u + u**2 = 0", "3"),
)


def in_decimals(oscillator: Oscillator) -> Oscillator:
    """The Taylor polynomial of the force at rest, each coefficient rounded to DIGITS digits."""
    terms = []
    for n in range(1, 7):
        c = oscillator.force.diff(U, n).subs(U, 0) / sympy.factorial(n)
        terms.append(f"({sympy.Rational(str(sympy.N(c, DIGITS)))})*u**{n}")
    return Oscillator.from_equation("u'' + " + " + ".join(terms) + " = 0")


@pytest.mark.parametrize(("equation", "about"), CASES)
def test_exact_coefficients_are_those_of_the_decimals(equation: str, about: str) -> None:
    oscillator = from_text(equation, about=about)
    exact, near = lindstedt(oscillator, 5), energy_integral(in_decimals(oscillator), 5)
    for mine, other in zip(exact.frequency, near.frequency, strict=True):
        assert abs(sympy.N(mine - other, DIGITS)) < 1e-30
    assert not any(symbol.name.endswith("*") for c in exact.frequency for symbol in c.free_symbols)
    assert all(check.passed is not False for check in certify(oscillator, exact))
    assert not exact.residual()


def test_asymmetric_well_by_hand() -> None:
    """w'' + 4 w + 3 sqrt(2) w^2 + w^3: 2 (3/32 - 5/12 (3 sqrt(2)/4)^2) = -3/4 (Nayfeh and Mook, 1979, 2.3)."""
    assert lindstedt(from_text("u'' - 2*u + u**3 = 0", about="sqrt(2)"), 2).frequency == (2, 0, sympy.Rational(-3, 4))


def test_numbers_that_must_cancel_are_not_taken_for_parameters() -> None:
    force = U * (sympy.sqrt(2) + sympy.sqrt(3)) ** 2 / (5 + 2 * sympy.sqrt(6)) + U**3
    found = in_natural_units(force, sympy.S.One)
    assert sympy.expand(found.force) == U + U**3


def test_functions_without_a_number_in_their_sum_are_left_closed() -> None:
    """Opening sinh of 27 u' or so would never end."""
    own = Oscillator.from_equation("u'' + 2*u + u**3 + asinh(sinh(u'**27)**9) = 0")
    assert list(own.normalised.constants.values()) == [sympy.sqrt(2)]


def test_high_powers_of_functions_are_not_multiplied_out() -> None:
    """tanh(asinh(z)) is z/sqrt(1 + z^2), and the 21st power of that beside 1/pi had millions of terms."""
    own = Oscillator.from_equation("u'' + 2*u + ((tanh(asinh(tanh(u)/pi + u))/pi + u)**7)**3 = 0")
    assert lindstedt(own, 4).frequency == (sympy.sqrt(2), 0, 0, 0, 0)
