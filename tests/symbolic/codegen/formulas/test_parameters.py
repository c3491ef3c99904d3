"""Code of results with symbolic parameters, rational powers and averaged losses: the value of the exact expression."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq
from sympy import Expr, Rational, Symbol

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import form_of, generate
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.number import FLOAT32, FLOAT64, Number, Real
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Operation, Step
from ridgeback.symbolic.codegen.proofs.analysis import Computed, any_root
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.reconstruction import PHI, Reconstruction
from ridgeback.symbolic.flow.term import LossTerm
from ridgeback.symbolic.systems.oscillator import Oscillator

VALUES = {"m": 2.5, "k": 7.25, "k3": -0.75, "k5": 0.5, "c": 0.0625, "w": 1.75, "a2": 0.5, "mu": 0.03125, "L": 0.5}
VALUES |= {"g": 9.75, "A": 0.625, "a": 0.625, "phi": 1.375, "F": 0.0625, "d": 0.375, "eps": 0.25}


def named(form: Form, name: str) -> Function:
    return next(f for f in form.functions if f.name == name)


def computed(form: Form, name: str) -> float:
    """The value of a function, each argument by its name in the equation."""
    function = named(form, name)
    own = any("a parameter" in a.meaning for a in function.arguments if a.name == "k")
    natural = {} if own else {"k": VALUES["w"]}
    at = ({**VALUES, **natural}[a.name.rstrip("_")] if a.default is None else a.default for a in function.arguments)
    return value_at(form, function, tuple(at))


def exact(expression: Expr) -> float:
    values = {s: Rational(*VALUES[s.name].as_integer_ratio()) for s in expression.free_symbols}
    return float(expression.xreplace(values).evalf(40))


EQUATIONS = (
    "m*u'' + k*u + k3*u**3 = 0",
    "m*u'' + k*u + k3*u**3 + k5*u**5 = 0",
    "u'' + w**2*u + a2*u**2 = 0",
    "L*u'' + g*sin(u) = 0",
    "u'' + sin(u) + w**2*u = 0",
    "m*u'' + k*u*(1 + k3*u**2)/(1 + a2*u**2) = 0",
)


@pytest.mark.parametrize("equation", EQUATIONS)
def test_a_series_with_symbols_is_its_expression(equation: str) -> None:
    series = lindstedt(Oscillator.from_equation(equation), 5)
    form, A = form_of(series, motion=True), Symbol("A", real=True)
    assert math.isclose(computed(form, "omega0"), exact(series.expression()), rel_tol=1e-14)
    assert math.isclose(computed(form, "omega0_slope"), exact(series.expression().diff(A)), rel_tol=1e-13)
    third = next(h for h in series.harmonics if h.multiple == 3)
    wanted = sum((c * A**n for n, c in enumerate(third.cosine)), sympy.S.Zero)
    assert math.isclose(computed(form, "cosine_3"), exact(wanted), rel_tol=1e-13)
    assert "None" not in generate(series, "c")


def test_parameters_keep_their_names_where_the_frequency_is_an_expression() -> None:
    form = form_of(lindstedt(Oscillator.from_equation(EQUATIONS[0]), 2))
    assert [a.name for a in form.functions[0].arguments] == ["A", "k3", "k", "m"]
    formula = generate(lindstedt(Oscillator.from_equation(EQUATIONS[0]), 2), "latex")
    assert r"\sqrt{\frac{k}{m}}" in formula


FLOWS = (
    "m*u'' + c*u' + k*u + k3*u**3 = 0",
    "u'' + 2*mu*u' + 2*u + u'**3 = 0",
    "u'' + 2*mu*u' + w**2*u + a2*u**2 = 0",
    "u'' - eps*(1 - u**2)*u' + u = 0",
    "u'' + 2*mu*u' + u + k3*u**3 = 0",
)


@pytest.mark.parametrize("equation", FLOWS)
def test_a_slow_flow_and_its_motion_are_their_expressions(equation: str) -> None:
    flow = multiple_scales(Oscillator.from_equation(equation), 4)
    form, wave = form_of(flow, motion=True), Reconstruction(flow)
    a = Symbol("a", real=True)
    wanted = {"omega0": flow.frequency_expression(), "growth_rate": flow.growth_rate_expression()}
    wanted |= {"amplitude_rate": a * wanted["growth_rate"], "motion": wave.expression()}
    for name, expression in wanted.items():
        assert math.isclose(computed(form, name), exact(expression), rel_tol=1e-13), name
    assert str(PHI) == "phi"


POWERS = (
    "u'' + u**3 = 0",
    "u'' + sign(u) = 0",
    "u'' + u**(1/3) = 0",
    "u'' + u*abs(u) = 0",
    "m*u'' + c*u**3 + d*u**5 = 0",
    "u'' + u + c*abs(u)**(1/3)*sign(u) = 0",
)


@pytest.mark.parametrize("equation", POWERS)
def test_rational_powers_of_the_amplitude(equation: str) -> None:
    series = energy_on_each_side(Oscillator.from_equation(equation), 2)
    form, A = form_of(series), Symbol("A", real=True)
    assert math.isclose(computed(form, "omega0"), exact(series.expression()), rel_tol=1e-14)
    assert math.isclose(computed(form, "omega0_slope"), exact(series.expression().diff(A)), rel_tol=1e-13)
    function = form.functions[0]
    smallest = (function.domain.low, *(1.0 for _ in function.arguments[1:]))
    assert math.isfinite(value_at(form, form.functions[1], smallest))
    assert math.isnan(value_at(form, function, (-0.5, *smallest[1:])))


LOSSES = (
    "u'' + F*sign(u') + u = 0",
    "u'' + c*abs(u')*u' + F*sign(u') + u + u**3 = 0",
    "m*u'' + c*abs(u')**(1/2)*sign(u') + k*u + k3*u**3 = 0",
)


@pytest.mark.parametrize("equation", LOSSES)
def test_averaged_losses(equation: str) -> None:
    flow = averaged_losses(Oscillator.from_equation(equation), 2)
    form = form_of(flow)
    assert math.isclose(computed(form, "omega0"), exact(flow.frequency_expression()), rel_tol=1e-14)
    assert math.isclose(computed(form, "growth_rate"), exact(flow.growth_rate_expression()), rel_tol=1e-13)


@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
@pytest.mark.parametrize("force", ["u", "sin(u)"])
@pytest.mark.parametrize("given", ["numbers", "one symbol", "symbols"])
def test_code_of_losses_given_in_any_way_is_that_of_the_symbols(given: str, force: str, amplitude: str) -> None:
    """Dry friction, quadratic damping and the force bring terms in the same powers of a."""
    law, values = "u'' + {F}*sign(u') + {c}*abs(u')*u' + {force} = 0", {"F": Fraction(1, 100), "c": Fraction(1, 10)}
    kept = {"numbers": "", "one symbol": "F", "symbols": "Fc"}[given]
    told = {name: name if name in kept else f"({value})" for name, value in values.items()}
    flow = averaged_losses(Oscillator.from_equation(law.format(**told, force=force)), 4, amplitude=amplitude)
    whole = averaged_losses(Oscillator.from_equation(law.format(F="F", c="c", force=force)), 4, amplitude=amplitude)
    code: dict[str, Any] = {}
    exec(generate(flow, "python"), code)  # noqa: S102 - our own text
    small, both = [float(values[name]) for name in flow.losses], [float(value) for value in values.values()]
    for a in (0.5, 1.0, 2.0):
        rates = whole.frequency_at(a, *both), whole.growth_rate_at(a, *both)
        assert (flow.frequency_at(a, *small), flow.growth_rate_at(a, *small)) == pytest.approx(rates, rel=1e-13)
        assert (code["omega0"](a, *small), code["growth_rate"](a, *small)) == pytest.approx(rates, rel=1e-13)


def test_terms_in_the_same_powers_add_up_in_code() -> None:
    flow = averaged_losses(Oscillator.from_equation("u'' + abs(u')*u'/10 + sin(u) = 0"), 4)
    apart = tuple(LossTerm(term.powers, term.coefficient / 2) for term in flow.frequency for _ in range(2))
    form = form_of(replace(flow, phase_terms=apart))
    assert math.isclose(computed(form, "omega0"), exact(flow.frequency_expression()), rel_tol=1e-14)


def test_dry_friction_brings_the_amplitude_to_rest() -> None:
    """a' = -2 F/pi: a(t) = a - 2 F t/pi exactly, and 0 afterwards."""
    form = form_of(averaged_losses(Oscillator.from_equation(LOSSES[0]), 2))
    after = named(form, "amplitude_after")
    assert math.isclose(value_at(form, after, (0.5, 3.0, 0.125)), 0.5 - 0.75 / math.pi, rel_tol=1e-14)
    assert value_at(form, after, (0.5, 30.0, 0.125)) == 0.0


