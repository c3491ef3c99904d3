"""How often the 95 % intervals of growth rate, amplitude and frequency hold: ``python benchmarks/growth_rate.py``.

Seeded trials of free decays at 20 Hz, 400 samples per second, with white noise: damped oscillations at damping ratios
of 0.3 to 15 %, over 3 to 60 cycles, and quadratic drag beside viscous damping.  A row of the table that it prints is a
kind of record: coverage over the bins of all backbones, the claimed share of the samples whose amplitude is above the
noise, and refusals.  About a second per trial.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.estimators.estimate import estimate

RATE, FREQUENCY, BEND = 400.0, 20.0, 0.05
NORMAL_95 = 1.96


@dataclass(frozen=True)
class Decay:
    """a' = -(linear + quadratic a) a from a(0) = 1, omega = 2 pi FREQUENCY (1 + bend a^2)."""

    linear: float
    quadratic: float = 0.0
    bend: float = 0.0
    seconds: float = 1.0
    noise: float = 0.012

    def amplitude(self, t: Array) -> Array:
        """a(t), by separation of variables."""
        if self.quadratic == 0.0:
            return np.asarray(np.exp(-self.linear * t))
        return self.linear / ((self.linear + self.quadratic) * np.exp(self.linear * t) - self.quadratic)

    def growth_rate(self, a: Array) -> Array:
        """a'/a."""
        return -(self.linear + self.quadratic * a)

    def omega(self, a: Array) -> Array:
        """The frequency, rad/s."""
        return 2 * np.pi * FREQUENCY * (1 + self.bend * a**2)

    def record(self, seed: int) -> Array:
        """The samples of one trial."""
        rng = np.random.default_rng(seed)
        fine = np.arange(16 * int(self.seconds * RATE) + 1) / (16 * RATE)
        w = self.omega(self.amplitude(fine))
        phase = np.concatenate([[0.0], np.cumsum(0.5 * (w[1:] + w[:-1]) / (16 * RATE))])[::16]
        a = self.amplitude(fine[::16])
        return np.asarray(a * np.cos(phase + rng.uniform(0, 2 * np.pi)) + self.noise * rng.normal(size=a.size))


def damped(ratio: float, cycles: float) -> Decay:
    """A plain damped oscillation."""
    return Decay(2 * np.pi * FREQUENCY * ratio, seconds=cycles / FREQUENCY)


LONG = ((0.003, 60.0), (0.01, 60.0), (0.03, 17.0), (0.05, 10.0), (0.1, 5.0))
TAILS = ((0.03, 40.0), (0.1, 40.0))
SHORT = ((0.03, 5.0), (0.05, 4.0), (0.1, 3.0), (0.15, 5.0))
KINDS: dict[str, Decay] = {
    **{f"ratio {100 * z:g} %, {c:g} cycles": damped(z, c) for z, c in (*LONG, *TAILS, *SHORT)},
    "quadratic drag": Decay(0.628, 8.0, BEND, seconds=6.0),
    "quadratic drag, little noise": Decay(0.628, 8.0, BEND, seconds=6.0, noise=0.002),
}


@dataclass(frozen=True)
class Outcome:
    """Deviations over their sigma in one trial: growth rate, frequency, amplitude; and the claimed share of time."""

    growth: Array
    omega: Array
    amplitude: Array
    claimed: float


def trial(decay: Decay, seed: int) -> Outcome:
    """One record, measured as the command does."""
    x = decay.record(seed)
    track = estimate(x, RATE)
    found = backbone(track, x, RATE)
    a = found.curve_amplitude
    t = np.arange(x.size) / RATE
    above = decay.amplitude(t) > decay.noise
    near = np.abs(t[:, None] - found.time).min(axis=1) <= np.median(np.diff(found.time))
    return Outcome(
        (found.curve_growth_rate - decay.growth_rate(a)) / found.curve_growth_rate_sd,
        (found.curve_omega - decay.omega(a)) / found.curve_omega_sd if track.interval is not None else np.zeros(0),
        (found.amplitude - decay.amplitude(found.time)) / found.amplitude_sd,
        float(np.mean(near[above])),
    )


def row(name: str, decay: Decay, trials: int, seed: int) -> str:
    """A row of the table."""
    found, refused = [], 0
    for k in range(trials):
        try:
            found.append(trial(decay, seed + k))
        except InputError:
            refused += 1

    def held(of: Callable[[Outcome], Array]) -> str:
        every = np.concatenate([of(one) for one in found]) if found else np.zeros(0)
        return f"{100 * np.mean(np.abs(every) < NORMAL_95):.0f}" if every.size else "none"

    claimed = f"{100 * np.mean([one.claimed for one in found]):.0f}" if found else "none"
    cells = (held(lambda o: o.growth), held(lambda o: o.amplitude), held(lambda o: o.omega), claimed, str(refused))
    return f"| {name} | {' | '.join(cells)} |"


def main() -> None:
    """Read the options, run, print a row as soon as it is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    sys.stdout.write("| record | a'/a, % | a, % | omega, % | claimed, % | refused |\n|---|---|---|---|---|---|\n")
    for name, decay in KINDS.items():
        sys.stdout.write(row(name, decay, given.trials, given.seed) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
