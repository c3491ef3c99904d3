"""The expression tree: frozen nodes, their text and their constants."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, TypeAlias


@dataclass(frozen=True, slots=True)
class Number:
    """A non-negative decimal literal, exact."""

    value: Fraction
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Name:
    """A parameter, or the constant ``pi``."""

    name: str
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Unknown:
    """The unknown function of time (0), its first (1) or its second derivative (2)."""

    derivative: Literal[0, 1, 2]
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Negate:
    """Minus the operand."""

    operand: Node
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Sum:
    """Two or more terms; a subtraction is a negated term."""

    terms: tuple[Node, ...]
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Product:
    """Two or more factors."""

    factors: tuple[Node, ...]
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Quotient:
    """One division; ``a/b/c`` is ``a`` over the product of ``b`` and ``c``."""

    numerator: Node
    denominator: Node
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Power:
    """A base to a constant rational exponent."""

    base: Node
    exponent: Node
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Call:
    """One of the known functions of one argument."""

    function: str
    argument: Node
    column: int = field(default=0, compare=False, repr=False)


Node: TypeAlias = Number | Name | Unknown | Negate | Sum | Product | Quotient | Power | Call


def children(node: Node) -> tuple[Node, ...]:
    """The nodes directly below, in the order in which they are written.

    >>> children(Negate(Name("k")))
    (Name(name='k'),)
    """
    match node:
        case Negate(operand=below) | Call(argument=below):
            return (below,)
        case Sum(terms=below) | Product(factors=below):
            return below
        case Quotient(numerator=first, denominator=second) | Power(base=first, exponent=second):
            return (first, second)
        case _:
            return ()


def names(node: Node) -> tuple[str, ...]:
    """The parameter names in a tree, in order of first appearance; ``pi`` is not one.

    >>> names(Product((Name("k"), Name("pi"), Negate(Name("k")))))
    ('k',)
    """
    if isinstance(node, Name):
        return () if node.name == "pi" else (node.name,)
    return tuple(dict.fromkeys(name for below in children(node) for name in names(below)))


def to_text(node: Node, *, unknown: str = "u") -> str:
    """The text that parses back to the same tree.

    >>> to_text(Sum((Unknown(2), Negate(Power(Unknown(0), Number(Fraction(3)))))))
    "u'' - u**3"
    """

    def write(below: Node) -> str:
        return to_text(below, unknown=unknown)

    def inside(below: Node, *loose: type) -> str:
        return f"({write(below)})" if isinstance(below, loose) else write(below)

    match node:
        case Number(value=value):
            return _decimal(value)
        case Name(name=name):
            return name
        case Unknown(derivative=derivative):
            return unknown + "'" * derivative
        case Negate(operand=operand):
            return "-" + inside(operand, Sum, Negate)
        case Sum(terms=terms):
            signed = [inside(term, Sum) for term in terms]
            return signed[0] + "".join(f" - {t[1:]}" if t[0] == "-" else f" + {t}" for t in signed[1:])
        case Product(factors=factors):
            return "*".join(inside(factor, Sum, Negate, Product, Quotient) for factor in factors)
        case Quotient(numerator=above, denominator=below):
            return inside(above, Sum, Negate, Quotient) + "/" + inside(below, Sum, Negate, Product, Quotient)
        case Power(base=base, exponent=exponent):
            compound = (Sum, Negate, Product, Quotient, Power)
            return inside(base, *compound) + "**" + inside(exponent, *compound)
    return f"{node.function}({write(node.argument)})"


def _decimal(value: Fraction) -> str:
    """A literal of exactly this value: an integer, or digits with a decimal exponent."""
    places = 0
    while (value * 10**places).denominator != 1:
        places += 1
    digits = int(value * 10**places)
    return f"{digits}e-{places}" if places else str(digits)


def extreme(name: str, first: Node, second: Node, column: int = 0) -> Node:
    """(a + b + abs(a - b))/2 for the larger, with a minus for the smaller.

    >>> to_text(extreme("max", Unknown(0), Number(Fraction(0))))
    '(u + abs(u))/2'
    """
    zero = isinstance(second, Number) and second.value == 0
    apart = first if zero else Sum((first, Negate(second)))
    size: Node = Call("abs", apart, column)
    bent = size if name == "max" else Negate(size, column)
    terms = (first, bent) if zero else (first, second, bent)
    return Quotient(Sum(terms, column), Number(Fraction(2), column), column)


def constant(node: Node) -> Fraction | None:
    """The rational value of a tree of numbers alone, None when a name, the unknown or a function occurs.

    Call it on trees that ``measure`` has accepted; a division by zero gives None as well.

    >>> constant(Quotient(Number(Fraction(1)), Number(Fraction(3))))
    Fraction(1, 3)
    """
    if isinstance(node, Number):
        return node.value
    values = [constant(below) for below in children(node)]
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return None
    match node:
        case Negate():
            return -known[0]
        case Sum():
            return sum(known, Fraction(0))
        case Product():
            return _product(known)
        case Quotient():
            return known[0] / known[1] if known[1] else None
        case Power():
            whole = known[1].denominator == 1 and (known[0] != 0 or known[1] >= 0)
            return known[0] ** int(known[1]) if whole else None
        case _:
            return None


def _product(values: list[Fraction]) -> Fraction:
    result = Fraction(1)
    for value in values:
        result *= value
    return result
