"""One function for every estimator of the fundamental frequency: ``estimate(x, rate, method=...)`` gives a Track."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Mask
from ridgeback.numeric.components.tones import total
from ridgeback.numeric.estimators.auto import for_auto, for_least_squares
from ridgeback.numeric.estimators.global_harmonics import by_harmonic_splines, with_spline_interval
from ridgeback.numeric.estimators.higher_harmonics import harmonic_with_interval, locked_track
from ridgeback.numeric.estimators.memory import check_memory, without_room
from ridgeback.numeric.estimators.peak import by_pseudo_wigner, by_smoothed_pseudo_wigner, by_spectrogram, by_wigner
from ridgeback.numeric.estimators.phase import by_harmonic_least_squares, by_hilbert, by_zero_crossing
from ridgeback.numeric.estimators.polynomial_peak import by_polynomial_wigner
from ridgeback.numeric.estimators.reassigned_ridge import by_reassigned_spectrogram, by_synchrosqueezing
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.fit import fitted
from ridgeback.numeric.model_fit.track import model_track
from ridgeback.numeric.signal.decimation import LONG, PER_CYCLE, Samples, checked, decimated
from ridgeback.numeric.signal.presence import presence
from ridgeback.numeric.signal.search_band import SearchBand
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.in_band import in_its_band
from ridgeback.numeric.tracking.own_stretch import after_its_start, doubting_steps, has_model, in_its_stretch
from ridgeback.numeric.tracking.request import (
    FEWEST_SAMPLES,
    Options,
    Request,
    beyond_band,
    prepared,
    refuse_cross_term,
)
from ridgeback.numeric.tracking.settings import refuse_unused
from ridgeback.numeric.tracking.strongest import of_most_energy
from ridgeback.numeric.tracking.track import NORMAL_95, Track
from ridgeback.numeric.tracking.uncertainty import trial_of, with_interval


@dataclass(frozen=True)
class Estimation:
    """A track, the samples that it is of, and the request that led to it, which an oscillator's fit does without."""

    track: Track
    samples: Samples
    request: Request | None

    @property
    def modelled(self) -> bool:
        """Whether a model of all of the track's stretch settled."""
        return self.request is not None and has_model(self.request)

    @property
    def claimed_models(self) -> SignalModels | None:
        """The models of the track's stretch, where it claims an interval that rests on them."""
        claimed = self.request is not None and self.track.interval is not None and has_model(self.request)
        return self.request.models if claimed and self.request is not None else None


def without_bias(track: Track, remove_bias: bool) -> Track:
    """The track with its bias taken off, where that is wanted and it is known."""
    if track.bias is None or not remove_bias:
        return track
    return replace(track, omega=track.omega - track.bias, bias_removed=True)


def by_least_squares(request: Request) -> Track:
    """Harmonic least squares, local or global."""
    return by_harmonic_splines(request) if request.plan.scope is Scope.GLOBAL else by_harmonic_least_squares(request)


def with_bias(track: Track, estimator: Callable[[Request], Track], request: Request) -> Track:
    """The track with its bias and its interval, or with the reason why it has none."""
    if not request.options.bias:
        return track
    if request.signal.doubt:
        return replace(track, no_interval=request.signal.doubt)
    if request.plan.scope is Scope.GLOBAL:
        return with_spline_interval(track, request)
    try:
        fixed = replace(request, known_models=request.models)
    except InputError as error:
        return replace(track, no_interval=str(error))
    return with_interval(track, fixed, trial_of(estimator, fixed, track), fixed.models)


