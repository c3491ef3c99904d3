"""Candidates as models of a signal: parameters to a slow flow, and back to the equation's own numbers.

The parameters of a fit are theta = (k, shape .., rates .., ln a0, phase0, offset): the frequency scale, what is special
to the class, the loss rates of its damping, the start, and the sensor's offset.  Lengths are in units of L, the
largest measured amplitude, so that all but k and the rates are pure numbers of order 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cache, lru_cache

import numpy as np

from ridgeback.compare.identification.potentials import FINE, POTENTIALS, Potential, Shape
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.slow_flow import Flow, Motion, Path, ScaledOrbits, decay_flow, motion, path
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.reconstruction import Reconstruction
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.systems.catalogue import find

Described = tuple[str, float, str, str]
"""Name, value, unit and meaning of a parameter of the equation; U and T in a unit stand for those of the signal."""


class DampingLaw(StrEnum):
    """How the damping force depends on the velocity."""

    LINEAR = "linear"
    QUADRATIC = "linear + quadratic"
    CUBIC = "linear + cubic"
    COULOMB = "linear + coulomb"
    """Dry friction."""
    VAN_DER_POL = "van der Pol"
    """That of the van der Pol oscillator, which no other candidate has."""


LAWS = (DampingLaw.LINEAR, DampingLaw.QUADRATIC, DampingLaw.CUBIC)
"""The laws that are tried with every potential."""
ALL_LAWS = (*LAWS, DampingLaw.COULOMB)
"""Those, and what is tried when it is asked for."""
LAW_TEXT = {
    DampingLaw.LINEAR: "2 mu u'",
    DampingLaw.QUADRATIC: "2 mu u' + beta |u'| u'",
    DampingLaw.CUBIC: "2 mu u' + gamma u'^3",
    DampingLaw.COULOMB: "2 mu u' + F sign(u')",
}
VAN_DER_POL = "van-der-pol"
BACKBONE = "backbone-polynomial"
NAMES = (*(p.name for p in POTENTIALS), VAN_DER_POL, BACKBONE)
"""Every candidate that there is."""
COLUMNS = 16
"""More than any candidate has parameters."""


@dataclass(frozen=True)
class Model:
    """One class with its damping law; ``flow(theta, span)`` takes theta without phase and offset, for a time span."""

    name: str
    title: str
    equation: str
    law: DampingLaw
    size: int
    """Length of the part of theta between k and ln a0: shape and rates."""
    flow: Callable[[Array, float], Flow]
    physical: Callable[[Array, float], tuple[Described, ...]]
    """(k, shape .., rates ..) and L -> the equation's parameters."""
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    """Bounds of shape and rates; those of rates are relative to k."""
    groups: tuple[tuple[Shape, ...], ...]
    """Starting shapes, from each group the best; none: they are fitted.  Rates are appended by the fit."""
    rates: int
    mirror: Callable[[Array], Array] | None = None
    """theta of the oscillator turned round, u -> -u, where that is another one with the same backbone."""
    forms: int = 0
    """How many of the shape parameters, the last, only the waveform shows."""

    @property
    def count(self) -> int:
        """Number of fitted parameters, k, ln a0, phase and offset among them."""
        return self.size + 4

    def motion(self, theta: Array, time: Array) -> Motion:
        """The motion at times from 0 on, in units of L."""
        flow = self.flow(theta[:-2], float(time[-1]))
        return motion(flow, level_at(flow, float(theta[-3])), float(theta[-2]), time)

    def signal(self, theta: Array, time: Array) -> Array:
        """The modelled samples, in units of L, the offset included."""
        return np.asarray(self.motion(theta, time).u + theta[-1])

    def signals(self, time: Array) -> Callable[[Array], Array]:
        """``signal`` at these times, which keeps what another offset or another phase leaves as it is.

        Two of the columns of a Jacobian by differences then cost less than one.
        """

        @lru_cache(maxsize=COLUMNS)
        def way(numbers: tuple[float, ...]) -> Path:
            flow = self.flow(np.array(numbers), float(time[-1]))
            return path(flow, level_at(flow, numbers[-1]), time)

        @lru_cache(maxsize=COLUMNS)
        def wave(numbers: tuple[float, ...]) -> Array:
            return way(numbers[:-1]).at_phase(numbers[-1]).u

        return lambda theta: np.asarray(wave(tuple(theta[:-1].tolist())) + theta[-1])

    def curves(self, theta: Array, amplitude: Array, span: float) -> tuple[Array, Array]:
        """omega0 and a'/a at fundamental amplitudes in units of L."""
        flow = self.flow(theta[:-2], span)
        order = np.argsort(flow.amplitude)
        at, known = np.log(amplitude), np.log(flow.amplitude[order])
        return np.interp(at, known, flow.omega[order]), np.interp(at, known, flow.growth[order])


