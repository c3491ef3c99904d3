"""An expansion as code with all that is known of it: where the oscillation ends, and its certified error."""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

from ridgeback.common.errors import InputError
from ridgeback.compare.study.derivation import described
from ridgeback.symbolic.codegen import Formula, form_of
from ridgeback.symbolic.codegen.program import Form, Mode
from ridgeback.symbolic.codegen.proofs.facts import certified_facts, end_of, range_fact
from ridgeback.symbolic.enclosure.enclosure import rounded_down, separatrix
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.flow.loss_flow import LossFlow
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.systems.oscillator import Oscillator

Derived: TypeAlias = Expansion | PowerExpansion | SlowFlow | LossFlow
"""What a derivation gives."""


def known_form(
    oscillator: Oscillator,
    series: Derived | None,
    result: Formula,
    *,
    up_to: Fraction | None = None,
    name: str = "",
    mode: Mode = "strict",
    real: str = "float64",
    motion: bool = False,
) -> Form:
    """The coefficient form of a formula of an oscillator; ``series`` is what it was made of, if it was of one."""
    peak = series is None or series.amplitude == "peak"
    limit = end_of_oscillation(oscillator) if peak else None
    end, facts = up_to, tuple[str, ...]()
    if isinstance(series, Expansion | PowerExpansion) and not isinstance(result, SlowFlow | LossFlow):
        end = end or end_of(oscillator, series, result, limit)
        facts = () if end is None else certified_facts(oscillator, result, end, whole=up_to is not None)
        facts += () if end is None or up_to is not None else range_fact(result, end, limit)
    return form_of(
        result,
        equation=described(oscillator),
        limit=limit,
        up_to=end,
        more=facts,
        name=name,
        mode=mode,
        real=real,
        motion=motion,
    )


def end_of_oscillation(oscillator: Oscillator) -> float | None:
    """The peak amplitude of the separatrix, proved, as the largest number that is certainly not above it.

    None where there is no other equilibrium, and where it is not decided.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> end_of_oscillation(find("pendulum")), end_of_oscillation(find("tanh"))
    (3.141592653589793, None)
    """
    try:
        found = separatrix(oscillator)
    except InputError:
        return None
    return None if found.saddle is None or found.peak is None else rounded_down(found.peak)
