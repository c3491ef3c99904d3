"""All that the page shows, in one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ridgeback.common.show.brief import Brief
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


@dataclass(frozen=True, repr=False)
class Provenance(Brief):
    """How to get the same page again."""

    command: str
    versions: Mapping[str, str]
    parameters: Mapping[str, str]
    settings_hash: str
    input_hash: str = ""
    seconds: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, repr=False)
class Report(ShownReport):
    """All that the page shows; parts that a run does not have are None.

    Made by :func:`ridgeback.report`; ``save(path)`` writes the page.

    Parameters
    ----------
    title, lead : str
        Heading, and the sentence below it.
    summary : tuple of str
        What was found, in sentences.
    cards : tuple of Card
        The findings at the head of the page.
    derivation : Derivation, optional
        The series or slow flow and its certificate.
    study : Study, optional
        Error over order and amplitude.
    ranges : tuple of Range
        Up to which amplitude each order stays within the target.
    decay : DecayComparison, optional
        One motion: expansions and estimates along it.
    recording : RecordingComparison, optional
        What was measured of a recording.
    timings : tuple of Timing
        Cost of evaluation.
    provenance : Provenance
        How to get the same page again.
    certified : Certified, optional
        Proved errors of the series and its resummations, where omega0 can be enclosed.
    estimator_scores : tuple of EstimatorScore
        Every estimator on the same samples.
    noise : NoiseStudy, optional
        The estimators in noise, beside the Cramér-Rao bound.
    identification : Identification, optional
        Which oscillator made a recording.
    csv : mapping of str to str
        File name to CSV text, for the download links.
    finding : Range, optional
        The range of use that the title states and the figures mark; None: the first of ``ranges``.

    Examples
    --------
    >>> provenance = Provenance("ridgeback report", {}, {}, "")
    >>> cards = (Card("Range", "0.5", "up to which order 2 errs by less than 1 %"),)
    >>> Report("Pendulum", "", (), cards, None, None, (), None, None, (), provenance).findings()
    (('Range', '0.5', 'up to which order 2 errs by less than 1 %'),)
    """

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
    estimator_scores: tuple[EstimatorScore, ...] = ()
    noise: NoiseStudy | None = None
    identification: Identification | None = None
    csv: Mapping[str, str] = field(default_factory=dict)
    finding: Range | None = None

    def findings(self) -> tuple[tuple[str, str, str], ...]:
        """The cards."""
        return tuple((card.heading, card.value, card.text) for card in self.cards)