def level_at(flow: Flow, log_amplitude: float) -> float:
    """The level of a fundamental amplitude on a flow, whichever way it runs."""
    known = flow.log_amplitude
    if known[-1] < known[0]:
        return float(np.interp(-log_amplitude, -known, flow.level))
    return float(np.interp(log_amplitude, known, flow.level))


def rates_of(law: DampingLaw, values: Array) -> tuple[float, float, float, float]:
    """(2 mu, beta L k, gamma L^2 k^2, F/(L k)) of a law from its fitted rates."""
    first = float(values[0])
    second = float(values[1]) if values.size > 1 else 0.0
    if law == DampingLaw.COULOMB:
        return first, 0.0, 0.0, second
    return (first, second, 0.0, 0.0) if law == DampingLaw.QUADRATIC else (first, 0.0, second, 0.0)


def least_rates(rates: int) -> tuple[float, ...]:
    """Lower bounds of rates relative to k: linear damping alone is not negative, of two terms one may be."""
    return (0.0,) if rates == 1 else (-1.0, -1.0)


def damping_parameters(law: DampingLaw, rates: Array, speed: float) -> tuple[Described, ...]:
    """mu, and beta, gamma or F, from the rates at the ``speed`` L k."""
    mu: Described = ("mu", 0.5 * float(rates[0]), "1/T", "linear damping")
    if law == DampingLaw.LINEAR:
        return (mu,)
    if law == DampingLaw.QUADRATIC:
        return (mu, ("beta", float(rates[1]) / speed, "1/U", "quadratic damping"))
    if law == DampingLaw.COULOMB:
        return (mu, ("F", float(rates[1]) * speed, "U/T^2", "dry friction"))
    return (mu, ("gamma", float(rates[1]) / speed**2, "T/U^2", "cubic damping"))


@cache
def orbits_of(potential: Potential) -> Callable[[Shape], ScaledOrbits]:
    """Orbits of a potential by shape: those that fits start from are kept, of others the last few."""
    first = frozenset(shape for group in potential.groups for shape in group)
    kept, last = cache(potential.orbits), lru_cache(maxsize=8)(potential.orbits)

    def orbits(shape: Shape) -> ScaledOrbits:
        return kept(shape) if shape in first else last(shape)

    return orbits


def potential_model(potential: Potential, law: DampingLaw) -> Model:
    """A potential with a damping law, along its exact orbits."""
    orbits = orbits_of(potential)
    shapes, rates = len(potential.lower), 1 if law == DampingLaw.LINEAR else 2

    @lru_cache(maxsize=4)
    def numbers_to_flow(numbers: tuple[float, ...]) -> Flow:
        return decay_flow(
            orbits(numbers[1 : 1 + shapes]),
            k=numbers[0],
            length=1.0,
            rates=rates_of(law, np.array(numbers[1 + shapes :])),
        )

    def flow(theta: Array, _: float) -> Flow:
        return numbers_to_flow(tuple(theta[:-1].tolist()))

    def mirrored(theta: Array) -> Array:
        assert potential.mirror is not None  # noqa: S101 - it is only handed on when there is one
        factor, shape = potential.mirror(tuple(theta[1 : 1 + shapes].tolist()))
        return np.concatenate(([factor * theta[0]], shape, theta[1 + shapes :]))

    def physical(numbers: Array, length: float) -> tuple[Described, ...]:
        k, shape = float(numbers[0]), tuple(float(x) for x in numbers[1 : 1 + shapes])
        own = potential.physical(k, length, shape)
        return (*own, *damping_parameters(law, numbers[1 + shapes :], k * length))

    return Model(
        name=potential.name,
        title=potential.title,
        equation=f"u'' + {LAW_TEXT[law]} + r(u) = 0, r = {potential.restoring}",
        law=law,
        size=shapes + rates,
        flow=flow,
        physical=physical,
        lower=(*potential.lower, *least_rates(rates)),
        upper=(*potential.upper, *(1.0 for _ in range(rates))),
        groups=potential.groups,
        rates=rates,
        mirror=None if potential.mirror is None else mirrored,
    )


