"""Kinds of recording as people have them, with known truth: what ``coverage_of_recordings.py`` counts over.

Clean decays, tails, a few cycles, quadratic drag, hum, two modes, a release and a stop, clipping, spikes, 1/f noise,
harmonics, a chirp: each as one record whose noise and phases are drawn (``KINDS``), and with frequency, damping, rate,
length and what else belongs to it drawn, too (``DRAWN``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.signal.samples import TWO_PI

OVER = 16
"""Steps of the integration of the phase per sample."""
RATE, FREQUENCY = 400.0, 20.0


@dataclass(frozen=True)
class Motion:
    """The truth at the samples: amplitude of the fundamental, frequency in rad/s, and a'/a; True where there is any."""

    amplitude: Array
    omega: Array
    growth: Array
    there: Mask


@dataclass(frozen=True)
class Record:
    """One trial."""

    x: Array
    rate: float
    motion: Motion
    noise: float


Kind = Callable[[np.random.Generator], Record]
Spoil = Callable[[Array, Array, np.random.Generator], Array]
"""What becomes of the samples: of samples, times and a source of random numbers."""


def unspoilt(x: Array, _t: Array, _rng: np.random.Generator) -> Array:
    """The samples as they are."""
    return x


def times(cycles: float, frequency: float = FREQUENCY, rate: float = RATE) -> Array:
    """Sample times of so many cycles."""
    return np.arange(round(cycles / frequency * rate)) / rate


def dragged(t: Array, linear: float, quadratic: float) -> Array:
    """a(t) of a' = -(linear + quadratic a) a from 1."""
    if quadratic == 0.0:
        return np.asarray(np.exp(-linear * t))
    return np.asarray(linear / ((linear + quadratic) * np.exp(linear * t) - quadratic))


def phase_of(omega: Callable[[Array], Array], t: Array) -> Array:
    """The integral of a frequency to each time."""
    step = (t[1] - t[0]) / OVER
    w = omega(t[0] + step * np.arange(OVER * (t.size - 1) + 1))
    return np.asarray(np.concatenate([[0.0], np.cumsum(0.5 * (w[1:] + w[:-1]) * step)])[::OVER])


@dataclass(frozen=True)
class Decay:
    """a' = -(linear + quadratic a) a, omega = TWO_PI frequency (1 + bend a^2), with harmonics that go with the motion.

    ``third`` is the amplitude of the third harmonic at a = 1, which falls with a^3; ``spoil`` changes the samples.
    """

    linear: float
    seconds: float
    quadratic: float = 0.0
    bend: float = 0.0
    third: float = 0.0
    noise: float = 0.012
    frequency: float = FREQUENCY
    rate: float = RATE
    spoil: Spoil = unspoilt

    def motion(self, t: Array) -> Motion:
        """The truth."""
        a = dragged(t, self.linear, self.quadratic)
        omega = TWO_PI * self.frequency * (1 + self.bend * a**2)
        return Motion(a, omega, -(self.linear + self.quadratic * a), np.ones(t.size, dtype=np.bool_))

    def __call__(self, rng: np.random.Generator) -> Record:
        t = np.arange(int(self.seconds * self.rate)) / self.rate
        motion = self.motion(t)
        phase = phase_of(lambda fine: self.motion(fine).omega, t) + rng.uniform(0, TWO_PI)
        clean = motion.amplitude * np.cos(phase) + self.third * motion.amplitude**3 * np.cos(3 * phase)
        x = self.spoil(clean + self.noise * rng.normal(size=t.size), t, rng)
        return Record(x, self.rate, motion, self.noise)


def damped(ratio: float, cycles: float, **more: object) -> Decay:
    """A plain damped oscillation."""
    return Decay(TWO_PI * FREQUENCY * ratio, cycles / FREQUENCY, **more)  # type: ignore[arg-type]


def hum(size: float, at: float) -> Spoil:
    """A steady tone beside the motion."""
    return lambda x, t, rng: x + size * np.cos(TWO_PI * at * t + rng.uniform(0, TWO_PI))


def second_mode(size: float, at: float, ratio: float) -> Spoil:
    """Another damped oscillation beside the motion."""

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        w = TWO_PI * at
        return np.asarray(x + size * np.exp(-ratio * w * t) * np.cos(w * t + rng.uniform(0, TWO_PI)))

    return spoiled


