r"""A function of one variable run over a part of its domain by ``analysis``, its other arguments at their defaults.

A function that vanishes with its variable, A^p y(A) with y(0) not 0, has a relative error at 0 all the same.  Scaling A
by a power of two in the last products, with y left as it is, scales the result by one, and all its roundings: so on a
part that holds 0, y is taken over that part, and the products over the one binade [m, 2 m].  m is the smallest A of
which anything is said: there what underflows counts most.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final, TypeAlias

from flint import arb, arb_poly, fmpq

from ridgeback.symbolic.arithmetic.balls import whole_power
from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.program import (
    Form,
    Function,
    Horner,
    Operation,
    Statement,
    Step,
    Terms,
    operands_of,
)
from ridgeback.symbolic.codegen.proofs.analysis import Analysis, Computed

EXPANDED: Final = 64
"""The highest degree of a polynomial whose exact values are found by expanding it."""
PIECES: Final = 8
"""Of a binade."""
WIDE: Final = 16
"""A ball with a radius of more than this share of its middle is replaced by a narrower one, where there is one."""


@dataclass(frozen=True)
class Seen:
    """The function on a part of its domain, and what its relative error is judged by."""

    whole: Computed
    parts: tuple[Computed, ...]


Run: TypeAlias = Callable[[arb], Seen]


def runner(form: Form, function: Function) -> Run | None:
    """The analysis on a part of the domain; None where an argument has no default, or the domain no known end."""
    variable = function.domain.argument
    others = {a.name: a.default for a in function.arguments if a.name != variable}
    known = function.domain.known or variable not in function.read()
    if not known or None in others.values():
        return None
    fixed = {name: Computed(arb(value), arb(0)) for name, value in others.items() if value is not None}
    constants: dict[int, Computed] = {}  # by identity: they live as long as the form

    def begun(at: arb) -> Analysis:
        return Analysis({**fixed, variable: Computed(at, arb(0))}, form, constants)

    def run(box: arb) -> Seen:
        whole = _value(begun(box), function, function.body, box)
        if not least(function, form.real) or not box.contains(0):
            return Seen(whole, (whole,))
        return Seen(whole, tuple(_scaled(begun(box), function, box, form.real)))

    return run


def _value(analysis: Analysis, function: Function, body: tuple[Statement, ...], box: arb) -> Computed:
    if function.compensated and function.polynomial is not None:
        return analysis.run_to_sum(body, function, exact_value(_terms(function), box))
    found = analysis.run(body, function.result)
    if not _alone(function) or found.exact.rad() * WIDE < abs(found.exact.mid()):
        return found
    factor = function.polynomial.factor if function.polynomial else ""
    exact = exact_value(_terms(function), box) * (analysis.known[factor].exact if factor else 1)
    return replace(found, exact=exact.intersection(found.exact))


def _alone(function: Function) -> bool:
    """Whether a function is a polynomial in the variable of its domain, and in no other."""
    return function.polynomial is not None and function.polynomial.variables == (function.domain.argument,)


def least(function: Function, real: Real) -> fmpq:
    """m: the smallest size of the variable for which a relative error is claimed; 0 where the value at 0 is not 0."""
    power = min(_terms(function), default=0) if _alone(function) else 0
    return fmpq(2) ** ((real.low + 4 * real.digits) // power) if power > 0 else fmpq(0)


def _scaled(analysis: Analysis, function: Function, box: arb, real: Real) -> Iterator[Computed]:
    """The function on each piece of [m, 2 m], y being that of the part that holds 0."""
    terms, m, variable = _terms(function), arb(least(function, real)), function.domain.argument
    power, cut = min(terms), _last_products(function)
    analysis.run(function.body[:cut], Number(fmpq(0)))
    y = exact_value({p - power: c for p, c in terms.items()}, box)
    monomials = _monomials(function.body[:cut], function)
    for i in range(PIECES):
        piece = (m * (PIECES + i) / PIECES).union(m * (PIECES + i + 1) / PIECES)
        analysis.known[variable] = Computed(piece, arb(0))
        analysis.run(monomials, Number(fmpq(0)))
        body = function.body[cut:]
        if function.compensated:
            yield analysis.run_to_sum(body, function, y * whole_power(piece, power))
        else:
            yield analysis.run(body, function.result)


def _last_products(function: Function) -> int:
    """Where the products with powers of the variable begin: after the last sum of terms."""
    sums = (Operation.MULTIPLY_ADD, Operation.TWO_SUM)
    places = [i for i, s in enumerate(function.body) if isinstance(s, Horner) or s.operation in sums]
    return places[-1] + 1 if places else 0


def _monomials(body: tuple[Statement, ...], function: Function) -> list[Statement]:
    """The statements that give powers of the variable times a constant, by the names that they have in the end."""
    free = {a.name for a in function.arguments} - {function.domain.argument}
    held, found = {function.domain.argument}, dict[str, Step]()
    for statement in body:
        names = {o for o in operands_of(statement) if isinstance(o, str)}
        found.pop(statement.name, None)
        if isinstance(statement, Step) and _is_monomial(statement, held, free):
            held |= {statement.name, statement.rest}
            found[statement.name] = statement
        else:
            held.discard(statement.name)
            (free.add if free.issuperset(names) else free.discard)(statement.name)
    return list(found.values())


def _is_monomial(step: Step, held: set[str], free: set[str]) -> bool:
    first, *others = step.operands
    names = {o for o in step.operands if isinstance(o, str)}
    if step.operation is Operation.DIVIDE:
        return first in held and free.issuperset({o for o in others if isinstance(o, str)})
    return step.operation in (Operation.MULTIPLY, Operation.TWO_PRODUCT) and bool(names & held) and names <= held | free


def _terms(function: Function) -> dict[int, Number]:
    """The coefficients of a polynomial in one variable by its powers."""
    terms: Terms = {} if function.polynomial is None else function.polynomial.terms
    return {p[0]: c for p, c in terms.items()}


def exact_value(powers: dict[int, Number], box: arb) -> arb:
    """A polynomial in one variable on a ball, by its exact coefficients and without its factor.

    Where it is not too long it is expanded about the middle, |p(m + r z) - p(m)| <= sum |p_i| r^i for |z| <= 1.

    >>> exact_value({0: Number(fmpq(1)), 2: Number(fmpq(3))}, arb(2)) == 13
    True
    """
    low, high = min(powers, default=0), max(powers, default=0)
    if high <= EXPANDED:
        dense = arb_poly([powers[p].ball if p in powers else 0 for p in range(high + 1)])
        middle, *others = dense(arb_poly([box.mid(), box.rad()])).coeffs() or [arb(0)]
        return middle + arb(0, sum(map(abs, others), arb(0)).upper())
    total = arb(0)
    stride = 2 if all((p - low) % 2 == 0 for p in powers) else 1
    for p in range(high, low - 1, -stride):
        total = total * whole_power(box, stride) + (powers[p].ball if p in powers else 0)
    return total * whole_power(box, low)
