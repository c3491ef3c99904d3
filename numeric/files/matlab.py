"""Columns of a MATLAB file: v4 to v7 by scipy, v7.3 (which is HDF5) by h5py; numbers only, nothing is executed.

Only variables of a numeric class, and structures, are loaded at all: function handles, objects and cells stay unread.
"""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.io import loadmat, whosmat
from scipy.io.matlab import MatReadError

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import from_arrays, in_memory
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.files.hdf5 import SIGNATURE, first_line, from_hdf5
from ridgeback.numeric.signal.samples import checked_budget

NUMERIC = frozenset(
    [
        *("double", "single", "logical"),
        *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
    ]
)
DAMAGE = (
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    OverflowError,
    NotImplementedError,
    RecursionError,
    OSError,
    MemoryError,
    EOFError,
    struct.error,
    zlib.error,
    MatReadError,
)
"""What scipy raises on a file that is not what it says: it is a wrong file, whatever went wrong inside."""


def from_mat(data: bytes, source: str) -> Columns:
    """Columns of all real vectors and matrices, those in structures under dotted names.

    Raises InputError for a damaged file or one without numbers, OSError for v7.3 without h5py.
    """
    if SIGNATURE in (data[:8], data[512:520]):
        return from_hdf5(data, source)
    try:
        kinds = {name: kind for name, _, kind in listed(data)}
        wanted = [name for name, kind in kinds.items() if kind in NUMERIC or kind == "struct"]
        needed = sum(8 * int(np.prod(shape, dtype=float)) for name, shape, _ in listed(data) if name in wanted)
        checked_budget(needed, FILE_BUDGET, f"{source} unpacked", "cut the recording into parts")
        arrays = dict(flattened("", loaded(data, wanted) if wanted else {}))
    except InputError:
        raise
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable MATLAB file: {first_line(error)}") from None
    unread = [f"{name} ({kind})" for name, kind in kinds.items() if name not in wanted]
    note = f"Not read, because it holds no plain numbers: {', '.join(unread)}." if unread else ""
    return from_arrays(in_memory(arrays), source, kind="MATLAB file", note=note)


def listed(data: bytes) -> list[tuple[str, tuple[int, ...], str]]:
    """Name, shape and class of each variable, without reading its values."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stream: Any = io.BytesIO(data)  # scipy's types know paths only, its functions take open files too
        return list(whosmat(stream))


def loaded(data: bytes, names: list[str]) -> Mapping[str, Any]:
    """The variables of these names, structures as dictionaries."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stream: Any = io.BytesIO(data)
        found: Mapping[str, Any] = loadmat(stream, variable_names=names, simplify_cells=True)
    return {name: value for name, value in found.items() if not name.startswith("__")}


def flattened(prefix: str, tree: Mapping[str, Any]) -> Iterator[tuple[str, NDArray[Any]]]:
    """Plain numeric arrays of a tree of dictionaries, under dotted names.

    >>> [name for name, _ in flattened("", {"run": {"x": np.zeros(3), "label": "a"}, "fs": 8.0})]
    ['run.x', 'fs']
    """
    for key, value in tree.items():
        name = f"{prefix}.{key}" if prefix else str(key)
        if isinstance(value, Mapping):
            yield from flattened(name, value)
        elif isinstance(value, (np.ndarray, np.number, int, float)):
            array = np.asarray(value)
            if array.dtype.kind in "biufc":
                yield name, array
