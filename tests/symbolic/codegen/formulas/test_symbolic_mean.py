"""The closed form with parameters as arguments: the enclosed frequency at any values of them."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.formulas.symbolic_mean import closed_form
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.systems.oscillator import Oscillator

CUBIC = Oscillator.from_equation("m*u'' + k*u + k3*u**3 = 0")
SINE = Oscillator.from_equation("L*u'' + g*sin(2*u) = 0")


@pytest.mark.parametrize(
    ("oscillator", "values", "amplitudes"),
    [
        (CUBIC, {"k": "29/4", "k3": "1/2", "m": "5/2"}, ("1.3", "100")),
        (CUBIC, {"k": "29/4", "k3": "-1/2", "m": "5/2"}, ("1.3", "3.8")),
        (SINE, {"L": "1/2", "g": "39/4"}, ("0.25", "1.5")),
    ],
)
def test_it_is_the_exact_frequency(oscillator: Oscillator, values: dict[str, str], amplitudes: tuple[str, ...]) -> None:
    form = form_of(closed_form(oscillator), up_to=None if oscillator is CUBIC else Fraction(31, 20))
    omega, slope = form.functions
    assert [a.name for a in omega.arguments] == ["A", *values]
    given = [float(Fraction(v)) for v in values.values()]
    for text in amplitudes:
        x = float(Fraction(text))
        exact = enclose(oscillator.with_parameters(values), Fraction(text)).omega
        assert math.isclose(value_at(form, omega, (x, *given)), float(exact), rel_tol=1e-13)
        h = x * 2.0**-20
        near = (value_at(form, omega, (x + h, *given)) - value_at(form, omega, (x - h, *given))) / (2 * h)
        assert math.isclose(value_at(form, slope, (x, *given)), near, rel_tol=1e-5)


def test_there_is_none_beyond_the_separatrix_and_of_other_forces() -> None:
    form = form_of(closed_form(CUBIC))
    assert math.isnan(value_at(form, form.functions[0], (4.0, 7.25, -0.5, 2.5)))
    with pytest.raises(InputError, match=r"--up-to below 1\.5708"):
        form_of(closed_form(SINE))
    with pytest.raises(InputError, match="neither c sin"):
        closed_form(Oscillator.from_equation("u'' + u + c*u**2 = 0"))
