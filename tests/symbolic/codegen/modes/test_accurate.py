"""Mode accurate at low orders, where there is no sum: a single term is within the same bound."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.expansion.energy_integral import energy_integral
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
