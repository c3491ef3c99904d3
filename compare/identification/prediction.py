"""The rest of a decay predicted from its first cycles, and held against what was then measured.

Candidates are fitted to the first part alone.  The prediction is their mean by Akaike weights, and its variance is that
of the parameters and of the candidates' disagreement: sum of w (sigma^2 + (value - mean)^2).  Where no candidate is
quite right this is too narrow.  So the same candidates, fitted to the first three fifths of that part, predict its last
two fifths, and each band is widened by the ratio of what they missed to what they expected to miss, if above 1; that of
the phase, which is the integral of the frequency, at least as that of the frequency.  What only shows at amplitudes
that the fitted part never reached, no such rehearsal can show.  A candidate whose own deviation is not known is left
out of the mean: the part that was fitted does not ask for it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.identification.candidates import LAWS, NAMES
from ridgeback.compare.identification.fits import Ranked, rank
from ridgeback.compare.identification.fitting import DEMODULATED, Data, Fit, demodulated, fit, prepare, refit
from ridgeback.compare.identification.identify import FEWEST_CYCLES, checked
from ridgeback.compare.identification.preparation import Prepared, local_track, part_of, prepared
from ridgeback.compare.identification.ranking import covariance, spread_along
from ridgeback.compare.identification.results import Prediction
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.backbone.model_rates import PHASE, ModelRates
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import NORMAL_95, Track

LEAST_WEIGHT = 0.01
"""Candidates of less weight are left out of the mean."""
REHEARSAL = 0.6
"""Share of the fitted part from which the rest of it is predicted, to see how wide the bands must be."""
NAMED = ("amplitude", "omega", "phase")


@dataclass(frozen=True)
class Rest:
    """What was measured after the part that was fitted: times from the first sample, and deviations.

    The phase is not a number where only a window that reaches beyond the record would tell it.
    """

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
    recording: Recording | Prepared,
    *,
    cycles: float,
    candidates: Iterable[str] = NAMES,
    laws: Sequence[str] = LAWS,
    kind: str = "bic",
    span: tuple[float, float] | None = None,
    band: tuple[float, float] | None = None,
    progress: Progress = silent,
) -> Prediction:
    """Fit the first cycles of a decay and predict amplitude, frequency and phase of the rest.

    The whole recording's track counts the cycles and is what the prediction is held against; the fit sees none of it.

    Parameters
    ----------
    recording
        One signal, evenly sampled; or what :func:`prepared` made of it, to share that with :func:`identify`.
    cycles
        How many of the first cycles are fitted.
    candidates, laws, kind, span, band
        As for :func:`identify`.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Prediction
        Means and 95 % bands over time, what was then measured, and how much of it lies inside.

    Raises
    ------
    InputError
        As :func:`identify` does, and when fewer than six cycles are left on either side.

    Examples
    --------
    >>> t = np.arange(600) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=600)
    >>> decay = Recording(t, np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, 4.0, "u", "", "decay.csv", "")
    >>> ahead = predict(decay, cycles=10, candidates=("linear",), laws=("linear",))
    >>> ahead.candidate, ahead.errors["amplitude"] < 0.05, ahead.errors["phase"] < 0.1
    ('linear', True, True)
    """
    names, allowed = checked(candidates, laws, kind)
    ready = prepared(recording, span=span, band=band) if isinstance(recording, Recording) else recording
    used, whole = ready.recording, ready.track
    start = float(used.time[0])
    offset = float(used.values.mean())
    phase, _ = demodulated(used.values - offset, used.rate, whole, start)
    cut = cut_after(phase, cycles, used)
    first = part_of(used, slice(cut))
    track = local_track(first)
    data = prepare(first, track, kept=ready.kept[:cut])
    ranked = rank(data, names, allowed, kind, progress)
    rest = measured_rest(used, whole, phase, first.time[-1] - start, ready.models)
    progress(0.95, "prediction")
    kept = Weighted.of(ranked)
    widening = rehearsed(first, track, kept)
    return held_against(data, kept, rest, widening, cycles=cycles, start=start)


def cut_after(phase: Array, cycles: float, recording: Recording) -> int:
    """Number of samples in the first cycles; InputError when too few cycles are on either side of the cut."""
    total = (phase[-1] - phase[0]) / (2 * np.pi)
    if not FEWEST_CYCLES <= cycles <= total - FEWEST_CYCLES:
        raise InputError(
            f"{recording.source}: predicting from {cycles:g} of {total:.1f} cycles; use {FEWEST_CYCLES} to "
            f"{total - FEWEST_CYCLES:.0f}, so that there are {FEWEST_CYCLES} to fit and {FEWEST_CYCLES} to predict"
        )
    return int(np.searchsorted(phase - phase[0], 2 * np.pi * cycles)) + 1


def measured_rest(
    recording: Recording, track: Track, phase: Array, until: float, models: SignalModels | None = None
) -> Rest:
    """Amplitude, frequency and phase after the cut: by ``models`` of the samples if there are any, else in windows."""
    start = float(recording.time[0])
    found = backbone(track, recording.values, recording.rate, start=start, models=models)
    margin = 0.5 * (found.window_seconds or 0.0)
    later = found.time - start >= until + margin
    if np.count_nonzero(later) < 4:
        raise InputError(f"{recording.source}: nothing clear of noise is left to predict; fit fewer cycles")
    time = found.time[later] - start
    at = np.clip(np.rint(time * recording.rate).astype(np.intp), 0, phase.size - 1)
    amplitude, sd = found.amplitude[later], found.amplitude_sd[later]
    phase_sd = sd / amplitude
    if models is not None and models.fine is not models.coarse:
        phase, phase_sd = models.fine.phase, ModelRates(models, at).at_points(PHASE, slopes=False)
        told = np.ones_like(time, dtype=np.bool_)
    else:
        half = 0.5 * DEMODULATED * 2 * np.pi / float(np.median(found.omega))
        told = time <= float(recording.time[-1]) - start - half
    cut = float(phase[round(until * recording.rate)])
    own = np.where(told, phase[at], np.nan)
    return Rest(time, amplitude, sd, found.omega[later], found.omega_sd[later], own, phase_sd, cut)


@dataclass(frozen=True)
class Weighted:
    """Fits with their weights, the best first; the weights sum to 1."""

    fits: tuple[Fit, ...]
    weights: Array

    @staticmethod
    def of(ranked: Ranked) -> Weighted:
        """Those candidates of a ranking that have weight."""
        kept = [(f, w) for f, w in zip(ranked.fits, ranked.weights, strict=True) if w >= LEAST_WEIGHT]
        weights = np.array([w for _, w in kept])
        return Weighted(tuple(f for f, _ in kept), weights / weights.sum())

    def ahead(self, data: Data, time: Array) -> tuple[Array, Array]:
        """Mean and deviation of amplitude, frequency and phase, ``[3, time]``."""
        parts = [ahead(f, data, time) for f in self.fits]
        values, deviations = (np.array([p[i] for p in parts]) for i in (0, 1))
        known = np.isfinite(deviations).all(axis=1)
        weights = self.weights * known if known.any() else self.weights
        values, deviations, weights = values[weights > 0], deviations[weights > 0], weights[weights > 0]
        weights = weights / weights.sum()
        mean = np.tensordot(weights, values, 1)
        variance = np.tensordot(weights, deviations**2 + (values - mean) ** 2, 1)
        return mean.reshape(3, -1), np.sqrt(variance).reshape(3, -1)


def missed(kept: Weighted, data: Data, rest: Rest, mean: Array) -> Array:
    """Measured less predicted, ``[3, time]``: amplitude, frequency, phase."""
    # the two phases count whole turns from different starts, and agree at the end of what was fitted
    best = kept.fits[0]
    apart = rest.at_cut - float(best.model.motion(best.theta, data.time).phase[-1])
    turns = 2 * np.pi * np.round(apart / (2 * np.pi))
    return np.array([rest.amplitude, rest.omega, rest.phase - turns]) - mean


def expected(rest: Rest, deviation: Array) -> Array:
    """Deviation of measured less predicted: that of both."""
    return np.asarray(np.hypot(deviation, np.array([rest.amplitude_sd, rest.omega_sd, rest.phase_sd])))


def rehearsed(first: Recording, track: Track, kept: Weighted) -> Array:
    """How many times what was expected the same candidates miss the end of the fitted part; 1 where it is too short."""
    start = float(first.time[0])
    phase, _ = demodulated(first.values - float(first.values.mean()), first.rate, track, start)
    cut = int(np.searchsorted(phase - phase[0], REHEARSAL * (phase[-1] - phase[0]))) + 1
    try:
        early = part_of(first, slice(cut))
        data = prepare(early, local_track(early), kept=~early.unsound)
        rest = measured_rest(first, track, phase, float(early.time[-1]) - start)
        again = Weighted(tuple(refit(f.model, data, fit(f.model, data).theta) for f in kept.fits), kept.weights)
        mean, deviation = again.ahead(data, rest.time)
    except InputError:
        return np.ones(3)
    ratio = missed(again, data, rest, mean) / expected(rest, deviation)
    of_amplitude, of_omega, of_phase = (rms_known(row) for row in ratio)
    return np.array([max(1.0, of_amplitude), max(1.0, of_omega), max(1.0, of_omega, of_phase)])


def rms_known(values: Array) -> float:
    """Root mean square of those that are known; 0 where none is.

    >>> rms_known(np.array([3.0, np.nan, 4.0])) == 12.5**0.5, rms_known(np.array([np.nan]))
    (True, 0.0)
    """
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else 0.0


def held_against(data: Data, kept: Weighted, rest: Rest, widening: Array, *, cycles: float, start: float) -> Prediction:
    """The mean of the candidates, its widened band, and how much of what was measured lies inside."""
    mean, deviation = kept.ahead(data, rest.time)
    deviation = deviation * widening[:, None]
    error = missed(kept, data, rest, mean)
    ratio = error / expected(rest, deviation)
    inside = {name: np.abs(row[np.isfinite(row)]) <= NORMAL_95 for name, row in zip(NAMED, ratio, strict=True)}
    scale = np.array([mean[0], mean[1], np.ones_like(mean[2])])
    sizes = [rms_known(row) for row in error / scale]
    (a, omega, _), (a_half, omega_half, phase_half) = mean, NORMAL_95 * deviation
    shares = ", ".join(f"{f.model.name} ({w:.0%})" for f, w in zip(kept.fits, kept.weights, strict=True))
    wider = ", ".join(f"{name} {w:.1f}" for name, w in zip(NAMED, widening.tolist(), strict=True))
    return Prediction(
        candidate=kept.fits[0].model.name,
        cycles=cycles,
        until=start + float(data.time[-1]),
        time=start + rest.time,
        amplitude=a,
        amplitude_low=a - a_half,
        amplitude_high=a + a_half,
        measured_amplitude=rest.amplitude,
        measured_amplitude_sd=rest.amplitude_sd,
        omega=omega,
        omega_low=omega - omega_half,
        omega_high=omega + omega_half,
        measured_omega=rest.omega,
        measured_omega_sd=rest.omega_sd,
        phase_error=error[2],
        phase_band=phase_half,
        measured_phase_sd=rest.phase_sd,
        coverage={name: float(row.mean()) for name, row in inside.items() if row.size},
        errors=dict(zip(NAMED, sizes, strict=True)),
        note=f"Mean of {shares}; bands widened, by a rehearsal within the fitted part, by factors of {wider}",
    )


def ahead(found: Fit, data: Data, time: Array) -> tuple[Array, Array]:
    """Amplitude, frequency and phase of one candidate at later times, end to end, with their deviations."""
    model, length = found.model, data.length

    def values(theta: Array) -> Array:
        at = model.motion(theta, time)
        return np.concatenate((length * at.amplitude, at.omega, at.phase))

    return values(found.theta), spread_along(values, found, data, covariance(found))
