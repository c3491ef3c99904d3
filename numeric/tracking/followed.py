"""A frequency that runs away from the search band's guide, followed from the stretch in which the guide is right.

At the end of what is followed so far, a phase and an amplitude of degree DEGREE are fitted to the last BEHIND cycles;
the logarithm of the frequency is carried on at the slope of its last cycle for AHEAD cycles, which the next fit
corrects.  It ends with the record, or where a fit leaves more than LOST of the amplitude.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_fit import corrected_phase, fit_on
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.signal.search_band import MARGIN, SearchBand

BEHIND, AHEAD = 4.0, 0.75
DEGREE = 5
LOST = 0.1
HIGHEST = 0.9
"""Of the Nyquist frequency, up to which a frequency is followed."""


def lengthened(x: Array, rate: float, guide: Array, stretch: slice) -> tuple[Array, slice]:
    """A better guide, and the stretch over which it holds: as far as the oscillation can be followed to either side.

    Parameters
    ----------
    x : array of float, shape (N,)
        Samples without their mean.
    rate : float
        Samples per time unit.
    guide : array of float, shape (N,)
        Frequency, rad per time unit, right in the stretch.
    stretch : slice
        Of samples.

    Returns
    -------
    guide : array of float, shape (N,)
        The frequency that was followed; as it was beyond.
    stretch : slice
        Where it was.

    Examples
    --------
    >>> t = np.arange(700) / 140.0
    >>> omega = 4 * np.pi * (1 - t / 5.05) ** -0.6
    >>> x = np.cos(50.5 * np.pi * (1 - (1 - t / 5.05) ** 0.4))
    >>> guide, stretch = lengthened(x, 140.0, np.minimum(omega, 30.0), slice(0, 500))
    >>> stretch, bool(np.abs(guide / omega - 1.0).max() < 0.1)
    (slice(0, 700, None), True)
    """
    guide, stop = forward(x, rate, guide, stretch)
    turned = slice(x.size - stop, x.size - stretch.start)
    back, begin = forward(x[::-1], rate, guide[::-1], turned)
    return back[::-1].copy(), slice(x.size - begin, stop)


def forward(x: Array, rate: float, guide: Array, stretch: slice) -> tuple[Array, int]:
    """The guide carried on beyond the end of a stretch, and the new end.

    It begins before that end where the guide strays already.
    """
    omega, good = guide.copy(), 0
    stop, lowest = stretch.stop, (stretch.start + stretch.stop) // 2
    while stop > lowest:
        turned = cumulative_trapezoid(omega[stretch.start : stop], dx=1.0 / rate, initial=0) / TWO_PI
        first = stretch.start + int(np.searchsorted(turned, turned[-1] - BEHIND))
        model = tail(x[first:stop], rate, omega[first:stop])
        if model is None and good:
            break
        if model is None:
            stop -= max(2, math.ceil(AHEAD * TWO_PI * rate / float(omega[stop - 1])))
            continue
        middle = (first + stop) // 2
        good, omega[middle:stop] = stop, model.omega[middle - first :]
        if stop == x.size:
            break
        ahead = carried_on(omega[first:stop], rate)[: x.size - stop]
        omega[stop : stop + ahead.size] = ahead
        stop += ahead.size
    return omega, good or stretch.stop


def carried_on(omega: Array, rate: float) -> Array:
    """A frequency AHEAD cycles further, at the slope that its logarithm has over the last one."""
    last = float(omega[-1])
    cycle = max(2, math.ceil(TWO_PI * rate / last))
    recent = np.log(omega[-cycle:])
    slope = float(np.polyfit(np.arange(recent.size) / rate, recent, 1)[0])
    ahead = np.arange(1, math.ceil(AHEAD * cycle) + 1) / rate
    return np.asarray(np.minimum(last * np.exp(slope * ahead), HIGHEST * math.pi * rate))


def tail(x: Array, rate: float, guide: Array) -> SplineModel | None:
    """A polynomial phase and amplitude of a few cycles; None where they do not follow them."""
    try:
        phase, size = corrected_phase(x, rate, guide)
        time = np.arange(x.size) / rate
        model = fit_on(x, time, phase, np.maximum(size, 0.1 * size.max()), time[[0, -1]], (), DEGREE)
    except (InputError, np.linalg.LinAlgError):
        return None
    follows = model.noise < LOST * float(np.median(model.size)) and bool((model.omega > 0.0).all())
    return model if follows else None


def along(search: SearchBand, guide: Array, rate: float) -> SearchBand:
    """A search band round another guide."""
    high = np.minimum(guide * MARGIN, math.pi * rate)
    return replace(search, low=guide / MARGIN, high=high, guide=guide)
