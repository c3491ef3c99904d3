"""From coefficients by powers to Horner's rule: in one variable, or nested over several, each in its unit of k."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from flint import fmpq
from sympy import Expr

from ridgeback.symbolic.codegen.number import FLOAT64, Real
from ridgeback.symbolic.codegen.program import (
    Argument,
    Domain,
    Function,
    Operand,
    Operation,
    Polynomial,
    Steps,
    Terms,
    needed,
)

K = "k"
"""The argument that stands for the natural frequency."""


def whole_domain(argument: str, real: Real = FLOAT64) -> Domain:
    """All finite numbers."""
    return Domain(argument, -real.largest, real.largest, known=False)


def derivative(terms: Terms) -> Terms:
    """Exact derivative of a polynomial by its first variable.

    >>> from ridgeback.symbolic.codegen.number import Number
    >>> {p: str(c) for p, c in derivative({(0,): Number(fmpq(1)), (2,): Number(fmpq(-1, 16))}).items()}
    {(1,): '-1/8'}
    """
    return {(p[0] - 1, *p[1:]): type(c)(c.exact * p[0], c.real) for p, c in terms.items() if p[0] > 0}


def nested(steps: Steps, name: str, variables: tuple[str, ...], terms: Mapping[tuple[int, ...], Operand]) -> Operand:
    """Horner's rule over the last variable, its coefficients by the same rule over the others."""
    if len(variables) == 1:
        return steps.horner(name, variables[0], {powers[0]: value for powers, value in terms.items()})
    last = sorted({powers[-1] for powers in terms})
    rows = {q: {powers[:-1]: value for powers, value in terms.items() if powers[-1] == q} for q in last}
    if last == [0]:
        return nested(steps, name, variables[:-1], rows[0])
    inner = {q: nested(steps, steps.fresh(), variables[:-1], rows[q]) for q in last}
    return steps.horner(name, variables[-1], inner)


def measured(steps: Steps, name: str, dimension: int, k: str = K) -> str:
    """A quantity over its power of the natural frequency ``k``, computed when there is one; the name of that.

    A name in brackets, as ``(k)``, is that of 1.
    """
    if dimension == 0:
        return name
    if name.startswith("("):
        return k if dimension < 0 else steps.once("k_inverse", Operation.DIVIDE, steps.number(1), k)
    power = steps.power(k, abs(dimension))
    suffix = "" if abs(dimension) == 1 else f"_{abs(dimension)}"
    if dimension > 0:
        return steps.once(f"{name}_by_k{suffix}", Operation.DIVIDE, name, power)
    return steps.once(f"{name}_times_k{suffix}", Operation.MULTIPLY, name, power)


def polynomial_function(
    name: str,
    summary: str,
    arguments: tuple[Argument, ...],
    variables: tuple[str, ...],
    terms: Terms,
    domain: Domain,
    *,
    factor: str = "",
    units: Mapping[str, int] | None = None,
    real: Real = FLOAT64,
    before: Steps | None = None,
    symbol: str = "y",
    where: tuple[tuple[str, Expr], ...] = (),
    k: str = K,
) -> Function:
    """A polynomial in ``variables``, each first divided by the power of k that ``units`` gives it, times ``factor``.

    ``before`` computes the values of the names in ``where``, of which those are kept that are read.

    >>> from ridgeback.symbolic.codegen.number import Number
    >>> terms = {(0,): Number(fmpq(1)), (2,): Number(fmpq(-1, 16))}
    >>> made = polynomial_function("f", "", (Argument("A", ""),), ("A",), terms, whole_domain("A"))
    >>> [statement.name for statement in made.body]
    ['A_squared', 'y']
    """
    kept: Terms = {powers: c for powers, c in terms.items() if c.exact != 0}
    steps, units = before or Steps(real), units or {}
    used = [any(powers[i] for powers in kept) for i in range(len(variables))]
    names = [measured(steps, v, units.get(v, 0), k) if u else v for v, u in zip(variables, used, strict=True)]
    shift = out_of_range(kept, real) if len(variables) == 1 else 0
    rows = kept
    if shift:
        scale = steps.number(fmpq(2) ** -shift)
        names = [steps.once(f"{names[0]}_scaled", Operation.MULTIPLY, scale, names[0])]
        rows = {p: type(c)(c.exact * fmpq(2) ** (shift * p[0]), c.real) for p, c in kept.items()}
    value: Operand = nested(steps, symbol, tuple(names), rows) if rows else steps.number(0)
    if factor:
        value = steps.multiply("result", factor, value)
    read = {v for v, u in zip(variables, used, strict=True) if u} | {factor}
    told = Polynomial(variables, kept, factor, tuple(pair for pair in where if pair[0] in read))
    return Function(name, summary, arguments, needed(steps.taken, value), value, domain, (), told)


def out_of_range(terms: Terms, real: Real) -> int:
    """e such that the variable over 2^e has coefficients that the format holds; 0 where they are held as they are.

    A multiplication by a power of two is exact, so that nothing else changes.

    >>> from ridgeback.symbolic.codegen.number import Number
    >>> out_of_range({(n,): Number(fmpq(1, 3**n)) for n in range(0, 2000, 2)}, FLOAT64)
    2
    """
    sizes = {p[0]: _magnitude(c.exact) for p, c in terms.items() if isinstance(c.exact, fmpq)}
    low, high = real.low + 2 * real.digits, real.high - 8
    if not sizes or all(low < size < high for size in sizes.values()):
        return 0
    rate = Fraction(sizes[max(sizes)] - sizes[min(sizes)], max(1, max(sizes) - min(sizes)))
    return round(-rate)


def _magnitude(exact: fmpq) -> int:
    return int(exact.p).bit_length() - int(exact.q).bit_length()
