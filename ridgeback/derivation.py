"""Which derivation the options ask for; the derivations themselves live in ``symbolic``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from symbolic.expansion import Expansion
    from symbolic.oscillator import Oscillator
    from symbolic.slow_flow import SlowFlow


def derived(
    oscillator: Oscillator,
    order: int,
    *,
    method: str | None,
    amplitude: str | None,
    weight: int | None,
    weights: dict[str, int] | None = None,
) -> Expansion | SlowFlow:
    """Derive by the method asked for, or by the one that suits the oscillator.

    Raises click.UsageError for options that the method does not have, InputError from the derivation.

    >>> from symbolic.systems import find
    >>> derived(find("pendulum"), 2, method=None, amplitude=None, weight=None).method
    'lindstedt'
    """
    name = method or ("multiple-scales" if oscillator.kind == "damped" else "lindstedt")
    if name != "multiple-scales" and (weight is not None or weights is not None):
        option = "--weight" if weight is not None else "--weights"
        raise click.UsageError(f"{option} belongs to multiple-scales, not to {name}; leave it out")
    if name == "multiple-scales":
        return slow_flow(oscillator, order, amplitude=amplitude, weight=weight, weights=weights)
    if name == "energy-integral":
        from symbolic.energy_integral import energy_integral

        return energy_integral(oscillator, order, amplitude=amplitude or "peak")
    from symbolic.lindstedt import lindstedt

    return lindstedt(oscillator, order, amplitude=amplitude or "peak")


def slow_flow(
    oscillator: Oscillator, order: int, *, amplitude: str | None, weight: int | None, weights: dict[str, int] | None
) -> SlowFlow:
    """Multiple scales, whose amplitude is that of the first harmonic."""
    if amplitude not in (None, "fundamental"):
        raise click.UsageError(
            f"multiple-scales has the fundamental amplitude, not {amplitude}; use --amplitude fundamental, "
            "or another method"
        )
    from symbolic.multiple_scales import multiple_scales

    return multiple_scales(oscillator, order, weight=2 if weight is None else weight, weights=weights)
