"""What every estimator is given: the checked signal, where to look, and how long a window."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray, Mask
from ridgeback.numeric.harmonics.noise import Level, measure_level
from ridgeback.numeric.harmonics.signal_model import SignalModels, signal_models
from ridgeback.numeric.signal.analytic import as_analytic
from ridgeback.numeric.signal.band_limit import ringing
from ridgeback.numeric.signal.samples import TWO_PI, checked_rate, checked_real_samples, checked_swing
from ridgeback.numeric.signal.search_band import Corridor, find_corridor, strongest_frequency
from ridgeback.numeric.signal.windows import half_width
from ridgeback.numeric.tracking.curvature_bias import held

FEWEST_SAMPLES = 16
FEWEST_VALID = 8
FEWEST_IN_WINDOW = 4.0
"""Steps of the samples that a lag window must span before a shorter one could be the remedy."""
NEAR_MULTIPLE = 0.05
"""Relative distance within which a frequency counts as a multiple of another."""
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
    order: int
    bias: bool
    offset: float
    band_limited: bool = False
    single: bool = False
    lag_given: bool = False
    """Whether the window was asked for, or is the default that a method may change."""
    scope: str = "local"
    """Of harmonic least squares: in a sliding window, or ``global``."""
    phase_degree: int | None = None
    why: str = ""
    """Reason for what was chosen from the data."""
    bare: bool = False
    """Only the values are wanted, without a deviation: a trial, to be run many times."""
    multiples: tuple[int, ...] | None = None
    """Harmonics to fit beside the fundamental, where a trial is to use those of the track itself."""
    hysteresis: float | None = None
    """Of zero crossings, likewise."""
    known_models: SignalModels | None = None
    """Of the track's own signal, likewise."""

    def on(self, x: Array) -> Request:
        """The same request for other samples, of which only the values are wanted."""
        return replace(self, x=x, z=as_analytic(x), bias=False, bare=True)

    def like(self, settings: Mapping[str, object]) -> Request:
        """The same request with what a track chose from the data fixed: for trials of that track's estimator."""
        harmonics, hysteresis = settings.get("harmonics"), settings.get("hysteresis")
        multiples = tuple(harmonics[1:]) if isinstance(harmonics, tuple) else None
        known = hysteresis if isinstance(hysteresis, float) else None
        return replace(self, multiples=multiples, hysteresis=known, known_models=self.models)

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

    @property
    def margin(self) -> int:
        """Samples at each end that expected errors leave out: half the default window, or a tenth of the record."""
        return min(round(0.5 * LAG_CYCLES * self.cycle * self.rate), self.x.size // 10)

    @property
    def band(self) -> tuple[float, float] | None:
        """The band that a band-limited Wigner kernel keeps, None for all."""
        return self.corridor.limits if self.band_limited else None

    @property
    def ringing(self) -> float:
        """How long the ends of the record ring in the filter of a band-limited kernel; 0 without it."""
        return 0.0 if self.band is None else ringing(*self.band)

    @cached_property
    def models(self) -> SignalModels:
        """Models of the whole signal; raises InputError where there is none."""
        if self.known_models is not None:
            return self.known_models
        multiples = None if self.harmonics is None else tuple(range(2, self.harmonics + 1))
        return signal_models(self.x, self.rate, self.corridor.guide, half=self.half, multiples=multiples)

    def away_from_border(self, seconds: float) -> Mask:
        """True at samples at least ``seconds`` inside the record."""
        t = self.time - self.start
        slack = 1e-9 / self.rate
        return np.asarray((t >= seconds - slack) & (t <= t[-1] - seconds + slack), dtype=np.bool_)

    def deviation(self, of: Callable[[Level], Array], omega: Array, valid: Mask) -> Array | None:
        """What a formula gives for the amplitude and the noise along a track; None for a trial."""
        return None if self.bare else of(self.level(omega, valid))

    def level(self, omega: Array, valid: Mask) -> Level:
        """Amplitude and noise along a track."""
        return measure_level(self.x, self.rate, held(self.time, omega, valid), half=self.half)

    def settings(self, **more: object) -> dict[str, object]:
        """What every track reports, and more."""
        low, high = self.corridor.limits
        return {
            "offset_removed": self.offset,
            "rate": self.rate,
            "start": self.start,
            "band_rad": (low, high),
            "band_why": self.corridor.why,
            **({"why": self.why} if self.why else {}),
            **more,
        }


def prepared(
    x: ArrayLike,
    rate: float,
    *,
    band: tuple[float, float] | None,
    start: float,
    lag_seconds: float | None,
    smoothing_seconds: float | None,
    lag_window: str,
    harmonics: int | None,
    order: int,
    bias: bool,
    band_limited: bool = False,
    single: bool = False,
) -> Request:
    """Check a signal, take its mean off, find its corridor and set the default windows."""
    samples, rate = checked_real_samples(x, what="estimate", at_least=FEWEST_SAMPLES), checked_rate(rate)
    if not np.ptp(samples) > 0.0:
        raise InputError(f"signal is constant at {samples[0]:g}; there is no oscillation to follow")
    offset = float(checked_swing(samples).mean())
    real = samples - offset
    corridor = find_corridor(real, rate, band=band)
    cycle, span = TWO_PI / corridor.centre, (real.size - 1) / rate
    if lag_seconds is None and LAG_CYCLES * cycle > span:
        raise InputError(
            f"signal spans {span / cycle:.3g} cycles of its strongest component ({cycle:.4g} each); "
            f"{LAG_CYCLES:g} are needed (give a longer record, a band, or lag_seconds)"
        )
    return Request(
        x=real,
        z=as_analytic(real),
        rate=rate,
        start=float(start),
        corridor=corridor,
        lag_seconds=LAG_CYCLES * cycle if lag_seconds is None else lag_seconds,
        lag_given=lag_seconds is not None,
        lag_window=lag_window,
        smoothing_seconds=cycle if smoothing_seconds is None else smoothing_seconds,
        harmonics=harmonics,
        order=order,
        bias=bias,
        offset=offset,
        band_limited=band_limited,
        single=single,
    )


def refuse_cross_term(request: Request, method: str) -> None:
    """Refuse the peak of a quadratic distribution near a multiple of the strongest component, which lies outside.

    Components m and n of a signal leave a cross term at (m + n) / 2: of an oscillation's harmonics 1 and 2 h - 1, and
    h - 1 and h + 1, it falls exactly on harmonic h.
    """
    low, high = request.corridor.limits
    strongest, here = strongest_frequency(request.x, request.rate), request.corridor.centre
    h = round(here / strongest)
    if request.band_limited or h < 2 or low <= strongest <= high or abs(here / strongest - h) > NEAR_MULTIPLE * h:
        return
    raise InputError(
        f"{method}: the band {low:.4g} .. {high:.4g} lies round {h} times the strongest component at {strongest:.4g} "
        f"rad per time unit, where the cross term of harmonics 1 and {2 * h - 1} falls; use harmonic {h} with a band "
        f"round the fundamental, or band_limited, which takes the other harmonics out first"
    )


def need(valid: Mask, method: str, border: float, request: Request) -> None:
    """Refuse a track with hardly a valid sample, with what would give more of them."""
    if np.count_nonzero(valid) >= FEWEST_VALID:
        return
    advice = "give a longer record, a shorter lag_seconds or another band"
    if request.lag_seconds * request.rate < FEWEST_IN_WINDOW:
        advice = (
            f"lag_seconds {request.lag_seconds:.4g} holds only {request.lag_seconds * request.rate:.2g} steps of "
            f"{1.0 / request.rate:.4g}; give a longer one, such as {LAG_CYCLES * TWO_PI / request.corridor.centre:.4g}"
        )
    raise InputError(
        f"{method}: {np.count_nonzero(valid)} samples of {valid.size} lie {border:.4g} inside the record and have a "
        f"peak in the band; {advice}"
    )
