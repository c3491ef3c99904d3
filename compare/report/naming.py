"""What the page calls contenders, amplitudes and starts: short names made from typed rows."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from ridgeback.common.numbers import NONE, alike, listing, per_cent
from ridgeback.common.quantities import measured_time, symbol
from ridgeback.compare.benchmark.contenders import Reference, Row, Source
from ridgeback.compare.motion.results import Case

ESTIMATORS: Mapping[str, str] = {
    "wigner": "Wigner peak",
    "pseudo-wigner": "pseudo-Wigner",
    "smoothed-pseudo-wigner": "smoothed pseudo-Wigner",
    "polynomial-wigner": "polynomial Wigner",
    "spectrogram": "spectrogram",
    "zero-crossing": "zero crossings",
    "harmonic-least-squares": "harmonic least squares",
    "hilbert": "Hilbert phase",
}
SOURCES: Mapping[Source, str] = {
    "energy": "A(t) from the energy",
    "action": "A(t) from the averaged action",
    "fit": "A(t) from the turning points",
}
REMOVED = "own bias removed"


def estimator(method: str) -> str:
    """An estimator as it is called in a sentence.

    >>> estimator("wigner"), estimator("my-own"), estimator("harmonic-least-squares/local")
    ('Wigner peak', 'my own', 'harmonic least squares (local)')
    """
    name, _, scope = method.partition("/")
    return ESTIMATORS.get(name, name.replace("-", " ")) + (f" ({scope})" if scope else "")


def short_name(row: Row) -> str:
    """A contender without its amplitude and language.

    >>> short_name(Row("lindstedt-20-action-c", "", "expansion", order=20))
    'order 20'
    >>> short_name(Row("wigner-corrected", "", "estimate", corrected_by="its own track"))
    'Wigner peak, own bias removed'
    """
    match row.kind:
        case "expansion" if row.order is not None:
            return f"order {row.order}"
        case "slow-flow":
            return f"multiple scales, order {row.order}"
        case "series-model":
            return f"series, {row.order} terms"
        case "estimate":
            plain = estimator(row.method.removesuffix("-corrected"))
            return f"{plain}, {REMOVED}" if row.corrected_by else plain
        case "closed-form":
            return "exact ω₀"
        case "averaged":
            return "exact √(ω₀² − μ²)" if row.method == "averaged-damped" else "exact ω₀"
        case "linear":
            return "linear oscillator"
    name = row.label.partition(", A(t)")[0].replace(", order", " of order").replace("Pade", "Padé")
    name = name.replace("A^2", "A²")
    return f"{name[0].lower() if name[1:2].islower() and not name.startswith('Pad') else name[0]}{name[1:]}"


def spoken(row: Row) -> str:
    """A contender in a sentence.

    >>> spoken(Row("series-21", "", "series-model", order=21))
    '21 terms of the paper’s series'
    >>> spoken(Row("multiple-scales-8", "", "slow-flow", order=8))
    'multiple scales to order 8'
    """
    match row.kind:
        case "series-model":
            return f"{row.order} terms of the paper’s series"
        case "slow-flow":
            return f"multiple scales to order {row.order}"
    return short_name(row)


def at_most(
    error: float | None,
    reference: Reference | None,
    words: str = "at most ",
    *,
    missing: str = NONE,
    signed: bool = False,
    written: Callable[..., str] = per_cent,
) -> str:
    """An error as far as the reference knows it: below its floor, the floor; ``written`` as its column is.

    >>> at_most(1.3e-5, Reference("", 0.0, 1.8e-4)), at_most(0.01, Reference("", 0.0, 1.8e-4), "≤ ")
    ('at most 0.018 %', '1.0 %')
    """
    if reference is not None and below_floor(error, reference):
        return f"{words}{written(reference.floor)}"
    return written(error, missing=missing, signed=signed)


def written_of(errors: Iterable[float | None], reference: Reference | None = None) -> Callable[..., str]:
    """How a column of errors is written that tells those below the reference's floor as the floor."""
    floor = 0.0 if reference is None else reference.floor
    return alike(None if error is None else max(abs(error), floor) for error in errors)


def below_floor(error: float | None, reference: Reference | None) -> bool:
    """Whether the reference cannot tell an error from none."""
    return reference is not None and error is not None and abs(error) < reference.floor


