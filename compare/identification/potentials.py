"""The potentials among the candidates, each in units where k = 1 and lengths are measured in L, as tables of orbits.

A *shape* is what is left of a restoring force r(u) then: a few pure numbers.  ``physical`` gives them their units back.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.bilinear import Bilinear
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, pendulum
from ridgeback.numeric.orbits.orbit_table import HARMONICS, OrbitTable, bilinear_table, orbit_table
from ridgeback.numeric.orbits.slow_flow import ScaledOrbits, as_scaled, refine

Shape = tuple[float, ...]
REACH = 1.5
"""Largest peak of a table, in lengths L: the largest measured amplitude is 1."""
CLOSEST = 0.992
"""Share of the amplitude at which oscillation ends that a table reaches."""
COARSE = 40
FINE = 320
LEAST = 2e-3
"""Smallest peak of a table, relative to the largest; below it the oscillator is taken as linear."""


@dataclass(frozen=True)
class Potential:
    """A family of restoring forces; ``groups`` are starting shapes, of which the best of each group is tried."""

    name: str
    title: str
    restoring: str
    """Text of the restoring force."""
    orbits: Callable[[Shape], ScaledOrbits]
    physical: Callable[[float, float, Shape], tuple[tuple[str, float, str, str], ...]]
    """(k, L, shape) -> (name, value, exponents of unit and time as text, meaning) of each parameter."""
    lower: Shape = ()
    upper: Shape = ()
    groups: tuple[tuple[Shape, ...], ...] = (((),),)
    mirror: Callable[[Shape], tuple[float, Shape]] | None = None
    """Factor of k and shape of the potential turned round, u -> -u, whose backbone is the same; None: it is itself."""


def smooth_orbits(dynamics: Dynamics, limit: float) -> ScaledOrbits:
    """Fine table of a smooth potential up to REACH, or nearly to the end of its well.

    >>> float(smooth_orbits(pendulum(), math.pi).peak[-1])
    1.5
    """
    top = min(REACH, CLOSEST * limit)
    peaks = top * np.sin(np.arange(1, COARSE + 1) * (0.5 * math.pi / COARSE))
    return refine(orbit_table(dynamics, peaks), nodes(top))


def nodes(top: float) -> Array:
    """Peaks in proportion up to half of the largest, then closer and closer to it: orbits change fast at a well's end.

    >>> x = nodes(2.0)
    >>> x.size == FINE, round(float(x[0]), 9), round(float(x[-1]), 9), bool((np.diff(x) > 0.0).all())
    (True, 0.004, 2.0, True)
    """
    upper = FINE // 2
    fine = 0.5 + 0.5 * np.sin(np.arange(upper + 1) * (0.5 * math.pi / upper))
    return np.asarray(top * np.concatenate((np.geomspace(LEAST, 0.5, FINE - upper), fine[1:])))


def linear_orbits(_: Shape) -> ScaledOrbits:
    """Those of the harmonic oscillator, in closed form."""
    A = np.geomspace(LEAST * REACH, REACH, FINE)
    cosine = np.zeros((HARMONICS + 1, A.size))
    cosine[1] = A
    ones = np.ones_like(A)
    return as_scaled(OrbitTable(A, ones, 0.5 * A**2, cosine, 4 / (3 * math.pi) * A**3, 0.375 * A**4, 2 * A))


def pendulum_orbits(shape: Shape) -> ScaledOrbits:
    """Those of u'' + sin(b u)/b = 0 by b^2: the pendulum's in the angle b u.

    The frequency changes in proportion to b^2, which small amplitudes therefore leave as open as a cubic stiffness.
    """
    b = math.sqrt(max(shape[0], LEAST_TURN))
    sine = pendulum()
    assert sine.potential is not None  # noqa: S101 - a pendulum has one
    assert sine.restoring is not None  # noqa: S101
    force, energy = sine.restoring, sine.potential
    scaled = Dynamics(
        name="pendulum-like",
        force=sine.force,
        natural_frequency=1.0,
        potential=lambda u: energy(b * np.asarray(u)) / b**2,
        restoring=lambda u: force(b * np.asarray(u)) / b,
    )
    return smooth_orbits(scaled, math.pi / b)


def duffing_orbits(shape: Shape) -> ScaledOrbits:
    """Those of u'' + u + e u^3 = 0."""
    (e,) = shape
    return smooth_orbits(duffing(eps=e), 1 / math.sqrt(-e) if e < 0 else math.inf)


def helmholtz_orbits(shape: Shape) -> ScaledOrbits:
    """Those of u'' + u + alpha u^2 + e u^3 = 0."""
    alpha, e = shape
    return smooth_orbits(helmholtz_duffing(alpha=alpha, eps=e), helmholtz_limit(alpha, e))


def helmholtz_limit(alpha: float, e: float) -> float:
    """Peak at which the well of u + alpha u^2 + e u^3 ends, on the right or, at equal potential, on the left.

    >>> round(helmholtz_limit(-1.0, 0.0), 9), round(helmholtz_limit(1.0, 0.0), 6), helmholtz_limit(0.1, 1.0)
    (1.0, 0.5, inf)
    """
    roots = np.roots([e, alpha, 1.0] if e else [alpha, 1.0] if alpha else [1.0])
    real = roots[np.abs(roots.imag) < 1e-12].real
    right = float(real[real > 0].min(initial=math.inf))
    left = real[real < 0]
    if not left.size:
        return right
    energy = np.polynomial.Polynomial([0.0, 0.0, 0.5, alpha / 3, e / 4])
    crossings = (energy - float(energy(left.max()))).roots()
    same = crossings[np.abs(crossings.imag) < 1e-9 * np.abs(crossings)].real
    return min(right, float(same[same > 0].min(initial=math.inf)))


def halves_orbits(shape: Shape) -> ScaledOrbits:
    """Those of two half-planes, stiffness 1 for u < 0 and ratio^2 for u > 0, which scale with the amplitude."""
    one = bilinear_table(Bilinear(1.0, shape[0]), [1.0])
    A = np.geomspace(LEAST * REACH, REACH, FINE)
    return as_scaled(
        OrbitTable(
            A,
            np.full_like(A, one.omega[0]),
            one.action[0] * A**2,
            one.cosine * A,
            one.cubic[0] * A**3,
            one.quartic[0] * A**4,
            one.width[0] * A,
        )
    )


def stop_orbits(shape: Shape, *, side: int) -> ScaledOrbits:
    """Those of a stop at u = s on the ``side`` 1 or -1, or on both (0): ratio of frequencies, and s."""
    ratio, s = shape
    A = np.geomspace(LEAST * REACH, REACH, FINE)
    oscillator = Bilinear(1.0, ratio, max(s, 1e-6), symmetric=side == 0)
    scaled = as_scaled(bilinear_table(oscillator, A, samples=64))
    if side >= 0:
        return scaled
    # u -> -u with the phase counted from the new peak: even harmonics change their sign
    signs = np.array([-1.0 if m % 2 == 0 else 1.0 for m in range(scaled.cosine.shape[0])])
    return replace(scaled, cosine=scaled.cosine * signs[:, None])


def _k(k: float) -> tuple[str, float, str, str]:
    return ("k", k, "rad/T", "frequency of small oscillations")


def _stop(name: str, title: str, restoring: str, side: int) -> Potential:
    ratios, places = (0.5, 0.75, 1.3, 1.8), (0.15, 0.3, 0.5, 0.7)
    return Potential(
        name,
        title,
        restoring,
        lambda shape: stop_orbits(shape, side=side),
        lambda k, L, shape: (
            ("k1", k, "rad/T", "frequency up to the switch"),
            ("k2", k * shape[0], "rad/T", "frequency of the stiffness beyond it"),
            ("s", L * shape[1], "U", "switch"),
        ),
        (0.1, 1e-3),
        (10.0, 1.4),
        (tuple((r, s) for r in ratios for s in places),),
    )


LEAST_TURN = 1e-6
"""Least square of the pendulum's b: there it is a linear oscillator."""
HALF_TURNS = tuple((b**2,) for b in (0.1, 0.2, 0.4, 0.7, 1.0, 1.4, 1.9, 2.4, 2.8, 3.1, 3.3))
CUBIC = tuple((e,) for e in (0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0))
HELMHOLTZ = tuple((a, e) for a in (0.05, 0.15, 0.3, 0.45) for e in (-0.4, -0.15, -0.03, 0.03, 0.1, 0.3, 1.0))
POTENTIALS: tuple[Potential, ...] = (
    Potential("linear", "Linear oscillator", "k^2 u", linear_orbits, lambda k, _, __: (_k(k),)),
    Potential(
        "pendulum",
        "Pendulum-like oscillator",
        "(k^2/b) sin(b u)",
        pendulum_orbits,
        lambda k, L, shape: (_k(k), ("b", math.sqrt(shape[0]) / L, "rad/U", "angle per unit of the signal")),
        (LEAST_TURN,),
        (3.9**2,),  # next to the separatrix the swing is nearly square, with a fundamental of 4/pi times its peak
        (HALF_TURNS,),
    ),
    Potential(
        "duffing-hardening",
        "Duffing oscillator, hardening",
        "k^2 u + eps u^3",
        duffing_orbits,
        lambda k, L, shape: (_k(k), ("eps", shape[0] * (k / L) ** 2, "1/(T^2 U^2)", "cubic stiffness")),
        (0.0,),
        (50.0,),
        ((*CUBIC, (2.5,), (6.0,)),),
    ),
    Potential(
        "duffing-softening",
        "Duffing oscillator, softening",
        "k^2 u + eps u^3",
        duffing_orbits,
        lambda k, L, shape: (_k(k), ("eps", shape[0] * (k / L) ** 2, "1/(T^2 U^2)", "cubic stiffness")),
        (-1.5,),
        (0.0,),
        (tuple((-e,) for (e,) in CUBIC),),
    ),
    Potential(
        "helmholtz-duffing",
        "Helmholtz-Duffing oscillator",
        "k^2 u + alpha u^2 + eps u^3",
        helmholtz_orbits,
        lambda k, L, shape: (
            _k(k),
            ("alpha", shape[0] * k**2 / L, "1/(T^2 U)", "quadratic stiffness"),
            ("eps", shape[1] * (k / L) ** 2, "1/(T^2 U^2)", "cubic stiffness"),
        ),
        (-3.0, -1.5),
        (3.0, 20.0),
        (HELMHOLTZ,),
        lambda shape: (1.0, (-shape[0], shape[1])),
    ),
    Potential(
        "bilinear",
        "Bilinear oscillator, switching at 0",
        "k1^2 u for u < 0, k2^2 u for u > 0",
        halves_orbits,
        lambda k, _, shape: (
            ("k1", k, "rad/T", "frequency of the stiffness at u < 0"),
            ("k2", k * shape[0], "rad/T", "frequency of the stiffness at u > 0"),
        ),
        (0.1,),
        (10.0,),
        (((1.25,),),),
        lambda shape: (shape[0], (1 / shape[0],)),
    ),
    _stop("bilinear-stop", "Bilinear oscillator, switching at u = s", "k1^2 u, with k2 in place of k1 beyond u = s", 1),
    _stop("bilinear-stop-below", "Bilinear oscillator, switching at u = -s", "k1^2 u, with k2 beyond u = -s", -1),
    _stop(
        "bilinear-two-stops", "Bilinear oscillator, switching at both u = s and -s", "k1^2 u, with k2 beyond |u| = s", 0
    ),
)
