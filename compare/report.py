"""Assemble a report: everything the page shows, computed here, deterministic apart from the times it took."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from compare import tables
from compare.bind import bind
from compare.certified import certified
from compare.decay import HIGH_ORDER, compare_decay
from compare.derivation import Exact, derivation, derive, undamped
from compare.models import LOW_ORDERS
from compare.motion import Setting, setting
from compare.provenance import provenance
from compare.recording import compare_recording
from compare.results import Array, DecayComparison, Range, RecordingComparison, Report, Study, Timing
from compare.study import ranges, study
from compare.summary import cards, decay_sentences, study_sentences, study_title
from compare.summary_recording import recording_cards, recording_sentences, recording_title
from compare.timing import timings
from compare.wording import symbol
from numeric.potential import peak_limit
from numeric.recording import Recording
from symbolic.errors import InputError
from symbolic.oscillator import Oscillator
from symbolic.singularity import limits
from symbolic.systems import find

Progress = Callable[[float, str], None]
ORDERS = (2, 4, 6, 8, 10, 12, 16, 20, 30, 40)
CYCLE_ORDERS = (2, 4, 6, 8, 12, 16, 20, 30, 48)
"""Orders in eps for limit cycles, whose series cost more per order."""
AMPLITUDES = 49
CYCLE_STRENGTHS = np.linspace(0.2, 2.6, 13)
ORDER, TARGET = 8, 1e-3

# The paper's case: k = 4 pi to the last digit of a double, mu = 0.01, theta(0) = 0.95 pi at rest, 20 s.
PAPER_PARAMETERS = {"k": "12.566370614359172", "mu": "0.01"}


def paper_case() -> Setting:
    """Return the paper's damped pendulum: k = 4 pi, mu = 0.01, theta(0) = 0.95 pi at rest, 0 .. 20 s at 64 Hz.

    >>> paper_case().duration, paper_case().is_pendulum
    (20.0, True)
    """
    oscillator = find("damped-pendulum").with_parameters(PAPER_PARAMETERS)
    return setting(oscillator, initial=(0.95 * np.pi, 0.0), duration=20.0, rate=64.0, time_unit="s")


def silent(_: float, __: str) -> None:
    """Report no progress."""


@dataclass(frozen=True)
class Stages:
    """Times the stages of a report and passes their progress on."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, low: float, high: float) -> Iterator[Progress]:
        """Yield a progress callback that runs from ``low`` to ``high`` of the whole."""
        self.progress(low, name)
        began = time.perf_counter()
        yield lambda fraction, label: self.progress(low + fraction * (high - low), label)
        self.seconds[name] = round(time.perf_counter() - began, 3)


@dataclass(frozen=True)
class Plan:
    """What a report on an oscillator computes."""

    setting: Setting
    order: int
    orders: tuple[int, ...]
    amplitudes: Array
    target: float

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
        }


