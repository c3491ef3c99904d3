"""Every estimator with its own defaults on the same noise-free samples: how far off it is, and what it says of that."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.motion.error_norms import Zones, relative_error, rms
from ridgeback.compare.motion.estimate_curves import curve_of
from ridgeback.compare.motion.results import Curve, DecayComparison
from ridgeback.compare.report.results import EstimatorScore
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.estimators.estimate import METHODS, estimate
from ridgeback.numeric.tracking.track import Track

COMPARED = tuple(method for method in METHODS if method not in ("auto", "model-fit"))
"""All that need nothing but the samples; ``auto`` is one of the others."""


def estimator_scores(
    decay: DecayComparison, *, methods: Iterable[str] = COMPARED, progress: Callable[[float, str], None]
) -> tuple[EstimatorScore, ...]:
    """Run every method on the samples of u; a refusal becomes a score with its reason."""
    wanted = tuple(methods)
    found = []
    for i, method in enumerate(wanted):
        progress(i / len(wanted), method)
        found.append(estimator_score(decay, method))
    return tuple(found)


def estimator_score(decay: DecayComparison, method: str) -> EstimatorScore:
    """Run one method."""
    began = time.process_time()
    try:
        track = estimate(decay.u, decay.case.rate, method=method, start=float(decay.time[0]), remove_bias=True)
    except InputError as refusal:
        return EstimatorScore(method, *(None,) * 6, time.process_time() - began, failed=str(refusal))
    return judged(decay, track, time.process_time() - began)


def judged(decay: DecayComparison, track: Track, seconds: float) -> EstimatorScore:
    """Errors and interval of a track, its bias removed, against the reference of the decay."""
    zone = Zones(float(decay.time[0]), *decay.interior, float(decay.time[-1]))
    expected = reference_at(decay.reference, track.time)
    error = relative_error(curve_of(track, track.method, track.method), lambda _: expected)
    raw = error if track.bias is None else error + track.bias / expected
    inside = zone.interior(track.time)
    half_width, coverage = interval_of(track, expected, inside & track.valid & np.isfinite(expected))
    return EstimatorScore(
        method=track.method,
        rms_raw=rms(raw[inside]),
        rms_interior=rms(error[inside]),
        rms_start=rms(error[zone.start(track.time)]),
        rms_end=rms(error[zone.end(track.time)]),
        half_width=half_width,
        coverage=coverage,
        seconds=seconds,
    )


def interval_of(track: Track, expected: Array, keep: Mask) -> tuple[float | None, float | None]:
    """Median relative half width of the 95 % interval and the share that holds the reference; None without one."""
    if track.interval is None or not keep.any():
        return None, None
    low, high = track.interval.low[keep], track.interval.high[keep]
    width = 0.5 * (high - low) / expected[keep]
    return float(np.median(width)), float(np.mean((low <= expected[keep]) & (expected[keep] <= high)))


def reference_at(reference: Curve, times: Array) -> Array:
    """The reference at the times of a track, by interpolation between its samples; NaN where it says nothing.

    >>> t = np.arange(4.0)
    >>> curve = Curve("", "", "reference", t, 2 * t, t < 3)
    >>> reference_at(curve, np.array([0.5, 2.5])).tolist()
    [1.0, nan]
    """
    known = reference.valid & np.isfinite(reference.omega)
    return np.interp(times, reference.time[known], reference.omega[known], left=np.nan, right=np.nan)
