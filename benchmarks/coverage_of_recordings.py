"""How often the 95 % intervals hold on recordings as people have them: ``python benchmarks/coverage_of_recordings.py``.

Seeded trials of kinds of record: clean decays, tails, a few cycles, quadratic drag, hum, two modes, a release and a
stop, clipping, spikes, 1/f noise, harmonics, a chirp.  A row of the table that it prints is a kind: the share of the
intervals of growth rate, amplitude and frequency that hold the truth; the share of the samples whose amplitude stands
above the noise for which they are claimed; the trials in which nothing is claimed; and the reason that is given then.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.stats import beta

from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import measure
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.samples import TWO_PI

NORMAL_95 = 1.96
LIMITS = 92.0, 98.0
"""Where the share that holds is to lie, in per cent."""
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
    spoil: Callable[[Array, Array, np.random.Generator], Array] = field(default=lambda x, _t, _rng: x)

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


def hum(size: float, at: float) -> Callable[[Array, Array, np.random.Generator], Array]:
    """A steady tone beside the motion."""
    return lambda x, t, rng: x + size * np.cos(TWO_PI * at * t + rng.uniform(0, TWO_PI))


def second_mode(size: float, at: float, ratio: float) -> Callable[[Array, Array, np.random.Generator], Array]:
    """Another damped oscillation beside the motion."""

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        w = TWO_PI * at
        return np.asarray(x + size * np.exp(-ratio * w * t) * np.cos(w * t + rng.uniform(0, TWO_PI)))

    return spoiled


def bent_mode(
    size: float, at: float, ratio: float, bend: float
) -> Callable[[Array, Array, np.random.Generator], Array]:
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


def coloured(level: float) -> Callable[[Array, Array, np.random.Generator], Array]:
    """Noise with a spectrum of 1/f and this standard deviation."""

    def spoiled(x: Array, t: Array, rng: np.random.Generator) -> Array:
        f = np.fft.rfftfreq(2 * t.size)
        shape = np.concatenate([[0.0], f[1:] ** -0.5])
        red = np.fft.irfft(np.fft.rfft(rng.normal(size=2 * t.size)) * shape)[: t.size]
        return np.asarray(x + level * red / red.std())

    return spoiled


def released(rng: np.random.Generator) -> Record:
    """Held at 1, released after 4 s, stopped at 40 s."""
    t = np.arange(900) / 20.0
    begin, end = rng.uniform(3.5, 4.5), rng.uniform(38.0, 41.0)
    there = (t >= begin) & (t < end)
    a, w = np.exp(-0.004 * (t - begin)), TWO_PI * 0.95
    moving = np.where(t < begin, 1.0, np.where(there, a * np.cos(w * (t - begin)), 0.0))
    motion = Motion(a, np.full(t.size, w), np.full(t.size, -0.004), there)
    return Record(moving + 0.003 * rng.normal(size=t.size), 20.0, motion, 0.003)


def triggered(rng: np.random.Generator) -> Record:
    """Silence, then a hammer's blow."""
    t = np.arange(1200) / RATE
    begin = rng.uniform(0.3, 0.5)
    there = t >= begin
    g, w = 0.03 * TWO_PI * FREQUENCY, TWO_PI * FREQUENCY
    a = np.exp(-g * np.maximum(t - begin, 0.0))
    x = np.where(there, a * np.sin(w * (t - begin)), 0.0) + 0.01 * rng.normal(size=t.size)
    return Record(x, RATE, Motion(a, np.full(t.size, w), np.full(t.size, -g), there), 0.01)


def chirp(rng: np.random.Generator) -> Record:
    """f = 2 (1 - t / 5.05)^-0.6 Hz, of constant amplitude, 140 samples a second."""
    t = np.arange(700) / 140.0
    phase = TWO_PI * 2.0 * 5.05 / 0.4 * (1.0 - (1.0 - t / 5.05) ** 0.4)
    x = 0.5 * np.cos(phase + rng.uniform(0, TWO_PI)) + 0.01 * rng.normal(size=t.size)
    omega = TWO_PI * 2.0 * (1.0 - t / 5.05) ** -0.6
    ones = np.ones(t.size)
    return Record(x, 140.0, Motion(0.5 * ones, omega, 0.0 * ones, ones > 0), 0.01)


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


@dataclass(frozen=True)
class Outcome:
    """Whether intervals hold in one trial: growth rate, amplitude, frequency; the claimed share; why there is none."""

    growth: Mask
    amplitude: Mask
    omega: Mask
    claimed: float
    reason: str = ""


