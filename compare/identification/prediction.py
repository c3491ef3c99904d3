"""The rest of a decay foretold from its first cycles, and held against what was then measured.

Candidates are fitted to the first part alone.  The prediction is their mean by Akaike weights, and its variance is that
of the parameters and of the candidates' disagreement: sum of w (sigma^2 + (value - mean)^2).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from compare.identification.fitting import Data, Fit, demodulated, prepare
from compare.identification.identify import FEWEST_CYCLES, METHOD, Progress, Ranked, checked, part_of, rank, usable
from compare.identification.models import LAWS, NAMES
from compare.identification.ranking import covariance, spread_along
from compare.identification.results import NORMAL_95, Prediction
from compare.results import Array
from numeric.backbone import backbone
from numeric.errors import InputError
from numeric.estimate import estimate
from numeric.recording import Recording
from numeric.track import Track

LEAST_WEIGHT = 0.01
"""Candidates of less weight are left out of the mean."""


@dataclass(frozen=True)
class Rest:
    """What was measured after the part that was fitted: times from the first sample, and deviations."""

    time: Array
    amplitude: Array
    amplitude_sd: Array
    omega: Array
    omega_sd: Array
    phase: Array
    phase_sd: Array
    at_cut: float
    """Phase at the last sample of the part that was fitted."""


def predict(
    recording: Recording,
    *,
    cycles: float,
    candidates: Iterable[str] = NAMES,
    laws: Sequence[str] = LAWS,
    kind: str = "bic",
    method: str = METHOD,
    span: tuple[float, float] | None = None,
    progress: Progress = lambda _, __: None,
) -> Prediction:
    """Fit the first ``cycles`` cycles and predict amplitude, frequency and phase of the rest.

    The whole recording's track counts the cycles and is what the prediction is held against; the fit sees none of it.
    Raises InputError as ``identify`` does, and when too few cycles are left on either side.

    >>> t = np.arange(600) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=600)
    >>> decay = Recording(t, np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, 4.0, "u", "", "decay.csv", "")
    >>> ahead = predict(decay, cycles=10, candidates=("linear",), laws=("linear",))
    >>> ahead.candidate, ahead.errors["amplitude"] < 0.05, ahead.errors["phase"] < 0.1
    ('linear', True, True)
    """
    names, laws = checked(candidates, laws, kind)
    used, _ = usable(recording, span)
    start = float(used.time[0])
    whole = estimate(used.values, used.rate, method=method, start=start, bias=False)
    offset = float(used.values.mean())
    phase, _ = demodulated(used.values - offset, used.rate, whole, start)
    cut = cut_after(phase, cycles, used)
    first = part_of(used, used.time[:cut], used.values[:cut], used.rate)
    track = estimate(first.values, first.rate, method=method, start=start, bias=False)
    data = prepare(first, track)
    ranked = rank(data, names, laws, kind, progress)
    rest = measured_rest(used, whole, phase, first.time[-1] - start)
    return held_against(data, ranked, rest, cycles, start)


def cut_after(phase: Array, cycles: float, recording: Recording) -> int:
    """Number of samples in the first cycles; InputError when too few cycles are on either side of the cut."""
    total = (phase[-1] - phase[0]) / (2 * np.pi)
    if not FEWEST_CYCLES <= cycles <= total - FEWEST_CYCLES:
        raise InputError(
            f"{recording.source}: predicting from {cycles:g} of {total:.1f} cycles; use {FEWEST_CYCLES} to "
            f"{total - FEWEST_CYCLES:.0f}, so that there are {FEWEST_CYCLES} to fit and {FEWEST_CYCLES} to predict"
        )
    return int(np.searchsorted(phase - phase[0], 2 * np.pi * cycles)) + 1


def measured_rest(recording: Recording, track: Track, phase: Array, until: float) -> Rest:
    """Amplitude, frequency and phase where the window of the measurement lies after the cut."""
    start = float(recording.time[0])
    found = backbone(track, recording.values, recording.rate, start=start)
    window = found.settings["window_seconds"]
    margin = 0.5 * float(window) if isinstance(window, (int, float)) else 0.0
    later = found.time - start >= until + margin
    if np.count_nonzero(later) < 4:
        raise InputError(f"{recording.source}: nothing clear of noise is left to predict; fit fewer cycles")
    time = found.time[later] - start
    at = np.clip(np.rint(time * recording.rate).astype(int), 0, phase.size - 1)
    amplitude, sd = found.amplitude[later], found.amplitude_sd[later]
    cut = float(phase[round(until * recording.rate)])
    return Rest(time, amplitude, sd, found.omega[later], found.omega_sd[later], phase[at], sd / amplitude, cut)


def held_against(data: Data, ranked: Ranked, rest: Rest, cycles: float, start: float) -> Prediction:
    """The mean of the candidates, its band, and how much of what was measured lies inside."""
    best = ranked.fits[0]
    kept = [(f, w) for f, w in zip(ranked.fits, ranked.weights, strict=True) if w >= LEAST_WEIGHT]
    weights = np.array([w for _, w in kept]) / sum(w for _, w in kept)
    parts = [ahead(f, data, rest.time) for f, _ in kept]
    values, deviations = (np.array([p[i] for p in parts]) for i in (0, 1))
    mean = np.tensordot(weights, values, 1)
    sd = np.sqrt(np.tensordot(weights, deviations**2 + (values - mean) ** 2, 1))
    a, omega, phase = np.split(mean, 3)
    a_sd, omega_sd, phase_sd = np.split(sd, 3)
    # the two phases count whole turns from different starts, and agree at the end of what was fitted
    apart = rest.at_cut - float(best.model.motion(best.theta, data.time).phase[-1])
    late = rest.phase - phase - 2 * np.pi * np.round(apart / (2 * np.pi))
    inside = {
        "amplitude": covered(rest.amplitude - a, np.hypot(a_sd, rest.amplitude_sd)),
        "omega": covered(rest.omega - omega, np.hypot(omega_sd, rest.omega_sd)),
        "phase": covered(late, np.hypot(phase_sd, rest.phase_sd)),
    }
    errors = {
        "amplitude": rms(rest.amplitude / a - 1),
        "omega": rms(rest.omega / omega - 1),
        "phase": rms(late),
    }
    return Prediction(
        candidate=best.model.name,
        cycles=cycles,
        until=start + float(data.time[-1]),
        time=start + rest.time,
        amplitude=a,
        amplitude_low=a - NORMAL_95 * a_sd,
        amplitude_high=a + NORMAL_95 * a_sd,
        measured_amplitude=rest.amplitude,
        omega=omega,
        omega_low=omega - NORMAL_95 * omega_sd,
        omega_high=omega + NORMAL_95 * omega_sd,
        measured_omega=rest.omega,
        phase_error=late,
        phase_band=NORMAL_95 * phase_sd,
        coverage=inside,
        errors=errors,
        note="Mean of " + ", ".join(f"{f.model.name} ({w:.0%})" for (f, _), w in zip(kept, weights, strict=True)),
    )


def ahead(fit: Fit, data: Data, time: Array) -> tuple[Array, Array]:
    """Amplitude, frequency and phase of one candidate at later times, end to end, with their deviations."""
    model, length = fit.model, data.length

    def values(theta: Array) -> Array:
        at = model.motion(theta, time)
        return np.concatenate((length * at.amplitude, at.omega, at.phase))

    return values(fit.theta), spread_along(values, fit, data, covariance(fit))


def covered(error: Array, deviation: Array) -> float:
    """Share of errors within the 95 % interval of their deviations.

    >>> covered(np.array([0.0, 1.9, 2.1]), np.ones(3))
    0.6666666666666666
    """
    return float(np.mean(np.abs(error) <= NORMAL_95 * deviation))


def rms(values: Array) -> float:
    """Root mean square.

    >>> rms(np.array([3.0, -3.0]))
    3.0
    """
    return float(np.sqrt(np.mean(values**2)))
