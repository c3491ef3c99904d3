"""Where the motion stands above the noise: from the release or the trigger to the stop, or until it has sunk too far.

Windows of four cycles, half overlapping, are fitted by harmonic least squares.  The stretch runs from the first to the
last in which the amplitude is CLEAR of its own deviation.  Where it does not begin or end with the record, the end is
moved inward until the residual of the window there is no larger than that of its neighbours: a window that holds the
jump of a release or a stop fits badly, one in a tail that sinks into the noise does not.  It is moved from the last
window that fits badly, for the jump can be anywhere in it.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.local_fit import choose_multiples, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.signal.analytic import analytic_of
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.spikes import TO_SIGMA
from ridgeback.numeric.tracking.request import LAG_CYCLES, Request

CLEAR = 5.0
FEWEST_WINDOWS = 2
"""Of those that are clear, and of all: with fewer nothing is cut."""
WEAKER = 0.5
"""What is cut has, on the mean, at most this share of the clearness of what is kept."""
ROUGH = 1.5
"""A residual above that of the next windows inside by this factor is that of a jump."""
LOUD = 0.2
"""Of the amplitude, that a fit leaves where there is a motion which it does not follow: what is cut is quiet."""
NEAR, MOSTLY = 1.6, 0.5
"""Where the search band's guide strays from its centre by more than this factor there is nothing to guide it, unless
most of the power is there: a long chirp."""
TURN, FOLLOWED = 0.1, 0.3
"""Relative change of the frequency per cycle that can be followed, and the least share of a record in which it is."""
KEPT = 8
"""Records whose stretch is kept."""
TRIES = 24
"""Places over a window at which its end is tried."""


def clear_stretch(request: Request) -> slice | None:
    """The samples whose amplitude stands above the noise; None where all of them do, or hardly any.

    Parameters
    ----------
    request : Request
        Of the whole record.

    Returns
    -------
    slice or None
        First sample, and one beyond the last.
    """
    signal = request.signal
    return clear_once(signal.x.tobytes(), signal.rate, signal.search.guide.tobytes(), signal.search.centre)


@lru_cache(maxsize=KEPT)
def clear_once(samples: bytes, rate: float, guide_bytes: bytes, centre: float) -> slice | None:
    """The same of arrays as their bytes, kept for the next method that asks it of the same samples."""
    x, guide = np.frombuffer(samples), np.frombuffer(guide_bytes)
    led = (guide > centre / NEAR) & (guide < centre * NEAR)
    guide = np.where(led, guide, centre)
    led_share = float(np.average(led, weights=np.abs(analytic_of(x)) ** 2))
    half = round(0.5 * LAG_CYCLES * TWO_PI / centre * rate)
    if led_share < MOSTLY or x.size < (FEWEST_WINDOWS + 1) * half or 2 * half + 1 < 2 * Shape().size:
        return None
    shape = Shape(choose_multiples(x, rate, guide, half=half))
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, centres=np.arange(half, x.size - half, half))
    clearness = np.where(fit.settled, np.abs(fit.amplitude) / np.maximum(fit.amplitude_sd, np.finfo(float).tiny), 0.0)
    clear = np.flatnonzero(clearness > CLEAR)
    if clear.size < FEWEST_WINDOWS:
        return None
    first, last = int(clear[0]), int(clear[-1])
    outside = np.concatenate([clearness[:first], clearness[last + 1 :]])
    if outside.size == 0 or float(outside.mean()) > WEAKER * float(np.median(clearness[clear])):
        return None
    begin, end = 0, x.size
    if first > 0:
        typical = float(np.median(fit.noise[clear[1:4]]))
        jumped = int(fit.noise[first - 1] > ROUGH * typical)
        begin = smooth_from(x, rate, guide, shape, half=half, near=(first - jumped) * half, typical=typical)
    if last < clearness.size - 1:
        typical = float(np.median(fit.noise[clear[-4:-1]]))
        jumped = int(fit.noise[last + 1] > ROUGH * typical)
        near = x.size - ((last + jumped) * half + 2 * half + 1)
        end = x.size - smooth_from(x[::-1], rate, guide[::-1], shape, half=half, near=max(0, near), typical=typical)
    beyond = float(np.median(np.concatenate([fit.noise[:first], fit.noise[last + 1 :]])))
    loud = LOUD * float(np.median(np.abs(fit.amplitude[clear])))
    if beyond > loud and max(wavering(x[:begin]), wavering(x[end:])) > loud:
        return None
    return slice(begin, end) if end - begin > 2 * half else None


def followed_stretch(request: Request) -> slice | None:
    """The longest run of samples in which the search band's guide changes by at most TURN a cycle.

    None where that is all of them, or hardly any: of a chirp that runs away, the part that a model can follow.
    """
    guide, rate = request.signal.search.guide, request.signal.rate
    change = np.abs(np.gradient(np.log(guide))) * rate * TWO_PI / guide
    edges = np.flatnonzero(np.diff(np.concatenate([[False], change <= TURN, [False]]).astype(int)))
    if not edges.size:
        return None
    longest = int(np.argmax(edges[1::2] - edges[::2]))
    begin, end = int(edges[2 * longest]), int(edges[2 * longest + 1])
    return slice(begin, end) if FOLLOWED * guide.size <= end - begin < guide.size else None


def wavering(x: Array) -> float:
    """The standard deviation of samples at rest, by their median absolute deviation: a jump at their end counts little.

    >>> wavering(np.concatenate([np.full(50, 2.0), np.full(9, 7.0)]))
    0.0
    """
    return TO_SIGMA * float(np.median(np.abs(x - np.median(x)))) if x.size else 0.0


def smooth_from(x: Array, rate: float, guide: Array, shape: Shape, *, half: int, near: int, typical: float) -> int:
    """The first sample from ``near`` on from which a window fits with a residual that is not ROUGH times the typical.

    >>> t = np.arange(400) / 20.0
    >>> x = np.where(t < 4.0, 1.0, np.cos(2 * np.pi * (t - 4.0))) + 0.01 * np.random.default_rng(1).normal(size=400)
    >>> first = smooth_from(x, 20.0, np.full(400, 2 * np.pi), Shape(), half=40, near=40, typical=0.01)
    >>> 80 <= first <= 84
    True
    """
    begins = np.unique(np.linspace(near, min(near + 2 * half, x.size - 2 * half - 1), TRIES + 1).astype(int))
    fit = harmonic_fit(x, rate, guide, half=half, shape=shape, centres=begins + half)
    good = np.flatnonzero(fit.settled & (fit.noise <= ROUGH * typical))
    return int(begins[good[0]]) if good.size else int(begins[-1])
