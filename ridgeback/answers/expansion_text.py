"""Expansions as text for reading: headings, coefficients, limits, certificates."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from ridgeback.answers.at import cycle_lines
from ridgeback.console.tables import aligned

if TYPE_CHECKING:
    from ridgeback.symbolic.certificates.certificate import Check
    from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.fixed_points import FixedPoint
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

    Result = Expansion | PowerExpansion | LossFlow | SlowFlow

TITLES = {"frequency": "omega0", "growth_rate": "a'/a", "amplitude_series": "amplitude"}
_STABILITY = {True: "stable", False: "unstable", None: "of undecided stability"}


def as_text(oscillator: Oscillator, public: dict[str, Any]) -> str:
    """The equation, what the amplitude is, and every coefficient, exactly and as a decimal."""
    rows = balls if public.get("arithmetic") == "balls" else coefficients
    tables = [f"{title} = sum of\n{rows(public[key])}" for key, title in TITLES.items() if public.get(key)]
    return "\n\n".join([heading(oscillator, public), *tables]) + "\n"


def heading(oscillator: Oscillator, public: dict[str, Any]) -> str:
    """The equation with its numbers; method, order, variables, and the amplitude's definition."""
    values = ", ".join(f"{n} = {v}" if v is not None else f"{n} symbolic" for n, v in oscillator.parameters.items())
    digits = f", in balls of {public['digits']} digits" if "digits" in public else ""
    return (
        f"{oscillator.title}: {oscillator.equation}"
        + (f"   ({values})" if values else "")
        + f"\n{public['method']}, order {public['order']}{digits}, variables {', '.join(public['variables'])}"
        + (f", amplitude: {public['amplitude']}" if public.get("amplitude") else "")
    )


def coefficients(terms: list[dict[str, Any]]) -> str:
    """One line per term: its powers, the exact coefficient and six digits of it."""
    rows = [{"term": power(term), "decimal": near(term), "coefficient": term["coefficient"]} for term in terms]
    return aligned(["term", "decimal", "coefficient"], rows)


def balls(terms: list[dict[str, Any]]) -> str:
    """One line per term: the true coefficient is within the radius of the decimal.

    >>> row = {"powers": {"A": 2}, "coefficient": "-0.0625000", "radius": "0", "certain_digits": None}
    >>> print(balls([row]))
    term  coefficient  radius  certain digits
    A^2   -0.0625000   0       exact
    """
    rows = [
        {
            "term": power(term),
            **{key: term[key] for key in ("coefficient", "radius")},
            "certain digits": "exact" if term["certain_digits"] is None else str(term["certain_digits"]),
        }
        for term in terms
    ]
    return aligned(["term", "coefficient", "radius", "certain digits"], rows)


def power(term: dict[str, Any]) -> str:
    """The powers of a term.

    >>> power({"powers": {"a": 2, "mu": 1}}), power({"powers": {"a": 0}}), power({"powers": {"A": "-1/2"}})
    ('a^2*mu', '1', 'A^(-1/2)')
    """
    written = {v: f"({p})" if isinstance(p, str) or p < 0 else str(p) for v, p in term["powers"].items() if p}
    return "*".join(v if p == "1" else f"{v}^{p}" for v, p in written.items()) or "1"


def decimal(exact: str) -> float | None:
    """A rational as a float; None for what is no rational (an irrational natural frequency, a parameter).

    >>> decimal("-1/16"), decimal("sqrt(2)")
    (-0.0625, None)
    """
    try:
        return float(Fraction(exact))
    except (ValueError, OverflowError):
        return None


def near(term: dict[str, Any]) -> float | None:
    """The coefficient of a term as a float, where it is a number."""
    found: float | None = term.get("decimal", decimal(term["coefficient"]))
    return found


def range_of_use(oscillator: Oscillator, result: Result | BallExpansion) -> str:
    """Where a series converges and how far it may be used, in one line; what is known of both for a slow flow."""
    from ridgeback.symbolic.flow.limits import flow_limits
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.singularities.settled import settled_limits

    if isinstance(result, LossFlow):
        return f"\n{result.sentence()}\n"
    if isinstance(result, SlowFlow):
        return f"\n{flow_limits(oscillator, result).sentence()}\n" + limit_cycles(oscillator, result)
    return f"\n{settled_limits(oscillator, result).sentence()}\n" + no_cycle(oscillator)


