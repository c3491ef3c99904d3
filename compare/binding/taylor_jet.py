"""Taylor coefficients of the solution of ``u'' + f(u, u') = 0`` for a force given as a SymPy expression.

Automatic differentiation in Taylor arithmetic (Moore 1966; Griewank and Walther 2008, chapter 13): ``symbolic``
compiles the force to recurrences, ``numeric`` brings the ring they run over.
"""

from __future__ import annotations

import mpmath as mp
import sympy

from ridgeback.common.recurrences import Input, solution
from ridgeback.numeric.motion.precise_ring import Jet, Precise
from ridgeback.symbolic.arithmetic.ball_ring import REAL_BALLS, at_bits, midpoint
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.arithmetic.expression_series import Program, check_expandable
from ridgeback.symbolic.systems.oscillator import U, V


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
        with at_bits(mp.mp.prec):
            u, v = (Input(REAL_BALLS, [ball(mp.mpf(x))]) for x in (u0, v0))
            root = Program(force, REAL_BALLS, {U: u, V: v}, U, V).root
            return [mp.mpf(midpoint(c)) for c in solution(root, u, v, degree)]

    return jet
