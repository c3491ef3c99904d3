"""The lines of a text, cut out of it when they are asked for: a large table costs little more memory than its text."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

COMMENTS = ("#", "%")
ENDS = ("\r\n", "\r", "\v", "\f", "\x1c", "\x1d", "\x1e", "\x85", "\u2028", "\u2029")
"""What ends a line beside a line feed, as in ``str.splitlines``."""
BLOCK = 65_536
"""Lines that are cut out at a time."""


@dataclass(frozen=True)
class Lines:
    r"""Some lines of a text.

    Parameters
    ----------
    text : str
        Lines end in a line feed.
    begin : array of int, shape (N,)
        Where each line begins, in characters.
    number : array of int, shape (N,)
        Its number in the file, from 1.

    Examples
    --------
    >>> lines, comments = lines_of("# t, u\n0,1\n\n1,2")
    >>> list(lines), lines.number.tolist(), comments
    (['0,1', '1,2'], [2, 4], ('# t, u',))
    """

    text: str
    begin: NDArray[np.int64]
    number: NDArray[np.int32]

    def __len__(self) -> int:
        return int(self.begin.size)

    def __getitem__(self, at: int) -> str:
        begin = int(self.begin[at])
        end = self.text.find("\n", begin)
        return self.text[begin : len(self.text) if end < 0 else end]

    def __iter__(self) -> Iterator[str]:
        for _, block in self.blocks():
            yield from block

    def blocks(self) -> Iterator[tuple[int, list[str]]]:
        """Some lines after the other, with the index of the first of them."""
        text, find, size = self.text, self.text.find, len(self.text)
        for first in range(0, len(self), BLOCK):
            begins = self.begin[first : first + BLOCK].tolist()
            ends = (find("\n", begin) for begin in begins)
            yield first, [text[b : size if e < 0 else e] for b, e in zip(begins, ends, strict=True)]

    def after(self, first: int) -> Lines:
        """The lines from one on."""
        return Lines(self.text, self.begin[first:], self.number[first:])

    @property
    def longest(self) -> int:
        """Characters that no line exceeds."""
        ends = np.append(self.begin, len(self.text))
        return int(np.diff(ends).max(initial=0))


def with_line_feeds(text: str) -> str:
    r"""The text with line feeds at the ends of its lines.

    >>> with_line_feeds("a\r\nb\rc")
    'a\nb\nc'
    """
    for mark in ENDS:
        if mark in text:
            text = text.replace(mark, "\n")
    return text


def lines_of(text: str, *, skip: int = 0) -> tuple[Lines, tuple[str, ...]]:
    """The lines that are neither empty nor a comment, after the first ``skip``; and the comments above them.

    The text has line feeds at the ends of its lines.
    """
    begins, numbers = array("q"), array("i")
    comments: list[str] = []
    begin, number, size, find = 0, 0, len(text), text.find
    while begin < size:
        end = find("\n", begin)
        end, number = (size if end < 0 else end), number + 1
        line = text[begin:end].lstrip()
        if line and number > skip:
            if not line.startswith(COMMENTS):
                begins.append(begin)
                numbers.append(number)
            elif not begins:
                comments.append(line)
        begin = end + 1
    return Lines(text, np.array(begins, dtype=np.int64), np.array(numbers, dtype=np.int32)), tuple(comments)
