"""What every estimator is given: what the caller asked for, what the data gave, and what was resolved from both."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray, Mask
from ridgeback.numeric.components.beyond import is_in, tones_beyond
from ridgeback.numeric.components.modulation import Swing
from ridgeback.numeric.components.separation import MOST_TONES, separated_once
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.harmonics.noise import Level, measure_level
from ridgeback.numeric.harmonics.signal_model import SignalModels, models_once
from ridgeback.numeric.signal.analytic import analytic_of
from ridgeback.numeric.signal.band_limit import ringing
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.presence import Presence, presence
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import SearchBand, checked_band, find_search_band, strongest_frequency
from ridgeback.numeric.signal.spikes import without_isolated
from ridgeback.numeric.signal.windows import half_width
from ridgeback.numeric.tracking.choices import Choices, Held, Scope
from ridgeback.numeric.tracking.curvature_bias import hold_nearest

FEWEST_SAMPLES = 16
FEWEST_VALID = 8
FEWEST_IN_WINDOW = 4.0
"""Steps of the samples that a lag window must span before a shorter one could be the remedy."""
NEAR_MULTIPLE = 0.05
"""Relative distance within which a frequency counts as a multiple of another."""
LAG_CYCLES = 4.0
"""Default window, in cycles of the strongest component: 3 s for the paper's pendulum."""
FEWEST_CYCLES = 2.6
"""That a record must hold, where no window is asked for: fewer are not told from drift, at the band's lower end."""
SHORT_SHARE, SHORT_CYCLES = 0.6, 2.0
"""Of a short record the default window takes this share, but so many cycles."""


@dataclass(frozen=True)
class Options:
    """What the caller asks for; None leaves it to the data.  The words are those of ``estimate``."""

    band: tuple[float, float] | None = None
    lag_seconds: float | None = None
    lag_window: str = "blackman"
    smoothing_seconds: float | None = None
    harmonics: int | None = None
    order: int = 6
    scope: Scope | None = None
    band_limited: bool = False
    single: bool = False
    bias: bool = True
    components: int | None = None
    """Oscillations to tell apart; None for those that the samples show."""
    shared: float = 1.0
    """Variance of the oscillation's parameters beside components that are off the samples, over that without them."""
    deviations: bool = True
    """Whether what noise does to a track is found, which takes about as long as the track itself."""

    @property
    def most_tones(self) -> int:
        """Tones to look for beside the oscillation: more than are asked for, too, lest they disturb it."""
        if self.components == 1:
            return 0
        return MOST_TONES if self.components is None else max(MOST_TONES, self.components - 1)

    @property
    def given(self) -> list[str]:
        """Names of the settings that differ from their defaults."""
        return [
            item.name
            for item in fields(self)
            if getattr(self, item.name) != item.default and item.name not in ("deviations", "shared")
        ]

    @property
    def multiples(self) -> tuple[int, ...] | None:
        """The harmonics to fit beside the fundamental, None for those that the data show."""
        return None if self.harmonics is None else tuple(range(2, self.harmonics + 1))


@dataclass(frozen=True)
class Signal:
    """What the data gave: samples without their mean, their analytic signal, where the fundamental is looked for."""

    x: Array
    z: ComplexArray
    rate: float
    start: float
    offset: float
    search: SearchBand
    factor: int = 1
    """Samples of the record behind each of these."""
    wrong: Mask | None = None
    """Samples that are known to be no part of the motion."""
    tones: tuple[Tone, ...] = ()
    """What was found beside the oscillation and is off the samples."""
    spikes: int = 0
    span_why: tuple[Held, ...] = ()
    """What holds of these samples and not of the rest of the record."""
    doubt: str = ""
    """Why no model of the samples can be trusted, if so."""
    swing: Swing | None = None
    """How the oscillation swings, if it is one that does."""

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.start + np.arange(self.x.size) / self.rate

    @property
    def cycle(self) -> float:
        """The longest period that the search band's guide shows."""
        return TWO_PI / float(self.search.guide.min())


@dataclass(frozen=True)
class Plan:
    """What was resolved: windows, scope, and what a trial is to take over from the track it is a trial of."""

    lag_seconds: float
    smoothing_seconds: float
    scope: Scope = Scope.LOCAL
    phase_degree: int | None = None
    why: str = ""
    """Reason for what was chosen from the data, for display."""
    trial: bool = False
    """Only the values are wanted, without a deviation: to be run many times."""
    multiples: tuple[int, ...] | None = None
    """Harmonics to fit beside the fundamental."""
    hysteresis: float | None = None
    """Of zero crossings."""


