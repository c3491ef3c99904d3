"""Kinds of record whose frequency, damping, rate, length and what else belongs to them are drawn in each trial."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from benchmarks.trials.records.motions import (
    Decay,
    Kind,
    Motion,
    Record,
    Spoil,
    coloured,
    freed,
    hum,
    runaway,
    second_mode,
    spiked,
    struck,
    unspoilt,
)
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.signal.samples import TWO_PI


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


def any_overlapping(rng: np.random.Generator) -> Kind:
    """Two modes apart by half to twice the mean of their growth rates."""
    f, ratio = rng.uniform(2.0, 80.0), log_uniform(rng, 0.005, 0.03)
    second = ratio * rng.uniform(0.6, 1.6)
    apart = 0.5 * (ratio + second) * rng.uniform(0.5, 2.0) * rng.choice([-1, 1])
    other = second_mode(rng.uniform(0.2, 0.6), f * (1.0 + apart), second)
    return any_decay(rng, ratio, rng.uniform(0.5, 1.0) / ratio, other, log_uniform(rng, 0.002, 0.02), f)


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
    "two modes apart by half to twice their damping": drawn(any_overlapping),
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
