"""A repr of a few lines for values that hold arrays, long series or other results: what is long is only named."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import fields
from typing import Any, ClassVar, Final, Protocol

PART: Final = 40
"""Characters of one field that are shown."""
WHOLE: Final = 360
"""Characters of all of them."""


class _Dataclass(Protocol):
    __dataclass_fields__: ClassVar[dict[str, Any]]


def brief(value: object) -> str:
    """A value in a few characters: its repr where that is short, else what it is and how long.

    >>> brief(1.5), brief("x" * 99), brief(tuple(range(99))), brief({"a": 1})
    ('1.5', "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'", '<tuple of 99>', "{'a': 1}")
    """
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"<array {'x'.join(map(str, shape))}>"
    if isinstance(value, str):
        return repr(value if len(value) <= PART else value[: PART - 4] + "...")
    if isinstance(value, Collection) and len(value) > PART:
        return f"<{type(value).__name__} of {len(value)}>"
    text = repr(value)
    if len(text) <= PART and "\n" not in text:
        return text
    counted = isinstance(value, tuple | list | Mapping)
    return f"<{type(value).__name__} of {len(value)}>" if counted else f"<{type(value).__name__}>"  # type: ignore[arg-type]


def brief_repr(value: _Dataclass) -> str:
    """The fields of a dataclass, each in brief, as many as go into a few lines.

    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, repr=False)
    ... class Samples(Brief):
    ...     name: str
    ...     values: tuple[int, ...]
    >>> Samples("u", tuple(range(500)))
    <Samples: name='u', values=<tuple of 500>>
    """
    text = ""
    for item in fields(value):
        part = f"{', ' if text else ''}{item.name}={brief(getattr(value, item.name))}"
        if len(text) + len(part) > WHOLE:
            text += ", ..."
            break
        text += part
    return f"<{type(value).__name__}: {text}>"


class Brief:
    """What shows itself in a few lines; a dataclass that inherits it is declared with ``repr=False``."""

    def __repr__(self) -> str:
        return brief_repr(self)  # type: ignore[arg-type]
