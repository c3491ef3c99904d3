"""``observed-order``: the power of the amplitude with which the error of an order grows, against the theoretical one.

The error of a series that is cut after order N is, with p the first power beyond N whose coefficient is not zero,

    e(A) = c A^p (1 + b1 A + b2 A^2 + ...),    ln |e| = ln c + p ln A + b1 A + (b2 - b1^2 / 2) A^2 + ...

so p is found by least squares with the powers of A as further unknowns, from amplitudes at which the error stands well
above what the reference is uncertain by, and below which it does not change its sign.  The interval holds the spread of
the points and, for the powers that are left out, what one and two powers more change.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import stdtrit

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.measures.backbone import series_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions.grids import SHOWN_STROKES, WHO, Grid, grids, titles
from ridgeback.compare.studies.tasks import Column, Finished
from ridgeback.numeric.arrays import Array

ABOVE = 1e3
"""Times the uncertainty of the reference, and of a double, that an error must have to count."""
LARGEST = 0.02
"""Relative error up to which powers beyond the third are small."""
POWERS = (1, 2, 3, 4, 5)
"""Numbers of powers of A beside p that are tried; each is held against the two before."""
LEAST = 8
"""Amplitudes that the three smallest fits need."""
MOST = 24
"""Amplitudes that are used, the smallest that count."""
ROUNDING = 1e-3
"""Deviation of a power that is no failure, however narrow its interval."""
BESIDE = 0.12
"""How far the points of the next oscillator stand aside, in orders, so that none covers another."""
DECIDED = 0.25
"""Half width of the interval up to which the power is decided."""
COLUMNS = (
    *WHO,
    Column("order", "1", "highest power kept"),
    Column("theoretical", "1", "first power beyond the order whose coefficient is not zero"),
    Column("observed", "1", "power with which the error grows"),
    Column("half_width", "1", "half of its 95 % interval"),
    Column("amplitudes", "1", "number of amplitudes that it is found from"),
    Column("verdict", "", "pass, fail, or why it is not decided"),
)


@dataclass(frozen=True)
class Slope:
    """An observed power with half of its 95 % interval."""

    power: float
    half_width: float
    count: int


def answer(plan: Plan, blocks: Iterable[Finished]) -> Answer:
    """Observed against theoretical order.

    Parameters
    ----------
    plan : Plan
        The study; small amplitudes in logarithmic steps serve best.
    blocks : iterable of Finished
        Backbone cells.

    Returns
    -------
    Answer
        A row for each oscillator, method and order; passed when no row that is decided fails and one is decided.
    """
    rows: list[dict[str, Any]] = []
    strokes: list[Stroke] = []
    failed = 0
    found = list(grids(blocks))
    for grid, name in zip(found, titles(found), strict=True):
        failed += grid.failed
        own = list(rows_of(grid))
        rows += own
        strokes += stroke_of(name, own, BESIDE * len(strokes))
    passes, fails = (sum(row["verdict"] == word for row in rows) for word in ("pass", "fail"))
    said = (summary(len(rows), passes, fails),)
    title = plan.title or "order of convergence"
    picture = Picture(
        title,
        "order of the expansion",
        "observed less theoretical order, bars 95 %",
        tuple(strokes[:SHOWN_STROKES]),
        labelled=sorted({row["order"] for row in rows if row["verdict"] in ("pass", "fail")}),
    )
    passed = None if passes + fails == 0 else fails == 0
    title = "order of convergence, observed and theoretical"
    return Answer("observed-order", title, COLUMNS, tuple(rows), said, picture, failed, passed)


def summary(count: int, passes: int, fails: int) -> str:
    """How many orders of convergence agree with theory, how many do not, and how many are left open.

    >>> summary(20, 10, 0), summary(2, 1, 1)
    ('10 of 20 orders of convergence agree with theory, none disagrees, 10 are left open', \
'1 of 2 orders of convergence agrees with theory, 1 disagrees')
    """
    wrong = f"{fails or 'none'} {'disagree' if fails > 1 else 'disagrees'}"
    rest = count - passes - fails
    open_ = f", {rest} {'are' if rest > 1 else 'is'} left open" if rest else ""
    right = f"{passes} of {count} orders of convergence {'agrees' if passes == 1 else 'agree'} with theory"
    return f"{right}, {wrong}{open_}"


def stroke_of(name: str, rows: Sequence[Mapping[str, Any]], aside: float) -> Iterator[Stroke]:
    """What is decided of one oscillator: how far observed orders are from theory's, with their intervals."""
    known = [row for row in rows if row["verdict"] in ("pass", "fail")]
    order, theory, power, half = (
        np.array([row[name] for row in known], dtype=float)
        for name in ("order", "theoretical", "observed", "half_width")
    )
    if known:
        off = power - theory
        yield Stroke(order + aside, off, name, off - half, off + half, dots=True)


