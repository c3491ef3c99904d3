"""Which values may be changed in place: those that nothing reads any more, so that no array is made for the result."""

from __future__ import annotations

from collections.abc import Iterator

from ridgeback.symbolic.codegen.lowering import lowered_step
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operation, Statement, Step, operands_of

CHANGING = (Operation.ADD, Operation.SUBTRACT, Operation.MULTIPLY, Operation.MULTIPLY_ADD)


def single_steps(function: Function, form: Form) -> tuple[Statement, ...]:
    """The statements with only loops left whole."""
    found: list[Statement] = []
    for statement in function.body:
        if isinstance(statement, Horner) and statement.loops:
            found.append(statement)
        else:
            steps = statement.steps() if isinstance(statement, Horner) else (statement,)
            found += (low for step in steps for low in lowered_step(step, form.real, fused=form.fused))
    return tuple(found)


def changed_in_place(function: Function, steps: tuple[Statement, ...]) -> Iterator[str | None]:
    """For each statement the operand that its result may take the place of, or None.

    That is a computed value, not read afterwards, read here once, and of the shape of the result: depending on every
    argument that the other operands depend on; under another name only where a product and a sum would make two arrays.

    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> form = form_of(lindstedt(find("pendulum"), 4))
    >>> steps = single_steps(form.functions[0], form)
    >>> [step.name for step in steps], list(changed_in_place(form.functions[0], steps))
    (['A_squared', 'y', 'y', 'result'], [None, None, 'y', None])
    """
    arguments = {a.name for a in function.arguments}
    shapes = {name: frozenset({name}) for name in arguments}
    for step, live in zip(steps, _live(function, steps), strict=True):
        read = [o for o in operands_of(step) if isinstance(o, str)]
        shape = frozenset[str]().union(*(shapes[name] for name in read))
        own = [name for name in read if name == step.name]
        double = isinstance(step, Step) and step.operation is Operation.MULTIPLY_ADD
        factors = [o for o in operands_of(step)[1::-1] if isinstance(o, str) and o not in live] if double else []
        dead = (name for name in (*own, *factors) if name not in arguments)
        fitting = (name for name in dead if shapes[name] == shape and read.count(name) == 1)
        yield next(fitting, None) if isinstance(step, Step) and step.operation in CHANGING else None
        shapes[step.name] = shape


def _live(function: Function, steps: tuple[Statement, ...]) -> list[set[str]]:
    """What is read after each statement."""
    live = {function.result} if isinstance(function.result, str) else set()
    found = []
    for step in reversed(steps):
        found.append(set(live))
        live.discard(step.name)
        live |= {o for o in operands_of(step) if isinstance(o, str)}
    return found[::-1]
