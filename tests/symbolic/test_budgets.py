"""A budget that is spent ends in a refusal that says so, or in another way to the same ball; never in a value."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import pytest

from ridgeback.common.errors import InputError
from ridgeback.symbolic.cycles import enclose as cycle_enclosure
from ridgeback.symbolic.cycles import passage, search, taylor_step
from ridgeback.symbolic.cycles.found import limit_cycles
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure import analytic_strip, ball_integral, half_wells, walk
from ridgeback.symbolic.enclosure.enclosure import Enclosure
from ridgeback.symbolic.flow import fixed_points, reconstruction, transient
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.high_order import in_balls
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

VDP_FLOW = multiple_scales(find("van-der-pol"), 6, weight=1)
UNDECIDED = "cannot decide here"
UNPROVED = "no proof of a limit cycle"


def at(equation: str, amplitude: str | int) -> Callable[[], Enclosure]:
    """Enclose the frequency of an equation."""
    return lambda: exact_frequency(Oscillator.from_equation(equation), amplitude, bits=64)


KINKED = at("u'' + sin(u) + u*abs(u)/10 = 0", 3)
SLANTED = at("u'' + u + u*abs(u) + u**2/2 = 0", 3)
REVERSIBLE = at("u'' + u*u'**4 + u = 0", 1)
OWN = at("u'' + u + u**5 + exp(u) - 1 = 0", 1)
INTEGRATED = at("u'' + sin(u)*exp(u)/(1 + u**2) = 0", "1/2")


def proved() -> object:
    """Enclose the limit cycle of van der Pol's oscillator at eps = 1."""
    return cycle_enclosure.enclose_cycle(U - (1 - U**2) * V, 2.00862, unit=1.0, bits=64)


def found() -> object:
    """Look for the limit cycle of van der Pol's oscillator at eps = 1."""
    return limit_cycles(Oscillator.from_equation("u'' - (1 - u**2)*u' + u = 0"))


def settling() -> object:
    """Follow van der Pol's slow flow up to its cycle."""
    return transient.transient(VDP_FLOW, [0.0, 40.0], [0.1], amplitude=0.5)


def started() -> object:
    """Find the amplitude and phase of a state."""
    return reconstruction.Reconstruction(VDP_FLOW).start(1.0, 0.5, 0.1)


@pytest.mark.parametrize(
    ("module", "budget", "least", "call", "words"),
    [
        (half_wells, "MAX_STEPS", 1, KINKED, UNDECIDED),
        (half_wells, "FINEST", 0, KINKED, UNDECIDED),
        (half_wells, "MAX_EVALUATIONS", 1, KINKED, UNDECIDED),
        (half_wells, "MOST_STRIDES", 0, SLANTED, "does not rise as high on the other side"),
        (walk, "MAX_REFINEMENTS", 0, OWN, UNDECIDED),
        (walk, "MAX_STEPS", 1, OWN, UNDECIDED),
        (ball_integral, "MOST_HALVINGS", 0, INTEGRATED, UNDECIDED),
        (ball_integral, "MOST_PIECES", 0, INTEGRATED, UNDECIDED),
        (passage, "MOST_STEPS", 1, REVERSIBLE, UNDECIDED),
        (taylor_step, "TRIES", 0, REVERSIBLE, UNDECIDED),
        (cycle_enclosure, "MOST_BITS", 1, proved, UNPROVED),
        (
            in_balls,
            "ATTEMPTS",
            0,
            lambda: in_balls.lindstedt_in_balls(find("duffing"), 6, digits=20),
            "do not give 20 digits",
        ),
        (search, "MOST_STEPS", 1, found, "not followed to its turning point"),
        (transient, "MOST_STEPS", 1, settling, "takes more than 1 steps"),
        (reconstruction, "MOST_ITERATIONS", 1, started, "start closer to rest"),
    ],
)
def test_a_spent_budget_is_a_refusal(
    monkeypatch: pytest.MonkeyPatch, module: ModuleType, budget: str, least: int, call: Callable[[], object], words: str
) -> None:
    monkeypatch.setattr(module, budget, least)
    with pytest.raises(InputError, match=words) as refused:
        call()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("module", "budget", "least", "call"),
    [
        (analytic_strip, "MAX_BOXES", 1, OWN),
        (analytic_strip, "WIDTHS", (), OWN),
    ],
)
def test_another_way_leads_to_the_same_ball(
    monkeypatch: pytest.MonkeyPatch, module: ModuleType, budget: str, least: object, call: Callable[[], Enclosure]
) -> None:
    usual = call().omega
    monkeypatch.setattr(module, budget, least)
    assert call().omega.overlaps(usual)


def test_a_zero_that_cannot_be_followed_has_no_series_but_is_enclosed(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = fixed_points.fixed_points(VDP_FLOW, {"eps": "1/10"})[0]
    monkeypatch.setattr(fixed_points, "MOST_STEPS", 0)
    lone = fixed_points.fixed_points(VDP_FLOW, {"eps": "1/10"})[0]
    assert (whole.square_series is None, lone.square_series) == (False, None)
    assert lone.amplitude.overlaps(whole.amplitude)
