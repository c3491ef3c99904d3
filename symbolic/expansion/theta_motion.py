r"""Motions that are theta series, to any order: u'' + sin(b u)/b = 0 and u'' + u + e u^3 = 0 with the peak amplitude A.

With the nome q of the modulus k and theta = theta_3(q), omega0 over its value at rest and the odd harmonics are

    sine:    k = sin(b A/2),                  omega0 = 1/theta^2,
             u = (8/b) sum (-1)^((m-1)/2) q^(m/2) / (m (1 + q^m)) cos m tau
    cubic:   k^2 = e A^2 / (2 (1 + e A^2)),   omega0 = sqrt(1 + e A^2)/theta^2,
             u = A (4/(k theta^2)) sum q^(m/2) / (1 + q^m) cos m tau

(DLMF 22.11.2, 22.19.2, 22.19.6; the pendulum's by integration of its velocity).  Everything is a power series in A^2: q
in k^2/16 is the reversion of q (theta_2/(2 q^(1/4) theta_3))^4 (DLMF 20.2, 22.2.2), the rest are powers of q.  The
coefficients are those of Lindstedt's recursion, which knows no closed forms, for a fraction of its products.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import reduce

import sympy
from flint import fmpq, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.series.spaces import Space
from ridgeback.symbolic.series.trigonometric import Trig, constant
from ridgeback.symbolic.systems.elliptic import cubic_force, sine_force

Series = list[fmpq]


@dataclass(frozen=True)
class ThetaMotion:
    """Power series in y = A^2, all of one length."""

    omega: Series
    nome: Series
    """q/y."""
    lead: Series
    """What stands before q^((m-1)/2) / (1 + q^m) in the harmonic m of u/A, but for its sign and 1/m."""
    alternating: bool
    """Whether the harmonic m carries (-1)^((m-1)/2)/m."""


def is_theta_series(force: sympy.Expr) -> bool:
    """Whether the motion of a force in units with k = 1 is a theta series: sin(b u)/b or u + e u^3, in rationals.

    >>> from ridgeback.symbolic.grammar.parse import U
    >>> is_theta_series(sympy.sin(U)), is_theta_series(U - U**3), is_theta_series(U + U**2)
    (True, True, False)
    """
    return _parameter(force) is not None


def _parameter(force: sympy.Expr) -> tuple[bool, fmpq] | None:
    """Whether the force is a sine, and b or e."""
    sine, cubic = sine_force(force), cubic_force(force)
    if sine is not None and sine.rate.is_Rational and sine.factor * sine.rate == 1:
        return True, fmpq(int(sine.rate.p), int(sine.rate.q))
    if cubic is not None and cubic.linear == 1 and cubic.cubic.is_Rational and cubic.cubic != 0:
        return False, fmpq(int(cubic.cubic.p), int(cubic.cubic.q))
    return None


def theta_motion(force: sympy.Expr, length: int) -> ThetaMotion:
    """The motion of a force that ``is_theta_series``, each series with so many terms.

    >>> from ridgeback.symbolic.grammar.parse import U
    >>> theta_motion(U + U**3, 3).omega
    [1, 3/8, -21/256]
    """
    known = _parameter(force)
    if known is None:
        raise InputError(f"the motion of the force {force} is no theta series; use Lindstedt's recursion")
    is_sine, value = known
    return _sine(value, length) if is_sine else _cubic(value, length)


def _sine(b: fmpq, length: int) -> ThetaMotion:
    modulus = [(-1) ** n * b ** (2 * n + 2) / (32 * math.factorial(2 * n + 2)) for n in range(length)]
    nome, omega = _nome_and_omega(modulus)  # k^2/16 = (1 - cos b A)/32
    root = truncated.square_root([c / nome[0] for c in nome])  # sqrt(q) = b A/8 + ...
    return ThetaMotion(omega, nome, root, alternating=True)


def _cubic(e: fmpq, length: int) -> ThetaMotion:
    modulus = [-((-e) ** (n + 1)) / 32 for n in range(length)]
    nome, theta = _nome_and_omega(modulus)
    stretch = truncated.square_root([fmpq(1), e, *[fmpq(0)] * length][:length])
    over = truncated.multiply(nome, truncated.reciprocal([c / modulus[0] for c in modulus]))
    lead = truncated.multiply(truncated.square_root([c / over[0] for c in over]), theta)  # sqrt(16 q/k^2)/theta^2
    return ThetaMotion(truncated.multiply(stretch, theta), nome, lead, alternating=False)


def _nome_and_omega(modulus: Series) -> tuple[Series, Series]:
    """q/y and 1/theta_3(q)^2, from k^2/(16 y)."""
    length = len(modulus)
    two, three = (_sparse(length, offset) for offset in (1, 0))  # theta_2/(2 q^(1/4)), theta_3
    ratio = truncated.multiply(two, truncated.reciprocal(three))
    square = truncated.multiply(ratio, ratio)
    in_modulus = truncated.revert([fmpq(0), *truncated.multiply(square, square)])
    nome = truncated.compose(in_modulus, [fmpq(0), *modulus])
    theta = truncated.reciprocal(truncated.multiply(three, three))
    return nome[1:], truncated.compose(theta, nome[:length])


def _sparse(length: int, offset: int) -> Series:
    """Sum of q^(n (n + offset)) over n >= 0 (offset 1) or over all n (offset 0)."""
    result = [fmpq(0)] * length
    for n in range(math.isqrt(length) + 1):
        if n * (n + offset) < length:
            result[n * (n + offset)] += fmpq(1 if offset or n == 0 else 2)
    return result


def waveform(motion: ThetaMotion, space: Space, last: int) -> list[Trig]:
    """u_0 ... u_last by powers of A.

    >>> from ridgeback.symbolic.grammar.parse import U
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> waveform(theta_motion(sympy.sin(U), 2), space_for(()), 3)[3].coefficients(1)  # (cos - cos 3 tau)/192
    [1/48, -1/48]
    """
    harmonics = _harmonics(motion, (last + 1) // 2)
    result = [constant(space, fmpq(0)) for _ in range(last + 1)]
    for i, p in enumerate(_in_powers(harmonics)):
        result[2 * i + 1] = Trig(space, (None, p, None, None))
    return result


def _harmonics(motion: ThetaMotion, count: int) -> list[Series]:
    """Row i: the coefficients of cos tau, cos 3 tau, ... in A^(2i+1).

    1/(1 + q^m) = sum (-1)^j q^(m j), so the powers lead q^i, i = 0, 1, ..., are enough.
    """
    powers, power = [], motion.lead[:count]
    for i in range(count):
        powers.append(power)
        power = truncated.multiply(power[: count - i - 1], motion.nome[: count - i - 1])
    rows = [[fmpq(0)] * (i + 1) for i in range(count)]
    for c in range(count):
        m, sign = 2 * c + 1, -1 if motion.alternating and c % 2 else 1
        for j, i in enumerate(range(c, count, m)):
            for r, value in enumerate(powers[i], i):
                rows[r][c] += value if j % 2 == 0 else -value
        scale = fmpq(sign, m if motion.alternating else 1)
        for r in range(c, count):
            rows[r][c] *= scale
    return rows


def _in_powers(rows: list[Series]) -> list[fmpq_poly]:
    """Every row of cosines as a polynomial in cos^2 tau behind cos tau: a product of matrices in integers."""
    size = len(rows)
    commons = [reduce(fmpz.lcm, (c.q for c in row), fmpz(1)) for row in rows]
    numerators = [
        [c.p * (d // c.q) for c in row] + [0] * (size - len(row)) for row, d in zip(rows, commons, strict=True)
    ]
    chebyshev = [fmpz_poly.chebyshev_t(2 * c + 1).coeffs()[1::2] + [0] * (size - c - 1) for c in range(size)]
    product = fmpz_mat(numerators) * fmpz_mat(chebyshev)
    table = product.tolist()
    return [fmpq_poly(fmpz_poly(row), d) for row, d in zip(table, commons, strict=True)]
