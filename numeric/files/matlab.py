"""Columns of a MATLAB file: v4 to v7 read here, v7.3 (which is HDF5) by h5py; numbers only, nothing is executed.

Function handles, objects, cells and text stay unread.
"""

from __future__ import annotations

import math

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import Stored, from_arrays
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.files.hdf5 import SIGNATURE, from_hdf5
from ridgeback.numeric.files.level4 import matrices
from ridgeback.numeric.files.level5 import STORED, Variable, flattened, variables
from ridgeback.numeric.signal.samples import checked_budget


def from_mat(data: bytes, source: str) -> Columns:
    """Columns of all real vectors and matrices, those in structures under dotted names.

    Raises InputError for a damaged file, with the place, or one without numbers; OSError for v7.3 without h5py.
    """
    if SIGNATURE in (data[:8], data[512:520]):
        return from_hdf5(data, source)
    if len(data) < 20:
        raise InputError(f"{source} is not a readable MATLAB file: it has {len(data)} bytes")
    if 0 in data[:4]:
        return from_arrays(tuple(matrices(data, source)), source, kind="MATLAB file")
    found = [pair for variable in variables(data, source) if variable.name for pair in flattened(variable)]
    needed = sum(8 * math.prod(one.shape) for _, one in found if one.numeric)
    checked_budget(needed, FILE_BUDGET, f"{source} unpacked", "cut the recording into parts")
    unread = [f"{name} ({one.kind})" for name, one in found if not one.numeric and one.kind != "empty"]
    note = f"Not read, because it holds no plain numbers: {', '.join(unread)}." if unread else ""
    arrays = tuple(stored(name, one) for name, one in found if one.numeric)
    for array in arrays:
        array.load()  # damage is named before anything is chosen
    return from_arrays(arrays, source, kind="MATLAB file", note=note)


def stored(name: str, one: Variable) -> Stored:
    """An array that is read when asked for."""
    kind = "u1" if one.kind == "logical" else STORED.get(one.kind, one.kind)
    return Stored(name, one.shape, np.dtype("c16" if one.complex else kind), one.values)
