"""One coefficient form: exact constants, each with its nearest double, and functions as Horner steps.

Every target language prints the same constants and the same steps in the same order, so that all of them give the
same double for the same argument (as long as the compiler does not fuse a product with a sum).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from sympy import Add, Expr, Integer, Mul, Rational, Symbol
from sympy.codegen.ast import Assignment

from symbolic.errors import InputError

Powers = tuple[int, ...]
Terms = Mapping[Powers, Rational]


@dataclass(frozen=True)
class Constant:
    """An exact coefficient under the name it has in the code, and the one double that stands for it."""

    name: str
    exact: Rational
    nearest: float


@dataclass(frozen=True)
class Argument:
    """What a function takes: its name, its meaning, and its default where there is one."""

    name: str
    meaning: str
    default: float | None = None


@dataclass(frozen=True)
class Function:
    """A polynomial as a list of assignments; ``result`` is what it returns."""

    name: str
    summary: str
    arguments: tuple[Argument, ...]
    constants: tuple[Constant, ...]
    steps: tuple[Assignment, ...]
    result: Expr


@dataclass(frozen=True)
class Form:
    """All that a writer needs: the functions, and the facts that must travel with them."""

    system: str
    title: str
    facts: tuple[str, ...]
    """Lines of documentation: equation, method, amplitude definition, order, range of use."""
    functions: tuple[Function, ...]


def nearest_double(exact: Rational) -> float:
    """The double nearest to a rational: one rounding, half to even.

    Raises InputError when the number is beyond the doubles or would become zero.

    >>> nearest_double(Rational(1, 3072)).hex()
    '0x1.5555555555555p-12'
    """
    try:
        value = int(exact.p) / int(exact.q)  # Python's division of integers rounds correctly
    except OverflowError:
        value = math.inf
    if not math.isfinite(value) or (value == 0 and exact != 0):
        raise InputError(
            f"a coefficient of about 10^{decimal_exponent(exact)} has no double; generate code for a lower order"
        )
    return value


def decimal_exponent(exact: Rational) -> int:
    """Decimal exponent of a rational too large or too small to be a float, to within one.

    >>> decimal_exponent(Rational(10**400))
    400
    """
    bits = abs(int(exact.p)).bit_length() - int(exact.q).bit_length()
    return round(bits * math.log10(2))


def distance(exact: Rational, value: float) -> Fraction:
    """Exact distance between a rational and a double.

    >>> distance(Rational(1, 4), 0.25)
    Fraction(0, 1)
    """
    return abs(Fraction(int(exact.p), int(exact.q)) - Fraction(value))


def constants_of(prefix: str, terms: Terms) -> tuple[Constant, ...]:
    """Name every coefficient by its powers, rising: ``C4`` is that of A^4, ``W2_1`` that of a^2 mu.

    >>> [(c.name, c.nearest) for c in constants_of("C", {(2,): Rational(-1, 16), (0,): Rational(1)})]
    [('C0', 1.0), ('C2', -0.0625)]
    """
    return tuple(
        Constant(constant_name(prefix, powers), Rational(terms[powers]), nearest_double(Rational(terms[powers])))
        for powers in sorted(terms)
    )


def constant_name(prefix: str, powers: Powers) -> str:
    """Name of the coefficient of these powers."""
    return prefix + "_".join(map(str, powers))


def product(*factors: Expr) -> Expr:
    """A product that stays written out: A*A, not A**2, so that every language multiplies alike."""
    return Mul(*factors, evaluate=False)


class Steps:
    """Assignments collected in order; a name is computed once."""

    def __init__(self) -> None:
        self.taken: list[Assignment] = []
        self.squares: dict[Symbol, Symbol] = {}

    def assign(self, name: str, value: Expr) -> Symbol:
        """Append ``name = value`` and return the name as a symbol."""
        symbol = Symbol(name)
        self.taken.append(Assignment(symbol, value))
        return symbol

    def square(self, variable: Symbol) -> Symbol:
        """The square of an argument, computed on first use."""
        if variable not in self.squares:
            self.squares[variable] = self.assign(f"{variable.name}_squared", product(variable, variable))
        return self.squares[variable]

    def horner(self, name: str, variable: Symbol, coefficients: Mapping[int, Expr]) -> Expr:
        """Evaluate sum_p coefficients[p] * variable^p by Horner's rule, in variable^2 where that is possible."""
        low, high = min(coefficients), max(coefficients)
        even = all((power - low) % 2 == 0 for power in coefficients)
        stride, step = (2, self.square(variable)) if even and high > 1 else (1, variable)
        value = self.assign(name, coefficients[high])
        for power in range(high - stride, low - 1, -stride):
            value = self.assign(name, add(product(step, value), coefficients.get(power)))
        for _ in range(low // stride):
            value = self.assign(name, product(step, value))
        return product(variable, value) if low % stride else value


def add(term: Expr, coefficient: Expr | None) -> Expr:
    """Horner's sum; a missing coefficient costs nothing."""
    return term if coefficient is None else Add(coefficient, term)


def polynomial(prefix: str, names: tuple[str, ...], terms: Terms, steps: Steps) -> Expr:
    """Append the Horner steps of a polynomial in one or two variables; of two, the outer rule runs over the second.

    >>> steps = Steps()
    >>> polynomial("C", ("A",), {(0,): Rational(1), (2,): Rational(-1, 16)}, steps)
    y
    >>> [f"{step.lhs} = {step.rhs}" for step in steps.taken]
    ['A_squared = A*A', 'y = C2', 'y = A_squared*y + C0']
    """
    if not terms:
        return Integer(0)
    inner = dict(by_outer_power(prefix, terms))
    if len(names) == 1:
        return steps.horner("y", Symbol(names[0]), inner[0])
    first = Symbol(names[0])
    outer = {power: steps.horner(f"y{power}", first, row) for power, row in inner.items()}
    return steps.horner("y", Symbol(names[1]), outer)


def by_outer_power(prefix: str, terms: Terms) -> Iterator[tuple[int, dict[int, Expr]]]:
    """Coefficient symbols by the power of the second variable (0 where there is none), then of the first."""
    for outer in sorted({powers[1] if len(powers) > 1 else 0 for powers in terms}):
        yield (
            outer,
            {
                powers[0]: Symbol(constant_name(prefix, powers))
                for powers in sorted(terms)
                if (powers[1] if len(powers) > 1 else 0) == outer
            },
        )


def derivative(terms: Terms) -> dict[Powers, Rational]:
    """Exact derivative of a polynomial by its first variable.

    >>> derivative({(0,): Rational(1), (2,): Rational(-1, 16)})
    {(1,): -1/8}
    """
    return {(p[0] - 1, *p[1:]): c * p[0] for p, c in terms.items() if p[0] > 0}


def function(
    name: str,
    summary: str,
    prefix: str,
    arguments: tuple[Argument, ...],
    terms: Terms,
    *,
    factor: Symbol | None = None,
    per: Mapping[str, Symbol] | None = None,
) -> Function:
    """A polynomial in the leading arguments.

    ``factor`` (the natural frequency) multiplies the result; ``per`` names the arguments that enter divided by it.
    """
    count = len(next(iter(terms), (0,)))
    kept = {powers: coefficient for powers, coefficient in terms.items() if coefficient != 0}
    steps = Steps()
    names = tuple(a.name for a in arguments[:count])
    for index, own in enumerate(names):
        if per and own in per and any(powers[index] for powers in kept):
            scaled = steps.assign(f"{own}_by_{per[own]}", Symbol(own) / per[own])
            names = (*names[:index], scaled.name, *names[index + 1 :])
    value = polynomial(prefix, names, kept, steps)
    result = value if factor is None else product(factor, value)
    return Function(name, summary, arguments, constants_of(prefix, kept), tuple(steps.taken), result)
