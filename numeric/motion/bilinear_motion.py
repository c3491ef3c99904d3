"""The damped motion of a bilinear oscillator, piece by piece in closed form, its switches located to rounding.

On one side of a switch u'' + 2 mu u' + k^2 (u - c) = 0, so that from the state (u0, v0) at t = 0

    u = c + exp(-mu t) (P cos w t + Q sin w t),   w^2 = k^2 - mu^2,   P = u0 - c,   Q = (v0 + mu P) / w.

Its extrema lie pi/w apart and decay, so that a level is reached before the second extremum or never; between two
extrema u is monotone, and one bracketed root is the switch.  No step size and no tolerance enter.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen, frozen_mask
from ridgeback.numeric.motion.bilinear import Bilinear, as_dynamics
from ridgeback.numeric.motion.events import CrossingEvents, TurningEvents
from ridgeback.numeric.motion.request import check_request
from ridgeback.numeric.motion.trajectory import Trajectory, sample_times

MAX_PIECES = 1_000_000
_ROUNDING = 4 * float(np.spacing(1.0))


@dataclass(frozen=True)
class Piece:
    """The motion from ``start`` until the next switch, about the centre ``c`` with natural frequency ``k``."""

    start: float
    centre: float
    k: float
    mu: float
    u: float
    velocity: float

    @property
    def omega(self) -> float:
        """w = sqrt(k^2 - mu^2)."""
        return math.sqrt((self.k - self.mu) * (self.k + self.mu))

    @property
    def coefficients(self) -> tuple[float, float]:
        """P and Q."""
        P = self.u - self.centre
        return P, (self.velocity + self.mu * P) / self.omega

    def at(self, t: float) -> tuple[float, float]:
        """u and u' at a time t after the start.

        >>> [round(x, 12) for x in Piece(0.0, 1.0, 2.0, 0.0, 2.0, 0.0).at(math.pi / 2)]
        [0.0, -0.0]
        """
        (P, Q), w = self.coefficients, self.omega
        decay, c, s = math.exp(-self.mu * t), math.cos(w * t), math.sin(w * t)
        along = P * c + Q * s
        return self.centre + decay * along, decay * (w * (Q * c - P * s) - self.mu * along)

    def first_turning(self) -> float:
        """Time to the first extremum after the start: tan(w t) = (w Q - mu P) / (w P + mu Q)."""
        (P, Q), w = self.coefficients, self.omega
        if self.velocity == 0:
            return math.pi / w
        angle = math.atan2(w * Q - self.mu * P, w * P + self.mu * Q) % math.pi
        return (angle if angle > 0 else math.pi) / w

    def passage(self, level: float) -> float | None:
        """Time to the next crossing of ``level`` after the start; None when it is never reached.

        >>> Piece(0.0, 0.0, 1.0, 0.0, 1.0, 0.0).passage(0.0) == math.pi / 2
        True
        """
        first = self.first_turning()
        ends = [0.0, first, first + math.pi / self.omega]
        sides = [self.u - level, *(self.at(t)[0] - level for t in ends[1:])]
        for i in (0, 1):
            if sides[i] * sides[i + 1] < 0:
                return self._root(level, ends[i], ends[i + 1])
        return None

    def _root(self, level: float, low: float, high: float) -> float:
        smallest = _ROUNDING * math.pi / self.omega
        root: float = brentq(lambda t: self.at(t)[0] - level, low, high, xtol=smallest, rtol=_ROUNDING)
        return root


def bilinear_motion(oscillator: Bilinear, initial: tuple[float, float], *, duration: float, rate: float) -> Trajectory:
    """Return the motion of a bilinear oscillator, with its events.

    Every value is a closed form between located switches, so the error is rounding that grows with their number.

    Parameters
    ----------
    oscillator : Bilinear
        The oscillator.
    initial : (float, float)
        u and u' at t = 0.
    duration : float
        How long, in time units.
    rate : float
        Samples per time unit.

    Returns
    -------
    Trajectory
        Samples over 0 .. ``duration``, with located zero crossings and turning points.

    Raises
    ------
    InputError
        For a start at rest at 0, values that are not finite, and work beyond the budget.

    Examples
    --------
    >>> from ridgeback.numeric.motion.bilinear import Bilinear
    >>> run = bilinear_motion(Bilinear(1.0, 2.0), (1.0, 0.0), duration=5.0, rate=1.0)  # a period of 1.5 pi
    >>> [round(float(t), 12) for t in run.turnings.time]
    [0.0, 2.356194490192, 4.712388980385]
    """
    u, v = check_request(as_dynamics(oscillator), initial, duration=duration, rate=rate)
    pieces = list(_pieces(oscillator, u, v, duration))
    time = np.minimum(sample_times(duration, rate), duration)
    dense = _dense(pieces)
    samples, velocity = dense(time)
    steps = np.array([*(piece.start for piece in pieces), duration])
    return Trajectory(
        name="bilinear",
        time=frozen(time),
        u=frozen(samples),
        velocity=frozen(velocity),
        rate=float(rate),
        duration=float(duration),
        crossings=_crossings(pieces, duration),
        turnings=_turnings(pieces, duration),
        method="closed form between switches",
        rtol=_ROUNDING,
        evaluations=len(pieces),
        steps=frozen(steps),
        interpolant=dense,
    )


def _pieces(oscillator: Bilinear, u: float, v: float, duration: float) -> list[Piece]:
    """The pieces in order; each ends where u reaches its boundary, exactly on it."""
    found: list[Piece] = []
    t = 0.0
    while t < duration:
        if len(found) == MAX_PIECES:
            raise InputError(f"bilinear: more than {MAX_PIECES} switches before t = {t:.6g}; use a shorter duration")
        piece = _piece(oscillator, t, u, v)
        found.append(piece)
        passages = [(p, level) for level in _levels(oscillator, piece) if (p := piece.passage(level)) is not None]
        if not passages:
            break
        wait, u = min(passages)
        v = piece.at(wait)[1]
        t += wait
    return found


def _piece(oscillator: Bilinear, t: float, u: float, v: float) -> Piece:
    """The piece that starts here; on a switch the velocity says which side is entered."""
    k1, k2, s = oscillator.inner, oscillator.outer, oscillator.switch
    centre = s - (k1 * k1 * s + oscillator.preload) / (k2 * k2)
    if u > s or (u == s and v > 0):
        return Piece(t, centre, k2, oscillator.mu, u, v)
    if oscillator.symmetric and (u < -s or (u == -s and v < 0)):
        return Piece(t, -centre, k2, oscillator.mu, u, v)
    return Piece(t, 0.0, k1, oscillator.mu, u, v)


def _levels(oscillator: Bilinear, piece: Piece) -> tuple[float, ...]:
    """Values of u at which this piece ends."""
    s = oscillator.switch
    if not oscillator.symmetric:
        return (s,)
    inside = abs(piece.u) < s or (abs(piece.u) == s and piece.u * piece.velocity <= 0)
    return (-s, s) if inside else (math.copysign(s, piece.u),)


def _dense(pieces: list[Piece]) -> Callable[[Array], tuple[Array, Array]]:
    """u and u' at any times, vectorised over the pieces."""
    start, centre, mu = (np.array([getattr(p, name) for p in pieces]) for name in ("start", "centre", "mu"))
    w = np.array([p.omega for p in pieces])
    P, Q = np.array([p.coefficients for p in pieces]).T

    def dense(time: Array) -> tuple[Array, Array]:
        i = np.clip(np.searchsorted(start, time, side="right") - 1, 0, start.size - 1)
        t = time - start[i]
        decay, c, s = np.exp(-mu[i] * t), np.cos(w[i] * t), np.sin(w[i] * t)
        along = P[i] * c + Q[i] * s
        return centre[i] + decay * along, decay * (w[i] * (Q[i] * c - P[i] * s) - mu[i] * along)

    return dense


