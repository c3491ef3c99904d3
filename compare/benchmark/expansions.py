"""The contenders that come from theory: what each gives along the motion, and what a value costs.

Expansions are run as the code that Ridgeback generates for them, in Python over a NumPy array and in C; their
amplitude is the peak A(t), of the instantaneous energy (21) and of the averaged action, which needs no trajectory.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.contenders import Kind, Row, Source
from ridgeback.compare.binding.compiled_code import NotCompiled, compiled
from ridgeback.compare.binding.generated_code import python_module
from ridgeback.compare.motion.model_curves import slow_flow_curve
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.study.derived import backbone_series, without_damping
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.energy import is_linearly_damped
from ridgeback.numeric.orbits.paper_model import series_frequency
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.resummation.by_name import resum

ORDERS = (2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 24, 28, 32, 36, 40)
FLOW_ORDERS = (2, 4, 6, 8)
TERMS = (3, 5, 11, 21, 41)
"""Terms of (14): the three that the paper prints, and as many coefficients as some orders have."""
RESUMMATIONS = ("pade", "map", "nome")
REPEATS = 7
TIMED = 2**15
"""Values in a timed call: enough that the call itself costs nothing."""


@dataclass(frozen=True)
class Contender:
    """One way to omega0(t): its row without errors, and its values on the motion's samples; None when refused."""

    row: Row
    omega: Array | None
    """NaN where the contender says nothing."""


def amplitudes(motion: Motion) -> Mapping[Source, Array]:
    """A(t) by each source that this motion has, on its samples.

    ``energy`` is eq. (20)-(21), ``action`` the averaged motion's peak, ``fit`` the envelope of the turning points.
    """
    found: dict[Source, Array] = {}
    if motion.has_backbone:
        found["energy"] = motion.energy_peak
    if motion.averaged is not None:
        found["action"] = motion.averaged.peak
    if not found:
        found["fit"] = motion.energy_peak
    return found


def theory(
    motion: Motion, orders: Iterable[int], step: Callable[[str], None], *, known: Expansion | None = None
) -> Iterator[Contender]:
    """Every contender from theory that this motion has; ``known`` is the series, where it is derived already."""
    sources = amplitudes(motion)
    oscillator = motion.setting.oscillator
    step("expansions, derived and generated")
    try:
        rest = without_damping(oscillator).oscillator
        expansion = backbone_series(rest, max(orders)) if known is None else known.truncated(max(orders))
    except InputError as error:
        yield refused("lindstedt", "perturbation expansion", "expansion", str(error))
    else:
        yield from series(motion, expansion, sorted(orders), sources)
        step("resummations")
        yield from resummations(motion, expansion, sources)
    step("slow flow by order")
    yield from slow_flows(motion)
    yield from yardsticks(motion, sources)


def refused(method: str, label: str, kind: Kind, why: str, *, order: int | None = None) -> Contender:
    """A contender that says why it gives nothing."""
    return Contender(Row(method, label, kind, order=order, refused=why), None)


def nanoseconds(function: Callable[[Array], object], x: Array) -> float:
    """Median wall time of a call over the array, per value, repeated to ``TIMED`` values; one call is not counted."""
    x = np.resize(x, max(TIMED, x.size))
    function(x)
    laps = []
    for _ in range(REPEATS):
        began = time.perf_counter_ns()
        function(x)
        laps.append(time.perf_counter_ns() - began)
    return float(np.median(laps)) / x.size


def arguments(motion: Motion, expansion: Expansion, sources: Mapping[Source, Array]) -> dict[Source | None, Array]:
    """What the expansion is evaluated at: A(t) by source, or eps of a limit cycle, the same at all times."""
    if expansion.variable != "eps":
        return {source: x for source, x in sources.items()}  # noqa: C416 - the keys widen to those of a limit cycle
    name = motion.setting.oscillator.small or "eps"
    eps = motion.setting.case().parameters[name]
    return {None: np.full(motion.time.size, float(eps))}


