"""One way to omega0(t): its row, before it is judged, and its values along the motion; and A(t) by source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ridgeback.compare.benchmark.contenders import Kind, Row, Source
from ridgeback.compare.motion.motion import Motion
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import Track


@dataclass(frozen=True)
class Contender:
    """One way to omega0(t): its row without errors, and its values on the motion's samples; None when refused."""

    row: Row
    omega: Array | None
    """NaN where the contender says nothing."""
    track: Track | None = None
    """Of an estimate, what it found."""


def refused(method: str, label: str, kind: Kind, why: str, *, order: int | None = None) -> Contender:
    """A contender that says why it gives nothing."""
    return Contender(Row(method, label, kind, order=order, refused=why), None)


def amplitudes(motion: Motion) -> Mapping[Source, Array]:
    """A(t) by each source that this motion has, on its samples.

    ``energy`` is the paper's eq. (20)-(21), ``action`` the averaged motion's peak, ``fit`` the envelope of the
    turning points.
    """
    found: dict[Source, Array] = {}
    if motion.has_backbone:
        found["energy"] = motion.energy_peak
    if motion.averaged is not None:
        found["action"] = motion.averaged.peak
    if not found:
        found["fit"] = motion.energy_peak
    return found
