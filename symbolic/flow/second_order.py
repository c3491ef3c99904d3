r"""phi' to second order in losses that are not analytic at rest, along the cosine of a linear restoring force.

Let u'' + u + h = 0 with h = sum of e_i s_i(u) |u'|^r sign(u'), s_i a power of |u| on one side of u = 0.  With
u = a cos(phi) + u1(a, phi), u1 without a first harmonic, and H = h(a cos phi, -a sin phi), the orders of
a' = A1 + ..., phi' = 1 + B2 + ... are (N. N. Bogoliubov and Y. A. Mitropolsky, Asymptotic Methods in the Theory of
Non-linear Oscillations, 1961, section 1)

    A1 = (1/2 pi) integral of H sin phi,          u1'' + u1 = 2 A1 sin phi - H,
    B2 = (A1 dA1/da + P)/(2 a),    P = (1/pi) integral of (h_u u1 + h_u' (u1' + A1 cos phi)) cos phi,

over a cycle.  H is odd in phi and, on each quarter, a product of powers of sine and cosine, so that u1 is a sum of
phi^m exp(i n phi) there, and B2 exact in the rationals and 1/pi.  a'/a has no second order: the losses change sign
with time.  The kink of sign(u') at the turning points adds 2 delta(u') to h_u'; that of s_i at u = 0 adds nothing, for
cos phi = 0 there.  Dry friction alone has B2 = -6 F^2/(pi a)^2, in which each half cycle takes pi exactly.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TypeAlias

import sympy

from ridgeback.symbolic.flow.term import LossTerm, by_losses
from ridgeback.symbolic.systems.oscillator import U

Waves: TypeAlias = dict[tuple[int, int], sympy.Expr]
"""The sum of c phi^m exp(i n phi), c by (m, n)."""

QUARTERS = (1, 2)
"""0 < phi < pi/2, where u > 0, and pi/2 < phi < pi."""


@dataclass(frozen=True)
class Shape:
    """|u|^power |u'|^exponent sign(u') on one side of u = 0, the one with the sign ``side``."""

    power: int
    exponent: int
    side: int

    @property
    def degree(self) -> int:
        """The power of a that it goes with."""
        return self.power + self.exponent

    @property
    def quarter(self) -> int:
        """Where it acts."""
        return 1 if self.side > 0 else 2

    def loss(self) -> Waves:
        """-H for a = 1: |cos|^power sin^exponent."""
        return _product(_cosines(self.power, self.side), _sines(self.exponent))

    def by_place(self) -> Waves:
        """-h_u."""
        if self.power == 0:
            return {}
        return _scaled(_product(_cosines(self.power - 1, self.side), _sines(self.exponent)), self.side * self.power)

    def by_speed(self) -> Waves:
        """h_u' but for the delta function of dry friction."""
        if self.exponent == 0:
            return {}
        return _scaled(_product(_cosines(self.power, self.side), _sines(self.exponent - 1)), self.exponent)


@dataclass(frozen=True)
class Part:
    """A shape in a loss: its factor, and by how many powers of a it stands above the first ones of its loss."""

    shape: Shape
    factor: sympy.Expr
    above: int


def parts_of(right: sympy.Expr, left: sympy.Expr, exponent: int, above: int) -> list[Part]:
    """The shapes of c(u) |u'|^exponent sign(u'), given c(u) for u > 0 and c(-u) for u < 0, through ``above``.

    >>> [(part.shape.power, part.shape.side, part.factor) for part in parts_of(1 + 2 * U, 1 - 2 * U, 1, 1)]
    [(0, 1, 1), (0, -1, 1), (1, 1, 2), (1, -1, -2)]
    """
    found: list[Part] = []
    first: int | None = None
    slopes, power = (right, left), 0
    while (first is None or power <= first + above) and any(slope != 0 for slope in slopes):
        for side, slope in zip((1, -1), slopes, strict=True):
            factor = sympy.expand(slope.subs(U, 0)) / math.factorial(power)
            if factor != 0:
                first = power if first is None else first
                found.append(Part(Shape(power, exponent, side), factor, power - first))
        slopes, power = (slopes[0].diff(U), slopes[1].diff(U)), power + 1
    return found


def phase_terms(parts: Sequence[Part], names: Sequence[str], k: sympy.Expr, above: int) -> list[LossTerm]:
    """The terms of phi' of second order in the losses, through ``above`` powers of a above the first ones.

    Parameters
    ----------
    parts : sequence of Part
        Of all losses.
    names : sequence of str
        Parameters that the losses vanish with, whose powers are those of the terms.
    k : sympy.Expr
        Natural frequency, in rad per time unit.
    above : int
        Powers of a.

    Returns
    -------
    list of LossTerm
        In the oscillator's own units: a loss c |u'|^r is c k^(r - 2) in those of k t.

    Examples
    --------
    >>> friction = parts_of(sympy.Symbol("F", real=True), sympy.Symbol("F", real=True), 0, 0)
    >>> [(term.powers, term.coefficient) for term in phase_terms(friction, ["F"], sympy.Integer(1), 0)]
    [((-2, 2), -6/pi**2)]
    """
    sums: dict[int, sympy.Expr] = {}
    for one, other in product(parts, repeat=2):
        if one.above + other.above <= above:
            degree = one.shape.degree + other.shape.degree - 2
            unit = k ** (one.shape.exponent + other.shape.exponent - 3)
            value = one.factor * other.factor * unit * coefficient(one.shape, other.shape)
            sums[degree] = sums.get(degree, sympy.S.Zero) + value
    return [term for degree, total in sorted(sums.items()) for term in by_losses(degree, total, names)]


