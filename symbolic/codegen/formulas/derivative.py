r"""The derivative of a function operation by operation, along with its value: forward differentiation.

    (a b)' = a' b + a b',   (a/b)' = (a' - (a/b) b')/b,   (sqrt a)' = a'/(2 sqrt a),   (c_0 + x y)' = x' y + x y'

(A. Griewank and A. Walther, Evaluating Derivatives, SIAM, 2nd edition, 2008, chapter 3).  The size |a| has the slope
a' times its sign a/|a|, with a number far below all amplitudes added to |a|: at 0, where the even functions that it
stands in have the slope 0, it is 0.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.lowering import lowered
from ridgeback.symbolic.codegen.number import Real
from ridgeback.symbolic.codegen.program import Function, Operand, Operation, Step, Steps, needed

TAIL: Final = "_rise"
"""Ends the name of a derivative."""


def differentiated(function: Function, name: str, summary: str, real: Real) -> Function:
    """The derivative by the argument of the domain.

    >>> from ridgeback.symbolic.codegen.evaluation import value_at
    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.codegen.formulas.closed_forms import mean_form
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> form = form_of(mean_form(find("pendulum")), limit=3.0)
    >>> slope = next(f for f in form.functions if f.name == "omega0_slope")
    >>> round(value_at(form, slope, (1.0, 1.0)), 12)
    -0.123901976513
    """
    slopes = _Slopes(function, real)
    for step in lowered(function.body, real):
        slopes.add(step)
    result = slopes.of(function.result)
    value: Operand = slopes.steps.number(0) if result is None else result
    body = needed(slopes.steps.taken, value)
    made = replace(function, name=name, summary=summary, body=body, result=value)
    return replace(made, notes=(), polynomial=None, bounded=False)


class _Slopes:
    """The steps of a function with those of its derivative; None stands for a slope that is 0."""

    def __init__(self, function: Function, real: Real) -> None:
        self.steps = Steps(real)
        self.variable = function.domain.argument
        self.known: dict[str, Operand | None] = {a.name: None for a in function.arguments}
        self.known[self.variable] = self.steps.number(1)

    def of(self, operand: Operand) -> Operand | None:
        """The slope of a value."""
        return self.known[operand] if isinstance(operand, str) else None

    def add(self, step: Step) -> None:
        """A step and the slope of what it computes; the slope first where the name is given a new value."""
        a, *others = step.operands
        slopes = [self.of(o) for o in step.operands]
        if all(slope is None for slope in slopes):
            self.known[step.name] = None
            self.steps.taken.append(step)
            return
        before = step.operation in (Operation.ADD, Operation.SUBTRACT, Operation.MULTIPLY, Operation.MULTIPLY_ADD)
        if not before:
            self.steps.taken.append(step)
        slope = self._slope(step, a, others, slopes)
        if before:
            self.steps.taken.append(step)
        self.known[step.name] = slope

    def _slope(self, step: Step, a: Operand, others: list[Operand], slopes: list[Operand | None]) -> Operand | None:
        name, steps = f"{step.name}{TAIL}", self.steps
        match step.operation:
            case Operation.ADD:
                return self._sum(name, slopes[0], slopes[1])
            case Operation.SUBTRACT:
                if slopes[1] is None:
                    return self._kept(name, slopes[0])
                return steps.subtract(name, steps.number(0) if slopes[0] is None else slopes[0], slopes[1])
            case Operation.MULTIPLY:
                return self._product(name, a, others[0], slopes[0], slopes[1])
            case Operation.MULTIPLY_ADD:
                return self._sum(name, self._product(name, a, others[0], slopes[0], slopes[1]), slopes[2])
            case Operation.DIVIDE:
                return self._quotient(step, name, others[0], slopes)
            case Operation.SQUARE_ROOT:
                return steps.divide(name, slopes[0] or steps.number(0), steps.add(f"{name}_b", step.name, step.name))
            case Operation.ABSOLUTE:
                below = steps.add(f"{name}_b", step.name, steps.number(fmpq(2) ** (real_exponent(steps.real))))
                sign = steps.divide(f"{name}_b", a, below)
                return steps.multiply(name, sign, slopes[0] or steps.number(0))
            case Operation.FLOOR:
                return None
        raise InputError(f"the derivative of {step.operation.value} is not written; leave it out")

    def _kept(self, name: str, slope: Operand | None) -> Operand | None:
        """A slope under the name of the new value, since the old name may be given another."""
        return slope if slope is None else self.steps.multiply(name, slope, self.steps.number(1))

    def _sum(self, name: str, a: Operand | None, b: Operand | None) -> Operand | None:
        if a is None or b is None:
            return self._kept(name, b if a is None else a)
        return self.steps.add(name, a, b)

    def _product(
        self, name: str, a: Operand, b: Operand, slope_a: Operand | None, slope_b: Operand | None
    ) -> Operand | None:
        if slope_a is None and slope_b is None:
            return None
        if slope_a is None or slope_b is None:
            other, slope = (a, slope_b) if slope_a is None else (b, slope_a)
            return self.steps.multiply(name, other, slope or self.steps.number(0))
        first = self.steps.multiply(f"{name}_a", slope_a, b)
        return self.steps.add(name, first, self.steps.multiply(f"{name}_b", a, slope_b))

    def _quotient(self, step: Step, name: str, b: Operand, slopes: list[Operand | None]) -> Operand:
        """(a' - q b')/b with q = a/b."""
        steps, above = self.steps, slopes[0]
        if slopes[1] is not None:
            moved = steps.multiply(f"{name}_b", step.name, slopes[1])
            above = steps.subtract(f"{name}_b", above or steps.number(0), moved)
        return steps.divide(name, above or steps.number(0), b)


def real_exponent(real: Real) -> int:
    """The exponent of a number far below all amplitudes, and far above the smallest number."""
    return real.low + 3 * real.digits
