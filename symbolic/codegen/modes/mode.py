"""Which evaluation a mode takes: the cheapest whose proved rounding bound comes to the mode's goal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.modes.accurate import compensated
from ridgeback.symbolic.codegen.modes.leading import leading
from ridgeback.symbolic.codegen.modes.splitting import split
from ridgeback.symbolic.codegen.program import Form, Function, Mode
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

    Modes strict and fma take Horner's rule, in parts where it is long, as it is when it comes to the goal, when nothing
    does, and when there is no bound to be judged by; accurate then takes what carries most.

    Raises InputError in mode accurate for a function that is not Horner's rule in one variable, times powers and k, and
    in all for one whose rounding must have a bound and has none.
    """
    try:
        made, found = _chosen(form, function)
    except InputError:
        if function.bounded or form.mode == "accurate":
            raise
        return split(function)
    return replace(made, notes=(*made.notes, *rounding_notes(form, made, found)))


def _chosen(form: Form, function: Function) -> tuple[Function, Bound | None]:
    goal, exact = GOALS[form.mode], form.mode == "accurate"
    plain = last = split(function)
    for last in _candidates(form, function, plain):
        if surely_above(form, last, goal):
            continue
        found = bound(form, last)
        none = found is None or found.ulps is None
        if (none and not exact) or (found is not None and found.ulps is not None and found.ulps <= goal):
            return last, found
    made = last if exact else plain
    return made, bound(form, made)


def _candidates(form: Form, function: Function, plain: Function) -> Iterator[Function]:
    """From cheap to costly."""
    if form.mode != "accurate":
        yield plain
        yield from leading(form, function)
    yield from compensated(form, function)
