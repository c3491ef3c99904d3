"""What is known of each contender of a benchmark, where contenders cross, and which is best at what cost.

Errors are relative to the reference omega0(t) and are taken over the support that is named; times are those of this
machine's processor in this run.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Literal

from ridgeback.common.numbers import relative, rounded_down, scientific, two_digits, uncertain
from ridgeback.common.quantities import measured_time
from ridgeback.common.show.brief import Brief

Kind = Literal[
    "expansion", "slow-flow", "resummation", "minimax", "series-model", "closed-form", "averaged", "linear", "estimate"
]
Source = Literal["energy", "action", "fit"]
"""Where a model takes its amplitude from: A(t) of the energy of each instant (the paper's eq. (21)), of the averaged
action, or of the envelope of the turning points."""
Way = Literal["expansions", "series model", "estimates"]

WAYS: Mapping[Kind, Way | None] = {
    "expansion": "expansions",
    "slow-flow": "expansions",
    "resummation": "expansions",
    "minimax": None,
    "series-model": "series model",
    "closed-form": None,
    "averaged": None,
    "linear": None,
    "estimate": "estimates",
}
"""The way that a kind belongs to; None for what serves as a yardstick."""


@dataclass(frozen=True, repr=False)
class Reference(Brief):
    """What errors are measured against, and how well that is known (relative rms over the support)."""

    label: str
    numerical_error: float
    definition: float
    """How far two readings of the same motion differ: below it, omega0(t) of a decay is not defined."""

    @property
    def floor(self) -> float:
        """The error below which two contenders cannot be told apart."""
        return max(self.numerical_error, self.definition)

    @property
    def defined(self) -> bool:
        """Whether two readings of the same motion leave the floor open, rather than its integration."""
        return self.definition >= self.numerical_error

    @property
    def open_words(self) -> str:
        """What leaves omega0(t) open, in words."""
        return "two readings of ω₀(t) disagree" if self.defined else "the integration leaves ω₀(t) open"

    def told_apart(self, one: float, other: float) -> bool:
        """Whether two errors keep their order whichever reading is taken: each may be wrong by the floor.

        >>> [Reference("", 0.0, 1e-5).told_apart(5e-7, other) for other in (2e-5, 3e-5)]
        [False, True]
        """
        return abs(one - other) > 2.0 * self.floor


@dataclass(frozen=True, repr=False)
class Row(Brief):
    """One contender.  Its errors are None when it was refused; ``refused`` says why."""

    method: str
    label: str
    kind: Kind
    order: int | None = None
    """Order of an expansion, or number of terms of the series model."""
    coefficients: int | None = None
    amplitude_from: Source | None = None
    language: str | None = None
    corrected_by: str | None = None
    relative_rms_error: float | None = None
    largest: float | None = None
    mean: float | None = None
    """Signed: negative means low."""
    support: tuple[float, float] | None = None
    coverage: float = 0.0
    """Share of the interior that the contender itself covers."""
    ranked: bool = False
    time_ns_per_value: float | None = None
    time_s_per_track: float | None = None
    time_scatter: float | None = None
    """How such times scatter from run to run, as a share of them."""
    refused: str | None = None

    def to_dict(self) -> dict[str, object]:
        """The row as JSON knows it."""
        return asdict(self)


@dataclass(frozen=True)
class OrderCrossing:
    """The order from which an expansion stays below the error of an estimate; None in ``after`` when it never does."""

    estimate: str
    estimate_error: float
    amplitude_from: Source | None
    """None: of a limit cycle, whose series is in eps."""
    before: int | None
    """The last order that errs more; None when the lowest order is better already."""
    after: int | None
    settled: bool
    """Whether the two errors on each side differ by more than the reference leaves open."""

    def sentence(self) -> str:
        """The crossing in words.

        >>> OrderCrossing("pseudo-wigner", 4.6e-4, "action", 20, 30, True).sentence()
        'expansion at A(t) from the action passes pseudo-wigner between orders 20 and 30'
        """
        head = f"expansion at A(t) from the {self.amplitude_from}" if self.amplitude_from else "expansion in eps"
        if self.after is None:
            return f"{head} stays behind {self.estimate} to order {self.before}"
        if self.before is None:
            return f"{head} is ahead of {self.estimate} from order {self.after}"
        return f"{head} passes {self.estimate} between orders {self.before} and {self.after}"


@dataclass(frozen=True)
class AmplitudeCrossing:
    """The peak amplitude below which an expansion of this order errs less than an estimate along the same decay."""

    estimate: str
    order: int
    amplitude_from: Source
    amplitude: float | None
    """None: there is no crossing on the support."""
    uncertainty: float
    below_everywhere: bool
    """Without a crossing: whether the expansion is the better one throughout."""

    def words(self) -> str:
        """Where the expansion is ahead.

        >>> AmplitudeCrossing("pseudo-wigner", 4, "action", 1.234, 0.05, False).words()
        'A < 1.234 ± 0.050'
        """
        if self.amplitude is None:
            return "always" if self.below_everywhere else "never"
        return f"A < {uncertain(self.amplitude, self.uncertainty)}"


@dataclass(frozen=True)
class EqualCoefficients:
    """The paper's series and the expansion with as many coefficients, at the same amplitude."""

    coefficients: int
    terms: int
    order: int
    amplitude_from: Source
    series_error: float
    expansion_error: float


@dataclass(frozen=True, repr=False)
class Crossings(Brief):
    """All crossings of a benchmark."""

    orders: tuple[OrderCrossing, ...] = ()
    amplitudes: tuple[AmplitudeCrossing, ...] = ()
    equal_coefficients: tuple[EqualCoefficients, ...] = ()


@dataclass(frozen=True, repr=False)
class Verdict(Brief):
    """Which way is best here, by how much over the best of another way, and what it costs."""

    way: Way
    best: Row
    rival_way: Way | None
    """None where no other way could be ranked; the rival is then the best yardstick, an exact omega0 at A(t)."""
    rival: Row | None
    ratio: float | None
    """The rival's error over the best's, both no less than the reference's floor; below 1 for a better yardstick."""
    decided: bool
    """Whether the errors keep their order whichever reading of omega0(t) is taken, and differ by more than 5 %."""
    limit: str
    """Where the best way ends, in words made from its numbers."""

    def sentence(self, reference: Reference) -> str:
        """The verdict in words: errors and costs of the best way and of the best of another one."""
        head = f"{_capital(self.best.label)} errs {_error(self.best)} rms{_cost(self.best)}"
        if self.rival is None or self.ratio is None:
            return f"{head}; nothing of another way could be ranked"
        rival = f"{self.rival.label} ({_error(self.rival)}{_cost(self.rival)})"
        if not self.decided and reference.told_apart(*self.errors):
            return f"{head}, and {rival} does as well, within 5 %"
        if not self.decided:
            return (
                f"{head}, and {rival} cannot be told from it: omega0(t) itself is open by {relative(reference.floor)}"
            )
        times = self.times(reference)
        if min(self.errors) < reference.floor:
            rival = f"{rival}, as far as omega0(t) itself is known: it is open by {relative(reference.floor)}"
        return f"{head}, {times} times {'less' if self.ratio > 1.0 else 'more'} than {rival}"

    @property
    def errors(self) -> tuple[float, float]:
        """Of the best and of its rival."""
        rival = self.best if self.rival is None else self.rival
        return float(self.best.relative_rms_error or 0.0), float(rival.relative_rms_error or 0.0)

    def least_ratio(self, reference: Reference) -> float:
        """How many times the larger error is the smaller one, whichever reading of omega0(t) is taken."""
        floor = reference.floor if min(self.errors) < reference.floor else 0.0
        return (max(self.errors) - floor) / max(min(self.errors) + floor, 1e-300)

    def times(self, reference: Reference) -> str:
        """The same in words, a bound rounded down."""
        ratio = self.least_ratio(reference)
        if min(self.errors) >= reference.floor:
            return two_digits(ratio) if ratio < 1e5 else scientific(ratio)
        least = rounded_down(ratio, 2)
        return f"at least {two_digits(least) if least < 1e5 else scientific(least)}"


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


def _cost(row: Row) -> str:
    ns = row.time_ns_per_value
    return "" if ns is None else f" at {measured_time(1e-9 * ns, row.time_scatter)} a value"


def _error(row: Row) -> str:
    return relative(row.relative_rms_error or 0.0)
