"""Taylor coefficients of the solution of ``u'' + f(u, u') = 0`` for a force given as a SymPy expression.

Automatic differentiation in Taylor arithmetic (Moore 1966; Griewank and Walther 2008, chapter 13): ``symbolic``
compiles the force to recurrences, ``numeric`` brings the ring they run over.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

import mpmath as mp
import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FUNCTIONS, NumberRing
from ridgeback.common.recurrences import Input, solution
from ridgeback.compare.binding.closures import mp_constant
from ridgeback.numeric.motion.precise_ring import Jet, Precise
from ridgeback.symbolic.arithmetic.expression_series import Program, check_expandable
from ridgeback.symbolic.systems.oscillator import U, V

GUARD: Final = 16
"""Bits beyond mpmath's precision, for the roundings of one series."""


class _Balls(NumberRing):
    """Ball arithmetic, four times as fast as mpmath's numbers; only what holds 0 and nothing else is 0."""

    def absent(self, element: arb) -> bool:
        return bool(element.is_zero())

    def invert(self, element: arb) -> arb:
        if element.contains(0):
            raise InputError("a denominator, log or root is 0 here, where its power series is not analytic")
        return 1 / element


def _real(name: str) -> Callable[[arb], arb]:
    """An elementary function that raises ValueError where it is not real."""

    def value(x: arb) -> arb:
        found: arb = getattr(x, name)()
        if not found.is_finite():
            raise ValueError(name)
        return found

    return value


RING: Final = _Balls(
    whole=arb,
    functions={name: _real(name) for name in FUNCTIONS},
    number=lambda constant: arb(mp_constant(constant)),
)


@contextmanager
def at_precision() -> Iterator[None]:
    """Balls at mpmath's precision of the moment, and a little more."""
    with ctx.workprec(mp.mp.prec + GUARD):
        yield


def midpoint(ball: Any) -> Precise:
    """The middle of a ball as one of mpmath's numbers."""
    mantissa, exponent = ball.mid().man_exp()
    return mp.mpf((int(mantissa), int(exponent)))


def force_jet(force: sympy.Expr) -> Jet:
    """Return the Taylor coefficients of the solutions of u'' + f(u, u') = 0.

    Parameters
    ----------
    force
        f in ``U`` and ``V`` (u and u'), without further symbols.

    Returns
    -------
    Jet
        (u0, u0', degree) -> degree + 1 coefficients [u0, u0', u''/2!, ...] at mpmath's precision of the moment.

    Raises
    ------
    InputError
        For a function without a recurrence and a symbol without a value, at once; for a point where f is not analytic,
        when it is reached.

    Examples
    --------
    >>> [int(6 * c) for c in force_jet(U)(1, 0, 3)]  # cos t
    [6, 0, -3, 0]
    """
    check_expandable(force, {U, V})

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        with at_precision():
            u, v = Input(RING, [arb(mp.mpf(u0))]), Input(RING, [arb(mp.mpf(v0))])
            return [midpoint(c) for c in solution(Program(force, RING, {U: u, V: v}, U, V).root, u, v, degree)]

    return jet
