"""Frequency, amplitude and growth rate half cycle by half cycle, from zero crossings and turning points alone.

With crossings t_i and the turning points p_i between them, at s_i,

    omega_i = pi / (t_(i+1) - t_i),     a_i = |p_i|,     a'/a = ln(|p_(i+1)| / |p_(i-1)|) / (s_(i+1) - s_(i-1)),

the peak finding and fitting of free decays (Jin, Chen, Brake and Song, J. Vib. Acoust. 142 (2020) 051111).  The growth
rate compares turning points on the same side, so that an asymmetry cancels; the frequency of a single half cycle does
not cancel it, and alternates.  A turning point is that of a quartic fitted to the middle of its lobe.  Zero is the
local mean that harmonic least squares finds: the mean of all samples would be off, by the first cycles of a decay, and
crossings and turning points are all the more wrong the smaller the oscillation has become.

They are those of the sum of all that the samples hold: nothing is claimed where that is no single oscillation, as
models of the whole tell (``components.separation``), and what is before the free decay or after it is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.numeric.arrays import Array, Mask, as_rows, freeze
from ridgeback.numeric.backbone.backbone import CLEAR
from ridgeback.numeric.backbone.curve import Backbone, Crowding, Points, assemble
from ridgeback.numeric.backbone.damping import growth_columns
from ridgeback.numeric.backbone.shown import Curve, ShownBackbone
from ridgeback.numeric.estimators.zero_crossing import crossing_samples, dead_zone, interpolate
from ridgeback.numeric.harmonics.local_fit import choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.signal.decimation import Samples, checked
from ridgeback.numeric.signal.presence import Presence
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Definition, Held
from ridgeback.numeric.tracking.clear_stretch import clear_stretch
from ridgeback.numeric.tracking.own_stretch import part_of
from ridgeback.numeric.tracking.request import FEWEST_SAMPLES, Options, Request, prepared

MIDDLE = 0.6
"""Share of a half cycle to which the quartic is fitted: cos lies within 1e-4 of one there."""
DEGREE = 4
FEWEST = 6


@dataclass(frozen=True, repr=False)
class HalfCycles(ShownBackbone):
    """One value per half cycle, at the middle between its two zero crossings.

    Parameters
    ----------
    time : array of float, shape (M,)
        Middle of each half cycle.
    omega, omega_sd : array of float, shape (M,)
        Frequency in rad per time unit, and its standard deviation.
    amplitude, amplitude_sd : array of float, shape (M,)
        Size of the turning point, in the signal's unit: the definition ``peak``.
    growth_rate, growth_rate_sd : array of float, shape (M,)
        a'/a per time unit, negative in a decay; NaN in the first and the last half cycle.
    side : array of float, shape (M,)
        1 above zero, -1 below.
    offset : float
        The mean that was taken off.
    noise : float
        Standard deviation of the noise, in the signal's unit.
    settings : mapping
        How they were found, for display.
    definition : Definition
        Of the amplitude.
    units : str
        Unit of the signal; may be empty.
    presence : Presence, optional
        How well noise alone explains the signal.
    no_interval : str, optional
        Why no deviations are given, if so.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> found = half_cycles(np.exp(-0.05 * t) * np.cos(6.0 * t), 32.0)
    >>> round(float(np.median(found.omega)), 3), round(float(np.nanmedian(found.growth_rate)), 3)
    (6.0, -0.05)
    """

    time: Array
    omega: Array
    omega_sd: Array
    amplitude: Array
    amplitude_sd: Array
    growth_rate: Array
    growth_rate_sd: Array
    side: Array
    offset: float
    noise: float
    settings: Mapping[str, object] = field(default_factory=dict)
    definition: Definition = Definition.PEAK
    units: str = ""
    presence: Presence | None = None
    no_interval: str | None = None

    def __post_init__(self) -> None:
        freeze(self)

    def along(self) -> Curve:
        """Each half cycle's amplitude and frequency."""
        return Curve(self.amplitude, self.omega, self.omega_sd)

    def index(self) -> tuple[str, ...]:
        """Half cycles follow one another in time."""
        return ("time_s",)

    def rows(self) -> list[dict[str, float]]:
        """One row per half cycle."""
        columns = {
            "time_s": self.time,
            "omega_rad_s": self.omega,
            "frequency_hz": self.omega / TWO_PI,
            "omega_standard_deviation_rad_s": self.omega_sd,
            "amplitude": self.amplitude,
            "amplitude_standard_deviation": self.amplitude_sd,
            **growth_columns(self.growth_rate, self.growth_rate_sd, self.omega, self.omega_sd),
            "side": self.side,
        }
        return as_rows(columns)

    def backbone(self, exclude: Mask | None = None) -> Backbone:
        """Frequency and growth rate against peak amplitude, binned; ``exclude`` marks half cycles to leave out.

        Raises InputError when fewer than four half cycles are clear of the noise, and where all is noise.
        """
        if self.presence is not None and not self.presence.found:
            raise InputError(f"backbone: {self.presence.reason}")
        if self.no_interval is not None:
            raise InputError(f"backbone: {self.no_interval}")
        usable = np.isfinite(self.growth_rate) & (self.amplitude > CLEAR * self.amplitude_sd)
        usable &= np.ones_like(usable) if exclude is None else ~exclude
        if np.count_nonzero(usable) < 4:
            raise InputError(
                f"backbone: {np.count_nonzero(usable)} half cycles are clear of the noise and of clipped or stuck "
                "samples; give a longer or less noisy record"
            )
        points = Points(
            self.time,
            self.amplitude,
            self.amplitude_sd,
            self.omega,
            self.omega_sd,
            self.growth_rate,
            self.growth_rate_sd,
        ).at(usable)
        notes = [
            *self.span_notes(),
            f"The mean of the samples, {self.offset:.4g}, was removed.",
            f"{usable.size - np.count_nonzero(usable)} of {usable.size} half cycles are not used: without a neighbour "
            f"on both sides, not {CLEAR:g} times above noise, or clipped.",
        ]
        settings = {"track": "half-cycles", **self.settings}
        return assemble(
            points,
            # Neighbours share a crossing, whose error cancels in their mean; so do turning points, two at either end.
            crowding=Crowding(amplitude=1.0, omega=1.0, omega_ends=1.0, growth_ends=2.0),
            offset=self.offset,
            settings=settings,
            notes=notes,
            definition=self.definition,
            fewest=FEWEST,
        )

    def span_notes(self) -> tuple[str, ...]:
        """Which part of the record they are of, where that is not all."""
        span = self.settings.get("span")
        if not isinstance(span, tuple):
            return ()
        low, high = span
        return (f"Of t = {low:.6g} to {high:.6g}, where {Held.CLEAR}; the rest is left out.",)


