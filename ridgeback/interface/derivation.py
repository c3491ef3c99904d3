"""An oscillator's expansion by the method asked for, or by the one that suits it; each method is loaded when used."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen
from ridgeback.common.progress import Wanted

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.cost import Budget
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

METHODS = ("lindstedt", "multiple-scales", "energy-integral")


def derivation(
    system: Oscillator,
    order: int,
    *,
    method: str | None = None,
    amplitude: str | None = None,
    weight: int | None = None,
    weights: Mapping[str, int] | None = None,
    budget: Budget | None = None,
    progress: Wanted = None,
) -> Expansion | PowerExpansion | LossFlow | SlowFlow:
    """Derive by the method asked for, or by the one that suits the oscillator; see ``ridgeback.derive``.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> derivation(find("pendulum"), 2).method
    'lindstedt'
    """
    name = method_for(system, method)
    if name == "multiple-scales":
        if system.has_rough_losses:
            return rough_losses(system, order, amplitude=amplitude, weighted=weight is not None or weights is not None)
        return slow_flow(
            system, order, amplitude=amplitude, weight=weight, weights=weights, budget=budget, progress=progress
        )
    refuse_weights(weight, weights, name)
    amplitude = amplitude or "peak"
    if name == "lindstedt":
        from ridgeback.symbolic.expansion.lindstedt import lindstedt

        return lindstedt(system, order, amplitude=amplitude, budget=budget, progress=progress)
    if system.by_sides:
        from ridgeback.symbolic.expansion.each_side import energy_on_each_side

        return energy_on_each_side(system, order, amplitude=amplitude, budget=budget)
    from ridgeback.symbolic.expansion.energy_integral import energy_integral

    return energy_integral(system, order, amplitude=amplitude, budget=budget, progress=progress)


def method_for(oscillator: Oscillator, method: str | None) -> str:
    """The method asked for, or the one that suits the oscillator."""
    if method is not None:
        return chosen(method, METHODS, "method")
    if oscillator.kind == "damped":
        return "multiple-scales"
    if oscillator.kind == "limit-cycle":
        from ridgeback.symbolic.expansion.limit_cycle import has_series

        return "lindstedt" if has_series(oscillator) else "multiple-scales"
    return "energy-integral" if oscillator.by_sides and oscillator.is_conservative else "lindstedt"


def refuse_weights(weight: int | None, weights: Mapping[str, int] | None, owner: str) -> None:
    """Raise InputError for weights where there are none."""
    for name, value in {"weight": weight, "weights": weights}.items():
        if value is not None:
            raise InputError(f"{name} belongs to multiple-scales, not to {owner}; leave it out")


def rough_losses(system: Oscillator, order: int, *, amplitude: str | None, weighted: bool) -> LossFlow:
    """The slow flow of losses that are not analytic at rest."""
    from ridgeback.symbolic.flow.averaged_losses import averaged_losses

    if weighted:
        raise InputError("losses with abs or sign are averaged and have no weights; leave them out")
    return averaged_losses(system, order, amplitude=amplitude)


def slow_flow(
    system: Oscillator,
    order: int,
    *,
    amplitude: str | None,
    weight: int | None,
    weights: Mapping[str, int] | None,
    budget: Budget | None,
    progress: Wanted,
) -> SlowFlow:
    """Multiple scales, whose amplitude is that of the first harmonic."""
    from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    from ridgeback.symbolic.flow.ordering import check_both

    if amplitude not in (None, "fundamental"):
        raise InputError(
            f"multiple-scales has the fundamental amplitude, not {amplitude}; ask for fundamental, or another method"
        )
    check_both(system, weight, weights)
    return multiple_scales(
        system, order, weight=2 if weight is None else weight, weights=weights, budget=budget, progress=progress
    )
