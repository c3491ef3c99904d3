"""A closed expression in parameters as operations: sums, products, and powers whose exponents are rational."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce

from flint import fmpq
from sympy import Add, Expr, Mul, Pow, Rational, Symbol

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.number import Exact
from ridgeback.symbolic.codegen.program import Operand, Operation, Steps


def exact_number(value: Expr) -> Exact:
    """A number without symbols as a coefficient: FLINT's rational where it is one.

    >>> exact_number(Rational(3, 8)), exact_number(Rational(2) ** Rational(1, 2))
    (3/8, sqrt(2))
    """
    return fmpq(int(value.p), int(value.q)) if isinstance(value, Rational) else value


def valued(steps: Steps, value: Expr, named: Mapping[str, str]) -> Operand:
    """Append what computes an expression; ``named`` gives the names in the code of its symbols.

    Raises InputError for another function than those in the title.

    >>> from sympy import sqrt, symbols
    >>> k, m = symbols("k m", real=True)
    >>> steps = Steps()
    >>> name = valued(steps, sqrt(k / m), {"k": "k", "m": "m"})
    >>> [(s.name, s.operation.value, s.operands) for s in steps.taken]
    [('y1', '/', ('k', 'm')), ('y2', 'sqrt', ('y1',))]
    """
    if value.is_number:
        return steps.number(exact_number(value))
    if isinstance(value, Symbol):
        return named[value.name]
    if isinstance(value, Add):
        terms = [valued(steps, term, named) for term in value.args]
        return reduce(lambda a, b: steps.add(steps.fresh(), a, b), terms)
    if isinstance(value, Mul):
        return _product(steps, value, named)
    if isinstance(value, Pow) and isinstance(value.exp, Rational):
        return _power(steps, value.base, value.exp, named)
    raise InputError(f"no code is written for {value}; give its parameters numbers")


def _product(steps: Steps, value: Mul, named: Mapping[str, str]) -> Operand:
    """Factors with negative exponents below one bar; one root of a quotient is a root of it."""
    above, below = value.as_numer_denom()
    if below == 1 or (above.is_number and below.is_number):
        parts = [valued(steps, factor, named) for factor in value.args]
        return reduce(lambda a, b: steps.multiply(steps.fresh(), a, b), parts)
    return steps.divide(steps.fresh(), valued(steps, above, named), valued(steps, below, named))


def _power(steps: Steps, base: Expr, exponent: Rational, named: Mapping[str, str]) -> Operand:
    if exponent < 0:
        return steps.divide(steps.fresh(), steps.number(1), valued(steps, base**-exponent, named))
    name = named_value(steps, valued(steps, base, named))
    whole, part = divmod(int(exponent.p), int(exponent.q))
    value: Operand | None = rooted(steps, name, part, int(exponent.q)) if part else None
    if whole:
        raised = steps.power(name, whole)
        value = raised if value is None else steps.multiply(steps.fresh(), raised, value)
    return steps.number(1) if value is None else value


def named_value(steps: Steps, value: Operand) -> str:
    """A value under a name: of its own where it is a number."""
    return value if isinstance(value, str) else steps.multiply(steps.fresh(), value, steps.number(1))


def rooted(steps: Steps, name: str, n: int, degree: int) -> str:
    """name^(n/degree) for n >= 1."""
    root = name
    while degree % 2 == 0:
        root, degree = steps.root(steps.fresh(), root), degree // 2
    if degree > 1:
        root = steps.assign(steps.fresh(), Operation.ROOT, root, steps.number(degree))
    return steps.power(root, n)
