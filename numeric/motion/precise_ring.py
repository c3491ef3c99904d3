"""Multiple precision (mpmath) as a ring for power series, at mpmath's precision of the moment."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import mpmath as mp
from mpmath.libmp import mpf_mul, mpf_sum

from ridgeback.common.number_ring import FUNCTIONS, NumberRing
from ridgeback.common.recurrences import Input, Node, solution

Precise = Any
"""An ``mpmath.mpf``: mpmath ships no types."""

Jet = Callable[[Precise, Precise, int], list[Precise]]
"""(u0, u0', degree) -> the Taylor coefficients [u0, u0', u''/2!, ...] of a motion."""


def _dot(left: Sequence[Precise], right: Sequence[Precise]) -> Precise:
    """The sum of products rounded once, as ``mpmath.fdot`` gives it, which asks each number what it is."""
    products = [mpf_mul(x._mpf_, y._mpf_) for x, y in zip(left, right, strict=True)]
    return mp.mp.make_mpf(mpf_sum(products, *mp.mp._prec_rounding))


PRECISE: Final = NumberRing(
    whole=mp.mpf,
    functions={name: getattr(mp, name) for name in FUNCTIONS},
    dot=_dot,
    root=mp.power,
    number=mp.mpf,
)


def solution_jet(force: Callable[[Input, Input], Node]) -> Jet:
    """Return the Taylor coefficients of the solutions of u'' + f(u, u') = 0, at mpmath's precision when asked.

    Parameters
    ----------
    force
        Builds f over u and u' from the nodes of ``ridgeback.common.recurrences``; called again for every state.

    Returns
    -------
    Jet
        Takes u, u' and the degree; returns degree + 1 coefficients.

    Examples
    --------
    >>> [int(6 * c) for c in solution_jet(lambda u, v: u)(1, 0, 3)]  # cos t
    [6, 0, -3, 0]
    """

    def jet(u0: Precise, v0: Precise, degree: int) -> list[Precise]:
        u, v = Input(PRECISE, [mp.mpf(u0)]), Input(PRECISE, [mp.mpf(v0)])
        return solution(force(u, v), u, v, degree)

    return jet
