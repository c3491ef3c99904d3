"""Arithmetic of truncated power series in one variable, given as lists of exact coefficients.

The coefficients are rationals (then FLINT's ``fmpq_series`` does the work) or polynomials in parameters (then the
plain quadratic and cubic rules do).  A list of length n + 1 is known through order n, and so is every result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import flint
from flint import fmpq, fmpq_series

Scalar = Any
Coefficients = list[Scalar]


@contextmanager
def _precision(length: int) -> Iterator[None]:
    """Set FLINT's series length for one operation and restore it."""
    before = flint.ctx.cap
    flint.ctx.cap = length
    try:
        yield
    finally:
        flint.ctx.cap = before


def _rational(*series: Sequence[Scalar]) -> bool:
    return all(isinstance(value, fmpq) for coefficients in series for value in coefficients)


def _by_flint(length: int, operation: Callable[[], fmpq_series]) -> Coefficients:
    with _precision(length):
        found = list(operation().coeffs())
    return found + [fmpq(0)] * (length - len(found))


def multiply(x: Sequence[Scalar], y: Sequence[Scalar]) -> Coefficients:
    """Return x y through the shorter length.

    >>> multiply([fmpq(1), fmpq(1)], [fmpq(1), fmpq(-1)])
    [1, 0]
    """
    n = min(len(x), len(y))
    if _rational(x, y):
        return _by_flint(n, lambda: fmpq_series(list(x[:n]), prec=n) * fmpq_series(list(y[:n]), prec=n))
    if sum(c != 0 for c in y[:n]) < sum(c != 0 for c in x[:n]):
        x, y = y, x
    few = [(j, c) for j, c in enumerate(x[:n]) if c != 0]
    return [sum((c * y[i - j] for j, c in few if j <= i), fmpq(0)) for i in range(n)]


def reciprocal(x: Sequence[Scalar]) -> Coefficients:
    """Return 1 / x for x_0 = 1.

    >>> reciprocal([fmpq(1), fmpq(1), fmpq(0)])
    [1, -1, 1]
    """
    n = len(x)
    if _rational(x):
        return _by_flint(n, lambda: fmpq_series(list(x), prec=n).inv())
    result: Coefficients = [fmpq(1)]
    for i in range(1, n):
        result.append(-sum((x[j] * result[i - j] for j in range(1, i + 1)), fmpq(0)))
    return result


def square_root(x: Sequence[Scalar]) -> Coefficients:
    """Return sqrt(x) for x_0 = 1: 2 r_i = x_i - sum of r_j r_(i-j) over 0 < j < i.

    >>> square_root([fmpq(1), fmpq(1), fmpq(0)])
    [1, 1/2, -1/8]
    """
    if _rational(x):
        return _by_flint(len(x), lambda: fmpq_series(list(x), prec=len(x)).sqrt())
    result: Coefficients = [fmpq(1)]
    for i in range(1, len(x)):
        inner = sum((result[j] * result[i - j] for j in range(1, i)), fmpq(0))
        result.append((x[i] - inner) * fmpq(1, 2))
    return result


def power(x: Sequence[Scalar], exponent: fmpq) -> Coefficients:
    """Return x^r for x_0 = 1: n y_n = sum of ((r + 1) j - n) x_j y_(n-j) over 0 < j <= n (J. C. P. Miller).

    >>> power([fmpq(1), fmpq(1), fmpq(0)], fmpq(1, 3))
    [1, 1/3, -1/9]
    """
    if _rational(x):
        return _by_flint(len(x), lambda: _raised(x, exponent))
    result: Coefficients = [fmpq(1)]
    for n in range(1, len(x)):
        inner = sum((((exponent + 1) * j - n) * x[j] * result[n - j] for j in range(1, n + 1)), fmpq(0))
        result.append(inner * fmpq(1, n))
    return result


def _raised(x: Sequence[Scalar], exponent: Scalar) -> Any:
    scaled: Any = fmpq_series(list(x), prec=len(x)).log() * exponent
    return scaled.exp()


def compose(outer: Sequence[Scalar], inner: Sequence[Scalar]) -> Coefficients:
    """Return outer(inner) for inner_0 = 0, by Horner's rule.

    >>> compose([fmpq(0), fmpq(0), fmpq(1)], [fmpq(0), fmpq(1), fmpq(1)])
    [0, 0, 1]
    """
    n = min(len(outer), len(inner))
    if not any(value != 0 for value in inner[:n]):  # FLINT takes a zero series for one with a constant term
        return [outer[0], *[fmpq(0)] * (n - 1)] if n else []
    if _rational(outer, inner):
        return _by_flint(n, lambda: fmpq_series(list(outer[:n]), prec=n)(fmpq_series(list(inner[:n]), prec=n)))
    result: Coefficients = [fmpq(0)] * n
    for value in reversed(outer[:n]):
        result = multiply(result, inner[:n])
        result[0] = result[0] + value
    return result


def revert(x: Sequence[Scalar]) -> Coefficients:
    """Return the inverse function's series for x_0 = 0, x_1 = 1, by Lagrange: [t^n] = [s^(n-1)] (s / x(s))^n / n.

    >>> revert([fmpq(0), fmpq(1), fmpq(1), fmpq(0)])
    [0, 1, -1, 2]
    """
    if _rational(x):
        return _by_flint(len(x), lambda: fmpq_series(list(x), prec=len(x)).reversion())
    base = reciprocal(list(x[1:]))
    power, result = [fmpq(1)] + [fmpq(0)] * (len(base) - 1), [fmpq(0)]
    for n in range(1, len(x)):
        power = multiply(power, base)
        result.append(power[n - 1] * fmpq(1, n))
    return result
