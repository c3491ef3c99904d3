"""The slow flow of a lightly damped oscillator as a table, and the motion along it by quadrature.

Averaging a damping 2 mu u' + beta |u'| u' + gamma u'^3 + F sign(u') over an undamped orbit gives the loss of action

    R = -J'/J = 2 mu + (beta <|u'|^3> + gamma <u'^4> + F <|u'|>) / (omega0 J) - G/J,     phi'^2 = omega0^2 + 2 omega0 B,

(Bogoliubov and Mitropolsky 1961), with B of second order in the losses and G of third (``loss_response``; for the
linear oscillator omega0^2 - mu^2 is exact), so that time and phase at each level of action are integrals,
t = int d ln J / R and phi = int omega d ln J / R: no differential equation is left to solve.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.loss_response import OfCosine, OfPotential, Response
from ridgeback.numeric.orbits.orbit_table import OrbitTable

LEAST_RATE = 1e-9
"""Floor of R relative to omega: where damping is lost or turns to growth, the amplitude stays."""
LEAST_OMEGA, MOST_MORE, MOST_SINE, UNSEEN = 0.1, 0.3, 0.5, 1e-9
"""Bounds of phi' over k, of a third order over its first, of a sine over the fundamental; a harmonic to leave out."""
MOST_LOG = 50.0
"""Amplitudes are kept within exp(-50) and exp(50), so that a step of a fit that goes astray has a finite cost."""


@dataclass(frozen=True)
class Flow:
    """A slow flow on nodes in the order in which they are passed; ``rate`` > 0 is that at which ``level`` rises.

    ``growth`` is a'/a of the fundamental amplitude; u/a = sum of cosine[m] cos(m phi) + sine[m] sin(m phi).
    """

    level: Array
    rate: Array
    omega: Array
    growth: Array
    amplitude: Array
    cosine: Array
    sine: Array | None = None

    @cached_property
    def slopes(self) -> Array:
        """Derivatives of time and phase by the level, ``[2, node]``."""
        return np.array([1 / self.rate, self.omega / self.rate])

    @cached_property
    def _bends(self) -> Array:
        """Derivatives by the level of both slopes and of omega."""
        return np.asarray(np.gradient(np.vstack((self.slopes, self.omega)), self.level, axis=1))

    # h/2 (f0 + f1) - h^2/12 (f1' - f0'): the integral of the cubic that has these values and slopes
    @cached_property
    def increments(self) -> Array:
        """Time and phase from each node to the next, ``[2, node - 1]``."""
        f, h = self.slopes, np.diff(self.level)
        return np.asarray(h / 2 * (f[:, 1:] + f[:, :-1]) - h**2 / 12 * np.diff(self._bends[:2], axis=1))

    @cached_property
    def chirp(self) -> Array:
        """d omega / dt at the nodes."""
        return np.asarray(self.rate * self._bends[2])

    @cached_property
    def parts(self) -> tuple[tuple[int, bool, Array], ...]:
        """The harmonics that are there: multiple, whether a sine, and coefficient at the nodes."""
        sine = np.zeros_like(self.cosine) if self.sine is None else self.sine
        both = [
            (m, odd, row) for m, pair in enumerate(zip(self.cosine, sine, strict=True)) for odd, row in enumerate(pair)
        ]
        return tuple((m, bool(odd), row) for m, odd, row in both if row.any())

    @cached_property
    def log_amplitude(self) -> Array:
        """ln a at the nodes."""
        return np.asarray(np.log(self.amplitude))


@dataclass(frozen=True)
class Motion:
    """The motion at given times: phase, frequency, fundamental amplitude, and the displacement itself."""

    phase: Array
    omega: Array
    amplitude: Array
    u: Array


@dataclass(frozen=True)
class ScaledOrbits(OrbitTable):
    """Orbits refined to closely spaced peaks, in units k = 1, and how they respond to losses."""

    response: Response

    @cached_property
    def level(self) -> Array:
        """ln J."""
        return np.asarray(np.log(self.action))

    @cached_property
    def bend(self) -> Array:
        """d ln a / d ln J of the fundamental amplitude: 1/2 for the linear oscillator."""
        return np.asarray(np.gradient(np.log(self.cosine[1]), self.level))


