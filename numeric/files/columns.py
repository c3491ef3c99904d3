"""What every reader of a file hands over: named columns, read when they are asked for."""

from __future__ import annotations

import struct
import tokenize
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass

from ridgeback.numeric.arrays import Array

FILE_BUDGET = 1_000_000_000
"""Bytes that a file, unpacked, may hold."""
DAMAGE = (
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    ArithmeticError,
    RuntimeError,
    OSError,
    MemoryError,
    EOFError,
    SyntaxError,
    SystemError,
    UnboundLocalError,
    struct.error,
    zlib.error,
    tokenize.TokenError,
    zipfile.BadZipFile,
)
"""What libraries raise on a file that is not what it says: it is a wrong file, whatever went wrong inside."""


def first_line(error: BaseException) -> str:
    """The error's own words, on one line."""
    return " ".join(str(error).split()) or type(error).__name__


@dataclass(frozen=True)
class Columns:
    """Named columns of a file, ``sizes`` rows each; ``rate`` is what the file itself states, else None.

    ``values(i)`` gives the numbers of column i, missing ones as NaN; ``place(row)`` says where a row is.  ``hinted`` is
    whether something stands above columns without names that may say what they are, and was not understood;
    ``words`` are the columns that hold no numbers, ``stamps`` those of dates and times of day, as seconds from the
    first.
    """

    names: tuple[str, ...]
    sizes: tuple[int, ...]
    values: Callable[[int], Array]
    place: Callable[[int], str]
    source: str
    rate: float | None = None
    units: str = ""
    note: str = ""
    hinted: bool = False
    words: tuple[int, ...] = ()
    stamps: tuple[int, ...] = ()
