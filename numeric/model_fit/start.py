"""Where the fit of an oscillator begins: parameters that its equation asks of the smoothed signal.

The harmonic model of the samples is differentiated in closed form, and p and the offset d minimise the equation error
u'' + f(u - d, u'; p) in least squares ("gradient matching": Varah, SIAM J. Sci. Stat. Comput. 3 (1982) 28).  No
equation is integrated, so nothing can diverge; noise and lost harmonics bias the values by a few per cent.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.signal.samples import TWO_PI


def matched(family: Family, signal: HarmonicSignal, *, free_offset: bool) -> tuple[Array, tuple[Array, Array]]:
    """Return u0, v0, the offset and the parameters that the smoothed signal suggests, and lower and upper limits.

    The point of rest lies between the turning points, and a parameter on whose sign the force does not depend (k in
    k^2 sin u) keeps the one that it began with.  Raises InputError when the equation has no finite error at the
    starting values.
    """
    first = signal.rate_of_change()
    u, v, a = signal.values(), first.values(), first.rate_of_change().values()
    edge = round(TWO_PI / float(np.median(signal.omega)) * signal.rate)
    inner = slice(edge, -edge) if u.size > 4 * edge else slice(None)
    scale = float(np.sqrt(np.mean(a[inner] ** 2)))

    def error(theta: Array) -> Array:
        d, *p = theta.tolist()
        with np.errstate(all="ignore"):
            gap = (a[inner] + family.forces(u[inner] - d * free_offset, v[inner], p)) / scale
        return np.nan_to_num(gap, nan=1e6, posinf=1e6, neginf=-1e6)

    begin = np.array([float(np.mean(signal.offset)), *family.start])
    if not np.abs(error(begin)).max() < 1e6:
        raise InputError(f"{family.name}: the force has no value along this signal at the starting parameters")
    low, high = np.full(begin.size, -np.inf), np.full(begin.size, np.inf)
    low[0], high[0] = float(u.min()), float(u.max())
    low[1:], high[1:] = one_sided(family, (u[inner] - begin[0], v[inner]))
    d, *p = least_squares(error, begin, bounds=(low, high), x_scale="jac", max_nfev=200).x.tolist()
    d = d if free_offset else 0.0
    free = np.array([np.inf, np.inf])
    return np.array([u[0] - d, v[0], d, *p]), (np.append(-free, low), np.append(free, high))


def one_sided(family: Family, states: tuple[Array, Array]) -> tuple[Array, Array]:
    """Limits that keep the sign of every parameter on whose sign the force does not depend."""
    low, high = np.full(family.start.size, -np.inf), np.full(family.start.size, np.inf)
    for i in np.flatnonzero(family.start):
        turned = family.start.copy()
        turned[i] = -turned[i]
        if np.array_equal(family.forces(*states, turned.tolist()), family.forces(*states, family.start.tolist())):
            low[i], high[i] = (0.0, np.inf) if family.start[i] > 0.0 else (-np.inf, 0.0)
    return low, high
