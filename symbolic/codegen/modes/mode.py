"""Which evaluation a mode takes: the cheapest whose proved rounding bound comes to the mode's goal."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import chain
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


def in_mode(form: Form, function: Function) -> Function:
    """The function as its mode evaluates it, with what is proved about its rounding.

    The cheapest evaluation that comes to the goal is taken; where none does, that with the smallest bound.  Without a
    bound in units in the last place to judge by, in modes strict and fma it is Horner's rule, in parts where it is
    long, and in accurate what carries most errors along.

    Raises InputError in mode accurate for a function that is not Horner's rule in one variable, times powers and k, and
    in all for one whose rounding must have a bound and has none.
    """
    try:
        made, found = _chosen(form, function)
    except InputError:
        if function.bounded or form.mode == "accurate":
            raise
        made, found = split(function), None
    notes = (*made.notes, *rounding_notes(form, made, found))
    if made.carries:
        notes += (f"Evaluation: {cost(form, made)} operations, rounding errors carried along.",)
    return replace(made, notes=notes)


def _chosen(form: Form, function: Function) -> tuple[Function, Bound | None]:
    goal, exact = GOALS[form.mode], form.mode == "accurate"
    plain = (split(function), *leading(form, function))
    made = function
    for made in chain(plain, compensated(form, function)):
        if made not in plain[:1] and surely_above(form, made, goal):
            continue
        found = bound(form, made)
        if found is not None and found.ulps is not None and found.ulps <= goal:
            return made, found
        if (found is None or found.ulps is None) and not exact:
            return made, found
    judged = [(one, bound(form, one)) for one in ((made,) if exact else (*plain, made))]
    return min(judged, key=lambda pair: _size(pair[1]))


def _size(found: Bound | None) -> tuple[float, float]:
    """By units in the last place, then by the error itself."""
    if found is None:
        return math.inf, math.inf
    return math.inf if found.ulps is None else float(found.ulps), float(found.absolute)


def cost(form: Form, function: Function) -> int:
    """How many single operations a function comes to."""
    double = () if form.fused else (Operation.MULTIPLY_ADD,)
    return sum(2 if step.operation in double else 1 for step in operations(function, form))
