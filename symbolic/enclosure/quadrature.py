r"""omega0 of any orbit by a quadrature with a proved error bound (units with k = 1).

With V(A) - V(u) = (A - u)(u - B) q(u) and u = (A + B)/2 + (A - B)/2 cos(theta), the period loses its singular ends:

    T = sqrt(2) * integral of F(cos theta) over 0 < theta < pi,    F = I(u) / sqrt(q(u)),     omega0 = 2 pi / T.

F(cos theta) is even, 2 pi-periodic, and analytic for |Im theta| <= a as long as q has no zero and V, I no singularity
in the ellipse that cos maps that strip onto.  If |F| <= M there, n midpoints give the mean over 0 < theta < pi within

    2 M / (exp(2 a n) - 1)

(Trefethen and Weideman, SIAM Review 56 (2014) 385-458, Theorem 3.2, with N = 2n points round the period).  Close to a
separatrix a is small and n large; then FLINT's adaptive Gauss-Legendre rule, whose error is proved in the same way on
ellipses round each piece, takes over (F. Johansson, Numerical integration in arbitrary-precision ball arithmetic,
ICMS 2018).
"""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from flint import acb, arb, ctx, fmpq

from ridgeback.symbolic.enclosure.analytic_strip import Strip
from ridgeback.symbolic.enclosure.integrand import Integrand
from ridgeback.symbolic.enclosure.walk import UndecidedError

MAX_NODES: Final = 4096
"""Beyond this many midpoints the adaptive rule is cheaper."""

MAX_EVALUATIONS: Final = 50_000
"""Evaluations of the integrand after which the adaptive rule gives up."""


def frequency(integrand: Integrand, strip: Strip | None, bits: int) -> arb:
    """omega0/k at the present precision, to about ``bits`` bits; without a strip by the adaptive rule.

    Raises UndecidedError when the balls come out too wide.
    """
    mean = _mean(integrand, strip, bits)
    if not mean > 0:
        raise UndecidedError
    return arb(2).sqrt() / mean


def _mean(integrand: Integrand, strip: Strip | None, bits: int) -> arb:
    if strip is not None:
        nodes = nodes_needed(strip, integrand.typical(), bits)
        if nodes is not None:
            return midpoint_mean(integrand, strip, nodes)
    return adaptive_mean(integrand, bits)


def nodes_needed(strip: Strip, typical: arb, bits: int) -> int | None:
    """How many midpoints reach ``bits`` bits relative to a typical value of F; None when more than the limit.

    >>> nodes_needed(Strip(arb(1), arb(1)), arb(1), 64) in range(24, 32)
    True
    """
    digits = (arb(2) ** (bits + 2) * strip.bound / typical + 1).log()
    count = (digits / (2 * strip.width)).upper().ceil().unique_fmpz()
    return None if count is None or count > MAX_NODES else _rounded_up(int(count))


def _rounded_up(count: int) -> int:
    """An even number with four leading bits at least as large, so that few sets of nodes are ever made."""
    unit = max(2, 1 << max(0, count.bit_length() - 4))
    return -(-count // unit) * unit


def midpoint_mean(integrand: Integrand, strip: Strip, nodes: int) -> arb:
    """Mean of F over theta by ``nodes`` midpoints (an even number), its error bound included."""
    cosines = list(midpoints(nodes, ctx.prec))
    if not integrand.even:
        cosines += [-x for x in cosines]
    mean = sum(integrand.values(cosines), arb(0)) / len(cosines)
    error = 2 * strip.bound / ((2 * strip.width * nodes).exp() - 1)
    return mean + arb(0, error.upper())


@lru_cache(maxsize=64)
def midpoints(nodes: int, bits: int) -> tuple[arb, ...]:
    """The positive ones of cos((2 j + 1) pi / (2 nodes)), for even ``nodes``.

    >>> [round(float(x), 3) for x in midpoints(4, 53)]
    [0.924, 0.383]
    """
    with ctx.workprec(bits):
        return tuple(arb.cos_pi_fmpq(fmpq(2 * j + 1, 2 * nodes)) for j in range(nodes // 2))


def adaptive_mean(integrand: Integrand, bits: int) -> arb:
    """The same mean by FLINT's adaptive integration.

    Raises UndecidedError when it does not get there within its limit of evaluations.
    """
    end, goal = arb.pi() / 2 if integrand.even else arb.pi(), arb(2) ** -bits
    total = acb.integral(
        lambda theta, analytic: integrand.on_ball(theta, analytic=analytic),
        0,
        end,
        rel_tol=goal,
        abs_tol=goal * integrand.typical(),
        eval_limit=MAX_EVALUATIONS,
    )
    mean = total.real / end
    if not mean.is_finite() or mean.rel_accuracy_bits() < bits - 8:
        raise UndecidedError
    return mean