NOTHING = np.zeros(0, dtype=np.bool_)


def trial(kind: Kind, seed: int) -> Outcome:
    """One record, measured as the command does."""
    record = kind(np.random.default_rng(seed))
    t = np.arange(record.x.size) / record.rate
    above = record.motion.there & (record.motion.amplitude > record.noise)
    try:
        found = measure(Recording.from_arrays(record.x, record.rate))
    except InputError as error:
        return Outcome(NOTHING, NOTHING, NOTHING, 0.0, str(error))
    track, curve = found.track, found.backbone
    if track is None or track.interval is None or curve is None:
        why = "" if track is None else track.no_interval
        return Outcome(NOTHING, NOTHING, NOTHING, 0.0, why or found.notes[-1])
    motion = record.motion
    held = track.interval.holds(np.interp(track.time, t, motion.omega))[track.valid]
    near = np.abs(t[:, None] - curve.time).min(axis=1) <= np.median(np.diff(curve.time))
    valid = np.interp(t, track.time, track.valid, left=0.0, right=0.0) > 0.5
    size = within(curve.amplitude, curve.amplitude_sd, np.interp(curve.time, t, motion.amplitude))
    rise = np.interp(curve.time, t, motion.growth)
    growth = within(curve.growth_rate, curve.growth_rate_sd, rise)
    if np.ptp(motion.amplitude) > 0.01:
        order = np.argsort(motion.amplitude)
        on_curve = np.interp(curve.curve_amplitude, motion.amplitude[order], motion.growth[order])
        growth = within(curve.curve_growth_rate, curve.curve_growth_rate_sd, on_curve)
    return Outcome(growth, size, held, float(np.mean((near & valid)[above])))


def within(values: Array, deviations: Array, truth: Array) -> Mask:
    """Which 95 % intervals hold the truth."""
    return np.asarray(np.abs(values - truth) <= NORMAL_95 * deviations)


def hold(masks: list[Mask]) -> tuple[float, float, float]:
    """The share that holds, and between which shares the true one lies at 95 %.

    Neighbouring samples of a trial share their error, so that the trials are the independent draws: n is taken as
    p (1 - p) / s^2, with s the standard error of the share over trials, in the exact interval of Clopper and Pearson
    (Korn and Graubard 1998, Survey Methodology 24, 193, without their allowance for few trials, 4 % of n for 60).
    """
    counts = np.array([one.size for one in masks], dtype=float)
    held = np.array([one.sum() for one in masks], dtype=float)
    p = float(held.sum() / counts.sum())
    trials = counts.size
    spread = np.sqrt(trials / max(trials - 1, 1) * np.sum((held - p * counts) ** 2)) / counts.sum()
    n = min(p * (1 - p) / spread**2, counts.sum()) if spread > 0.0 else float(trials)
    low = beta.ppf(0.025, p * n, n - p * n + 1) if p > 0.0 else 0.0
    high = beta.ppf(0.975, p * n + 1, n - p * n) if p < 1.0 else 1.0
    return p, float(low), float(high)


def cell(masks: list[Mask]) -> str:
    """A share with its interval, in bold where the interval does not meet 92 to 98 %."""
    masks = [one for one in masks if one.size]
    if not masks:
        return "none"
    share, low, high = (100 * value for value in hold(masks))
    text = f"{share:.0f} ({low:.0f} to {high:.0f})"
    return text if low <= LIMITS[1] and high >= LIMITS[0] else f"**{text}**"


def row(name: str, kind: Kind, trials: int, seed: int) -> str:
    """A row of the table."""
    found = [trial(kind, seed + k) for k in range(trials)]
    claiming = [one for one in found if not one.reason]
    claimed = f"{100 * np.mean([one.claimed for one in found]):.0f}"
    reasons = Counter(one.reason[:90] for one in found if one.reason)
    why = "; ".join(f"{text} ({count})" for text, count in reasons.most_common(1))
    cells = (cell([getattr(one, of) for one in claiming]) for of in ("growth", "amplitude", "omega"))
    return f"| {name} | {trials} | {' | '.join(cells)} | {claimed} | {len(found) - len(claiming)} | {why} |"


def main() -> None:
    """Read the options, run, print a row as soon as it is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="kinds with this in their name")
    given = parser.parse_args()
    sys.stdout.write("| record | trials | a'/a, % | a, % | omega, % | claimed, % | without | reason |\n")
    sys.stdout.write(f"{'|---' * 8}|\n")
    for name, kind in KINDS.items():
        if given.only in name:
            sys.stdout.write(row(name, kind, given.trials, given.seed) + "\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
