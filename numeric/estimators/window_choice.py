"""The length and the order of a local fit, best_model with the bias in view: where the expected squared error is least.

The derivative at the centre of a polynomial fitted to the phase in a window is a Savitzky-Golay filter.  Run over the
phase of a model of the whole signal it shows the bias of every window length and degree; the sum of its squared
coefficients gives the variance (2 noise^2 / a^2 per sample of a phase), which for a real tone is the Cramer-Rao bound
of the local model.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.harmonics.window_steps import Shape

LENGTHS = (2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 24.0, 32.0, 48.0, 64.0)
"""Windows tried, in cycles."""
DEGREES = (3, 5)
CENTRES = 2000
"""Windows from which on they are enough to tell an error by."""
MOST_SHARE = 0.5
"""Of the record, that a window may take."""


@dataclass(frozen=True)
class Window:
    """A window of 2 ``half`` + 1 samples, the degree of the phase in it, and the relative rms error expected of it."""

    half: int
    degree: int
    expected: float


def expected_error(model: SplineModel, half: int, degree: int, margin: int) -> float:
    """Relative root mean square error of omega by local fits of the model's own signal and noise.

    The mean is over all but ``margin`` samples at each end, the same for windows of every length, so that they compare;
    over some CENTRES of them in a long record.  Within half a window of an end the end's own window counts.

    >>> from ridgeback.numeric.harmonics.spline_fit import best_model, harmonic_splines
    >>> t = np.arange(640) / 32.0
    >>> x = np.cos(2 * np.pi * (1.2 * t + 0.02 * t**2)) + 0.1 * np.random.default_rng(1).normal(size=640)
    >>> model = best_model(harmonic_splines(x, 32.0, np.full(640, 8.0)))
    >>> expected_error(model, 80, 3, 64) < expected_error(model, 40, 3, 64) < expected_error(model, 40, 5, 64)
    True
    """
    rate = 1.0 / float(model.time[1] - model.time[0])
    omega, amplitude = model.tone(1)
    size, step = 2 * half + 1, max(1, omega.size // CENTRES)
    at = np.arange(margin, max(omega.size - margin, margin + 1), step)
    coefficients = middle_slope(half, degree) * rate
    slope = np.empty(at.size)
    first, last = (at < half), (at >= omega.size - half)
    inner = ~(first | last)
    slope[inner] = np.lib.stride_tricks.sliding_window_view(model.phase, size)[at[inner] - half] @ coefficients
    for edge, begin in ((first, 0), (last, omega.size - size)):
        slope[edge] = rate * fitted_slope(model.phase[begin : begin + size], degree)(at[edge] - begin)
    bias, strength = slope - omega[at], np.maximum(np.abs(amplitude), 1e-3 * np.abs(amplitude).max())[at]
    noise = np.sqrt(2.0 * (coefficients**2).sum()) * model.noise / strength
    return float(np.sqrt(np.mean((bias**2 + noise**2) / omega[at] ** 2)))


# A. Savitzky and M. J. E. Golay, Analytical Chemistry 36 (1964) 1627-1639.
def middle_slope(half: int, degree: int) -> Array:
    """What 2 ``half`` + 1 samples are weighted with to give the slope of their fitted polynomial in the middle.

    >>> bool(np.allclose(middle_slope(2, 2), [-0.2, -0.1, 0.0, 0.1, 0.2]))
    True
    """
    s = np.arange(-half, half + 1) / half
    return np.asarray(np.linalg.pinv(np.vander(s, degree + 1, increasing=True))[1] / half, dtype=np.float64)


def fitted_slope(values: Array, degree: int) -> Polynomial:
    """The slope of the polynomial fitted to samples, as one of their number from 0 on.

    >>> float(fitted_slope(np.arange(6.0) ** 2, 2)(4.0).round(12))
    8.0
    """
    return Polynomial.fit(np.arange(values.size), values, degree).deriv()


def lengths(model: SplineModel, cycle: float) -> Iterator[int]:
    """Half widths of the windows that fit the record, ``cycle`` its longest period."""
    rate = 1.0 / float(model.time[1] - model.time[0])
    for cycles in LENGTHS:
        half = round(0.5 * cycles * cycle * rate)
        if 2 * half + 1 <= MOST_SHARE * model.time.size:
            yield half


def best_window(model: SplineModel, cycle: float, multiples: tuple[int, ...], margin: int) -> Window | None:
    """The window and degree with the least expected error; None where no window holds enough samples for its model.

    A window is at least (degree + 1) / 2 cycles long: in shorter ones the amplitude would imitate offset and harmonics.
    """
    rate = 1.0 / float(model.time[1] - model.time[0])
    found = [
        Window(half, degree, expected_error(model, half, degree, margin))
        for half in lengths(model, cycle)
        for degree in DEGREES
        if 2 * half + 1 >= 1.5 * Shape(multiples, degree, degree - 1).size
        and half >= round(0.25 * (degree + 1) * cycle * rate)
    ]
    return min(found, key=lambda window: window.expected, default=None)
