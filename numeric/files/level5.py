"""Variables of a MATLAB file of level 5 (v5 to v7), every length held against the bytes that there are.

The file is a row of elements, each a tag (type and length in bytes) and its data, padded to 8 bytes; a variable is an
element of elements: flags with its class, dimensions, name, then its numbers, or the fields of a structure.  Source:
MathWorks, MAT-File Format, "Level 5 MAT-File Format".
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.columns import FILE_BUDGET

HEADER = 128
"""Bytes of text, version and byte order before the first element."""
NUMBERS: Mapping[int, str] = MappingProxyType(
    {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
)
"""Types of data that are numbers."""
MATRIX, COMPRESSED = 14, 15
CLASSES: Mapping[int, str] = MappingProxyType(
    dict(
        enumerate(
            (
                *("cell", "struct", "object", "char", "sparse", "double", "single", "int8", "uint8", "int16"),
                *("uint16", "int32", "uint32", "int64", "uint64", "function", "opaque"),
            ),
            start=1,
        )
    )
)
STORED: Mapping[str, str] = MappingProxyType({"double": "f8", "single": "f4"})
"""Names of NumPy for the classes that it calls otherwise."""
COMPLEX_FLAG, LOGICAL_FLAG = 0x0800, 0x0200
MOST_AXES, DEEPEST = 32, 32


@dataclass(frozen=True)
class Element:
    """One tag with its data; ``place`` says in words where it stands."""

    kind: int
    data: memoryview
    place: str


@dataclass(frozen=True)
class Variable:
    """One array of the file: its class as MATLAB calls it, and the elements behind its name."""

    name: str
    kind: str
    shape: tuple[int, ...]
    complex: bool
    parts: tuple[Element, ...]
    order: str
    """``<`` or ``>``, of its bytes."""
    place: str

    @property
    def size(self) -> int:
        """How many numbers, or structures, it holds."""
        return math.prod(self.shape)

    @property
    def numeric(self) -> bool:
        """Whether it is a full array of numbers."""
        return self.kind in STORED or self.kind == "logical" or "int" in self.kind

    def values(self) -> NDArray[Any]:
        """The numbers, in the class that the file states."""
        stated = "u1" if self.kind == "logical" else STORED.get(self.kind, self.kind)
        if len(self.parts) < 1 + self.complex:
            raise InputError(f"{self.place}: {self.name} has no numbers; the file is damaged")
        flat = np.empty(self.size, dtype="c16" if self.complex else stated)
        with np.errstate(invalid="ignore"):  # damaged numbers, which say so by being none
            flat.real = numbers(self.parts[0], self.order, self.size).astype(stated)
            if self.complex:
                flat.imag = numbers(self.parts[1], self.order, self.size)
        return flat.reshape(self.shape, order="F")


def numbers(element: Element, order: str, size: int) -> NDArray[Any]:
    """The numbers of an element, exactly so many."""
    kind = NUMBERS.get(element.kind)
    if kind is None:
        raise InputError(f"{element.place}: data of type {element.kind} are no numbers; the file is damaged")
    dtype = np.dtype(order + kind)
    if len(element.data) != size * dtype.itemsize:
        raise InputError(
            f"{element.place}: {len(element.data)} bytes do not hold {size} numbers of {dtype.itemsize} bytes; "
            "the file is damaged"
        )
    return np.frombuffer(element.data, dtype=dtype)


def elements(data: memoryview, order: str, where: str, start: int = 0) -> Iterator[Element]:
    """The elements in a row of bytes; ``where`` and ``start`` say where the first of them stands."""
    at = 0
    while at < len(data):
        place = f"{where} byte {start + at}"
        if len(data) - at < 8:
            raise InputError(f"{place}: {len(data) - at} bytes are left where a tag has 8; the file is damaged")
        first, second = (int(value) for value in np.frombuffer(data[at : at + 8], dtype=f"{order}u4"))
        small = first >> 16
        kind, length, begin = (first & 0xFFFF, small, at + 4) if small else (first, second, at + 8)
        if length > (4 if small else len(data) - begin):
            raise InputError(
                f"{place}: {length} bytes are announced, {len(data) - begin} are left; the file is damaged"
            )
        yield Element(kind, data[begin : begin + length], place)
        padding = 0 if kind == COMPRESSED else -length % 8
        at = at + 8 if small else begin + length + padding


def variables(data: bytes, source: str) -> Iterator[Variable]:
    """Every variable of a file of level 5."""
    order = {b"IM": "<", b"MI": ">"}.get(data[126:HEADER])
    if order is None:
        raise InputError(f"{source} is not a readable MATLAB file: bytes 126 and 127 are not those of a MAT file")
    left = FILE_BUDGET
    for element in elements(memoryview(data)[HEADER:], order, f"{source},", HEADER):
        inner = element
        if element.kind == COMPRESSED:
            inner = unpacked(element, order, left)
            left -= len(inner.data)
        if inner.kind != MATRIX:
            raise InputError(f"{element.place}: type {inner.kind} where a variable should begin; the file is damaged")
        yield variable(inner, order)


def unpacked(element: Element, order: str, at_most: int) -> Element:
    """The one element in a compressed one."""
    try:
        data = zlib.decompressobj().decompress(element.data, at_most + 1)
    except zlib.error as error:
        raise InputError(f"{element.place}: cannot be unpacked ({error}); the file is damaged") from None
    if len(data) > at_most:
        raise InputError(
            f"{element.place}: unpacks to more than {FILE_BUDGET / 1e6:g} MB; cut the recording into parts"
        )
    found = next(elements(memoryview(data), order, f"{element.place}, unpacked"), None)
    if found is None:
        raise InputError(f"{element.place}: unpacks to nothing; the file is damaged")
    return found


def variable(element: Element, order: str, name: str | None = None) -> Variable:
    """A variable of its element; a field of a structure has its name from there."""
    if not element.data:
        return Variable(name or "", "empty", (0,), False, (), order, element.place)
    flags, *rest = elements(element.data, order, f"{element.place},")
    word = int(numbers(flags, order, 2)[0])
    kind = CLASSES.get(word & 0xFF)
    if kind is None:
        raise InputError(f"{element.place}: class {word & 0xFF} is unknown; the file is damaged")
    if kind == "opaque":  # an object of a newer kind: its elements are names, not dimensions
        return Variable(name or text(rest[0]) if rest else "", kind, (1,), False, (), order, element.place)
    if len(rest) < 2:
        raise InputError(f"{element.place}: no dimensions or no name; the file is damaged")
    axes = numbers(rest[0], order, len(rest[0].data) // 4)
    shape = tuple(int(size) for size in axes)
    if not 0 < len(shape) <= MOST_AXES or min(shape) < 0:
        raise InputError(f"{element.place}: the dimensions {shape} are none; the file is damaged")
    kind = "logical" if word & LOGICAL_FLAG else kind
    parts = tuple(rest[2:])
    return Variable(name or text(rest[1]), kind, shape, bool(word & COMPLEX_FLAG), parts, order, element.place)


def text(element: Element) -> str:
    """A name, up to its first null character."""
    return bytes(element.data).partition(b"\0")[0].decode("utf-8", "replace")


def fields(structure: Variable) -> Iterator[Variable]:
    """The fields of a single structure."""
    if len(structure.parts) < 2:
        raise InputError(f"{structure.place}: structure {structure.name} has no field names; the file is damaged")
    width = int(numbers(structure.parts[0], structure.order, 1)[0])
    block = bytes(structure.parts[1].data)
    if width <= 0 or len(block) % width or len(structure.parts) - 2 != len(block) // width:
        raise InputError(
            f"{structure.place}: structure {structure.name} has {len(structure.parts) - 2} fields and names of "
            f"{len(block)} bytes in steps of {width}; the file is damaged"
        )
    for i, part in enumerate(structure.parts[2:]):
        name = block[i * width : (i + 1) * width].partition(b"\0")[0].decode("utf-8", "replace")
        if part.kind != MATRIX:
            raise InputError(f"{part.place}: field {name} has type {part.kind}; the file is damaged")
        yield variable(part, structure.order, name)


def flattened(found: Variable, prefix: str = "", depth: int = 0) -> Iterator[tuple[str, Variable]]:
    """A variable under its name; a single structure as its fields, under dotted names."""
    name = f"{prefix}.{found.name}" if prefix else found.name
    if depth > DEEPEST:
        raise InputError(f"{found.place}: structures are nested deeper than {DEEPEST}; flatten the recording")
    if found.kind != "struct" or found.size != 1:
        yield name, found
        return
    for part in fields(found):
        yield from flattened(part, name, depth + 1)
