"""The catalogue: each oscillator as data, with the work it is taken from.

Parameters are in natural units (k = 1) unless ``with_parameters`` says otherwise.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from functools import cache
from math import pi
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.oscillator import Oscillator

_NAYFEH_MOOK: Final = "A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, Wiley, New York, 1979"
_GALLEANI_COHEN: Final = "L. Galleani and L. Cohen, The pendulum: a time-frequency model"
_KOVACIC_BRENNAN: Final = (
    "I. Kovacic and M. J. Brennan (eds), The Duffing Equation: Nonlinear Oscillators and their Behaviour, "
    "Wiley, Chichester, 2011"
)
_VAN_DER_POL: Final = (
    "B. van der Pol, On relaxation-oscillations, The London, Edinburgh, and Dublin Philosophical Magazine and "
    "Journal of Science, Series 7, 2(11), 978-992, 1926"
)
_RAYLEIGH: Final = (
    "Lord Rayleigh, On maintained vibrations, The London, Edinburgh, and Dublin Philosophical Magazine and "
    "Journal of Science, Series 5, 15(94), 229-235, 1883"
)


@dataclass(frozen=True)
class _Entry:
    """One line of the catalogue; ``damped`` names the twin that has mu = 1/100 by default."""

    name: str
    title: str
    equation: str
    values: dict[str, str]
    reference: str
    description: str
    potential: str | None = None
    initial: tuple[float, float] = (1.0, 0.0)
    aliases: tuple[str, ...] = ()
    unit: str = ""
    damped: str | None = None
    damped_aliases: tuple[str, ...] = field(default=())


_ENTRIES: Final = (
    _Entry(
        name="linear",
        title="Linear oscillator",
        equation="u'' + 2*mu*u' + k**2*u = 0",
        potential="k**2*u**2/2",
        values={"mu": "0", "k": "1"},
        reference=_NAYFEH_MOOK + ", section 1.1",
        description="The frequency does not depend on the amplitude; with damping it is sqrt(k^2 - mu^2).",
        aliases=("harmonic", "linear-oscillator"),
        damped="damped-linear",
        damped_aliases=("linear-damped",),
    ),
    _Entry(
        name="pendulum",
        title="Pendulum",
        equation="theta'' + 2*mu*theta' + k**2*sin(theta) = 0",
        potential="k**2*(1 - cos(theta))",
        values={"mu": "0", "k": "1"},
        reference=_GALLEANI_COHEN + ", eq. (1)",
        description="Softening: the frequency falls with the amplitude and vanishes at the separatrix, A = pi.",
        initial=(0.95 * pi, 0.0),
        aliases=("simple-pendulum",),
        unit="rad",
        damped="damped-pendulum",
        damped_aliases=("pendulum-damped",),
    ),
    _Entry(
        name="duffing-hardening",
        title="Duffing oscillator, hardening",
        equation="u'' + 2*mu*u' + k**2*u + eps*u**3 = 0",
        potential="k**2*u**2/2 + eps*u**4/4",
        values={"mu": "0", "k": "1", "eps": "1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2",
        description="The frequency rises with the amplitude; there is no separatrix.",
        aliases=("duffing", "hardening-duffing"),
        damped="damped-duffing-hardening",
        damped_aliases=("damped-duffing", "duffing-damped"),
    ),
    _Entry(
        name="duffing-softening",
        title="Duffing oscillator, softening",
        equation="u'' + 2*mu*u' + k**2*u + eps*u**3 = 0",
        potential="k**2*u**2/2 + eps*u**4/4",
        values={"mu": "0", "k": "1", "eps": "-1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2",
        description="The frequency falls with the amplitude and vanishes at the saddles, A = k/sqrt(-eps).",
        initial=(0.9, 0.0),
        aliases=("softening-duffing",),
        damped="damped-duffing-softening",
    ),
    _Entry(
        name="helmholtz-duffing",
        title="Helmholtz-Duffing oscillator",
        equation="u'' + 2*mu*u' + k**2*u + alpha2*u**2 + alpha3*u**3 = 0",
        potential="k**2*u**2/2 + alpha2*u**3/3 + alpha3*u**4/4",
        values={"mu": "0", "k": "1", "alpha2": "1", "alpha3": "1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2; " + _NAYFEH_MOOK + ", section 2.3.1",
        description=(
            "Quadratic and cubic stiffness: unequal turning points and a mean offset.  With the default values the "
            "well is single (alpha2^2 < 4 k^2 alpha3), so every amplitude oscillates."
        ),
        aliases=("helmholtz", "duffing-helmholtz"),
        damped="damped-helmholtz-duffing",
    ),
    _Entry(
        name="van-der-pol",
        title="Van der Pol oscillator",
        equation="u'' - eps*(1 - u**2)*u' + k**2*u = 0",
        values={"eps": "1/2", "k": "1"},
        reference=_VAN_DER_POL,
        description="Self-excited: every orbit approaches a limit cycle of amplitude near 2; expanded in eps.",
        initial=(2.0, 0.0),
        aliases=("vdp",),
    ),
    _Entry(
        name="rayleigh",
        title="Rayleigh oscillator",
        equation="u'' - eps*(1 - u'**2/3)*u' + k**2*u = 0",
        values={"eps": "1/2", "k": "1"},
        reference=_RAYLEIGH,
        description="Self-excited; its velocity obeys the van der Pol equation when k = 1, so their frequencies agree.",
        initial=(2.0, 0.0),
        aliases=("lord-rayleigh",),
    ),
)


@cache
def catalogue() -> tuple[Oscillator, ...]:
    """Return every oscillator of the catalogue, damped twins last.

    Returns
    -------
    tuple of Oscillator
        With their default parameters.

    Examples
    --------
    >>> [system.name for system in catalogue()][:3]
    ['linear', 'pendulum', 'duffing-hardening']
    """
    plain = [_oscillator(entry) for entry in _ENTRIES]
    return (*plain, *(_damped(entry) for entry in _ENTRIES if entry.damped))


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
    ridgeback.common.errors.InputError: no system 'raleigh'; did you mean rayleigh? (ridgeback systems lists all)
    """
    known = {_key(alias): system for system in catalogue() for alias in (system.name, *system.aliases)}
    system = known.get(_key(name))
    if system is None:
        raise InputError(f"no system {name[:60]!r}; {_suggestion(name, known)} (ridgeback systems lists all)")
    return system


def _suggestion(name: str, known: dict[str, Oscillator]) -> str:
    close = difflib.get_close_matches(_key(name[:60]), known, 3, 0.5)
    found = list(dict.fromkeys(known[key].name for key in close))
    return f"did you mean {' or '.join(found)}?" if found else "for instance pendulum, duffing-hardening, van-der-pol"


def _key(name: str) -> str:
    return "".join(character for character in name.casefold() if character not in " -_")


def _oscillator(entry: _Entry) -> Oscillator:
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


def _damped(entry: _Entry) -> Oscillator:
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
