"""Yardsticks of the energy integral: plain reversion and composition of power series in FLINT, for one force each.

With 2 V(u) = s^2, u = U(s) and the energy E:

    T(E) / 2 pi = sum [s^(2n)] U'(s) binom(2n, n) / 4^n (2E)^n,      omega0(A) = 2 pi / T(V(A)).

The limit for the pendulum is its closed form, the arithmetic-geometric mean M(1, cos(A/2)), of power series.
"""

from __future__ import annotations

import math

import flint
from flint import fmpq, fmpq_series


def pendulum(order: int) -> list[fmpq]:
    """omega0(A) of u'' + sin u = 0: 2 V = 2 - 2 cos u."""
    half = order // 2
    potential = [fmpq(0), fmpq(0)]
    potential += [
        fmpq(2 * (-1) ** (n // 2), math.factorial(n + 2)) if n % 2 == 0 else fmpq(0) for n in range(2 * half + 1)
    ]
    return by_reversion(potential, order)


def helmholtz_duffing(order: int) -> list[fmpq]:
    """omega0(A) of u'' + u + u^2 + u^3 = 0."""
    return by_reversion([fmpq(0), fmpq(0), fmpq(1), fmpq(2, 3), fmpq(1, 2)], order)


def pendulum_mean(order: int) -> list[fmpq]:
    """omega0(A) of u'' + sin u = 0 as M(1, cos(A/2)), in powers of A^2."""
    length = order // 2 + 1
    before, flint.ctx.cap = flint.ctx.cap, length
    try:
        cosine = [fmpq((-1) ** n, 4**n * math.factorial(2 * n)) for n in range(length)]
        a, b = fmpq_series([1], prec=length), fmpq_series(cosine, prec=length)
        for _ in range(length.bit_length()):  # what the two agree in doubles
            a, b = (a + b) / 2, (a * b).sqrt()
    finally:
        flint.ctx.cap = before
    found = a.coeffs()
    return [found[n // 2] if n % 2 == 0 else fmpq(0) for n in range(order + 1)]


def by_reversion(twice_potential: list[fmpq], order: int) -> list[fmpq]:
    """omega0 through A^order from the coefficients of 2 V(u)."""
    length = order + 2
    before, flint.ctx.cap = flint.ctx.cap, length
    try:
        root = fmpq_series(twice_potential[2:], prec=length - 1).sqrt()
        inverse = fmpq_series([0, *root.coeffs()], prec=length).reversion().coeffs()
        period = [
            (2 * n + 1) * inverse[2 * n + 1] * fmpq(math.comb(2 * n, n), 4**n)
            for n in range(order // 2 + 1)
            if 2 * n + 1 < len(inverse)
        ]
        energy = fmpq_series(twice_potential, prec=order + 1)
        found = (1 / fmpq_series(period, prec=order + 1)(energy)).coeffs()
    finally:
        flint.ctx.cap = before
    return list(found) + [fmpq(0)] * (order + 1 - len(found))
