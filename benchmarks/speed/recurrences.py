"""The yardstick: direct recurrences, each written by hand for one equation, as fast as products order by order get.

Solvability at each order, nothing general about them.  With z = exp(i tau) only odd powers of z occur, and
z^-h P(z^2) stands for a Fourier polynomial of highest harmonic h.  Orders that a symmetry removes are not stored, a
square multiplies each pair once, and products are of integers over denominators (``Whole``) that are brought together
once an order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly

Whole = tuple[fmpz_poly, fmpz]
"""Numerator and denominator of P."""


def pendulum(order: int) -> list[fmpq]:
    """omega0(A) of u'' + sin u = 0 through A^order, peak amplitude.

    U_k, S_k are the parts of u, sin u of A^(2k+1), C_k that of cos u of A^(2k).  From d/dA:
    2k C_k = -sum (2j+1) U_j S_(k-1-j),  (2k+1) S_k = sum (2j+1) U_j C_(k-j).
    """
    start = (fmpz_poly([1, 1]), fmpz(2))
    rates, sine, cosine = [start], [start], [(fmpz_poly([1]), fmpz(1))]
    curves, w = [each(start, 1, curve)], [fmpq(1)]
    for k in range(1, order // 2 + 1):
        h = 2 * k + 1
        cosine.append(reduced(dot(rates, sine[::-1]), fmpq(-1, 2 * k)))
        partial = reduced(dot(rates, cosine[:0:-1]), fmpq(1, h))  # S_k without U_k
        right = reduced(added([partial, dot(shifted(w[1:], 1), curves[:0:-1])]), fmpq(-1))
        w.append(fmpq(-2 * right[0][k + 1], right[1]))  # w_k u_0'' holds -w_k / 2 at either end
        p, d = solved(right, h)
        at_zero = p(1)
        new = reduced((2 * p - fmpz_poly([at_zero, at_zero]).left_shift(k), 2 * d))
        rates.append((h * new[0], new[1]))
        curves.append(each(new, h, curve))
        sine.append(reduced(added([partial, new])))
    halves = square_root(w)
    return [halves[n // 2] if n % 2 == 0 else fmpq(0) for n in range(order + 1)]


def van_der_pol(order: int) -> list[fmpq]:
    """omega0(eps) of u'' - eps (1 - u^2) u' + u = 0; u_n stands times i^n, so that it is real.

    With eps -> i eps the equation reads omega^2 u'' + u + eps omega D (u - u^3/3) = 0, D = -i d/dtau: D z^m = m z^m.
    """
    u, square = [(fmpz_poly([1, 1]), fmpz(1))], [(fmpz_poly([1, 2, 1]), fmpz(1))]
    flow, curves, w, omega = [(fmpz_poly([-1, 0, 0, -1]), fmpz(3))], [each(u[0], 1, curve)], [fmpq(1)], [fmpq(1)]
    for n in range(1, order + 2):
        h = 2 * n + 1
        driven = each(dot(shifted(omega, 0), flow[::-1]), h, lambda m: m)
        right = reduced(added([driven, dot(shifted(w[1:], 1), curves[:0:-1])]), fmpq(-1))
        if n % 2 and n > 1:  # the secular sine: a cos tau more in u_(n-1) changes it by 2a, and the third by 3a
            a = fmpq(-right[0][n + 1], 2 * right[1])
            changes = (1, 1), (2, 4, 2), (-1, -2, -2, -1)  # of u, u^2 and u - u^3/3 times a
            for series, c in zip((u, square, flow), changes, strict=True):
                series[-1] = reduced(added([series[-1], (fmpz_poly(list(c)).left_shift(n - 1) * a.p, a.q)]))
            curves[-1] = each(u[-1], h - 2, curve)
            turn = fmpz_poly([-3, -2, 2, 3]).left_shift(n - 1)
            right = added([right, (turn * a.p, a.q)])
        w.append(fmpq(-right[0][n + 1], right[1]) if n % 2 == 0 else fmpq(0))
        omega.append((w[n] - sum((omega[j] * omega[n - j] for j in range(2, n, 2)), fmpq(0))) / 2)
        p, d = solved(right, h)
        if n % 2:  # u'(0) = 0 by a multiple of sin tau
            tilt = each((p, d), h, lambda m: m)[0](1)
            p, d = 2 * p + fmpz_poly([tilt, -tilt]).left_shift(n), 2 * d
        u.append(reduced((p, d)))
        curves.append(each(u[n], h, curve))
        square.append(reduced(squared(u)))
        cube = dot(u, square[::-1])
        flow.append(reduced(added([(u[n][0].left_shift(1), u[n][1]), (-cube[0], 3 * cube[1])])))
    return [(-1) ** (n // 2) * c for n, c in enumerate(omega[: order + 1])]  # back from i eps


def dot(left: Iterable[Whole], right: Iterable[Whole]) -> Whole:
    """Sum of products, those with a zero left out."""
    return added([(p * q, d * e) for (p, d), (q, e) in zip(left, right, strict=True) if p and q])


def squared(u: list[Whole]) -> Whole:
    """The last coefficient of u^2."""
    n = len(u)
    p, d = dot(u[: n // 2], u[: (n - 1) // 2 : -1])
    return added([(2 * p, d), dot([u[n // 2]], [u[n // 2]])]) if n % 2 else (2 * p, d)


def added(terms: list[Whole]) -> Whole:
    """The sum, from the shortest denominator to the longest."""
    total, common = fmpz_poly([]), fmpz(1)
    for p, d in sorted(terms, key=lambda term: term[1]):
        before, common = common, common.lcm(d)
        total = total * (common // before) + p * (common // d)
    return total, common


def reduced(x: Whole, factor: fmpq | int = 1) -> Whole:
    """A multiple in lowest terms."""
    p = fmpq_poly(*x) * factor
    return p.numer(), p.denom()


def shifted(numbers: list[fmpq], first: int) -> list[Whole]:
    """The numbers times z^(2j), j = first, first + 1, ...: by so much the harmonics of their partners are lower."""
    return [(fmpz_poly([c.p]).left_shift(j), c.q) for j, c in enumerate(numbers, first)]


def each(x: Whole, h: int, factor: Callable[[int], int]) -> Whole:
    """Multiply each harmonic m of z^-h P(z^2)."""
    return fmpz_poly([factor(m) * c for m, c in zip(range(-h, h + 1, 2), x[0].coeffs(), strict=False)]), x[1]


def curve(m: int) -> int:
    """d^2/dtau^2 of z^m, over z^m."""
    return -m * m


def solved(right: Whole, h: int) -> Whole:
    """v'' + v = right but for the first harmonic: each other over 1 - m^2."""
    common = reduce(fmpz.lcm, (fmpz(m * m - 1) for m in range(3, h + 1, 2)), fmpz(1))
    quotient = each(right, h, lambda m: 0 if abs(m) == 1 else common // (1 - m * m))
    return quotient[0], right[1] * common


def square_root(w: list[fmpq]) -> list[fmpq]:
    """omega from omega^2."""
    omega = [fmpq(1)]
    for n in range(1, len(w)):
        omega.append((w[n] - sum((omega[j] * omega[n - j] for j in range(1, n)), fmpq(0))) / 2)
    return omega
