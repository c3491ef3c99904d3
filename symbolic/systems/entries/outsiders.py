"""Oscillators that other distributions add by entry points of the group ``ridgeback.systems``.

An entry point names an ``Oscillator``, or a function without arguments that returns one; its name is the oscillator's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.metadata import EntryPoint

from ridgeback.common.errors import InputError
from ridgeback.common.plugins import loaded, plugins
from ridgeback.symbolic.systems.entries.every import names
from ridgeback.symbolic.systems.oscillator import Oscillator

GROUP = "ridgeback.systems"


def outside() -> Mapping[str, EntryPoint]:
    """The entry points by name; ours cannot be replaced."""
    return plugins(GROUP, names())


def outsider(point: EntryPoint) -> Oscillator:
    """The oscillator of one entry point, under the entry point's name.

    Raises InputError for one that cannot be loaded.
    """
    found = loaded(point, Oscillator)
    if found.name != point.name:
        raise InputError(f"the plugin {point.name!r} ({point.value}) gives an oscillator that is called {found.name!r}")
    return found


def outside_rows() -> Iterator[dict[str, str]]:
    """Name, kind, equation and parameters of each; of one that cannot be loaded the reason in place of its equation."""
    for name, point in outside().items():
        try:
            found = outsider(point)
        except InputError as fault:
            yield {"name": name, "kind": "not loaded", "equation": str(fault), "parameters": ""}
        else:
            values = " ".join(f"{key}={value}" for key, value in found.parameters.items())
            yield {"name": name, "kind": found.kind, "equation": found.equation, "parameters": values}


def outside_oscillators() -> tuple[Oscillator, ...]:
    """Those that can be loaded."""
    found = []
    for point in outside().values():
        try:
            found.append(outsider(point))
        except InputError:
            continue
    return tuple(found)
