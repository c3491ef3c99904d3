"""A prediction of how large an expression becomes in a computer algebra, made before anything is built."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import comb, prod
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.nodes import (
    Call,
    Name,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Unknown,
    children,
    constant,
)

MAX_EXPONENT: Final = 200
MAX_TERMS: Final = 1000
MAX_DEGREE: Final = 400
MAX_BITS: Final = 10_000
MAX_FUNCTIONS: Final = 4
"""SymPy's questions about the sign of a nested function take time exponential in the nesting."""


@dataclass(frozen=True, slots=True)
class Size:
    """An upper bound on what an expression becomes: terms once expanded, degree, bits of its coefficients' sum."""

    terms: int
    degree: int
    bits: int
    functions: int = 0
    """How deep functions and roots are nested."""


def measure(node: Node) -> Size:
    """Predict the size of the expanded expression without building it.

    Raises InputError, with the column, where an exponent is not a rational constant or is too large, where
    something is divided by zero, and where a bound on terms, degree, digits or nested functions is passed.

    >>> measure(Power(Sum((Number(Fraction(1)), Unknown(0))), Number(Fraction(10)))).terms
    11
    """
    size = _power_size(node) if isinstance(node, Power) else _size(node, [measure(n) for n in children(node)])
    if isinstance(node, Quotient) and constant(node.denominator) == 0:
        raise InputError(f"division by zero at column {node.column}; the denominator is identically 0")
    for what, value, most in (
        ("terms", size.terms, MAX_TERMS),
        ("degree", size.degree, MAX_DEGREE),
        ("bits", size.bits, MAX_BITS),
    ):
        if value > most:
            raise InputError(
                f"the expression at column {node.column} would grow to {what} {_rounded(value)}, at most {most} "
                "are allowed; use smaller exponents or fewer factors"
            )
    if size.functions > MAX_FUNCTIONS:
        raise InputError(
            f"functions are nested {size.functions} deep at column {node.column}; at most {MAX_FUNCTIONS} are allowed"
        )
    return size


def _rounded(value: int) -> str:
    return str(value) if value < 10**9 else f"about 2**{value.bit_length()}"


def _size(node: Node, below: list[Size]) -> Size:
    functions = max((size.functions for size in below), default=0)
    bits = sum(size.bits for size in below)
    match node:
        case Number(value=value):
            return Size(1, 0, value.numerator.bit_length() + value.denominator.bit_length())
        case Name() | Unknown():
            return Size(1, 1, 1)
        case Sum():
            return Size(sum(size.terms for size in below), max(size.degree for size in below), bits, functions)
        case Product() | Quotient():
            return Size(prod(size.terms for size in below), sum(size.degree for size in below), bits, functions)
        case Call():
            return Size(1, below[0].degree, bits, functions + 1)
        case _:
            return below[0]


def _power_size(node: Power) -> Size:
    base, exponent = measure(node.base), _exponent(node)
    n = abs(exponent.numerator)
    whole = exponent.denominator == 1
    terms = comb(n + base.terms - 1, base.terms - 1) if whole else base.terms
    functions = base.functions if whole else base.functions + 1
    return Size(terms, max(n * base.degree, base.degree), max(n * base.bits, base.bits), functions)


def _exponent(node: Power) -> Fraction:
    measure(node.exponent)
    exponent = constant(node.exponent)
    if exponent is None:
        raise InputError(
            f"the exponent at column {node.exponent.column or node.column} is not a rational number; "
            "write other powers with exp and log, as in exp(p*log(1 + u))"
        )
    if max(abs(exponent.numerator), exponent.denominator) > MAX_EXPONENT:
        raise InputError(
            f"the exponent {_shown(exponent)} at column {node.exponent.column or node.column} is too large; "
            f"numerator and denominator may be at most {MAX_EXPONENT}"
        )
    value = constant(node.base)
    if value is not None and ((value == 0 and exponent < 0) or (value < 0 and exponent.denominator != 1)):
        raise InputError(f"the power at column {node.column} of the number {_shown(value)} is not a real number")
    return exponent


def _shown(value: Fraction) -> str:
    text = str(value) if value.numerator.bit_length() + value.denominator.bit_length() < 200 else ""
    return text if text and len(text) <= 40 else f"with {value.numerator.bit_length()} bits"
