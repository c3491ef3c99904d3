"""Samples on a uniform grid: as they are where the stamps allow it, else interpolated, with the error estimated.

A stamp may leave the grid by JITTER of a step: decimal rounding.  Beyond it the samples are interpolated by a spline
of degree five through all of them (scipy's), and its difference from the cubic one, which is the less exact, is stated
as the error.  Steps that vary by more than EASY, or an error above TOLERANCE, need to be asked for.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.fft import rfft
from scipy.interpolate import make_interp_spline

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.late import signal
from ridgeback.numeric.recording.stretches import Stamped
from ridgeback.numeric.signal.samples import checked_work

JITTER = 0.02
"""Share of the step by which a time stamp may leave the uniform grid: decimal rounding."""
EASY = 0.1
"""Share of the usual step by which steps may differ from it for samples to be interpolated without being asked."""
TOLERANCE = 1e-3
"""Interpolation error, relative to the rms of the signal, up to which it need not be asked for."""
MOST_SAMPLES = 50_000_000
MOST_LOST = 0.9
"""Share of the signal's energy that a lower rate may filter out: more is no longer noise about an oscillation."""
KEPT, ROOM = 0.9, 1.25
"""Share of the energy that an advised rate keeps, and that rate over twice the highest frequency in it."""
REACH = 10
"""Output samples that scipy's default resampling filter reaches on either side."""


@dataclass(frozen=True)
class Uniform:
    """Uniform samples, and how they came about.

    ``error`` is the interpolation's, rms relative to that of the signal, 0 where there was none (across missing samples
    by themselves, where that is more).  ``filled`` says which samples were interpolated across missing ones,
    ``clipped`` which lie at or beside one that is clipped or stands still.
    """

    start: float
    rate: float
    values: Array
    clipped: Mask
    filled: Mask
    error: float
    how: str

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.start + np.arange(self.values.size) / self.rate


@dataclass(frozen=True)
class Grid:
    """Samples as multiples ``k`` of a step, and how far their stamps leave it at most, as a share of the step."""

    k: Array
    step: float
    off: float


def grid_of(time: Array, usual: float) -> Grid:
    """The uniform grid that fits stamps best end to end, steps counted by the usual one.

    >>> grid = grid_of(np.array([0.0, 1.0, 2.0, 4.0]), 1.0)
    >>> grid.k.tolist(), grid.step, grid.off
    ([0.0, 1.0, 2.0, 4.0], 1.0, 0.0)
    """
    counted = np.maximum(1.0, np.rint(np.diff(time) / usual))
    k = np.concatenate([[0.0], np.cumsum(counted)])
    step = float(time[-1] - time[0]) / float(k[-1])
    off = float(np.abs(time - time[0] - step * k).max()) / step
    odd = float(np.abs(np.diff(time) - usual * counted).max()) / (2.0 * usual)
    return Grid(k, step, max(off, odd))


def spline_values(t: Array, x: Array, at: Array) -> tuple[Array, Array]:
    """The quintic spline through (t, x) at ``at``, and its differences from the cubic, relative to the rms of x.

    >>> t = np.linspace(0.0, 6.0, 60)
    >>> found, error = spline_values(t, np.sin(t), np.array([1.0, 2.0]))
    >>> bool(np.abs(found - np.sin([1.0, 2.0])).max() < 1e-7), bool(rms(error) < 1e-4)
    (True, True)
    """
    centre = float(x.mean())
    quintic = make_interp_spline(t, x - centre, k=5)(at)
    cubic = make_interp_spline(t, x - centre, k=3)(at)
    scale = max(float(np.std(x)), np.finfo(float).tiny)
    return np.asarray(quintic + centre), np.asarray((quintic - cubic) / scale)


def rms(values: Array) -> float:
    """Root mean square; 0 of nothing.

    >>> rms(np.array([3.0, -4.0, 5.0, 0.0])), rms(np.zeros(0))
    (3.5355339059327378, 0.0)
    """
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def nearby(t: Array, flags: Mask, at: Array) -> Mask:
    """Which times of ``at`` lie between samples one of which is flagged."""
    return np.asarray(np.interp(at, t, flags.astype(float)) > 0.0)


def on_grid(part: Stamped, clipped: Mask, grid: Grid) -> Uniform:
    """Samples on their grid, the places of missing ones interpolated."""
    start, rate = float(part.time[0]), 1.0 / grid.step
    if grid.k.size == grid.k[-1] + 1.0:
        return Uniform(start, rate, part.values, clipped, np.zeros(grid.k.size, dtype=np.bool_), 0.0, "")
    at = np.arange(grid.k[-1] + 1.0)
    filled = ~np.isin(at, grid.k)
    values = np.empty(at.size)
    values[~filled] = part.values
    values[filled], apart = spline_values(grid.k, part.values, at[filled])
    how = f"{np.count_nonzero(filled)} missing samples were interpolated"
    return Uniform(start, rate, values, nearby(grid.k, clipped, at), filled, rms(apart), how)


