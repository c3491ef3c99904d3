"""Samples that are in memory already, as the columns that a reader of a file hands over.

Lists, NumPy and masked arrays, pandas Series and DataFrames, xarray DataArrays and Datasets.  A masked sample is a
missing one.  Neither pandas nor xarray is imported: who hands over such an object has imported it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.column_names import is_time
from ridgeback.numeric.files.columns import Columns

Samples: TypeAlias = Any
"""Whatever ``columns_of`` takes: the libraries of half of it may not be installed."""
Column: TypeAlias = tuple[str, Array]
SOURCE = "the samples"
UNNAMED = "x"


def is_a(x: object, library: str, kind: str) -> bool:
    """Whether ``x`` is an instance of a library's class, without importing the library.

    >>> is_a(np.zeros(1), "numpy", "ndarray"), is_a([1.0], "pandas", "Series")
    (True, False)
    """
    return any(c.__name__ == kind and c.__module__.partition(".")[0] == library for c in type(x).__mro__)


def numbers(x: Samples, name: str) -> Array:
    """One column as float64, missing samples as NaN; dates become seconds after the first.

    Raises InputError for what is not a one-dimensional column of real numbers.

    >>> numbers(np.ma.masked_greater([1.0, 9.0, 2.0], 5.0), "u")
    array([ 1., nan,  2.])
    >>> numbers([1, None, 3], "u")
    array([ 1., nan,  3.])
    >>> numbers(np.array(["2026-01-01T00:00:00", "2026-01-01T00:00:01.5"], "datetime64[ms]"), "t")
    array([0. , 1.5])
    """
    raw = plain(x)
    if raw.ndim != 1:
        if not raw.shape:
            raise InputError(f"{name} is {type(x).__name__}, not samples; give a sequence of numbers, or a file's path")
        raise InputError(f"{name} has shape {raw.shape}; give one column, such as x[:, 0], or name it by column=")
    if raw.dtype.kind in "mM":
        return seconds(raw)
    if raw.dtype.kind == "c":
        raise InputError(f"{name} is complex; give its real part, or its modulus")
    try:
        values = raw.astype(np.float64)
    except (TypeError, ValueError):
        wrong = next((item for item in raw.tolist() if not is_number(item)), raw.dtype)
        raise InputError(f"{name} holds {str(wrong)[:40]!r}, which is no number; give numbers alone") from None
    return values if not isinstance(x, np.ma.MaskedArray) else np.where(np.ma.getmaskarray(x), np.nan, values)


def plain(x: Samples) -> np.ndarray[Any, np.dtype[Any]]:
    """The bare NumPy array of a container; pandas' missing values become NaN, a mask is left to the caller."""
    if is_a(x, "pandas", "Series") or is_a(x, "pandas", "Index"):
        return np.asarray(x) if x.dtype.kind in "mM" else np.asarray(x.to_numpy(dtype=float, na_value=np.nan))
    return np.asarray(np.ma.getdata(x) if isinstance(x, np.ma.MaskedArray) else x)


def is_number(item: object) -> bool:
    """Whether NumPy reads this as a real number or as missing.

    >>> is_number(None), is_number("2.5"), is_number("spam")
    (True, True, False)
    """
    try:
        np.asarray(item).astype(np.float64)
    except (TypeError, ValueError):
        return item is None
    return True


def seconds(stamps: np.ndarray[Any, np.dtype[Any]]) -> Array:
    """Dates or durations in seconds after the first that is there; those that are not are NaN."""
    there = ~np.isnat(stamps)
    if not there.any():
        raise InputError("no time is given: every one of the dates is missing")
    passed = (stamps - stamps[there][0]) / np.timedelta64(1, "s")
    return np.where(there, passed, np.nan)


