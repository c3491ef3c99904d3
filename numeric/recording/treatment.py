"""What is done to samples before they are a signal: gaps, uneven times, clipping, drift: found, reported and treated.

The rules, in this order:
0. Of the samples those within ``span`` count, if one is given.  Stamps that are uneven by rounding alone are even.
1. A value or time that is missing, or a step over GAP_STEPS usual ones, is a gap and cuts the signal.  ``fill`` lets
   neighbours up to that far apart stay together and interpolates between them; with ``resample`` the default for it
   is RESAMPLED_STEPS steps, usual ones or those of the new rate, whichever are longer.
2. A stretch on a uniform grid is kept as it is.  Nearly even times are interpolated, others only by ``resample``.
3. Stretches with too few samples, or constant, are left out.
4. Clipped samples and those that stand still are kept and marked; they must enter no fit.
5. The slow part is measured and named, and removed by ``detrend`` only.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.files.columns import Columns
from ridgeback.numeric.recording.clipping import clipped, runs, standing_still
from ridgeback.numeric.recording.drift import DETRENDS, detrended, wandering
from ridgeback.numeric.recording.rounded_stamps import unrounded
from ridgeback.numeric.recording.stretches import GAP_STEPS, Gap, Stamped, split
from ridgeback.numeric.recording.uniform import (
    EASY,
    JITTER,
    TOLERANCE,
    Grid,
    Uniform,
    grid_of,
    off_grid,
    on_grid,
    resampled,
)
from ridgeback.numeric.signal.samples import checked_rate

FEWEST_SAMPLES = 16
RESAMPLED_STEPS = 4.0
SCATTERED = 0.02
"""Share of steps over GAP_STEPS usual ones from which on times are uneven altogether, not even with gaps."""
GUESS = 0.3
"""Interpolation error, relative to the rms of the signal, from which on it is refused."""
ROUNDS = 100
SHORT_GAP, ROOM = 6.0, 1.01
"""Usual steps up to which it is advised to fill a gap, and times its length that are to be given for that."""
PLACES = 4
"""Places that a note lists."""


@dataclass(frozen=True)
class Treatment:
    """What was asked for: ``resample`` to a rate, ``fill`` gaps up to a time, ``detrend`` by a method, keep a ``span``.

    >>> Treatment(detrend="cubic")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: detrend 'cubic' is unknown; use one of none, linear, slow
    """

    resample: float | None = None
    fill: float | None = None
    detrend: str = "none"
    span: tuple[float, float] | None = None
    unit: str = ""
    """Of the samples, in place of the one that their column states."""

    def __post_init__(self) -> None:
        if self.span is not None and not self.span[0] < self.span[1]:
            raise InputError(f"span {self.span[0]:g} to {self.span[1]:g} is empty; give its begin first, then its end")
        if self.resample is not None:
            checked_rate(self.resample)
        if self.fill is not None and not (math.isfinite(self.fill) and self.fill > 0.0):
            raise InputError(f"fill {self.fill} is not a positive time; give the longest gap to interpolate across")
        if self.detrend not in DETRENDS:
            raise InputError(f"detrend {self.detrend!r} is unknown; use one of {', '.join(DETRENDS)}")

    def longest(self, usual: float) -> float:
        """The longest step that is no gap."""
        if self.fill is not None:
            return max(self.fill * (1 + 1e-9), GAP_STEPS * usual)
        return GAP_STEPS * usual if self.resample is None else RESAMPLED_STEPS * max(usual, 1.0 / self.resample)


@dataclass(frozen=True)
class Piece:
    """One stretch: its uniform samples, their values after detrending, and the notes about it."""

    samples: Uniform
    values: Array
    notes: tuple[str, ...]
    facts: Mapping[str, object]


def treated(
    samples: Stamped, columns: Columns, header: str, treatment: Treatment
) -> tuple[list[Piece], tuple[str, ...]]:
    """The stretches of a signal, and the notes that hold for all of them.

    Raises InputError when no stretch is long enough, or times are uneven and no rate to resample to is given.
    """
    samples, rounded = unrounded(samples) if treatment.fill is None else (samples, "")
    longest = treatment.longest(samples.usual)
    if treatment.resample is None:
        check_not_scattered(samples, columns, treatment)
    flat = clipped(samples.values)
    still = standing_still(samples.values) & ~flat
    parts, gaps = split(samples, longest)
    marks = np.split(flat | still, np.cumsum([part.time.size for part in parts])[:-1])
    whole = Whole(samples, grid_of(samples.time, samples.usual), columns, treatment)
    kept, lost = [], []
    for part, mark in zip(parts, marks, strict=True):
        if part.time.size < FEWEST_SAMPLES or not np.ptp(part.values) > 0.0:
            lost.append(part)
            continue
        kept.append(piece(uniform(part, mark, whole), treatment))
    if not kept:
        raise InputError(
            f"{columns.source}, column {header}: no stretch between its {len(gaps)} gaps has {FEWEST_SAMPLES} samples "
            f"that vary (the first gap: {gap_text(gaps[0])}); interpolate across short gaps (--fill), give the rate of "
            "even samples whose stamps are at fault (--rate), or record longer"
        )
    facts = {
        "missing": samples.absent,
        "standing_still": int(np.count_nonzero(still)),
        "gaps": [[gap.begin, gap.end] for gap in gaps],
        "left_out": len(lost),
    }
    kept = [Piece(p.samples, p.values, p.notes, {**facts, **p.facts}) for p in kept]
    return kept, (
        *((rounded,) if rounded else ()),
        *signal_notes(samples, header, gaps, lost, flat),
        *still_notes(samples, still),
    )


@dataclass(frozen=True)
class Whole:
    """The signal that a stretch is a part of: its samples and their grid, where it is from, what was asked for."""

    samples: Stamped
    grid: Grid
    columns: Columns
    treatment: Treatment

    def advised(self) -> float:
        """The rate to suggest for its uneven times."""
        return advised_rate(self.samples, self.treatment)


def uniform(part: Stamped, mark: Mask, whole: Whole) -> Uniform:
    """One stretch on a uniform grid: the whole recording's, its own, or by interpolation."""
    own, columns = grid_of(part.time, part.usual), whole.columns
    rate = whole.treatment.resample
    if own.off <= JITTER:
        if whole.grid.off <= JITTER:
            own = Grid(own.k, whole.grid.step, own.off)
        even = sound(on_grid(part, mark, own), columns)
        return even if rate is None else resampled(even, rate)
    if rate is not None:
        check_not_slower(rate, part, whole)
        return sound(off_grid(part, mark, rate, GAP_STEPS * part.usual), columns)
    steps = np.diff(part.time)
    if float(np.abs(steps / part.usual - 1.0).max()) > EASY:
        refuse_uneven(part, whole)
    found = off_grid(part, mark, own.k[-1] / (part.time[-1] - part.time[0]), GAP_STEPS * part.usual)
    if found.error > TOLERANCE:
        refuse_uneven(part, whole, f"; interpolation would err by {found.error:.1e} of the rms")
    return found


