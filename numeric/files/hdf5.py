"""Columns of an HDF5 file, also of MATLAB's v7.3, by h5py: real datasets only, read when asked for.

Nothing outside the file is followed: h5py's visitor skips soft and external links, and datasets whose values lie in
other files (external storage, virtual datasets) are left out.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import RATE_NAMES, STEP_NAMES, Stored, from_arrays, held
from ridgeback.numeric.files.columns import DAMAGE, Columns, first_line

if TYPE_CHECKING:
    import h5py

SIGNATURE = b"\x89HDF\r\n\x1a\n"
UNIT_NAMES = ("units", "unit")
MATLAB_INTERNALS = ("#refs#", "#subsystem#")


def from_hdf5(data: bytes, source: str) -> Columns:
    """Columns of all real datasets of one or two axes.

    An attribute ``units`` of a dataset is its unit; ``rate``, ``fs``, ``dt``, ... of a dataset or of the file, or a
    scalar dataset of that name, is the sampling rate.  Raises OSError without h5py, InputError for a damaged file.
    """
    h5py = library(source)
    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            stored = tuple(datasets(file, data, source))
    except InputError:
        raise
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable HDF5 file: {first_line(error)}") from None
    return from_arrays(stored, source, kind="HDF5 file")


def library(source: str) -> Any:
    """The module h5py, or an OSError that says how to get it."""
    try:
        import h5py  # noqa: PLC0415 - two tenths of a second that only HDF5 files should cost
    except ImportError:
        raise OSError(
            f"reading {source} needs h5py, which is not installed; pip install 'ridgeback[hdf5]' brings it"
        ) from None
    return h5py


def datasets(file: h5py.File, data: bytes, source: str) -> Iterator[Stored]:
    """Every dataset that holds its own values, with its unit in its name, and numbers that attributes state."""
    found: list[Any] = []
    kind = library(source).Dataset
    file.visititems(lambda _, item: found.append(item))
    yield from attribute_numbers(file)
    for group in (item for item in found if not isinstance(item, kind)):
        yield from attribute_numbers(group)
    for item in (item for item in found if isinstance(item, kind)):
        path = str(item.name).lstrip("/")
        if path.startswith(MATLAB_INTERNALS) or item.external or item.is_virtual or item.shape is None:
            continue
        yield from attribute_numbers(item)
        units = unit_of(item)
        name = f"{path} [{units}]" if units else path
        yield Stored(name, item.shape, item.dtype, partial(read, data, path, source))


def read(data: bytes, path: str, source: str) -> NDArray[Any]:
    """The values of one dataset."""
    try:
        with library(source).File(io.BytesIO(data), "r") as file:
            return np.asarray(file[path][()])
    except DAMAGE as error:
        raise InputError(f"{source}, dataset {path} cannot be read: {first_line(error)}") from None


def unit_of(item: h5py.Dataset) -> str:
    """The unit that an attribute states, else nothing."""
    for name in UNIT_NAMES:
        value = item.attrs.get(name)
        word = value.decode("utf-8", "replace") if isinstance(value, bytes) else value
        if isinstance(word, str) and word.strip():
            return word.strip()
    return ""


def attribute_numbers(item: h5py.Dataset | h5py.Group) -> Iterator[Stored]:
    """A sampling rate or step among the attributes, however its words are joined, as a scalar array of that name."""
    known = {name.replace("_", ""): name for name in (*RATE_NAMES, *STEP_NAMES)}
    for spelled in item.attrs:
        name = known.get(str(spelled).lower().replace("_", "").replace(" ", ""))
        if name is not None:
            value = np.asarray(item.attrs[spelled])
            if value.dtype.kind in "iuf" and math.prod(value.shape) == 1:
                yield held(name, value)
