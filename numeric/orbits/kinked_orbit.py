r"""The undamped orbit of a force with kinks, stretch by stretch: between kinks all is smooth, and Gauss-Legendre exact.

On a stretch from b, its end towards the turning point, inwards to a, with E - V(b) = e left of the energy and the force
f_b at b, let d = e / f_b, so that b + d is where the law of this stretch would turn.  With y^2 = d + b - u

    E - V(u) = e + (b - u) <V'>_[u,b] = y^2 g,   dt = sqrt(2/g) dy,   u'^2 = 2 g y^2,   sqrt(d) < y < sqrt(d + b - a),

and g is smooth up to the ends, also where the orbit only just passes b; at the turning point itself e = d = 0.  For a
constant force g is constant.  Distances are from rest, on the left counted to the left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.polynomial import legendre

from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.events import Switches
from ridgeback.numeric.orbits.potential import Restoring, gauss, mean_restoring, restoring_of

FEWEST, MOST = 16, 256
"""Nodes of a stretch; they are doubled until the frequency has settled."""
INNER = 24
"""Fewest Gauss points of a mean of V' within a stretch; they rise with the nodes."""
FARTHEST = 1e3
"""Of d, in lengths of the stretch: where the force at b is small, any d will do."""


@dataclass(frozen=True)
class HalfOrbit:
    """From each peak to its trough: nodes ``[orbit, node]`` in the order of time, with weights of dt."""

    u: Array
    speed: Array
    weight: Array
    time: Array

    @property
    def duration(self) -> Array:
        """Half the period."""
        return np.asarray(self.weight.sum(axis=1))

    def mean(self, values: Array) -> Array:
        """The mean over half a cycle."""
        return np.asarray((values * self.weight).sum(axis=1) / self.duration)

    @property
    def action(self) -> Array:
        """J, 1/pi times the integral of u'^2 over half a cycle."""
        return np.asarray((self.speed**2 * self.weight).sum(axis=1) / np.pi)


@dataclass(frozen=True)
class _Stretch:
    """Nodes from the outer end of a stretch inwards."""

    distance: Array
    speed: Array
    weight: Array
    elapsed: Array


def half_orbit(dynamics: Dynamics, low: Array, high: Array, nodes: int) -> HalfOrbit:
    """The orbits between turning points low < 0 < high, of a force with kinks in u.

    >>> from ridgeback.numeric.motion.events import Switches
    >>> place = Switches((0.5,), False, lambda stretch, side: lambda u, v: u)
    >>> stop = Dynamics("stop", lambda u, v: u, 1.0, restoring=np.asarray, switches=place)
    >>> half_orbit(stop, np.array([-1.0]), np.array([1.0]), 16).duration.round(12).tolist()  # a kink that is none
    [3.14159265359]
    """
    right = list(_stretches(dynamics, high, 1, nodes))
    left = list(_stretches(dynamics, -low, -1, nodes))
    before = np.zeros_like(high)
    times: list[Array] = []
    for each in right:
        times.append(before[:, None] + each.elapsed)
        before = before + each.weight.sum(axis=1)
    for each in reversed(left):
        before = before + each.weight.sum(axis=1)
        times.append((before[:, None] - each.elapsed)[:, ::-1])
    back = [(-e.distance[:, ::-1], e.speed[:, ::-1], e.weight[:, ::-1]) for e in reversed(left)]
    parts = [(e.distance, e.speed, e.weight) for e in right] + back
    u, speed, weight = (np.hstack([part[i] for part in parts]) for i in range(3))
    return HalfOrbit(u, speed, weight, np.hstack(times))


def settled_half_orbit(dynamics: Dynamics, low: Array, high: Array, tolerance: float) -> tuple[HalfOrbit, Array]:
    """The orbits with as many nodes as they need, and what the last doubling changed of each frequency, relative."""
    nodes, found = FEWEST, half_orbit(dynamics, low, high, FEWEST)
    change = np.full_like(high, np.inf)
    while nodes < MOST and np.any(change > tolerance):
        nodes *= 2
        finer = half_orbit(dynamics, low, high, nodes)
        change = np.abs(finer.duration / found.duration - 1)
        found = finer
    return found, change