# A higher rate cuts at shorter steps, and what is left between the cuts has the higher mean rate: hence the rounds.
# They end, since a cut stays a cut while the rate rises, and no step below RESAMPLED_STEPS usual ones is ever cut at.
def advised_rate(samples: Stamped, treatment: Treatment) -> float:
    """A rate to resample uneven times to, at least the mean rate of every stretch that it leaves.

    >>> time = np.concatenate([np.arange(20.0), 40.0 + 0.5 * np.arange(20)])
    >>> round(advised_rate(Stamped(time, time, np.arange(40), 0), Treatment()), 3)
    2.0
    """
    rate = 1.0 / samples.mean
    for _round in range(ROUNDS):
        parts, _ = split(samples, replace(treatment, resample=rate).longest(samples.usual))
        needed = max((1.0 / part.mean for part in parts if part.time.size >= FEWEST_SAMPLES), default=rate)
        if needed <= rate * (1 + 1e-9):
            break
        rate = needed
    return rate


def check_not_scattered(samples: Stamped, columns: Columns, treatment: Treatment) -> None:
    """Refuse times of which many leave any grid, rather than take each step for a gap."""
    steps = np.diff(samples.time) / samples.usual
    off = np.abs(steps - np.maximum(1.0, np.rint(steps))) > EASY
    if np.count_nonzero((steps > GAP_STEPS) & off) > SCATTERED * steps.size:
        raise InputError(
            f"{columns.source}: {np.count_nonzero(off)} of {steps.size} steps of the time differ from the usual one, "
            f"{samples.usual:.6g}, by more than {EASY:.0%}; interpolate, for instance by --resample "
            f"{advised_rate(samples, treatment):.4g}, or give the rate of even samples by --rate"
        )


def sound(samples: Uniform, columns: Columns) -> Uniform:
    """The samples, or InputError where their interpolation would be a guess."""
    if samples.error > GUESS:
        raise InputError(
            f"{columns.source}: interpolation would err by about {samples.error:.0%} of the rms; --fill shorter gaps "
            "only, or leave them as cuts"
        )
    return samples


def check_not_slower(rate: float, part: Stamped, whole: Whole) -> None:
    """Refuse to pick samples from uneven ones at a rate at which they would alias."""
    if rate < 0.9 / part.mean:
        raise InputError(
            f"{whole.columns.source}: resampling uneven times to {rate:g} per time unit, below their own mean rate of "
            f"{1.0 / part.mean:.6g} in one stretch, would alias; use for instance --resample {whole.advised():.4g}"
        )


def refuse_uneven(part: Stamped, whole: Whole, more: str = "") -> None:
    """Raise the InputError for uneven times, at the first odd step."""
    columns = whole.columns
    steps = np.diff(part.time)
    grid = grid_of(part.time, part.usual)
    odd = np.flatnonzero(np.abs(steps - part.usual) > 2.0 * JITTER * part.usual)
    off = np.flatnonzero(np.abs(part.time - part.time[0] - grid.step * grid.k) > JITTER * grid.step)
    at = int(odd[0]) + 1 if odd.size else int(off[0])
    raise InputError(
        f"{columns.source}, {columns.place(int(part.row[at]))}: time {part.time[at]:.9g} comes {steps[at - 1]:.6g} "
        f"after the one above, the usual step is {part.usual:.6g}; steps must agree to {2 * JITTER:.0%} (interpolate "
        f"by --resample {whole.advised():.4g}, or give the rate by --rate if the stamps are at fault){more}"
    )


