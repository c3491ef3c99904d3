"""Named arrays of a file (NPZ, MAT, HDF5) as columns: vectors as they are, matrices column by column."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.signal.samples import checked_budget

RATE_NAMES = ("rate", "fs", "sr", "sampling_rate", "sample_rate", "samplerate", "sampling_frequency")
STEP_NAMES = ("dt", "ts", "time_step", "timestep", "sampling_interval")
REAL = "biuf"
MOST_COLUMNS = 4096
KEPT = 100_000_000
"""Bytes up to which a matrix is kept once it is read, for its other columns."""


@dataclass(frozen=True)
class Stored:
    """One array of a file; ``load`` reads it."""

    name: str
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    load: Callable[[], NDArray[Any]]

    @property
    def real(self) -> bool:
        """Whether it holds real numbers."""
        return self.dtype.kind in REAL

    @property
    def lengths(self) -> tuple[int, ...]:
        """The sizes of its axes other than 1."""
        return tuple(size for size in self.shape if size != 1)


@dataclass(frozen=True)
class Lane:
    """One column: which array it is of, and its place across it (None for a vector)."""

    array: Stored
    place: int | None

    @property
    def name(self) -> str:
        """The array's name, numbered from 1 when the array holds several columns."""
        return self.array.name if self.place is None else f"{self.array.name}[{self.place + 1}]"

    @property
    def size(self) -> int:
        """The number of samples."""
        return max(self.array.shape)

    def values(self) -> Array:
        """The numbers, read now."""
        needed = math.prod(self.array.shape) * max(8, self.array.dtype.itemsize)
        checked_budget(needed, FILE_BUDGET, f"{self.array.name} in memory", "store the recording in smaller arrays")
        with np.errstate(invalid="ignore", over="ignore"):  # damaged numbers, which are none in the result either
            matrix = np.asarray(self.array.load(), dtype=np.float64)
        if self.place is None:
            return matrix.reshape(-1)
        flat = matrix.reshape(self.array.lengths)
        return np.array(flat[:, self.place] if flat.shape[0] >= flat.shape[1] else flat[self.place])


def in_memory(arrays: Mapping[str, NDArray[Any]]) -> tuple[Stored, ...]:
    """Arrays that are already read."""
    return tuple(held(name, array) for name, array in arrays.items())


def held(name: str, array: NDArray[Any]) -> Stored:
    """An array that is already read."""
    return Stored(name, array.shape, array.dtype, lambda: array)


# Samples outnumber channels: the longer axis is time.  A square matrix is read as columns.
def lanes_of(stored: Stored) -> list[Lane]:
    """The columns that a real array of one or two axes longer than 1 holds.

    >>> wide = Stored("x", (2, 9), np.dtype(float), lambda: np.zeros((2, 9)))
    >>> [(lane.name, lane.size) for lane in lanes_of(wide)]
    [('x[1]', 9), ('x[2]', 9)]
    """
    if len(stored.lengths) == 1:
        return [Lane(stored, None)]
    if len(stored.lengths) == 2 and min(stored.lengths) <= MOST_COLUMNS:
        small = 8 * math.prod(stored.shape) <= KEPT
        kept = replace(stored, load=lru_cache(maxsize=1)(stored.load)) if small else stored
        return [Lane(kept, i) for i in range(min(stored.lengths))]
    return []


def stated_rate(arrays: Iterable[Stored]) -> float | None:
    """Samples per time unit that a lone number with a telling name states, else None.

    >>> stated_rate(in_memory({"dt": np.array([[0.25]])}))
    4.0
    """
    for array in arrays:
        word = array.name.rpartition("/")[2].rpartition(".")[2].lower()
        if not array.real or math.prod(array.shape) != 1 or word not in (*RATE_NAMES, *STEP_NAMES):
            continue
        value = float(np.asarray(array.load()).reshape(-1)[0])
        if math.isfinite(value) and value > 0.0:
            return value if word in RATE_NAMES else 1.0 / value
    return None


def from_arrays(arrays: Iterable[Stored], source: str, *, kind: str, note: str = "") -> Columns:
    """Columns of all real vectors and matrices; raises InputError when there is none, saying what there is."""
    everything = tuple(arrays)
    lanes = [lane for array in everything if array.real for lane in lanes_of(array)]
    if not lanes:
        found = ", ".join(f"{a.name} {a.dtype}{list(a.shape)}" for a in everything[:20]) or "nothing"
        raise InputError(f"{source}: the {kind} holds no real array of one or two axes; it has {found}. {note}".strip())
    return Columns(
        names=tuple(lane.name for lane in lanes),
        sizes=tuple(lane.size for lane in lanes),
        values=lambda i: lanes[i].values(),
        place=lambda row: f"index {row}",
        source=source,
        rate=stated_rate(everything),
        note=note,
    )
