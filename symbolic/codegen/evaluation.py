"""Generated code run in Python's own floats, operation by operation: what every language must give, bit for bit."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import partial
from typing import Final

from ridgeback.symbolic.codegen.lowering import lowered
from ridgeback.symbolic.codegen.number import FLOAT32, FLOAT64, Number, Real, rounded
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operation, Step


def divided(a: float, b: float) -> float:
    """a/b as IEEE 754 has it.

    >>> divided(1.0, -0.0)
    -inf
    """
    if b != 0:
        return a / b
    return math.nan if a == 0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)


PLAIN: Final[Mapping[Operation, Callable[..., float]]] = {
    Operation.ADD: lambda a, b: a + b,
    Operation.SUBTRACT: lambda a, b: a - b,
    Operation.MULTIPLY: lambda a, b: a * b,
    Operation.DIVIDE: divided,
    Operation.SQUARE_ROOT: lambda a: math.sqrt(a) if a >= 0 else math.nan,
    Operation.ABSOLUTE: abs,
    Operation.FLOOR: lambda a: float(math.floor(a)) if math.isfinite(a) else a,
}


def fused(a: float, b: float, c: float, real: Real = FLOAT64) -> float:
    """a*b + c in one rounding, by exact fractions.

    >>> fused(1 + 2.0**-30, 1 + 2.0**-30, -1.0 - 2.0**-29) == 2.0**-60
    True
    """
    if not all(map(math.isfinite, (a, b, c))):
        return a * b + c
    exact = Fraction(a) * Fraction(b) + Fraction(c)
    return rounded(exact, real) if exact else a * b + c


def single(value: float) -> float:
    """The nearest float32: double rounding is harmless, 53 digits being more than 2*24 + 1.

    >>> single(0.1)
    0.10000000149011612
    """
    try:
        return float(struct.unpack("f", struct.pack("f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


def value_at(form: Form, function: Function, arguments: tuple[float, ...]) -> float:
    """The value of a function as every language computes it; not a number outside the domain."""
    given = dict(zip((a.name for a in function.arguments), arguments, strict=True))
    domain, result = function.domain, function.result
    if not domain.low <= given[domain.argument] <= domain.high:
        return math.nan
    known = values_at(form, function, arguments)
    return result.nearest if isinstance(result, Number) else known[result]


def values_at(form: Form, function: Function, arguments: tuple[float, ...]) -> dict[str, float]:
    """Arguments and computed values by their names, wherever the arguments lie.

    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> form = form_of(lindstedt(find("pendulum"), 2))
    >>> values_at(form, form.functions[0], (2.0, 1.0))
    {'A': 2.0, 'k': 1.0, 'A_squared': 4.0, 'y': 0.75, 'result': 0.75}
    """
    cut = single if form.real is FLOAT32 else float
    known = {a.name: cut(value) for a, value in zip(function.arguments, arguments, strict=True)}
    for statement in function.body:
        if isinstance(statement, Horner) and form.real is FLOAT64 and not form.fused:
            known[statement.name] = _horner(statement, known[statement.at])
            continue
        for step in lowered((statement,), form.real, fused=form.fused):
            given = [o.nearest if isinstance(o, Number) else known[o] for o in step.operands]
            known[step.name] = _step(form, step, given, cut)
    return known


def _horner(statement: Horner, x: float) -> float:
    """Horner's rule in doubles; a coefficient that is 0 changes nothing but the sign of a zero."""
    value, *rest = statement.falling
    for coefficient in rest:
        value = value * x + coefficient
    return value


def _step(form: Form, step: Step, x: list[float], cut: Callable[[float], float]) -> float:
    if step.operation is Operation.MULTIPLY_ADD:
        if form.fused:
            return fused(x[0], x[1], x[2], form.real)
        return cut(cut(x[0] * x[1]) + x[2])
    return cut(PLAIN[step.operation](*x))


POINTS: Final = 32
"""In a self-test, beside those outside the domain."""
SPAN: Final = 3.0
"""Where a domain has no known end, points lie up to there."""
SHARES: Final = (0.37, 0.11, 1.25, 0.73, 0.05, 0.91)
"""Values of parameters in a self-test."""


def test_points(form: Form, function: Function) -> tuple[tuple[tuple[float, ...], float], ...]:
    """Arguments spread over the domain and beyond it, each with the value there.

    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> form = form_of(lindstedt(find("pendulum"), 2), limit=3.0)
    >>> points = test_points(form, form.functions[0])
    >>> len(points), points[0], points[-1]
    (34, ((0.0, 1.0), 1.0), ((inf, 1.0), nan))
    """
    cut = single if form.real is FLOAT32 else float
    domain = function.domain
    low, high = (domain.low, domain.high) if domain.known else (max(domain.low, -SPAN), SPAN)
    inside = [0.0, *(cut(low + (high - low) * i / (POINTS - 2)) for i in range(POINTS - 1))]
    outside = [cut(high * 1.5) if domain.known else math.nan, math.inf]
    return tuple(map(partial(_point, form, function), [*inside, *outside]))


def _point(form: Form, function: Function, x: float) -> tuple[tuple[float, ...], float]:
    cut = single if form.real is FLOAT32 else float
    arguments = tuple(
        x if a.name == function.domain.argument else cut(SHARES[i % len(SHARES)] if a.default is None else a.default)
        for i, a in enumerate(function.arguments)
    )
    return arguments, value_at(form, function, arguments)
