"""Derivatives of closed forms and quotients: those of the formula itself, to the last few digits."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, arb_series, ctx

from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.formulas.closed_forms import mean_form, sine_series
from ridgeback.symbolic.codegen.program import Form
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.systems.catalogue import find


def mean(a: arb_series, b: arb_series) -> arb_series:
    for _ in range(9):
        a, b = (a + b) / 2, (a * b).sqrt()
    return a


def exact(system: str, x: float) -> arb:
    """The derivative of the arithmetic-geometric mean by power series in balls."""
    with ctx.workprec(200):
        amplitude, one = arb_series([arb(x), 1], 2), arb_series([1], 2)
        if system == "pendulum":
            return mean(one, (amplitude / 2).cos())[1]
        square = amplitude * amplitude
        return mean((one + square).sqrt(), (one + square * arb(0.5)).sqrt())[1]


@pytest.mark.parametrize("system", ["pendulum", "duffing"])
@pytest.mark.parametrize("mode", ["strict", "fma"])
def test_the_slope_of_the_closed_form(system: str, mode: str) -> None:
    form = form_of(mean_form(find(system)), up_to=Fraction(3), mode=mode)  # type: ignore[arg-type]
    for x in (0.0, 2.0**-20, 0.5, -1.0, 2.5, 3.0):
        with ctx.workprec(200):
            error = abs(arb(value_at(form, form.functions[1], (x, 1.0))) - exact(system, x))
        assert float(error.upper()) <= 1e-14


def forms() -> dict[str, Form]:
    pendulum, end = find("pendulum"), Fraction(2)
    series = lindstedt(pendulum, 16)
    made = {"sine": sine_series(pendulum, 300), "nome": nome(pendulum, 24)}
    made |= {kind: resum(pendulum, series, kind, up_to=end) for kind in ("pade", "map")}
    return {name: form_of(formula, up_to=end) for name, formula in made.items()}


def test_slopes_of_resummations_are_those_of_their_values() -> None:
    """By central differences of the code of omega0 itself, whose rounding leaves seven digits."""
    for name, form in forms().items():
        omega, slope = form.functions
        for x in (0.25, 1.0, -1.5):
            h = 2.0**-18
            near = (value_at(form, omega, (x + h, 1.0)) - value_at(form, omega, (x - h, 1.0))) / (2 * h)
            assert abs(value_at(form, slope, (x, 1.0)) - near) < 1e-8, (name, x)
        assert value_at(form, slope, (0.0, 1.0)) == 0
