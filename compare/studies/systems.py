"""The oscillator of a study as text and exact numbers: small enough to travel, enough to be made again anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.description import from_text, moved_to
from ridgeback.symbolic.systems.oscillator import Oscillator

KEPT = 128
"""Oscillators that a process keeps."""


@dataclass(frozen=True)
class System:
    """An oscillator by its catalogue name or its equation, with the values of its parameters.

    Parameters
    ----------
    name : str
        What it is called in a table.
    catalogue : str
        Its name in the catalogue; empty for one that has an equation.
    equation, about, potential : str
        As :func:`ridgeback.oscillator` takes them; empty for what is not given.
    parameters : tuple of (str, str)
        Values by name, exact as written, in the order of the names.

    Examples
    --------
    >>> System("pendulum", catalogue="pendulum", parameters=(("mu", "1/100"),)).oscillator().kind
    'damped'
    """

    name: str
    catalogue: str = ""
    equation: str = ""
    about: str = ""
    potential: str = ""
    parameters: tuple[tuple[str, str], ...] = ()

    def oscillator(self) -> Oscillator:
        """The oscillator, made once in a process.  Raises InputError for what cannot be read."""
        return _made(self)

    def having(self, values: Mapping[str, str]) -> System:
        """The same with more parameters set."""
        return replace(self, parameters=tuple(sorted({**dict(self.parameters), **values}.items())))

    def numbers(self) -> dict[str, float]:
        """Every parameter that has a value, as a float."""
        return {name: float(value) for name, value in self.oscillator().parameters.items() if value is not None}

    @property
    def title(self) -> str:
        """What it is called in a sentence."""
        return self.oscillator().title

    @property
    def natural_frequency(self) -> float:
        """The natural frequency k, rad per time unit."""
        return float(self.oscillator().natural_frequency.evalf(30))


@lru_cache(maxsize=KEPT)
def _made(system: System) -> Oscillator:
    values = {name: Fraction(text) for name, text in system.parameters}
    if system.catalogue:
        found = find(system.catalogue).with_parameters(values)
        return moved_to(found, system.about) if system.about else found
    details = {"potential": system.potential} if system.potential else {}
    return from_text(
        system.equation, about=system.about or "0", parameters=values, name=system.name, title=system.name, **details
    )


def checked(system: System) -> System:
    """The system when it can be made and all its parameters have values; raises InputError.

    >>> checked(System("mine", equation="u'' + u + c*u**3 = 0"))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: mine: parameter c has no value; give it one
    """
    free = [name for name, value in system.oscillator().parameters.items() if value is None]
    if free:
        raise InputError(f"{system.name}: parameter {free[0]} has no value; give it one")
    return system
