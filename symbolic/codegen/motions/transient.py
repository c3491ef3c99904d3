r"""The transient of a slow flow step by step: amplitude and phase after a time h, by the classical Runge-Kutta rule.

    a' = A(a),   phi' = W(a):      a_1 = a,  a_2 = a + h A_1/2,  a_3 = a + h A_2/2,  a_4 = a + h A_3,
    a(t + h) = a + h (A_1 + 2 A_2 + 2 A_3 + A_4)/6,      phi(t + h) = phi + h (W_1 + 2 W_2 + 2 W_3 + W_4)/6

(W. Kutta, 1901).  Its error is of the order h^4, and h is measured by the slow time: many periods may go by in one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import fmpq

from ridgeback.symbolic.codegen.motions.motion import inlined
from ridgeback.symbolic.codegen.program import Argument, Domain, Function, Operand, Operation, Steps, needed

if TYPE_CHECKING:
    from ridgeback.symbolic.codegen.number import Real

STEP = Argument("h", "the time that goes by")


def transient_functions(
    phase: Function, amplitude: Function, domain: Domain, real: Real, *, stops: bool = False
) -> tuple[Function, Function]:
    """a after a time h, and what the phase has grown by, from the two sides of the slow flow.

    ``stops``: whether the motion comes to rest in a finite time, as by dry friction; a is then 0 and not negative.
    """
    first, *others = amplitude.arguments
    arguments = (first, STEP, *others)
    after = "Amplitude after a time h, by one step of Runge and Kutta's rule of order 4."
    grown = "Growth of the phase over a time h, by the same step."
    return (
        _step("amplitude_after", after + " 0 from rest on." * stops, arguments, phase, amplitude, domain, real, stops),
        _step("phase_after", grown, arguments, phase, amplitude, domain, real),
    )


def _step(
    name: str,
    summary: str,
    arguments: tuple[Argument, ...],
    phase: Function,
    amplitude: Function,
    domain: Domain,
    real: Real,
    stops: bool = False,
) -> Function:
    steps, a, h = Steps(real), arguments[0].name, STEP.name
    half = steps.multiply("half_step", steps.number(fmpq(1, 2)), h)
    at: str = a
    rates: list[tuple[Operand, Operand]] = []
    for n, share in enumerate((half, half, h, None), start=1):
        rate = inlined(steps, amplitude, f"a{n}", {a: at})
        rates.append((rate, inlined(steps, phase, f"w{n}", {a: at})))
        if share is not None:
            at = steps.assign(f"at_{n}", Operation.MULTIPLY_ADD, share, rate, a)
    first, second, third, fourth = (pair[0 if name == "amplitude_after" else 1] for pair in rates)
    middle = steps.add("middle", second, third)
    total = steps.add("total", steps.add("ends", first, fourth), steps.add("middle", middle, middle))
    moved = steps.multiply("moved", steps.divide("sixth", h, steps.number(6)), total)
    result = steps.add("result", a, moved) if name == "amplitude_after" else moved
    if stops:
        size = steps.assign("size", Operation.ABSOLUTE, result)
        result = steps.multiply("result", steps.number(fmpq(1, 2)), steps.add("result", result, size))
    return Function(name, summary, arguments, needed(steps.taken, result), result, domain)