ESTIMATORS: Mapping[str, Callable[[Request], Track]] = MappingProxyType(
    {
        "wigner": by_wigner,
        "pseudo-wigner": by_pseudo_wigner,
        "smoothed-pseudo-wigner": by_smoothed_pseudo_wigner,
        "polynomial-wigner": by_polynomial_wigner,
        "spectrogram": by_spectrogram,
        "reassigned-spectrogram": by_reassigned_spectrogram,
        "synchrosqueezed": by_synchrosqueezing,
        "hilbert": by_hilbert,
        "zero-crossing": by_zero_crossing,
        "harmonic-least-squares": by_least_squares,
    }
)
METHODS = ("auto", *ESTIMATORS)
MODEL_FIT = "model-fit"
"""The method that needs an oscillator beside the signal."""
FAR = 0.03
"""Bias, relative to omega, beyond which a value outside its own interval is that of something else: a cross term."""
HARDLY_KNOWN = 0.1
"""Half width of a 95 % interval, relative to omega, beyond which a value is not counted as valid."""
MORE_PER_CYCLE, VERY_LONG = 12.0, 65_536
"""Samples a cycle that methods other than auto keep of a record of more samples than that."""
OF_A_MODE = 0.6
"""Of the samples a cycle that as many harmonics need, those that are kept for components of which there are so many."""
QUADRATIC = ("wigner", "pseudo-wigner", "smoothed-pseudo-wigner", "polynomial-wigner")
"""Methods whose distribution has cross terms on the harmonics."""


def estimate(
    x: ArrayLike,
    rate: float,
    *,
    method: str = "auto",
    band: tuple[float, float] | None = None,
    start: float = 0.0,
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
    wrong: Mask | None = None,
    family: Family | None = None,
    progress: Progress = silent,
) -> Track:
    """Estimate the frequency omega0(t) of a signal's fundamental.

    Parameters
    ----------
    x : array of float, shape (N,)
        Real samples, evenly spaced.  Their mean is taken off.
    rate : float
        Samples per time unit.
    method : str
        One of METHODS, or ``"model-fit"``.  ``"auto"`` takes the method and the window that should have the least error
        on a model of the signal, says why in ``used.why``, and decimates records of more than 16,384 samples first,
        where the rate allows; the others do so with records of more than 65,536.
    band : (float, float), optional
        Lowest and highest frequency looked at, rad per time unit; by default a band around the strongest component is
        found from the data.  A Wigner peak is refused in a band around a harmonic of a stronger component: a cross term
        falls on it.
    start : float
        Time of the first sample.
    lag_seconds : float, optional
        Stretch of signal under the window of the windowed methods, in time units; four cycles by default.
    lag_window : str
        Its name, one of ``signal.windows.WINDOWS``.
    smoothing_seconds : float, optional
        Full width of the smoothing along time of the smoothed pseudo-Wigner distribution; one cycle by default.
    harmonics : int, optional
        The highest multiple that harmonic least squares fits; by default those that the data show.
    harmonic : int
        Above 1: the track of that harmonic, phase-locked to the fundamental that ``method`` finds.
    order : int
        Number of factors of the polynomial Wigner distribution, 4 or 6.
    scope : str, optional
        Of harmonic least squares: ``"global"``, splines over the whole record (the default without ``lag_seconds``), or
        ``"local"``, a polynomial in a sliding window, whose length and degree have the least expected error.
    band_limited : bool
        Limit the signal to the band before a Wigner, pseudo- or smoothed pseudo-Wigner distribution, and decimate its
        lags: faster, free of cross terms with what lies outside, and less exact near the ends, where the filter rings
        (not counted as valid).
    single : bool
        Compute these three in complex64: an error near 1e-8 of omega for a clean signal.
    bias : bool
        Whether the bias is estimated, and with it the 95 % interval.
    remove_bias : bool
        Whether it is taken off the values.
    components : int, optional
        Oscillations to tell apart, the strongest in the band and tones beside it, steady or damped; 1 looks for no
        others.  By default those that the samples show; all but the one that is tracked are taken off, and
        ``used.tones`` says what they are.
    wrong : array of bool, shape (N,), optional
        Samples that are known to be no part of the motion, such as clipped ones: they enter no model of the signal.
    family : Family, optional
        The oscillator that ``method="model-fit"`` fits to the samples; of the other options only ``band`` counts then.
    progress : callable, optional
        Told the share of the work that is done, and what comes next.

    Returns
    -------
    Track
        ``omega`` at every sample (every half cycle for ``"zero-crossing"``), rad per time unit, with its deviation and
        bias. Its interval holds the noise, what is not known of the bias, and near a separatrix what the definition of
        omega0(t) leaves open (``ambiguous``); it supposes white noise and one smooth oscillation with its harmonics.
        Where no model of the signal settles there is none, and ``no_interval`` says why. ``presence.probability`` is
        that of noise alone, white or with a power law for its spectrum, showing as clear a peak; above 1 in 1000 no
        sample is valid.

    Raises
    ------
    InputError
        For an unknown method, settings that it has no use for, samples that are not finite, a constant signal, a record
        too short for the window, or a band beyond the Nyquist frequency.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> track = estimate(np.cos(2 * np.pi * (1.0 * t + 0.01 * t**2)), 32.0, method="pseudo-wigner")
    >>> inside = track.inside()
    >>> bool(np.abs(inside.frequency_hz - 1.0 - 0.02 * inside.time).max() < 1e-3)
    True
    """
    return estimation(
        x,
        rate,
        method=method,
        start=start,
        harmonic=harmonic,
        remove_bias=remove_bias,
        family=family,
        scope=scope,
        bias=bias,
        band=band,
        lag_seconds=lag_seconds,
        lag_window=lag_window,
        smoothing_seconds=smoothing_seconds,
        harmonics=harmonics,
        order=order,
        band_limited=band_limited,
        single=single,
        components=components,
        wrong=wrong,
        progress=progress,
    ).track


