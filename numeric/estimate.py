"""One door to every estimator of the fundamental frequency: ``estimate(x, rate, method=...)`` gives a Track."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from scipy import fft

from numeric.curvature import formula_bias, held, reestimated_bias
from numeric.errors import InputError
from numeric.harmonic_fit import Shape, choose_harmonics, harmonic_fit
from numeric.hilbert import band_frequency
from numeric.lag_kernel import LagKernel
from numeric.noise import Level, measure_level, peak_deviation
from numeric.ridge import Kernel, follow
from numeric.samples import TWO_PI, Array, ComplexArray, Mask, checked_rate, checked_real_samples
from numeric.search_band import Corridor, find_corridor, given_band, strongest_frequency
from numeric.short_time import ShortTimeKernel
from numeric.track import Track
from numeric.wigner import as_analytic, wigner_kernel
from numeric.windows import half_width, window
from numeric.zero_crossing import full_cycles

LAG_CYCLES = 4.0
"""Default window, in cycles of the strongest component: 3 s for the paper's pendulum."""


@dataclass(frozen=True)
class Request:
    """What an estimator needs to know, checked."""

    x: Array
    z: ComplexArray
    rate: float
    start: float
    corridor: Corridor
    lag_seconds: float
    lag_window: str
    smoothing_seconds: float
    harmonics: int | None
    remove_bias: bool
    bias: bool

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.start + np.arange(self.x.size) / self.rate

    @property
    def half(self) -> int:
        """Half the lag window, in samples."""
        return half_width(self.lag_seconds, self.rate, longest=self.x.size)

    @property
    def cycle(self) -> float:
        """The longest period that the corridor's guide shows."""
        return TWO_PI / float(self.corridor.guide.min())

    def away_from_border(self, seconds: float) -> Mask:
        """True at samples at least ``seconds`` inside the record."""
        t = self.time - self.start
        slack = 1e-9 / self.rate
        return np.asarray((t >= seconds - slack) & (t <= t[-1] - seconds + slack), dtype=np.bool_)

    def level(self, omega: Array, valid: Mask) -> Level:
        """Amplitude and noise along a track."""
        return measure_level(self.x, self.rate, held(self.time, omega, valid), half=self.half)

    def settings(self, **more: object) -> dict[str, object]:
        """What every track reports, and more."""
        low, high = self.corridor.limits
        return {"rate": self.rate, "band_rad": (low, high), "band_why": self.corridor.why, **more}


def finish(track: Track, remove_bias: bool) -> Track:
    """Take the bias off when that is wanted, and say so."""
    if track.bias is None or not remove_bias:
        return replace(track, settings={**track.settings, "bias_removed": False})
    return replace(track, omega=track.omega - track.bias, settings={**track.settings, "bias_removed": True})


def peak_estimate(
    request: Request,
    method: str,
    make: Callable[[ComplexArray], Kernel],
    *,
    border: float,
    half_window: Array,
    smoothing: Array | None = None,
    formula: LagKernel | None = None,
    **settings: object,
) -> Track:
    """Ridge of a kernel with its deviation and its bias: by formula where given, else by estimating again."""
    corridor, time = request.corridor, request.time
    ridge = follow(make(request.z), corridor.low, corridor.high)
    valid = ridge.inside & request.away_from_border(border)
    need(valid, method, border)

    def again(z: ComplexArray) -> Array:
        return follow(make(z), corridor.low, corridor.high).omega

    bias: Array | None = None
    if request.bias and formula is not None:
        bias = formula_bias(time, ridge.omega, valid, kernel=formula)
    elif request.bias:
        bias = reestimated_bias(time, ridge.omega, valid, resolution=2.0 * border, estimator=again)
    level = request.level(ridge.omega, valid)
    deviation = peak_deviation(level, request.rate, half_window, smoothing)
    how = {"bias_by": "formula" if formula is not None else "estimating again on the fitted chirp"}
    return Track(
        time, ridge.omega, valid, method, deviation, bias, request.settings(noise=level.noise, **how, **settings)
    )


def need(valid: Mask, method: str, border: float) -> None:
    """Refuse a track with hardly a valid sample."""
    if np.count_nonzero(valid) < 8:
        raise InputError(
            f"{method}: {np.count_nonzero(valid)} samples of {valid.size} lie {border:.4g} inside the record "
            f"and have a peak in the band; give a longer record, a shorter lag_seconds or another band"
        )