# phi' = k (1 + s1 X^2 + s2 X^4 + ..), X = a/L, losses too; damping as on orbits of the harmonic oscillator; the mean
# and harmonics with their leading powers of the amplitude, h0 a^2, h2 a^2, h3 a^3, as any smooth equation gives them.
def backbone_model(terms: int, law: DampingLaw) -> Model:
    """The slow flow alone, without an equation: an even polynomial of ``terms`` terms, and free harmonics."""
    rates = 1 if law == DampingLaw.LINEAR else 2
    bends = terms - 1
    size = bends + 3 + rates

    @lru_cache(maxsize=4)
    def numbers_to_flow(numbers: tuple[float, ...]) -> Flow:
        X = np.geomspace(1.5, 3e-3, FINE)
        k, bend, (h0, h2, h3) = numbers[0], numbers[1 : 1 + bends], numbers[1 + bends : 4 + bends]
        r = rates_of(law, np.array(numbers[4 + bends :]))
        growth = -0.5 * (r[0] + r[1] * 8 / (3 * math.pi) * X + 0.75 * r[2] * X**2 + r[3] * 4 / (math.pi * X))
        growth = np.minimum(growth, -1e-9 * k)
        omega = k * np.polynomial.polynomial.polyval(X**2, (1.0, *bend))
        cosine = np.array([h0 * X, np.ones_like(X), h2 * X, h3 * X**2])
        return Flow(-np.log(X), -growth, np.maximum(omega, 0.1 * k), growth, X, cosine)

    def flow(theta: Array, _: float) -> Flow:
        return numbers_to_flow(tuple(theta[:-1].tolist()))

    def physical(numbers: Array, length: float) -> tuple[Described, ...]:
        k = float(numbers[0])
        powers = [
            (f"w{2 * n}", k * float(numbers[n]) / length ** (2 * n), f"rad/(T U^{2 * n})", f"coefficient of a^{2 * n}")
            for n in range(1, terms)
        ]
        tail = numbers[1 + bends : 4 + bends]
        harmonics = [
            (f"h{m}", float(x) / length**p, f"1/U^{p}" if p > 1 else "1/U", f"harmonic {m} over a^{p + 1}")
            for m, p, x in zip((0, 2, 3), (1, 1, 2), tail, strict=True)
        ]
        first: Described = ("w0", k, "rad/T", "frequency of small oscillations")
        return (first, *powers, *harmonics, *damping_parameters(law, numbers[4 + bends :], k * length))

    text = " + ".join(["w0", *(f"w{2 * n} a^{2 * n}" for n in range(1, terms))])
    return Model(
        name=BACKBONE,
        title="Even polynomial backbone",
        equation=f"phi' = {text}, a'/a as of {LAW_TEXT[law]}",
        law=law,
        size=size,
        flow=flow,
        physical=physical,
        lower=(*(-3.0 for _ in range(bends)), -1.0, -1.0, -1.0, *least_rates(rates)),
        upper=(*(3.0 for _ in range(bends)), 1.0, 1.0, 1.0, *(1.0 for _ in range(rates))),
        groups=(),
        rates=rates,
        forms=3,
    )


ORDER = 9
TOP = 8
"""Harmonics kept, the mean among them."""
HIGHEST = 3
"""Powers of eps kept: with unit weight and order 9 every term of them is complete."""


Terms = dict[tuple[int, int], float]


@lru_cache(maxsize=1)
def _van_der_pol() -> tuple[Terms, Terms, tuple[tuple[int, str, Terms], ...]]:
    """Terms of phi'/k, of a'/(a k) and of the harmonics by powers of (a, eps), from multiple scales, rounded once."""
    flow = multiple_scales(find("van-der-pol").with_parameters({"k": 1, "eps": None}), ORDER, weight=1)
    harmonics = [
        (h.multiple, kind, _kept(terms))
        for h in Reconstruction(flow).harmonics
        if h.multiple > 1
        for kind, terms in (("cosine", h.cosine), ("sine", h.sine))
    ]
    return _kept(flow.frequency), _kept(flow.growth_rate), tuple(h for h in harmonics if h[2])


def _kept(terms: tuple[Term, ...]) -> Terms:
    return {(t.powers[0], t.powers[1]): float(t.coefficient) for t in terms if t.powers[1] <= HIGHEST}


