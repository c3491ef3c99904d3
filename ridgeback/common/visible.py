"""Text of a user as a terminal, a table and a page may show it: nothing in it acts."""

from __future__ import annotations

import re

# Control characters but the tab and the line end, the marks that turn the direction of writing, line separators, and
# what is no character at all, which no UTF-8 and no XML file may hold.
ACTING = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]|\r(?!\n)"
)
NUMERIC = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?(/\d+)?|-", re.ASCII)
FORMULA = ("=", "+", "-", "@", "\t", "\r")


def visible(text: str) -> str:
    r"""The text with every character that acts on a terminal or turns the writing round written as its escape.

    >>> visible("a\x1b[31m\u202eb\n")
    'a\\x1b[31m\\u202eb\n'
    """
    return ACTING.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


def no_formula(text: str) -> str:
    """The text with a quotation mark before what a spreadsheet would take for a formula; numbers stay numbers.

    >>> no_formula("=HYPERLINK(1)"), no_formula("-1/16"), no_formula("+1.5e-3"), no_formula("u")
    ("'=HYPERLINK(1)", '-1/16', '+1.5e-3', 'u')
    """
    return f"'{text}" if text.startswith(FORMULA) and not NUMERIC.fullmatch(text) else text
