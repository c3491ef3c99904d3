"""Equilibria given as algebraic numbers, or near by a decimal."""

from __future__ import annotations

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.description import from_text

LENNARD_JONES = "u'' + 24*(1/(1 + u)**7 - 2/(1 + u)**13) = 0"


def test_a_lennard_jones_well_is_expanded_about_its_minimum() -> None:
    """V = 4 (r^-12 - r^-6) has k^2 = V'' = 36 * 2^(2/3) at r = 2^(1/6)."""
    own = from_text(LENNARD_JONES, about="2^(1/6) - 1")
    series = lindstedt(own, 4)
    assert sympy.expand(own.natural_frequency**2 - 36 * sympy.Integer(2) ** sympy.Rational(2, 3)) == 0
    checks = certify(own, series)
    assert all(check.passed is not False for check in checks)
    assert sum(check.passed is True for check in checks) >= 3


@pytest.mark.parametrize(
    ("equation", "near", "exact"),
    [
        ("u'' - 2 + u**3 = 0", "1.26", "2**(1/3)"),
        ("u'' - 1 + 10*u - 10*u**2 = 0", "0.1127", "1/2 - sqrt(15)/10"),
        ("u'' - 1 + b*u - 10*u**2 = 0", "0.1127", "1/2 - sqrt(15)/10"),
        ("u'' + u**2 - 1/9 = 0", "0.33", "1/3"),
        ("u'' - u + u**3 = 0", "-0.99", "-1"),
    ],
)
def test_a_decimal_near_an_equilibrium_stands_for_it(equation: str, near: str, exact: str) -> None:
    values = {"b": 10} if "b*u" in equation else {}
    first, second = (from_text(equation, about=place, parameters=values) for place in (near, exact))
    assert lindstedt(first, 4).frequency == lindstedt(second, 4).frequency


@pytest.mark.parametrize(
    ("equation", "about", "words"),
    [
        ("u'' - 2 + u**3 = 0", "1.15", "nearest equilibrium is at 1.25992104989"),
        ("u'' + 1 + u**2 = 0", "0.5", "there is none"),
        ("u'' + sin(u) - 1/2 = 0", "0.52", "no polynomial in u .* give the place exactly"),
    ],
)
def test_what_is_near_nothing_is_refused(equation: str, about: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        from_text(equation, about=about)
