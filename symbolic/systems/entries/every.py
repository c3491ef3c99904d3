"""All entries of the catalogue in its order, as text: no equation is read here."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ridgeback.symbolic.systems.entries.classical import CLASSICAL
from ridgeback.symbolic.systems.entries.entry import Entry
from ridgeback.symbolic.systems.entries.kinked import KINKED
from ridgeback.symbolic.systems.entries.moving_mass import MOVING_MASS
from ridgeback.symbolic.systems.entries.self_excited import SELF_EXCITED
from ridgeback.symbolic.systems.entries.wells import WELLS

OTHERS: Final = (*WELLS, *MOVING_MASS, *SELF_EXCITED, *KINKED)
ENTRIES: Final = (*CLASSICAL, *OTHERS)
DAMPING: Final = "1/100"
"""mu of the damped twins."""


def names() -> tuple[str, ...]:
    """Return the names of the catalogue in its order.

    Returns
    -------
    tuple of str
        Of the classical oscillators and their damped twins, then of the others and theirs.

    Examples
    --------
    >>> names()[4:8]
    ('helmholtz-duffing', 'van-der-pol', 'rayleigh', 'damped-linear')
    """
    return tuple(row["name"] for row in listed())


def listed() -> list[dict[str, str]]:
    """Return name, kind, equation and parameters of every oscillator, damped twins too.

    Returns
    -------
    list of dict
        Text throughout; parameters as ``name=value`` with blanks between.

    Examples
    --------
    >>> listed()[1]["parameters"]
    'mu=0 k=1'
    """
    return [*_listed(CLASSICAL), *_listed(OTHERS)]


def _listed(entries: tuple[Entry, ...]) -> Iterator[dict[str, str]]:
    for entry in entries:
        yield _row(entry.name, entry.kind, entry, entry.values)
    for entry in entries:
        if entry.damped:
            yield _row(entry.damped, "damped", entry, {**entry.values, "mu": DAMPING})


def _row(name: str, kind: str, entry: Entry, values: dict[str, str]) -> dict[str, str]:
    parameters = " ".join(f"{key}={value}" for key, value in values.items())
    return {"name": name, "kind": kind, "equation": entry.equation, "parameters": parameters}


def known_frequency(name: str) -> str | None:
    """Return omega0 of an oscillator in closed form, as text, where one is known.

    Parameters
    ----------
    name : str
        In the catalogue.

    Returns
    -------
    str or None
        In the peak amplitude A and the parameters; ``agm(x, y)`` is the arithmetic-geometric mean.

    Examples
    --------
    >>> known_frequency("morse"), known_frequency("toda")
    ('sqrt(1 - (1 - exp(-alpha*A))**2)', None)
    """
    return next((entry.exact for entry in ENTRIES if entry.name == name), None)
