"""Higher harmonics of the sampled motion: phase-locked tracks, what (24) predicts, and the raw peak that fails."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.motion.estimate_curves import Outcome
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.order_analysis import MOST, Orders, orders
from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.higher_harmonics import harmonic_track, raw_harmonic_peak
from ridgeback.numeric.tracking.track import Track

VISIBLE_DB = -60.0
"""A multiple is tracked when its level re the fundamental is above this."""
TRACKED = 3
"""Most overtones that are tracked."""
_CARRIERS = ("pseudo-wigner-corrected", "harmonic-least-squares", "pseudo-wigner", "spectrogram", "zero-crossing")


@dataclass(frozen=True)
class Overtones:
    """Levels of the harmonics of u and u', their tracks, and the fundamental that the tracks are locked to."""

    of_u: Orders
    of_velocity: Orders
    carrier: Track | None
    curves: tuple[Curve, ...]
    multiples: tuple[int, ...]
    failed: str = ""

    def curve(self, name: str) -> Curve | None:
        """The curve of that name, or None."""
        return next((curve for curve in self.curves if curve.name == name), None)


def overtones(motion: Motion, outcomes: tuple[Outcome, ...]) -> Overtones:
    """Measure the levels and track the strongest overtones of the derivative (where they stand out more)."""
    run = motion.trajectory
    of_u = orders(lambda t: run.at(t)[0], motion.rising)
    of_velocity = orders(lambda t: run.at(t)[1], motion.rising)
    base = carrier(outcomes)
    if base is None:
        return Overtones(of_u, of_velocity, None, (), (), "No estimate of the fundamental to lock to.")
    multiples = _visible(motion, of_u)
    try:
        curves = tuple(_curves(motion, base, multiples))
    except InputError as error:
        return Overtones(of_u, of_velocity, base, (), multiples, str(error))
    return Overtones(of_u, of_velocity, base, curves, multiples)


def carrier(outcomes: tuple[Outcome, ...]) -> Track | None:
    """Return the fundamental to lock to: the first of the good estimators that gave a track."""
    tracks = {outcome.recipe.name: outcome.track for outcome in outcomes if outcome.track is not None}
    return next((tracks[name] for name in _CARRIERS if name in tracks), None)


def _visible(motion: Motion, levels: Orders) -> tuple[int, ...]:
    """Multiples above the visible level and safely below the Nyquist frequency, the strongest first, then by number."""
    nyquist = np.pi * motion.trajectory.rate
    room = [m for m in range(2, MOST + 1) if 1.2 * m * motion.known_omega.max() < nyquist]
    loud = [m for m in room if levels.level_db(m) > VISIBLE_DB]
    return tuple(sorted(sorted(loud, key=levels.level_db, reverse=True)[:TRACKED]))


def _curves(motion: Motion, base: Track, multiples: tuple[int, ...]) -> Iterator[Curve]:
    for multiple in multiples:
        track = harmonic_track(motion.trajectory.velocity, motion.trajectory.rate, base, multiple=multiple)
        yield _curve(track, f"harmonic-{multiple}", f"harmonic {multiple}, phase-locked")
        yield _predicted(base, multiple)
    if multiples:
        first = multiples[0]
        raw = raw_harmonic_peak(motion.trajectory.u, motion.trajectory.rate, base, multiple=first)
        note = str(raw.settings.get("why", ""))
        yield _curve(raw, f"harmonic-{first}-raw", f"harmonic {first}, raw Wigner peak", note)


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
