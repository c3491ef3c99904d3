"""One array of NumPy's own format, its header held against the bytes that there are; nothing pickled is read.

Source: NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays".
"""

from __future__ import annotations

import io
import math
import warnings
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.columns import DAMAGE, first_line


def array_of(data: bytes, place: str) -> NDArray[Any]:
    """The array of an NPY file.

    Raises InputError for objects, for a damaged header, and for fewer bytes than the shape needs.
    """
    stream = io.BytesIO(data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of headers that a version 2 of Python wrote
            shape, fortran, dtype = header(stream)
    except DAMAGE as error:
        raise InputError(f"{place} is not an NPY file of plain numbers: {first_line(error)}") from None
    if dtype.hasobject or dtype.itemsize == 0:
        raise InputError(f"{place} is not an NPY file of plain numbers: it holds objects ({dtype}), which are not read")
    size, left = math.prod(shape), len(data) - stream.tell()
    if min(shape, default=0) < 0 or size * dtype.itemsize > left:
        raise InputError(
            f"{place}, byte {stream.tell()}: an array of shape {shape} and type {dtype} needs {size * dtype.itemsize} "
            f"bytes, {left} are left; the file is damaged"
        )
    flat = np.frombuffer(data, dtype=dtype, count=size, offset=stream.tell())
    return flat.reshape(shape, order="F" if fortran else "C")


def header(stream: io.BytesIO) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, whether the first index runs fastest, and type."""
    version = npy.read_magic(stream)
    if version == (1, 0):
        return npy.read_array_header_1_0(stream)
    if version == (2, 0):
        return npy.read_array_header_2_0(stream)
    raise ValueError(f"version {version[0]}.{version[1]} is neither 1.0 nor 2.0")