def bent_mode(size: float, at: float, ratio: float, bend: float) -> Spoil:
    """Another damped oscillation beside the motion, of frequency at (1 + bend a^2)."""

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        fall = ratio * TWO_PI * at
        turned = phase_of(lambda s: TWO_PI * at * (1 + bend * (size * np.exp(-fall * s)) ** 2), t)
        return np.asarray(x + size * np.exp(-fall * t) * np.cos(turned + rng.uniform(0, TWO_PI)))

    return spoiled


def spiked(x: Array, t: Array, rng: np.random.Generator) -> Array:
    """One sample in a hundred is off by up to twice the largest amplitude."""
    hit = rng.uniform(size=t.size) < 0.01
    return np.where(hit, x + rng.uniform(-2, 2, size=t.size), x)


def coloured(level: float) -> Spoil:
    """Noise with a spectrum of 1/f and this standard deviation."""

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        f = np.fft.rfftfreq(2 * t.size)
        shape = np.concatenate([[0.0], f[1:] ** -0.5])
        red = np.fft.irfft(np.fft.rfft(rng.normal(size=2 * t.size)) * shape)[: t.size]
        return np.asarray(x + level * red / red.std())

    return spoiled


def freed(
    rng: np.random.Generator, t: Array, begin: float, end: float, frequency: float, growth: float, noise: float
) -> Record:
    """Held at 1, released at one time and stopped at another."""
    there = (t >= begin) & (t < end)
    a, w = np.exp(-growth * (t - begin)), TWO_PI * frequency
    moving = np.where(t < begin, 1.0, np.where(there, a * np.cos(w * (t - begin)), 0.0))
    motion = Motion(a, np.full(t.size, w), np.full(t.size, -growth), there)
    return Record(moving + noise * rng.normal(size=t.size), 1.0 / (t[1] - t[0]), motion, noise)


def released(rng: np.random.Generator) -> Record:
    """Held at 1, released after 4 s, stopped at 40 s."""
    begin, end = rng.uniform(3.5, 4.5), rng.uniform(38.0, 41.0)
    return freed(rng, np.arange(900) / 20.0, begin, end, 0.95, 0.004, 0.003)


def struck(t: Array, begin: float, frequency: float, growth: float, noise: float, rng: np.random.Generator) -> Record:
    """Silence, then a damped oscillation."""
    there, w = t >= begin, TWO_PI * frequency
    a = np.exp(-growth * np.maximum(t - begin, 0.0))
    x = np.where(there, a * np.sin(w * (t - begin)), 0.0) + noise * rng.normal(size=t.size)
    return Record(x, 1.0 / (t[1] - t[0]), Motion(a, np.full(t.size, w), np.full(t.size, -growth), there), noise)


def triggered(rng: np.random.Generator) -> Record:
    """Silence, then a hammer's blow."""
    return struck(np.arange(1200) / RATE, rng.uniform(0.3, 0.5), FREQUENCY, 0.03 * TWO_PI * FREQUENCY, 0.01, rng)


def runaway(rng: np.random.Generator, start: float, power: float, end: float, rate: float) -> Record:
    """f = start (1 - t / end)^-power for five seconds, of constant amplitude."""
    t = np.arange(round(5.0 * rate)) / rate
    phase = TWO_PI * start * end / (1.0 - power) * (1.0 - (1.0 - t / end) ** (1.0 - power))
    x = 0.5 * np.cos(phase + rng.uniform(0, TWO_PI)) + 0.01 * rng.normal(size=t.size)
    omega, ones = TWO_PI * start * (1.0 - t / end) ** -power, np.ones(t.size)
    return Record(x, rate, Motion(0.5 * ones, omega, 0.0 * ones, ones > 0), 0.01)


def chirp(rng: np.random.Generator) -> Record:
    """f = 2 (1 - t / 5.05)^-0.6 Hz, 140 samples a second."""
    return runaway(rng, 2.0, 0.6, 5.05, 140.0)


