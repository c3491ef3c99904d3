"""Very high orders from the command line: certified balls with a checkpoint."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ridgeback.common.files import remove_through
from ridgeback.console.failure import say
from ridgeback.interface.derivation import refuse_weights
from ridgeback.options.budget import Watch
from ridgeback.options.derivation import Request

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
    from ridgeback.symbolic.systems.oscillator import Oscillator


def in_balls(oscillator: Oscillator, request: Request, digits: int, checkpoint: str | None) -> BallExpansion:
    """Derive in balls, saying how far it is; an interrupt says how to go on.

    Raises click.UsageError for options that balls do not have, InputError from the derivation, OSError for the file.
    """
    if request.method not in (None, "lindstedt"):
        raise click.UsageError(f"--digits belongs to lindstedt, not to {request.method}; leave one of the two out")
    refuse_weights(request.weight, request.weights, "--digits")
    from ridgeback.symbolic.expansion.cost import Budget, balls_of, predict
    from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls

    cost, path = predict(balls_of(oscillator), request.order), None if checkpoint is None else Path(checkpoint)
    allowed = cost.within(request.budget or Budget())  # else the refusal says it
    with Watch(f"order {request.order} in balls of {digits} digits", cost if allowed else None) as watch:
        try:
            return lindstedt_in_balls(
                oscillator,
                request.order,
                digits=digits,
                amplitude=request.amplitude or "peak",
                checkpoint=path,
                progress=watch,
                budget=request.budget,
            )
        except KeyboardInterrupt:
            raise KeyboardInterrupt(interrupted(f"before {watch.last or 'the first order'}", path)) from None


@contextmanager
def kept_until_written(checkpoint: str | None) -> Iterator[None]:
    """Remove the checkpoint when the block has written the result; else say, when there is one, that it is there."""
    try:
        yield
    except OSError:
        if checkpoint is not None and Path(checkpoint).exists():
            say(f"the state is in {checkpoint}: the same command goes on from there when the output can be written")
        raise
    except KeyboardInterrupt as stop:
        if not str(stop) and checkpoint is not None:
            raise KeyboardInterrupt(interrupted("before the result was written", Path(checkpoint))) from None
        raise
    if checkpoint is not None:
        remove_through(Path(checkpoint))


def interrupted(when: str, path: Path | None) -> str:
    """What to do after an interrupt.

    >>> interrupted("before order 7 of 20", None)
    'interrupted before order 7 of 20; nothing was kept: with --checkpoint FILE the next run could go on from here'
    """
    if path is None or not path.exists():
        return f"interrupted {when}; nothing was kept: with --checkpoint FILE the next run could go on from here"
    return f"interrupted {when}; the state is in {path}: run the same command again to go on from there"