def test_motions_that_no_method_gives_are_refused() -> None:
    with pytest.raises(InputError, match="frequency only"):
        form_of(energy_on_each_side(Oscillator.from_equation(POWERS[0]), 2), motion=True)
    with pytest.raises(InputError, match="no motion"):
        form_of(averaged_losses(Oscillator.from_equation(LOSSES[0]), 2), motion=True)


@pytest.mark.parametrize("real", [FLOAT64, FLOAT32])
@pytest.mark.parametrize("degree", [3, 5, 7, 13, 63])
def test_a_root_is_within_its_bound(degree: int, real: Real) -> None:
    """Over the whole range of the format, against balls."""
    step = Step("y1", Operation.ROOT, ("A", Number(fmpq(degree), real)))
    function = Function("r", "", (Argument("A", ""),), (step,), "y1", Domain("A", 0.0, real.largest))
    form = Form("r", "", (), (function,), real=real)
    low, high = real.low + 2 * real.digits, real.high - 3
    for i in range(61):
        x = Fraction(2) ** (low + (high - low) * i // 60) * (1 + Fraction(37 * i % 61, 64))
        with ctx.workprec(200):
            bound = any_root(Computed(arb(float(x)), arb(0)), degree, real)
            assert abs(arb(value_at(form, function, (float(x),))) - bound.exact) <= bound.error