def modulated(rng: np.random.Generator) -> Record:
    """A steady oscillation whose frequency swings by 4 %."""
    t = np.arange(1600) / 40.0
    swing, begin = TWO_PI / 12.0, rng.uniform(0, TWO_PI)
    omega = TWO_PI * 3.0 * (1.0 + 0.04 * np.cos(swing * t + begin))
    phase = TWO_PI * 3.0 * (t + 0.04 / swing * (np.sin(swing * t + begin) - np.sin(begin)))
    ones = np.ones(t.size)
    x = np.cos(phase + rng.uniform(0, TWO_PI)) + 0.05 * rng.normal(size=t.size)
    return Record(x, 40.0, Motion(ones, omega, 0.0 * ones, ones > 0), 0.05)


def struck_twice(rng: np.random.Generator) -> Record:
    """A damped oscillation that a second blow sets off again, at another phase."""
    t = np.arange(1200) / RATE
    at, g, w = rng.uniform(1.2, 1.8), 0.01 * TWO_PI * FREQUENCY, TWO_PI * FREQUENCY
    before, after = t < at, rng.uniform(0, TWO_PI)
    a = np.where(before, np.exp(-g * t), 0.8 * np.exp(-g * (t - at)))
    x = a * np.cos(w * t + np.where(before, 0.0, after)) + 0.01 * rng.normal(size=t.size)
    return Record(x, RATE, Motion(a, np.full(t.size, w), np.full(t.size, -g), t >= 0), 0.01)


def jumping(least: float, most: float) -> Kind:
    """A steady oscillation whose frequency jumps by a share between these."""

    def made(rng: np.random.Generator) -> Record:
        t = np.arange(800) / 40.0
        ratio, at = 1.0 + rng.uniform(least, most), rng.uniform(6.0, 14.0)
        omega = TWO_PI * 3.0 * np.where(t < at, 1.0, ratio)
        x = np.cos(TWO_PI * 3.0 * (np.minimum(t, at) + ratio * np.maximum(t - at, 0.0)))
        ones = np.ones(t.size)
        return Record(x + 0.01 * rng.normal(size=t.size), 40.0, Motion(ones, omega, 0.0 * ones, ones > 0), 0.01)

    return made


KINDS: dict[str, Kind] = {
    "damping ratio 0.3 %, 60 cycles": damped(0.003, 60.0),
    "damping ratio 1 %, 60 cycles": damped(0.01, 60.0),
    "damping ratio 3 %, 17 cycles": damped(0.03, 17.0),
    "damping ratio 5 %, 10 cycles": damped(0.05, 10.0),
    "damping ratio 10 %, 5 cycles": damped(0.1, 5.0),
    "damping ratio 3 %, 40 cycles: a tail": damped(0.03, 40.0),
    "damping ratio 10 %, 40 cycles: a tail": damped(0.1, 40.0),
    "damping ratio 5 %, 4 cycles": damped(0.05, 4.0),
    "damping ratio 10 %, 3.5 cycles": damped(0.1, 3.5),
    "quadratic drag": Decay(0.628, 2.0, 8.0, 0.05),
    "quadratic drag, little noise, long tail": Decay(0.628, 6.0, 8.0, 0.05, noise=0.002),
    "cubic spring with its third harmonic": Decay(0.8, 3.0, 0.0, 0.1, third=0.05, noise=0.01),
    "hum of 2 % beside the mode": Decay(0.0628, 60.0, frequency=2.0, rate=15.0, noise=0.005, spoil=hum(0.02, 2.23)),
    "hum of 20 % beside the mode": damped(0.01, 40.0, spoil=hum(0.2, 23.0)),
    "two modes 8 % apart": damped(0.004, 60.0, spoil=second_mode(0.4, 21.6, 0.004)),
    "two modes 4 % apart": damped(0.003, 80.0, spoil=second_mode(0.5, 20.8, 0.003)),
    "modes 1 : 1.99": damped(0.005, 60.0, spoil=second_mode(0.5, 39.8, 0.004)),
    "held, released, stopped": released,
    "silence before a blow": triggered,
    "clipped at 60 %": Decay(
        0.0628, 40.0, 0.0, 0.05, frequency=2.0, rate=20.0, noise=0.004, spoil=lambda x, _t, _rng: np.clip(x, -0.6, 0.6)
    ),
    "spikes": damped(0.01, 40.0, spoil=spiked),
    "1/f noise": damped(0.01, 40.0, noise=0.001, spoil=coloured(0.03)),
    "a chirp that rises to six times": chirp,
    "a swinging frequency": modulated,
    "struck twice": struck_twice,
    "a frequency that jumps": jumping(0.03, 0.33),
    "a frequency that jumps a little": jumping(0.002, 0.03),
    "two modes 2 % apart": damped(0.003, 120.0, spoil=second_mode(0.5, 20.4, 0.003)),
    "two modes, one not linear": damped(0.006, 60.0, spoil=bent_mode(0.4, 26.0, 0.006, 0.3)),
    "hum at twice the frequency": damped(0.01, 40.0, spoil=hum(0.1, 40.0)),
    "three modes": damped(
        0.006,
        40.0,
        spoil=lambda x, t, rng: second_mode(0.3, 17.0, 0.005)(second_mode(0.5, 24.0, 0.005)(x, t, rng), t, rng),
    ),
    "damping ratio 15 %, 4 cycles": damped(0.15, 4.0),
    "damping ratio 1 %, strong noise": damped(0.01, 60.0, noise=0.1),
}


