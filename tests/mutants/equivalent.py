"""Mutants that no test can kill, since they change nothing but rounding or cost: named one by one, with the reason.

They stand in ``equivalent.toml``, by what ``changes.Mutant.name`` is made of, so that an entry ends with its line.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path

PLACE = Path(__file__).with_suffix(".toml")


def equivalents(place: Path = PLACE) -> Mapping[str, str]:
    """The reason of each, by the mutant's name."""
    entries = tomllib.loads(place.read_text(encoding="utf-8"))["mutant"]
    return {entry["name"]: entry["reason"] for entry in entries}
