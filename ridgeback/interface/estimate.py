"""``ridgeback.estimate``, ``half_cycles``, ``backbone`` and ``model_fit``: what a signal says of its oscillation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.binding.family import family_of
from ridgeback.compare.recording.measurement import as_tracked, marked, samples_behind
from ridgeback.interface.signals import SignalLike, as_recording
from ridgeback.interface.unused import refuse_unused
from ridgeback.numeric.backbone import backbone as along
from ridgeback.numeric.backbone import half_cycles as cycles
from ridgeback.numeric.backbone.curve import Backbone
from ridgeback.numeric.backbone.half_cycles import HalfCycles
from ridgeback.numeric.estimators import estimate as estimators
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.model_fit import fit
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.fit import ModelFit
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value

ESTIMATORS = (*estimators.METHODS, estimators.MODEL_FIT)
"""Every method of ``estimate``."""


def estimate(
    x: SignalLike,
    rate: float | None = None,
    *,
    time: Any = None,
    column: str | int | None = None,
    method: str = "auto",
    band: tuple[float, float] | None = None,
    lag_seconds: float | None = None,
    lag_window: str = "blackman",
    smoothing_seconds: float | None = None,
    harmonics: int | None = None,
    harmonic: int = 1,
    order: int = 6,
    scope: str | None = None,
    band_limited: bool = False,
    single: bool = False,
    bias: bool = True,
    remove_bias: bool = False,
    components: int | None = None,
    oscillator: OscillatorLike | None = None,
    free: Sequence[str] | None = None,
    parameters: Mapping[str, Value] | None = None,
    fill: float | None = None,
    resample: float | None = None,
    detrend: str = "none",
    span: tuple[float, float] | None = None,
    progress: Wanted = None,
) -> Track:
    """Estimate the fundamental frequency omega0(t) of a signal.

    Parameters
    ----------
    x : array_like, masked array, Series, DataFrame, DataArray, Recording, str or path
        The samples, or the file that holds them.  Missing samples cut the signal; the longest stretch is taken, and a
        warning says so.
    rate : float, optional
        Samples per time unit.
    time : array_like, optional
        The time of each sample, in place of a rate.
    column : str or int, optional
        The signal of a table or a file with several.
    method : str
        ``"auto"`` (which says what it took, and why), ``"wigner"``, ``"pseudo-wigner"``, ``"smoothed-pseudo-wigner"``,
        ``"polynomial-wigner"``, ``"spectrogram"``, ``"reassigned-spectrogram"``, ``"synchrosqueezed"``, ``"hilbert"``,
        ``"zero-crossing"``, ``"harmonic-least-squares"`` or ``"model-fit"``.
    band : (float, float), optional
        Search band in rad per time unit; by default found from the data.
    lag_seconds : float, optional
        Stretch of signal under the window of the windowed methods (four cycles by default).
    lag_window : {"blackman", "gaussian", "hamming", "hann", "rectangular"}
        The window.
    smoothing_seconds : float, optional
        Time smoothing of the smoothed pseudo-Wigner distribution (one cycle by default).
    harmonics : int, optional
        Highest multiple that harmonic least squares fits (by default those that the data show).
    harmonic : int
        Which harmonic is tracked, phase-locked to the fundamental.
    order : {4, 6}
        Order of the polynomial Wigner distribution.
    scope : {"global", "local"}, optional
        Of harmonic least squares: splines over the whole record, or a sliding window.
    band_limited, single : bool
        Limit the signal to the band first; compute in single precision (the Wigner methods only).
    bias : bool
        Whether the bias, and with it the 95 % interval, is estimated.
    remove_bias : bool
        Whether the bias is taken off the values.
    components : int, optional
        Oscillations to tell apart: one in the band, and tones beside it, steady or damped, which are taken off (see
        ``track.used.tones``); by default those that the samples show.
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr, optional
        What ``"model-fit"`` fits, in any of the forms that :func:`ridgeback.oscillator` takes.
    free : sequence of str, optional
        Parameters that ``"model-fit"`` finds; by default all that ``parameters`` gives no value.
    parameters : mapping, optional
        Values of its other parameters.
    fill, resample : float, optional
        Longest gap to interpolate across, with samples that enter no fit; rate to interpolate uneven times to.
    detrend : {"none", "linear", "slow"}
        What is taken off the samples.
    span : (float, float), optional
        First and last time to use, such as the free decay after a release.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Track
        ``time``, ``omega`` (rad per time unit), its standard deviation, bias and 95 % interval, and where it is valid.

    Raises
    ------
    InputError
        For an unknown method, samples that are no signal, a record too short for the window, and a band beyond the
        Nyquist frequency.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> track = estimate(np.cos(2 * np.pi * (t + 0.01 * t**2)), time=t, method="pseudo_wigner")
    >>> inside = track.inside()
    >>> bool(np.abs(inside.frequency_hz - 1.0 - 0.02 * inside.time).max() < 1e-3)
    True
    """
    name = chosen(method, ESTIMATORS, "method")
    used = as_recording(x, rate, time=time, column=column, fill=fill, resample=resample, detrend=detrend, span=span)
    return estimation_of(
        used,
        name,
        progress,
        band=band,
        lag_seconds=lag_seconds,
        lag_window=lag_window,
        smoothing_seconds=smoothing_seconds,
        harmonics=harmonics,
        harmonic=harmonic,
        order=order,
        scope=scope,
        band_limited=band_limited,
        single=single,
        bias=bias,
        remove_bias=remove_bias,
        components=components,
        oscillator=oscillator,
        free=free,
        parameters=parameters,
    ).track


def estimation_of(
    recording: Recording,
    method: str,
    progress: Wanted,
    *,
    oscillator: OscillatorLike | None = None,
    free: Sequence[str] | None = None,
    parameters: Mapping[str, Value] | None = None,
    **settings: Any,
) -> estimators.Estimation:
    """The track of a recording with what led to it, in the words of :func:`estimate`."""
    family = fitted_family(method, oscillator, free, parameters)
    with showing(progress) as told:
        return estimators.estimation(
            recording.values,
            recording.rate,
            method=method,
            start=float(recording.time[0]),
            wrong=marked(recording),
            family=family,
            progress=told,
            **settings,
        )


def fitted_family(
    method: str,
    oscillator: OscillatorLike | None,
    free: Sequence[str] | None,
    parameters: Mapping[str, Value] | None,
) -> Family | None:
    """What a fit of a model needs; None for the methods that have no model."""
    if method != estimators.MODEL_FIT:
        if oscillator is not None or free is not None or parameters is not None:
            raise InputError(f"oscillator, free and parameters belong to method 'model-fit', not to {method!r}")
        return None
    if oscillator is None:
        raise InputError("method 'model-fit' fits an oscillator; name it by oscillator=")
    return family_to_fit(oscillator, free, parameters)


def family_to_fit(
    oscillator: OscillatorLike, free: Sequence[str] | None, parameters: Mapping[str, Value] | None
) -> Family:
    """The oscillator with its free parameters: those named, else all that are given no value."""
    system = as_oscillator(oscillator, parameters=parameters)
    fixed = parameters or {}
    return family_of(system, tuple(free) if free is not None else tuple(n for n in system.parameters if n not in fixed))


def model_fit(
    x: SignalLike,
    rate: float | None = None,
    *,
    oscillator: OscillatorLike,
    time: Any = None,
    column: str | int | None = None,
    free: Sequence[str] | None = None,
    parameters: Mapping[str, Value] | None = None,
    free_offset: bool = True,
    band: tuple[float, float] | None = None,
    progress: Wanted = None,
) -> ModelFit:
    """Fit an oscillator's own solutions to a signal: parameters with their covariance, and a test of the residual.

    Parameters
    ----------
    x, rate, time, column
        The signal, as for :func:`estimate`.
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        What is fitted, in any of the forms that :func:`ridgeback.oscillator` takes.
    free : sequence of str, optional
        Parameters to be found, starting at their values; by default all that ``parameters`` gives no value.
    parameters : mapping, optional
        Values of the others.
    free_offset : bool
        Whether the samples may read something else than 0 at rest.
    band : (float, float), optional
        Where the oscillation is looked for, rad per time unit.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    ModelFit
        Parameters, initial state, offset, their deviations, the residual and whether it is white.

    Raises
    ------
    InputError
        Where no oscillation is found, the samples do not determine the parameters, or no fit locks on to the signal.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(400) / 20.0
    >>> fitted = model_fit(np.cos(7.0 * t), 20.0, oscillator="linear", free=["k"])
    >>> round(fitted.parameters["k"], 6)
    7.0
    """
    used = as_recording(x, rate, time=time, column=column)
    chosen_family = family_to_fit(oscillator, free, parameters)
    begin = float(used.time[0])
    with showing(progress) as told:
        return fit.model_fit(
            used.values, used.rate, chosen_family, start=begin, free_offset=free_offset, band=band, progress=told
        )


def half_cycles(
    x: SignalLike,
    rate: float | None = None,
    *,
    time: Any = None,
    column: str | int | None = None,
    band: tuple[float, float] | None = None,
    progress: Wanted = None,
) -> HalfCycles:
    """Frequency, peak amplitude and growth rate of each half cycle, from zero crossings and turning points alone.

    Parameters
    ----------
    x, rate, time, column
        The signal, as for :func:`estimate`.
    band : (float, float), optional
        Search band in rad per time unit.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    HalfCycles
        One value per half cycle, with standard deviations.

    Raises
    ------
    InputError
        With fewer than four crossings.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> found = half_cycles(np.exp(-0.05 * t) * np.cos(7.0 * t), 32.0)
    >>> bool(abs(found.growth_rate[5] + 0.05) < 1e-3)
    True
    """
    used = as_recording(x, rate, time=time, column=column)
    begin = float(used.time[0])
    with showing(progress) as told:
        found = cycles.half_cycles(used.values, used.rate, start=begin, band=band, exclude=used.unsound, progress=told)
    return replace(found, units=used.units)


def backbone(
    x: SignalLike,
    rate: float | None = None,
    *,
    time: Any = None,
    column: str | int | None = None,
    track: Track | None = None,
    method: str = "auto",
    window_seconds: float | None = None,
    progress: Wanted = None,
    **settings: Any,
) -> Backbone:
    """Measure the backbone curve of a decay: frequency and growth rate against amplitude.

    Parameters
    ----------
    x, rate, time, column
        The signal, as for :func:`estimate`.
    track : Track, optional
        Its frequency track where there is one; by default :func:`estimate` makes it.
    method : str
        The estimator of the track, or ``"half-cycles"`` for zero crossings and turning points (peak amplitude).
    window_seconds : float, optional
        Window of the amplitude's harmonic least squares (four cycles by default).
    progress : bool or callable, optional
        As for :func:`estimate`.
    **settings
        Further settings of :func:`estimate`.

    Returns
    -------
    Backbone
        omega and a'/a in bins of amplitude with standard deviations, and along time.

    Raises
    ------
    InputError
        When fewer than four points are clear of the noise, for settings that would go unused, and as :func:`estimate`
        does.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(1280) / 32.0
    >>> curve = backbone(2.0 * np.exp(-0.05 * t) * np.cos(2.5 * np.pi * t), 32.0)
    >>> bool(np.abs(curve.curve_growth_rate + 0.05).max() < 1e-4)
    True
    """
    name = chosen(method, (*ESTIMATORS, "half-cycles"), "method")
    used = as_recording(x, rate, time=time, column=column)
    if track is not None:
        refuse_unused("a backbone along a track", method=None if name == "auto" else method, **settings)
    if name == "half-cycles":
        refuse_unused("method 'half-cycles'", window_seconds=window_seconds)
        return replace(half_cycles(used, progress=progress, **settings).backbone(), units=used.units)
    if track is None:
        found = estimation_of(used, name, progress, **settings)
        curve = measured_along(found.track, as_tracked(used, found.samples), window_seconds, found.claimed_models)
    else:
        curve = measured_along(track, as_tracked(used, samples_behind(track, used)), window_seconds, None)
    return replace(curve, units=used.units)


def measured_along(
    track: Track, used: Recording, window_seconds: float | None, models: SignalModels | None
) -> Backbone:
    """The backbone along a track; samples near clipped ones are left out."""
    return along.backbone(
        track,
        used.values,
        used.rate,
        start=float(used.time[0]),
        window_seconds=window_seconds,
        exclude=marked(used),
        models=models,
    )
