"""Assemble a report: everything the page shows, computed here, deterministic apart from the times it took."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.benchmark.benchmark import assembled
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.ways.contender import Contender
from ridgeback.compare.benchmark.ways.estimates import estimates
from ridgeback.compare.benchmark.ways.expansions import ORDERS as CONTENDING
from ridgeback.compare.benchmark.ways.expansions import theory
from ridgeback.compare.motion.comparison import HIGH_ORDER, compare_motion
from ridgeback.compare.motion.estimate_curves import LEAN, SHORT
from ridgeback.compare.motion.model_curves import LOW_ORDERS
from ridgeback.compare.motion.motion import Motion, Setting, integrate_motion, setting
from ridgeback.compare.motion.paper_case import is_paper_case
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.noise.truth import motion_truth
from ridgeback.compare.report import csv_tables as tables
from ridgeback.compare.report.cards import Known, cards
from ridgeback.compare.report.error_grid import ErrorGrid, error_grid
from ridgeback.compare.report.findings import findings, lead_of, title_of
from ridgeback.compare.report.naming import parameters_line
from ridgeback.compare.report.noise_part import TRIALS, noise_part
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.results import Described, Report
from ridgeback.compare.report.stages import Stopwatch
from ridgeback.compare.study.certified import certified
from ridgeback.compare.study.derivation import derivation
from ridgeback.compare.study.derived import Derived, derived_or_none
from ridgeback.compare.study.results import Range, Study
from ridgeback.compare.study.study import ranges, study_of
from ridgeback.compare.study.truncations import already_derived
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.any_form import OscillatorLike

ORDERS = tuple(range(2, 41, 2))
CYCLE_ORDERS = (2, 4, 6, 8, 10, 12, 16, 20, 24, 30)
"""Orders in eps for limit cycles, whose series cost more per order."""
AMPLITUDES = 98
CYCLE_STRENGTHS = np.linspace(0.2, 2.6, 13)
ORDER, TARGET = 20, 1e-3
FLOW_ORDER = 8
BEYOND = 1.1
"""The study goes at least this many times as far as the motion."""
UNNAMED = "equation"
"""What an equation of the command line is called, which says nothing that the equation does not."""


@dataclass(frozen=True)
class Plan:
    """What a report on an oscillator computes."""

    setting: Setting
    order: int
    orders: tuple[int, ...]
    amplitudes: Array
    target: float
    trials: int

    def settings(self) -> Mapping[str, object]:
        """Everything that determines the result, for the settings hash."""
        o, case = self.setting.oscillator, self.setting
        return {
            "system": o.name,
            "equation": o.equation,
            **{f"parameter {name}": str(value) for name, value in o.parameters.items()},
            "initial": f"{case.initial[0]!r}, {case.initial[1]!r}",
            "duration": case.duration,
            "rate": case.rate,
            "order": self.order,
            "orders": ", ".join(map(str, self.orders)),
            "amplitudes": f"{self.amplitudes.size} from {self.amplitudes[0]:.6g} to {self.amplitudes[-1]:.6g}",
            "target": self.target,
            "trials": self.trials,
        }


@dataclass(frozen=True)
class Accuracy:
    """Order against amplitude: study, range of use of each order, grid of the sliders; empty without a series."""

    study: Study | None = None
    ranges: tuple[Range, ...] = ()
    grid: ErrorGrid | None = None


def system_report(
    chosen: Setting | OscillatorLike,
    *,
    order: int = ORDER,
    orders: Sequence[int] | None = None,
    amplitudes: Sequence[float] | Array | None = None,
    target: float = TARGET,
    trials: int = TRIALS,
    timed: bool = True,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Derive, study, integrate, compare and time one oscillator, and say what was found.

    Parameters
    ----------
    chosen
        An oscillator, or anything that names one, which then starts from its own initial state; or a setting with its
        initial state, duration and rate.
    order
        The expansion that formulas and code are about, and at which the sliders stand.
    orders
        Orders of the accuracy study; by default the even ones to 40 (limit cycles: some to 30).
    amplitudes
        Peak amplitudes of the study in the unit of u, or values of eps for a limit cycle, shape (n,); by default up to
        98 % of the separatrix, else beyond the start.
    target
        Relative error of the ranges of use, between 0 and 1.
    trials
        Noisy records a point of the noise study; 0 for none.
    timed
        Whether measured times are kept; without them the same inputs give the same report.
    command
        The command line that makes the same report, for its provenance.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Report
        Complete; a method that fails keeps its reason, and a noise study that is left out is named in the summary.

    Raises
    ------
    InputError
        For a target outside 0 to 1, and for whatever cannot be derived, studied or integrated.
    """
    case = chosen if isinstance(chosen, Setting) else setting(chosen)
    paper = is_paper_case(case)
    watch = Stopwatch(progress)
    with watch.stage("integrating the motion twice", 0.0, 0.1):
        motion = integrate_motion(case)
    with watch.stage("deriving and studying", 0.1, 0.2):
        plan, derived = _plan(motion, order, orders, amplitudes, target, trials)
        accuracy = Accuracy() if derived is None else _accuracy(derived, plan)
    with watch.stage("contenders", 0.2, 0.5) as inner:
        contenders = _contenders(motion, plan, derived, inner, timed=timed)
        found = assembled(motion, contenders) if timed else untimed(assembled(motion, contenders))
    with watch.stage("along the motion", 0.5, 0.7) as inner:
        decay = compare_motion(
            motion,
            derived=derived,
            orders=_drawn(derived, order),
            recipes=LEAN if paper else SHORT,
            known_tracks=tracks_of(contenders),
            progress=inner,
        )
    with watch.stage("estimators in noise", 0.7, 1.0) as inner:
        noise = noise_part(lambda: motion_truth(motion), trials, inner)
    progress(1.0, "done")
    known = Known(
        benchmark=found,
        study=accuracy.study,
        ranges=accuracy.ranges,
        noise=noise.study,
        target=target,
        pendulum=case.is_pendulum,
        natural_frequency=motion.dynamics.natural_frequency,
    )
    said = findings(found, decay, derived, float(motion.energy_peak[0]))
    return Report(
        title=title_of(found.verdict, found.reference),
        lead=lead_of(found, timed=timed),
        summary=(*said, *((noise.left_out,) if noise.left_out else ())),
        cards=cards(known),
        derivation=None if derived is None else derivation(derived, order=plan.order),
        study=accuracy.study,
        ranges=accuracy.ranges,
        decay=decay,
        recording=None,
        provenance=provenance(plan.settings(), command=command, seconds=watch.seconds() if timed else None),
        certified=None
        if derived is None
        else certified(derived.undamped.oscillator, plan.order, float(plan.amplitudes[-1])),
        noise=noise.study,
        csv=_csv(accuracy.study, decay, found),
        finding=next((r for r in accuracy.ranges if r.order == plan.order and r.target == plan.target), None),
        benchmark=found,
        grid=accuracy.grid,
        described=described(case),
        paper=paper,
        timed=timed,
    )


