"""Rows of a result as a short table, in HTML and in LaTeX: the first and the last of them, and how many lie between."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

SHOWN = 8
"""Rows of a table that a notebook shows; the rest is counted."""
DIGITS = 6
Row = Mapping[str, Any]


def cell(value: object) -> str:
    """One entry of a table as it is read.

    >>> cell(0.123456789), cell(True), cell("a"), cell(float("nan"))
    ('0.123457', 'yes', 'a', '')
    """
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.{DIGITS}g}"
    text = str(value)
    return text if len(text) <= 40 else f"{text[:24]} ... {text[-8:]}"


def shortened(rows: Sequence[Row]) -> tuple[list[list[str]], int]:
    """The first and last rows as text, and how many lie between."""
    left_out = max(0, len(rows) - SHOWN)
    shown = rows if not left_out else [*rows[: SHOWN // 2], *rows[-SHOWN // 2 :]]
    return [[cell(value) for value in row.values()] for row in shown], left_out


def html_table(rows: Sequence[Row]) -> str:
    """A short HTML table, everything in it escaped.

    >>> html_table([{"a": 1, "b": "<x>"}])
    '<table><thead><tr><th>a</th><th>b</th></tr></thead><tbody><tr><td>1</td><td>&lt;x&gt;</td></tr></tbody></table>'
    """
    if not rows:
        return ""
    body, left_out = shortened(rows)
    lines = ["".join(f"<td>{escape(text)}</td>" for text in row) for row in body]
    if left_out:
        lines.insert(SHOWN // 2, f'<td colspan="{len(rows[0])}">... {left_out} more ...</td>')
    head = "".join(f"<th>{escape(name)}</th>" for name in rows[0])
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(f'<tr>{x}</tr>' for x in lines)}</tbody></table>"


def latex_table(rows: Sequence[Row]) -> str:
    r"""A short table in LaTeX, as text in an array that MathJax sets, too.

    >>> latex_table([{"a_1": 0.5}])
    '\\begin{array}{r}\\text{a\\_1}\\\\\\hline \\text{0.5}\\end{array}'
    """
    if not rows:
        return ""
    body, left_out = shortened(rows)
    lines = [" & ".join(f"\\text{{{protected(text)}}}" for text in row) for row in body]
    if left_out:
        lines.insert(SHOWN // 2, rf"\vdots \quad ({left_out})")
    head = " & ".join(f"\\text{{{protected(name)}}}" for name in rows[0])
    columns, text = "r" * len(rows[0]), r"\\".join(lines)
    return rf"\begin{{array}}{{{columns}}}{head}\\\hline {text}\end{{array}}"


SPECIAL = {
    **{mark: f"\\{mark}" for mark in "&%$#_{}"},
    "\\": r"\backslash ",
    "~": r"\sim ",
    "^": r"\wedge ",
}


def protected(text: str) -> str:
    """Text with the characters that LaTeX takes for commands made harmless."""
    return "".join(SPECIAL.get(character, character) for character in text)
