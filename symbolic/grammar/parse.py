"""Equations as text: a recursive descent over our own tokens; text is never evaluated.

Grammar (``^`` is ``**``, blanks are free, nothing multiplies implicitly)::

    equation   = expression [ "=" expression ]
    expression = [ "+" | "-" ] term { ( "+" | "-" ) term }
    term       = signed { ( "*" | "/" ) signed }
    signed     = ( "+" | "-" ) signed | power
    power      = atom [ "**" signed ]
    atom       = number | name | name "'" | name "''" | function "(" expression ")" | "(" expression ")"
               | ( "max" | "min" ) "(" expression "," expression ")"

``max(a, b)`` is read as (a + b + abs(a - b))/2, and an odd root of u or u' is the real one.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from typing import Final, Literal, cast

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.kinks import U, V, W
from ridgeback.symbolic.grammar.nodes import (
    Call,
    Name,
    Negate,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Unknown,
    children,
    extreme,
    names,
    to_text,
)
from ridgeback.symbolic.grammar.size import measure
from ridgeback.symbolic.grammar.to_sympy import FUNCTIONS, to_sympy
from ridgeback.symbolic.grammar.tokens import Token, number_value, parse_number, quoted, tokenize

__all__ = [
    "FUNCTIONS",
    "Call",
    "Equation",
    "Name",
    "Negate",
    "Node",
    "Number",
    "Power",
    "Product",
    "Quotient",
    "Sum",
    "U",
    "Unknown",
    "V",
    "W",
    "children",
    "names",
    "parse_equation",
    "parse_expression",
    "parse_number",
    "to_sympy",
    "to_text",
]

MAX_NESTING: Final = 30
MAX_NODES: Final = 1000

_INSTEAD: Final = {
    "ln": "log",
    "arcsin": "asin",
    "arctan": "atan",
    "arcsinh": "asinh",
    "arctanh": "atanh",
    "sh": "sinh",
    "Abs": "abs",
    "fabs": "abs",
    "sgn": "sign",
    "Max": "max",
    "Min": "min",
    "heaviside": "sign",
    "Heaviside": "sign",
}
EXTREMES: Final = ("max", "min")
"""Functions of two arguments, which abs expresses."""


@dataclass(frozen=True, slots=True)
class Equation:
    """``left = 0`` for the unknown function of time called ``unknown``; ``text`` is what was read."""

    unknown: str
    left: Node
    text: str


def parse_equation(text: str) -> Equation:
    """Read a second-order equation such as ``u'' + 2*mu*u' + k**2*sin(u) = 0``; ``= 0`` may be left out.

    Parameters
    ----------
    text : str
        The equation; the unknown is whatever name carries the two primes.

    Returns
    -------
    Equation
        The tree of its left-hand side, the right one subtracted, and the unknown's name.

    Raises
    ------
    InputError
        One line with the column, for anything outside the grammar or beyond the bounds on length, nesting, digits,
        exponents and predicted size.

    Examples
    --------
    >>> parse_equation("theta'' = -sin(theta)").unknown
    'theta'
    >>> parse_equation("2u + u''")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: missing operator before 'u' at column 2; write 2*u
    """
    tokens = tokenize(text)
    unknown = _unknown(tokens)
    parser = _Parser(tokens, unknown)
    left = parser.expression()
    if parser.take("="):
        left = _moved_left(left, parser.expression())
    parser.finish()
    if not any(token.primes == 2 for token in tokens):
        raise InputError(f"{quoted(text)} has no second derivative; write it with two primes, as in u'' + u = 0")
    measure(left)
    return Equation(cast(str, unknown), left, text)


def parse_expression(text: str, *, unknown: str | None = None) -> Node:
    """Read an expression.

    Parameters
    ----------
    text : str
        The expression.
    unknown : str, optional
        The unknown's name; without it, the name that carries primes (if any) is it.

    Returns
    -------
    Node
        Its tree.

    Raises
    ------
    InputError
        As ``parse_equation`` does.

    Examples
    --------
    >>> to_text(parse_expression("1 - cos(u)", unknown="u"))
    '1 - cos(u)'
    """
    tokens = tokenize(text)
    parser = _Parser(tokens, _unknown(tokens, unknown))
    node = parser.expression()
    parser.finish()
    measure(node)
    return node


def _moved_left(left: Node, right: Node) -> Node:
    if isinstance(right, Number) and right.value == 0:
        return left
    terms = left.terms if isinstance(left, Sum) else (left,)
    return Sum((*terms, Negate(right, right.column)), left.column)


def _unknown(tokens: tuple[Token, ...], given: str | None = None) -> str | None:
    """The one name that carries primes."""
    unknown = given
    for token in tokens:
        if not token.primes:
            continue
        if unknown is None:
            unknown = token.text
        if token.text != unknown:
            raise InputError(
                f"derivatives of both {quoted(unknown)} and {quoted(token.text)} (column {token.column}) occur; "
                "an oscillator has one unknown"
            )
        if token.text in FUNCTIONS or token.text == "pi":
            raise InputError(
                f"{quoted(token.text)} at column {token.column} is reserved; give the unknown another name"
            )
    return unknown


class _Parser:
    """Position in the token list, and the counts that bound recursion and size."""

    def __init__(self, tokens: tuple[Token, ...], unknown: str | None) -> None:
        self.tokens = tokens
        self.unknown = unknown
        self.index = 0
        self.nesting = 0
        self.nodes = 0

    @property
    def current(self) -> Token:
        return self.tokens[self.index]

    def take(self, *operators: str) -> Token | None:
        """The current token if it is one of these operators, stepping over it."""
        token = self.current
        if token.kind != "operator" or token.text not in operators:
            return None
        self.index += 1
        return token

    def enter(self, token: Token) -> None:
        """Count one level of recursion; ``leave`` undoes it."""
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            raise InputError(f"nesting deeper than {MAX_NESTING} at column {token.column}; simplify the expression")

    def leave(self) -> None:
        self.nesting -= 1

    def count(self, column: int) -> int:
        self.nodes += 1
        if self.nodes > MAX_NODES:
            raise InputError(f"more than {MAX_NODES} numbers, names and operations at column {column}; simplify")
        return column

    def expression(self) -> Node:
        column = self.current.column
        sign = self.take("+", "-")
        terms = [self.negated(self.term(), sign)]
        while (sign := self.take("+", "-")) is not None:
            terms.append(self.negated(self.term(), sign))
        return terms[0] if len(terms) == 1 else Sum(tuple(terms), self.count(column))

    def negated(self, node: Node, sign: Token | None) -> Node:
        return Negate(node, self.count(sign.column)) if sign is not None and sign.text == "-" else node

    def term(self) -> Node:
        column = self.current.column
        above: list[Node] = [self.signed()]
        below: list[Node] = []
        while (operator := self.take("*", "/")) is not None:
            (above if operator.text == "*" else below).append(self.signed())
        numerator = self.product(above, column)
        return Quotient(numerator, self.product(below, column), self.count(column)) if below else numerator

    def product(self, factors: list[Node], column: int) -> Node:
        return factors[0] if len(factors) == 1 else Product(tuple(factors), self.count(column))

    def signed(self) -> Node:
        sign = self.take("+", "-")
        if sign is None:
            return self.power()
        self.enter(sign)
        node = self.negated(self.signed(), sign)
        self.leave()
        return node

    def power(self) -> Node:
        column = self.current.column
        base = self.atom()
        operator = self.take("**", "^")
        if operator is None:
            return base
        self.enter(operator)
        exponent = self.signed()
        self.leave()
        return Power(base, exponent, self.count(column))

    def atom(self) -> Node:
        token = self.current
        if token.kind == "number":
            node: Node = Number(number_value(token.text), self.count(token.column))
        elif token.kind == "name":
            return self.named(token)
        elif token.text == "(":
            return self.bracketed(token)
        else:
            raise self.unexpected()
        self.index += 1
        self.refuse_juxtaposition(token.text)
        return node

    def bracketed(self, opening: Token) -> Node:
        self.index += 1
        self.enter(opening)
        node = self.expression()
        self.leave()
        if self.take(")") is None:
            self.refuse_juxtaposition("the value before")
            if self.current.text == ",":
                raise InputError(
                    f"the , at column {self.current.column} separates nothing; only max and min have two arguments"
                )
            raise InputError(f"the bracket opened at column {opening.column} is not closed; add )")
        self.refuse_juxtaposition("(...)")
        return node

    def named(self, token: Token) -> Node:
        self.index += 1
        if self.current.text == "(":
            return self.extreme(token) if token.text in EXTREMES else self.call(token)
        if token.text in FUNCTIONS:
            raise InputError(
                f"the function {token.text} at column {token.column} has no argument; write {token.text}(u)"
            )
        self.refuse_juxtaposition(token.text + "'" * token.primes)
        if token.text == self.unknown:
            return Unknown(cast(Literal[0, 1, 2], token.primes), self.count(token.column))
        return Name(token.text, self.count(token.column))

    def call(self, token: Token) -> Node:
        if token.text not in FUNCTIONS or token.primes:
            raise _unknown_function(token, is_unknown=token.text == self.unknown)
        opening = self.current
        if self.tokens[self.index + 1].text == ")":
            raise InputError(f"{token.text}() at column {token.column} has no argument; write {token.text}(u)")
        return Call(token.text, self.bracketed(opening), self.count(token.column))

    def extreme(self, token: Token) -> Node:
        """max or min of two expressions, by abs."""
        opening = self.current
        self.index += 1
        self.enter(opening)
        first = self.expression()
        if self.take(",") is None:
            raise InputError(f"{token.text} at column {token.column} takes two arguments; write {token.text}(u, 0)")
        second = self.expression()
        self.leave()
        if self.take(")") is None:
            raise InputError(f"the bracket opened at column {opening.column} is not closed; add )")
        self.refuse_juxtaposition("(...)")
        self.count(token.column)
        return extreme(token.text, first, second, token.column)

    def refuse_juxtaposition(self, before: str) -> None:
        token = self.current
        if token.kind in ("number", "name") or token.text == "(":
            after = token.text + "'" * token.primes if token.kind != "operator" else "(...)"
            raise InputError(
                f"missing operator before {quoted(token.text)} at column {token.column}; write {before}*{after}"
            )

    def unexpected(self) -> InputError:
        token = self.current
        if token.kind == "end":
            return InputError(f"the text ends at column {token.column} where a number, a name or ( should follow")
        return InputError(f"unexpected {quoted(token.text)} at column {token.column}; a number, a name or ( fits here")

    def finish(self) -> None:
        token = self.current
        if token.text == ")":
            raise InputError(f"the bracket ) at column {token.column} closes nothing; remove it or add (")
        if token.text == "=":
            raise InputError(f"an extra = at column {token.column}; an equation has one, an expression has none")
        if token.kind != "end":
            raise self.unexpected()


def _unknown_function(token: Token, *, is_unknown: bool) -> InputError:
    name, where = token.text, f"{quoted(token.text)} at column {token.column}"
    if is_unknown or token.primes:
        mark = "'" * token.primes
        return InputError(f"{where} is the unknown, not a function; write {name}{mark} or {name}{mark}*(...)")
    known = (*FUNCTIONS, *EXTREMES)
    close = difflib.get_close_matches(_INSTEAD.get(name, name), known, 1)
    hint = f"did you mean {close[0]}?" if close else f"to multiply write {name}*(...)"
    return InputError(f"{where} is not a known function; {hint} (known: {', '.join(known)})")
