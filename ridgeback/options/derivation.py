"""Which derivation the options ask for; the derivations themselves live in ``symbolic``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from ridgeback.options.arguments import ORDER
from ridgeback.options.budget import budget_option
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

    def method_for(self, oscillator: Oscillator) -> str:
        """The method asked for, or the one that suits the oscillator."""
        if self.method is not None:
            return self.method
        if oscillator.kind == "damped":
            return "multiple-scales"
        return "energy-integral" if oscillator.by_sides and oscillator.is_conservative else "lindstedt"


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
    """Derive by the method asked for, or by the one that suits the oscillator.

    Raises click.UsageError for options that the method does not have, InputError from the derivation.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> derived(find("pendulum"), Request(2)).method
    'lindstedt'
    """
    name = request.method_for(oscillator)
    if name == "multiple-scales":
        return averaged(oscillator, request) if oscillator.has_rough_losses else slow_flow(oscillator, request)
    refuse_weights(request, name)
    if name == "energy-integral":
        if oscillator.by_sides:
            return on_each_side(oscillator, request)
        from ridgeback.symbolic.expansion.energy_integral import energy_integral

        return energy_integral(oscillator, request.order, amplitude=request.amplitude or "peak", budget=request.budget)
    from ridgeback.symbolic.expansion.lindstedt import lindstedt

    return lindstedt(oscillator, request.order, amplitude=request.amplitude or "peak", budget=request.budget)


def on_each_side(oscillator: Oscillator, request: Request) -> Expansion | PowerExpansion:
    """The energy integral of a force with a kink at rest, or without a linear part."""
    from ridgeback.symbolic.expansion.each_side import energy_on_each_side

    return energy_on_each_side(oscillator, request.order, amplitude=request.amplitude or "peak", budget=request.budget)


def refuse_weights(request: Request, name: str) -> None:
    """Raise click.UsageError for weights where there are none."""
    if request.weight is not None or request.weights is not None:
        option = "--weight" if request.weight is not None else "--weights"
        raise click.UsageError(f"{option} belongs to multiple-scales, not to {name}; leave it out")


def averaged(oscillator: Oscillator, request: Request) -> LossFlow:
    """The slow flow of losses that are not analytic at rest."""
    if request.weight is not None or request.weights is not None:
        raise click.UsageError(
            "losses with abs or sign are averaged to first order and have no weights; leave them out"
        )
    from ridgeback.symbolic.flow.averaged_losses import averaged_losses

    return averaged_losses(oscillator, request.order, amplitude=request.amplitude)


def slow_flow(oscillator: Oscillator, request: Request) -> SlowFlow:
    """Multiple scales, whose amplitude is that of the first harmonic."""
    if request.amplitude not in (None, "fundamental"):
        raise click.UsageError(
            f"multiple-scales has the fundamental amplitude, not {request.amplitude}; use --amplitude fundamental, "
            "or another method"
        )
    from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    from ridgeback.symbolic.flow.ordering import check_both

    check_both(oscillator, request.weight, request.weights)
    return multiple_scales(
        oscillator,
        request.order,
        weight=2 if request.weight is None else request.weight,
        weights=request.weights,
        budget=request.budget,
    )
