"""The paper's model: period series (10)-(14), one-component model (22)-(23), harmonics (7), (24)-(25).

The series in z is the pendulum's; the one-component and the multicomponent model hold in any potential, the paper's
complex exponentials being read as their real parts.  Components are numbered by their multiple m of the fundamental:
the paper's k-th harmonic omega_k, eq. (24), has m = k + 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import comb

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import make_interp_spline

from ridgeback.common.errors import InputError
from ridgeback.common.horner import polynomial_value
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.waveform import harmonics_along

MAX_TERMS = 100_000


def series_coefficients(terms: int) -> tuple[Fraction, ...]:
    """Return the first coefficients (binom(2n, n) / 4^n)^2 of z^(2n) in k T / (2 pi), eq. (10), exactly.

    >>> [str(c) for c in series_coefficients(4)]
    ['1', '1/4', '9/64', '25/256']
    """
    if not 1 <= terms <= 2000:
        raise InputError(f"exact coefficients: {terms} terms is outside 1 to 2000")
    return tuple(Fraction(comb(2 * n, n), 4**n) ** 2 for n in range(terms))


def _coefficients(terms: int) -> Array:
    """Return the same as float64; the ratio ((2n - 1) / (2n))^2 keeps the relative error below 2 n roundings."""
    if not 1 <= terms <= MAX_TERMS:
        raise InputError(f"{terms} terms is outside 1 to {MAX_TERMS}")
    if terms <= 64:
        return np.array([float(c) for c in series_coefficients(terms)])
    n = np.arange(1, terms)
    return np.concatenate(([1.0], np.cumprod(((2 * n - 1) / (2 * n)) ** 2)))


def modulus(peak: ArrayLike) -> Array:
    """Return z = sin(A / 2), eq. (11) and (13), for pendulum amplitudes 0 <= A < pi.

    >>> modulus([np.pi / 3]).round(15).tolist()
    [0.5]
    """
    A = np.atleast_1d(np.asarray(peak, dtype=float))
    bad = A[~((A >= 0) & (np.pi > A))]
    if bad.size:
        raise InputError(f"pendulum amplitude {bad[0]:.6g} is outside 0 <= A < pi, where it swings")
    return np.asarray(np.sin(0.5 * A))


def series_period(peak: ArrayLike, *, k: float, terms: int) -> Array:
    """Return T(z) of the pendulum with the first ``terms`` terms of eq. (10), (12); peak amplitudes in rad.

    All terms are positive, so that fewer terms always give a period too short.

    >>> series_period([0.0], k=2 * np.pi, terms=3).tolist()
    [1.0]
    """
    return np.asarray(2 * np.pi / k * polynomial_value(_coefficients(terms).tolist(), modulus(peak) ** 2))


def series_frequency(peak: ArrayLike, *, k: float, terms: int) -> Array:
    """Return the pendulum's omega0 = 2 pi / T(z) by eq. (14), cut after some terms.

    Parameters
    ----------
    peak : array of float, shape (M,)
        Peak amplitudes in rad, below pi.
    k : float
        Natural frequency, rad per time unit.
    terms : int
        Terms of the series that are kept.

    Returns
    -------
    array of float, shape (M,)
        Rad per time unit.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import pendulum_frequency
    >>> bool(abs(series_frequency([1.0], k=1.0, terms=30) - pendulum_frequency([1.0]))[0] < 1e-15)
    True
    """
    return frozen(2 * np.pi / series_period(peak, k=k, terms=terms))


def phase_of_samples(time: ArrayLike, omega: ArrayLike) -> Array:
    """Return the phase phi0 by eq. (23) from samples of omega0: the integral of their quintic spline.

    Parameters
    ----------
    time : array of float, shape (N,)
        Increasing; six or more.
    omega : array of float, shape (N,)
        Rad per time unit.

    Returns
    -------
    array of float, shape (N,)
        Rad, 0 at the first time.

    Raises
    ------
    InputError
        For fewer than six times, or values that are not finite.

    Examples
    --------
    >>> t = np.linspace(0.0, 1.0, 50)
    >>> bool(abs(phase_of_samples(t, np.cos(t)) - np.sin(t)).max() < 1e-11)
    True
    """
    t, w = _samples(time, omega)
    phase = make_interp_spline(t, w, k=5).antiderivative()
    return frozen(phase(t) - phase(t[0]))


def slope_of_samples(time: ArrayLike, omega: ArrayLike) -> Array:
    """Return d omega0 / dt at the samples, by their quintic spline.

    >>> t = np.linspace(0.0, 1.0, 50)
    >>> bool(abs(slope_of_samples(t, np.sin(t)) - np.cos(t)).max() < 1e-7)
    True
    """
    t, w = _samples(time, omega)
    return frozen(make_interp_spline(t, w, k=5).derivative()(t))


def _samples(time: ArrayLike, omega: ArrayLike) -> tuple[Array, Array]:
    t, w = np.asarray(time, dtype=float), np.asarray(omega, dtype=float)
    if t.ndim != 1 or t.shape != w.shape or t.size < 6:
        raise InputError(f"needs 6 or more times and as many frequencies; got shapes {t.shape} and {w.shape}")
    if not (np.all(np.isfinite(t)) and np.all(np.isfinite(w)) and np.all(np.diff(t) > 0)):
        raise InputError("times and frequencies must be finite, and times must increase")
    return t, w


@dataclass(frozen=True)
class SimpleModel:
    """u(t) = A(t) cos(phi0(t)), the real part of eq. (22); 1-D arrays of one length."""

    time: Array
    amplitude: Array
    omega: Array
    phase: Array
    signal: Array


def simple_model(time: ArrayLike, amplitude: ArrayLike, omega: ArrayLike, phase: ArrayLike) -> SimpleModel:
    """Return the one-component model (22) from A(t), omega0(t) and phi0(t).

    Parameters
    ----------
    time, amplitude, omega : array of float, shape (N,)
        Times, peak amplitude and frequency there.
    phase : array of float, shape (N,)
        Zero at a peak; add the phase of the initial state when the motion does not start at one.

    Returns
    -------
    SimpleModel
        The signal and its component.

    Examples
    --------
    >>> simple_model([0.0, 1.0], [2.0, 1.0], [np.pi, np.pi], [0.0, np.pi]).signal.tolist()
    [2.0, -1.0]
    """
    t, A, w, phi = (frozen(x) for x in (time, amplitude, omega, phase))
    if not t.shape == A.shape == w.shape == phi.shape:
        raise InputError("time, amplitude, omega and phase must have one length")
    return SimpleModel(t, A, w, phi, frozen(A * np.cos(phi)))


@dataclass(frozen=True)
class Component:
    """One term a_m(t) cos(m phi0(t)) of the multicomponent model (7), with omega_m = m omega0 and its slope."""

    multiple: int
    amplitude: Array
    omega: Array
    slope: Array


@dataclass(frozen=True)
class MulticomponentModel:
    """u(t) = offset(t) + sum of components, the real part of eq. (7); 1-D arrays of one length."""

    time: Array
    offset: Array
    """The mean of u over a cycle: zero in a symmetric well."""
    components: tuple[Component, ...]
    signal: Array


def multicomponent_model(
    dynamics: Dynamics, time: ArrayLike, peak: ArrayLike, omega: ArrayLike, phase: ArrayLike, *, count: int = 9
) -> MulticomponentModel:
    """Return the multicomponent model, eq. (7), each amplitude that of the undamped motion at the peak A(t).

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    time, peak, omega, phase : array of float, shape (N,)
        Times, and peak amplitude, frequency and phase of the fundamental there.
    count : int
        Multiples 1 .. ``count``.

    Returns
    -------
    MulticomponentModel
        The components, with frequencies and slopes by (24) and (25), and their sum.

    Raises
    ------
    InputError
        Without a potential, beyond its limit, and for arrays of different lengths.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> t = np.linspace(0.0, 1.0, 9)
    >>> model = multicomponent_model(linear(), t, np.ones(9), np.ones(9), t, count=3)
    >>> bool(np.allclose(model.signal, np.cos(t), atol=1e-14)), model.components[2].omega[0].item()
    (True, 3.0)
    """
    t, w = _samples(time, omega)
    phi = np.asarray(phase, dtype=float)
    cosine = harmonics_along(dynamics, peak, count=count).cosine
    if not (phi.shape == t.shape and cosine.shape[1] == t.size):
        raise InputError("time, peak, omega and phase must have one length")
    slope = slope_of_samples(t, w)
    components = tuple(Component(m, frozen(cosine[m]), frozen(m * w), frozen(m * slope)) for m in range(1, count + 1))
    signal = cosine[0] + sum(c.amplitude * np.cos(c.multiple * phi) for c in components)
    return MulticomponentModel(frozen(t), frozen(cosine[0]), components, frozen(signal))
