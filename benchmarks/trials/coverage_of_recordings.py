"""How often the 95 % intervals hold on recordings as people have them.

    python -m benchmarks.trials.coverage_of_recordings

Seeded trials of kinds of record: clean decays, tails, a few cycles, quadratic drag, hum, two modes, a release and a
stop, clipping, spikes, 1/f noise, harmonics, a chirp.  A row of the table that it prints is a kind: the share of the
intervals of growth rate, amplitude and frequency that hold the truth; the share of the samples whose amplitude stands
above the noise for which they are claimed; the trials in which nothing is claimed; and the reason that is given then.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from dataclasses import dataclass

import numpy as np

from benchmarks.trials.records.drawn import DRAWN
from benchmarks.trials.records.fixed import KINDS
from benchmarks.trials.records.motions import Kind
from benchmarks.trials.shares import written
from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import measure
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import NORMAL_95


@dataclass(frozen=True)
class Outcome:
    """Whether intervals hold in one trial: growth rate, amplitude, frequency; the claimed share; why there is none."""

    growth: Mask
    amplitude: Mask
    omega: Mask
    claimed: float
    reason: str = ""


NOTHING = np.zeros(0, dtype=np.bool_)


def trial(kind: Kind, seed: int) -> Outcome:
    """One record, measured as the command does."""
    record = kind(np.random.default_rng(seed))
    t = np.arange(record.x.size) / record.rate
    above = record.motion.there & (record.motion.amplitude > record.noise)
    try:
        found = measure(Recording.from_arrays(record.x, record.rate))
    except InputError as error:
        return Outcome(NOTHING, NOTHING, NOTHING, 0.0, str(error))
    track, curve = found.track, found.backbone
    if track is None or track.interval is None or curve is None:
        why = "" if track is None else track.no_interval
        return Outcome(NOTHING, NOTHING, NOTHING, 0.0, why or found.notes[-1])
    motion = record.motion
    held = track.interval.holds(np.interp(track.time, t, motion.omega))[track.valid]
    near = np.abs(t[:, None] - curve.time).min(axis=1) <= np.median(np.diff(curve.time))
    valid = np.interp(t, track.time, track.valid, left=0.0, right=0.0) > 0.5
    size = within(curve.amplitude, curve.amplitude_sd, np.interp(curve.time, t, motion.amplitude))
    rise = np.interp(curve.time, t, motion.growth)
    growth = within(curve.growth_rate, curve.growth_rate_sd, rise)
    if np.ptp(motion.amplitude) > 0.01 and np.diff(motion.amplitude).max() <= 0.0:
        order = np.argsort(motion.amplitude)
        on_curve = np.interp(curve.curve_amplitude, motion.amplitude[order], motion.growth[order])
        growth = within(curve.curve_growth_rate, curve.curve_growth_rate_sd, on_curve)
    return Outcome(growth, size, held, float(np.mean((near & valid)[above])))


def within(values: Array, deviations: Array, truth: Array) -> Mask:
    """Which 95 % intervals hold the truth."""
    return np.asarray(np.abs(values - truth) <= NORMAL_95 * deviations)


def independent(masks: list[Mask]) -> tuple[float, float]:
    """The share that holds, and as how many independent draws it counts.

    Neighbouring samples of a trial share their error, so that the trials are the independent draws: n is taken as
    p (1 - p) / s^2, with s the standard error of the share over trials (Korn and Graubard 1998, Survey Methodology 24,
    193, without their allowance for few trials, 4 % of n for 60).
    """
    counts = np.array([one.size for one in masks], dtype=float)
    held = np.array([one.sum() for one in masks], dtype=float)
    p = float(held.sum() / counts.sum())
    trials = counts.size
    spread = np.sqrt(trials / max(trials - 1, 1) * np.sum((held - p * counts) ** 2)) / counts.sum()
    return p, float(min(p * (1 - p) / spread**2, counts.sum()) if spread > 0.0 else trials)


def cell(masks: list[Mask]) -> str:
    """A share with its interval."""
    masks = [one for one in masks if one.size]
    return written(*independent(masks)) if masks else "none"


def row(name: str, kind: Kind, trials: int, seed: int) -> str:
    """A row of the table."""
    found = [trial(kind, seed + k) for k in range(trials)]
    claiming = [one for one in found if not one.reason]
    claimed = f"{100 * np.mean([one.claimed for one in found]):.0f}"
    reasons = Counter(one.reason[:90] for one in found if one.reason)
    why = "; ".join(f"{text} ({count})" for text, count in reasons.most_common(1))
    cells = (cell([getattr(one, of) for one in claiming]) for of in ("growth", "amplitude", "omega"))
    return f"| {name} | {trials} | {' | '.join(cells)} | {claimed} | {len(found) - len(claiming)} | {why} |"


def main() -> None:
    """Read the options, run, print a row as soon as it is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="kinds with this in their name")
    parser.add_argument("--drawn", action="store_true", help="kinds whose parameters are drawn anew in each trial")
    given = parser.parse_args()
    sys.stdout.write("| record | trials | a'/a, % | a, % | omega, % | claimed, % | without | reason |\n")
    sys.stdout.write(f"{'|---' * 8}|\n")
    for name, kind in (DRAWN if given.drawn else KINDS).items():
        if given.only in name:
            sys.stdout.write(row(name, kind, given.trials, given.seed) + "\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