def limit_rows(oscillator: Oscillator, result: Result | BallExpansion) -> dict[str, object]:
    """The same in JSON, and why there is no limit cycle where there is none."""
    from ridgeback.symbolic.flow.limits import flow_limits
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.singularities.settled import settled_limits

    if isinstance(result, LossFlow):
        return {"limits": {"radius": None, "sentence": result.sentence()}}
    found = flow_limits(oscillator, result) if isinstance(result, SlowFlow) else settled_limits(oscillator, result)
    none = without_cycle(oscillator)
    return {"limits": found.to_dict(), **({"no_limit_cycle": none} if none else {})}


def no_cycle(oscillator: Oscillator) -> str:
    """The line that says that there is no limit cycle, where the small parameter is 0; nothing elsewhere."""
    return f"\n{without_cycle(oscillator)}\n" if without_cycle(oscillator) else ""


def without_cycle(oscillator: Oscillator) -> str:
    """Why a self-excited oscillator has no limit cycle at its own parameters; empty when that is not so."""
    if oscillator.small is None or oscillator.parameters.get(oscillator.small) != 0 or not oscillator.is_conservative:
        return ""
    name = oscillator.small
    return (
        f"At {name} = 0 there is no limit cycle: the oscillator is conservative there and keeps every amplitude. "
        f"A series in {name} describes the limit cycle for {name} other than 0."
    )


def limit_cycles(oscillator: Oscillator, flow: SlowFlow) -> str:
    """The fixed points of a self-excited slow flow at the oscillator's own parameters.

    Those that belong to a series, or else lie within the reach of the order; of the others that they do not.
    """
    if oscillator.kind != "limit-cycle" or any(oscillator.parameters.get(name) is None for name in flow.weights):
        return ""
    if without_cycle(oscillator):
        return no_cycle(oscillator)
    from ridgeback.symbolic.flow.fixed_points import fixed_points
    from ridgeback.symbolic.flow.limits import flow_limits

    values = {name: oscillator.parameters[name] for name in flow.weights}
    points = fixed_points(flow, values, limits=flow_limits(oscillator, flow).limits)
    series = [point for point in points if point.square_series is not None]
    at = ", ".join(f"{name} = {value}" for name, value in values.items())
    shown = series or points
    lines = "".join(cycle_line(point, at) for point in shown)
    return complete_powers(flow) + lines + cycle_lines(oscillator, flow, shown)


def cycle_line(point: FixedPoint, at: str) -> str:
    """One fixed point in words; beyond the reach of the order only its place is printed."""
    amplitude = float(point.amplitude.mid())
    if point.reach.beyond:
        return f"\na'/a of this order vanishes at {at}, a = {amplitude:.4g}: beyond its reach, {point.reach.why}\n"
    return (
        f"\nlimit cycle of this order at {at}: a = {amplitude:.10g}, "
        f"omega0 = {float(point.frequency.mid()):.10g}, {_STABILITY[point.stable]}\n"
    )


def complete_powers(flow: SlowFlow) -> str:
    """Which powers of the small parameter enter a limit cycle; nothing where none ever has all its terms."""
    if flow.complete is None:
        return ""
    if not flow.entire().growth_rate:
        return f"\nNo limit cycle is known: no power of {flow.small} has all its terms at order {flow.order}\n"
    last = power({"powers": {flow.small: flow.complete}})
    return (
        f"\nA limit cycle, and the way to it, is of the powers through {last} only: those have all their terms at this "
        "order, and a is not small there.\n"
    )


def certified(checks: tuple[Check, ...] | None) -> str:
    """The certificate, a line a check."""
    if checks is None:
        return ""
    words = {True: "holds", False: "FAILS", None: "-"}
    rows = [{"check": c.name, "": words[c.passed], "statement": c.statement} for c in checks]
    return "\ncertificate\n" + aligned(["check", "", "statement"], rows) + "\n"


def joined(parts: str | tuple[str, ...]) -> str:
    """One relation per line; a slow flow has two."""
    return "".join(f"{part}\n" for part in ((parts,) if isinstance(parts, str) else parts))


def expressions(result: Result) -> tuple[Any, ...]:
    """The right-hand sides as SymPy expressions; printed, they are Python, exact for SymPy symbols and Fractions."""
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.slow_flow import SlowFlow

    if isinstance(result, SlowFlow | LossFlow):
        return result.frequency_expression(), result.growth_rate_expression()
    return (result.expression(),)
