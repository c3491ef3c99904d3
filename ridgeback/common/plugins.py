"""What other distributions add by entry points, each found by its name, its faults its own.

A plugin is loaded when its name is asked for.  Whatever its code raises becomes one line that says which distribution
to mend or to uninstall, and no other plugin and nothing of ours is touched by it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from importlib.metadata import EntryPoint, entry_points
from typing import TypeVar

from ridgeback.common.errors import InputError, one_line

Value = TypeVar("Value")


def plugins(group: str, ours: Collection[str] = ()) -> Mapping[str, EntryPoint]:
    """The entry points of a group by name, sorted; one that bears a name of ours is left out.

    >>> dict(plugins("ridgeback.no_such_group"))
    {}
    """
    found = {point.name: point for point in entry_points(group=group) if point.name not in ours}
    return dict(sorted(found.items()))


def loaded(point: EntryPoint, kind: type[Value]) -> Value:
    """The value that an entry point names, or that the function without arguments which it names returns.

    Raises InputError with what went wrong in it, and where it came from.
    """
    value = guarded(point, point.load)
    value = value if isinstance(value, kind) else guarded(point, value) if callable(value) else value
    if not isinstance(value, kind):
        raise InputError(f"{told(point)} gives a {type(value).__name__}, not a {kind.__name__}")
    return value


def guarded(point: EntryPoint, call: Callable[..., object], *arguments: object) -> object:
    """Call somebody else's code; an InputError is its word to the user, all else its fault."""
    try:
        return call(*arguments)
    except InputError:
        raise
    except Exception as error:
        said = one_line(f"{type(error).__name__}: {error}")
        raise InputError(f"{told(point)} raised {said}; mend it or uninstall it") from error


def told(point: EntryPoint) -> str:
    """A plugin as it is named in a message."""
    owner = f" of {point.dist.name} {point.dist.version}" if point.dist is not None else ""
    return f"the plugin {point.name!r} ({point.value}){owner}"