def series(
    motion: Motion, expansion: Expansion, orders: Iterable[int], sources: Mapping[Source, Array]
) -> Iterator[Contender]:
    """The truncated series by order, as generated Python and generated C."""
    at = arguments(motion, expansion, sources)
    for order in orders:
        part = expansion.truncated(order)
        count = sum(1 for c in part.coefficients if c != 0)
        with compiled(part) as native:
            ways: dict[str, Callable[[Array], Array]] = {"python": python_module(part).omega0}
            if not isinstance(native, NotCompiled):
                ways["c"] = native
            for language, function in ways.items():
                cost = nanoseconds(function, next(iter(at.values())))
                for source, x in at.items():
                    row = Row(
                        f"{expansion.method}-{order}"
                        + (f"-{source}" if source else "")
                        + ("" if language == "python" else "-c"),
                        f"expansion, order {order}" + (f", A(t) from the {source}" if source else ""),
                        "expansion",
                        order=order,
                        coefficients=count,
                        amplitude_from=source,
                        language=language,
                        time_ns_per_value=cost,
                    )
                    yield Contender(row, np.asarray(function(x), dtype=float))


def resummations(motion: Motion, expansion: Expansion, sources: Mapping[Source, Array]) -> Iterator[Contender]:
    """Other formulas from the same coefficients, where they exist."""
    if expansion.variable == "eps":
        return
    oscillator = without_damping(motion.setting.oscillator).oscillator
    order = min(expansion.order, 24)
    part = expansion.truncated(order)
    for name in RESUMMATIONS:
        for source, x in sources.items():
            try:
                formula = resum(oscillator, part, name, up_to=Fraction(float(np.nanmax(x))))
                omega = np.asarray(formula(x), dtype=float)
            except (InputError, ValueError, ZeroDivisionError) as error:
                yield refused(f"{name}-{order}", f"{name}, order {order}", "resummation", str(error), order=order)
                break
            row = Row(
                f"{name}-{order}-{source}",
                f"{formula.method}, A(t) from the {source}",
                "resummation",
                order=order,
                amplitude_from=source,
            )
            yield Contender(row, omega)


def slow_flows(motion: Motion) -> Iterator[Contender]:
    """Multiple scales by order: a(t) integrated from the slow flow, then phi'(a); no trajectory enters."""
    for order in FLOW_ORDERS:
        label = f"multiple scales, order {order}"
        try:
            flow = multiple_scales(motion.setting.oscillator, order)
            began = time.perf_counter()
            curve = slow_flow_curve(motion, flow)
            seconds = time.perf_counter() - began
        except (InputError, ValueError) as error:
            yield refused(f"multiple-scales-{order}", label, "slow-flow", str(error), order=order)
            continue
        omega = np.full(motion.time.size, np.nan)
        omega[: curve.omega.size] = curve.omega
        row = Row(
            f"multiple-scales-{order}",
            label,
            "slow-flow",
            order=order,
            coefficients=len(flow.frequency) + len(flow.growth_rate),
            time_s_per_track=seconds,
            time_ns_per_value=seconds / motion.time.size * 1e9,
        )
        yield Contender(row, omega)


def yardsticks(motion: Motion, sources: Mapping[Source, Array]) -> Iterator[Contender]:
    """The paper's series (14) by terms, the exact backbone at each amplitude, and the linear oscillator (3)."""
    k, mu = motion.dynamics.natural_frequency, motion.dynamics.damping
    for source, x in sources.items():
        if motion.setting.is_pendulum:
            for terms in TERMS:
                function = partial(series_frequency, k=k, terms=terms)
                row = Row(
                    f"series-{terms}-{source}",
                    f"(14), {terms} terms, A(t) from the {source}",
                    "series-model",
                    order=terms,
                    coefficients=terms,
                    amplitude_from=source,
                    language="numpy",
                    time_ns_per_value=nanoseconds(function, x),
                )
                yield Contender(row, np.asarray(function(x)))
        if source == "energy":
            cost = None if motion.dynamics.closed_form is None else nanoseconds(motion.dynamics.closed_form, x)
            label = "exact omega0 at A(t) from the energy"
            row = Row("closed-form", label, "closed-form", amplitude_from=source, time_ns_per_value=cost)
            yield Contender(row, motion.exact_at_energy)
    if motion.averaged is not None:
        row = Row("averaged-action", "exact omega0 of the averaged action", "averaged", amplitude_from="action")
        yield Contender(row, motion.averaged.omega)
        if mu and is_linearly_damped(motion.dynamics, float(motion.averaged.peak[0])):
            label = "sqrt(omega0^2 - mu^2) of the averaged action"
            row = Row("averaged-damped", label, "averaged", amplitude_from="action")
            yield Contender(row, np.sqrt(np.maximum(motion.averaged.omega**2 - mu * mu, 0.0)))
    flat = np.full(motion.time.size, np.sqrt(max(k * k - mu * mu, 0.0)))
    yield Contender(Row("linear", "linear oscillator, eq. (3)", "linear"), flat)