def rows_of(grid: Grid) -> Iterator[dict[str, Any]]:
    """One row for each order."""
    floor = grid.uncertainty + 4.0 * np.finfo(float).eps
    for order, errors in zip(grid.orders, grid.error, strict=True):
        expected = theoretical(grid, order)
        found = slope(grid.amplitudes, errors, floor)
        yield {
            **grid.who(),
            "order": order,
            "theoretical": expected,
            "observed": None if found is None else found.power,
            "half_width": None if found is None else found.half_width,
            "amplitudes": 0 if found is None else found.count,
            "verdict": verdict(expected, found),
        }


def theoretical(grid: Grid, order: int) -> int | None:
    """The first power beyond the order with a coefficient; None for formulas that are no truncated series."""
    series = series_of(grid.system, grid.method, max(grid.orders) + 4)
    if series is None:
        return None
    return next((n for n, c in enumerate(series.coefficients) if n > order and c != 0), None)


def slope(amplitudes: Array, signed: Array, floor: Array) -> Slope | None:
    """The power of the error by least squares, None where too few amplitudes count.

    >>> A = np.geomspace(0.01, 0.5, 20)
    >>> found = slope(A, 3.0 * A**4 * np.exp(0.5 * A**2), np.full(20, 1e-16))
    >>> round(found.power, 6), found.count >= 8
    (4.0, True)
    """
    errors = np.abs(signed)
    with np.errstate(invalid="ignore"):
        counts = np.isfinite(errors) & (errors > ABOVE * floor) & (errors < LARGEST)
    at = np.flatnonzero(counts)
    turns = np.flatnonzero(np.diff(np.sign(signed[at])))
    at = at[: turns[0] + 1][:MOST] if turns.size else at[:MOST]
    if at.size < LEAST:
        return None
    scatter = float(np.mean((floor[at] / errors[at]) ** 2))
    fits = [fitted(amplitudes[at], np.log(errors[at]), powers, scatter) for powers in POWERS if at.size >= powers + 5]
    return min((judged(*three) for three in zip(fits, fits[1:], fits[2:], strict=False)), key=lambda s: s.half_width)


def judged(coarse: Slope, fine: Slope, finer: Slope) -> Slope:
    """The last of three fits, its interval wide enough for what the powers that are left out may change."""
    steps = abs(finer.power - fine.power) + abs(fine.power - coarse.power)
    return Slope(finer.power, finer.half_width + steps, finer.count)


# ln |e| = ln c + p ln A + b_1 A + ... + b_n A^n, by least squares
def fitted(amplitudes: Array, logarithms: Array, powers: int, scatter: float) -> Slope:
    """The power p with ``powers`` powers of A beside it; ``scatter`` is the variance that the reference adds."""
    unit = amplitudes / amplitudes[-1]
    columns = [np.ones(unit.size), np.log(unit), *(unit**n for n in range(1, powers + 1))]
    design = np.stack(columns, axis=1)
    solution, *_ = np.linalg.lstsq(design, logarithms, rcond=None)
    rest = logarithms - design @ solution
    freedom = unit.size - len(columns)
    variance = float(rest @ rest) / freedom + scatter
    width = float(stdtrit(freedom, 0.975)) * math.sqrt(variance * np.linalg.pinv(design.T @ design)[1, 1])
    return Slope(float(solution[1]), width, unit.size)


def verdict(expected: int | None, found: Slope | None) -> str:
    """Pass or fail in a word, or why neither.

    >>> verdict(4, Slope(4.01, 0.02, 20)), verdict(4, Slope(6.0, 0.02, 20)), verdict(None, Slope(4.0, 0.01, 9))
    ('pass', 'fail', 'no theoretical order: not a truncated series')
    """
    if expected is None:
        return "no theoretical order: not a truncated series"
    if found is None:
        return f"not decided: fewer than {LEAST} amplitudes have an error between the reference's and {LARGEST:g}"
    if found.half_width > DECIDED:
        return "not decided: the interval is too wide"
    return "pass" if abs(found.power - expected) <= max(found.half_width, ROUNDING) else "fail"
