"""Matrices of a MATLAB file of level 4, every length held against the bytes that there are.

Each matrix is five integers (type, rows, columns, whether it is complex, length of the name), the name, and its numbers
column by column.  Source: MathWorks, MAT-File Format, "Level 4 MAT-File Format".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import Stored, held

BYTES: Mapping[str, Literal["little", "big"]] = MappingProxyType({"<": "little", ">": "big"})
KINDS = ("f8", "f4", "i4", "i2", "u2", "u1")
FULL = 0


def matrices(data: bytes, source: str) -> Iterator[Stored]:
    """Every full matrix of numbers; text and sparse ones are passed over."""
    at = 0
    while at < len(data):
        place = f"{source}, byte {at}"
        order, kind, form = code(data[at : at + 4], place)
        if len(data) < at + 20:
            raise InputError(f"{place}: the file ends within the head of a matrix; it is damaged")
        head = np.frombuffer(data[at + 4 : at + 20], dtype=f"{order}i4")
        rows, columns, imaginary, length = (int(value) for value in head)
        size, parts = rows * columns, 2 if imaginary else 1
        begin = at + 20 + length
        end = begin + parts * size * np.dtype(kind).itemsize
        if min(rows, columns) < 0 or length < 1 or imaginary not in (0, 1) or end > len(data):
            raise InputError(
                f"{place}: a matrix of {rows} x {columns} ends at byte {end} of {len(data)}; the file is damaged"
            )
        if form == FULL:
            name = data[at + 20 : begin].partition(b"\0")[0].decode("utf-8", "replace")
            yield held(name, matrix(np.frombuffer(data[begin:end], dtype=order + kind), (rows, columns), parts))
        at = end


def code(data: bytes, place: str) -> tuple[str, str, int]:
    """Byte order, type of the numbers and form (0: a full matrix) from the type's four decimal digits."""
    for order in "<>":
        machine, zero, kind, form = (int(digit) for digit in f"{int.from_bytes(data, BYTES[order]):04d}"[-4:])
        known = machine == "<>".index(order) and zero == 0 and kind < len(KINDS) and form < 3
        if len(data) == 4 and known and int.from_bytes(data, BYTES[order]) < 5000:
            return order, KINDS[kind], form
    raise InputError(f"{place}: no matrix begins here; the file is damaged or not of MATLAB")


def matrix(flat: NDArray[np.generic], shape: tuple[int, int], parts: int) -> NDArray[np.generic]:
    """The matrix of its numbers, the imaginary ones behind the real ones."""
    if parts == 1:
        return flat.reshape(shape, order="F")
    real, imaginary = flat.astype(np.float64).reshape(2, -1)
    return np.asarray((real + 1j * imaginary).reshape(shape, order="F"))