def drawn(make: Callable[[np.random.Generator], Kind]) -> Kind:
    """A kind whose parameters are drawn anew in each trial."""
    return lambda rng: make(rng)(rng)


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number between these whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def any_decay(
    rng: np.random.Generator,
    ratio: float,
    cycles: float,
    spoil: Spoil = unspoilt,
    noise: float | None = None,
    frequency: float | None = None,
    bend: float = 0.0,
) -> Decay:
    """A damped oscillation of 0.5 to 200 Hz with 9 to 40 samples a cycle and noise of 0.2 to 2.5 %."""
    f = frequency or rng.uniform(0.5, 200.0)
    level = noise or log_uniform(rng, 0.002, 0.025)
    return Decay(
        TWO_PI * f * ratio,
        cycles / f,
        bend=bend,
        noise=level,
        frequency=f,
        rate=f * rng.uniform(9.0, 40.0),
        spoil=spoil,
    )


def any_drag(rng: np.random.Generator) -> Decay:
    """Quadratic beside viscous drag, over up to 80 cycles."""
    f = rng.uniform(1.0, 50.0)
    return Decay(
        6.0 * f * rng.uniform(0.005, 0.03),
        rng.uniform(20.0, 80.0) / f,
        quadratic=f * rng.uniform(0.05, 0.5),
        bend=rng.uniform(-0.08, 0.08),
        third=rng.uniform(-0.03, 0.03),
        noise=log_uniform(rng, 0.001, 0.01),
        frequency=f,
        rate=f * rng.uniform(12.0, 30.0),
    )


def beside_mains(mains: float, frequency: float, size: float) -> Kind:
    """A mode within 1 % of a frequency beside a steady tone."""
    return drawn(
        lambda rng: any_decay(
            rng,
            rng.uniform(0.003, 0.01),
            rng.uniform(30.0, 80.0),
            hum(size, mains),
            noise=0.005,
            frequency=frequency * rng.uniform(0.99, 1.01),
        )
    )


def any_outlasted(rng: np.random.Generator) -> Kind:
    """A mode beside a hum of 1 to 10 % that lasts when the mode is gone."""
    f, off = rng.uniform(2.0, 60.0), rng.uniform(0.05, 0.2) * rng.choice([-1, 1])
    spoil = hum(rng.uniform(0.01, 0.1), f * (1.0 + off))
    noise = rng.uniform(0.001, 0.006)
    return any_decay(rng, rng.uniform(0.02, 0.08), rng.uniform(15.0, 40.0), spoil, noise=noise, frequency=f)


def any_pair(apart: float) -> Kind:
    """Two modes so far apart, over 2.5 to 5 of their beats."""

    def made(rng: np.random.Generator) -> Kind:
        f, ratio = rng.uniform(2.0, 80.0), apart * rng.uniform(0.03, 0.08)
        other = second_mode(
            rng.uniform(0.2, 0.6), f * (1.0 + apart * rng.choice([-1, 1])), ratio * rng.uniform(0.6, 1.6)
        )
        return any_decay(rng, ratio, rng.uniform(2.5, 5.0) / apart, other, noise=0.01, frequency=f)

    return drawn(made)


