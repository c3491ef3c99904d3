"""An oscillator ``u'' + f(u, u') = 0`` bound to numbers, and the standard ones ready made.

Angular frequencies in rad per time unit.  ``potential`` and ``restoring`` belong to the conservative part
(``V(0) = 0``); oscillators whose damping is not linear, such as van der Pol's, have neither.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mpmath as mp
import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.elementary import powers, wave_pair
from ridgeback.common.errors import InputError
from ridgeback.common.recurrences import Combination, Input, Node, Product
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.events import Switches
from ridgeback.numeric.motion.precise_ring import PRECISE, Jet, Precise, solution_jet
from ridgeback.numeric.motion.roots import bracketed_newton


@dataclass(frozen=True, repr=False)
class Dynamics:
    """The oscillator ``u'' + f(u, u') = 0`` with all its parameters set.

    Made by :func:`ridgeback.bind`.

    Parameters
    ----------
    name : str
        What it is called.
    force : callable
        f(u, u') on plain floats.
    natural_frequency : float
        k, the frequency of small oscillations without damping, rad per time unit; for a force without a linear part
        omega0 at the oscillator's initial amplitude, as the scale of time.
    damping : float
        mu in the linear damping 2 mu u', per time unit; 0 when there is none or it is of another form.
    potential : callable, optional
        V(u), V(0) = 0, of arrays.
    restoring : callable, optional
        V'(u), of arrays.
    closed_form : callable, optional
        Exact omega0 of the undamped oscillator at the peak amplitude A, of arrays; NaN where there is no oscillation.
    precise_force : callable, optional
        f in mpmath arithmetic.
    jet : callable, optional
        (u0, u0', degree) to the Taylor coefficients [u0, u0', u''/2!, ...] at mpmath's current precision; None for a
        force with kinks.
    switches : Switches, optional
        The smooth laws of a force with kinks.
    ends : callable, optional
        Takes nothing and returns where the undamped oscillation ends: the first other equilibria or the edges of V',
        left and right, and the largest peak; None where that could not be decided.  Without it V' is scanned.

    Examples
    --------
    >>> pendulum(k=1.0, mu=0.01).force(0.0, 1.0)
    0.02
    """

    name: str
    force: Callable[[float, float], float]
    natural_frequency: float
    damping: float = 0.0
    potential: Callable[[ArrayLike], Array] | None = None
    restoring: Callable[[ArrayLike], Array] | None = None
    closed_form: Callable[[ArrayLike], Array] | None = None
    precise_force: Callable[[Precise, Precise], Precise] | None = None
    jet: Jet | None = None
    switches: Switches | None = None
    ends: Callable[[], tuple[float, float, float] | None] | None = None

    def known_ends(self) -> tuple[float, float, float] | None:
        """What ``ends`` returns, None without it."""
        return None if self.ends is None else self.ends()

    @property
    def is_kinked_in_u(self) -> bool:
        """Whether the force has kinks at places in u."""
        return self.switches is not None and bool(self.switches.places)

    def __repr__(self) -> str:
        return f"<Dynamics: {self.name}, k = {self.natural_frequency:.6g}, mu = {self.damping:.6g}>"


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


def pendulum_frequency(peak: ArrayLike, *, scale: float = 1.0, rate: float = 1.0) -> Array:
    """Return the frequency of u'' + c sin(b u) = 0: omega0 = sqrt(c b) agm(1, cos(b A/2)) (Gauss).

    Parameters
    ----------
    peak
        Peak amplitudes A.
    scale
        sqrt(c b), the frequency of small oscillations, in rad per time unit.
    rate
        b, in 1/unit of u.

    Returns
    -------
    Array
        omega0 in rad per time unit, of the shape of ``peak``; NaN from b A = pi on, where nothing oscillates.

    Examples
    --------
    >>> pendulum_frequency([0.0, 1.0, 4.0]).round(6).tolist()
    [1.0, 0.937792, nan]
    """
    half = np.minimum(np.abs(np.asarray(peak, dtype=float) * rate) / 2, np.pi)
    return scale * agm(1.0, np.cos(half))


def duffing_frequency(peak: ArrayLike, *, linear: float, cubic: float) -> Array:
    """Return the frequency of u'' + a u + e u^3 = 0: omega0 = agm(sqrt(a + e A^2), sqrt(a + e A^2/2)).

    With u = A sin phi, T = 4 times the integral of dphi / sqrt(a + e A^2 (1 + sin^2 phi)/2) from 0 to pi/2.

    Parameters
    ----------
    peak
        Peak amplitudes A.
    linear, cubic
        a and e.

    Returns
    -------
    Array
        omega0 in rad per time unit, of the shape of ``peak``; NaN where a + e A^2 <= 0.

    Examples
    --------
    >>> round(float(duffing_frequency(1.0, linear=1.0, cubic=0.1)), 12)
    1.036716907075
    """
    square = cubic * np.square(np.asarray(peak, dtype=float))
    inside = np.where(linear + square > 0, square, np.nan)
    return agm(np.sqrt(linear + inside), np.sqrt(linear + inside / 2))


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

    def series(u: Input, v: Input) -> Node:
        sine, _ = wave_pair(PRECISE, u)
        return _combined([(2 * mp.mpf(mu), v), (mp.mpf(k) ** 2, sine)])

    return Dynamics(
        name="pendulum",
        force=lambda u, v: 2 * mu * v + k * k * math.sin(u),
        natural_frequency=float(k),
        damping=float(mu),
        potential=lambda u: 2 * k * k * np.sin(0.5 * np.asarray(u, dtype=float)) ** 2,
        restoring=lambda u: k * k * np.sin(np.asarray(u, dtype=float)),
        closed_form=lambda A: pendulum_frequency(A, scale=k),
        precise_force=lambda u, v: 2 * mp.mpf(mu) * v + mp.mpf(k) ** 2 * mp.sin(u),
        jet=solution_jet(series),
    )


def duffing(k: float = 1.0, eps: float = 1.0, mu: float = 0.0) -> Dynamics:
    """Return Duffing's oscillator ``u'' + 2 mu u' + k^2 u + eps u^3 = 0``; softening for eps < 0.

    >>> round(float(duffing(eps=0.1).closed_form(1.0)), 12)
    1.036716907075
    """
    return polynomial(
        (k * k, 0.0, eps), mu=mu, name="duffing", closed_form=lambda A: duffing_frequency(A, linear=k * k, cubic=eps)
    )


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

    def series(u: Input, v: Input) -> Node:
        return _combined([(2 * mp.mpf(mu), v), *zip(c, powers(PRECISE, u, len(c))[1:], strict=True)])

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
        jet=solution_jet(series),
    )


def van_der_pol(eps: float = 1.0) -> Dynamics:
    """Return van der Pol's oscillator ``u'' - eps (1 - u^2) u' + u = 0``.

    >>> van_der_pol(0.5).force(2.0, 1.0)
    3.5
    """
    _check(k=1.0, eps=eps)

    def series(u: Input, v: Input) -> Node:
        growth = Product(PRECISE, Product(PRECISE, u, u), v)
        return _combined([(-eps, v), (eps, growth), (1, u)])

    return Dynamics(
        name="van-der-pol",
        force=lambda u, v: u - eps * (1 - u * u) * v,
        natural_frequency=1.0,
        precise_force=lambda u, v: u - mp.mpf(eps) * (1 - u * u) * v,
        jet=solution_jet(series),
    )


def rayleigh(eps: float = 1.0) -> Dynamics:
    """Return Rayleigh's oscillator ``u'' - eps (u' - u'^3 / 3) + u = 0``.

    Its velocity u' obeys van der Pol's equation, so both have one period.

    >>> round(rayleigh(0.3).force(0.0, 1.0), 15)
    -0.2
    """
    _check(k=1.0, eps=eps)

    def series(u: Input, v: Input) -> Node:
        cube = Product(PRECISE, Product(PRECISE, v, v), v)
        return _combined([(-eps, v), (mp.mpf(eps) / 3, cube), (1, u)])

    return Dynamics(
        name="rayleigh",
        force=lambda u, v: u - eps * (v - v * v * v / 3),
        natural_frequency=1.0,
        precise_force=lambda u, v: u - mp.mpf(eps) * (v - v**3 / 3),
        jet=solution_jet(series),
    )


def _combined(terms: Sequence[tuple[Precise, Node]]) -> Node:
    """The sum of power series times numbers; those times 0 are left out."""
    present = [(mp.mpf(weight), term) for weight, term in terms if weight]
    return Combination(PRECISE, [weight for weight, _ in present], [term for _, term in present])


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

    As whoever bound the oscillator to its numbers knows them.  Else they are infinite where V' restores at every
    scanned u up to 1e6, and without ``restoring``.

    >>> well(pendulum())
    (-3.14159265358979..., 3.14159265358979...)
    >>> well(duffing(eps=1.0))
    (-inf, inf)
    """
    known = dynamics.known_ends()
    return (-_well_end(dynamics, -1.0), _well_end(dynamics, 1.0)) if known is None else known[:2]


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
            return _edge(lambda u: restoring(side * u), float(SCAN[first - 1]), float(SCAN[first]))
        if pull[first] == 0 and pull[first - 1] < _UNDERFLOW:
            return math.inf
        return _equilibrium(lambda u: side * restoring(side * u), SCAN[first - 1], SCAN[first])


def _edge(pull: Callable[[Array], Array], inside: float, outside: float) -> float:
    """The last place that has a force, by bisection down to neighbouring doubles."""
    while inside < (middle := 0.5 * (inside + outside)) < outside:
        inside, outside = (inside, middle) if np.isnan(pull(np.array([middle]))[0]) else (middle, outside)
    return inside


def _equilibrium(pull: Callable[[Array], Array], inside: float, outside: float) -> float:
    def value_and_slope(u: Array) -> tuple[Array, Array]:
        value = np.asarray(pull(u), dtype=float)
        step = 1e-6 * u
        return value, (np.asarray(pull(u + step)) - np.asarray(pull(u - step))) / (2 * step)

    return float(bracketed_newton(value_and_slope, np.array([inside]), np.array([outside]))[0])
