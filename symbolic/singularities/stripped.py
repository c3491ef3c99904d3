"""The coefficients of a series as numbers in the power that occurs: what its singularities are read from."""

from __future__ import annotations

import math
from typing import Any, Final, TypeAlias

import sympy
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.ball_ring import at_bits, midpoint
from ridgeback.symbolic.arithmetic.balls import rational, scalar_ball
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
from ridgeback.symbolic.expansion.expansion import Expansion

Series: TypeAlias = Expansion | BallExpansion

CONSTANT: Final = "every coefficient beyond the first is zero"
DIGITS: Final = 200
"""Of irrational coefficients."""
BITS: Final = int(DIGITS / math.log10(2.0))


def stripped(expansion: Series) -> tuple[int, list[Any]]:
    """Return the step of the powers that occur, and the coefficients of x = X^step.

    Parameters
    ----------
    expansion : Expansion or BallExpansion
        With rational coefficients or balls.

    Returns
    -------
    step : int
        1 or more.
    coefficients : list
        Rational numbers or balls.

    Raises
    ------
    InputError
        When there is nothing to examine: symbolic coefficients, all zero, or a polynomial.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> stripped(energy_integral("pendulum", 4))
    (2, [1, -1/16, 1/3072])
    """
    c = expansion.coefficients
    if not all(isinstance(value, fmpq | arb) for value in c):
        names = ", ".join(getattr(expansion, "symbolic_names", ()))
        if names:
            raise InputError(f"the coefficients hold {names} as symbols; set them to numbers")
        c = tuple(_decimal(expansion, value) for value in c)
    present = [n for n, value in enumerate(c) if n and not _is_zero(value)]
    if not present:
        raise InputError(CONSTANT)
    step = math.gcd(*present)
    series = list(c[::step])
    if len(series) > 2 * (present[-1] // step) + 4:
        raise InputError(f"every coefficient beyond {expansion.variable}^{present[-1]} is zero, a polynomial so far")
    return step, series


def _decimal(expansion: Series, coefficient: Any) -> fmpq:
    """An irrational coefficient to so many digits that what is estimated from it does not feel the rest."""
    assert not isinstance(expansion, BallExpansion)  # noqa: S101 - their coefficients are balls
    with at_bits(4 * BITS):  # terms that cancel take some
        near = scalar_ball(coefficient, expansion.names, expansion.constants)
    if near.rel_accuracy_bits() < BITS:  # it may be 0
        value = expansion.exact(coefficient)
        return rational(value if value.is_Rational else sympy.Rational(str(value.evalf(DIGITS))))
    with at_bits(BITS):
        mantissa, exponent = midpoint(1 * near)
    return fmpq(mantissa) * fmpq(2) ** exponent


def _is_zero(value: fmpq | arb) -> bool:
    """Exactly zero; a ball that merely holds 0 is not."""
    return bool(value.is_zero()) if isinstance(value, arb) else bool(value == 0)
