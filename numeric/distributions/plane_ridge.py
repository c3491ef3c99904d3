"""The ridge of a distribution that is at hand as a plane: the highest bin of each column, and a vertex nearby.

The tracks of ``numeric.estimators`` store no plane, read their spectra between the bins to rounding and carry
intervals; this one takes any plane, and is right to a share of a bin.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.distributions.bin_interpolation import parabola_vertex
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.tracking.track import Track


# The logarithm of a window's main lobe is nearly a parabola (that of a Gaussian's exactly): its vertex is nearer the
# maximum than that of a parabola through the values themselves.
def vertex(three: NDArray[np.floating]) -> Array:
    """Offset in bins, -1/2 .. 1/2, of the maximum near the middle one of three neighbours, ``(3, N)``.

    Examples
    --------
    >>> lobe = np.exp(-0.5 * (np.array([-1.0, 0.0, 1.0]) - 0.3) ** 2)
    >>> vertex(lobe[:, None]).round(12).tolist()
    [0.3]
    """
    positive = (three > 0.0).all(axis=0)
    values = np.where(positive, np.log(np.where(three > 0.0, three, 1.0)), three)
    return parabola_vertex(*np.asarray(values, dtype=np.float64))


def rows_between(distribution: Distribution, band: tuple[float, float] | None) -> tuple[int, int]:
    """First row within a band, and the one after the last."""
    low, high = (-np.inf, np.inf) if band is None else band
    rows = np.flatnonzero((distribution.omega >= low) & (distribution.omega <= high))
    if rows.size < 3:
        raise InputError(
            f"{distribution.name}: {rows.size} rows lie in the band; a ridge needs 3 (they stand from "
            f"{distribution.omega[0]:.4g} to {distribution.omega[-1]:.4g} rad per time unit; give a wider band)"
        )
    return int(rows[0]), int(rows[-1]) + 1


def away_from_border(distribution: Distribution) -> Mask:
    """Which columns see a whole window of the signal."""
    t, slack = distribution.time, 1e-9 * float(np.ptp(distribution.time))
    border = distribution.border - slack
    return np.asarray((t - t[0] >= border) & (t[-1] - t >= border), dtype=np.bool_)


def ridge(distribution: Distribution, *, band: tuple[float, float] | None = None) -> Track:
    """Return the frequency of the highest value of each column.

    Parameters
    ----------
    distribution : Distribution
        Any plane; of a complex one the modulus counts.
    band : (float, float), optional
        Lowest and highest frequency looked at, rad per time unit; the whole axis by default.  Give one where a cross
        term, an offset or a harmonic may be higher than the component wanted.

    Returns
    -------
    Track
        ``omega`` at ``distribution.time``, rad per time unit: the vertex of a parabola through the logarithms of the
        highest value and its neighbours, right to a share of ``distribution.spacing``, and in a reassigned or
        synchrosqueezed plane to half of it.  ``valid`` is False where the highest value is at an edge of the band, not
        positive, or nearer than ``distribution.border`` to an end.  It claims no deviation, no bias and so no interval:
        use ``estimate`` for those.

    Raises
    ------
    InputError
        Where fewer than three rows lie in the band, and for what is no distribution.

    Examples
    --------
    >>> from ridgeback.numeric.distributions.wigner import pseudo_wigner
    >>> t = np.arange(640) / 32.0
    >>> chirp = np.cos(2 * np.pi * (1.0 * t + 0.05 * t**2))
    >>> track = ridge(pseudo_wigner(chirp, 32.0, lag_seconds=4.0), band=(3.0, 25.0)).inside()
    >>> bool(np.abs(track.frequency_hz - 1.0 - 0.1 * track.time).max() < 0.02)
    True
    """
    if not isinstance(distribution, Distribution):
        raise InputError(
            f"{type(distribution).__name__} is no distribution; make one of samples first, such as "
            "spectrogram(x, rate, window_seconds=4.0)"
        )
    first, beyond = rows_between(distribution, band)
    size = distribution.size()
    column = np.arange(distribution.time.size)
    at = size[first:beyond].argmax(axis=0) + first
    middle = np.clip(at, first + 1, beyond - 2)
    three = np.stack([size[middle + step, column] for step in (-1, 0, 1)])
    inside = (at == middle) & (three[1] > 0.0)
    omega = distribution.omega[at] + distribution.spacing * np.where(inside, vertex(three), 0.0)
    details = {"bin_spacing": distribution.spacing, "border": distribution.border}
    valid = inside & away_from_border(distribution)
    return Track(distribution.time, omega, valid, f"ridge of {distribution.name}", details=details)
