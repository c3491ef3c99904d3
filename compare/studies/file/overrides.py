"""Settings of a study from outside its file: ``--set`` by key, its value as TOML or as a list with commas."""

from __future__ import annotations

import tomllib
from decimal import Decimal
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.keys import KEYS


def overridden(table: dict[str, Any], key: str, text: str) -> str:
    """Set a key of the tables; return its whole path.

    >>> table = {"grid": {"orders": [2]}}
    >>> overridden(table, "orders", "2,4"), table["grid"]["orders"]
    ('grid.orders', [2, 4])
    """
    path = whole_path(key)
    parts = path.split(".")
    here: Any = table
    for depth, part in enumerate(parts[:-1]):
        if isinstance(here, list):
            if not part.isdecimal() or not 1 <= int(part) <= len(here):
                raise InputError(f"--set {key}: {part!r} is no number from 1 to {len(here)}")
            here = here[int(part) - 1]
        else:
            here = here.setdefault(part, {})
        if not isinstance(here, dict | list):
            raise InputError(f"--set {key}: {'.'.join(parts[: depth + 1])} is a value, not a table")
    if isinstance(here, list):
        raise InputError(f"--set {key}: say which oscillator, as in oscillator.1.{parts[-1]}")
    here[parts[-1]] = literal(text)
    return path


def whole_path(key: str) -> str:
    """The path of a key that may be given by its last name.

    >>> whole_path("trials"), whole_path("grid.orders")
    ('signal.trials', 'grid.orders')
    """
    if "." in key:
        return key
    homes = [table for table in ("grid", "signal", "study") if key in KEYS[table]]
    if not homes:
        known = ", ".join(name for table in ("study", "grid", "signal") for name in KEYS[table])
        raise InputError(
            f"--set {key[:60]!r}: a study has no such key; it has {known}, and oscillator.1.parameters.NAME"
        )
    return f"{homes[0]}.{key}"


def literal(text: str) -> Any:
    """A value as TOML writes it, a list without its brackets, or a word.

    >>> literal("[1, 2]"), literal("1,2"), literal("pade"), literal("lindstedt,pade")
    ([1, 2], [1, 2], 'pade', ['lindstedt', 'pade'])
    """
    for form in (text, f"[{text}]") if "," in text else (text,):
        try:
            return tomllib.loads(f"value = {form}", parse_float=Decimal)["value"]
        except (tomllib.TOMLDecodeError, RecursionError):
            continue
    words = [word.strip() for word in text.split(",")]
    return words if len(words) > 1 else words[0]