def since_turning(dynamics: Dynamics, turn: float, side: int, u: float, nodes: int = MOST) -> tuple[float, float]:
    """Time and integral of u'^2 from a turning point to u on the same side of rest."""
    parts = list(_stretches(dynamics, np.array([abs(turn)]), side, nodes, until=abs(u)))
    return float(sum(e.weight.sum() for e in parts)), float(sum((e.speed**2 * e.weight).sum() for e in parts))


def _stretches(dynamics: Dynamics, turn: Array, side: int, nodes: int, until: float = 0.0) -> Iterator[_Stretch]:
    """The stretches of one side from the turning points inwards, down to a distance from rest."""
    switches, restoring = cast(Switches, dynamics.switches), restoring_of(dynamics)
    kinks = sorted(side * place for place in switches.places if side * place > until)
    left = np.zeros_like(turn)
    for outer, inner in zip((np.inf, *reversed(kinks)), (*reversed(kinks), until), strict=True):
        top = np.maximum(np.minimum(turn, outer), inner)
        length = top - inner
        reach = np.zeros_like(turn)
        if np.isfinite(outer):
            middle = side * 0.5 * (outer + inner)
            pull = side * switches.pull(switches.stretch(middle, 0.0), side * outer)
            reach = _virtual(left, pull, length)
        force = _Pull(restoring, side, max(nodes, INNER))
        yield _stretch(force, top, length, reach, left, nodes)
        left = left + length * force.mean(top, length)


@dataclass(frozen=True)
class _Pull:
    """The force towards rest at distances on one side."""

    restoring: Restoring
    side: int
    points: int

    def mean(self, outer: Array, inwards: Array) -> Array:
        """Its mean over a way inwards."""
        return self.side * mean_restoring(self.restoring, self.side * outer, -self.side * inwards, self.points)


def _virtual(left: Array, pull: float, length: Array) -> Array:
    """How far beyond the end of its stretch a law would turn the motion, d = e / f_b."""
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.minimum(left / max(pull, 0.0), FARTHEST * length)
    return np.where(left > 0, reach, 0.0)


def _stretch(pull: _Pull, top: Array, length: Array, reach: Array, left: Array, nodes: int) -> _Stretch:
    x, weights = gauss(nodes)
    x, weights = 0.5 * (1 + x), 0.5 * weights
    start = np.sqrt(reach)[:, None]
    width = length[:, None] / (np.sqrt(reach + length)[:, None] + start + (length[:, None] == 0))
    y = start + width * x
    way = width * x * (y + start)  # b - u, without cancellation
    with np.errstate(divide="ignore", invalid="ignore"):
        g = np.where(length[:, None] > 0, (left[:, None] + way * pull.mean(top[:, None], way)) / y**2, 1.0)
    rate = np.sqrt(2 / g)
    return _Stretch(top[:, None] - way, np.sqrt(2 * g) * y, rate * width * weights, width * (rate @ _integrals(nodes)))


@lru_cache(maxsize=8)
def _integrals(nodes: int) -> Array:
    """The matrix that takes values at Gauss points in 0..1 to their integrals from 0 to each of the points.

    Through the Legendre series, the integral of P_j being (P_{j+1} - P_{j-1})/(2j + 1).

    >>> x = 0.5 * (1 + gauss(8)[0])
    >>> bool(np.allclose(x**3 @ _integrals(8), x**4 / 4, rtol=1e-13))
    True
    """
    x, weights = gauss(nodes)
    values = legendre.legvander(x, nodes)
    j = np.arange(nodes)
    coefficients = (weights[:, None] * values[:, :nodes]) * (2 * j + 1) / 2
    integrals = np.empty((nodes, nodes))
    integrals[0] = 1 + x
    integrals[1:] = ((values[:, 2:] - values[:, : nodes - 1]) / (2 * j[1:] + 1)).T
    return frozen(0.5 * coefficients @ integrals)
