"""Parameter values as they come in: names checked, every value made an exact rational."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Final, TypeAlias

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.tokens import parse_number

Value: TypeAlias = "str | int | float | Fraction | sympy.Rational | None"
Parameters: TypeAlias = "Mapping[str, sympy.Rational | None]"

_NUMBER_BITS: Final = 2000


def merged(system: str, known: Parameters, given: Mapping[str, Value]) -> Parameters:
    """Return known parameters with given values in place.

    Parameters
    ----------
    system : str
        The oscillator's name, for messages.
    known : mapping of str to sympy.Rational or None
        The parameters it has.
    given : mapping of str to number, str or None
        New values; text and floats become the decimal rational that they print as, None leaves one symbolic.

    Returns
    -------
    mapping of str to sympy.Rational or None
        All known parameters.

    Raises
    ------
    InputError
        For names that are not known and for values that are not finite numbers.

    Examples
    --------
    >>> merged("pendulum", {"k": None, "mu": sympy.S.Zero}, {"k": "2.5"})
    {'k': 5/2, 'mu': 0}
    """
    for name in given:
        if name not in known:
            raise InputError(unknown_parameter(system, name, known))
    return {**known, **{name: _exact(name, value) for name, value in given.items()}}


def unknown_parameter(system: str, name: str, known: Parameters) -> str:
    """The message for a name that is not a parameter.

    >>> unknown_parameter("pendulum", "g", {"mu": None, "k": None})
    "pendulum has no parameter 'g'; its parameters: mu, k"
    """
    return f"{system} has no parameter {name[:60]!r}; its parameters: {', '.join(known) or 'none'}"


def reciprocal(name: str, value: sympy.Rational) -> sympy.Rational:
    """One over the value of a parameter; InputError for 0.

    >>> reciprocal("Q", sympy.Rational(40))
    1/40
    """
    if value == 0:
        raise InputError(f"parameter {name} = 0 is divided by; give a number other than 0")
    return 1 / value


def _exact(name: str, value: Value) -> sympy.Rational | None:
    """The rational that a value stands for; a float is what it prints as."""
    if value is None:
        return None
    try:
        if isinstance(value, float):
            value = float.__repr__(value)
        number = parse_number(value) if isinstance(value, str) else _whole(value)
    except InputError as error:
        raise InputError(f"parameter {name}: {error}") from None
    return sympy.Rational(number.numerator, number.denominator)


def _whole(value: object) -> Fraction:
    if isinstance(value, sympy.Rational):
        value = Fraction(int(value.p), int(value.q))
    if isinstance(value, bool) or not isinstance(value, int | Fraction):
        raise InputError(f"{value!r} is a {type(value).__name__}, not a number; give an integer, a decimal or a/b")
    if value.numerator.bit_length() + value.denominator.bit_length() > _NUMBER_BITS:
        raise InputError(f"a number of more than {_NUMBER_BITS} bits is too long; give fewer digits")
    return Fraction(value)


def symbol_of(name: str) -> sympy.Symbol:
    """The symbol by which a parameter stands in a force.

    >>> symbol_of("mu").is_real
    True
    """
    return sympy.Symbol(name, real=True)
