r"""What weak losses do to the waveform to first order and to the frequency to second, in any smooth potential.

In the action J and the phase phi of the undamped orbit u = U(J, phi), a loss h(u') acts by

    J' = f = -h U_phi,      phi' = omega + g,      g = h U_J.

With J = I + P1 + P2 and phi = psi + Q1 + Q2 of zero mean but for what is said below, the slow flow I' = F, psi' = omega
+ B is (N. N. Bogoliubov and Y. A. Mitropolsky, Asymptotic Methods in the Theory of Non-linear Oscillations, 1961)

    F = <f>,    omega P1_psi = f - F,    omega Q1_psi = g + omega_J P1,
    omega P2_psi = f_J P1 + f_phi Q1 - F P1_J,
    B = <omega_J P2 + omega_JJ P1^2 / 2 + g_J P1 + g_phi Q1 - F Q1_J>,     omega Q2_psi = that less its mean,

with every derivative at (I, psi).  The means of Q1 and P2 are those with which a cos psi is the first harmonic of u to
second order, a that of the undamped orbit: then a'/a and the cosines stay as they are in first order, as losses change
sign with time, and u has sines.  On the cosine of a linear force B is -mu^2/2 of 2 mu u', and -6 F^2/(pi a)^2
of F sign(u').
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import combinations_with_replacement

import numpy as np
from scipy.fft import irfft, rfft
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
    """The first order of one loss, ``[peak, phase]``; it is linear in the loss."""

    F: Array
    P1: Array
    P1_J: Array
    Q1: Array
    Q1_J: Array
    g: Array
    g1: Array
    f1: Array
    """Derivatives by J."""
    f_phi: Array

    def __add__(self, other: First) -> First:
        return First(*(getattr(self, name) + getattr(other, name) for name in First.__dataclass_fields__))


@dataclass(frozen=True, eq=False)
class AlongPeaks:
    """Derivatives along peaks, of splines through A^-power times the values, which are smooth down to rest."""

    peak: Array
    matrix: Array
    """Values of a spline to its slopes, at the peaks."""

    def slope(self, values: Array, power: int) -> Array:
        """d/dA of values ``[peak, ...]`` that go with this power of the peak as that vanishes."""
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
    return np.asarray(values.mean(axis=1, keepdims=True))


def primitive(values: Array) -> Array:
    """The integral over the phase, of zero mean, of values less their mean."""
    spectrum = rfft(values, axis=1)
    m = np.arange(1, spectrum.shape[1])
    spectrum[:, 0] = 0.0
    spectrum[:, 1:] /= 1j * m
    return np.asarray(irfft(spectrum, POINTS, axis=1))


def harmonic(values: Array, multiple: int, wave: np.ufunc) -> Array:
    """Coefficient of the cosine or sine of a multiple of the phase."""
    return 2.0 * mean(values * wave(multiple * (np.arange(POINTS) + 0.5) * (2 * np.pi / POINTS)))


def first_order(orbits: Orbits, exponent: int) -> First:
    """Of the loss |u'|^exponent sign(u')."""
    o = orbits
    velocity = o.omega * o.slope
    h = np.abs(velocity) ** exponent * np.sign(velocity)
    stiffer = exponent * np.abs(velocity) ** (exponent - 1) if exponent else np.zeros_like(velocity)
    f, g = -h * o.slope, h * o.U_J
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
        f1=o.by_action(f, exponent + 1),
        f_phi=-stiffer * o.omega * o.bend * o.slope - h * o.bend,
    )


# g_phi Q1 is taken by parts, (g Q1)_psi - g Q1_psi: dry friction jumps at the turning points
def second_order(orbits: Orbits, first: First) -> Array:
    """B at each peak."""
    o, s = orbits, first
    P2 = primitive(s.f1 * s.P1 + s.f_phi * s.Q1 - s.F * s.P1_J) / o.omega
    by_parts = s.g * (s.g + o.omega1 * s.P1) / o.omega
    rest = o.omega1 * P2 + 0.5 * o.omega2 * s.P1**2 + s.g1 * s.P1 - by_parts - s.F * s.Q1_J
    Q2 = (primitive(rest) + s.g * s.Q1) / o.omega
    waves = o.U_J * P2 + o.slope * Q2 + 0.5 * o.U_JJ * s.P1**2 + o.U_Jphi * s.P1 * s.Q1 + 0.5 * o.bend * s.Q1**2
    level = -harmonic(waves, 1, np.cos) / harmonic(o.U_J, 1, np.cos)
    return np.asarray((mean(rest) + o.omega1 * level)[:, 0])


@dataclass(frozen=True, eq=False)
class AtPeaks:
    """The response of orbits at their own peaks; each part is found once."""

    orbits: Orbits
    known: dict[tuple[int, ...], Array] = field(default_factory=dict)
    firsts: dict[int, First] = field(default_factory=dict)

    def first(self, i: int) -> First:
        """The first order of a loss."""
        if i not in self.firsts:
            self.firsts[i] = first_order(self.orbits, EXPONENTS[i])
        return self.firsts[i]

    def pair(self, i: int, j: int) -> Array:
        """The part of B with the product of the rates of two losses, at each peak."""
        if (i, j) not in self.known:
            whole = self.first(i) if i == j else self.first(i) + self.first(j)
            parts = 0.0 if i == j else self.pair(i, i) + self.pair(j, j)
            self.known[i, j] = second_order(self.orbits, whole) - parts
        return self.known[i, j]

    def sines(self, i: int) -> Array:
        """Coefficients of sin(m phi) in u by the rate of a loss, ``[m, peak]``."""
        wave = self.orbits.U_J * self.first(i).P1 + self.orbits.slope * self.first(i).Q1
        return np.array([harmonic(wave, m, np.sin)[:, 0] * (m > 1) for m in range(HARMONICS + 1)])


@lru_cache(maxsize=1)
def at_rest() -> AtPeaks:
    """Those of the linear oscillator with k = 1; the last peak is 1."""
    A = np.array([0.25, 0.5, 0.75, 1.0])
    cosine = np.zeros((HARMONICS + 1, A.size))
    cosine[1] = A
    return AtPeaks(
        orbits_of(OrbitTable(A, np.ones(4), 0.5 * A**2, cosine, 4 / (3 * np.pi) * A**3, 0.375 * A**4, 2 * A))
    )


@lru_cache(maxsize=16)
def linear_pair(i: int, j: int) -> float:
    """The part of B with the product of two rates, on the cosine of amplitude 1 with k = 1.

    >>> round(linear_pair(0, 0), 9), round(linear_pair(3, 3) * np.pi**2, 2)
    (-0.125, -6.0)
    """
    return float(at_rest().pair(i, j)[-1])


@lru_cache(maxsize=4)
def linear_sines(i: int) -> Array:
    """Coefficients of sin(m phi) by the rate of a loss, on the cosine of amplitude 1 with k = 1.

    >>> float((15 * np.pi * linear_sines(1)[3]).round(4))  # |u'| u' holds 8 sin(3 phi)/(15 pi), and u an eighth of it
    1.0
    """
    return at_rest().sines(i)[:, -1]


def pairs_of(acting: Sequence[int]) -> list[tuple[int, int]]:
    """Every two of some losses, each with itself too."""
    return list(combinations_with_replacement(acting, 2))


class Response(ABC):
    """B and the sines of u under a sum of rates times the losses that are numbered as in EXPONENTS, in units k = 1."""

    @abstractmethod
    def parts(self, acting: tuple[int, ...]) -> tuple[Array, Array]:
        """Of some losses, those of B by the product of two rates, ``[pair, M]``, and of u by a rate, ``[loss, m, M]``.

        The latter are the coefficients of sin(m phi).
        """

    def under(self, rates: Sequence[float]) -> tuple[Array, Array]:
        """B, ``(M,)``, and the coefficients of sin(m phi) in u, ``[m, M]``."""
        acting = tuple(i for i, rate in enumerate(rates) if rate) or (0,)
        pairs, sines = self.parts(acting)
        products = [rates[i] * rates[j] for i, j in pairs_of(acting)]
        return np.asarray(products @ pairs), np.tensordot([rates[i] for i in acting], sines, 1)


@dataclass(frozen=True, eq=False)
class OfCosine(Response):
    """That of a cosine of any amplitude and frequency, ``(M,)``: of the linear oscillator, nearly of one with kinks.

    >>> OfCosine(np.ones(1), np.full(1, 2.0)).under((0.1,))[0].round(9).tolist()  # -mu^2 / (2 omega)
    [-0.000625]
    """

    amplitude: Array
    omega: Array

    def parts(self, acting: tuple[int, ...]) -> tuple[Array, Array]:
        """As of any response."""
        r = [float(power) for power in EXPONENTS]
        a, w = self.amplitude, self.omega
        pairs = [linear_pair(i, j) * a ** (r[i] + r[j] - 2) * w ** (r[i] + r[j] - 3) for i, j in pairs_of(acting)]
        return np.array(pairs), np.array([np.outer(linear_sines(i), a ** r[i] * w ** (r[i] - 2)) for i in acting])


@dataclass(frozen=True, eq=False)
class OfPotential(Response):
    """That along the orbits of a smooth potential, by a table with rising peaks, at M other peaks."""

    table: OrbitTable
    peak: Array
    known: dict[tuple[int, ...], tuple[Array, Array]] = field(default_factory=dict)

    @cached_property
    def own(self) -> AtPeaks:
        """That at the peaks of the table."""
        return AtPeaks(orbits_of(self.table))

    def parts(self, acting: tuple[int, ...]) -> tuple[Array, Array]:
        """As of any response."""
        if acting not in self.known:
            self.known[acting] = self.read(acting)
        return self.known[acting]

    def read(self, acting: tuple[int, ...]) -> tuple[Array, Array]:
        """The parts at the peaks that are wanted, by one spline of each over its power of the peak, down to rest."""
        pairs, rows = pairs_of(acting), HARMONICS + 1
        powers = [EXPONENTS[i] + EXPONENTS[j] - 2.0 for i, j in pairs]
        powers += [float(EXPONENTS[i]) for i in acting for _ in range(rows)]
        at_peaks = [self.own.pair(i, j)[None] for i, j in pairs] + [self.own.sines(i) for i in acting]
        limit = [[linear_pair(i, j)] for i, j in pairs] + [linear_sines(i) for i in acting]
        scaled = np.concatenate(at_peaks).T / self.table.peak[:, None] ** powers
        places = np.concatenate(([0.0], self.table.peak))
        smooth = CubicSpline(places, np.concatenate((np.concatenate(limit)[None], scaled)))
        found = (smooth(self.peak) * np.maximum(self.peak, np.finfo(float).tiny)[:, None] ** powers).T
        return found[: len(pairs)], found[len(pairs) :].reshape(len(acting), rows, self.peak.size)