def estimation(
    x: ArrayLike,
    rate: float,
    *,
    method: str = "auto",
    start: float = 0.0,
    harmonic: int = 1,
    remove_bias: bool = False,
    family: Family | None = None,
    scope: str | None = None,
    bias: bool = True,
    wrong: Mask | None = None,
    progress: Progress = silent,
    **words: Any,
) -> Estimation:
    """What :func:`estimate` finds, in its words, with what led to it: for those who measure more of the same signal."""
    if scope not in (None, *Scope):
        raise InputError(f"scope {scope!r} is unknown; use one of {', '.join(Scope)}")
    options = Options(scope=None if scope is None else Scope(scope), bias=bias or remove_bias, **words)
    samples = replace(checked(x, rate, start=start, what="estimate", at_least=FEWEST_SAMPLES), wrong=wrong)
    if family is not None or method == MODEL_FIT:
        return of_model(samples, options, method, family, harmonic)
    if method not in METHODS:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join((*METHODS, MODEL_FIT))}")
    refuse_unused(method, options.given)
    samples, search = of_enough_samples(samples, method, options, harmonic)
    check_memory(method, samples.x.size)
    no_room = without_room(method, samples.x.size) if options.bias else None
    if no_room is not None and remove_bias:
        raise InputError(no_room)
    options = options if no_room is None else replace(options, bias=False)
    request = prepared(samples, options, search=search)
    noise = request.presence
    if method in QUADRATIC and options.band is not None:
        refuse_cross_term(request, method)
    request = in_its_stretch(request, samples) if noise.found else without_bias_of(request)
    if request.options.bias:
        request = after_its_start(of_most_energy(request.separated(), samples), samples)
    if request.options.bias or request.signal.tones:
        request = doubting_steps(request, samples)
        samples = with_motion_of(request, samples)
    progress(0.1, "choosing an estimator" if method == "auto" else method)
    name, request = for_auto(request) if method == "auto" else (method, request)
    if method == "harmonic-least-squares":
        request = for_least_squares(request)
    progress(0.3, name)
    try:
        found = ESTIMATORS[name](request)
    except InputError as error:
        raise (error if noise.found else InputError(f"{noise.reason}; {name}: {error}")) from None
    progress(0.5, f"bias and interval of {name}")
    found = in_its_band(found, options.band)
    track = known_well(without_bias(with_bias(found, ESTIMATORS[name], request), remove_bias))
    track = in_its_band(track, options.band)
    track = replace(track, used=replace(track.used, span=span_of(request, samples), span_why=request.signal.span_why))
    progress(1.0, "done")
    if harmonic > 1:
        track = of_harmonic(harmonic, request, track.held_against(noise).of_oscillation(), remove_bias)
    track = track if no_room is None else replace(track, no_interval=no_room)
    return Estimation(track.held_against(noise), samples, request)


