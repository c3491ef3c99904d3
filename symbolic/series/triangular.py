r"""The triangular system of ``w'' + w = right`` in powers of cos tau, one part at a time.

At the power m = 2i + odd of x = cos tau, with shift 1 behind a factor sin tau (``trigonometric``):

    (1 - (m + shift)^2) w_i + (m + 2)(m + 1) w_(i+1) = r_i

Where the diagonal vanishes (the resonance) w_i is 0 and what is left of r_i is returned.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache, reduce
from typing import Any

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly

Scalar = Any


def back_substitute(right: Sequence[Scalar], *, odd: int, shift: int) -> tuple[list[Scalar], Scalar]:
    """Solve over any field that holds the rationals.

    >>> back_substitute([fmpq(0), fmpq(1)], odd=1, shift=0)  # cos^3 tau = (3 cos tau + cos 3 tau) / 4
    ([0, -1/8], 3/4)
    """
    solution: list[Scalar] = [fmpq(0)] * len(right)
    left: Scalar = fmpq(0)
    above: Scalar = fmpq(0)
    for i in range(len(right) - 1, -1, -1):
        m = 2 * i + odd
        known = right[i] - above * ((m + 2) * (m + 1))
        diagonal = 1 - (m + shift) ** 2
        if diagonal == 0:
            left, above = known, fmpq(0)
        else:
            above = solution[i] = known * fmpq(1, diagonal)
    return solution, left


def solve_rational(p: fmpq_poly, *, odd: int, shift: int) -> tuple[fmpq_poly | None, fmpq]:
    """Solve over the rationals, in integers: over the denominator of ``common_multiple`` every w_i is whole.

    >>> solve_rational(fmpq_poly([0, 1]), odd=1, shift=0)
    ((-1/8)*x, 3/4)
    """
    numerators, multiple = p.numer().coeffs(), common_multiple(p.length(), odd, shift)
    solution, left, above = [fmpz(0)] * len(numerators), fmpz(0), fmpz(0)
    for i in range(len(numerators) - 1, -1, -1):
        m = 2 * i + odd
        known = numerators[i] * multiple - above * ((m + 2) * (m + 1))
        diagonal = 1 - (m + shift) ** 2
        if diagonal == 0:
            left, above = known, fmpz(0)
        else:
            above = solution[i] = known // diagonal
    denominator = p.denom() * multiple
    whole = fmpz_poly(solution)
    return None if whole.is_zero() else fmpq_poly(whole, denominator), fmpq(left, denominator)


@lru_cache(maxsize=4096)
def common_multiple(length: int, odd: int, shift: int) -> fmpz:
    """A multiple of the denominators of all solutions with whole right-hand sides of so many coefficients.

    2^m x^m is a whole combination of the harmonics h = m + shift, m + shift - 2, ..., which 1 - h^2 divides, and each
    harmonic is a polynomial in x with whole coefficients (Chebyshev's T_h, and U_(h-1) behind sin tau).

    >>> common_multiple(2, 1, 0)
    64
    """
    top = 2 * max(length - 1, 0) + odd
    divisors = (fmpz(h * h - 1) for h in range(odd + shift, top + shift + 1, 2) if h > 1)
    return reduce(fmpz.lcm, divisors, fmpz(1)) << top
