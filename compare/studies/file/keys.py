"""The tables and keys that a study has, and how a value is taken from one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.axes import shown
from ridgeback.compare.studies.file.places import LocatedError, Source

T = TypeVar("T")

KEYS: Mapping[str, tuple[str, ...]] = {
    "study": ("title", "ask"),
    "oscillator": ("name", "system", "equation", "about", "potential", "parameters", "amplitudes", "signal"),
    "grid": ("amplitudes", "damping", "orders", "methods", "tolerances"),
    "signal": ("duration", "periods", "rate", "samples_per_period", "snr_db", "trials", "seed"),
}


def check_keys(source: Source, table: Mapping[str, Any]) -> None:
    """Refuse tables and keys that a study does not have."""
    for name, entry in table.items():
        if name not in KEYS:
            raise LocatedError(f"{source.place(name)}: a study has no table {shown(name)}; it has {', '.join(KEYS)}")
        entries = entry if name == "oscillator" else [entry]
        form = f"[[{name}]]" if name == "oscillator" else f"[{name}]"
        if not isinstance(entries, list) or not all(isinstance(item, dict) for item in entries):
            raise LocatedError(f"{source.place(name)}: write it as a table, {form}")
        for i, item in enumerate(entries, start=1):
            for key in item:
                if key not in KEYS[name]:
                    path = f"{name}.{i}.{key}" if name == "oscillator" else f"{name}.{key}"
                    raise LocatedError(f"{source.place(path)}: no such key; {form} may have {', '.join(KEYS[name])}")


def value_of(table: Mapping[str, Any], path: str, *, missing: str) -> Any:
    """A value that must be there."""
    head, _, key = path.partition(".")
    if key not in table.get(head, {}):
        raise InputError(f"is missing; {missing}")
    return table[head][key]


def given(source: Source, table: Mapping[str, Any], path: str, read: Callable[[Any], T], default: T) -> T:
    """A value that may be there, read at its place."""
    key = path.rpartition(".")[2]
    if key not in table:
        return default
    with source.at(path):
        return read(table[key])


def text_of(value: Any) -> str:
    """A text."""
    if not isinstance(value, str):
        raise InputError(f"{shown(value)} is not text; put it in quotation marks")
    return value


def texts(value: Any) -> tuple[str, ...]:
    """One text or a list of them, each once."""
    items = value if isinstance(value, list) else [value]
    if not items:
        raise InputError("is an empty list; give one or more")
    return tuple(dict.fromkeys(text_of(item) for item in items))
