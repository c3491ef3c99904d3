"""What is proved about the rounding of a function, in a line."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import Final

from flint import arb
from sympy import Add

from ridgeback.symbolic.codegen.lowering import lowered
from ridgeback.symbolic.codegen.number import FLOAT64, Number, Real
from ridgeback.symbolic.codegen.program import Form, Function, Operand, Operation, Statement, Step
from ridgeback.symbolic.codegen.proofs.bounds import Bound
from ridgeback.symbolic.enclosure.enclosure import rounded_down


def rounding_notes(form: Form, function: Function, found: Bound | None) -> tuple[str, ...]:
    """The bound over the domain where one is known; for a polynomial without one, in terms of its terms."""
    if found is not None:
        return (bound_note(function, found),)
    if form.mode == "accurate":
        return ("Rounding: no bound is proved, as no range of the amplitude is known; --up-to gives one.",)
    if function.polynomial is None:
        return ()
    if any(value.has(Add) for _, value in function.polynomial.where):
        return ()  # a difference of parameters may cancel, and its error then has no share of the terms as a bound
    return (rounding_note(roundings(function.body, function.result), form.real),)


def bound_note(function: Function, found: Bound) -> str:
    """A bound over a domain in words."""
    inside = _inside(function, found)
    if found.absolute == 0:
        return f"Rounding: none{inside}, the result is exact."
    if found.relative is None or found.ulps is None:
        why = (
            f"none in units in the last place, as the value may be 0 near {function.domain.argument} = {found.zero:.4g}"
        )
        return f"Rounding:{inside} the error is at most {upwards(found.absolute)}, proved in ball arithmetic; {why}."
    return (
        f"Rounding:{inside} the relative error is at most {upwards(found.relative)} "
        f"({upwards(found.ulps, 3)} units in the last place), proved in ball arithmetic."
    )


def _inside(function: Function, found: Bound) -> str:
    """For which arguments a bound holds; nothing where it does for all."""
    domain, read = function.domain, function.read()
    name, end = domain.argument, domain.high
    others = [a for a in function.arguments if a.name != name and a.name in read and a.default is not None]
    places = [f"{a.name} = {f'{a.default!r}'.removesuffix('.0')}" for a in others]
    if name in read:
        size = f"|{name}|" if domain.low == -end else name
        least = upwards(found.least) if found.least else "" if domain.low == -end else "0"
        places = [f"{least} <= {size} <= {end!r}" if least else f"{size} <= {end!r}", *places]
    return f" for {' and '.join(places)}" if places else ""


# --- a bound without a domain ---


def gamma(count: int, real: Real = FLOAT64) -> Fraction:
    r"""gamma_m = m u/(1 - m u), exactly.

    Every operation rounds to the nearest number, fl(x op y) = (x op y)(1 + d) with |d| <= u unless it over- or
    underflows.  A product of m factors (1 + d)^(+-1) is 1 + theta with |theta| <= gamma_m (N. J. Higham, Accuracy and
    Stability of Numerical Algorithms, 2nd edition, SIAM, 2002, Lemma 3.1), so that a computed sum of products is
    within gamma_m times the sum of the absolute values of its terms.

    >>> gamma(1) == FLOAT64.unit / (1 - FLOAT64.unit)
    True
    """
    return count * real.unit / (1 - count * real.unit)


def roundings(body: Iterable[Statement], result: Operand) -> int:
    """m for the result of statements: an exact constant counts 0, a rounded one 1, an argument 0.

    A product counts the sum of its factors plus one, a sum the largest of its terms plus one, a division twice what is
    below it (Higham, Lemma 3.3).
    """
    known: dict[str, int] = {}

    def of(operand: Operand) -> int:
        if isinstance(operand, Number):
            return 0 if operand.representable else 1
        return known.get(operand, 0)

    for statement in body:
        if isinstance(statement, Step) and statement.operation is Operation.ROOT:
            known[statement.name] = of(statement.operands[0]) + ROOT_COUNT
            continue
        for step in lowered((statement,)):
            known[step.name] = _count(step.operation, [of(o) for o in step.operands])
    return of(result)


ROOT_COUNT: Final = 3
"""A root errs by at most 9/4 u, see ``bounds.any_root``."""


def _count(operation: Operation, m: list[int]) -> int:
    match operation:
        case Operation.MULTIPLY:
            return m[0] + m[1] + 1
        case Operation.MULTIPLY_ADD:
            return max(m[0] + m[1] + 1, m[2]) + 1
        case Operation.DIVIDE:
            return m[0] + 2 * m[1] + 1
        case Operation.ABSOLUTE:
            return m[0]
    return max(m) + 1


def rounding_note(count: int, real: Real = FLOAT64) -> str:
    """The bound in words.

    >>> rounding_note(0)
    'Rounding: none, the result is exact.'
    >>> rounding_note(3)
    'Rounding: the error is at most 3.4e-16 times the sum of the absolute values of the terms (3 roundings in a row, ...
    """
    if count == 0:
        return "Rounding: none, the result is exact."
    return (
        f"Rounding: the error is at most {upwards(gamma(count, real))} times the sum of the absolute values of the "
        f"terms ({count} roundings in a row, proved; without over- or underflow)."
    )


def upwards(value: Fraction, digits: int = 2) -> str:
    """A number that is not negative in a few digits, rounded up.

    >>> upwards(Fraction(1, 3))
    '0.34'
    """
    context = Context(prec=digits, rounding=ROUND_CEILING)
    return f"{float(context.divide(Decimal(value.numerator), Decimal(value.denominator))):.{digits}g}"


def rounded_down_text(x: arb) -> str:
    """A positive number in six digits, rounded down."""
    exact = Context(prec=6, rounding=ROUND_FLOOR).create_decimal(rounded_down(x))
    return f"{float(exact):.6g}"