def off_grid(part: Stamped, clipped: Mask, rate: float, longest: float) -> Uniform:
    """Samples at ``rate``, interpolated from uneven times."""
    count = int((part.time[-1] - part.time[0]) * rate * (1 + 1e-12)) + 1
    if count > MOST_SAMPLES:
        raise InputError(f"resampling to {rate:g} gives {count} samples, over {MOST_SAMPLES}; use a lower rate")
    at = part.time[0] + np.arange(count) / rate
    values, apart = spline_values(part.time, part.values, at)
    step = np.diff(part.time)
    wide = np.concatenate([step > longest, [False]])
    inside = wide[np.clip(np.searchsorted(part.time, at, side="right") - 1, 0, step.size)]
    how = f"uneven times were resampled to {rate:.6g} per time unit"
    error = max(rms(apart), rms(apart[inside]))
    return Uniform(float(part.time[0]), rate, values, nearby(part.time, clipped, at), inside, error, how)


# scipy's polyphase resampler: a zero-phase Kaiser FIR low-pass at the lower of the two Nyquist frequencies.
def slower(samples: Uniform, rate: float) -> Uniform:
    """Samples at a lower rate, what is above its Nyquist frequency filtered out first.

    >>> t = np.arange(4000) / 100.0
    >>> none = np.zeros(4000, dtype=bool)
    >>> found = slower(Uniform(0.0, 100.0, np.sin(t), none, none, 0.0, ""), 20.0)
    >>> found.rate, bool(np.abs(found.values - np.sin(found.time))[50:-50].max() < 1e-3)
    (20.0, True)
    """
    ratio = Fraction(rate / samples.rate).limit_denominator(2000)
    if ratio <= 0:
        least = samples.rate / 2000
        raise InputError(f"resampling from {samples.rate:g} to {rate:g} is too far; use at least {least:g}")
    checked_work(20.0 * samples.values.size * ratio.denominator, "resampling", "cut the recording into parts")
    values = signal.resample_poly(samples.values, ratio.numerator, ratio.denominator, padtype="line")
    exact = samples.rate * float(ratio)
    edge = REACH if values.size > 4 * REACH else 0
    at = (np.arange(values.size) / exact)[edge : values.size - edge]
    values = values[edge : values.size - edge]
    source = np.arange(samples.values.size) / samples.rate
    gone = lost_share(samples.values[(source >= at[0]) & (source <= at[-1])], values)
    if gone > MOST_LOST:
        refuse_loss(samples, exact, gone)
    how = (
        f"resampled from {samples.rate:.6g} to {exact:.6g} per time unit below a low-pass at {exact / 2:.6g}, which "
        f"took off {100.0 * gone:.2g} % of the signal's energy, "
        f"without the {edge} samples at either end that it sees incompletely"
    )
    return Uniform(
        start=samples.start + float(at[0]),
        rate=exact,
        values=np.asarray(values, dtype=np.float64),
        clipped=nearby(source, samples.clipped, at),
        filled=nearby(source, samples.filled, at),
        error=samples.error,
        how="; ".join(text for text in (samples.how, how) if text),
    )


def lost_share(before: Array, after: Array) -> float:
    """Share of the energy without the mean that is gone, 0 where there is none.

    >>> lost_share(np.array([2.0, -2.0]), np.array([1.0, -1.0])), lost_share(np.ones(3), np.ones(3))
    (0.75, 0.0)
    """
    energy = float(np.var(before))
    return max(0.0, 1.0 - float(np.var(after)) / energy) if energy > 0.0 else 0.0


def refuse_loss(samples: Uniform, rate: float, gone: float) -> None:
    """Raise the InputError for a rate too low for the signal, with one under which most of its energy passes."""
    spectrum = np.abs(rfft(samples.values - samples.values.mean())) ** 2
    share = np.cumsum(spectrum) / spectrum.sum()
    highest = int(np.searchsorted(share, KEPT)) * samples.rate / samples.values.size
    enough = ROOM * 2.0 * highest
    fits = f"use at least {enough:.4g}" if enough < samples.rate else "leave its rate as it is"
    raise InputError(
        f"resampling from {samples.rate:.6g} to {rate:.6g} per time unit would take off {100.0 * gone:.3g} % of the "
        f"signal's energy, which lies above the new Nyquist frequency {rate / 2:.6g}; {fits}"
    )


def resampled(samples: Uniform, rate: float) -> Uniform:
    """Uniform samples at another rate: filtered when it is lower, interpolated when it is higher."""
    if abs(rate / samples.rate - 1.0) < 1e-9:
        return samples
    if rate < samples.rate:
        return slower(samples, rate)
    part = Stamped(samples.time, samples.values, np.arange(samples.values.size), 0)
    finer = off_grid(part, samples.clipped, rate, np.inf)
    filled = nearby(samples.time, samples.filled, finer.time)
    how = f"resampled from {samples.rate:.6g} to {rate:.6g} per time unit"
    return Uniform(finer.start, rate, finer.values, finer.clipped, filled, max(finer.error, samples.error), how)