@dataclass(frozen=True)
class Request:
    """What an estimator needs to know, checked."""

    options: Options
    signal: Signal
    plan: Plan
    known_models: SignalModels | None = None
    """Models of the whole signal where they have been fitted; those of the track's own signal, for a trial."""

    def on(self, x: Array) -> Request:
        """The same request for other samples, of which only the values are wanted."""
        return replace(self, signal=replace(self.signal, x=x, z=analytic_of(x)), plan=replace(self.plan, trial=True))

    def like(self, used: Choices) -> Request:
        """The same request with what a track chose from the data fixed: for trials of that track's estimator."""
        multiples = used.harmonics[1:] if used.harmonics else None
        plan = replace(self.plan, multiples=multiples, hysteresis=used.hysteresis)
        return replace(self, plan=plan, known_models=self.models)

    @cached_property
    def presence(self) -> Presence:
        """Whether an oscillation stands out of the noise in the search band."""
        limits, found = self.signal.search.limits, self.options.band is None
        return presence(self.signal.x, self.signal.rate, limits=limits, whole=found)

    @property
    def half(self) -> int:
        """Half the lag window, in samples."""
        return half_width(self.plan.lag_seconds, self.signal.rate, name="--lag", longest=self.signal.x.size)

    @property
    def lag_given(self) -> bool:
        """Whether the window was asked for, or is the default that a method may change."""
        return self.options.lag_seconds is not None

    @property
    def margin(self) -> int:
        """Samples at each end that expected errors leave out: half the default window, or a tenth of the record."""
        return min(round(0.5 * LAG_CYCLES * self.signal.cycle * self.signal.rate), self.signal.x.size // 10)

    @property
    def band(self) -> tuple[float, float] | None:
        """The band that a band-limited Wigner kernel keeps, None for all."""
        return self.signal.search.limits if self.options.band_limited else None

    @property
    def ringing(self) -> float:
        """How long the ends of the record ring in the filter of a band-limited kernel; 0 without it."""
        return 0.0 if self.band is None else ringing(*self.band)

    def separated(self) -> Request:
        """The request for one oscillation alone, with models of it; unchanged where no model of it settles."""
        signal = self.signal
        try:
            found = separated_once(
                (signal.x + total(signal.tones, signal.time - signal.start)).tobytes(),
                signal.rate,
                signal.search.guide.tobytes(),
                self.half,
                self.options.multiples,
                None if signal.wrong is None else signal.wrong.tobytes(),
                self.options.most_tones,
                self.options.band,
                signal.tones,
                self.options.shared,
                signal.start,
            )
        except InputError:
            return self
        # where no model of the oscillation can be trusted, a tone that was found beside it cannot
        tones = found.tones if not found.reason else tuple(filter(self.stays_off, found.tones))
        back = tuple(tone for tone in found.tones if tone not in tones)
        x = found.x + total(back, signal.time - signal.start)
        swing = None if found.reason else found.swing
        alone = replace(
            signal, x=x, z=analytic_of(x), tones=tones, spikes=found.spikes, doubt=found.reason, swing=swing
        )
        return replace(self, signal=alone, known_models=found.models)

    def stays_off(self, tone: Tone) -> bool:
        """Whether a tone stays off the samples whatever holds of the oscillation: hum, and what is beyond a band."""
        band = self.options.band
        return tone.mains or (band is not None and not is_in(tone.omega, band))

    @cached_property
    def models(self) -> SignalModels:
        """Models of the whole signal; raises InputError where there is none."""
        if self.known_models is not None:
            return self.known_models
        signal = self.signal
        guide = signal.search.guide
        return models_once(signal.x.tobytes(), signal.rate, guide.tobytes(), self.half, self.options.multiples)

    def away_from_border(self, seconds: float) -> Mask:
        """True at samples at least ``seconds`` inside the record."""
        t = self.signal.time - self.signal.start
        slack = 1e-9 / self.signal.rate
        return np.asarray((t >= seconds - slack) & (t <= t[-1] - seconds + slack), dtype=np.bool_)

    def deviation(self, of: Callable[[Level], Array], omega: Array, valid: Mask) -> Array | None:
        """What a formula gives for the amplitude and the noise along a track; None where it is not wanted."""
        wanted = self.options.deviations and not self.plan.trial
        return of(self.level(omega, valid)) if wanted else None

    def level(self, omega: Array, valid: Mask) -> Level:
        """Amplitude and noise along a track."""
        signal = self.signal
        return measure_level(signal.x, signal.rate, hold_nearest(signal.time, omega, valid), half=self.half)

    @property
    def used(self) -> Choices:
        """What every track was made with; each method adds its own."""
        signal = self.signal
        return Choices(
            start=signal.start,
            decimated_by=signal.factor,
            tones=signal.tones,
            spikes=signal.spikes,
            doubt=signal.doubt,
            swing=signal.swing,
            why=self.plan.why,
        )

    def details(self, **more: object) -> dict[str, object]:
        """What every track shows beside that, and more."""
        signal = self.signal
        given = {"rate_given": signal.rate * signal.factor} if signal.factor > 1 else {}
        return {
            "offset_removed": signal.offset,
            "rate": signal.rate,
            **given,
            "band_rad": signal.search.limits,
            "band_why": signal.search.why,
            **({"components": [tone.row() for tone in signal.tones]} if signal.tones else {}),
            **more,
        }


def prepared(samples: Samples, options: Options, *, search: SearchBand | None = None) -> Request:
    """Take the mean off checked samples, find their search band (unless it is known) and set the default windows.

    Where a band is asked for, what is stronger beyond it is taken off first.
    """
    if not np.ptp(samples.x) > 0.0:
        raise InputError(f"signal is constant at {samples.x[0]:g}; there is no oscillation to follow")
    offset = float(samples.x.mean())
    real = samples.x - offset
    beyond = beyond_band(real, samples, options.band)
    if beyond:
        real = real - total(beyond, np.arange(real.size) / samples.rate)
    if search is None or beyond:
        search = find_search_band(without_isolated(real)[0], samples.rate, band=up_to_nyquist(options.band, samples))
    cycle, span = TWO_PI / search.centre, real.size / samples.rate
    if options.lag_seconds is None and FEWEST_CYCLES * cycle > span:
        slow = "another --band" if options.band else "a --band round a faster oscillation"
        drift = "" if options.band else "take a drift off (--detrend linear), "
        raise InputError(
            f"signal spans {span / cycle:.3g} cycles of its strongest component ({cycle:.4g} each); {FEWEST_CYCLES:g} "
            f"are needed: give a longer record, {drift}or {slow}"
        )
    for name, seconds in (("--lag", options.lag_seconds), ("--smoothing", options.smoothing_seconds)):
        if seconds is not None:
            half_width(seconds, samples.rate, name=name, longest=real.size)
    lag = min(LAG_CYCLES * cycle, max(SHORT_CYCLES * cycle, SHORT_SHARE * span))
    signal = Signal(real, analytic_of(real), samples.rate, samples.start, offset, search, samples.factor, samples.wrong)
    signal = replace(signal, tones=beyond)
    plan = Plan(
        lag_seconds=lag if options.lag_seconds is None else options.lag_seconds,
        smoothing_seconds=cycle if options.smoothing_seconds is None else options.smoothing_seconds,
    )
    return Request(options, signal, plan)


def up_to_nyquist(band: tuple[float, float] | None, samples: Samples) -> tuple[float, float] | None:
    """A band of a record, for what decimation left of it."""
    return band if band is None or samples.factor < 2 else (band[0], min(band[1], math.pi * samples.rate))


def beyond_band(x: Array, samples: Samples, band: tuple[float, float] | None) -> tuple[Tone, ...]:
    """Tones beyond a band that was asked for, which are to be taken off the samples."""
    here, sound = up_to_nyquist(band, samples), None if samples.wrong is None else ~samples.wrong
    return () if here is None else tones_beyond(x, samples.rate, checked_band(here, samples.rate), sound)


def refuse_cross_term(request: Request, method: str) -> None:
    """Refuse the peak of a quadratic distribution near a multiple of the strongest component, which lies outside.

    Components m and n of a signal leave a cross term at (m + n) / 2: of an oscillation's harmonics 1 and 2 h - 1, and
    h - 1 and h + 1, it falls exactly on harmonic h.
    """
    signal = request.signal
    low, high = signal.search.limits
    strongest, here = strongest_frequency(signal.x, signal.rate), signal.search.centre
    h = round(here / strongest)
    off = abs(here / strongest - h)
    if request.options.band_limited or h < 2 or low <= strongest <= high or off > NEAR_MULTIPLE * h:
        return
    raise InputError(
        f"{method}: the band {low:.4g} .. {high:.4g} lies round {h} times the strongest component at {strongest:.4g} "
        f"rad per time unit, where the cross term of harmonics 1 and {2 * h - 1} falls; use --harmonic {h} with a "
        f"--band round the fundamental, or --band-limited, which takes the other harmonics out first"
    )


def check_valid(valid: Mask, method: str, border: float, request: Request) -> None:
    """Refuse a track with hardly a valid sample, with what would give more of them."""
    if np.count_nonzero(valid) >= FEWEST_VALID:
        return
    seconds, rate = request.plan.lag_seconds, request.signal.rate
    shorter = ", a shorter --lag" if request.lag_given else ""
    advice = f"give a longer record{shorter} or another --band"
    if request.lag_given and seconds * rate < FEWEST_IN_WINDOW:
        advice = (
            f"--lag {seconds:.4g} holds only {seconds * rate:.2g} steps of {1.0 / rate:.4g}; give a longer one, "
            f"such as {LAG_CYCLES * TWO_PI / request.signal.search.centre:.4g}"
        )
    raise InputError(
        f"{method}: {np.count_nonzero(valid)} samples of {valid.size} lie {border:.4g} inside the record and have a "
        f"peak in the band; {advice}"
    )