def _ends(pieces: list[Piece], duration: float) -> list[float]:
    return [*(piece.start for piece in pieces[1:]), duration]


def _turnings(pieces: list[Piece], duration: float) -> TurningEvents:
    """Turning points of every piece, and a start at rest."""
    times, values = [], []
    if pieces[0].velocity == 0:
        times, values = [0.0], [pieces[0].u]
    for piece, end in zip(pieces, _ends(pieces, duration), strict=True):
        local = piece.first_turning()
        while piece.start + local <= end:
            times.append(piece.start + local)
            values.append(piece.at(local)[0])
            local += math.pi / piece.omega
    return TurningEvents(frozen(times), frozen(values))


def _crossings(pieces: list[Piece], duration: float) -> CrossingEvents:
    """Zeros of u: the switches themselves when s = 0, else zeros within pieces, pi/w apart about the centre 0."""
    times: list[float] = []
    velocities: list[float] = []
    for piece, end in zip(pieces, _ends(pieces, duration), strict=True):
        if piece.u == 0.0:
            times.append(piece.start)
            velocities.append(piece.velocity)
        local = piece.passage(0.0)
        while local is not None and piece.start + local < end:
            times.append(piece.start + local)
            velocities.append(piece.at(local)[1])
            local = local + math.pi / piece.omega if piece.centre == 0.0 else None
    kept = np.array(velocities)
    return CrossingEvents(frozen(times), frozen_mask(kept > 0), frozen(kept))
