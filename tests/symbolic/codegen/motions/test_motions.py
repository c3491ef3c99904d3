"""Code of every oscillator of the catalogue, with its motion, its slow flow and its transient."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
import sympy

from ridgeback.compare.binding.generated_code import check, tool_of
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.program import Form, Function
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import undamped
from ridgeback.symbolic.flow.transient import transient
from ridgeback.symbolic.systems.catalogue import catalogue, find
from ridgeback.symbolic.systems.oscillator import Oscillator

CLASSICAL = 12  # of the catalogue: the classical oscillators and their damped twins

SYSTEMS = sorted(entry.name for entry in catalogue()[:CLASSICAL])


def function(form: Form, name: str) -> Function:
    return next(f for f in form.functions if f.name == name)


def displacement(expansion: Expansion, t: float, amplitude: float) -> float:
    """u(t) by summing the harmonics in floats, the slow obvious twin."""
    x = sympy.Symbol(expansion.variable, real=True)
    omega = float(expansion.expression().subs(x, amplitude))
    total = 0.0
    for h in expansion.harmonics:
        c, s = (float(sum(v * amplitude**n for n, v in enumerate(part))) for part in (h.cosine, h.sine))
        total += c * math.cos(h.multiple * omega * t) + s * math.sin(h.multiple * omega * t)
    return total


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_motion_is_the_sum_of_its_harmonics(system: str) -> None:
    expansion = lindstedt(undamped(find(system)), 4)
    form = form_of(expansion, motion=True)
    motion = function(form, "motion")
    k = float(expansion.scale)
    for t in (0.0, 0.4, -7.3, 61.0):
        found = value_at(form, motion, (t, 0.3, k))
        assert found == pytest.approx(displacement(expansion, t, 0.3), rel=1e-13, abs=1e-13)


def test_the_whole_catalogue_compiles_in_one_file() -> None:
    """Series, motions and slow flows of all of them, in C and JavaScript, without a warning and bit for bit."""
    functions: list[Function] = []
    for system in SYSTEMS:
        tail = system.replace("-", "_")
        forms = [form_of(lindstedt(undamped(find(system)), 3), motion=True), form_of(multiple_scales(find(system), 3))]
        for kind, form in zip(("series", "flow"), forms, strict=True):
            functions += [replace(f, name=f"{f.name}_{kind}_{tail}") for f in form.functions]
    whole = replace(form, functions=tuple(functions), name="catalogue")
    for language in ("c", "javascript"):
        if tool_of(language) is not None:
            found = check(whole, language)
            assert found.state == "passed", found


def test_a_motion_keeps_symbolic_parameters_as_arguments() -> None:
    own = Oscillator.from_equation("u'' + w**2*u + b*u**2 + c*u**3 = 0")
    numbers = {"w": sympy.Rational(3, 2), "b": sympy.Rational(1, 4), "c": sympy.Rational(-1, 8)}
    form = form_of(lindstedt(own, 4), motion=True)
    motion = function(form, "motion")
    names = [a.name for a in motion.arguments]
    assert names == ["t", "A", "b", "c", "k"]
    given = {"t": 2.5, "A": 0.2, "b": 0.25, "c": -0.125, "k": 1.5}
    exact = lindstedt(own.with_parameters(numbers), 4)
    found = value_at(form, motion, tuple(given[name] for name in names))
    assert found == pytest.approx(displacement(exact, 2.5, 0.2), rel=1e-13)


def test_the_right_hand_side_of_a_slow_flow() -> None:
    form = form_of(multiple_scales(find("damped-pendulum"), 6))
    at = (0.7, 0.02, 1.0)
    growth, rate = (value_at(form, function(form, name), at) for name in ("growth_rate", "amplitude_rate"))
    assert rate == pytest.approx(0.7 * growth, rel=1e-15)


@pytest.mark.parametrize(("system", "small", "start"), [("damped-pendulum", 0.02, 1.2), ("van-der-pol", 0.1, 0.7)])
def test_steps_make_the_transient(system: str, small: float, start: float) -> None:
    """Against the closed form, or the Taylor series in time, of the same slow flow; of order 4 in the step."""
    flow = multiple_scales(find(system), 4)
    form, end = form_of(flow), 60.0
    exact = transient(flow, [0.0, end], [small], amplitude=start, phase=0.0)
    errors = []
    for count in (40, 80):
        a, phi, h = start, 0.0, end / count
        for _ in range(count):
            phi += value_at(form, function(form, "phase_after"), (a, h, small, 1.0))
            a = value_at(form, function(form, "amplitude_after"), (a, h, small, 1.0))
        errors.append((abs(a - exact.amplitude[-1]), abs(phi - exact.phase[-1])))
    assert errors[1][0] < 1e-6
    assert errors[1][1] < 1e-6
    assert all(fine < max(coarse / 12, 1e-10) for fine, coarse in zip(errors[1], errors[0], strict=True))