def piece(samples: Uniform, treatment: Treatment) -> Piece:
    """A stretch with its trend removed as asked, and the notes about it."""
    drift = wandering(samples.values, samples.rate, samples.clipped | samples.filled)
    values = detrended(samples.values, samples.rate, treatment.detrend)
    facts: dict[str, object] = {
        "rate": samples.rate,
        "interpolation": samples.how,
        "interpolation_error": samples.error,
        "filled": int(np.count_nonzero(samples.filled)),
        "clipped": int(np.count_nonzero(samples.clipped)),
        "drift": drift,
        "detrend": treatment.detrend,
    }
    return Piece(samples, values, tuple(piece_notes(samples, treatment)), facts)


def piece_notes(samples: Uniform, treatment: Treatment) -> list[str]:
    """Interpolation of one stretch, and what was removed from it, in words."""
    notes = []
    if samples.how:
        error = f"; the interpolation errs by about {samples.error:.1e} of the rms" if samples.error else ""
        apart = "; they enter no fit" if samples.filled.any() and "uneven" not in samples.how else ""
        notes.append(f"{samples.how[0].upper()}{samples.how[1:]}{apart}{error}.")
        if "uneven" in samples.how:
            notes.append("Standard deviations take noise as white, which interpolation makes it a little less.")
    if treatment.detrend != "none":
        what = "straight line" if treatment.detrend == "linear" else "slow part (a mean over six cycles)"
        notes.append(f"The {what} was removed.")
    return notes


def signal_notes(samples: Stamped, header: str, gaps: Sequence[Gap], lost: Sequence[Stamped], flat: Mask) -> list[str]:
    """Gaps, stretches left out and clipped samples of a signal in words, with counts and places."""
    notes = []
    if samples.absent:
        rows = "row has" if samples.absent == 1 else "rows have"
        notes.append(f"{header}: {samples.absent} {rows} no value or no time.")
    if gaps:
        notes.append(
            f"{len(gaps)} {'gap' if len(gaps) == 1 else 'gaps'}: {places([gap_text(gap) for gap in gaps])}; each "
            f"stretch between is taken by itself{advice(gaps, samples.usual)}."
        )
    if lost:
        spans = [f"t = {part.time[0]:.6g} to {part.time[-1]:.6g}" for part in lost]
        notes.append(f"Left out, with fewer than {FEWEST_SAMPLES} samples or constant: {places(spans)}.")
    if flat.any():
        tops = runs(flat, 1)
        spans = [f"t = {samples.time[first]:.6g} to {samples.time[last]:.6g}" for first, last in tops]
        notes.append(
            f"{np.count_nonzero(flat)} samples in {len(tops)} flat tops are clipped: {places(spans)}; they "
            "enter no fit of the motion."
        )
    return notes


def still_notes(samples: Stamped, still: Mask) -> list[str]:
    """Samples that stand still in words, with counts and places; none where there are none."""
    if not still.any():
        return []
    spans = [
        f"at {samples.values[first]:.6g} from t = {samples.time[first]:.6g} to {samples.time[last]:.6g}"
        for first, last in runs(still, 1)
    ]
    return [
        f"{np.count_nonzero(still)} samples stand still {places(spans)}, as where a sensor sticks or what was lost is "
        "written as one value; they enter no fit of the motion."
    ]


def advice(gaps: Sequence[Gap], usual: float) -> str:
    """What keeps a signal together across its short gaps; empty where there are none.

    >>> advice([Gap(2.0, 5.0, 2), Gap(7.0, 99.0, 91)], 1.0), advice([Gap(7.0, 99.0, 91)], 1.0)
    ('; --fill 3.03 keeps it together across 1 of them, and what is missing enters no fit', '')
    """
    short = [gap.end - gap.begin for gap in gaps if gap.end - gap.begin <= SHORT_GAP * usual]
    if not short:
        return ""
    across = "it" if len(gaps) == 1 else "them" if len(short) == len(gaps) else f"{len(short)} of them"
    return f"; --fill {ROOM * max(short):.3g} keeps it together across {across}, and what is missing enters no fit"


def gap_text(gap: Gap) -> str:
    """A gap in words.

    >>> gap_text(Gap(2.0, 5.0, 2))
    't = 2 to 5 (2 missing)'
    """
    return f"t = {gap.begin:.6g} to {gap.end:.6g} ({gap.missing} missing)"


def places(texts: Sequence[str]) -> str:
    """The first few places, and how many more.

    >>> places(["a", "b", "c", "d", "e", "f"])
    'a, b, c, d and 2 more'
    """
    more = f" and {len(texts) - PLACES} more" if len(texts) > PLACES else ""
    return ", ".join(texts[:PLACES]) + more
