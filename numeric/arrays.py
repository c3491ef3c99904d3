"""Read-only float64 and boolean arrays, the form in which values are handed over."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import fields
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Mask = NDArray[np.bool_]


def frozen(values: ArrayLike) -> Array:
    """Return a read-only float64 copy.

    >>> frozen([1, 2]).flags.writeable
    False
    """
    copy = np.array(values, dtype=float)
    copy.flags.writeable = False
    return copy


def frozen_mask(values: ArrayLike) -> Mask:
    """Return a read-only boolean copy.

    >>> frozen_mask([True]).flags.writeable
    False
    """
    copy = np.array(values, dtype=bool)
    copy.flags.writeable = False
    return copy


def as_rows(columns: Mapping[str, Array]) -> list[dict[str, float]]:
    """One row per value of columns of one length.

    >>> as_rows({"a": np.array([1.0, 2.0]), "b": np.array([3.0, 4.0])})
    [{'a': 1.0, 'b': 3.0}, {'a': 2.0, 'b': 4.0}]
    """
    values = [np.asarray(column, dtype=float).tolist() for column in columns.values()]
    return [dict(zip(columns, row, strict=True)) for row in zip(*values, strict=True)]


def freeze(value: Any) -> None:
    """Make the arrays and mappings of a frozen dataclass read-only copies; for its ``__post_init__``.

    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True)
    ... class Pair:
    ...     x: Array
    ...     settings: Mapping[str, int]
    ...     def __post_init__(self) -> None:
    ...         freeze(self)
    >>> pair = Pair(np.zeros(2), {"a": 1})
    >>> pair.x.flags.writeable, type(pair.settings).__name__
    (False, 'mappingproxy')
    """
    for item in fields(value):
        held = getattr(value, item.name)
        if isinstance(held, np.ndarray):
            object.__setattr__(value, item.name, frozen_mask(held) if held.dtype == np.bool_ else frozen(held))
        elif isinstance(held, Mapping):
            object.__setattr__(value, item.name, MappingProxyType(dict(held)))


def floats(values: Collection[float]) -> NDArray[np.float64]:
    """Any collection of numbers as an array.

    >>> floats([1, 2.5]).tolist()
    [1.0, 2.5]
    """
    return np.fromiter(values, np.float64, len(values))
