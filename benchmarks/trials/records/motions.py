"""Records as people have them, with known truth: a motion, what spoils its samples, and noise."""

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
