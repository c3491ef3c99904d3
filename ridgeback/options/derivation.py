"""Which derivation the options ask for; the derivations themselves live in ``symbolic``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from ridgeback.options.arguments import ORDER
from ridgeback.options.budget import Watch, budget_option
from ridgeback.options.shared import expansion_options

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.cost import Budget
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

Command = Callable[..., None]


@dataclass(frozen=True)
class Request:
    """Which expansion is asked for, as it was said on the command line."""

    order: int
    method: str | None = None
    amplitude: str | None = None
    weight: int | None = None
    weights: dict[str, int] | None = None
    budget: Budget | None = None


def requesting(command: Command) -> Command:
    """Give a verb the options of a derivation, as one ``request``."""

    @wraps(command)
    def wrapped(**options: Any) -> None:
        own = {item.name: options.pop(item.name) for item in fields(Request)}
        command(request=Request(**own), **options)

    for option in (
        budget_option,
        expansion_options,
        click.option("--order", type=ORDER, default="8", show_default=True, metavar="N", help="Highest power kept."),
    ):
        wrapped = option(wrapped)
    return wrapped


def derived(oscillator: Oscillator, request: Request) -> Expansion | PowerExpansion | LossFlow | SlowFlow:
    """Derive what is asked for, saying how far it is.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> derived(find("pendulum"), Request(2)).method
    'lindstedt'
    """
    from ridgeback.interface.derivation import derivation

    with Watch(f"order {request.order}", None) as watch:
        return derivation(
            oscillator,
            request.order,
            method=request.method,
            amplitude=request.amplitude,
            weight=request.weight,
            weights=request.weights,
            budget=request.budget,
            progress=watch,
        )
