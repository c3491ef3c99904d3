"""All that the page shows, in one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ridgeback.compare.identification.results import Identification
from ridgeback.compare.motion.results import DecayComparison
from ridgeback.compare.noise.results import NoiseStudy
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.report.shown import ShownReport
from ridgeback.compare.study.results import Certified, Derivation, Range, Study, Timing


@dataclass(frozen=True)
class Card:
    """One of the three figures that a reader takes away."""

    heading: str
    value: str
    text: str


@dataclass(frozen=True)
class EstimatorScore:
    """One estimator with its own defaults on the samples of a motion, with and without its bias."""

    method: str
    rms_raw: float | None
    """Relative, like the next four, against the cycle frequency; over the interior, bias left in."""
    rms_interior: float | None
    """Over the interior, bias removed; so are the next two."""
    rms_start: float | None
    rms_end: float | None
    half_width: float | None
    """Median half width of its 95 % interval over the interior; None where it claims none."""
    coverage: float | None
    """Share of the interior's samples whose interval holds the reference."""
    seconds: float
    """CPU time of the whole track on the machine that made the page."""
    note: str = ""
    failed: str = ""
    """Why the method gave nothing, when it did not."""


@dataclass(frozen=True)
class Provenance:
    """How to get the same page again."""

    command: str
    versions: Mapping[str, str]
    parameters: Mapping[str, str]
    settings_hash: str
    input_hash: str = ""
    seconds: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, repr=False)
class Report(ShownReport):
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
    estimator_scores: tuple[EstimatorScore, ...] = ()
    """Every estimator on the same samples."""
    noise: NoiseStudy | None = None
    """The estimators in noise, beside the Cramér-Rao bound."""
    identification: Identification | None = None
    """Which oscillator made a recording."""
    csv: Mapping[str, str] = field(default_factory=dict)
    """File name to CSV text, for the download links."""
    finding: Range | None = None
    """The range of use that the title states and the figures mark; None: the first of ``ranges``."""

    def findings(self) -> tuple[tuple[str, str, str], ...]:
        """The cards."""
        return tuple((card.heading, card.value, card.text) for card in self.cards)
