"""Assemble a report: everything the page shows, computed here, deterministic apart from the times it took."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.common.quantities import symbol
from ridgeback.compare.motion.comparison import HIGH_ORDER, compare_decay
from ridgeback.compare.motion.model_curves import LOW_ORDERS
from ridgeback.compare.motion.motion import Setting, integrate_motion, setting
from ridgeback.compare.motion.results import DecayComparison
from ridgeback.compare.noise.truth import motion_truth
from ridgeback.compare.report import csv_tables as tables
from ridgeback.compare.report.estimator_scores import estimator_scores
from ridgeback.compare.report.noise_part import TRIALS, noise_part
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.stages import Stopwatch
from ridgeback.compare.report.summary import cards, decay_sentences, study_sentences, study_title
from ridgeback.compare.study.certified import certified
from ridgeback.compare.study.derivation import derivation
from ridgeback.compare.study.derived import Derived, derive
from ridgeback.compare.study.results import Range, Study, Timing
from ridgeback.compare.study.study import ranges, study_of
from ridgeback.compare.study.timing import timings
from ridgeback.compare.study.truncations import already_derived
from ridgeback.numeric.arrays import Array
from ridgeback.symbolic.systems.any_form import OscillatorLike

ORDERS = (2, 4, 6, 8, 10, 12, 16, 20, 30, 40)
CYCLE_ORDERS = (2, 4, 6, 8, 12, 16, 20, 30, 48)
"""Orders in eps for limit cycles, whose series cost more per order."""
AMPLITUDES = 49
CYCLE_STRENGTHS = np.linspace(0.2, 2.6, 13)
ORDER, TARGET = 8, 1e-3


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


def system_report(
    chosen: Setting | OscillatorLike,
    *,
    order: int = ORDER,
    orders: Sequence[int] | None = None,
    amplitudes: Sequence[float] | Array | None = None,
    target: float = TARGET,
    trials: int = TRIALS,
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
        The expansion that title, formulas and code are about.
    orders
        Orders of the accuracy study; by default up to 40 (limit cycles: 48).
    amplitudes
        Peak amplitudes of the study in the unit of u, or values of eps for a limit cycle, shape (n,); by default up to
        98 % of the separatrix.
    target
        Relative error of the ranges of use, between 0 and 1.
    trials
        Noisy records a point of the noise study; 0 for none.
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
    watch = Stopwatch(progress)
    with watch.stage("deriving", 0.0, 0.05):
        plan, derived = _plan(case, order, orders, amplitudes, target, trials)
    with watch.stage("accuracy-order study", 0.05, 0.15):
        result = study_of(derived.undamped, plan.orders, plan.amplitudes, truncate=already_derived(derived))
    with watch.stage("along the motion", 0.15, 0.5) as inner:
        motion = integrate_motion(case)
        decay = compare_decay(motion, derived=derived, orders=_drawn(derived, order), progress=inner)
    with watch.stage("every estimator", 0.5, 0.7) as inner:
        ranked = estimator_scores(decay, progress=inner)
    with watch.stage("estimators in noise", 0.7, 0.97) as inner:
        noise = noise_part(lambda: motion_truth(motion), trials, inner)
    with watch.stage("evaluation time", 0.97, 1.0):
        times = _timings(derived, plan)
    progress(1.0, "done")
    found = ranges(result, plan.target)
    finding = next(item for item in found if item.order == plan.order)
    left_out = (noise.left_out,) if noise.left_out else ()
    return Report(
        title=study_title(result, finding),
        lead=_lead(case),
        summary=(*study_sentences(result, found), *decay_sentences(decay), *left_out),
        cards=cards(result, finding, times),
        derivation=derivation(derived, order=plan.order),
        study=result,
        ranges=_shown_ranges(result, plan.target),
        decay=decay,
        recording=None,
        timings=times,
        provenance=provenance(plan.settings(), command=command, seconds=watch.seconds()),
        certified=certified(derived.undamped.oscillator, plan.order, float(plan.amplitudes[-1])),
        estimator_scores=ranked,
        noise=noise.study,
        csv=_system_csv(result, decay),
        finding=finding,
    )


def _plan(
    case: Setting,
    order: int,
    orders: Sequence[int] | None,
    amplitudes: Sequence[float] | Array | None,
    target: float,
    trials: int,
) -> tuple[Plan, Derived]:
    if not 0 < target < 1:
        raise InputError(f"target {target} is not a relative error between 0 and 1; use e.g. 0.001")
    cycle = case.oscillator.kind == "limit-cycle"
    wanted = tuple(sorted({*(orders or (CYCLE_ORDERS if cycle else ORDERS)), order}))
    derived = derive(case.oscillator, max(HIGH_ORDER, *wanted), flow_order=min(max(order, 2), 8))
    grid = np.asarray(amplitudes, dtype=float) if amplitudes is not None else _amplitudes(case, derived)
    return Plan(case, order, wanted, np.sort(grid), target, trials), derived


def _amplitudes(case: Setting, derived: Derived) -> Array:
    """Up to 98 % of the separatrix; without one, beyond the radius of convergence or the initial amplitude."""
    if derived.expansion.variable == "eps":
        return CYCLE_STRENGTHS
    if derived.undamped.limit is not None:
        return np.linspace(0.02, 0.98, AMPLITUDES) * derived.undamped.limit
    radius = derived.limits.radius
    top = 1.5 * (max(abs(case.initial[0]), 0.1) if radius is None else radius)
    return np.linspace(0.02, 1.0, AMPLITUDES) * top


def _drawn(derived: Derived, order: int) -> tuple[int, ...]:
    """Orders drawn along the motion: the paper's low ones, the chosen one, and a high one."""
    return tuple(sorted({*LOW_ORDERS, min(order, derived.expansion.order), HIGH_ORDER}))


def _timings(derived: Derived, plan: Plan) -> tuple[Timing, ...]:
    expansion = derived.expansion.truncated(plan.order)
    return timings(
        expansion, derived.undamped.dynamics, upper=float(plan.amplitudes[-1]), pendulum=plan.setting.is_pendulum
    )


def _shown_ranges(result: Study, target: float) -> tuple[Range, ...]:
    """Ranges at the target asked for and at the three of the order map."""
    return tuple(item for level in sorted({1e-2, 1e-3, 1e-6, target}, reverse=True) for item in ranges(result, level))


def _lead(case: Setting) -> str:
    o = case.oscillator
    values = ", ".join(f"{symbol(name)} = {float(v):.6g}" for name, v in o.parameters.items() if v is not None)
    given = f" with {values}" if values else ""
    reference = f"  {o.reference}." if o.reference else ""
    return f"{o.title}{given}.{reference}".replace("..", ".")


def _system_csv(result: Study, decay: DecayComparison) -> dict[str, str]:
    return {
        "study.csv": tables.study_table(result),
        "decay.csv": tables.decay_table(decay),
        "scores.csv": tables.scores_table(decay.scores),
        "budget.csv": tables.budget_table(decay.budget),
        "harmonics.csv": tables.harmonics_table(decay),
    }
