"""CSV as every table of the project is written: one header line, empty cells for nothing, floats with every digit."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence

from ridgeback.common.visible import no_formula


def cell(value: object) -> str:
    """A value for CSV: floats with every digit they need to be read back the same, nothing for a missing one.

    Text that a spreadsheet would take for a formula is quoted.

    >>> cell(0.1), cell(None), cell(float("nan")), cell(True), cell(3)
    ('0.1', '', '', 'true', '3')
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(float(value)) if math.isfinite(value) else ""
    return no_formula(str(value)) if isinstance(value, str) else str(value)


def csv_text(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    r"""A header line and one line per row, each ended by ``\n``.

    >>> csv_text(["a", "b"], [[0.1, None]])
    'a,b\n0.1,\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(no_formula, header))
    writer.writerows([cell(value) for value in row] for row in rows)
    return text.getvalue()