def floor_words(errors: Iterable[float | None], reference: Reference | None) -> str:
    """What ≤ stands for below a table or a figure; empty where no error is below the floor.

    >>> floor_words([1e-5, 0.1], Reference("", 0.0, 1.8e-4))
    ' ≤: under 0.018 %, where two readings of ω₀(t) disagree.'
    """
    if reference is None or not any(below_floor(error, reference) for error in errors):
        return ""
    return f" ≤: under {per_cent(reference.floor)}, where {reference.open_words}."


def told(row: Row, reference: Reference, cost_s: float) -> str:
    """A contender with its error and what a track costs and scatters by, as a pointer reads them.

    >>> told(Row("series-21", "", "series-model", order=21, relative_rms_error=1e-5), Reference("", 0.0, 1.8e-4), 3e-3)
    '21 terms of the paper’s series: ≤ 0.018 %, 3 ms a track'
    """
    cost = f", {measured_time(cost_s, row.time_scatter)} a track" if math.isfinite(cost_s) else ""
    compiled = {"c": " in C", "python": " in Python"}.get(row.language or "", "") if row.kind == "expansion" else ""
    return f"{capital(spoken(row))}{compiled}: {at_most(row.relative_rms_error, reference, '≤ ')}{cost}"


def plural(row: Row) -> bool:
    """Whether a contender is spoken of as several."""
    return row.method.startswith("zero-crossing") or row.kind == "series-model"


def follow(row: Row) -> str:
    """The verb of a title."""
    return "follow" if plural(row) else "follows"


RESUMMED: Mapping[str, str] = {"pade": "Padé approximant", "map": "conformal map", "nome": "elliptic nome"}


def refused_names(rows: Sequence[Row]) -> str:
    """Contenders without a result, the orders of one kind together.

    >>> refused_names([Row(f"multiple-scales-{n}", "", "slow-flow", order=n) for n in (2, 4)])
    'multiple scales (orders 2 to 4)'
    """
    groups: dict[str, list[int]] = {}
    for row in rows:
        name = re.sub(r",?( of)? order \d+$| of degree \d+ in A²$", "", short_name(row))
        groups.setdefault(RESUMMED.get(name, name), []).extend([] if row.order is None else [row.order])
    return listing([f"{name}{_orders(orders)}" for name, orders in groups.items()])


def _orders(orders: Sequence[int]) -> str:
    if not orders:
        return ""
    low, high = min(orders), max(orders)
    return f" (order {low})" if low == high else f" (orders {low} to {high})"


def capital(text: str) -> str:
    """Text with a capital first letter, unless it starts with a symbol of one letter.

    >>> capital("order 20"), capital("")
    ('Order 20', '')
    """
    return text[:1].upper() + text[1:]


def multiple_of_pi(value: float, digits: int = 4) -> str:
    """A number, as a multiple of pi where it is a short one.

    >>> multiple_of_pi(0.95 * math.pi), multiple_of_pi(4 * math.pi), multiple_of_pi(0.01), multiple_of_pi(0.0)
    ('0.95 π', '4 π', '0.01', '0')
    """
    share = value / math.pi
    if share and abs(share - round(share, 3)) < 1e-9 * abs(share):
        return "π" if round(share, 3) == 1 else f"{round(share, 3):g} π".replace("-", "−")
    return f"{value:.{digits}g}".replace("-", "−")


def parameters_line(case: Case) -> str:
    """Parameters, start, duration and rate in one line."""
    values = ", ".join(f"{symbol(name)} = {multiple_of_pi(v)}" for name, v in case.parameters.items())
    return "; ".join(part for part in (values, start_line(case), sampled_line(case)) if part)


def start_line(case: Case) -> str:
    """How the motion starts."""
    u, v = case.initial
    unit = f" {case.unit}" if case.unit and "π" not in multiple_of_pi(u) else ""
    place = f"{multiple_of_pi(u)}{unit}"
    return f"released at rest from {place}" if v == 0 else f"from {case.symbol} = {place}, {case.symbol}′ = {v:.4g}"


def sampled_line(case: Case) -> str:
    """How long and how finely it is sampled."""
    unit = case.time_unit
    count = round(case.duration * case.rate) + 1
    if unit:
        return f"{case.duration:.6g} {unit} at {case.rate:.4g} samples per {unit}"
    return f"{count} samples over a time of {case.duration:.4g}"
