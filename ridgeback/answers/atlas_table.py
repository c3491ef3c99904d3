"""``study --atlas``: the charts of the catalogue as text, JSON, CSV and Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ridgeback.console.output import json_text, write_text
from ridgeback.console.tables import aligned, csv_text

if TYPE_CHECKING:
    from ridgeback.compare.study.atlas import Chart, Inside

COLUMNS = ("system", "variable", "radius", "uncertainty", "singularity", "share", "place", "order", "relative_error")
INTRODUCTION = """\
# An atlas of oscillators

For each oscillator of the catalogue (`ridgeback systems`): the radius of convergence of its series for the fundamental
frequency in the peak amplitude A (of a limit cycle in eps), the place and the kind of the nearest singularity, and the
relative error of the series, truncated after the order that heads the column, at half and at nine tenths of the radius.
Radii and places are estimated from the last of 48 to 96 coefficients, with the uncertainty that neighbouring estimates
show; where none is printed it is below the last digit. Errors are proved: the series is held against an enclosure of
the exact frequency in ball arithmetic, by the energy, by validated integration, or by interval Newton (limit cycles).
Of a force with a kink at rest (`abs`, `max`) the series is put together from the energy on each side, and its radius is
that of the nearest singularity of either side's force, continued through rest. Of a force that is a power of |u| omega0
is one power of A, which is all: nothing limits it, and no order is missing.
Made by `ridgeback study --atlas --orders {orders} --format markdown`.
"""


def atlas_verb(orders: Sequence[int] | None, *, style: str, output: str) -> None:
    """Chart the catalogue, in the form asked for."""
    from ridgeback.compare.study.atlas import ORDERS, atlas

    charts = atlas(orders=orders or ORDERS)
    if style == "json":
        write_text(output, json_text([chart.to_dict() for chart in charts]))
    elif style == "csv":
        write_text(output, csv_text(COLUMNS, [row for chart in charts for row in cells(chart)]))
    elif style == "markdown":
        write_text(output, markdown(charts))
    else:
        columns = ["system", "radius", "nearest singularity", *_heads(charts)]
        write_text(output, aligned(columns, [dict(zip(columns, _line(chart), strict=True)) for chart in charts]) + "\n")


def cells(chart: Chart) -> list[dict[str, object]]:
    """One row per share of the radius and order."""
    found = chart.limits
    public: dict[str, object] = {"system": chart.system}
    if found is not None:
        public |= {"variable": found.variable, "radius": found.radius, "uncertainty": found.uncertainty}
        public["singularity"] = found.nearest
    rows: list[dict[str, object]] = [
        {**public, "share": str(item.share), "place": float(item.place), "order": order, "relative_error": error}
        for item in chart.inside
        for order, error in zip(chart.orders, item.errors, strict=True)
    ]
    return rows or [public]


def markdown(charts: Sequence[Chart]) -> str:
    """The atlas as a page."""
    orders = ",".join(str(order) for order in (charts[0].orders if charts else ()))
    heads = ["oscillator", "radius", "nearest singularity", *_heads(charts)]
    table = [heads, ["---"] * len(heads), *(_line(chart) for chart in charts)]
    lines = ["| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in table]
    equations = [
        f"- **{chart.system}**: `{chart.equation}`" + (f"; omega0 = `{chart.exact}`" if chart.exact else "")
        for chart in charts
    ]
    parts = [INTRODUCTION.format(orders=orders), "\n".join(lines), "## The equations", "\n".join(equations)]
    return "\n\n".join(part.rstrip() for part in parts) + "\n"


def _heads(charts: Sequence[Chart]) -> list[str]:
    shares = next(([item.share for item in chart.inside] for chart in charts if chart.inside), [])
    return [f"{order} at {float(share):g} R" for share in shares for order in charts[0].orders]


def _line(chart: Chart) -> list[str]:
    """The cells of one oscillator; where no limit shows, why."""
    found = chart.limits
    errors = [_error(item, n) for item in chart.inside for n in range(len(chart.orders))]
    blank = [""] * (2 * len(chart.orders))
    if found is None or not found.circle:
        return [chart.system, "-", chart.why if found is None else _unlimited(found.why), *blank]
    return [chart.system, f"{found.variable}: {found.circle}", found.nearest, *errors]


def _unlimited(why: str) -> str:
    from ridgeback.symbolic.singularities.stripped import CONSTANT

    return "none: omega0 is constant" if why == CONSTANT else f"not known: {why}"


def _error(item: Inside, n: int) -> str:
    error = item.errors[n]
    return "-" if error is None else f"{error:.1e}"