@dataclass(frozen=True)
class Response:
    """A1 and u1 of one shape, for a = 1: u1 by quarters, with its slope."""

    rate: sympy.Expr
    place: tuple[Waves, Waves]
    slope: tuple[Waves, Waves]


@lru_cache(maxsize=64)
def response(shape: Shape) -> Response:
    """Solve u1'' + u1 = 2 A1 sin - H from phi = 0 on, and take its first harmonic off.

    >>> response(Shape(0, 1, 1)).rate + response(Shape(0, 1, -1)).rate  # of u': A1 = -a/2
    -1/2
    """
    q, sine, cosine = shape.quarter, _sines(1), _cosines(1, 1)
    rate = -_integral(_product(shape.loss(), sine), q) / sympy.pi
    pull = [_sum(_scaled(sine, 2 * rate), shape.loss() if q == each else {}) for each in QUARTERS]
    place, slope = [], []
    with_cos, with_sin = sympy.S.Zero, sympy.S.Zero
    for each, force in zip(QUARTERS, pull, strict=True):
        ahead, beside = (_primitive(_product(force, wave)) for wave in (cosine, sine))
        ahead = _sum(ahead, {(0, 0): with_cos - _at(ahead, each - 1)})
        beside = _sum(beside, {(0, 0): with_sin - _at(beside, each - 1)})
        with_cos, with_sin = _at(ahead, each), _at(beside, each)
        place.append(_sum(_product(sine, ahead), _scaled(_product(cosine, beside), -1)))
        slope.append(_sum(_product(cosine, ahead), _product(sine, beside)))
    first = 2 / sympy.pi * sum(_integral(_product(p, sine), each) for p, each in zip(place, QUARTERS, strict=True))
    one, two = (_sum(p, _scaled(sine, -first)) for p in place)
    down, up = (_sum(s, _scaled(cosine, -first)) for s in slope)
    return Response(rate, (one, two), (down, up))


@lru_cache(maxsize=256)
def coefficient(one: Shape, other: Shape) -> sympy.Expr:
    """The part of B2 over a^(degrees - 2) by the response to ``other`` in the loss ``one``; sum it over all pairs.

    >>> friction = [Shape(0, 0, side) for side in (1, -1)]
    >>> sympy.expand(sum(coefficient(one, other) for one in friction for other in friction))
    -6/pi**2
    """
    found, q, cosine = response(other), one.quarter, _cosines(1, 1)
    moved, speed = found.place[q - 1], _sum(found.slope[q - 1], _scaled(cosine, found.rate))
    inner = _sum(_scaled(_product(one.by_place(), moved), -1), _product(one.by_speed(), speed))
    total = 2 * _integral(_product(inner, cosine), q)
    if one.exponent == 0:
        end = 2 * (q - 1)  # the turning point on its side
        total += 2 * _at(_product(speed, cosine), end)
    own = response(one)
    return sympy.expand((own.rate * found.rate * other.degree + total / sympy.pi) / 2)


def _cosines(power: int, side: int) -> Waves:
    return _power({(0, 1): sympy.Rational(side, 2), (0, -1): sympy.Rational(side, 2)}, power)


def _sines(power: int) -> Waves:
    half = sympy.I / 2
    return _power({(0, 1): -half, (0, -1): half}, power)


def _power(base: Waves, exponent: int) -> Waves:
    result: Waves = {(0, 0): sympy.S.One}
    for _ in range(exponent):
        result = _product(result, base)
    return result


def _sum(*parts: Waves) -> Waves:
    keys = {key for part in parts for key in part}
    found = {key: sympy.expand(sympy.Add(*(part.get(key, 0) for part in parts))) for key in keys}
    return {key: value for key, value in found.items() if value != 0}


def _scaled(waves: Waves, factor: sympy.Expr | int) -> Waves:
    return {key: sympy.expand(value * factor) for key, value in waves.items()}


def _product(one: Waves, other: Waves) -> Waves:
    return _sum(*({(m + p, n + q): c * d} for (m, n), c in one.items() for (p, q), d in other.items()))


def _primitive(waves: Waves) -> Waves:
    """An integral over phi."""
    return _sum(*(_primitive_of(m, n, c) for (m, n), c in waves.items()))


def _primitive_of(m: int, n: int, c: sympy.Expr) -> Waves:
    if n == 0:
        return {(m + 1, 0): c / (m + 1)}
    falls = (math.perm(m, s) * (-1) ** s / (sympy.I * n) ** (s + 1) for s in range(m + 1))
    return {(m - s, n): c * fall for s, fall in enumerate(falls)}


def _at(waves: Waves, quarters: int) -> sympy.Expr:
    """The value at phi = quarters * pi/2."""
    place = quarters * sympy.pi / 2
    return sympy.expand(sympy.Add(*(c * place**m * sympy.I ** (n * quarters % 4) for (m, n), c in waves.items())))


def _integral(waves: Waves, quarter: int) -> sympy.Expr:
    """Over one quarter."""
    primitive = _primitive(waves)
    return sympy.expand(_at(primitive, quarter) - _at(primitive, quarter - 1))
