"""``derive --transient`` and ``--harmonics``: what an expansion says about the motion itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ridgeback.answers.at import cycle_rows
from ridgeback.answers.expansion_text import heading, joined, limit_rows, near, power, range_of_use
from ridgeback.console.output import json_text
from ridgeback.console.tables import aligned, csv_text
from ridgeback.options.demand import Demand

if TYPE_CHECKING:
    from ridgeback.answers.expansion_text import Result
    from ridgeback.symbolic.flow.reach import Reach
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.flow.transient import ClosedForm
    from ridgeback.symbolic.systems.oscillator import Oscillator

POINTS = 11
COLUMNS = ("time", "amplitude", "phase", "omega0", "u")


def transient_output(oscillator: Oscillator, result: Result, demand: Demand) -> str:
    """Amplitude, phase, frequency and displacement over time, with the closed form where there is one.

    Raises click.UsageError for an expansion that is no slow flow, InputError for parameters without a value and for
    an amplitude that runs away.
    """
    from ridgeback.common.errors import InputError
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if isinstance(result, LossFlow):
        raise InputError(result.refusal())
    if not isinstance(result, SlowFlow):
        raise click.UsageError(f"--transient belongs to multiple-scales, not to {result.method}; leave one out")
    from ridgeback.symbolic.flow.transient import closed_form

    flow = flow_to_follow(oscillator, result)
    rows, formula = transient_rows(oscillator, flow, demand), closed_form(flow)
    reach = transient_reach(oscillator, flow, rows)
    if demand.style == "csv":
        return csv_text(COLUMNS, rows)
    if demand.style == "json":
        exact = None if formula is None else {"amplitude": str(formula.amplitude), "phase": str(formula.phase)}
        more: dict[str, object] = {"closed_form": exact, "transient": rows, "beyond_reach": reach.beyond}
        more |= {**({"why": reach.why} if reach.beyond else {}), **fixed_rows(oscillator, result)}
        return json_text({**flow.to_dict(), **limit_rows(oscillator, result), **more})
    below = f"\n\n{aligned(COLUMNS, rows)}\n" + reach_line(reach) + range_of_use(oscillator, result)
    return heading(oscillator, flow.to_dict()) + "\n\n" + formula_lines(formula) + below


def flow_to_follow(oscillator: Oscillator, flow: SlowFlow) -> SlowFlow:
    """Of a self-excited oscillator the complete powers of its small parameter only: its amplitude does not stay small.

    Raises click.UsageError when no power of the small parameter has all its terms.
    """
    if oscillator.kind != "limit-cycle" or flow.complete is None:
        return flow
    if not flow.entire().growth_rate:
        raise click.UsageError(
            f"--order {flow.order} with weight {flow.weight} holds no power of {flow.small} with all its terms, and "
            f"{flow.system} has an amplitude that does not stay small; raise --order"
        )
    return flow.entire()


def transient_rows(oscillator: Oscillator, flow: SlowFlow, demand: Demand) -> list[dict[str, float]]:
    """One row per time; u is the reconstruction with all its harmonics."""
    from ridgeback.symbolic.flow.reconstruction import Reconstruction
    from ridgeback.symbolic.flow.transient import transient

    (amplitude, phase), last = demand.transient or (0.0, 0.0), (demand.points or POINTS) - 1
    time = [(demand.until or 0.0) * (i / last) for i in range(last + 1)]
    small = [float(value) for value in flow.values(oscillator.parameters)]
    found, motion = transient(flow, time, small, amplitude=amplitude, phase=phase), Reconstruction(flow)
    return [
        dict(zip(COLUMNS, (t, a, phi, flow.frequency_at(a, *small), motion(a, phi, *small)), strict=True))
        for t, a, phi in zip(found.time, found.amplitude, found.phase, strict=True)
    ]


def transient_reach(oscillator: Oscillator, flow: SlowFlow, rows: list[dict[str, float]]) -> Reach:
    """The reach of the order along a transient: of the amplitude, which rises or falls throughout, at both ends."""
    from ridgeback.symbolic.flow.limits import flow_limits
    from ridgeback.symbolic.flow.reach import reach_of

    limits = flow_limits(oscillator, flow).limits
    small = [float(value) for value in flow.values(oscillator.parameters)]
    ends = [reach_of(flow, row["amplitude"], small, limits=limits) for row in (rows[0], rows[-1])]
    return max(ends, key=lambda end: end.beyond)


def reach_line(reach: Reach) -> str:
    """What is said below a transient that leaves the reach of its order; nothing where it stays within."""
    return f"\nThe motion runs beyond the reach of this order: {reach.why}.\n" if reach.beyond else ""


def formula_lines(formula: ClosedForm | None) -> str:
    """The closed form in lines, or why there is none."""
    if formula is None:
        return "no closed form at this order, since a'/a has more than two powers of a^2: integrated by Taylor series"
    return f"a(t)   = {formula.amplitude}\nphi(t) = {formula.phase}"


def fixed_rows(oscillator: Oscillator, result: Any) -> dict[str, object]:
    """The limit cycles of a self-excited slow flow with their stability, in JSON; nothing for other results."""
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if not isinstance(result, SlowFlow) or oscillator.kind != "limit-cycle":
        return {}
    more: dict[str, object] = {} if result.complete is None else {"complete_powers": {result.small: result.complete}}
    values = {name: oscillator.parameters.get(name) for name in result.weights}
    if any(value is None for value in values.values()):
        return more
    from ridgeback.symbolic.flow.fixed_points import fixed_points
    from ridgeback.symbolic.flow.limits import flow_limits

    found = fixed_points(result, values, limits=flow_limits(oscillator, result).limits)
    rows = [point.to_dict() for point in found]
    return {**more, "fixed_points": rows, **cycle_rows(oscillator, result, found)}


def harmonic_output(oscillator: Oscillator, result: Result, style: str) -> str:
    """The displacement u as a sum of harmonics of the phase, exactly.

    Raises click.UsageError for forms that a series does not have, InputError for a method without a waveform.
    """
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if isinstance(result, SlowFlow):
        from ridgeback.symbolic.flow.reconstruction import Reconstruction

        motion = Reconstruction(result)
        if style in ("latex", "mathml"):
            return joined(motion.latex() if style == "latex" else motion.mathml())
        if style == "python":
            return joined(str(motion.expression()))
        rows: list[dict[str, Any]] = motion.to_dict()["harmonics"]  # type: ignore[assignment]
    elif style in ("text", "json"):
        rows = result.harmonic_rows()
    else:
        raise click.UsageError(f"--format {style} of --harmonics is for multiple-scales; use text or json")
    if style == "json":
        return json_text({**result.to_dict(), "harmonics": rows})
    phase = "phi" if isinstance(result, SlowFlow) else "omega0*t"
    return f"{heading(oscillator, result.to_dict())}\n\nu = sum of\n{harmonic_table(rows, phase)}\n"


def harmonic_table(harmonics: list[dict[str, Any]], phase: str) -> str:
    """One line per term of each harmonic.

    >>> term = {"powers": {"a": 3}, "coefficient": "1/32"}
    >>> print(harmonic_table([{"multiple": 3, "cosine": [term], "sine": []}], "phi"))
    wave        term   decimal  coefficient
    cos(3*phi)  a^3    0.03125  1/32
    """
    rows = [
        {"wave": wave(name, h["multiple"], phase), "term": power(term), "decimal": near(term)}
        | {"coefficient": term["coefficient"]}
        for h in harmonics
        for name, part in (("cos", "cosine"), ("sin", "sine"))
        for term in h[part]
    ]
    return aligned(["wave", "term", "decimal", "coefficient"], rows)


def wave(name: str, multiple: int, phase: str) -> str:
    """A harmonic by name; the mean is 1.

    >>> wave("cos", 1, "phi"), wave("sin", 3, "phi"), wave("cos", 0, "phi")
    ('cos(phi)', 'sin(3*phi)', '1')
    """
    return f"{name}({phase if multiple == 1 else f'{multiple}*{phase}'})" if multiple else "1"
