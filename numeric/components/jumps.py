"""Whether a frequency jumps: a bend of the phase at one time explains with few parameters what takes splines many.

A model of phase phi and amplitude a = e^l leaves r of the samples.  Another phase Q and logarithm R near its own
change the samples by P (Q - phi) + A (R - l) with P = -a sin phi, A = a cos phi, so that beside an offset d

    y = r + P phi + A l = P Q + A R + d + noise

is linear in Q and R, which come by linear least squares.  Three kinds of them are tried: polynomials in time;
polynomials of which R has a bend (t - t_j)+; and such of which both have one at the same t_j, as where the frequency
jumps.  All sums are moments of products of P, A and 1 over the stretches between the places t_j.  Parameters count as
those of the components do (``separation``).  A jump is where the bend of both gains GAIN over the other two kinds, and
over every spline that was tried.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legfit, legval
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.harmonics.signal_model import SignalModels
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI

GAIN, PER_PARAMETER = 12.0, 5.0
"""Fall of the criterion that is wanted, and what a parameter counts."""
SMOOTH, BENT = (1, 2, 3, 4, 5), (1, 2, 3)
"""Degrees of the polynomials without and with a bend."""
OFFSET = 5
"""Degree of the offset."""
FEW = 2000
"""Samples that polynomials are fitted to."""
APART, BORDER, MOST, FINER = 1.5, 3.0, 96, 13
"""Cycles from one place that is tried to the next and that are left at the ends, how many places at most, and how many
about the best of them."""
LOUD = 1e-3
"""Noise over amplitude below which what a model of a clean signal leaves is no noise."""


@dataclass(frozen=True)
class Moments:
    """Sums of products of P, A and 1 times u^n from each place on, ``[3, 3, n, place]``, and with y ``[3, n, place]``.

    The places are the samples number ``first``, of which the first is 0; u is time from -1 to 1, ``square`` the sum of
    y^2.  For fits of each degree there is a y of its own, less the polynomials of that degree through phi and l: sums
    of squares of many turns would lose the noise in their rounding.
    """

    first: NDArray[np.intp]
    place: Array
    pairs: Array
    target: dict[int, Array]
    square: dict[int, float]


def moments(model: SplineModel, left: Array, sound: Mask, first: NDArray[np.intp]) -> Moments:
    """Those of a model that leaves ``left`` of the samples, from some samples on."""
    phase, size, counts = model.phase, model.size, sound.astype(float)
    u, log = np.linspace(-1.0, 1.0, phase.size), np.log(np.maximum(size, np.finfo(float).tiny))
    P, A = -size * counts * np.sin(phase), size * counts * np.cos(phase)
    offset = model.samples(keep=lambda harmonic: harmonic == 0)
    most, weights = 2 * max(SMOOTH) + 3, (P, A, counts)

    def sums(values: Array, count: int) -> Array:
        rows = []
        for _ in range(count):
            rows.append(np.cumsum(np.add.reduceat(values, first)[::-1])[::-1])
            values = values * u
        return np.array(rows)

    pairs = np.array([[sums(one * other, most) for other in weights] for one in weights])
    target, square = dict[int, Array](), dict[int, float]()
    turns, levels = polynomial_of(u, phase), polynomial_of(u, log)
    for degree in SMOOTH:
        y = (left + offset) * counts
        y += P * (phase - legval(u, turns[: degree + 1])) + A * (log - legval(u, levels[: degree + 1]))
        target[degree] = np.array([sums(one * y, max(degree, OFFSET) + 1) for one in weights])
        square[degree] = float(y @ y)
    return Moments(first, u[first], pairs, target, square)


def polynomial_of(u: Array, values: Array) -> Array:
    """Coefficients of Legendre's polynomials near values, of the highest degree that is tried."""
    few = slice(None, None, max(1, u.size // FEW))
    return np.asarray(legfit(u[few], values[few], max(SMOOTH)))


def left_over(found: Moments, degree: int, bends: tuple[int, ...] = ()) -> Array:
    """The least sum of squares of y with bends of P and of A (0 and 1) at each place, ``(place,)``.

    P and A are multiplied by polynomials of a degree beside, and the offset is one of degree OFFSET.
    """
    smooth = [(of, n) for of in (0, 1) for n in range(degree + 1)] + [(2, n) for n in range(OFFSET + 1)]
    of, power = np.array(smooth).T
    u, pairs, target = found.place, found.pairs, found.target[degree]
    size, count = len(smooth), len(smooth) + len(bends)
    normal, right = np.empty((u.size, count, count)), np.empty((u.size, count))
    normal[:, :size, :size] = pairs[of[:, None], of, power[:, None] + power, 0]
    right[:, :size] = target[of, power, 0]
    for i, one in enumerate(bends, start=size):
        normal[:, i, :size] = (pairs[one, of, power + 1] - u * pairs[one, of, power]).T
        normal[:, :size, i] = normal[:, i, :size]
        right[:, i] = target[one, 1] - u * target[one, 0]
        for j, other in enumerate(bends, start=size):
            first, second, third = pairs[one, other, :3]
            normal[:, i, j] = third - 2.0 * u * second + u**2 * first
    scale = np.sqrt(np.maximum(np.einsum("pii->pi", normal), np.finfo(float).tiny))
    scaled, onto = normal / (scale[:, :, None] * scale[:, None, :]), right / scale
    inverse = np.linalg.pinv(scaled, rcond=1e-12, hermitian=True)
    gained = np.einsum("pi,pij,pj->p", onto, inverse, onto)
    return np.asarray(np.maximum(0.0, found.square[degree] - gained), dtype=float)


def jump(models: SignalModels, left: Array, sound: Mask, *, start: float = 0.0) -> str:
    """Why models cannot be trusted where the frequency jumps; empty where it does not.

    Parameters
    ----------
    models : SignalModels
        Of the oscillation.
    left : array of float, shape (N,)
        What the best of them leaves of the samples.
    sound : array of bool, shape (N,)
        Samples that count.
    start : float
        Time of the first sample in the record.

    Examples
    --------
    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t, noise = np.arange(800) / 16.0, 0.03 * np.random.default_rng(1).normal(size=800)
    >>> for jumps in (0.0, 0.1):
    ...     x = np.cos(6.0 * t + jumps * np.maximum(t - 20.0, 0.0)) + noise
    ...     models = signal_models(x, 16.0, np.full(800, 6.0), half=30, multiples=())
    ...     print(jump(models, x - models.best.samples(), np.ones(800, dtype=bool))[:24])
    <BLANKLINE>
    the frequency jumps near
    """
    best = models.best
    count = min(MOST, int((models.cycles - 2.0 * BORDER) / APART))
    if count < 2 or best.band_noise < LOUD * float(best.size.max()):
        return ""
    at, bent, others = 0.0, 0.0, [score_of(model, best) for model in models.others]
    ends = BORDER, models.cycles - BORDER
    for places in (count, FINER):
        turned = TWO_PI * np.linspace(*ends, places)
        first = np.searchsorted(np.maximum.accumulate(best.phase - best.phase[0]), turned)
        found = moments(best, left, sound, np.unique(np.append(0, first)))
        scores = np.min([scored(found, best, d, (0, 1))[1:] for d in BENT], axis=0)
        place = found.first[1 + int(scores.argmin())]
        bent, at = float(scores.min()), float(best.time[place])
        middle = float(best.phase[place] - best.phase[0]) / TWO_PI
        ends = max(BORDER, middle - APART), min(models.cycles - BORDER, middle + APART)
        others += [float(scored(found, best, d, (1,))[1:].min()) for d in BENT]
    others += [float(scored(found, best, d, ())[0]) for d in SMOOTH]
    if bent > min(others) - GAIN:
        return ""
    return (
        f"the frequency jumps near t = {start + at:.6g}, or wanders at random: a bend of the phase there "
        "explains with few parameters what takes smooth models many; give a --span on one side of it"
    )


def scored(found: Moments, best: SplineModel, degree: int, bends: tuple[int, ...]) -> Array:
    """What polynomials with bends at each place leave, over the variance of the noise, and what their parameters count.

    Those of the offset and of the harmonics, which are the best model's, count for as many values of the noise as they
    take up.
    """
    parameters = 2 * (degree + 1) + len(bends) + (1 if bends else 0)
    beside = OFFSET + 1 + best.parameters - 3 * best.basis.count
    return left_over(found, degree, bends) / best.band_noise**2 + PER_PARAMETER * parameters + beside


def score_of(model: SplineModel, best: SplineModel) -> float:
    """The same of a spline, by the noise of the best."""
    left = model.noise**2 * max(1, model.count - model.parameters) / best.band_noise**2
    return left + PER_PARAMETER * 2 * model.basis.count + model.parameters - 2 * model.basis.count