def _value(terms: Terms, a: Array, eps: float) -> Array:
    total = np.zeros_like(a)
    for (p, q), c in terms.items():
        total = total + c * eps**q * a**p
    return total


def van_der_pol_model() -> Model:
    """u'' - eps k (1 - (u/b)^2) u' + k^2 u = 0 along its exact slow flow through eps^3; it settles on a limit cycle."""

    def flow(theta: Array, span: float) -> Flow:
        k, eps, b, start = (float(x) for x in theta)
        return van_der_pol_flow(k, eps, b, math.exp(start), span)

    def physical(numbers: Array, length: float) -> tuple[Described, ...]:
        k, eps, b = (float(x) for x in numbers)
        return (
            ("k", k, "rad/T", "frequency of small oscillations"),
            ("eps", eps, "", "strength of the negative damping"),
            ("b", b * length, "U", "where the damping changes sign; the limit cycle is near 2 b"),
        )

    return Model(
        name=VAN_DER_POL,
        title="Van der Pol oscillator",
        equation="u'' - eps k (1 - (u/b)^2) u' + k^2 u = 0",
        law=DampingLaw.VAN_DER_POL,
        size=2,
        flow=flow,
        physical=physical,
        lower=(1e-6, 1e-3),
        upper=(0.9, 10.0),
        groups=(tuple((e, b) for e in (0.003, 0.01, 0.03, 0.1, 0.2, 0.4) for b in (0.25, 0.4, 0.5, 0.6)),),
        rates=0,
    )


# With p = (a/b)^2 and the limit cycle at p*, q = ln(p / |p* - p|) rises at the rate 2 D / (1 - p/p*), which has no
# zero: time and phase are integrals over q from any start to any closeness to the limit cycle.
def van_der_pol_flow(k: float, eps: float, b: float, start: float, span: float) -> Flow:
    """The flow from the amplitude ``start`` on, for a time ``span``, on nodes equidistant in q.

    >>> flow = van_der_pol_flow(1.0, 0.1, 0.5, 0.2, 500.0)
    >>> round(float(flow.amplitude[-1]), 2), bool(abs(flow.omega[-1] - (1 - 0.1**2 / 16)) < 1e-6)
    (1.0, True)
    """
    frequency, damping, harmonics = _van_der_pol()
    slopes: Array = np.zeros(HIGHEST + 1)
    for (power, q), c in damping.items():
        slopes[power // 2] += c * eps**q
    target = limit_cycle(slopes)
    p0 = (start / b) ** 2
    p0 = p0 if abs(p0 / target - 1) > 1e-6 else target * (1 - 1e-6)
    outside = p0 > target
    q0 = math.log(p0 / abs(target - p0))
    nodes: Array = np.linspace(q0 - 0.01, q0 + 2.5 * eps * k * span + 1.0, FINE)
    nodes = nodes[nodes > 1e-9] if outside else nodes
    p = -target / (np.expm1(-nodes) if outside else -1 - np.exp(-nodes))
    # D / (1 - p/p*) by polynomial division, without the cancellation at p*
    quotient, _ = np.polydiv(slopes[::-1], np.array([-1 / target, 1.0]))
    rate = np.maximum(2 * k * np.polyval(quotient, p), 1e-9 * k)
    scaled = np.sqrt(p)
    omega = np.maximum(k * _value(frequency, scaled, eps), 0.1 * k)
    cosine, sine = np.zeros((TOP, nodes.size)), np.zeros((TOP, nodes.size))
    cosine[1] = 1.0
    for multiple, kind, terms in harmonics:
        if multiple < TOP:
            (cosine if kind == "cosine" else sine)[multiple] += _value(terms, scaled, eps) / scaled
    growth = k * _value(damping, scaled, eps)
    return Flow(nodes, rate, omega, growth, b * scaled, cosine, sine)


def limit_cycle(slopes: Array) -> float:
    """Where D(p) vanishes next to p = 4, the limit of small eps.

    >>> limit_cycle(np.array([0.5, -0.125]))
    4.0
    """
    roots = np.roots(slopes[::-1])
    real = roots[np.abs(roots.imag) < 1e-9].real
    return float(real[np.argmin(np.abs(real - 4.0))]) if real.size else 4.0


def models_of(name: str, law: DampingLaw) -> Model:
    """The model of a candidate's name with a damping law (van der Pol's has its own)."""
    if name == VAN_DER_POL:
        return van_der_pol_model()
    return potential_model(next(p for p in POTENTIALS if p.name == name), law)
