"""How often the 95 % interval of each method holds the truth, over seeded trials; run it with pytest and -s.

Each trial has noise of its own; the share is over the valid samples of all trials of a row.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from ridgeback.numeric.estimators.estimate import METHODS, estimate
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, pendulum
from ridgeback.numeric.motion.trajectory import integrate

RATE, SECONDS, TRIALS = 32.0, 20.0, 6
DECIBELS = (10.0, 20.0, 30.0, 40.0)
Truth = Callable[[np.ndarray], np.ndarray]


def decay(oscillator: Dynamics, start: float) -> tuple[np.ndarray, Truth]:
    """The decay of an oscillator at rest, and its cycle frequency."""
    run = integrate(oscillator, (start, 0.0), duration=SECONDS, rate=RATE)
    return run.u, cycle_frequency(run, dynamics=oscillator).at


def chirp() -> tuple[np.ndarray, Truth]:
    """A chirp that swings by a fifth."""
    t = np.arange(int(RATE * SECONDS) + 1) / RATE
    phase = 2 * np.pi * (1.0 * t + 0.36 * np.sin(0.5 * t) + 0.01 * t * t)
    return np.cos(phase), lambda at: 2 * np.pi * (1.0 + 0.18 * np.cos(0.5 * at) + 0.02 * at)


SIGNALS: dict[str, Callable[[], tuple[np.ndarray, Truth]]] = {
    "pendulum": lambda: decay(pendulum(k=4 * np.pi, mu=0.01), 0.95 * np.pi),
    "chirp": chirp,
    "duffing": lambda: decay(duffing(k=2 * np.pi, eps=10.0, mu=0.05), 2.0),
}


def share(x: np.ndarray, truth: Truth, method: str, decibel: float, seed: int) -> float:
    """Share of the valid samples of one trial whose interval holds the truth; NaN where the method claims none."""
    power = float(np.mean((x - x.mean()) ** 2))
    noise = np.random.default_rng(seed).normal(size=x.size)
    track = estimate(x + np.sqrt(power / 10 ** (decibel / 10)) * noise, RATE, method=method).inside()
    if track.interval is None:
        return float("nan")
    true = truth(track.time)
    return float(np.mean(track.interval.holds(true)[np.isfinite(true)]))


def mean_of_claims(shares: list[float]) -> float:
    """The mean without the NaN, NaN when nothing else is there."""
    claimed = [value for value in shares if np.isfinite(value)]
    return float(np.mean(claimed)) if claimed else float("nan")


@pytest.mark.parametrize("method", METHODS[1:])
def test_coverage(method: str) -> None:
    found, first = [], 100_000 * METHODS.index(method)
    for i, (name, make) in enumerate(SIGNALS.items()):
        x, truth = make()
        row = [
            mean_of_claims([share(x, truth, method, d, first + 10_000 * i + 1000 * j + k) for k in range(TRIALS)])
            for j, d in enumerate(DECIBELS)
        ]
        print(f"| {method} | {name} | " + " | ".join(f"{100 * value:.0f}" for value in row) + " |")
        found += row
    assert 0.9 < mean_of_claims(found) < 0.99
