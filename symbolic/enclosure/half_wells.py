r"""omega0 of a force that is analytic on each side of rest, as a ball: one quarter of a cycle from each turning point.

On one side let f be analytic in w = u^(1/d), V(w) the potential, and W^d the turning point.  With w = W (1 - x^2) the
time from rest to u = 0 is

    t = integral of d w^(d-1) dw / sqrt(2 V(W) - 2 V(w)) over 0 < w < W
      = sqrt(2 W) * integral of d w^(d-1) / sqrt(q(w)) dx over 0 < x < 1,    q = (V(W) - V(w)) / (W - w),

and analytic in x, so that FLINT's adaptive Gauss-Legendre rule encloses it (F. Johansson, Numerical integration in
arbitrary-precision ball arithmetic, ICMS 2018).  omega0 = pi / (t + t'), where the other turning point has the same
energy.  Between rest and the turning points the force is proved to be positive: next to 0 by the derivative that it
begins with, further on by balls.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import sympy
from flint import acb, acb_poly, arb, arb_poly, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import rational
from ridgeback.symbolic.enclosure.ball_functions import Function, ball_function
from ridgeback.symbolic.enclosure.ball_integral import BallIntegral
from ridgeback.symbolic.enclosure.integrand import divided
from ridgeback.symbolic.enclosure.walk import UndecidedError, root
from ridgeback.symbolic.enclosure.well import exact_polynomial
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.potential import potential_of
from ridgeback.symbolic.systems.sides import Half, require_one_law
from ridgeback.symbolic.systems.structure import free_names

MAX_EVALUATIONS: Final = 50_000
MAX_STEPS: Final = 2000
FINEST: Final = 48
"""Steps shorter than 2**-48 of the way are not taken."""
MOST_STRIDES: Final = 60
"""Strides in which the other turning point is looked for, from the distance of the given one on; they double."""


@dataclass(frozen=True)
class TwoSided:
    """The force of an oscillator on each side of rest, the side of the amplitude first."""

    name: str
    near: Half
    far: Half

    @property
    def odd(self) -> bool:
        """Whether both sides are the same, so that the turning points are at the same distance."""
        return self.near == self.far

    def mirrored(self) -> TwoSided:
        """Seen from the other side."""
        return TwoSided(self.name, self.far, self.near)


def two_sided(oscillator: Oscillator) -> TwoSided:
    """Both sides of a restoring force.

    Raises InputError for terms in u' and symbolic parameters.

    >>> own = Oscillator.from_equation("u'' + u + u*abs(u) = 0")
    >>> two_sided(own).odd
    True
    """
    name, force = oscillator.name, oscillator.substituted_force
    require_one_law(name, force)
    if force.has(V):
        raise InputError(
            f"{name}: there is no energy with terms in u' beside a kink, hence no enclosure; leave them out"
        )
    if unset := free_names(force):
        raise InputError(f"{name}: an enclosure needs numbers, and {', '.join(unset)} has none; set it, e.g. to 1")
    return TwoSided(name, *oscillator.halves)


class HalfWell:
    """One side in balls at the present precision."""

    def __init__(self, half: Half) -> None:
        self.half, bits = half, ctx.prec
        slope = sympy.expand(half.force * half.root * U ** (half.root - 1))
        potential = potential_of(slope)
        self.polynomial = None if potential is None else exact_polynomial(sympy.expand(potential))
        self._force = ball_function(half.force, bits)
        self._begins = ball_function(half.force.diff(U, half.power), bits)
        self._slope, self._wide = (ball_function(slope, bits, complex_=c) for c in (False, True))
        self._bend = ball_function(slope.diff(U), bits, complex_=True)
        self._top = ball_function(slope.diff(U, self.rise - 1), bits, complex_=True)
        if potential is None:
            integral = BallIntegral(self._wide)
            self._value: Function = integral
            self._far: Function = integral
        else:
            self._value, self._far = (ball_function(potential, bits, complex_=c) for c in (False, True))

    @property
    def rise(self) -> int:
        """The power of w that V begins with."""
        return self.half.power + self.half.root

    def energy(self, w: arb) -> arb:
        """V(w)."""
        return arb(self._value(w))

    def restores(self, low: arb, high: arb) -> bool:
        """Whether the force is proved to be positive for low < w <= high; False where it is not positive."""
        start = self._beginning(high) if low.is_zero() else low
        left, step = start, (high - start).mid()
        smallest = high.upper() * arb(2) ** -FINEST
        for _ in range(MAX_STEPS):
            if not left < high:
                return True
            right = (left + step).mid()
            right = right if right < high else high.upper()
            if self._force(left.union(right)) > 0:
                left, step = right, 2 * step
            elif self._force(right) < 0 or self._force(right).is_zero():
                return False
            elif step < smallest:
                raise UndecidedError
            else:
                step = step / 2
        raise UndecidedError

    def _beginning(self, high: arb) -> arb:
        """A place up to which the derivative that the force begins with keeps its sign."""
        place = high.upper()
        for _ in range(FINEST):
            if self._begins(arb(0).union(place)) > 0:
                return place
            place = (place / 2).mid()
        raise UndecidedError

    def turning(self, energy: arb, unit: arb) -> arb | None:
        """The place where V is ``energy``; None when the force ends before, or too far away."""
        low, step = arb(0), unit.mid()
        for _ in range(MOST_STRIDES):
            high = (low + step).mid()
            rise = self.energy(high) - energy
            if not rise.is_finite() or not self._held(low, high):
                step = (step / 2).mid()
            elif rise > 0:
                return root(lambda w: self.energy(w) - energy, self._slope, low, high)
            elif rise < 0:
                low, step = high, 2 * step
            else:
                step = (step * 3 / 4).mid()
        return None

    def _held(self, low: arb, high: arb) -> bool:
        try:
            return self.restores(low, high)
        except UndecidedError:
            return False

    def time(self, turn: arb, bits: int) -> arb:
        """From rest at w = turn to u = 0."""
        q, d = self.quotient(turn), self.half.root

        def on_ball(x: acb, analytic: bool) -> acb:
            w = turn * (1 - x * x)
            return d * w ** (d - 1) * q(x, w).rsqrt(analytic=analytic)

        goal, end = arb(2) ** -bits, acb(1)
        typical = abs(on_ball(acb(1) / 2, analytic=False))
        found = acb.integral(on_ball, 0, end, rel_tol=goal, abs_tol=goal * typical, eval_limit=MAX_EVALUATIONS)
        if not found.real.is_finite() or found.real.rel_accuracy_bits() < bits - 8:
            raise UndecidedError
        return arb((2 * turn).sqrt() * found.real)

    def quotient(self, turn: arb) -> Callable[[acb, acb], acb]:
        """q as a function of balls of x and of w = turn (1 - x^2)."""
        return self._polynomial_q(turn) if self.polynomial is not None else self._general_q(turn)

    def _polynomial_q(self, turn: arb) -> Callable[[acb, acb], acb]:
        quotient = acb_poly(divided(arb_poly(self.polynomial) - self.energy(turn), turn))
        return lambda _, w: quotient(w)

    def _general_q(self, turn: arb) -> Callable[[acb, acb], acb]:
        energy, pull = self.energy(turn), acb(self._slope(turn))

        def q(x: acb, w: acb) -> acb:
            fall = turn * x * x
            if not fall.contains(0):
                plain = (energy - self._far(w)) / fall
                if plain.is_finite() and not plain.contains(0):
                    return acb(plain)
            begun = self._from_beginning(w, turn)
            if begun.is_finite() and not begun.contains(0):
                return begun
            return acb(pull - fall * self._bend(w.union(acb(turn))) / 2)

        return q

    def _from_beginning(self, w: acb, turn: arb) -> acb:
        """q of a force that begins with a high power, over a wide ball: the mean of V' from w to W.

        V' = h w^(m-1), with h in the convex hull of its derivative of that order over (m-1)!, on the way from 0: with
        h = c + e, |e| <= r, the mean is c (W^m - w^m)/(m (W - w)) within r max(|w|, W)^(m-1).
        """
        m = self.rise
        h = self._top(w.union(acb(0)).union(acb(turn))) / math.factorial(m - 1)
        centre, radius = acb(h.mid()), _radius(h)
        size = arb(abs(w).upper()).max(turn.upper())
        mean = centre * sum((turn ** (m - 1 - j) * w**j for j in range(m)), acb(0)) / m
        spread = arb(0, (radius * size ** (m - 1)).upper())
        return acb(mean + acb(spread, spread))


def _radius(ball: acb) -> arb:
    return arb((arb(ball.real.rad()) ** 2 + arb(ball.imag.rad()) ** 2).sqrt().upper())


def quarter_times(sides: TwoSided, peak: sympy.Rational, bits: int) -> tuple[arb, arb, arb] | None:
    """The times from both turning points to rest, and the far turning point; None when the orbit does not close.

    Raises UndecidedError when the present precision does not tell.
    """
    well = HalfWell(sides.near)
    turn = arb(rational(peak)).root(sides.near.root)
    if not well.restores(arb(0), turn):
        return None
    near = well.time(turn, bits)
    if sides.odd:
        return near, near, arb(rational(peak))
    other = HalfWell(sides.far)
    far = other.turning(well.energy(turn), turn)
    return None if far is None else (near, other.time(far, bits), far**sides.far.root)