def refine(table: OrbitTable, peak: Array) -> ScaledOrbits:
    """Interpolate a table with natural frequency 1 to more peaks by splines that know the limit of small amplitude.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> from ridgeback.numeric.orbits.orbit_table import orbit_table
    >>> table = orbit_table(pendulum(), 2.0 * np.sin(np.pi / 48 * np.arange(1, 25)))
    >>> fine = refine(table, np.array([0.0, 1.0]))
    >>> bool(np.abs(fine.omega - [1.0, pendulum().closed_form(1.0)]).max() < 1e-9)
    True
    """
    A = table.peak
    powers = [table.action / A**2, table.cubic / A**3, table.quartic / A**4, table.width / A]
    columns = [table.omega, *powers, *(table.cosine / A)]
    first = np.zeros(table.cosine.shape[0])
    first[1] = 1.0
    limit = np.array([1.0, 0.5, 4 / (3 * math.pi), 0.375, 2.0, *first])
    values = np.vstack((limit, np.array(columns).T))
    fine = CubicSpline(np.concatenate(([0.0], A)), values)(peak).T
    return ScaledOrbits(
        peak,
        fine[0],
        fine[1] * peak**2,
        fine[5:] * peak,
        fine[2] * peak**3,
        fine[3] * peak**4,
        fine[4] * peak,
        OfPotential(table, peak),
    )


def as_scaled(table: OrbitTable) -> ScaledOrbits:
    """A table that is fine enough as it is, and too rough for a response of its own: it has that of its cosine."""
    columns = table.peak, table.omega, table.action, table.cosine, table.cubic, table.quartic, table.width
    return ScaledOrbits(*columns, OfCosine(table.cosine[1], table.omega))


def decay_flow(orbits: ScaledOrbits, *, k: float, length: float, rates: tuple[float, ...]) -> Flow:
    """Return the slow flow of scaled orbits under damping forces 2 mu u' + beta |u'| u' + gamma u'^3 + F sign(u').

    Parameters
    ----------
    orbits : ScaledOrbits
        In units k = 1.
    k : float
        Natural frequency, rad per time unit.
    length : float
        The unit of u.
    rates : tuple of float
        2 mu, beta L k, gamma L^2 k^2 and, with dry friction, F/(L k), per time unit.

    Returns
    -------
    Flow
        Growth rate, frequency and amplitude by level.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> from ridgeback.numeric.orbits.orbit_table import orbit_table
    >>> orbits = refine(orbit_table(linear(), np.linspace(0.1, 1.0, 9)), np.geomspace(0.01, 1.0, 99))
    >>> flow = decay_flow(orbits, k=2.0, length=1.0, rates=(0.2, 0.0, 0.0))
    >>> np.allclose(flow.growth, -0.1), np.allclose(flow.omega, np.sqrt(4.0 - 0.01))
    (True, True)
    """
    power = orbits.omega * orbits.action
    loss = rates[0] + (rates[1] * orbits.cubic + rates[2] * orbits.quartic) / power
    if len(rates) > 3:
        loss = loss + rates[3] * orbits.width / (math.pi * orbits.action)
    fundamental, scaled = orbits.cosine[1], [rate / k for rate in rates]
    omega, loss, sine = responding(orbits.response, orbits.omega, fundamental, loss / k, scaled)
    cosine, down = orbits.cosine / fundamental, slice(None, None, -1)
    cosine[np.abs(cosine).max(axis=1) < UNSEEN] = 0.0
    return Flow(
        level=-orbits.level[down],
        rate=k * loss[down],
        omega=k * omega[down],
        growth=-k * (loss * orbits.bend)[down],
        amplitude=length * fundamental[down],
        cosine=cosine[:, down],
        sine=sine[:, down],
    )


def responding(
    response: Response, omega: Array, fundamental: Array, loss: Array, rates: Sequence[float]
) -> tuple[Array, Array, Array]:
    """phi', R and the sines of u/a under losses, of omega0 and R in first order, in units k = 1.

    All are kept within what a fit that goes astray can bear.
    """
    under = response.under(rates)
    square = omega**2 + 2.0 * omega * under.shift
    more, most = under.more, MOST_MORE * np.abs(loss)
    sine = np.clip(under.sines / fundamental, -MOST_SINE, MOST_SINE)
    sine[np.abs(sine).max(axis=1) < UNSEEN] = 0.0
    loss = np.maximum(loss + np.clip(more, -most, most), LEAST_RATE * omega)
    return np.sqrt(np.maximum(square, LEAST_OMEGA**2)), loss, sine


@dataclass(frozen=True)
class Places:
    """Where points lie between nodes: indices of both, and the shares of the step there that are passed and left.

    ``weights`` are those of the values left and right, and of the slopes there, in the cubic through them.
    """

    index: NDArray[np.intp]
    after: NDArray[np.intp]
    share: Array
    rest: Array
    weights: tuple[Array, Array, Array, Array]


