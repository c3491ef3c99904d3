"""One coefficient form: exact constants, each with its nearest double, and functions as Horner steps.

Every target language prints the same constants and the same steps in the same order, so that all of them give the
same double for the same argument (as long as the compiler does not fuse a product with a sum).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from sympy import Add, Expr, Integer, Mul, Pow, Rational, Symbol, cos
from sympy.codegen.ast import Assignment

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.rounding import rounding_note, roundings

K = Symbol("k")
Powers = tuple[int, ...]
Terms = Mapping[Powers, Expr]


@dataclass(frozen=True)
class Constant:
    """An exact coefficient under the name it has in the code, and the one double that stands for it."""

    name: str
    exact: Expr
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
    notes: tuple[str, ...] = ()
    """What is proved about the result."""


@dataclass(frozen=True)
class Form:
    """All that a writer needs: the functions, and the facts that must travel with them."""

    system: str
    title: str
    facts: tuple[str, ...]
    """Lines of documentation: equation, method, amplitude definition, order, range of use."""
    functions: tuple[Function, ...]

    @property
    def uses_library(self) -> bool:
        """Whether a square root or a cosine is taken, which the languages have in their mathematical library."""
        found = [step.rhs for function in self.functions for step in function.steps]
        return any(rhs.has(cos) or any(p.exp == Rational(1, 2) for p in rhs.atoms(Pow)) for rhs in found)


DIGITS = 40
"""Enough that rounding an algebraic number to a double is decided."""


def nearest_double(exact: Expr) -> float:
    """The double nearest to a rational (one rounding, half to even) or algebraic number.

    Raises InputError when the number is beyond the doubles or would become zero.

    >>> nearest_double(Rational(1, 3072)).hex()
    '0x1.5555555555555p-12'
    """
    ratio = exact if exact.is_Rational else Rational(str(exact.evalf(DIGITS)))
    try:
        value = int(ratio.p) / int(ratio.q)  # Python's division of integers rounds correctly
    except OverflowError:
        value = math.inf
    if not math.isfinite(value) or (value == 0 and exact != 0):
        raise InputError(
            f"a coefficient of about 10^{decimal_exponent(ratio)} has no double; generate code for a lower order"
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
        Constant(constant_name(prefix, powers), terms[powers], nearest_double(terms[powers]))
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

    def measured(self, name: str, dimension: int) -> str:
        """A quantity over its power of k, computed when there is one; return the name of what is computed."""
        if dimension == 0:
            return name
        power: Expr = K
        if name.startswith("("):
            return "k" if dimension < 0 else str(self.once("k_inverse", 1 / K).name)
        for n in range(2, abs(dimension) + 1):
            power = self.once(f"k_{n}", product(K, power))
        if dimension > 0:
            suffix = "by_k" if dimension == 1 else f"by_k_{dimension}"
            return str(self.once(f"{name}_{suffix}", Symbol(name) / power).name)
        suffix = "times_k" if dimension == -1 else f"times_k_{-dimension}"
        return str(self.once(f"{name}_{suffix}", product(Symbol(name), power)).name)

    def once(self, name: str, value: Expr) -> Symbol:
        """Append ``name = value`` unless the name has been computed, and return it."""
        known = any(step.lhs.name == name for step in self.taken)
        return Symbol(name) if known else self.assign(name, value)

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


def polynomial(prefix: str, names: tuple[str, ...], terms: Terms, steps: Steps, name: str = "y") -> Expr:
    """Append the Horner steps of a polynomial; the outermost rule runs over the last variable.

    >>> steps = Steps()
    >>> polynomial("C", ("A",), {(0,): Rational(1), (2,): Rational(-1, 16)}, steps)
    y
    >>> [f"{step.lhs} = {step.rhs}" for step in steps.taken]
    ['A_squared = A*A', 'y = C2', 'y = A_squared*y + C0']
    """
    if not terms:
        return Integer(0)
    rows: dict[Powers, Expr] = {powers: Symbol(constant_name(prefix, powers)) for powers in sorted(terms)}
    return nested(names, rows, steps, name)


def nested(names: tuple[str, ...], rows: Mapping[Powers, Expr], steps: Steps, name: str) -> Expr:
    """Horner's rule over the last variable, its coefficients by the same rule over the others."""
    last = sorted({powers[-1] for powers in rows})
    if len(names) == 1:
        return steps.horner(name, Symbol(names[0]), {power: rows[(power,)] for power in last})
    if last == [0]:
        return nested(names[:-1], {powers[:-1]: value for powers, value in rows.items()}, steps, name)
    outer = {}
    for power in last:
        below = {powers[:-1]: value for powers, value in rows.items() if powers[-1] == power}
        outer[power] = nested(names[:-1], below, steps, f"{name}{power}" if name == "y" else f"{name}_{power}")
    return steps.horner(name, Symbol(names[-1]), outer)


def derivative(terms: Terms) -> dict[Powers, Expr]:
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
    units: Mapping[str, int] | None = None,
) -> Function:
    """A polynomial in the leading arguments, or in the quantities that ``units`` names in their order.

    ``factor`` (the natural frequency k) multiplies the result; ``units`` gives the power of k that a quantity is
    measured in, and the quantity with a name in brackets, as ``"(k)"``, is 1.
    """
    kept = {powers: coefficient for powers, coefficient in terms.items() if coefficient != 0}
    units, count = units or {}, len(next(iter(terms), (0,)))
    ordered = tuple(units) if len(units) == count else tuple(a.name for a in arguments[:count])
    used = [any(powers[index] for powers in kept) for index in range(count)]
    steps = Steps()
    names = [steps.measured(n, units.get(n, 0)) if u else n for n, u in zip(ordered, used, strict=True)]
    value = polynomial(prefix, tuple(names), kept, steps)
    result = value if factor is None else product(factor, value)
    constants = constants_of(prefix, kept)
    note = rounding_note(roundings(constants, steps.taken, result))
    return Function(name, summary, arguments, constants, tuple(steps.taken), result, (note,))
