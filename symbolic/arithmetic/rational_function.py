"""Quotients of polynomials with exact rational coefficients: Padé approximants and where their poles are.

Baker and Graves-Morris, Padé Approximants, 2nd ed. (Cambridge, 1996), section 2.4: the [m/n] approximant of f is found
by Euclid's algorithm for x^(m+n+1) and f, stopped at the first remainder of degree m or less.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy
from flint import acb, arb, fmpq, fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rendering import as_sympy

Coefficients = tuple[fmpq, ...]


def approximant(series: Sequence[fmpq], m: int, n: int) -> tuple[Coefficients, Coefficients]:
    """Return numerator and denominator of the [m/n] Padé approximant, the denominator 1 at the origin.

    Parameters
    ----------
    series : sequence of fmpq
        c_0, c_1, ..., m + n + 1 of them or more.
    m, n : int
        Degrees of numerator and denominator.

    Returns
    -------
    tuple of two tuples of fmpq
        Their coefficients, the lowest first.

    Raises
    ------
    InputError
        When the degrees do not fit the terms given, or the approximant does not exist.

    Examples
    --------
    >>> approximant([fmpq(1, f) for f in (1, 1, 2)], 1, 1)
    ((1, 1/2), (1, -1/2))
    """
    if m < 0 or n < 0 or m + n >= len(series):
        raise InputError(f"[{m}/{n}] needs {m + n + 1} coefficients and {len(series)} are known; lower a degree")
    earlier, remainder = fmpq_poly([0] * (m + n + 1) + [1]), fmpq_poly(list(series[: m + n + 1]))
    before, factor = fmpq_poly([0]), fmpq_poly([1])
    while remainder.degree() > m:
        quotient, rest = divmod(earlier, remainder)
        earlier, remainder = remainder, rest
        before, factor = factor, before - quotient * factor
    if factor[0] == 0:
        raise InputError(
            f"the [{m}/{n}] Padé approximant does not exist (its denominator vanishes at 0); change m or n"
        )
    return _divided(remainder, factor[0]), _divided(factor, factor[0])


def _divided(p: fmpq_poly, by: fmpq) -> Coefficients:
    return tuple(c / by for c in p.coeffs()) or (fmpq(0),)


def zeros(coefficients: Coefficients) -> list[acb]:
    """Return every zero of a polynomial as a certified, isolated ball; real zeros have an exactly zero imaginary part.

    >>> sorted(root.real.str(8, radius=False) for root in zeros((fmpq(-2), fmpq(0), fmpq(1))))
    ['-1.4142136', '1.4142136']
    """
    p = fmpq_poly(list(coefficients))
    found: Any = p.complex_roots() if p.degree() > 0 else []  # pairs of a root and its multiplicity
    return [root for root, _ in found]


def first_positive_zero(coefficients: Coefficients) -> arb | None:
    """Return the smallest positive zero of a polynomial, or None when there is none (certified either way).

    >>> first_positive_zero((fmpq(1), fmpq(1))) is None
    True
    """
    positive = [root.real for root in zeros(coefficients) if root.imag == 0 and root.real > 0]
    return min(positive, key=lambda x: float(x.mid()), default=None)


def as_expression(coefficients: Coefficients, x: sympy.Expr) -> sympy.Expr:
    """Return a polynomial as a SymPy expression.

    >>> as_expression((fmpq(1), fmpq(0), fmpq(1, 2)), sympy.Symbol("A"))
    A**2/2 + 1
    """
    return sympy.Add(*(as_sympy(c) * x**n for n, c in enumerate(coefficients) if c != 0))