def described(case: Setting) -> Described:
    """Equation, parameters, start and sampling."""
    o = case.oscillator
    name = "" if o.title == UNNAMED else o.title
    return Described(name, o.equation_latex, parameters_line(case.case()), o.reference)


def _contenders(
    motion: Motion, plan: Plan, derived: Derived | None, progress: Progress, *, timed: bool
) -> list[Contender]:
    steps = iter(range(1, 100))

    def step(label: str) -> None:
        progress(min(next(steps) / 14, 0.99), label)

    orders = [o for o in plan.orders if o in CONTENDING or len(plan.orders) < len(CONTENDING)]
    known = None if derived is None else derived.expansion
    return [*theory(motion, orders, step, known=known, timed=timed), *estimates(motion, {}, step, timed=timed)]


def tracks_of(contenders: Sequence[Contender]) -> dict[str, Track]:
    """Raw estimates by method."""
    raw = (c for c in contenders if c.track is not None and c.row.corrected_by is None)
    return {c.row.method: c.track for c in raw if c.track is not None}


def untimed(found: Benchmark) -> Benchmark:
    """A benchmark without its measured times."""
    rows = tuple(replace(r, time_ns_per_value=None, time_s_per_track=None, time_scatter=None) for r in found.contenders)
    by_name = {row.method: row for row in rows}
    verdict = found.verdict
    rival = None if verdict.rival is None else by_name[verdict.rival.method]
    return replace(found, contenders=rows, verdict=replace(verdict, best=by_name[verdict.best.method], rival=rival))