def of_enough_samples(
    samples: Samples, method: str, options: Options, harmonic: int
) -> tuple[Samples, SearchBand | None]:
    """A long record decimated, as far as the options allow, with its search band where that was looked for."""
    least, longest = (PER_CYCLE, LONG) if method == "auto" else (MORE_PER_CYCLE, VERY_LONG)
    highest = max(harmonic, options.harmonics or 1, OF_A_MODE * (options.components or 1))
    return decimated(samples, band=options.band, per_cycle=max(least, 4.0 * highest), longest=longest)


def without_bias_of(request: Request) -> Request:
    """The same request without the bias: that of noise is not to be estimated."""
    return replace(request, options=replace(request.options, bias=False))


def with_motion_of(request: Request, samples: Samples) -> Samples:
    """The samples with those of the request's stretch as they are without what was found beside the oscillation."""
    first = round((request.signal.start - samples.start) * samples.rate)
    x = samples.x.copy()
    x[first : first + request.signal.x.size] = request.signal.x + request.signal.offset
    return replace(samples, x=x)


def span_of(request: Request, samples: Samples) -> tuple[float, float] | None:
    """First and last time of a request for some of the samples; None for all of them."""
    time = request.signal.time
    return (float(time[0]), float(time[-1])) if time.size < samples.x.size else None


def known_well(track: Track) -> Track:
    """Take out of the valid part what its own interval hardly knows, as at the end of a decay that sinks into noise.

    Where an interval was wanted and no model of the signal settles, the deviation alone counts.

    >>> import numpy as np
    >>> sigma, none = np.array([0.01, 0.5]), np.zeros(2)
    >>> track = Track(np.arange(2.0), np.ones(2), np.ones(2, bool), "example", sigma, none, bias_deviation=none)
    >>> known_well(track).valid.tolist()
    [True, False]
    """
    interval, reach = track.interval, None
    if interval is not None:
        reach = 0.5 * (interval.high - interval.low)
        far = np.zeros_like(track.omega) if track.bias is None else np.abs(track.bias)
        track = replace(track, valid=track.valid & ((far <= reach) | (far <= FAR * track.omega)))
    elif track.no_interval is not None and track.standard_deviation is not None:
        reach = NORMAL_95 * track.standard_deviation
    return track if reach is None else replace(track, valid=track.valid & (reach <= HARDLY_KNOWN * track.omega))


def of_model(samples: Samples, options: Options, method: str, family: Family | None, harmonic: int) -> Estimation:
    """The frequency of an oscillator fitted to the signal, without what is stronger beyond a band that is given."""
    if family is None or method != MODEL_FIT:
        raise InputError(f"method {method!r} and an oscillator do not go together: {MODEL_FIT} needs one, others none")
    refuse_unused(method, options.given)
    beyond = beyond_band(samples.x - samples.x.mean(), samples, options.band)
    samples = replace(samples, x=samples.x - total(beyond, samples.time - samples.start))
    track = model_track(fitted(samples, family, band=options.band))
    track = replace(in_its_band(track, options.band), used=replace(track.used, tones=beyond))
    noise = presence(samples.x, samples.rate, limits=options.band, whole=options.band is None)
    if harmonic > 1:
        x = samples.x - samples.x.mean()
        track = locked_track(x, samples.rate, track, multiple=harmonic, start=samples.start)
    return Estimation(track.held_against(noise), samples, None)


def of_harmonic(multiple: int, request: Request, fundamental: Track, remove_bias: bool) -> Track:
    """The track of a harmonic, locked to the fundamental's."""
    track = locked_track(request.signal.x, request.signal.rate, fundamental, multiple=multiple)
    return without_bias(
        harmonic_with_interval(track, request, fundamental) if request.options.bias else track, remove_bias
    )
