"""Transients in closed form and by Taylor steps."""

import math

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.transient import PHASE, START, TIME, closed_form, transient
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.flow.own import R, a, make, symbol

CLOSED = {
    "linear decay": ("u'' + c*u' + u + u**3", 2, 2),
    "linear decay of small weight": ("u'' + c*u' + u + u**3", 4, 4),
    "decay that depends on the amplitude": ("u'' + 2*mu*u' + sin(u)", 4, 2),
    "van der Pol": ("u'' - eps*(1 - u**2)*u' + u + u**3", 3, 1),
    "cubic damping alone": ("u'' + eps*u'**3 + u + u**3", 4, 2),
    "conservative": ("u'' + u + u**3", 6, 2),
}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_forms_solve_the_slow_flow_and_meet_the_taylor_steps(name: str) -> None:
    equation, order, weight = CLOSED[name]
    flow = multiple_scales(make(equation), order, weight=weight)
    found = closed_form(flow)
    assert found is not None
    small = {symbol(n): R(1, 10) for n in flow.small_parameters}
    numbers = {START: R(4, 5), PHASE: R(1, 3), **small}
    amplitude, phase = found.amplitude.subs(numbers), found.phase.subs(numbers)
    for t in (R(0), R(3), R(17, 2)):
        now = {a: amplitude.subs(TIME, t), **small}
        rate = (flow.growth_rate_expression() * a).subs(now), flow.frequency_expression().subs(now)
        assert abs((amplitude.diff(TIME).subs(TIME, t) - rate[0]).evalf(40)) < 1e-35
        assert abs((phase.diff(TIME).subs(TIME, t) - rate[1]).evalf(40)) < 1e-35
    assert (amplitude.subs(TIME, 0), sympy.simplify(phase.subs(TIME, 0))) == (R(4, 5), R(1, 3))
    for part, first in ((0.1, 0.8), (1e-6, 0.03)):  # weak damping takes its time and is no smaller against the rest
        numbers = {START: R(first), PHASE: R(1, 3), **{symbol(n): R(part) for n in flow.small_parameters}}
        times = [0.0, *(t * 0.1 / part for t in (3.0, 8.5, 50.0, 600.0))]
        steps = transient(flow, times, [part] * len(small), amplitude=first, phase=1 / 3)
        for t, size, angle in zip(times, steps.amplitude, steps.phase, strict=True):
            now = {**numbers, TIME: R(t)}
            assert size == pytest.approx(float(found.amplitude.subs(now).evalf(30)), rel=1e-11)
            assert angle == pytest.approx(float(found.phase.subs(now).evalf(30)), rel=1e-12, abs=1e-11)
    assert all(text.startswith(start) for text, start in zip(found.latex(), ("a(t) =", r"\varphi(t) ="), strict=True))


def test_a_flow_of_higher_degree_has_no_closed_form_but_steps() -> None:
    flow = multiple_scales(find("damped-duffing"), 8)
    assert closed_form(flow) is None
    coarse = transient(flow, [0.0, 20.0], [0.05], amplitude=0.6)
    fine = transient(flow, [0.05 * n for n in range(401)], [0.05], amplitude=0.6)
    assert coarse.amplitude[1] == pytest.approx(fine.amplitude[-1], rel=1e-12)
    assert coarse.phase[1] == pytest.approx(fine.phase[-1], abs=1e-11)


@pytest.mark.parametrize("eps", [-1e-6, -0.1, 0.1, 1e-6])
@pytest.mark.parametrize("start", [0.01, 0.5, 1.99])
def test_a_transient_of_any_speed_is_bernoullis(eps: float, start: float) -> None:
    """a' = eps a (1 - a^2/4)/2: a^2/(4 - a^2) grows as exp(eps t), at rest and next to the cycle as well."""
    flow, time = multiple_scales(find("van-der-pol"), 4), 2 / abs(eps)
    found = transient(flow, [0.0, time], [eps], amplitude=start)
    grown = start**2 / (4 - start**2) * math.exp(eps * time)
    assert found.amplitude[1] == pytest.approx(math.sqrt(4 * grown / (1 + grown)), rel=1e-11)
    assert found.phase[1] == pytest.approx((1 - eps**2 / 8) * time, rel=1e-11)


def test_without_damping_a_transient_keeps_its_amplitude() -> None:
    found = transient(multiple_scales(find("damped-pendulum"), 2), [0.0, 10.0], [0.0], amplitude=0.5)
    assert found.amplitude == (0.5, 0.5)
    assert found.phase[1] == pytest.approx(10.0 * (1 - 0.5**2 / 16), rel=1e-15)


def test_the_time_said_to_fit_fits_and_is_not_far_from_the_last_one() -> None:
    flow, most = multiple_scales(make("u'' + sin(u)"), 2), 2.0**52 * 1e-6
    with pytest.raises(InputError, match="too large for its cosine") as refused:
        transient(flow, [0.0, 1e9, 1e10], [], amplitude=0.1)
    fits = float(str(refused.value).split("t = ")[2].split()[0])
    found = transient(flow, [0.0, 1e9, fits], [], amplitude=0.1)
    assert 0.85 * most < found.phase[-1] <= most


def test_bad_transients_are_refused() -> None:
    flow = multiple_scales(make("u'' + u + u'**3 - u'**5 = 0"), 4)
    with pytest.raises(InputError, match="runs away"):
        transient(flow, [0.0, 1e6], [], amplitude=2.0)
    with pytest.raises(InputError, match="rise"):
        transient(flow, [1.0, 0.0], [], amplitude=0.1)
    with pytest.raises(InputError, match="finite"):
        transient(flow, [0.0, math.inf], [], amplitude=0.1)
    with pytest.raises(InputError, match="not a positive number"):
        transient(flow, [0.0, 1.0], [], amplitude=-1.0)
