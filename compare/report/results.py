"""All that the page shows, in one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ridgeback.compare.identification.results import Identification
from ridgeback.compare.noise.results import NoiseStudy
from ridgeback.compare.results import (
    Certified,
    DecayComparison,
    Derivation,
    Provenance,
    Range,
    RecordingComparison,
    Standing,
    Study,
    Timing,
)


@dataclass(frozen=True)
class Card:
    """One of the three figures that a reader takes away."""

    heading: str
    value: str
    text: str


@dataclass(frozen=True)
class Report:
    """All that the page shows; parts that a run does not have are None."""

    title: str
    lead: str
    summary: tuple[str, ...]
    cards: tuple[Card, ...]
    derivation: Derivation | None
    study: Study | None
    ranges: tuple[Range, ...]
    decay: DecayComparison | None
    recording: RecordingComparison | None
    timings: tuple[Timing, ...]
    provenance: Provenance
    certified: Certified | None = None
    """Proved errors of the series and its resummations, where omega0 can be enclosed."""
    standings: tuple[Standing, ...] = ()
    """Every estimator on the same samples."""
    noise: NoiseStudy | None = None
    """The estimators in noise, beside the Cramér-Rao bound."""
    identification: Identification | None = None
    """Which oscillator made a recording."""
    csv: Mapping[str, str] = field(default_factory=dict)
    """File name to CSV text, for the download links."""
    finding: Range | None = None
    """The range of use that the title states and the figures mark; None: the first of ``ranges``."""
