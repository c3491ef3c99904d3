"""One door to every estimator of the fundamental frequency: ``estimate(x, rate, method=...)`` gives a Track."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.estimators.auto import for_auto, for_least_squares
from ridgeback.numeric.estimators.global_harmonics import by_harmonic_splines, with_spline_interval
from ridgeback.numeric.estimators.higher_harmonics import harmonic_track, vouched_harmonic
from ridgeback.numeric.estimators.peak import by_pseudo_wigner, by_smoothed_pseudo_wigner, by_spectrogram, by_wigner
from ridgeback.numeric.estimators.phase import by_harmonic_least_squares, by_hilbert, by_zero_crossing
from ridgeback.numeric.estimators.polynomial_peak import by_polynomial_wigner
from ridgeback.numeric.estimators.reassigned_ridge import by_reassigned_spectrogram, by_synchrosqueezing
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.fit import model_fit
from ridgeback.numeric.model_fit.track import model_track
from ridgeback.numeric.signal.decimation import PER_CYCLE, Decimated, decimated
from ridgeback.numeric.signal.samples import checked_rate, checked_real_samples, checked_swing
from ridgeback.numeric.tracking.request import Request, prepared, refuse_cross_term
from ridgeback.numeric.tracking.track import NORMAL_95, Track
from ridgeback.numeric.tracking.uncertainty import trial_of, with_interval


def finish(track: Track, remove_bias: bool) -> Track:
    """Take the bias off when that is wanted, and say so."""
    if track.bias is None or not remove_bias:
        return replace(track, settings={**track.settings, "bias_removed": False})
    return replace(track, omega=track.omega - track.bias, settings={**track.settings, "bias_removed": True})


def by_least_squares(request: Request) -> Track:
    """Harmonic least squares, local or global."""
    return by_harmonic_splines(request) if request.scope == "global" else by_harmonic_least_squares(request)


def vouched(track: Track, estimator: Callable[[Request], Track], request: Request) -> Track:
    """The track with its bias and its interval, or with the reason why it has none."""
    if not request.bias:
        return track
    if request.scope == "global":
        return with_spline_interval(track, request)
    try:
        fixed = replace(request, known_models=request.models)
    except InputError as error:
        return replace(track, settings={**track.settings, "no_interval": str(error)})
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
HARDLY_KNOWN = 0.1
"""Half width of a 95 % interval, relative to omega, beyond which a value is not counted as valid."""
QUADRATIC = ("wigner", "pseudo-wigner", "smoothed-pseudo-wigner", "polynomial-wigner")
"""Methods whose distribution has cross terms on the harmonics."""
OF_ONE_KERNEL = ("wigner", "pseudo-wigner", "smoothed-pseudo-wigner")
"""Methods whose lag kernel can be limited to a band or held in single precision."""


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
    family: Family | None = None,
    progress: Progress = silent,
) -> Track:
    """Estimate the fundamental frequency omega0(t) of the real signal ``x``, shape ``(N,)``, sampled at ``rate``.

    ``method`` is one of METHODS; ``auto`` takes that, over the window, that should have the least error on a model of
    the signal, says so in ``settings["why"]``, and decimates records of more than 16,384 samples first, where the rate
    allows.  ``band`` limits the search, (low, high) in rad per time unit; by default a corridor around the strongest
    component is found from the data.  ``lag_seconds`` is the stretch of signal under the window of the windowed methods
    (default four cycles), ``smoothing_seconds`` the time smoothing (default one cycle).
    ``scope`` is that of harmonic least squares: ``"global"``, splines over the whole record (the default without a
    ``lag_seconds``), or ``"local"``, a polynomial in a sliding window, whose length and degree are then chosen by the
    least expected error.  ``harmonics`` is the highest multiple that they fit (default: those the data show).
    ``order`` is that of the polynomial Wigner distribution, 4 or 6.
    ``band_limited=True`` limits the signal to the band before a Wigner, pseudo- or smoothed pseudo-Wigner distribution
    and decimates its lags: faster, free of cross terms with what lies outside, and less exact near the ends,
    where the filter rings (not counted as valid).  ``single=True`` computes these three in complex64: an error near
    1e-8 of omega for a clean signal.  Other methods refuse both.
    ``harmonic`` above 1 asks for the track of that harmonic, phase-locked to the fundamental found by ``method``.
    ``method="model-fit"`` fits the oscillator ``family`` to the samples (``model_fit``), of the
    other settings only ``band`` counts then.
    ``bias=False`` leaves the bias estimate out, and so the 95 % interval ``Track.interval``; ``remove_bias=True`` takes
    it off.  The interval holds the noise, what is not known of the bias, and near a separatrix what the definition of
    omega0(t) leaves open (``Track.ambiguous``); it supposes white noise and one smooth oscillation with its harmonics.
    Where no model of the signal settles there is none, and ``settings["no_interval"]`` says why.  The mean is removed.
    A Wigner peak is refused in a ``band`` round a harmonic of a stronger component: a cross term falls on it.

    Raises InputError for an unknown method, values that are not finite, a constant signal, a record too short for the
    window, or a band beyond the Nyquist frequency.

    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> track = estimate(np.cos(2 * np.pi * (1.0 * t + 0.01 * t**2)), 32.0, method="pseudo-wigner")
    >>> inside = track.inside()
    >>> bool(np.abs(inside.frequency_hz - 1.0 - 0.02 * inside.time).max() < 1e-3)
    True
    """
    if family is not None or method == MODEL_FIT:
        return of_model(x, rate, method, family, band=band, start=start, harmonic=harmonic)
    if method not in METHODS:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join((*METHODS, MODEL_FIT))}")
    if (band_limited or single) and method not in OF_ONE_KERNEL:
        raise InputError(
            f"method {method!r} has no band-limited or single-precision form; {', '.join(OF_ONE_KERNEL)} have"
        )
    few = Decimated(checked_swing(checked_real_samples(x, what="estimate")), checked_rate(rate), start, 1)
    if method == "auto":
        few = decimated(few.x, few.rate, start=start, band=band, per_cycle=max(PER_CYCLE, 4.0 * harmonic))
    request = prepared(
        few.x,
        few.rate,
        band=band,
        start=few.start,
        lag_seconds=lag_seconds,
        smoothing_seconds=smoothing_seconds,
        lag_window=lag_window,
        harmonics=harmonics,
        order=order,
        bias=bias or remove_bias,
        band_limited=band_limited,
        single=single,
    )
    if method in QUADRATIC and band is not None:
        refuse_cross_term(request, method)
    progress(0.1, "choosing an estimator" if method == "auto" else method)
    name, request = for_auto(request) if method == "auto" else (method, request)
    if method == "harmonic-least-squares":
        request = for_least_squares(request, scope)
    progress(0.3, name)
    found = ESTIMATORS[name](request)
    progress(0.5, f"bias and interval of {name}")
    track = trusted(finish(vouched(found, ESTIMATORS[name], request), remove_bias))
    progress(1.0, "done")
    if few.factor > 1:
        track = replace(track, settings={**track.settings, "decimated_by": few.factor, "rate_given": rate})
    return track if harmonic == 1 else of_harmonic(harmonic, request, track, remove_bias)


def trusted(track: Track) -> Track:
    """Take out of the valid part what its own interval hardly knows, as at the end of a decay that sinks into noise.

    Where an interval was wanted and no model of the signal settles, the deviation alone counts.

    >>> import numpy as np
    >>> sigma, none = np.array([0.01, 0.5]), np.zeros(2)
    >>> track = Track(np.arange(2.0), np.ones(2), np.ones(2, bool), "example", sigma, none, bias_deviation=none)
    >>> trusted(track).valid.tolist()
    [True, False]
    """
    interval, reach = track.interval, None
    if interval is not None:
        reach = 0.5 * (interval.high - interval.low)
    elif "no_interval" in track.settings and track.standard_deviation is not None:
        reach = NORMAL_95 * track.standard_deviation
    return track if reach is None else replace(track, valid=track.valid & (reach <= HARDLY_KNOWN * track.omega))


def of_model(
    x: ArrayLike,
    rate: float,
    method: str,
    family: Family | None,
    *,
    band: tuple[float, float] | None,
    start: float,
    harmonic: int,
) -> Track:
    """The frequency of an oscillator fitted to the signal."""
    if family is None or method != MODEL_FIT:
        raise InputError(f"method {method!r} and an oscillator do not go together: {MODEL_FIT} needs one, others none")
    track = model_track(model_fit(x, rate, family, start=start, band=band))
    if harmonic == 1:
        return track
    samples = checked_real_samples(x, what="estimate")
    return harmonic_track(samples - samples.mean(), rate, track, multiple=harmonic, start=start)


def of_harmonic(multiple: int, request: Request, fundamental: Track, remove_bias: bool) -> Track:
    """The track of a harmonic, locked to the fundamental's."""
    track = harmonic_track(request.x, request.rate, fundamental, multiple=multiple)
    return finish(vouched_harmonic(track, request, fundamental) if request.bias else track, remove_bias)
