"""``derive --resummed``: another formula from the coefficients of a series."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import click

from ridgeback.answers.expansion_text import heading, joined
from ridgeback.options.demand import Demand

if TYPE_CHECKING:
    from ridgeback.answers.expansion_text import Result
    from ridgeback.symbolic.resummation.resummation import Resummation
    from ridgeback.symbolic.systems.oscillator import Oscillator


def resummed_from(oscillator: Oscillator, result: Result, demand: Demand) -> Resummation:
    """Resum what was derived; with ``--at`` poles are refused up to the largest amplitude.

    Raises click.UsageError for a slow flow, InputError from the resummation.
    """
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.resummation.by_name import resum

    if isinstance(result, SlowFlow | LossFlow):
        raise click.UsageError("--resummed belongs to a series in one variable, not to a slow flow; leave it out")
    return resum(
        oscillator,
        result,
        demand.resummed or "",
        degrees=demand.degrees,
        growth=demand.growth or Fraction(0),
        up_to=max(demand.at) if demand.at else None,
    )


def formula_text(oscillator: Oscillator, formula: Resummation, style: str) -> str:
    """The formula for reading or in a language of formulas."""
    if style == "latex":
        return joined(formula.latex())
    if style == "mathml":
        return joined(formula.mathml())
    if style == "python":
        return joined(str(formula.expression()))
    public = formula.to_dict()
    pole = f"first pole at {formula.variable} = {public['pole']:.10g}\n" if public.get("pole") else ""
    return f"{heading(oscillator, public)}\n\nomega0 = {public['expression']}\n{pole}"