def any_octave(rng: np.random.Generator) -> Kind:
    """Two modes near 1 : 2."""
    f = rng.uniform(2.0, 120.0)
    other = second_mode(rng.uniform(0.2, 0.6), f * rng.uniform(1.95, 2.05), rng.uniform(0.003, 0.008))
    return any_decay(rng, rng.uniform(0.003, 0.008), rng.uniform(40.0, 80.0), other, noise=0.008, frequency=f)


def any_release(rng: np.random.Generator) -> Record:
    """Held, released, stopped."""
    f = rng.uniform(0.5, 5.0)
    seconds, rate, noise = 50.0 / f, f * rng.uniform(15.0, 30.0), log_uniform(rng, 0.002, 0.01)
    begin, end = seconds * rng.uniform(0.08, 0.2), seconds * rng.uniform(0.8, 0.95)
    return freed(
        rng, np.arange(int(seconds * rate)) / rate, begin, end, f, rng.uniform(0.001, 0.01) * TWO_PI * f, noise
    )


def any_blow(rng: np.random.Generator) -> Record:
    """Silence, then a hammer's blow."""
    f = rng.uniform(5.0, 100.0)
    rate, growth = f * rng.uniform(12.0, 30.0), rng.uniform(0.004, 0.05) * TWO_PI * f
    t = np.arange(int(rng.uniform(20.0, 60.0) / f * rate)) / rate
    return struck(t, t[-1] * rng.uniform(0.1, 0.25), f, growth, log_uniform(rng, 0.003, 0.02), rng)


def any_chirp(rng: np.random.Generator) -> Record:
    """f (1 - t / T)^-p for five seconds, up to eight times the frequency at the start."""
    return runaway(
        rng, rng.uniform(1.5, 3.0), rng.uniform(0.4, 0.8), 5.0 * rng.uniform(1.01, 1.04), rng.uniform(100, 200)
    )


def any_clipped(rng: np.random.Generator) -> Kind:
    """Clipped at 40 to 80 % of the largest amplitude."""
    at = rng.uniform(0.4, 0.8)
    ratio, cycles, bend = rng.uniform(0.003, 0.01), rng.uniform(25.0, 60.0), rng.uniform(-0.05, 0.05)
    return any_decay(rng, ratio, cycles, lambda x, _t, _rng: np.clip(x, -at, at), noise=0.004, bend=bend)


def any_red(rng: np.random.Generator) -> Kind:
    """1/f noise of 1 to 6 %."""
    return any_decay(rng, rng.uniform(0.004, 0.02), rng.uniform(25, 60), coloured(rng.uniform(0.01, 0.06)), noise=0.001)


def any_dying_mode(rng: np.random.Generator) -> Kind:
    """A second mode 5 to 60 % above, which a damping ratio of 5 to 30 % ends within a few cycles."""
    f = rng.uniform(0.5, 200.0)
    other = second_mode(rng.uniform(0.3, 0.5), f * rng.uniform(1.05, 1.6), rng.uniform(0.05, 0.3))
    ratio, cycles, noise = log_uniform(rng, 0.001, 0.01), rng.uniform(10.0, 50.0), log_uniform(rng, 1e-4, 1e-2)
    return any_decay(rng, ratio, cycles, other, noise, f)


# F. J. Richards, J. Exp. Bot. 10 (1959) 290: a^p = 1 - (1 - a_0^p) e^(-k t); p = -2 is Landau's equation.
def any_swell(rng: np.random.Generator) -> Record:
    """A swell from 2 to 95 % within 3 to 6 cycles, in three forms, then a decay."""
    f, p = rng.uniform(0.5, 200.0), float(rng.choice([1.0, -1.0, -2.0]))
    t = np.arange(round(rng.uniform(20.0, 60.0) * (per_cycle := rng.uniform(9.0, 40.0)))) / (f * per_cycle)
    lack = 0.02**p - 1.0
    k, fall = f / rng.uniform(3.0, 6.0) * np.log(lack / (0.95**p - 1.0)), TWO_PI * f * rng.uniform(0.002, 0.015)
    left = lack * np.exp(-k * t)
    a, growth = (1.0 + left) ** (1.0 / p) * np.exp(-fall * t), -k / p * left / (1.0 + left) - fall
    noise = log_uniform(rng, 0.002, 0.02) * float(a.max())
    x = a * np.cos(TWO_PI * f * t + rng.uniform(0, TWO_PI)) + noise * rng.normal(size=t.size)
    return Record(x, f * per_cycle, Motion(a, np.full(t.size, TWO_PI * f), growth, t >= 0), noise)


