"""Frequency estimators in white Gaussian noise, trial by trial, held against the Cramer-Rao bound.

The noise of a trial depends on the seed, the ratio and the trial's number alone: every method sees the same records,
and the result is the same on any executor and in any order.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, as_completed
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.binding.family import family_of
from ridgeback.compare.noise.results import NoiseCell, NoiseStudy, Trial, Window, cell_of
from ridgeback.compare.noise.truth import STRAIGHT, Sampled, Truth, paper_truth, recording_truth
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.estimators.estimate import METHODS as ESTIMATORS
from ridgeback.numeric.estimators.estimate import MODEL_FIT, estimate, estimation
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.oscillator import Oscillator

METHODS = (
    "harmonic-least-squares",
    "harmonic-least-squares/local",
    "pseudo-wigner",
    "spectrogram",
    "zero-crossing",
)
"""``harmonic-least-squares`` chooses its scope; ``/local`` and ``/global`` settle it."""
SCOPED = "harmonic-least-squares"
SNR_DB = (0.0, 10.0, 20.0, 30.0, 40.0)
TRIALS = 12
MOST_TRIALS = 100_000
BUDGET_SECONDS = 3600.0
BLOCK = 5
"""Trials of one piece of work: small, so that an interrupted study holds about as many trials in every cell."""


@dataclass(frozen=True)
class Work:
    """One piece: trials ``first .. last - 1`` of one method at one ratio."""

    truth: Truth
    method: str
    snr_db: float
    seed: int
    first: int
    last: int
    options: Mapping[str, object]
    """Those of ridgeback.numeric.estimators.estimate."""


def monte_carlo(
    source: Truth | Sampled | ArrayLike | None = None,
    rate: float | None = None,
    *,
    methods: Sequence[str] = METHODS,
    snr_db: Sequence[float] = SNR_DB,
    trials: int = TRIALS,
    seed: int = 1,
    band: tuple[float, float] | None = None,
    lag_seconds: float | None = None,
    remove_bias: bool = False,
    intervals: bool = True,
    oscillator: Oscillator | None = None,
    free: Sequence[str] = (),
    executor: Executor | None = None,
    budget_seconds: float = BUDGET_SECONDS,
    progress: Progress = silent,
) -> NoiseStudy:
    """Run every method on ``trials`` noisy copies of a record at every signal-to-noise ratio (dB).

    The cost is predicted from one noise-free run of every method.  An interrupt (KeyboardInterrupt) ends the study
    with the trials done so far and ``complete=False``; before any trial is done it passes through.

    Parameters
    ----------
    source
        A :class:`Truth`; or a recording, or the samples of one, shape (n,), whose smooth harmonic model is then the
        truth.  By default the paper's case.
    rate
        Samples per time unit of ``source`` when that is an array.
    methods
        Estimators; ``harmonic-least-squares/local`` and ``/global`` settle that method's scope.
    snr_db
        Ratios of the noise-free signal's variance to the noise's, in decibels, each once.
    trials
        Noisy records at each ratio, 2 or more.
    seed
        Of the noise; every method sees the same records.
    band, lag_seconds, remove_bias
        Those of :func:`ridgeback.numeric.estimators.estimate.estimate`: search band in rad per time unit, length of the
        window in time units, and whether the estimated bias is taken off.
    intervals
        Whether 95 % intervals are found, for their coverage; without them a study takes a tenth of the time.
    oscillator, free
        What the method model-fit fits, and which of its parameters it finds; by default those of the truth.
    executor
        Where trials run, here by default; the result is the same.
    budget_seconds
        CPU seconds beyond which a study is refused beforehand.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    NoiseStudy
        One cell per method and ratio; errors are relative, over 10 % to 90 % of the record.

    Raises
    ------
    InputError
        For an unknown method, trials or ratios out of range, and a study that would take more than its budget.

    References
    ----------
    S. M. Kay, Fundamentals of Statistical Signal Processing: Estimation Theory (1993), ch. 3 (Cramer-Rao bound).

    Examples
    --------
    >>> study = monte_carlo(methods=("pseudo-wigner",), snr_db=(20.0,), trials=3)
    >>> cell = study.cells[0]
    >>> cell.trials, cell.failures, 1e-3 < cell.rms < 1e-2
    (3, 0, True)
    """
    _check(methods, snr_db, trials)
    truth = truth_of(source, rate)
    if oscillator is not None:
        truth = replace(truth, oscillator=oscillator, free=tuple(free) or tuple(oscillator.parameters))
    ratios = tuple(float(value) for value in snr_db)
    options = {
        "band": band,
        "lag_seconds": lag_seconds,
        "remove_bias": remove_bias,
        "bias": intervals,
        "deviations": intervals,
    }
    _check_cost(truth, methods, len(ratios) * trials, options, budget_seconds)
    pieces = [
        Work(truth, method, snr, seed, first, min(first + BLOCK, trials), options)
        for first in range(0, trials, BLOCK)
        for snr in ratios
        for method in methods
    ]
    done, complete = _gather(pieces, executor, progress)
    return NoiseStudy(
        title=truth.title,
        truth=truth.what,
        bound=truth.bound,
        methods=tuple(methods),
        snr_db=ratios,
        trials=trials,
        seed=seed,
        rate=truth.rate,
        samples=truth.x.size,
        interior=(truth.zone.lower, truth.zone.upper),
        cells=tuple(_cells(truth, methods, ratios, done)),
        complete=complete,
    )


def truth_of(source: Truth | Sampled | ArrayLike | None, rate: float | None = None) -> Truth:
    """The noise-free record that a study is about; InputError for samples without their rate."""
    if source is None:
        return paper_truth() if rate is None else paper_truth(rate=rate)
    if isinstance(source, Truth):
        return source
    if isinstance(source, Sampled):
        start = float(source.time[0])
        title = f"{source.source}, {source.name}"
        return recording_truth(source.values, source.rate, start=start, title=title)
    if rate is None:
        raise InputError("the samples come without their sampling rate; give rate=, samples per time unit")
    return recording_truth(np.asarray(source, dtype=np.float64), rate)


def _check(methods: Sequence[str], snr_db: Sequence[float], trials: int) -> None:
    for method in methods:
        name, slash, scope = method.partition("/")
        if name not in (*ESTIMATORS, MODEL_FIT) or (slash and (name != SCOPED or scope not in tuple(Scope))):
            known = (*ESTIMATORS, MODEL_FIT, *(f"{SCOPED}/{scope}" for scope in tuple(Scope)))
            raise InputError(f"method {method!r} is unknown; use one of {', '.join(known)}")
    for name, values in (("method", methods), ("ratio", snr_db)):
        if len(values) == 0 or len(set(values)) < len(values):
            raise InputError(f"{len(values)} values of {name}, some of them twice or none at all; name each once")
    wrong = [value for value in snr_db if not (math.isfinite(value) and -100.0 <= value <= 300.0)]
    if wrong:
        raise InputError(f"signal-to-noise ratio {wrong[0]} dB is not between -100 and 300; use for example 0,10,20")
    if not 2 <= trials <= MOST_TRIALS:
        raise InputError(f"{trials} trials are not between 2 and {MOST_TRIALS}; without a second there is no spread")


def _check_cost(
    truth: Truth, methods: Sequence[str], runs: int, options: Mapping[str, object], budget_seconds: float
) -> None:
    """Refuse a study that one noise-free run of every method predicts to be too long."""
    began = time.process_time()
    for method in methods:
        attempt(truth, truth.x, method, options)
    once = time.process_time() - began
    if once * runs > budget_seconds:
        raise InputError(
            f"{runs} runs of {len(methods)} methods need about {once * runs:.3g} s, over the budget of "
            f"{budget_seconds:g} s; use at most {int(budget_seconds / once)} runs (trials times ratios)"
        )


def attempt(truth: Truth, x: Array, method: str, options: Mapping[str, object]) -> Track | InputError:
    """One estimate of a record, or the reason why there is none."""
    name, _, scope = method.partition("/")
    try:
        if name == MODEL_FIT:
            return estimate(x, truth.rate, method=name, start=truth.start, family=fitted_family(truth))
        more = {"scope": scope} if scope else {}
        return estimation(x, truth.rate, method=name, start=truth.start, **options, **more).track  # type: ignore[arg-type]
    except InputError as refusal:
        return refusal


def fitted_family(truth: Truth) -> Family:
    """The oscillator that model-fit fits; InputError when the study names none."""
    if truth.oscillator is None:
        raise InputError(f"{MODEL_FIT} needs an oscillator; name it and its free parameters, or leave the method out")
    return family_of(truth.oscillator, truth.free)


def noisy(truth: Truth, snr_db: float, seed: int, trial: int) -> Array:
    """The record of one trial.

    >>> truth = paper_truth(duration=6.0)
    >>> x = noisy(truth, 20.0, seed=1, trial=0)
    >>> bool(np.array_equal(x, noisy(truth, 20.0, seed=1, trial=0))), round(float(np.std(x - truth.x)), 2)
    (True, 0.2)
    """
    key = (abs(seed), round(1000 * (snr_db + 1000)), trial)
    return truth.x + truth.noise(snr_db) * np.random.default_rng(key).standard_normal(truth.x.size)


def run(work: Work) -> list[Trial]:
    """The trials of one piece of work."""
    records = (noisy(work.truth, work.snr_db, work.seed, trial) for trial in range(work.first, work.last))
    return [judged(work.truth, attempt(work.truth, x, work.method, work.options)) for x in records]


def judged(truth: Truth, track: Track | InputError) -> Trial:
    """Errors of a track over the interior, where it is valid."""
    if isinstance(track, InputError):
        return Trial(reason=str(track))
    keep = track.valid & np.isfinite(track.omega) & truth.zone.interior(track.time)
    if not keep.any():
        return Trial(reason=f"{track.method}: no valid sample in the interior")
    expected = truth.omega_at(track.time[keep])
    error = track.omega[keep] / expected - 1.0
    covered = None
    if track.interval is not None:
        covered = float(np.mean((track.interval.low[keep] <= expected) & (expected <= track.interval.high[keep])))
    lag, degree = track.used.lag_seconds, track.used.phase_degree
    return Trial(
        float(np.mean(error**2)),
        float(error.mean()),
        covered,
        truth.half(lag),
        STRAIGHT if degree is None else degree,
        own_bound(track, keep, expected),
    )


def own_bound(track: Track, keep: Mask, expected: Array) -> float | None:
    """Relative bound for unit noise of a model of the whole record, from the deviations of its fit; None elsewhere."""
    noise = track.used.noise
    whole = track.method == MODEL_FIT or track.used.scope is Scope.GLOBAL
    if not whole or track.standard_deviation is None or noise is None or not noise > 0.0:
        return None
    return float(np.sqrt(np.mean((track.standard_deviation[keep] / expected) ** 2))) / noise


def _gather(
    pieces: list[Work], executor: Executor | None, progress: Progress
) -> tuple[dict[tuple[str, float], dict[int, Trial]], bool]:
    """Trials by cell and number; False when an interrupt came before the last."""
    found: dict[tuple[str, float], dict[int, Trial]] = {(p.method, p.snr_db): {} for p in pieces}
    results = _in_turn(pieces) if executor is None else _spread(pieces, executor)
    try:
        for count, (piece, trials) in enumerate(results, start=1):
            found[piece.method, piece.snr_db].update(zip(range(piece.first, piece.last), trials, strict=True))
            progress(count / len(pieces), f"{piece.method} at {piece.snr_db:g} dB, trials to {piece.last}")
    except KeyboardInterrupt:
        if not all(found.values()):
            raise
        return found, False
    return found, True


def _in_turn(pieces: list[Work]) -> Iterator[tuple[Work, list[Trial]]]:
    for piece in pieces:
        yield piece, run(piece)


def _spread(pieces: list[Work], executor: Executor) -> Iterator[tuple[Work, list[Trial]]]:
    """The same on an executor, in the order of completion; what has not begun is cancelled when nobody waits."""
    futures: dict[Future[list[Trial]], Work] = {executor.submit(run, piece): piece for piece in pieces}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    finally:
        for future in futures:
            future.cancel()


def _cells(
    truth: Truth,
    methods: Sequence[str],
    ratios: Sequence[float],
    done: dict[tuple[str, float], dict[int, Trial]],
) -> Iterator[NoiseCell]:
    given = [trial for cell in done.values() for trial in cell.values() if not trial.reason and trial.own is None]
    unit = {window: _bound(truth, window) for window in {(trial.half, trial.degree) for trial in given}}
    for method in methods:
        for snr in ratios:
            trials = [trial for _, trial in sorted(done[method, snr].items())]
            yield cell_of(method, snr, trials, unit, truth.noise(snr))


def _bound(truth: Truth, window: Window) -> float:
    """Relative bound for unit noise; NaN where the window does not determine the model."""
    try:
        return truth.relative_bound(*window, noise=1.0)
    except InputError:
        return math.nan