def assemble_system(
    chosen: Setting | Oscillator,
    *,
    order: int = ORDER,
    orders: Sequence[int] | None = None,
    amplitudes: Sequence[float] | Array | None = None,
    target: float = TARGET,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Derive, study, integrate, compare and time one oscillator, and say what was found.

    ``order`` is the expansion that the title and the formulas are about; ``orders`` and ``amplitudes`` span the
    study, ``target`` is the relative error of its ranges.  Raises InputError as the parts do.
    """
    case = setting(chosen) if isinstance(chosen, Oscillator) else chosen
    stages = Stages(progress)
    with stages.stage("deriving", 0.0, 0.05):
        plan, exact = _plan(case, order, orders, amplitudes, target)
    with stages.stage("accuracy-order study", 0.05, 0.15):
        result = study(case.oscillator, plan.orders, plan.amplitudes)
    with stages.stage("along the motion", 0.15, 0.93) as inner:
        decay = compare_decay(case, exact=exact, orders=_drawn(exact, order), progress=inner)
    with stages.stage("evaluation time", 0.93, 1.0):
        times = _timings(exact, plan)
    progress(1.0, "done")
    return _system_report(plan, exact, result, decay, times, command, stages.seconds)


def _plan(
    case: Setting, order: int, orders: Sequence[int] | None, amplitudes: Sequence[float] | Array | None, target: float
) -> tuple[Plan, Exact]:
    if not 0 < target < 1:
        raise InputError(f"target {target} is not a relative error between 0 and 1; use e.g. 0.001")
    cycle = case.oscillator.kind == "limit-cycle"
    wanted = tuple(sorted({*(orders or (CYCLE_ORDERS if cycle else ORDERS)), order}))
    exact = derive(case.oscillator, max(HIGH_ORDER, *wanted), flow_order=min(max(order, 2), 8))
    grid = np.asarray(amplitudes, dtype=float) if amplitudes is not None else _amplitudes(case, exact)
    return Plan(case, order, wanted, np.sort(grid), target), exact


def _amplitudes(case: Setting, exact: Exact) -> Array:
    """Up to 98 % of the separatrix; without one, beyond the radius of convergence or the initial amplitude."""
    if exact.expansion.variable == "eps":
        return CYCLE_STRENGTHS
    separatrix = peak_limit(bind(undamped(case.oscillator)))
    if np.isfinite(separatrix):
        return np.linspace(0.02, 0.98, AMPLITUDES) * separatrix
    radius = limits(exact.expansion).radius
    top = 1.5 * (max(abs(case.initial[0]), 0.1) if radius is None else radius)
    return np.linspace(0.02, 1.0, AMPLITUDES) * top


def _drawn(exact: Exact, order: int) -> tuple[int, ...]:
    """Orders drawn along the motion: the paper's low ones, the chosen one, and a high one."""
    return tuple(sorted({*LOW_ORDERS, min(order, exact.expansion.order), HIGH_ORDER}))


def _timings(exact: Exact, plan: Plan) -> tuple[Timing, ...]:
    expansion = exact.expansion.truncated(plan.order)
    dynamics = bind(undamped(plan.setting.oscillator))
    return timings(expansion, dynamics, upper=float(plan.amplitudes[-1]), pendulum=plan.setting.is_pendulum)


def _system_report(
    plan: Plan,
    exact: Exact,
    result: Study,
    decay: DecayComparison,
    times: tuple[Timing, ...],
    command: str,
    seconds: Mapping[str, float],
) -> Report:
    found = ranges(result, plan.target)
    finding = next(item for item in found if item.order == plan.order)
    shown = Exact(exact.oscillator, exact.expansion.truncated(plan.order), exact.flow)
    return Report(
        title=study_title(result, finding),
        lead=_lead(plan.setting),
        summary=(*study_sentences(result, found), *decay_sentences(decay)),
        cards=cards(result, finding, times),
        derivation=derivation(shown),
        study=result,
        ranges=_shown_ranges(result, plan.target),
        decay=decay,
        recording=None,
        timings=times,
        provenance=provenance(plan.settings(), command=command, seconds=seconds),
        certified=certified(undamped(plan.setting.oscillator), plan.order, float(plan.amplitudes[-1])),
        csv=_system_csv(result, decay),
        finding=finding,
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


def assemble_recording(
    source: str | Path | Recording,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    oscillator: Oscillator | None = None,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Estimate frequency, backbone and damping of a recording and say what was found.

    Raises InputError for a file that holds no usable signal, OSError when it cannot be read.
    """
    stages = Stages(progress)
    with stages.stage("recording", 0.0, 1.0) as inner:
        found = compare_recording(
            source, column=column, time_column=time_column, rate=rate, oscillator=oscillator, progress=inner
        )
    progress(1.0, "done")
    return _recording_report(found, oscillator, command, stages.seconds)


def _recording_report(
    found: RecordingComparison, oscillator: Oscillator | None, command: str, seconds: Mapping[str, float]
) -> Report:
    settings = {
        "source": found.source,
        "column": found.column,
        "rate": found.rate,
        "method": found.chosen,
        "theory": "" if oscillator is None else oscillator.equation,
    }
    nothing: tuple[Range, ...] = ()
    return Report(
        title=recording_title(found),
        lead=f"{found.source}, {found.column}: {found.time.size} samples shown, {found.rate:g} per second.",
        summary=recording_sentences(found),
        cards=recording_cards(found),
        derivation=None,
        study=None,
        ranges=nothing,
        decay=None,
        recording=found,
        timings=(),
        provenance=provenance(settings, command=command, input_hash=found.sha256, seconds=seconds),
        csv={"backbone.csv": tables.backbone_table(found), "tracks.csv": tables.curves_table(found.curves)},
    )