def any_hum_near_a_harmonic(rng: np.random.Generator) -> Kind:
    """Mains hum of 1 to 8 % within 1 to 6 % of a harmonic of the mode, which is not in the motion."""
    mains, multiple = rng.choice([50.0, 60.0]), rng.integers(2, 4)
    f = mains / multiple * (1.0 + rng.choice([-1, 1]) * rng.uniform(0.01, 0.06))
    size, noise = log_uniform(rng, 0.01, 0.08), log_uniform(rng, 0.005, 0.01)
    return any_decay(rng, rng.uniform(0.003, 0.015), rng.uniform(40.0, 120.0), hum(size, mains), noise, f)


def any_drift(rng: np.random.Generator) -> Kind:
    """A straight or an exponential drift of one to ten times the amplitude beneath."""
    level, rate = rng.choice([-1.0, 1.0]) * log_uniform(rng, 1.0, 10.0), rng.uniform(1.0, 5.0)

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        u = t / t[-1]
        return np.asarray(x + level * (u if rng.uniform() < 0.5 else np.exp(-rate * u)))

    return any_decay(rng, rng.uniform(0.003, 0.02), rng.uniform(20.0, 60.0), spoiled)


def any_tone_out_of_the_band(rng: np.random.Generator) -> Kind:
    """A steady tone, or a mode, of 2 to 10 % at 1.4 to 4.4 times the frequency."""
    f, ratio, size = rng.uniform(5.0, 100.0), rng.uniform(1.4, 4.4), log_uniform(rng, 0.02, 0.1)
    other = hum(size, f * ratio) if rng.uniform() < 0.5 else second_mode(size, f * ratio, rng.uniform(0.003, 0.01))
    return any_decay(rng, rng.uniform(0.003, 0.015), rng.uniform(40.0, 120.0), other, log_uniform(rng, 0.003, 0.01), f)


DRAWN: dict[str, Kind] = {
    "3 to 5 cycles, damping ratio 0.3 to 15 %": drawn(
        lambda rng: any_decay(rng, log_uniform(rng, 0.003, 0.15), rng.uniform(3.2, 5.0))
    ),
    "6 to 60 cycles, damping ratio 0.3 to 10 %": drawn(
        lambda rng: any_decay(rng, log_uniform(rng, 0.003, 0.1), rng.uniform(6.0, 60.0))
    ),
    "quadratic drag": drawn(any_drag),
    "hum of 1 % at 50 Hz beside 46 Hz": beside_mains(50.0, 46.0, 0.01),
    "hum of 10 % at 50 Hz beside 47.5 Hz": beside_mains(50.0, 47.5, 0.1),
    "hum of 5 % at 60 Hz beside 66 Hz": beside_mains(60.0, 66.0, 0.05),
    "hum of 40 % at 60 Hz beside 57 Hz": beside_mains(60.0, 57.0, 0.4),
    "a hum of 1 to 10 % that outlasts the mode": drawn(any_outlasted),
    "two modes 2 % apart": any_pair(0.02),
    "two modes 3 % apart": any_pair(0.03),
    "two modes 5 % apart": any_pair(0.05),
    "two modes 10 % apart": any_pair(0.1),
    "two modes 1 : 1.95 to 2.05": drawn(any_octave),
    "held, released, stopped": any_release,
    "silence before a blow": any_blow,
    "spikes": drawn(lambda rng: any_decay(rng, rng.uniform(0.003, 0.03), rng.uniform(15.0, 50.0), spiked)),
    "clipped": drawn(any_clipped),
    "1/f noise": drawn(any_red),
    "a chirp that runs away": any_chirp,
    "a mode beside that dies in a few cycles": drawn(any_dying_mode),
    "a swell from 2 % within 3 to 6 cycles": any_swell,
    "drift beneath": drawn(any_drift),
    "hum near a harmonic": drawn(any_hum_near_a_harmonic),
    "a tone out of the band": drawn(any_tone_out_of_the_band),
}
"""Each trial draws its parameters, too."""