def columns_of(x: Samples, *, time: Samples = None, name: str = "", units: str = "") -> Columns:
    """Samples as columns, their times first where they have any.

    Parameters
    ----------
    x : array_like, masked array, Series, DataFrame, DataArray or Dataset
        The samples.  The index of a Series or DataFrame (unless it only counts) and the coordinate of an xarray object
        along its one dimension are its times; a column of a DataFrame that is named like a time is, too.
    time : array_like, optional
        The times, in place of those.
    name, units : str, optional
        What the samples are called and measured in; by default what the container says, else ``"x"`` without a unit.

    Returns
    -------
    Columns
        The columns, read when they are asked for.

    Examples
    --------
    >>> columns_of([1.0, 2.0], time=[0.0, 0.5]).names
    ('time', 'x')
    """
    found = dict(named_columns(x, name))
    if time is not None:
        found = {"time": numbers(time, "time"), **{key: value for key, value in found.items() if not is_time(key)}}
        check_lengths(found)
    stated = units or unit_of(x)
    names = tuple(key if is_time(key) or not stated or "[" in key else f"{key} [{stated}]" for key in found)
    arrays = tuple(found.values())
    return Columns(names, tuple(a.size for a in arrays), arrays.__getitem__, place, SOURCE)


def check_lengths(columns: Mapping[str, Array]) -> None:
    """Refuse times that are not one per sample."""
    times = columns["time"].size
    wrong = [f"{name} has {values.size} samples" for name, values in columns.items() if values.size != times]
    if wrong:
        raise InputError(f"{wrong[0]}, and {times} times are given; give one time per sample")


def place(row: int) -> str:
    """Where a row is, counted as Python counts."""
    return f"index {row}"


def unit_of(x: Samples) -> str:
    """The unit that a container states in its attributes, as xarray's convention has it."""
    attributes = getattr(x, "attrs", None)
    stated = attributes.get("units", "") if isinstance(attributes, dict) else ""
    return stated if isinstance(stated, str) else ""


def named_columns(x: Samples, name: str) -> Iterator[Column]:
    """Each column with its name; times that a container has come first, as ``time``."""
    readers: tuple[tuple[str, str, Callable[[Samples, str], Iterator[Column]]], ...] = (
        ("pandas", "DataFrame", of_frame),
        ("pandas", "Series", of_series),
        ("xarray", "Dataset", of_dataset),
        ("xarray", "DataArray", of_data_array),
    )
    for library, kind, reader in readers:
        if is_a(x, library, kind):
            return reader(x, name)
    return iter([(name or UNNAMED, numbers(x, "the signal"))])


def of_index(index: Samples) -> Iterator[Column]:
    """The index as times, unless it only counts or holds names."""
    if not is_a(index, "pandas", "RangeIndex") and (index.dtype.kind in "iufmM"):
        yield "time", numbers(index, "the index")


def of_series(x: Samples, name: str) -> Iterator[Column]:
    """A pandas Series with its index."""
    yield from of_index(x.index)
    yield called(x, name), numbers(x, "the series")


def called(x: Samples, name: str) -> str:
    """The name that is given, else the container's own."""
    return name or (UNNAMED if x.name is None else str(x.name))


def refuse_name(name: str) -> None:
    """Refuse one name for a table of several columns."""
    if name:
        raise InputError(f"the columns of a table have names of their own, not {name!r}; choose one by column=")


def of_frame(x: Samples, name: str) -> Iterator[Column]:
    """The numeric columns of a pandas DataFrame; its index where no column is a time."""
    refuse_name(name)
    if not any(is_time(str(label)) for label in x.columns):
        yield from of_index(x.index)
    for label in x.columns:
        if x[label].dtype.kind in "biufmM":
            yield str(label), numbers(x[label], f"column {label}")


def of_data_array(x: Samples, name: str) -> Iterator[Column]:
    """A one-dimensional xarray DataArray with its coordinate."""
    if x.ndim != 1:
        raise InputError(f"the signal has dimensions {', '.join(map(str, x.dims))}; select along all but one")
    dimension = x.dims[0]
    if dimension in x.coords:
        yield timed(x.coords[dimension])
    yield called(x, name), numbers(x.values, "the signal")


def of_dataset(x: Samples, name: str) -> Iterator[Column]:
    """The one-dimensional variables of an xarray Dataset along its first dimension, each with its own unit."""
    refuse_name(name)
    first = next(iter(x.dims), None)
    if first in x.coords:
        yield timed(x.coords[first])
    for label, variable in x.data_vars.items():
        if variable.dims == (first,):
            unit = unit_of(variable)
            yield f"{label} [{unit}]" if unit else str(label), numbers(variable.values, f"variable {label}")


def timed(coordinate: Samples) -> Column:
    """A coordinate as the times, with the unit that it states."""
    unit = unit_of(coordinate)
    return f"time [{unit}]" if unit else "time", numbers(coordinate.values, "the coordinate")
