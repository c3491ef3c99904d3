r"""u(t; A) from the harmonics of an expansion, each a series in the amplitude.

u = sum_m [ C_m(A) cos(m theta) + S_m(A) sin(m theta) ],      theta = omega0(A) t

Of a slow flow the phase theta is an argument beside the amplitude: both change in time, as the transient has them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

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
    from collections.abc import Callable, Mapping, Sequence

    from ridgeback.symbolic.codegen.number import Real
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.series.trigonometric import Trig

TIME = Argument("t", "time; the phase is zero at t = 0")
PHASE = Argument("phi", "phase, in radians")


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
        rest = "so that no motion is written; leave it out" if expansion.sided else "use lindstedt for the motion u(t)"
        raise InputError(f"{expansion.method} gives the frequency only{', ' if expansion.sided else '; '}{rest}")

    def made(name: str, summary: str, values: Sequence[Any]) -> Function:
        return series.function(name, summary, values, rate=0)

    parts = _harmonics(expansion.waveform, made, "omega0 t")
    steps = Steps(series.real)
    rate = inlined(steps, series.function("omega0", "", expansion.coefficients, rate=1), "w")
    theta = steps.multiply("theta", rate, TIME.name)
    arguments = (TIME, *series.arguments)
    return [*parts.values(), _motion(steps, theta, parts, arguments, series.domain, "Displacement u at time t.")]


def flow_motion(
    waveform: Sequence[Trig],
    made: Callable[[str, str, Sequence[Any]], Function],
    arguments: tuple[Argument, ...],
    domain: Domain,
    real: Real,
) -> list[Function]:
    """The coefficients of cos and sin of each multiple of phi as functions of the amplitude, and u(phi, a)."""
    parts = _harmonics(waveform, made, PHASE.name)
    summary = "Displacement u at the phase phi and the amplitude a."
    return [*parts.values(), _motion(Steps(real), PHASE.name, parts, (PHASE, *arguments), domain, summary)]


Parts: TypeAlias = "dict[tuple[str, int], Function]"


def _harmonics(waveform: Sequence[Trig], made: Callable[[str, str, Sequence[Any]], Function], phase: str) -> Parts:
    """A function for each coefficient of u that does not vanish."""
    parts: Parts = {}
    for multiple in range(max(map(degree, waveform)) + 1):
        pairs = [harmonic(p, multiple) for p in waveform]
        for index, kind in enumerate(("cosine", "sine")):
            values = [pair[index] for pair in pairs]
            if any(value != 0 for value in values):
                summary = f"Coefficient of the {kind} of {multiple} {phase} in u." if multiple else "Mean of u."
                name = f"{kind}_{multiple}" if multiple else "mean"
                parts[kind, multiple] = made(name, summary, values)
    return parts


def _motion(
    steps: Steps, theta: str, parts: Parts, arguments: tuple[Argument, ...], domain: Domain, summary: str
) -> Function:
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
    return Function("motion", summary, arguments, needed(steps.taken, value), value, domain)


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
