"""The catalogue: each oscillator as data, with the work it is taken from, and those that other distributions add.

Parameters are in natural units (k = 1) unless ``with_parameters`` says otherwise.
"""

from __future__ import annotations

import difflib
from functools import cache

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.entries.entry import Entry
from ridgeback.symbolic.systems.entries.every import ENTRIES, names
from ridgeback.symbolic.systems.entries.outsiders import outside, outside_oscillators, outsider
from ridgeback.symbolic.systems.oscillator import Oscillator


@cache
def catalogue() -> tuple[Oscillator, ...]:
    """Return every oscillator of the catalogue: the classical ones, their damped twins, the others, and plugins.

    Returns
    -------
    tuple of Oscillator
        With their default parameters.

    Examples
    --------
    >>> [system.name for system in catalogue()][:3]
    ['linear', 'pendulum', 'duffing-hardening']
    """
    return (*(_made(name) for name in names()), *outside_oscillators())


def find(name: str) -> Oscillator:
    """Return the oscillator of this name or alias.

    Parameters
    ----------
    name : str
        Case, blanks, hyphens and underscores do not matter.

    Returns
    -------
    Oscillator
        With its default parameters.

    Raises
    ------
    InputError
        When there is none, with the closest names.

    Examples
    --------
    >>> find("Van der Pol").name
    'van-der-pol'
    >>> find("raleigh")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: no system 'raleigh'; did you mean rayleigh ...
    """
    known = _spellings()
    found = known.get(_key(name))
    if found is None:
        added = {_key(text): point for text, point in outside().items()}
        if _key(name) in added:
            return outsider(added[_key(name)])
        known = {**known, **{key: point.name for key, point in added.items()}}
        raise InputError(f"no system {name[:60]!r}; {_suggestion(name, known)} (ridgeback systems lists all)")
    return _made(found)


@cache
def _spellings() -> dict[str, str]:
    """The name of an oscillator by each of its spellings."""
    found = {_key(text): entry.name for entry in ENTRIES for text in (entry.name, *entry.aliases)}
    twins = {
        _key(text): entry.damped for entry in ENTRIES if entry.damped for text in (entry.damped, *entry.damped_aliases)
    }
    return {**found, **twins}


@cache
def _made(name: str) -> Oscillator:
    """The oscillator of one name; no other equation is read."""
    entry = next(entry for entry in ENTRIES if name in (entry.name, entry.damped))
    return _oscillator(entry) if name == entry.name else _damped(entry)


def _suggestion(name: str, known: dict[str, str]) -> str:
    close = difflib.get_close_matches(_key(name[:60]), known, 3, 0.5)
    found = list(dict.fromkeys(known[key] for key in close))
    return f"did you mean {' or '.join(found)}?" if found else "for instance pendulum, duffing-hardening, van-der-pol"


def _key(name: str) -> str:
    return "".join(character for character in name.casefold() if character not in " -_")


def _oscillator(entry: Entry) -> Oscillator:
    return Oscillator.from_equation(
        entry.equation,
        name=entry.name,
        title=entry.title,
        parameters=entry.values,
        potential=entry.potential,
        reference=entry.reference,
        description=entry.description,
        initial=entry.initial,
        unit=entry.unit,
        aliases=entry.aliases,
    )


def _damped(entry: Entry) -> Oscillator:
    """The twin with linear damping: the same equation with mu = 1/100."""
    return Oscillator.from_equation(
        entry.equation,
        name=entry.damped or entry.name,
        title=entry.title + ", linearly damped",
        parameters={**entry.values, "mu": "1/100"},
        potential=entry.potential,
        reference=entry.reference,
        description=entry.description + "  With linear damping 2*mu*u' the amplitude decays and the frequency with it.",
        initial=entry.initial,
        unit=entry.unit,
        aliases=entry.damped_aliases,
    )
