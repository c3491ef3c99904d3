"""What the lines above the numbers of a table say: the names of its columns and their units."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from ridgeback.numeric.files.column_names import SECONDS, is_time
from ridgeback.numeric.files.tables.cells import BLANKS, DELIMITERS, GAPS, cells_in, is_value
from ridgeback.numeric.files.tables.lines import COMMENTS

MOST_HEADS = 4
"""Lines above the numbers that may be names, what they are of, and units."""
LONGEST_UNIT = 12
UNIT = re.compile(r"[(\[][^()\[\]]*[)\]]|[^\s:=]*")
WORDS = re.compile(r"[^\W\d_]+")
OTHER_TIMES = frozenset(word for word, length in SECONDS.items() if length != 1.0 and word not in ("d", "h", "min"))
"""Words for units of time other than the second."""


def is_unit(cell: str) -> bool:
    """Whether a cell may be a unit: short, and without a blank unless it stands in brackets.

    >>> is_unit("mm"), is_unit("(s)"), is_unit(""), is_unit("sensor A"), is_unit("u [mm]"), is_unit("1.5")
    (True, True, True, False, False, False)
    """
    if cell and is_value(cell) and cell != "-":
        return False
    return len(cell) <= LONGEST_UNIT and UNIT.fullmatch(cell) is not None


def heading(heads: Sequence[Sequence[str]], places: Sequence[int]) -> tuple[tuple[str, ...], int]:
    """The names of the columns at ``places`` from the lines above the numbers, and how many of the lines they are.

    The last of them may hold the units; above it names the line that has a time, else the nearest.

    >>> heading([["made by X"], ["t", "u"]], (0, 1)), heading([["t", "u"], ["s", "mm"]], (0, 1))
    ((('t', 'u'), 1), (('t [s]', 'u [mm]'), 2))
    >>> heading([["X"]], (0, 1)), heading([["t", "u"], ["sensor A", "sensor B"], ["(s)", "(mm)"]], (0, 1))
    (((), 0), (('t [s]', 'u [mm]'), 3))
    """
    fitting = []
    for head in reversed(heads):
        if len(head) <= max(places):
            break
        fitting.append([head[i].strip() for i in places])
    if not fitting:
        return (), 0
    units = fitting[0] if len(fitting) > 1 and are_units(fitting[0], fitting[1]) else None
    lines = fitting if units is None else fitting[1:]
    chosen = next((at for at, line in enumerate(lines) if any(map(is_time, line))), 0)
    used = chosen + (1 if units is None else 2)
    if units is None:
        above = lines[chosen + 1] if len(lines) > chosen + 1 else None
        if above and any(map(is_bracketed, lines[chosen])):
            return tuple(map(completed, lines[chosen], above)), used + 1
        return tuple(lines[chosen]), used
    bare = [unit.strip("[]()") for unit in units]
    return tuple(f"{name} [{unit}]" if unit else name for name, unit in zip(lines[chosen], bare, strict=True)), used


def is_bracketed(cell: str) -> bool:
    """Whether a cell is a unit in brackets, without a name.

    >>> is_bracketed("[mm]"), is_bracketed("u [mm]")
    (True, False)
    """
    return cell[:1] in ("(", "[") and UNIT.fullmatch(cell) is not None


def completed(cell: str, above: str) -> str:
    """A unit with the name above it; another cell as it is.

    >>> completed("[mm]", "u"), completed("t [s]", "Channel")
    ('u [mm]', 't [s]')
    """
    return f"{above} {cell}".strip() if is_bracketed(cell) else cell


def are_units(last: Sequence[str], above: Sequence[str]) -> bool:
    """Whether a line holds the units of the names above it.

    >>> are_units(["s", "mm"], ["t", "u"]), are_units(["t", "u"], ["Date:", "2026"]), are_units(["t", "u"], ["A", "B"])
    (True, False, False)
    """
    names = [name for name in above if name]
    if not all(map(is_unit, last)) or any(map(is_value, names)) or any(name.endswith(":") for name in names):
        return False
    return not any(map(is_time, last)) or any(map(is_time, above))


def commented(comments: Sequence[str], delimiter: str, width: int) -> tuple[str, ...]:
    """The names of the columns from the last comment above the numbers, where it has as many words.

    >>> commented(("% made by X", "% t, u"), " ", 2)
    ('t', 'u')
    >>> commented(("% Time (s)   w (mm), Point: 5",), " ", 2)
    ('Time (s)', 'w (mm), Point: 5')
    """
    text = comments[-1].lstrip("".join(COMMENTS)).strip() if comments else ""
    ways = [cells_in(text, between) for between in (delimiter, *reversed(DELIMITERS))]
    if delimiter == BLANKS:
        ways.insert(1, GAPS.split(text))
    for cells in ways:
        if len(cells) == width and not any(is_value(cell) or cell.endswith(",") for cell in cells):
            return tuple(cells)
    return ()


def may_say_times(comments: Iterable[str]) -> bool:
    """Whether comments name a unit of time other than the second.

    >>> may_say_times(["# time in ms"]), may_say_times(["# time in s"])
    (True, False)
    """
    return any(word.lower() in OTHER_TIMES for line in comments for word in WORDS.findall(line))


def left_out(lines: int) -> str:
    """How many lines before the table, in words; empty for none.

    >>> left_out(1), left_out(2)
    ('1 line before the table was left out.', '2 lines before the table were left out.')
    """
    what = "line before the table was" if lines == 1 else "lines before the table were"
    return f"{lines} {what} left out." if lines else ""


def empty_columns(names: Sequence[str]) -> str:
    """Which named columns hold nothing, in words.

    >>> empty_columns(["Start", ""]), empty_columns([""])
    ('Nothing stands in column Start, which was left out.', '')
    """
    named = [name for name in names if name]
    if not named:
        return ""
    which = "column" if len(named) == 1 else "columns"
    return f"Nothing stands in {which} {', '.join(named)}, which {'was' if len(named) == 1 else 'were'} left out."