def half_cycles(
    x: ArrayLike,
    rate: float,
    *,
    start: float = 0.0,
    band: tuple[float, float] | None = None,
    exclude: Mask | None = None,
    progress: Progress = silent,
) -> HalfCycles:
    """Measure frequency, amplitude and growth rate of each half cycle.

    Parameters
    ----------
    x : array of float, shape (N,)
        Real samples, evenly spaced.  Their local mean is taken off.
    rate : float
        Samples per time unit.
    start : float
        Time of the first sample.
    band : (float, float), optional
        Where the fundamental is looked for, rad per time unit.
    exclude : array of bool, shape (N,), optional
        Samples that are no part of the motion, such as clipped ones: they do not count against one oscillation.
    progress : callable
        Told the share of the work that is done and the step.

    Returns
    -------
    HalfCycles
        With the standard deviations that white noise of the measured level causes; NaN where noise alone explains
        the signal.

    Raises
    ------
    InputError
        With fewer than four zero crossings, and as ``estimate`` does for signals that cannot be used.

    References
    ----------
    Jin, Chen, Brake and Song, J. Vib. Acoust. 142 (2020) 051111.

    Examples
    --------
    >>> t = np.arange(1280) / 32.0
    >>> found = half_cycles(np.exp(-0.05 * t) * np.cos(2 * np.pi * 1.25 * t), 32.0)
    >>> inner = slice(1, -1)
    >>> bool(np.abs(found.growth_rate[inner] + 0.05).max() < 1e-4), bool(np.abs(found.omega / np.pi - 2.5).max() < 2e-3)
    (True, True)
    """
    progress(0.0, "search band")
    samples = checked(x, rate, start=start, what="half_cycles", at_least=FEWEST_SAMPLES)
    wrong = exclude if exclude is not None and exclude.size == samples.x.size and exclude.any() else None
    whole = prepared(replace(samples, wrong=wrong), Options(band=band, bias=False))
    request = of_the_motion(whole, replace(samples, wrong=wrong))
    reason = not_one(request)
    rate = samples.rate
    progress(0.3, "local mean and noise")
    level = local_level(request)
    progress(0.4, "crossings and turning points")
    x, noise = request.signal.x - level.offset, level.noise
    hysteresis = dead_zone(noise, level.smallest)
    crossings = interpolate(x, crossing_samples(x, hysteresis))
    if crossings.at.size < 4:
        raise InputError(f"signal has {crossings.at.size} zero crossings; half cycles need 4 (give a longer record)")
    error = noise / crossings.slope / rate
    period = np.diff(crossings.at) / rate
    omega = np.pi / period
    found = np.array([turning_point(x, first, last) for first, last in pairwise(crossings.at.tolist())])
    at, peak, spread = found[:, 0] / rate, found[:, 1], noise * found[:, 2]
    growth_rate, growth_rate_sd = decrements(at, peak, spread)
    known = 1.0 if request.presence.found and reason is None else np.nan
    cut = request.signal.x.size < whole.signal.x.size
    span = (float(request.signal.start), float(request.signal.time[-1]))
    return HalfCycles(
        time=request.signal.start + 0.5 * (crossings.at[:-1] + crossings.at[1:]) / rate,
        omega=omega,
        omega_sd=known * omega / period * np.hypot(error[:-1], error[1:]),
        amplitude=np.abs(peak),
        amplitude_sd=known * spread,
        growth_rate=growth_rate,
        growth_rate_sd=known * growth_rate_sd,
        side=np.where(crossings.rising[:-1], 1.0, -1.0),
        offset=request.signal.offset,
        noise=noise,
        settings={
            "start": samples.start,
            "noise_probability": request.presence.probability,
            **({"span": span} if cut else {}),
            **({} if reason is None else {"no_interval": reason}),
            **request.details(noise=noise, hysteresis=hysteresis),
        },
        presence=request.presence,
        no_interval=reason,
    )


