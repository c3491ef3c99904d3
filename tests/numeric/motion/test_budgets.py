"""A budget of an integration that is spent ends in a refusal that says so."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion import bilinear_motion, closed_orbit, integration, taylor
from ridgeback.numeric.motion.bilinear import Bilinear
from ridgeback.numeric.motion.dynamics import duffing, pendulum
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits import action_loss

DAMPED = pendulum(1.0, 0.01)


@pytest.mark.parametrize(
    ("module", "budget", "least", "call", "words"),
    [
        (
            integration,
            "MAX_EVALUATIONS",
            9,
            lambda: integrate(DAMPED, (1.0, 0.0), duration=1.0, rate=9.0, method="DOP853"),
            "pendulum: more than 9 evaluations by DOP853",
        ),
        (
            bilinear_motion,
            "MAX_PIECES",
            1,
            lambda: bilinear_motion.bilinear_motion(Bilinear(1.0, 2.0, 0.5), (1.0, 0.0), duration=9.0, rate=9.0),
            "more than 1 switches before t = ",
        ),
        (
            closed_orbit,
            "DURATIONS",
            (0.1,),
            lambda: closed_orbit.closed_orbit(duffing(eps=1.0), 1.0),
            "does not come back",
        ),
        (
            taylor,
            "MEMORY_BUDGET",
            1,
            lambda: taylor.taylor_solution(DAMPED, (1.0, 0.0), duration=1.0, digits=20),
            "use fewer digits or duration",
        ),
        (
            action_loss,
            "NODES",
            (3,),
            lambda: action_loss.averaged_action(DAMPED, 1.0, np.linspace(0.0, 10.0, 9)),
            "changes too fast with amplitude",
        ),
    ],
)
def test_a_spent_budget_is_a_refusal(
    monkeypatch: pytest.MonkeyPatch,
    module: ModuleType,
    budget: str,
    least: object,
    call: Callable[[], object],
    words: str,
) -> None:
    monkeypatch.setattr(module, budget, least)
    with pytest.raises(InputError, match=words) as refused:
        call()
    assert "\n" not in str(refused.value)


def test_a_budget_that_is_just_enough_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    def evaluations() -> int:
        return integrate(DAMPED, (1.0, 0.0), duration=1.0, rate=9.0, method="DOP853").evaluations

    needed = evaluations()
    monkeypatch.setattr(integration, "MAX_EVALUATIONS", needed)
    assert evaluations() == needed
    monkeypatch.setattr(integration, "MAX_EVALUATIONS", needed - 1)
    with pytest.raises(InputError, match=f"more than {needed - 1} evaluations"):
        evaluations()


def test_a_degree_that_follows_no_acceleration_is_refused() -> None:
    with pytest.raises(InputError, match="degree = 1 is too low for a second-order equation"):
        taylor.taylor_solution(DAMPED, (1.0, 0.0), duration=1.0, digits=20, degree=1)
