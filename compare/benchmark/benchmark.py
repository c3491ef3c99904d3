"""Every contender on one motion, judged on one support against one reference, with its cost."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.benchmark.account import account
from ridgeback.compare.benchmark.crossings import crossings
from ridgeback.compare.benchmark.judging import common_support, coverages, judged, reference_of, relative_errors
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.benchmark.ways.contender import Contender, amplitudes
from ridgeback.compare.benchmark.ways.estimates import Estimator, estimates
from ridgeback.compare.benchmark.ways.expansions import ORDERS, theory
from ridgeback.compare.motion.motion import Motion, Setting, integrate_motion

STEPS = 14
"""Labels that the progress of a whole benchmark names, about."""


def benchmark(
    chosen: Setting,
    *,
    orders: Iterable[int] = ORDERS,
    estimators: Mapping[str, Estimator] | None = None,
    progress: Progress = silent,
) -> Benchmark:
    """Hold expansions, the paper's series model and estimates against the cycle frequency of one motion.

    Parameters
    ----------
    chosen : Setting
        Oscillator, initial state, duration and rate.
    orders : iterable of int
        Orders of the expansion, 0 or more.
    estimators : mapping, optional
        Estimators of your own that take part: name to a function of samples, shape ``(N,)``, that returns a Track.
    progress : callable
        Told the share that is done and the step.

    Returns
    -------
    Benchmark
        Rows with errors on one support and costs, crossings, and a verdict.

    Raises
    ------
    InputError
        For a motion that cannot be integrated or has too few cycles, and for orders below 0.
    """
    wanted = sorted(set(orders))
    if not wanted or wanted[0] < 0:
        raise InputError(f"orders {wanted} hold none, or one below 0; give for example 2,4,8,20,40")
    progress(0.0, "integrating the motion twice")
    motion = integrate_motion(chosen)
    step = _steps(progress)
    contenders = [*theory(motion, wanted, step), *estimates(motion, estimators or {}, step)]
    return assembled(motion, contenders)


def _steps(progress: Progress) -> Callable[[str], None]:
    done = 1

    def step(label: str) -> None:
        nonlocal done
        progress(min(done / STEPS, 0.99), label)
        done += 1

    return step


def assembled(motion: Motion, contenders: list[Contender]) -> Benchmark:
    """Judge the contenders and put everything together."""
    errors = relative_errors(motion, contenders)
    inside = motion.zone.interior(motion.time) & np.isfinite(motion.reference(motion.time))
    support, ranked = common_support(motion.time, errors, inside)
    share = coverages(errors, inside)
    rows = tuple(
        judged(c.row, error, motion.time, support if fit else inside, ranked=bool(fit), coverage=float(covered))
        for c, error, fit, covered in zip(contenders, errors, ranked, share, strict=True)
    )
    reference = reference_of(motion, support)
    amplitude = next(iter(amplitudes(motion).values()))
    cycle = round(2 * np.pi / float(np.nanmedian(motion.reference(motion.time))) * motion.trajectory.rate)
    times = motion.time[support]
    return Benchmark(
        case=motion.setting.case(),
        reference=reference,
        support=(float(times[0]), float(times[-1])),
        contenders=rows,
        crossings=crossings(rows, errors, amplitude, support, cycle, reference),
        verdict=judge(rows, reference),
        time=motion.time,
        amplitude=amplitude,
        errors=errors,
        account=account(motion),
    )