def by_wigner(request: Request) -> Track:
    """Peak of the full-length Wigner distribution; biased by the curvature of omega(t), to all orders."""
    n_fft = fft.next_fast_len(request.z.size, real=True)
    kernel = wigner_kernel(request.z, request.rate, n_fft=n_fft)
    # The number of lags changes from column to column; the deviation is that of the mean available window.
    quarter = np.ones(kernel.half_lags // 2 + 1)
    return peak_estimate(
        request,
        "wigner",
        lambda z: wigner_kernel(z, request.rate, n_fft=n_fft),
        border=request.cycle,
        half_window=quarter,
    )


def by_pseudo_wigner(request: Request) -> Track:
    """Peak of the pseudo-Wigner distribution."""

    def make(z: ComplexArray) -> LagKernel:
        return wigner_kernel(z, request.rate, lag_seconds=request.lag_seconds, lag_window=request.lag_window)

    kernel = make(request.z)
    return peak_estimate(
        request,
        "pseudo-wigner",
        make,
        border=0.5 * request.lag_seconds,
        half_window=kernel.lag_window,
        formula=kernel,
        lag_seconds=2.0 * kernel.half_lags / request.rate,
        lag_window=request.lag_window,
    )


def by_smoothed_pseudo_wigner(request: Request) -> Track:
    """Peak of the smoothed pseudo-Wigner distribution."""

    def make(z: ComplexArray) -> LagKernel:
        return wigner_kernel(
            z,
            request.rate,
            lag_seconds=request.lag_seconds,
            lag_window=request.lag_window,
            smoothing_seconds=request.smoothing_seconds,
        )

    kernel = make(request.z)
    return peak_estimate(
        request,
        "smoothed-pseudo-wigner",
        make,
        border=0.5 * (request.lag_seconds + request.smoothing_seconds),
        half_window=kernel.lag_window,
        smoothing=kernel.smoothing,
        lag_seconds=2.0 * kernel.half_lags / request.rate,
        lag_window=request.lag_window,
        smoothing_seconds=2.0 * kernel.half_smoothing / request.rate,
    )


def by_spectrogram(request: Request) -> Track:
    """Peak of the spectrogram of the analytic signal."""
    w = window(request.lag_window, request.half)
    n_fft = fft.next_fast_len(2 * w.size)
    return peak_estimate(
        request,
        "spectrogram",
        lambda z: ShortTimeKernel(z, request.rate, w, n_fft),
        border=0.5 * request.lag_seconds,
        half_window=w[request.half :],
        lag_seconds=2.0 * request.half / request.rate,
        lag_window=request.lag_window,
    )


# Phase noise through the band: var = (2 sigma^2 / A^2) / (2 pi rate) * integral over the band of (omega - omega0)^2.
def by_hilbert(request: Request) -> Track:
    """Phase derivative of the analytic signal limited to the band."""
    low, high = request.corridor.limits
    omega = band_frequency(request.x, request.rate, low, high)
    valid = request.away_from_border(2.0 * request.cycle)
    need(valid, "hilbert", 2.0 * request.cycle)
    level = request.level(np.clip(omega, request.corridor.low, request.corridor.high), valid)
    centre = np.clip(omega, low, high)
    spread = ((high - centre) ** 3 + (centre - low) ** 3) / (3.0 * TWO_PI * request.rate)
    deviation = np.sqrt(2.0 * spread) * level.noise / level.amplitude
    return Track(request.time, omega, valid, "hilbert", deviation, None, request.settings(noise=level.noise))


def by_zero_crossing(request: Request) -> Track:
    """Full cycles between zero crossings; one value per half cycle, at the middle of its cycle."""
    everywhere = np.ones(request.x.size, dtype=np.bool_)
    level = request.level(request.corridor.guide, everywhere)
    hysteresis = max(3.0 * level.noise, 0.02 * float(level.amplitude.min()))
    time, omega, deviation = full_cycles(request.x, request.rate, hysteresis=hysteresis, noise=level.noise)
    settings = request.settings(noise=level.noise, hysteresis=hysteresis)
    valid = np.ones(time.size, dtype=np.bool_)
    return Track(request.start + time, omega, valid, "zero-crossing", deviation, None, settings)


def by_harmonic_least_squares(request: Request) -> Track:
    """Phase polynomial with harmonics, fitted locally."""
    guide, half = request.corridor.guide, request.half
    count = request.harmonics or choose_harmonics(request.x, request.rate, guide, half=half)
    fit = harmonic_fit(request.x, request.rate, guide, half=half, shape=Shape(count), start_time=request.start)
    need(fit.valid, "harmonic-least-squares", 0.5 * request.lag_seconds)
    settings = request.settings(
        noise=float(np.median(fit.noise[fit.valid])),
        harmonics=count,
        lag_seconds=fit.window_seconds,
        one_sided_borders=True,
    )
    return Track(fit.time, fit.omega, fit.valid, "harmonic-least-squares", fit.standard_deviation, None, settings)


def by_auto(request: Request) -> Track:
    """Harmonic least squares where a window holds enough samples for it, else the pseudo-Wigner peak."""
    if 2 * request.half + 1 >= 2 * Shape(1).size:
        why = "harmonic least squares: efficient in noise and unbiased by curvature to third order in the phase"
        track = by_harmonic_least_squares(request)
    else:
        why = "pseudo-Wigner: the window holds too few samples for a least-squares fit of a phase polynomial"
        track = by_pseudo_wigner(request)
    return replace(track, settings={**track.settings, "why": why})


ESTIMATORS: Mapping[str, Callable[[Request], Track]] = MappingProxyType(
    {
        "auto": by_auto,
        "wigner": by_wigner,
        "pseudo-wigner": by_pseudo_wigner,
        "smoothed-pseudo-wigner": by_smoothed_pseudo_wigner,
        "spectrogram": by_spectrogram,
        "hilbert": by_hilbert,
        "zero-crossing": by_zero_crossing,
        "harmonic-least-squares": by_harmonic_least_squares,
    }
)
METHODS = tuple(ESTIMATORS)


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
    bias: bool = True,
    remove_bias: bool = False,
) -> Track:
    """Estimate the fundamental frequency omega0(t) of the real signal ``x``, shape ``(N,)``, sampled at ``rate``.

    ``method`` is one of METHODS.  ``band`` limits the search, (low, high) in rad per time unit; by default a corridor
    around the strongest component is found from the data.  ``lag_seconds`` is the stretch of signal under the window
    of the windowed methods (default four cycles), ``smoothing_seconds`` the time smoothing (default one cycle).
    ``bias=False`` leaves the bias estimate out; ``remove_bias=True`` takes it off.  The mean is removed.

    Raises InputError for an unknown method, values that are not finite, a constant signal, a record too short for the
    window, or a band beyond the Nyquist frequency.

    >>> t = np.arange(640) / 32.0
    >>> track = estimate(np.cos(2 * np.pi * (1.0 * t + 0.01 * t**2)), 32.0, method="pseudo-wigner")
    >>> inside = track.inside()
    >>> bool(np.abs(inside.frequency_hz - 1.0 - 0.02 * inside.time).max() < 1e-3)
    True
    """
    if method not in ESTIMATORS:
        raise InputError(f"method {method!r} is unknown; use one of {', '.join(METHODS)}")
    samples, rate = checked_real_samples(x, what="estimate", at_least=16), checked_rate(rate)
    if not np.ptp(samples) > 0.0:
        raise InputError(f"signal is constant at {samples[0]:g}; there is no oscillation to follow")
    offset = float(samples.mean())
    real = samples - offset
    corridor = find_corridor(real, rate) if band is None else given_band(band, real, rate)
    cycle = TWO_PI / strongest_frequency(real, rate)
    request = Request(
        x=real,
        z=as_analytic(real),
        rate=rate,
        start=float(start),
        corridor=corridor,
        lag_seconds=LAG_CYCLES * cycle if lag_seconds is None else lag_seconds,
        lag_window=lag_window,
        smoothing_seconds=cycle if smoothing_seconds is None else smoothing_seconds,
        harmonics=harmonics,
        remove_bias=remove_bias,
        bias=bias or remove_bias,
    )
    track = finish(ESTIMATORS[method](request), remove_bias)
    return replace(track, settings={"offset_removed": offset, **track.settings})
