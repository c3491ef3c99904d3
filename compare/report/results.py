"""All that the page shows, in one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from ridgeback.common.show.brief import Brief
from ridgeback.compare.benchmark.contenders import Way
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.noise.results import NoiseStudy
from ridgeback.compare.report.error_grid import ErrorGrid
from ridgeback.compare.report.shown import ShownReport
from ridgeback.compare.study.results import Certified, Derivation, Range, Study

if TYPE_CHECKING:
    from ridgeback.compare.drift.results import DriftComparison
    from ridgeback.compare.identification.results import Identification
    from ridgeback.compare.recording.results import RecordingComparison
    from ridgeback.compare.report.several.answered import Answered
    from ridgeback.compare.report.several.indexed import Page
    from ridgeback.compare.report.several.runs import Runs


@dataclass(frozen=True)
class Card:
    """One of the figures that a reader takes away: a number, what it is of, and rows that compare across cards."""

    heading: str
    value: str
    text: str
    rows: tuple[tuple[str, str], ...] = ()
    """Name and value of each row."""
    way: Way | Literal[""] = ""
    """The way to omega0 that the card is about, which gives its colour; empty for a recording."""


@dataclass(frozen=True)
class Described:
    """What was studied, for the line below the title."""

    name: str
    equation_latex: str
    given: str
    """Parameters, start and sampling in words."""
    reference: str = ""


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
    decay : MotionComparison, optional
        One motion: expansions and estimates along it.
    recording : RecordingComparison, optional
        What was measured of a recording.
    provenance : Provenance
        How to get the same page again.
    certified : Certified, optional
        Proved errors of the series and its resummations, where omega0 can be enclosed.
    benchmark : Benchmark, optional
        Every contender on the motion: error and cost.
    grid : ErrorGrid, optional
        omega0 by generated code over order and amplitude, with its enclosed error.
    described : Described, optional
        Equation, parameters and start.
    paper : bool
        Whether this is the paper's own case.
    timed : bool
        Whether measured times are shown; without them the same inputs give the same bytes.
    answered : Answered, optional
        The answers of a study, with its oscillators side by side.
    drift : DriftComparison, optional
        A motion whose parameters drift, beside omega0 at its conserved action.
    runs : Runs, optional
        Several signals of one experiment, measured and combined.
    indexed : tuple of Page
        Other reports that this one lists.
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
    >>> Report("Pendulum", "", (), cards, None, None, (), None, None, provenance).findings()
    (('Range', '0.5', 'up to which order 2 errs by less than 1 %'),)
    """

    title: str
    lead: str
    summary: tuple[str, ...]
    cards: tuple[Card, ...]
    derivation: Derivation | None
    study: Study | None
    ranges: tuple[Range, ...]
    decay: MotionComparison | None
    recording: RecordingComparison | None
    provenance: Provenance
    certified: Certified | None = None
    noise: NoiseStudy | None = None
    identification: Identification | None = None
    csv: Mapping[str, str] = field(default_factory=dict)
    finding: Range | None = None
    benchmark: Benchmark | None = None
    grid: ErrorGrid | None = None
    described: Described | None = None
    paper: bool = False
    timed: bool = True
    answered: Answered | None = None
    drift: DriftComparison | None = None
    runs: Runs | None = None
    indexed: tuple[Page, ...] = ()

    def findings(self) -> tuple[tuple[str, str, str], ...]:
        """The cards."""
        return tuple((card.heading, card.value, card.text) for card in self.cards)
