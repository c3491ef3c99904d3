"""On which line of a TOML file a key stands: the parser gives values alone, and a message should name the place."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

HEADER = re.compile(r"\s*(\[\[?)\s*([A-Za-z0-9_.\-\s]+?)\s*\]\]?\s*(?:#.*)?$")
ENTRY = re.compile(r"\s*([A-Za-z0-9_\-]+(?:\s*\.\s*[A-Za-z0-9_\-]+)*)\s*=")
QUOTES = ('"""', "'''")


def line_of(text: str, path: str) -> int | None:
    r"""The line, from 1, of the key ``path``, of the nearest key above it, or of its table; None when none is there.

    Parameters
    ----------
    text : str
        The file.
    path : str
        Names with points between; tables of an array are counted from 1, as in ``oscillator.2.system``.

    Examples
    --------
    >>> text = "[study]\nask = 1\n[[oscillator]]\nsystem = 2\n[[oscillator]]\nsystem = 3"
    >>> line_of(text, "study.ask"), line_of(text, "oscillator.2.system"), line_of(text, "oscillator.2.parameters.mu")
    (2, 6, 5)
    >>> line_of(text, "grid") is None
    True
    """
    places = dict(reversed(list(keys(text))))
    while path:
        if path in places:
            return places[path]
        path = path.rpartition(".")[0]
    return None


def keys(text: str) -> Iterator[tuple[str, int]]:
    """Every header and key of a TOML text by its whole path, with its line."""
    table, counts, inside = "", Counter[str](), ""
    for number, line in enumerate(text.splitlines(), start=1):
        if inside:
            inside = "" if inside in line else inside
            continue
        if found := HEADER.match(line):
            name = re.sub(r"\s", "", found[2])
            array = found[1] == "[["
            counts[name] += array
            table = f"{name}.{counts[name]}" if array else below(name, counts)
            yield table, number
        elif found := ENTRY.match(line):
            yield ".".join(part for part in (table, re.sub(r"\s", "", found[1])) if part), number
        inside = next((quote for quote in QUOTES if line.count(quote) % 2), "")


def below(name: str, counts: Counter[str]) -> str:
    """The path of a table that may lie below the last table of an array.

    >>> below("oscillator.parameters", Counter({"oscillator": 2}))
    'oscillator.2.parameters'
    """
    head, _, rest = name.partition(".")
    return f"{head}.{counts[head]}.{rest}" if rest and counts[head] else name
