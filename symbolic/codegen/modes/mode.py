"""Which evaluation a mode takes: the cheapest whose proved rounding bound comes to the mode's goal."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import chain, takewhile
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.lowering import operations
from ridgeback.symbolic.codegen.modes.accurate import compensated
from ridgeback.symbolic.codegen.modes.leading import leading
from ridgeback.symbolic.codegen.modes.splitting import split
from ridgeback.symbolic.codegen.program import Form, Function, Mode, Operation
from ridgeback.symbolic.codegen.proofs.bounds import Bound, bound, surely_above
from ridgeback.symbolic.codegen.proofs.notes import rounding_notes

GOALS: Final[Mapping[Mode, Fraction]] = {
    "strict": Fraction(9, 10),
    "fma": Fraction(3, 4),
    "accurate": Fraction(51, 100),
}
"""Units in the last place of the exact polynomial that the bound should come to."""


MOST: Final = 320
"""Operations that modes strict and fma may come to for the sake of the goal."""


def in_mode(form: Form, function: Function) -> Function:
    """The function as its mode evaluates it, with what is proved about its rounding.

    The cheapest evaluation that comes to the goal is taken; where none does without costing too much, in modes strict
    and fma the one with the smallest bound of those that carry no errors along, and in accurate what carries most.
    Without a bound to judge by it is Horner's rule, in parts where it is long.

    Raises InputError in mode accurate for a function that is not Horner's rule in one variable, times powers and k, and
    in all for one whose rounding must have a bound and has none.
    """
    try:
        made, found = _chosen(form, function)
    except InputError:
        if function.bounded or form.mode == "accurate":
            raise
        made, found = split(function), None
    return replace(made, notes=(*made.notes, *rounding_notes(form, made, found)))


def _chosen(form: Form, function: Function) -> tuple[Function, Bound | None]:
    goal, exact = GOALS[form.mode], form.mode == "accurate"
    plain = () if exact else (split(function), *leading(form, function))
    made = function
    for made in chain(plain, _carried(form, function)):
        if made not in plain[:1] and surely_above(form, made, goal):
            continue
        found = bound(form, made)
        if found is not None and found.ulps is not None and found.ulps <= goal:
            return made, found
        if (found is None or found.ulps is None) and not exact:
            return made, found
    judged = [(one, bound(form, one)) for one in plain or (made,)]
    return min(judged, key=lambda pair: _size(pair[1]))


def _size(found: Bound | None) -> tuple[float, float]:
    """By units in the last place, then by the error itself."""
    if found is None:
        return math.inf, math.inf
    return math.inf if found.ulps is None else float(found.ulps), float(found.absolute)


def _carried(form: Form, function: Function) -> Iterator[Function]:
    """What carries errors along, from cheap to costly."""
    within = MOST if form.mode != "accurate" else math.inf
    return takewhile(lambda made: cost(form, made) <= within, compensated(form, function))


def cost(form: Form, function: Function) -> int:
    """How many single operations a function comes to."""
    double = () if form.fused else (Operation.MULTIPLY_ADD,)
    return sum(2 if step.operation in double else 1 for step in operations(function, form))
