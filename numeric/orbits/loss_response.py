r"""What losses do to the waveform in first order, to the frequency in second and to the decay in third, in any well.

In the action J and the phase phi of the undamped orbit u = U(J, phi), a loss h(u') acts by

    J' = f = -h U_phi,      phi' = omega + g,      g = h U_J.

With J = I + P1 + P2 and phi = psi + Q1 + Q2 of zero mean but for what is said below, the slow flow I' = F, psi' = omega
+ B is (N. N. Bogoliubov and Y. A. Mitropolsky, Asymptotic Methods in the Theory of Non-linear Oscillations, 1961)

    F = <f>,    omega P1_psi = f - F,    omega Q1_psi = g + omega_J P1,
    omega P2_psi = f_J P1 + f_phi Q1 - F P1_J,
    B = <omega_J P2 + omega_JJ P1^2 / 2 + g_J P1 + g_phi Q1 - F Q1_J>,     omega Q2_psi = that less its mean,

with every derivative at (I, psi), and I' in third order, for the second vanishes as losses change sign with time,

    G = <f_J P2 + f_phi Q2 + f_JJ P1^2 / 2 + f_Jphi P1 Q1 + f_phiphi Q1^2 / 2> - F <P2>_J.

The means of Q1 and P2 are those with which a cos psi is the first harmonic of u to second order, a that of the
undamped orbit; u has sines of first order then.  On the cosine of a linear force B is -mu^2/2 of 2 mu u', which has no
G, and -6 F^2/(pi a)^2 of F sign(u').
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from functools import cache, lru_cache
from itertools import combinations_with_replacement

import numpy as np
from scipy.interpolate import CubicSpline

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.orbit_table import HARMONICS, OrbitTable

EXPONENTS = (1, 2, 3, 0)
"""Powers of |u'| in the losses |u'|^r sign(u') that go by these numbers: linear, quadratic, cubic, dry friction."""
POINTS = 64
"""Phases of a cycle, none of them at a turning point, where dry friction jumps."""


@dataclass(frozen=True, eq=False)
class Orbits:
    """Undamped orbits on the peaks of a table, ``[peak, phase]``, with their derivatives by the action."""

    along: AlongPeaks
    J: Array
    J_A: Array
    """dJ/dA."""
    omega: Array
    omega1: Array
    omega2: Array
    """Its derivatives by J."""
    first: Array
    """Coefficient of cos phi in u."""
    slope: Array
    """U_phi."""
    bend: Array
    """U_phi phi."""
    U_J: Array
    U_JJ: Array
    U_Jphi: Array

    def by_action(self, values: Array, power: int) -> Array:
        """Derivative by J of what goes with this power of the peak as that vanishes."""
        return self.along.slope(values, power) / self.J_A


@dataclass(frozen=True, eq=False)
class First:
    """The first order of one loss, ``[peak, phase]``, or of a sum in each trial, ``[trial, peak, phase]``.

    It is linear in the loss.
    """

    F: Array
    P1: Array
    P1_J: Array
    Q1: Array
    Q1_J: Array
    g: Array
    g1: Array
    f1: Array
    f2: Array
    """Derivatives by J."""
    f_phi: Array
    f_phi1: Array


def weighted(firsts: Sequence[First], rates: Array) -> First:
    """The first order of sums of losses at their rates, ``[trial, loss]``."""
    columns = rates.T[:, :, None, None]

    def total(name: str) -> Array:
        return np.asarray(sum(column * getattr(one, name) for column, one in zip(columns, firsts, strict=True)))

    return First(*(total(name.name) for name in fields(First)))


@dataclass(frozen=True, eq=False)
class AlongPeaks:
    """Derivatives along peaks, of splines through A^-power times the values, which are smooth down to rest."""

    peak: Array
    matrix: Array
    """Values of a spline to its slopes, at the peaks."""

    def slope(self, values: Array, power: int) -> Array:
        """d/dA of values ``[..., peak, phase]`` that go with this power of the peak as that vanishes."""
        A = self.peak[:, None]
        return np.asarray(A**power * (self.matrix @ (values / A**power)) + power / A * values)


def along(peak: Array) -> AlongPeaks:
    """Cubic splines are linear in their values."""
    return AlongPeaks(peak, np.asarray(CubicSpline(peak, np.eye(peak.size))(peak, 1)))


def orbits_of(table: OrbitTable) -> Orbits:
    """Orbits of a table of rising peaks, at POINTS phases."""
    m = np.arange(table.cosine.shape[0])
    angle = np.outer(m, (np.arange(POINTS) + 0.5) * (2 * np.pi / POINTS))
    u, slope, bend = (
        table.cosine.T @ wave
        for wave in (np.cos(angle), -m[:, None] * np.sin(angle), -(m[:, None] ** 2) * np.cos(angle))
    )
    peaks, omega = along(table.peak), table.omega[:, None]
    J_A = peaks.slope(table.action[:, None], 2)
    omega1, U_J = peaks.slope(omega, 0) / J_A, peaks.slope(u, 1) / J_A
    return Orbits(
        along=peaks,
        J=table.action[:, None],
        J_A=J_A,
        omega=omega,
        omega1=omega1,
        omega2=peaks.slope(omega1, 0) / J_A,
        first=table.cosine[1][:, None],
        slope=slope,
        bend=bend,
        U_J=U_J,
        U_JJ=peaks.slope(U_J, -1) / J_A,
        U_Jphi=peaks.slope(slope, 1) / J_A,
    )


def mean(values: Array) -> Array:
    """Over a cycle."""
    return np.asarray(values.mean(axis=-1, keepdims=True))


@cache
def _primitives() -> Array:
    """What phases are multiplied by for the integral of their trigonometric polynomial: dft, 1/(i m), and back."""
    m = np.fft.fftfreq(POINTS, 1 / POINTS)
    weight = np.where(np.abs(m) % (POINTS // 2) == 0, 0.0, 1 / np.where(m == 0.0, 1.0, 1j * m))
    return np.asarray(np.fft.ifft(weight[:, None] * np.fft.fft(np.eye(POINTS), axis=0), axis=0).real.T.copy())


def primitive(values: Array) -> Array:
    """The integral over the phase, of zero mean, of values less their mean."""
    return np.asarray(values @ _primitives())


@cache
def _waves(multiple: int, wave: np.ufunc) -> Array:
    """The cosine or sine of a multiple of the phase."""
    return np.asarray(wave(multiple * (np.arange(POINTS) + 0.5) * (2 * np.pi / POINTS)))


def harmonic(values: Array, multiple: int, wave: np.ufunc) -> Array:
    """Coefficient of the cosine or sine of a multiple of the phase."""
    return 2.0 * mean(values * _waves(multiple, wave))


def first_order(orbits: Orbits, exponent: int) -> First:
    """Of the loss |u'|^exponent sign(u')."""
    o = orbits
    velocity = o.omega * o.slope
    h = np.abs(velocity) ** exponent * np.sign(velocity)
    stiffer = exponent * np.abs(velocity) ** (exponent - 1) if exponent else np.zeros_like(velocity)
    f, g = -h * o.slope, h * o.U_J
    f1, f_phi = o.by_action(f, exponent + 1), -stiffer * o.omega * o.bend * o.slope - h * o.bend
    F = mean(f)
    P1 = primitive(f) / o.omega
    turned = primitive(g + o.omega1 * P1) / o.omega
    Q1 = turned + harmonic(o.U_J * P1 + o.slope * turned, 1, np.sin) / o.first
    return First(
        F=F,
        P1=P1,
        P1_J=o.by_action(P1, exponent + 1),
        Q1=Q1,
        Q1_J=o.by_action(Q1, exponent - 1),
        g=g,
        g1=o.by_action(g, exponent - 1),
        f1=f1,
        f2=o.by_action(f1, exponent - 1),
        f_phi=f_phi,
        f_phi1=o.by_action(f_phi, exponent + 1),
    )


# g_phi Q1 and f_phiphi Q1^2 are taken by parts: dry friction jumps at the turning points
def higher_orders(orbits: Orbits, first: First, lowest: int) -> tuple[Array, Array]:
    """B and -G/J at each peak, ``[trial, peak]``, of losses of which ``lowest`` is the least exponent."""
    o, s = orbits, first
    turning = (s.g + o.omega1 * s.P1) / o.omega
    P2 = primitive(s.f1 * s.P1 + s.f_phi * s.Q1 - s.F * s.P1_J) / o.omega
    rest = o.omega1 * P2 + 0.5 * o.omega2 * s.P1**2 + s.g1 * s.P1 - s.g * turning - s.F * s.Q1_J
    Q2 = (primitive(rest) + s.g * s.Q1) / o.omega
    waves = o.U_J * P2 + o.slope * Q2 + 0.5 * o.U_JJ * s.P1**2 + o.U_Jphi * s.P1 * s.Q1 + 0.5 * o.bend * s.Q1**2
    level = -harmonic(waves, 1, np.cos) / harmonic(o.U_J, 1, np.cos)
    lost = s.f1 * (P2 + level) + s.f_phi * (Q2 - s.Q1 * turning) + 0.5 * s.f2 * s.P1**2 + s.f_phi1 * s.P1 * s.Q1
    G = mean(lost) - s.F * o.by_action(level, 2 * lowest)
    return (mean(rest) + o.omega1 * level)[..., 0], -(G / o.J)[..., 0]


@dataclass(frozen=True)
class Acting:
    """Losses that act together, and the products of two and of three of their rates that the orders go with."""

    losses: tuple[int, ...]

    @property
    def pairs(self) -> list[tuple[int, ...]]:
        """Every two of them, each with itself too."""
        return list(combinations_with_replacement(self.losses, 2))

    @property
    def triples(self) -> list[tuple[int, ...]]:
        """Every three."""
        return list(combinations_with_replacement(self.losses, 3))

    @property
    def sines(self) -> list[tuple[int, ...]]:
        """Each alone, once for every harmonic."""
        return [(i,) for i in self.losses for _ in range(HARMONICS + 1)]

    def tried(self) -> Array:
        """Rates, one row a trial, by which a cubic form is known: those with the sum 3 of whole numbers."""
        return np.array([[one.count(i) for i in self.losses] for one in self.triples], dtype=float)

    def products(self, rates: Array, of: list[tuple[int, ...]]) -> Array:
        """Those of rates ``[trial, loss]``, ``[trial, product]``."""
        places = {loss: rates[:, at] for at, loss in enumerate(self.losses)}
        return np.array([np.prod([places[i] for i in one], axis=0) for one in of]).T


# B is a quadratic form in the rates and G a cubic one
def parts_at_peaks(orbits: Orbits, acting: Acting) -> Array:
    """B by pairs, -G/J by triples and the coefficients of sin(m phi) in u by losses, at each peak: ``[part, peak]``."""
    firsts = [first_order(orbits, EXPONENTS[i]) for i in acting.losses]
    rates, lowest = acting.tried(), min(EXPONENTS[i] for i in acting.losses)
    B, lost = higher_orders(orbits, weighted(firsts, rates), lowest)
    second = np.linalg.lstsq(acting.products(rates, acting.pairs), B, rcond=None)[0]
    third = np.linalg.solve(acting.products(rates, acting.triples), lost)
    waves = [orbits.U_J * one.P1 + orbits.slope * one.Q1 for one in firsts]
    sines = [harmonic(wave, m, np.sin)[:, 0] * (m > 1) for wave in waves for m in range(HARMONICS + 1)]
    return np.concatenate((second, third, sines))


@dataclass(frozen=True)
class Under:
    """What losses do at M amplitudes: B, what they add to -J'/J, and coefficients of sin(m phi) in u, ``[m, M]``."""

    shift: Array
    more: Array
    sines: Array


def together(acting: Acting, parts: Array, rates: Sequence[float]) -> Under:
    """The parts of the losses at their rates."""
    row = np.array([[rates[i] for i in acting.losses]])
    ends = np.cumsum([len(acting.pairs), len(acting.triples)])
    second, third, sines = np.split(parts, ends)
    return Under(
        (acting.products(row, acting.pairs) @ second)[0],
        (acting.products(row, acting.triples) @ third)[0],
        np.tensordot(row[0], sines.reshape(len(acting.losses), HARMONICS + 1, -1), 1),
    )


@lru_cache(maxsize=1)
def at_rest() -> Orbits:
    """Those of the linear oscillator with k = 1; the last peak is 1."""
    A = np.array([0.25, 0.5, 0.75, 1.0])
    cosine = np.zeros((HARMONICS + 1, A.size))
    cosine[1] = A
    return orbits_of(OrbitTable(A, np.ones(4), 0.5 * A**2, cosine, 4 / (3 * np.pi) * A**3, 0.375 * A**4, 2 * A))


@lru_cache(maxsize=16)
def linear_parts(acting: Acting) -> Array:
    """The parts on the cosine of amplitude 1 with k = 1, ``(part,)``.

    >>> [round(part, 6) + 0.0 for part in linear_parts(Acting((0,)))[:2].tolist()]
    [-0.125, 0.0]
    """
    return parts_at_peaks(at_rest(), acting)[:, -1]


class Response(ABC):
    """What a sum of rates times the losses that are numbered as in EXPONENTS does at M amplitudes, in units k = 1."""

    @abstractmethod
    def parts(self, acting: Acting) -> Array:
        """Those of :func:`parts_at_peaks`, ``[part, M]``."""

    def under(self, rates: Sequence[float]) -> Under:
        """All that they do at their rates."""
        acting = Acting(tuple(i for i, rate in enumerate(rates) if rate) or (0,))
        return together(acting, self.parts(acting), rates)


@dataclass(frozen=True, eq=False)
class OfCosine(Response):
    """That of a cosine of any amplitude and frequency, ``(M,)``: of the linear oscillator, nearly of one with kinks.

    >>> OfCosine(np.ones(1), np.full(1, 2.0)).under((0.1,)).shift.round(9).tolist()  # -mu^2 / (2 omega)
    [-0.000625]
    """

    amplitude: Array
    omega: Array

    def parts(self, acting: Acting) -> Array:
        """As of any response: each loss goes with a^(r - 1) omega^(r - 2)."""
        a, w = self.amplitude, self.omega
        size = [a ** (r - 1.0) * w ** (r - 2.0) for r in EXPONENTS]
        scale = [w * size[i] * size[j] for i, j in acting.pairs]
        scale += [w * size[i] * size[j] * size[k] for i, j, k in acting.triples]
        scale += [a * size[i] for (i,) in acting.sines]
        return linear_parts(acting)[:, None] * scale


@dataclass(frozen=True, eq=False)
class OfPotential(Response):
    """That along the orbits of a smooth potential, by a table with rising peaks, at M other peaks."""

    table: OrbitTable
    peak: Array
    known: dict[Acting, Array] = field(default_factory=dict)

    def parts(self, acting: Acting) -> Array:
        """As of any response."""
        if acting not in self.known:
            self.known[acting] = self.read(acting)
        return self.known[acting]

    def read(self, acting: Acting) -> Array:
        """The parts at the peaks that are wanted, by one spline of each over its power of the peak, down to rest."""
        products = [*acting.pairs, *acting.triples, *acting.sines]
        powers = [float(sum(EXPONENTS[i] - 1 for i in one)) for one in products]
        powers[-len(acting.sines) :] = [power + 1.0 for power in powers[-len(acting.sines) :]]
        scaled = parts_at_peaks(orbits_of(self.table), acting).T / self.table.peak[:, None] ** powers
        smooth = CubicSpline(np.append(0.0, self.table.peak), np.vstack((linear_parts(acting), scaled)))
        return np.asarray(smooth(self.peak) * np.maximum(self.peak, np.finfo(float).tiny)[:, None] ** powers).T
