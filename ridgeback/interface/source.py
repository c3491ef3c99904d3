"""An expansion as code with all that is known of it: where the oscillation ends, and its certified error."""

from __future__ import annotations

from fractions import Fraction

from ridgeback.compare.study.derivation import described
from ridgeback.compare.study.derived import Undamped
from ridgeback.symbolic.codegen import Formula, form_of
from ridgeback.symbolic.codegen.program import Form, Mode
from ridgeback.symbolic.codegen.proofs.facts import certified_facts, end_of
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.systems.oscillator import Oscillator


def known_form(
    oscillator: Oscillator,
    series: Expansion | SlowFlow | None,
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
    limit = Undamped(oscillator).limit if peak and not free(oscillator) else None
    end, facts = up_to, tuple[str, ...]()
    if series is not None and not isinstance(series, SlowFlow) and not isinstance(result, SlowFlow):
        end = end or end_of(oscillator, series, result, limit)
        facts = () if end is None else certified_facts(oscillator, result, end)
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


def free(oscillator: Oscillator) -> bool:
    """Whether a parameter has no value, so that no limit can be computed."""
    return any(value is None for value in oscillator.parameters.values())
