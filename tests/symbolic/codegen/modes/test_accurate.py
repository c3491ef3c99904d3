"""Mode accurate at low orders, where there is no sum: a single term is within the same bound."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import pytest

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.proofs.bounds import bound
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("order", [0, 1, 2, 3])
@pytest.mark.parametrize(("equation", "slopes"), [("u**3/7", (0, "3/28")), ("sin(u) - u", (0, "-1/8"))])
def test_a_single_term_is_rounded_once(equation: str, slopes: tuple[int, str], order: int) -> None:
    oscillator = Oscillator.from_equation(f"u'' + u + {equation} = 0")
    form = form_of(energy_integral(oscillator, order), up_to=1, mode="accurate")
    slope = Fraction(slopes[order > 1])
    for i in range(100):
        x = Fraction((i + 0.37) / 100)
        for function, exact in zip(form.functions, (1 + slope / 2 * x**2, slope * x), strict=True):
            value = value_at(form, function, (float(x), 1.0))
            assert abs(Fraction(value) - exact) <= Fraction(51, 100) * Fraction(math.ulp(float(exact)))


def test_an_irrational_coefficient_is_carried_to_twice_the_digits() -> None:
    """omega0 = c A of u'' + u^3 = 0, c = 0.847...; without what rounding cuts off c it would err by up to a unit."""
    oscillator = find("cubic")
    form = form_of(energy_on_each_side(oscillator, 2), up_to=1, mode="accurate")
    found = bound(form, form.functions[0])
    assert found is not None
    assert found.ulps is not None
    assert found.ulps <= Fraction(51, 100)
    with mpmath.workdps(60):
        c = mpmath.gamma(mpmath.mpf(3) / 4) ** 2 / mpmath.sqrt(mpmath.pi)
        for x in (0.1, 0.37, 0.99, 1.0, 3e-200):
            exact = c * mpmath.mpf(x)
            assert abs(value_at(form, form.functions[0], (x,)) - exact) <= 0.51 * math.ulp(float(exact))


def test_what_has_no_range_says_that_nothing_is_proved() -> None:
    form = form_of(lindstedt(find("bubble"), 4), mode="accurate")
    assert any("no bound is proved, as no range" in note for note in form.functions[0].notes)
    with pytest.raises(InputError, match="polynomials in one variable, and omega0 is none; use strict"):
        form_of(energy_on_each_side(find("quadratic"), 2), mode="accurate")  # in the square root of A
