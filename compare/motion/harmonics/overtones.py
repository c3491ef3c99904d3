"""Higher harmonics of the sampled motion: phase-locked tracks, what (24) predicts, and the raw peak that fails."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import decibels
from ridgeback.compare.motion.estimate_curves import CORRECTED, PSEUDO_WIGNER, Outcome
from ridgeback.compare.motion.harmonics.folding import Folding, folding
from ridgeback.compare.motion.harmonics.order_analysis import MOST, Orders, orders
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.higher_harmonics import harmonic_track, raw_harmonic_peak
from ridgeback.numeric.motion.cycle_frequency import is_symmetric
from ridgeback.numeric.tracking.track import Track

VISIBLE_DB = -60.0
"""A multiple is tracked when its level re the fundamental is above this."""
TRACKED = 3
"""Most overtones that are tracked."""
MARGIN_DB = 6.0
"""How far above the leakage of the analysis a multiple must stand to be one."""
FOLDING_DB = -90.0
"""A multiple above this level shows in a spectrogram of the derivative, folded or not."""
_CARRIERS = (CORRECTED, "harmonic-least-squares", PSEUDO_WIGNER, "spectrogram", "zero-crossing")


@dataclass(frozen=True)
class Overtone:
    """One multiple of the fundamental: its phase-locked track, and what (24) predicts for it."""

    multiple: int
    track: Curve
    predicted: Curve


@dataclass(frozen=True)
class Overtones:
    """Levels of the harmonics of u and u', and the overtones that stand out."""

    of_u: Orders
    of_velocity: Orders
    multiples: tuple[int, ...] = ()
    """Multiples that stand out, tracked or not."""
    tracked: tuple[Overtone, ...] = ()
    raw: Curve | None = None
    """The unlocked Wigner peak near the lowest of them, which a cross term may be; its note says which."""
    failed: str = ""
    """Why those that stand out could not be tracked, when they could not."""

    @property
    def curves(self) -> tuple[Curve, ...]:
        """All tracks with their predictions, then the raw peak."""
        pairs = tuple(curve for one in self.tracked for curve in (one.track, one.predicted))
        return pairs if self.raw is None else (*pairs, self.raw)


def overtones(motion: Motion, outcomes: tuple[Outcome, ...]) -> Overtones:
    """Measure the levels and track the strongest overtones of the derivative (where they stand out more)."""
    run = motion.trajectory
    of_u = orders(lambda t: run.at(t)[0], motion.rising)
    of_velocity = orders(lambda t: run.at(t)[1], motion.rising)
    base = carrier(outcomes)
    if base is None:
        return Overtones(of_u, of_velocity)
    multiples = _visible(motion, of_u)
    try:
        tracked = tuple(_overtone(motion, base, multiple) for multiple in multiples)
        raw = _raw(motion, base, multiples[0]) if multiples else None
    except InputError as error:
        return Overtones(of_u, of_velocity, multiples, failed=str(error))
    return Overtones(of_u, of_velocity, multiples, tracked, raw)


def carrier(outcomes: tuple[Outcome, ...]) -> Track | None:
    """The fundamental to lock to: the first of the good estimators that gave a track."""
    tracks = {outcome.recipe.name: outcome.track for outcome in outcomes if outcome.track is not None}
    return next((tracks[name] for name in _CARRIERS if name in tracks), None)


def _odd(motion: Motion) -> bool:
    return is_symmetric(motion.dynamics, largest=float(np.abs(motion.trajectory.u).max()))


def leakage_db(motion: Motion, levels: Orders) -> float | None:
    """The strongest even multiple under an odd force, which has none: what the analysis itself leaks; else None."""
    if not _odd(motion):
        return None
    return max(levels.level_db(m) for m in range(2, MOST + 1, 2))


