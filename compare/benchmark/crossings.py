"""Where one way overtakes another: by order, by amplitude, and at equal numbers of coefficients."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ridgeback.compare.benchmark.contenders import (
    AmplitudeCrossing,
    Crossings,
    EqualCoefficients,
    OrderCrossing,
    Reference,
    Row,
    Source,
)
from ridgeback.numeric.arrays import Array, Mask

SOURCES: tuple[Source | None, ...] = ("energy", "action", "fit", None)
"""None: the limit cycle, whose series is in eps."""
SHOWN_ORDERS = (2, 4, 8, 12, 20)
"""Orders whose crossing in amplitude is looked for."""


def crossings(
    rows: Sequence[Row], errors: Array, amplitude: Array, support: Mask, window: int, reference: Reference
) -> Crossings:
    """All crossings of a benchmark; ``window`` is the number of samples in a cycle, over which errors are averaged."""
    return Crossings(
        orders=tuple(by_order(rows, reference)),
        amplitudes=tuple(by_amplitude(rows, errors, amplitude, support, window)),
        equal_coefficients=tuple(at_equal_coefficients(rows)),
    )


def expansions(rows: Sequence[Row], source: Source | None) -> list[Row]:
    """The ranked expansions at one amplitude, by order, each once."""
    found = [r for r in rows if r.kind == "expansion" and r.amplitude_from == source and r.language == "python"]
    return sorted((r for r in found if r.ranked), key=lambda r: r.order or 0)


def raw_estimates(rows: Sequence[Row]) -> list[Row]:
    """The ranked estimates as they are."""
    return [r for r in rows if r.kind == "estimate" and r.ranked and r.corrected_by is None]


def by_order(rows: Sequence[Row], reference: Reference) -> Iterator[OrderCrossing]:
    """For each amplitude and estimate, where the orders pass it."""
    for source in SOURCES:
        series = expansions(rows, source)
        for estimate in raw_estimates(rows) if series else ():
            yield passing(series, estimate, source, reference)


def passing(series: Sequence[Row], estimate: Row, source: Source | None, reference: Reference) -> OrderCrossing:
    """The first order from which every higher one errs less than an estimate; ``series`` is by order."""
    error = float(estimate.relative_rms_error or 0.0)
    worse = [r for r in series if float(r.relative_rms_error or 0.0) >= error]
    last = worse[-1] if worse else None
    after = next((r for r in series if last is None or (r.order or 0) > (last.order or 0)), None)
    sides = [r for r in (last, after) if r is not None]
    settled = all(reference.told_apart(float(r.relative_rms_error or 0.0), error) for r in sides)
    before = None if last is None else last.order
    return OrderCrossing(estimate.method, error, source, before, None if after is None else after.order, settled)


def running_rms(error: Array, window: int) -> Array:
    """Root mean square over a window of samples, the ends with what there is.

    >>> running_rms(np.array([3.0, 3.0, 3.0]), 3).tolist()
    [3.0, 3.0, 3.0]
    """
    ones = np.ones(max(1, window))
    known = np.isfinite(error)
    total = np.convolve(np.where(known, error, 0.0) ** 2, ones, "same")
    return np.asarray(np.sqrt(total / np.maximum(np.convolve(known.astype(float), ones, "same"), 1.0)))


def by_amplitude(
    rows: Sequence[Row], errors: Array, amplitude: Array, support: Mask, window: int
) -> Iterator[AmplitudeCrossing]:
    """Along a decay, the amplitude below which an expansion errs less than an estimate, over a cycle's running rms."""
    place = {row.method: index for index, row in enumerate(rows)}
    smooth = {name: running_rms(errors[index], window)[support] for name, index in place.items()}
    size = amplitude[support]
    if np.ptp(size) <= _change(size, window):
        return
    for source in amplitudes_of(rows):
        for row in expansions(rows, source):
            if row.order in SHOWN_ORDERS:
                for estimate in raw_estimates(rows):
                    better = smooth[row.method] < smooth[estimate.method]
                    yield _crossing(row, estimate, source, better, size, window)


def amplitudes_of(rows: Sequence[Row]) -> list[Source]:
    """The amplitudes that the expansions take."""
    return [source for source in SOURCES if source is not None and expansions(rows, source)]


def _crossing(row: Row, estimate: Row, source: Source, better: Mask, size: Array, window: int) -> AmplitudeCrossing:
    """The largest amplitude below which ``better`` holds throughout; uncertain by what a cycle changes it."""
    order = np.argsort(size)
    wrong = np.flatnonzero(~better[order])
    first = int(wrong[0]) if wrong.size else size.size
    change = _change(size, window)
    found = None if first in (0, size.size) else float(size[order][first])
    return AmplitudeCrossing(
        estimate.method, row.order or 0, source, found, change, below_everywhere=first == size.size
    )


def _change(size: Array, window: int) -> float:
    """What a cycle changes the amplitude by, at most, but never less than the rounding of it."""
    return max(float(np.abs(np.gradient(size)).max()) * window, 1e-9 * float(size.max()))


def at_equal_coefficients(rows: Sequence[Row]) -> Iterator[EqualCoefficients]:
    """The paper's series and the expansion that has as many coefficients."""
    for series in rows:
        if series.kind == "series-model" and series.ranked and series.amplitude_from is not None:
            for row in expansions(rows, series.amplitude_from):
                if row.coefficients == series.coefficients:
                    yield EqualCoefficients(
                        coefficients=row.coefficients or 0,
                        terms=series.order or 0,
                        order=row.order or 0,
                        amplitude_from=series.amplitude_from,
                        series_error=float(series.relative_rms_error or 0.0),
                        expansion_error=float(row.relative_rms_error or 0.0),
                    )
