"""An oscillator from a description: an equation as text, or a TOML file that names it.

    [oscillator]
    equation = "theta'' + 2*mu*theta' + k**2*sin(theta) = 0"
    title = "My pendulum"                # optional, as all that follows
    reference = "where it is from"
    potential = "k**2*(1 - cos(theta))"  # checked by differentiation
    initial = [1.5, 0.0]
    unit = "rad"
    about = "0"                          # the equilibrium that the motion is about

    [oscillator.parameters]
    k = "12.5"                           # text keeps decimals and fractions exact; numbers work, too
    mu = 0.01

An equation may also be expanded about another equilibrium: the unknown is then measured from there.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.files import read_regular
from ridgeback.symbolic.arithmetic.roots import Root
from ridgeback.symbolic.grammar.nodes import (
    Call,
    Negate,
    Node,
    Power,
    Product,
    Quotient,
    Sum,
    Unknown,
    to_text,
)
from ridgeback.symbolic.grammar.parse import Equation, U, V, W, parse_equation, parse_expression, to_sympy
from ridgeback.symbolic.systems.equilibrium import about_root, near_equilibrium, numbers
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.parameters import Value

TEXTS = ("title", "reference", "description", "potential", "unit", "symbol")
KEYS = ("equation", *TEXTS, "initial", "about", "parameters")
MAX_BYTES = 100_000


def from_text(
    equation: str, *, about: str = "0", parameters: Mapping[str, Value] | None = None, **details: Any
) -> Oscillator:
    """Read an equation; with ``about`` the unknown is measured from that equilibrium.

    Parameters
    ----------
    equation : str
        Such as ``"u'' + u + u**3 = 0"``; read by Ridgeback's own grammar.
    about : str, optional
        The equilibrium, a number such as ``"1"`` or ``"2**(1/3)"``; a decimal within a unit of its last place of an
        equilibrium stands for that, exactly.
    parameters : mapping of str to number or str, optional
        Values of parameters.
    **details
        Title, reference, description, initial, symbol, unit, potential and aliases, as ``Oscillator.from_equation``.

    Returns
    -------
    Oscillator
        The oscillator, its parameters exact.

    Raises
    ------
    InputError
        As ``Oscillator.from_equation`` does, and when ``about`` is not a number or not an equilibrium.

    Examples
    --------
    >>> from_text("u'' - u + u**3 = 0", about="1").natural_frequency
    sqrt(2)
    """
    tree = parse_equation(equation)
    place = parse_expression(about, unknown=tree.unknown)
    value = to_sympy(place)
    if not value.is_number:
        raise InputError(f"about {about!r} is not a number; use e.g. 1, 1/2, sqrt(2) or pi")
    if value == 0:
        return Oscillator.from_tree(tree, parameters=parameters, **details)
    if "potential" in details:
        raise InputError(f"a potential cannot be given together with about = {about}; leave it out")
    moved_tree = _moved(tree.left, place)
    values = numbers(tree, parameters or {})
    rest = sympy.expand(to_sympy(moved_tree).subs({U: 0, V: 0, W: 0}).subs(values))
    if rest.is_number and rest != 0:
        place = near_equilibrium(tree, about, parameters or {})
        if isinstance(place, Root):
            return about_root(tree, place, parameters or {}, **details)
        moved_tree = _moved(tree.left, parse_expression(str(place)))
    moved = Equation(tree.unknown, moved_tree, to_text(moved_tree, unknown=tree.unknown) + " = 0")
    try:
        return Oscillator.from_tree(moved, parameters=parameters, **details)
    except InputError as reason:
        raise InputError(f"about {about}: {reason}") from None


def moved_to(oscillator: Oscillator, about: str) -> Oscillator:
    """The same equation with the unknown measured from another equilibrium; raises InputError as ``from_text``.

    >>> well = Oscillator.from_equation("u'' + u - u**2 = 0")
    >>> moved_to(well, "0").equation == well.equation
    True
    """
    return from_text(
        oscillator.equation,
        about=about,
        parameters=oscillator.parameters,
        name=oscillator.name,
        title=f"{oscillator.title}, about {about}",
        reference=oscillator.reference,
        unit=oscillator.unit,
    )


def _moved(node: Node, place: Node) -> Node:
    """Replace the unknown by the unknown plus its place; derivatives are unchanged."""
    match node:
        case Unknown(derivative=0):
            return Sum((node, place))
        case Negate(operand=below):
            return Negate(_moved(below, place))
        case Sum(terms=terms):
            return Sum(tuple(_moved(term, place) for term in terms))
        case Product(factors=factors):
            return Product(tuple(_moved(factor, place) for factor in factors))
        case Quotient(numerator=above, denominator=below):
            return Quotient(_moved(above, place), _moved(below, place))
        case Power(base=base, exponent=exponent):
            return Power(_moved(base, place), exponent)
        case Call(function=function, argument=argument):
            return Call(function, _moved(argument, place))
    return node


def read_description(path: str | Path) -> Oscillator:
    """Read an oscillator from a TOML file.

    Raises InputError that names the file and what is wrong in it, OSError when it cannot be read.
    """
    file = Path(path)
    data = read_regular(file, MAX_BYTES, "a description is a few lines")
    try:
        table = tomllib.loads(data.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as reason:
        raise InputError(f"{file} is not TOML: {reason}") from None
    except RecursionError:
        raise InputError(f"{file} nests its values too deeply; a description is a table of texts and numbers") from None
    try:
        return from_table(table, name=file.stem)
    except InputError as reason:
        raise InputError(f"{file}: {reason}") from None


def from_table(table: Mapping[str, Any], *, name: str) -> Oscillator:
    """Build an oscillator from the parsed TOML.

    >>> from_table({"oscillator": {"equation": "u'' + u + u**3", "parameters": {}}}, name="mine").kind
    'conservative'
    """
    entry = table.get("oscillator")
    if not isinstance(entry, dict) or not isinstance(entry.get("equation"), str):
        raise InputError("no [oscillator] table with an equation; write e.g. equation = \"u'' + u + u**3 = 0\" in it")
    unknown = sorted(set(entry) - set(KEYS))
    if unknown:
        raise InputError(f"unknown key {unknown[0]!r} in [oscillator]; it may have {', '.join(KEYS)}")
    details = {key: _text(entry, key) for key in TEXTS}
    given = {key: value for key, value in details.items() if value is not None}
    oscillator = from_text(
        entry["equation"], about=_text(entry, "about") or "0", parameters=_parameters(entry), name=name, **given
    )
    return replace(oscillator, initial=_initial(entry)) if "initial" in entry else oscillator


def _text(entry: Mapping[str, Any], key: str) -> str | None:
    value = entry.get(key)
    if value is None or isinstance(value, str):
        return value
    if key == "about" and isinstance(value, int | float) and not isinstance(value, bool):
        return str(value)
    raise InputError(f"{key} = {value!r} is not text; put it in quotation marks")


def _parameters(entry: Mapping[str, Any]) -> dict[str, Value]:
    table = entry.get("parameters", {})
    if not isinstance(table, dict):
        raise InputError(
            f"parameters = {table!r} is not a table; write [oscillator.parameters] and one name = value a line"
        )
    for name, value in table.items():
        if isinstance(value, bool) or not isinstance(value, int | float | str):
            raise InputError(f'parameter {name} = {value!r} is not a number; use e.g. 0.01 or "1/3"')
    return dict(table)


def _initial(entry: Mapping[str, Any]) -> tuple[float, float]:
    value = entry["initial"]
    numbers = isinstance(value, list) and len(value) == 2 and all(type(v) in (int, float) for v in value)
    if not numbers or not all(math.isfinite(v) for v in value):
        raise InputError(f"initial = {value!r} is not a pair of finite numbers; write e.g. initial = [1.5, 0.0]")
    return float(value[0]), float(value[1])