def of_the_motion(request: Request, samples: Samples) -> Request:
    """The request for what is between a release and a stop, or above the noise; unchanged where that is all."""
    stretch = clear_stretch(request) if request.presence.found else None
    return request if stretch is None else part_of(request, samples, stretch, (Held.CLEAR,))


def not_one(request: Request) -> str | None:
    """Why the samples are not those of one oscillation and noise; None where they are, or nobody knows."""
    if not request.presence.found:
        return None
    alone = replace(request, options=replace(request.options, bias=True)).separated()
    if alone.signal.doubt:
        return alone.signal.doubt
    beside = [tone for tone in alone.signal.tones if alone.known_models and tone.amplitude > alone.models.best.noise]
    if not beside:
        return None
    return (
        f"{max(beside, key=lambda tone: tone.amplitude).said()}, lies beside the oscillation: crossings and turning "
        "points are those of the sum; the other methods take it off"
    )


@dataclass(frozen=True)
class LocalLevel:
    """Local mean per sample, the smallest amplitude, and the noise, by harmonic least squares."""

    offset: Array
    smallest: float
    noise: float


def local_level(request: Request) -> LocalLevel:
    """Fit half-overlapping windows along the search band's guide."""
    half, guide = request.half, request.signal.search.guide
    shape = Shape(choose_multiples(request.signal.x, request.signal.rate, guide, half=half))
    centres = np.arange(half, request.signal.x.size - half, max(1, half))
    fit = harmonic_fit(request.signal.x, request.signal.rate, guide, half=half, shape=shape, centres=centres)
    good = fit.settled if fit.settled.any() else np.ones_like(fit.settled)
    offset = np.interp(np.arange(request.signal.x.size) / request.signal.rate, fit.time[good], fit.offset[good])
    return LocalLevel(offset, float(np.abs(fit.amplitude[good]).min()), float(np.median(fit.noise[good])))


def turning_point(x: Array, first: float, last: float) -> tuple[float, float, float]:
    """Place, value and standard deviation per unit of noise of the extreme between two crossings, in samples.

    >>> place, value, _ = turning_point(np.sin(0.1 * np.arange(40)), 0.0, 10 * np.pi)
    >>> bool(abs(place - 5 * np.pi) < 1e-3), bool(abs(value - 1.0) < 1e-4)
    (True, True)
    """
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    reach = max(MIDDLE * half, 0.5 * FEWEST)
    index = np.arange(max(0, int(np.ceil(middle - reach))), min(x.size - 1, int(np.floor(middle + reach))) + 1)
    s = (index - middle) / half
    matrix = np.vander(s, min(DEGREE, index.size - 1) + 1, increasing=True)
    inverse = np.linalg.pinv(matrix.T @ matrix)
    curve = Polynomial(inverse @ matrix.T @ x[index])
    candidates = np.concatenate([curve.deriv().roots(), s[[np.argmax(np.abs(x[index]))]]])
    real = candidates.real[(np.abs(candidates.imag) < 1e-9) & (np.abs(candidates.real) <= np.abs(s).max())]
    top = float(real[np.argmax(np.abs(curve(real)))])
    row = top ** np.arange(matrix.shape[1])
    return middle + half * top, float(curve(top)), float(np.sqrt(row @ inverse @ row))


def decrements(at: Array, peak: Array, deviation: Array) -> tuple[Array, Array]:
    """a'/a of each half cycle from the turning points before and after it, with its standard deviation.

    NaN where noise alone leaves no turning point, or two of them at one time.
    """
    growth_rate, spread = np.full(peak.size, np.nan), np.full(peak.size, np.nan)
    size = np.where(np.abs(peak) > np.finfo(float).tiny, np.abs(peak), np.nan)
    between = np.where(at[2:] > at[:-2], at[2:] - at[:-2], np.nan)
    growth_rate[1:-1] = np.log(size[2:] / size[:-2]) / between
    spread[1:-1] = np.hypot(deviation[2:] / size[2:], deviation[:-2] / size[:-2]) / between
    return growth_rate, spread
