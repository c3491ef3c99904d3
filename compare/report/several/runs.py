"""What a page shows of several recordings of one experiment: runs, channels, stretches."""

from __future__ import annotations

from dataclasses import dataclass

from ridgeback.common.show.brief import Brief
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.recording.measurements import Measurements
from ridgeback.compare.recording.theory import TheoryBackbone


@dataclass(frozen=True, repr=False)
class Named(Brief):
    """What made one of the signals, or why that is not said."""

    label: str
    made: Identification | None
    why: str = ""


@dataclass(frozen=True, repr=False)
class Runs(Brief):
    """Several signals, measured, combined where they are of one channel, and named."""

    found: Measurements
    labels: tuple[str, ...]
    """What tells each measured signal from the others."""
    theory: TheoryBackbone | None
    """The named oscillator's backbone at the amplitudes of the combined or the first one."""
    named: tuple[Named, ...]
