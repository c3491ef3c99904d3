"""An oscillator ``u'' + f(u, u') = 0`` bound to numbers, and the standard ones ready made.

Angular frequencies in rad per time unit.  ``potential`` and ``restoring`` belong to the conservative part
(``V(0) = 0``); oscillators whose damping is not linear, such as van der Pol's, have neither.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath as mp
import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.roots import bracketed_newton

Precise = Any  # an mpmath.mpf: mpmath ships no types
Jet = Callable[[Precise, Precise, int], list[Precise]]
Coefficient = Callable[[Sequence[Precise], Sequence[Precise], int], Precise]


@dataclass(frozen=True)
class Dynamics:
    """The oscillator ``u'' + f(u, u') = 0`` with all its parameters set.

    >>> pendulum(k=1.0, mu=0.01).force(0.0, 1.0)
    0.02
    """

    name: str
    force: Callable[[float, float], float]
    """f(u, u') on plain floats."""
    natural_frequency: float
    """k: the frequency of small oscillations without damping."""
    damping: float = 0.0
    """mu in the linear damping 2 mu u'; 0 when there is none or it is of another form."""
    potential: Callable[[ArrayLike], Array] | None = None
    """V(u), V(0) = 0, vectorised."""
    restoring: Callable[[ArrayLike], Array] | None = None
    """V'(u), vectorised."""
    closed_form: Callable[[ArrayLike], Array] | None = None
    """Exact omega0 of the undamped oscillator at the peak amplitude A; NaN where there is no oscillation."""
    precise_force: Callable[[Precise, Precise], Precise] | None = None
    """f in mpmath arithmetic."""
    jet: Jet | None = None
    """(u0, u0', degree) -> Taylor coefficients [u0, u0', u''/2!, ...] at mpmath's current precision."""


def agm(a: ArrayLike, b: ArrayLike) -> Array:
    """Return the arithmetic-geometric mean of positive values; NaN where b is not positive.

    >>> float(agm(1.0, np.sqrt(2.0)))  # Gauss's constant, inverted: 1.19814023473559220744
    1.1981402347355923
    """
    x, y = np.broadcast_arrays(np.asarray(a, dtype=float), np.asarray(b, dtype=float))
    y = np.where(y > 0, y, np.nan)
    for _ in range(60):
        x, y = 0.5 * (x + y), np.sqrt(x * y)
        if not np.any(np.abs(x - y) > 2e-16 * np.abs(x)):
            break
    return np.asarray(0.5 * (x + y))


def _series(acceleration: Coefficient, u0: Precise, v0: Precise, degree: int) -> list[Precise]:
    """Return the coefficients of u; ``acceleration`` gives that of u'' at n from u to n + 1, u' to n."""
    u, v = [mp.mpf(u0), mp.mpf(v0)], [mp.mpf(v0)]
    for n in range(degree - 1):
        v.append(acceleration(u, v, n) / (n + 1))
        u.append(v[n + 1] / (n + 2))
    return u[: degree + 1]


def _cauchy(a: Sequence[Precise], b: Sequence[Precise], n: int) -> Precise:
    """Return coefficient n of the product of two power series."""
    return mp.fdot(zip(a[: n + 1], b[n::-1], strict=True))


def linear(k: float = 1.0, mu: float = 0.0) -> Dynamics:
    """Return the harmonic oscillator ``u'' + 2 mu u' + k^2 u = 0``, eq. (2) of the paper.

    >>> float(linear(k=3.0).closed_form(0.5))
    3.0
    """
    return polynomial((k * k,), mu=mu, name="linear", closed_form=lambda A: np.full(np.shape(A), float(k)))


def pendulum(k: float = 1.0, mu: float = 0.0) -> Dynamics:
    """Return the pendulum ``u'' + 2 mu u' + k^2 sin u = 0``, eq. (1) of the paper.

    Exactly, omega0(A) = pi k / (2 K(sin(A/2))) = k agm(1, cos(A/2)).

    >>> round(float(pendulum().closed_form(1.0)), 15)
    0.937792258051428
    """
    _check(k=k, mu=mu)

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        """S = sin u and C = cos u obey S' = C u', C' = -S u' (Jorba and Zou 2005, section 2)."""
        sine, cosine = [mp.sin(u0)], [mp.cos(u0)]

        def acceleration(_: Sequence[Precise], v: Sequence[Precise], n: int) -> Precise:
            if n:
                sine.append(_cauchy(cosine, v, n - 1) / n)
                cosine.append(-_cauchy(sine, v, n - 1) / n)
            return -2 * mp.mpf(mu) * v[n] - mp.mpf(k) ** 2 * sine[n]

        return _series(acceleration, u0, v0, degree)

    return Dynamics(
        name="pendulum",
        force=lambda u, v: 2 * mu * v + k * k * math.sin(u),
        natural_frequency=float(k),
        damping=float(mu),
        potential=lambda u: 2 * k * k * np.sin(0.5 * np.asarray(u, dtype=float)) ** 2,
        restoring=lambda u: k * k * np.sin(np.asarray(u, dtype=float)),
        closed_form=lambda A: k * agm(1.0, np.cos(0.5 * np.asarray(A, dtype=float))),
        precise_force=lambda u, v: 2 * mp.mpf(mu) * v + mp.mpf(k) ** 2 * mp.sin(u),
        jet=jet,
    )


def duffing(k: float = 1.0, eps: float = 1.0, mu: float = 0.0) -> Dynamics:
    """Return Duffing's oscillator ``u'' + 2 mu u' + k^2 u + eps u^3 = 0``; softening for eps < 0.

    omega0(A) = pi sqrt(k^2 + eps A^2) / (2 K(m)), m = eps A^2 / (2 (k^2 + eps A^2)), written by the agm.

    >>> round(float(duffing(eps=0.1).closed_form(1.0)), 12)
    1.036716907075
    """

    def closed_form(peak: ArrayLike) -> Array:
        stiffening = eps * np.square(np.asarray(peak, dtype=float))
        a, b = k * k + stiffening, k * k + 0.5 * stiffening
        return agm(np.sqrt(np.where(a > 0, a, np.nan)), np.sqrt(np.where(a > 0, b, np.nan)))

    return polynomial((k * k, 0.0, eps), mu=mu, name="duffing", closed_form=closed_form)


def helmholtz_duffing(k: float = 1.0, alpha: float = 0.3, eps: float = 0.1, mu: float = 0.0) -> Dynamics:
    """Return the asymmetric oscillator ``u'' + 2 mu u' + k^2 u + alpha u^2 + eps u^3 = 0``.

    >>> helmholtz_duffing().force(1.0, 0.0)
    1.4
    """
    return polynomial((k * k, alpha, eps), mu=mu, name="helmholtz-duffing")


def polynomial(
    coefficients: Sequence[float],
    *,
    mu: float = 0.0,
    name: str = "polynomial",
    closed_form: Callable[[ArrayLike], Array] | None = None,
) -> Dynamics:
    """Return the oscillator ``u'' + 2 mu u' + c1 u + c2 u^2 + ... = 0`` with ``c1 > 0``.

    Raises InputError when c1 is not positive or a coefficient is not finite.

    >>> polynomial((4.0, 0.0, 1.0)).natural_frequency
    2.0
    """
    c = tuple(float(x) for x in coefficients)
    if not c or not all(map(math.isfinite, c)) or not c[0] > 0:
        raise InputError(f"polynomial coefficients {c} must be finite and start with a positive one")
    k = math.sqrt(c[0])
    _check(k=k, mu=mu)
    rising = np.array((0.0, *c))
    integral = np.array((0.0, 0.0, *(x / (n + 2) for n, x in enumerate(c))))
    horner = (*c[::-1], 0.0)

    def force(u: float, v: float) -> float:
        value = 0.0
        for x in horner:
            value = value * u + x
        return 2 * mu * v + value

    def precise_force(u: Precise, v: Precise) -> Precise:
        return 2 * mp.mpf(mu) * v + mp.polyval([mp.mpf(x) for x in horner], u)

    return Dynamics(
        name=name,
        force=force,
        natural_frequency=k,
        damping=float(mu),
        potential=lambda u: np.asarray(np.polynomial.polynomial.polyval(np.asarray(u, dtype=float), integral)),
        restoring=lambda u: np.asarray(np.polynomial.polynomial.polyval(np.asarray(u, dtype=float), rising)),
        closed_form=closed_form,
        precise_force=precise_force,
        jet=_polynomial_jet(c, mu),
    )


def _polynomial_jet(c: Sequence[float], mu: float) -> Jet:
    """Powers of u by repeated Cauchy products, one coefficient at a time."""

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        weights = [mp.mpf(x) for x in c]
        powers: list[list[Precise]] = [[] for _ in c[1:]]

        def acceleration(u: Sequence[Precise], v: Sequence[Precise], n: int) -> Precise:
            for i, power in enumerate(powers):
                power.append(_cauchy(powers[i - 1] if i else u, u, n))
            total = sum(w * p[n] for w, p in zip(weights, [u, *powers], strict=True))
            return -2 * mp.mpf(mu) * v[n] - total

        return _series(acceleration, u0, v0, degree)

    return jet


def van_der_pol(eps: float = 1.0) -> Dynamics:
    """Return van der Pol's oscillator ``u'' - eps (1 - u^2) u' + u = 0``.

    >>> van_der_pol(0.5).force(2.0, 1.0)
    3.5
    """
    _check(k=1.0, eps=eps)

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        growth: list[Precise] = []

        def acceleration(u: Sequence[Precise], v: Sequence[Precise], n: int) -> Precise:
            growth.append((1 if n == 0 else 0) - _cauchy(u, u, n))
            return mp.mpf(eps) * _cauchy(growth, v, n) - u[n]

        return _series(acceleration, u0, v0, degree)

    return Dynamics(
        name="van-der-pol",
        force=lambda u, v: u - eps * (1 - u * u) * v,
        natural_frequency=1.0,
        precise_force=lambda u, v: u - mp.mpf(eps) * (1 - u * u) * v,
        jet=jet,
    )


def rayleigh(eps: float = 1.0) -> Dynamics:
    """Return Rayleigh's oscillator ``u'' - eps (u' - u'^3 / 3) + u = 0``.

    Its velocity u' obeys van der Pol's equation, so both have one period.

    >>> round(rayleigh(0.3).force(0.0, 1.0), 15)
    -0.2
    """
    _check(k=1.0, eps=eps)

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        square: list[Precise] = []

        def acceleration(u: Sequence[Precise], v: Sequence[Precise], n: int) -> Precise:
            square.append(_cauchy(v, v, n))
            return mp.mpf(eps) * (v[n] - _cauchy(square, v, n) / 3) - u[n]

        return _series(acceleration, u0, v0, degree)

    return Dynamics(
        name="rayleigh",
        force=lambda u, v: u - eps * (v - v * v * v / 3),
        natural_frequency=1.0,
        precise_force=lambda u, v: u - mp.mpf(eps) * (v - v**3 / 3),
        jet=jet,
    )


def _check(*, k: float, **others: float) -> None:
    if not (math.isfinite(k) and k > 0):
        raise InputError(f"natural frequency k = {k} must be finite and positive")
    for name, value in others.items():
        if not math.isfinite(value):
            raise InputError(f"parameter {name} = {value} must be finite")


# The scan for equilibria: 1e-6 to 1e6 in steps of 1 %.  Two further equilibria closer together than 1 % of
# their distance from the origin would be missed; nothing shorter than a proof could promise more.
SCAN = 1e-6 * 1.01 ** np.arange(2778)
_UNDERFLOW = 1e-290  # V' vanishing from below this is a tail (Morse's potential), not an equilibrium


def well(dynamics: Dynamics) -> tuple[float, float]:
    """Return the ends of the potential well of u = 0: the first other equilibria, left and right.

    Infinite where V' restores at every scanned u up to 1e6; without ``restoring`` both are infinite.

    >>> well(pendulum())
    (-3.14159265358979..., 3.14159265358979...)
    >>> well(duffing(eps=1.0))
    (-inf, inf)
    """
    return -_well_end(dynamics, -1.0), _well_end(dynamics, 1.0)


def _well_end(dynamics: Dynamics, side: float) -> float:
    """Return the first u > 0 at which ``side V'(side u)`` stops being positive, or infinity."""
    restoring = dynamics.restoring
    if restoring is None:
        return math.inf
    with np.errstate(all="ignore"):
        pull = side * np.asarray(restoring(side * SCAN), dtype=float)
        failing = np.flatnonzero(~(pull > 0))
        if failing.size == 0:
            return math.inf
        first = int(failing[0])
        if first == 0:
            raise InputError(f"{dynamics.name}: u = 0 is not a stable equilibrium: V' does not restore near it")
        if np.isnan(pull[first]):
            return float(SCAN[first - 1])
        if pull[first] == 0 and pull[first - 1] < _UNDERFLOW:
            return math.inf
        return _equilibrium(lambda u: side * restoring(side * u), SCAN[first - 1], SCAN[first])


def _equilibrium(pull: Callable[[Array], Array], inside: float, outside: float) -> float:
    def value_and_slope(u: Array) -> tuple[Array, Array]:
        value = np.asarray(pull(u), dtype=float)
        step = 1e-6 * u
        return value, (np.asarray(pull(u + step)) - np.asarray(pull(u - step))) / (2 * step)

    return float(bracketed_newton(value_and_slope, np.array([inside]), np.array([outside]))[0])