@dataclass(frozen=True)
class Path:
    """A motion but for its phase at t = 0: what it has turned by since, frequency, amplitude, and where on the flow."""

    flow: Flow
    place: Places
    done: float
    turned: Array
    late: Array
    """What it has turned by beyond the last node."""
    omega: Array
    amplitude: Array

    def at_phase(self, phase: float, *, waveform: bool = True) -> Motion:
        """The motion with this phase at t = 0; without ``waveform`` u is left at 0."""
        angle = phase - self.done + self.turned + self.late
        wave = _wave(self.flow, self.place, angle) if waveform else np.zeros_like(angle)
        return Motion(angle, self.omega, self.amplitude, self.amplitude * wave)


def motion(flow: Flow, start: float, phase: float, time: Array, *, waveform: bool = True) -> Motion:
    """Follow the flow from the level ``start`` and a phase at t = 0, for ``time`` of 0 or more.

    A start before the first node is put there; beyond the last node the motion keeps its rate, frequency and form.
    Without ``waveform`` u is left at 0.

    >>> level = np.linspace(0.0, 5.0, 60)
    >>> flow = Flow(level, np.full(60, 0.2), np.full(60, 3.0), np.full(60, -0.1), np.exp(-level / 2),
    ...             np.array([[0.0], [1.0]]) + np.zeros(60))
    >>> at = motion(flow, 0.0, 0.5, np.array([0.0, 2.0]))
    >>> np.allclose(at.u, np.exp([0.0, -0.2]) * np.cos([0.5, 6.5])), np.allclose(at.phase, [0.5, 6.5])
    (True, True)
    """
    return path(flow, start, time).at_phase(phase, waveform=waveform)


def path(flow: Flow, start: float, time: Array) -> Path:
    """The same for any phase at t = 0."""
    begin = np.array([np.clip(start, flow.level[0], flow.level[-1])])
    at = _places(flow.level, begin)
    # counted from the node before the start: where damping is almost none, nodes are ages apart
    first = int(at.index[0])
    clock, turned = (np.concatenate((np.zeros(first + 1), np.cumsum(row[first:]))) for row in flow.increments)
    began, done = (float(_hermite(at, v, s)[0]) for v, s in zip((clock, turned), flow.slopes, strict=True))
    want = began + time
    inside = np.minimum(want, clock[-1])
    late = want - inside
    place = _places(clock, inside, first)
    omega = _hermite(place, flow.omega, flow.chirp)
    logarithm = _hermite(place, flow.log_amplitude, flow.growth) + late * flow.growth[-1]
    return Path(
        flow=flow,
        place=place,
        done=done,
        turned=_hermite(place, turned, flow.omega),
        late=late * omega,
        omega=omega,
        amplitude=np.exp(np.clip(logarithm, -MOST_LOG, MOST_LOG)),
    )


def _places(nodes: Array, points: Array, first: int = 0) -> Places:
    """Places of points among the nodes from ``first`` on."""
    index = np.clip(np.searchsorted(nodes[first:], points) - 1, 0, nodes.size - first - 2) + first
    after = index + 1
    begin = nodes[index]
    step = nodes[after] - begin
    s = (points - begin) / step
    rest = 1 - s
    left, right, between = rest**2, s**2, step * s * rest
    return Places(index, after, s, rest, ((1 + 2 * s) * left, (1 + 2 * rest) * right, between * rest, -between * s))


def _hermite(at: Places, values: Array, slopes: Array) -> Array:
    """Cubic through values and slopes of both neighbouring nodes."""
    i, j = at.index, at.after
    left, right, rise_left, rise_right = at.weights
    whole = left * values.take(i) + right * values.take(j)
    return np.asarray(whole + rise_left * slopes.take(i) + rise_right * slopes.take(j))


def _linear(at: Places, values: Array) -> Array:
    return np.asarray(values.take(at.index) * at.rest + values.take(at.after) * at.share)


def _wave(flow: Flow, at: Places, phase: Array) -> Array:
    """u/a by powers of exp(i phi); the small coefficients of the other harmonics are interpolated linearly."""
    turn = np.empty(phase.shape, dtype=np.complex128)
    turn.real, turn.imag = np.cos(phase), np.sin(phase)
    power, reached = np.ones_like(turn), 0
    total = np.zeros_like(phase)
    for m, odd, row in flow.parts:
        for _ in range(m - reached):
            power = power * turn
        reached = m
        total += (row[0] if (m, odd) == (1, False) else _linear(at, row)) * (power.imag if odd else power.real)
    return total