def _plan(
    motion: Motion,
    order: int,
    orders: Sequence[int] | None,
    amplitudes: Sequence[float] | Array | None,
    target: float,
    trials: int,
) -> tuple[Plan, Derived | None]:
    if not 0 < target < 1:
        raise InputError(f"target {target} is not a relative error between 0 and 1; use e.g. 0.001")
    case = motion.setting
    cycle = case.oscillator.kind == "limit-cycle"
    wanted = tuple(sorted({*(orders or (CYCLE_ORDERS if cycle else ORDERS)), order}))
    highest, flow_order = max(HIGH_ORDER, *wanted), min(max(order, 2), FLOW_ORDER)
    derived = derived_or_none(case.oscillator, highest, flow_order=flow_order)
    grid = _amplitudes(motion, derived) if amplitudes is None else np.asarray(amplitudes, dtype=float)
    return Plan(case, order, wanted, np.sort(grid), target, trials), derived


def _amplitudes(motion: Motion, derived: Derived | None) -> Array:
    """Up to 98 % of the separatrix; without one, beyond the start and beyond the radius of convergence."""
    start = max(float(motion.energy_peak[0]), 0.1)
    if derived is None:
        return np.linspace(0.01, 1.0, AMPLITUDES) * BEYOND * start
    if derived.expansion.variable == "eps":
        own = _strength(motion)
        return CYCLE_STRENGTHS if own <= CYCLE_STRENGTHS[-1] else np.linspace(0.1, BEYOND * own, CYCLE_STRENGTHS.size)
    if derived.undamped.limit is not None:
        return np.linspace(0.01, 0.98, AMPLITUDES) * derived.undamped.limit
    radius = derived.limits.radius
    top = BEYOND * start if radius is None else max(BEYOND * start, min(1.5 * radius, 3.0 * start))
    return np.linspace(0.01, 1.0, AMPLITUDES) * top


def _strength(motion: Motion) -> float:
    """The motion's own eps."""
    return float(motion.setting.case().parameters[motion.setting.oscillator.small or "eps"])


def _accuracy(derived: Derived, plan: Plan) -> Accuracy:
    result = study_of(derived.undamped, plan.orders, plan.amplitudes, truncate=already_derived(derived))
    return Accuracy(result, _shown_ranges(result, plan.target), error_grid(derived, result))


def _drawn(derived: Derived | None, order: int) -> tuple[int, ...]:
    """Orders compared along the motion: the paper's low ones, the chosen one, and a high one."""
    if derived is None:
        return LOW_ORDERS
    return tuple(sorted({*LOW_ORDERS, min(order, derived.expansion.order), HIGH_ORDER}))


def _shown_ranges(result: Study, target: float) -> tuple[Range, ...]:
    """Ranges at the target asked for and at the three of the order map."""
    return tuple(item for level in sorted({1e-2, 1e-3, 1e-6, target}, reverse=True) for item in ranges(result, level))


def _csv(result: Study | None, decay: MotionComparison, found: Benchmark) -> dict[str, str]:
    return {
        "contenders.csv": tables.contenders_table(found),
        **({} if result is None else {"study.csv": tables.study_table(result)}),
        "decay.csv": tables.decay_table(decay),
        "budget.csv": tables.budget_table(decay.budget),
        "harmonics.csv": tables.harmonics_table(decay),
    }
