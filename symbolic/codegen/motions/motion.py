r"""u(t; A) from the harmonics of an expansion, each a series in the amplitude.

u = sum_m [ C_m(A) cos(m theta) + S_m(A) sin(m theta) ],      theta = omega0(A) t
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.motions.trigonometry import clenshaw, cosine_and_sine
from ridgeback.symbolic.codegen.program import (
    Argument,
    Domain,
    Function,
    Horner,
    Operand,
    Statement,
    Step,
    Steps,
    needed,
)
from ridgeback.symbolic.series.trigonometric import degree, harmonic

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ridgeback.symbolic.codegen.number import Real
    from ridgeback.symbolic.expansion.expansion import Expansion

TIME = Argument("t", "time; the phase is zero at t = 0")


class Series(Protocol):
    """What the functions of one expansion share."""

    arguments: tuple[Argument, ...]
    domain: Domain
    real: Real

    def function(self, name: str, summary: str, values: Sequence[Any], *, rate: int) -> Function:
        """A series of the expansion as a function."""


def motion_functions(series: Series, expansion: Expansion) -> list[Function]:
    """The coefficients of cos and sin of each multiple of the phase, and u(t).

    Raises InputError for a method that has no waveform.
    """
    if expansion.waveform is None:
        raise InputError(f"{expansion.method} gives the frequency only; use lindstedt for the motion u(t)")
    parts: dict[tuple[str, int], Function] = {}
    for multiple in range(max(map(degree, expansion.waveform)) + 1):
        pairs = [harmonic(p, multiple) for p in expansion.waveform]
        for index, kind in enumerate(("cosine", "sine")):
            values = [pair[index] for pair in pairs]
            if any(value != 0 for value in values):
                summary = f"Coefficient of the {kind} of {multiple} omega0 t in u." if multiple else "Mean of u."
                name = f"{kind}_{multiple}" if multiple else "mean"
                parts[kind, multiple] = series.function(name, summary, values, rate=0)
    rate = series.function("omega0", "", expansion.coefficients, rate=1)
    return [*parts.values(), _motion(series, rate, parts)]


def _motion(series: Series, rate: Function, parts: dict[tuple[str, int], Function]) -> Function:
    steps = Steps(series.real)
    omega = inlined(steps, rate, "w")
    theta = steps.multiply("theta", omega, TIME.name)
    cosine, sine = cosine_and_sine(steps, theta)
    twice = steps.add("twice", cosine, cosine)
    sums = {}
    for kind, letter in (("cosine", "c"), ("sine", "s")):
        values = {m: inlined(steps, f, f"{letter}{m}") for (k, m), f in parts.items() if k == kind}
        sums[kind] = (values.get(0), *clenshaw(steps, f"{letter}_sum", twice, values))
    mean, first, second = sums["cosine"]
    value = steps.subtract("u", steps.multiply("u", cosine, first), second)
    if mean is not None:
        value = steps.add("u", value, mean)
    if any(kind == "sine" for kind, _ in parts):
        value = steps.add("u", value, steps.multiply("sine", sine, sums["sine"][1]))
    arguments = (TIME, *series.arguments)
    body = needed(steps.taken, value)
    return Function("motion", "Displacement u at time t.", arguments, body, value, series.domain)


def inlined(steps: Steps, function: Function, prefix: str, bound: Mapping[str, str] | None = None) -> Operand:
    """Append the statements of a function under names with a prefix; arguments keep theirs, or those of ``bound``."""
    given = {a.name: a.name for a in function.arguments} | dict(bound or {})

    def named(operand: Operand) -> Operand:
        return given.get(operand, f"{prefix}_{operand}") if isinstance(operand, str) else operand

    def renamed(statement: Statement) -> Statement:
        if isinstance(statement, Horner):
            return Horner(f"{prefix}_{statement.name}", str(named(statement.at)), statement.coefficients)
        rest = f"{prefix}_{statement.rest}" if statement.rest else ""
        return Step(f"{prefix}_{statement.name}", statement.operation, tuple(map(named, statement.operands)), rest)

    steps.taken += map(renamed, function.body)
    return named(function.result)
