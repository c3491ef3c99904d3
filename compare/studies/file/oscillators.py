"""The oscillators of a study: each with every combination of its parameters, made once to see that it can be."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import product
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.file.axes import exact_values, floats, once, shown
from ridgeback.compare.studies.file.keys import KEYS, given, text_of
from ridgeback.compare.studies.file.places import LocatedError, Source
from ridgeback.compare.studies.file.signals import own_signal
from ridgeback.compare.studies.plan import Subject
from ridgeback.compare.studies.systems import System, checked
from ridgeback.symbolic.systems.parameters import unknown_parameter

Values = tuple[Fraction, ...]
MOST_SUBJECTS = 10_000
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+/ -]{0,59}", re.ASCII)
DAMPING = "mu"
"""The parameter that ``damping`` sets, as in ``2*mu*u'``."""


def subjects(source: Source, table: Mapping[str, Any]) -> Iterator[Subject]:
    """Every oscillator with every combination of its parameters."""
    entries, grid = table.get("oscillator", []), table.get("grid", {})
    if not entries:
        raise LocatedError(f'{source.name}: no oscillator; write [[oscillator]] and, below it, system = "pendulum"')
    known: dict[Subject, str] = {}
    for i, entry in enumerate(entries, start=1):
        path = f"oscillator.{i}"
        place = f"{path}.amplitudes" if "amplitudes" in entry else "grid.amplitudes"
        with source.at(place):
            found = entry.get("amplitudes", grid.get("amplitudes"))
            if found is None:
                raise InputError("is missing; give amplitudes = { from = 0.1, to = 3, count = 30 }, for instance")
            amplitudes = floats(found, low=0.0)
        signal = own_signal(source, table.get("signal", {}), entry.get("signal", {}), f"{path}.signal")
        for system in systems(source, entry, path, grid):
            subject = Subject(system, amplitudes, signal)
            if subject in known:
                raise LocatedError(
                    f"{source.place(path)}: is {known[subject]} once more; give another name, or leave it out"
                )
            known[subject] = path
            yield subject


def systems(source: Source, entry: Mapping[str, Any], path: str, grid: Mapping[str, Any]) -> Iterator[System]:
    """One oscillator with every combination of its parameters."""
    base = system_of(source, entry, path)
    axes = parameter_axes(source, entry, path, base)
    if "damping" in grid:
        with source.at("grid.damping"):
            if DAMPING in axes:
                raise InputError(f"the damping {DAMPING} is among the parameters of {path}, too; keep one")
            if DAMPING not in base.oscillator().parameters:
                raise InputError(f"{base.name} has no parameter {DAMPING}; set its own parameters instead")
            axes[DAMPING] = once(exact_values(grid["damping"]))
    if math.prod(len(axis) for axis in axes.values()) > MOST_SUBJECTS:
        raise LocatedError(
            f"{source.place(f'{path}.parameters')}: more than {MOST_SUBJECTS} combinations; give fewer values"
        )
    for values in product(*axes.values()):
        chosen = {name: str(value) for name, value in zip(axes, values, strict=True)}
        with source.at(f"{path}.parameters"):
            yield checked(base.having(chosen))


def system_of(source: Source, entry: Mapping[str, Any], path: str) -> System:
    """The oscillator without the parameters that the study sets."""
    both = [key for key in ("system", "equation") if key in entry]
    if len(both) != 1:
        what = "both system and equation" if both else "neither system nor equation"
        raise LocatedError(f"{source.place(path)}: {what}; give one of them")
    words = {
        key: given(source, entry, f"{path}.{key}", text_of, "") for key in KEYS["oscillator"][:5] if key != "about"
    }
    about = entry.get("about", "")
    name = words["name"] or words["system"] or path.replace(".", "-")
    with source.at(f"{path}.name" if words["name"] else f"{path}.{both[0]}"):
        if not NAME.fullmatch(name):
            raise InputError(f"{shown(name)} is no name; use up to 60 letters, digits, blanks and the signs _ . + / -")
    with source.at(f"{path}.{both[0]}"):
        system = System(
            name=name,
            catalogue=words["system"],
            equation=words["equation"],
            about=str(about) if about != "" else "",
            potential=words["potential"],
        )
        system.oscillator()
    return system


def parameter_axes(
    source: Source, entry: Mapping[str, Any], path: str, base: System
) -> dict[str, tuple[Fraction, ...]]:
    """The values of each parameter that is given."""
    table = entry.get("parameters", {})
    with source.at(f"{path}.parameters"):
        if not isinstance(table, dict):
            raise InputError(f"{shown(table)} is not a table; write parameters = {{ mu = 0.01, k = 2 }}")
    axes = {}
    for name, value in table.items():
        with source.at(f"{path}.parameters.{name}"):
            if name not in base.oscillator().parameters:
                raise InputError(unknown_parameter(base.name, name, base.oscillator().parameters))
            axes[name] = once(exact_values(value))
    return axes