def seen(motion: Motion, levels: Orders, *, least_db: float = VISIBLE_DB) -> tuple[int, ...]:
    """Multiples that the motion has above a level; under an odd force, those that stand above their even neighbours."""
    visible = [m for m in range(2, MOST + 1) if levels.level_db(m) > least_db]
    if not _odd(motion):
        return tuple(visible)
    beside = {m: max(levels.level_db(n) for n in (m - 1, m + 1) if 1 < n <= MOST) for m in visible if m % 2}
    return tuple(m for m, leaked in beside.items() if levels.level_db(m) > leaked + MARGIN_DB)


def folding_of(motion: Motion, of_velocity: Orders) -> Folding:
    """What the rate of a motion folds of the multiples that its derivative shows."""
    fastest = float(motion.known_omega.max()) / (2.0 * np.pi)
    return folding(seen(motion, of_velocity, least_db=FOLDING_DB), fastest, motion.trajectory.rate)


def even_sentence(motion: Motion, levels: Orders) -> str:
    """What stands at the even multiples: leakage under an odd force, harmonics under another."""
    leakage = leakage_db(motion, levels)
    if leakage is None:
        even = max(levels.level_db(m) for m in range(2, MOST + 1, 2))
        return f"The strongest even multiple is at {decibels(even)}."
    return (
        f"An odd force has odd multiples only; what the analysis finds at the even ones, {decibels(leakage)} at most, "
        "is its own leakage."
    )


def _visible(motion: Motion, levels: Orders) -> tuple[int, ...]:
    """Multiples that are seen safely below the Nyquist frequency, the strongest first, then by number."""
    nyquist = np.pi * motion.trajectory.rate
    visible = [m for m in seen(motion, levels) if 1.2 * m * motion.known_omega.max() < nyquist]
    return tuple(sorted(sorted(visible, key=levels.level_db, reverse=True)[:TRACKED]))


def _overtone(motion: Motion, base: Track, multiple: int) -> Overtone:
    run = motion.trajectory
    track = harmonic_track(run.velocity, run.rate, base, multiple=multiple)
    locked = _curve(track, f"harmonic-{multiple}", f"harmonic {multiple}, phase-locked")
    return Overtone(multiple, locked, _predicted(base, multiple))


def _raw(motion: Motion, base: Track, multiple: int) -> Curve:
    raw = raw_harmonic_peak(motion.trajectory.u, motion.trajectory.rate, base, multiple=multiple)
    return _curve(raw, f"harmonic-{multiple}-raw", f"harmonic {multiple}, raw Wigner peak", raw.used.why)


def _curve(track: Track, name: str, label: str, note: str = "") -> Curve:
    valid = track.valid & np.isfinite(track.omega)
    return Curve(name, label, "estimate", track.time, track.omega, valid, track.standard_deviation, note=note)


# omega_k = (k + 1) omega_0, eq. (24); multiples are counted from 1 here
def _predicted(base: Track, multiple: int) -> Curve:
    return Curve(
        f"harmonic-{multiple}-predicted",
        f"{multiple} times the fundamental, eq. (24)",
        "model",
        base.time,
        multiple * base.omega,
        base.valid & np.isfinite(base.omega),
    )


def slope(curve: Curve, low: float, high: float) -> float | None:
    """Mean slope d omega / dt of a curve between two times, by a straight-line fit; None with too few samples.

    >>> t = np.arange(10.0)
    >>> slope(Curve("", "", "model", t, 2 * t, t >= 0), 0, 9).__round__(12)
    2.0
    """
    keep = curve.valid & (curve.time >= low) & (curve.time <= high)
    if np.count_nonzero(keep) < 3:
        return None
    return float(np.polynomial.Polynomial.fit(curve.time[keep], curve.omega[keep], 1).convert().coef[1])


def ratio_error(curve: Curve, multiple: int, motion: Motion, low: float, high: float) -> Array:
    """Relative distance of a harmonic's track from ``multiple`` times the reference, within two times."""
    keep = curve.valid & (curve.time >= low) & (curve.time <= high)
    return np.asarray(curve.omega[keep] / (multiple * motion.reference(curve.time[keep])) - 1)
