"""Oscillators as they come in: every form in which one may be named becomes an ``Oscillator`` here, and only here."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias, Union

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.description import from_text, moved_to, read_description
from ridgeback.symbolic.systems.from_sympy import equation_text
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.parameters import Value

OscillatorLike: TypeAlias = Union[Oscillator, str, "os.PathLike[str]", sympy.Expr, sympy.Eq]
"""An oscillator, a name of the catalogue, an equation as text, a TOML path, or a SymPy equation or expression."""

MARKS = frozenset("'\u2019\u2032=+*^(")
"""What an equation holds and neither a name nor a file's does: a prime, as it is typed or set, or an operation."""


def as_oscillator(
    given: OscillatorLike,
    *,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    unknown: str | None = None,
) -> Oscillator:
    """Make an oscillator of any of its forms.

    Text is read by Ridgeback's own grammar and never evaluated; SymPy objects are taken as objects.

    Parameters
    ----------
    given : Oscillator, str, path, sympy.Eq or sympy.Expr
        An oscillator; a name of the catalogue (case, hyphens and underscores do not matter); an equation such as
        ``"u'' + u + c*u**3 = 0"``; the path of a TOML description (text ending in ``.toml``, or any ``Path``); a SymPy
        equation or left-hand side in a function of time; or the force f(u) of ``u'' + f = 0`` in a symbol.
    parameters : mapping of str to number or str, optional
        Values of parameters, exact as they are written (0.01 and ``"1/100"`` are 1/100); ``None`` leaves one symbolic.
    about : str, optional
        An equilibrium to measure the unknown from, such as ``"1"`` or ``"sqrt(2)"``.
    unknown : str, optional
        The symbol that is the unknown of a SymPy expression that holds several.

    Returns
    -------
    Oscillator
        The oscillator, its parameters exact.

    Raises
    ------
    InputError
        For a name that is not in the catalogue (with the nearest that are), an equation that cannot be read, and a
        parameter that it does not have.
    OSError
        For a file that cannot be read.

    Examples
    --------
    >>> as_oscillator("van_der_pol").name
    'van-der-pol'
    >>> as_oscillator("u'' + u + c*u**3 = 0", parameters={"c": "1/2"}).substituted_force
    u**3/2 + u
    >>> x = sympy.Symbol("x")
    >>> as_oscillator(sympy.sin(x)).equation
    "x'' + sin(x) = 0"
    """
    text = _equation(given, unknown)
    if text is not None:
        return from_text(text, about=about or "0", parameters=parameters)
    found = _named(given)
    found = found.with_parameters(parameters) if parameters else found
    return found if about is None else moved_to(found, about)


def _equation(given: OscillatorLike, unknown: str | None) -> str | None:
    """The text of what is an equation of motion; None for what only names one."""
    if isinstance(given, sympy.Expr | sympy.Eq):
        return equation_text(given, unknown=unknown)
    if isinstance(given, str) and not given.endswith(".toml") and MARKS & set(given):
        return given
    return None


def _named(given: OscillatorLike) -> Oscillator:
    match given:
        case Oscillator():
            return given
        case os.PathLike():
            return read_description(Path(given))
        case str():
            return read_description(given) if given.endswith(".toml") else find(given)
    raise InputError(
        f"{type(given).__name__} is no oscillator; give a name such as 'pendulum', an equation, a TOML path, a SymPy "
        "equation or an Oscillator"
    )
