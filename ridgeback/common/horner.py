"""Horner's rule: the value of a polynomial in one variable, over numbers or arrays."""

from __future__ import annotations

from collections.abc import Reversible
from typing import Any


def polynomial_value(coefficients: Reversible[Any], x: Any) -> Any:
    """The value of c_0 + c_1 x + c_2 x^2 + ... at a number or an array.

    References
    ----------
    Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), section 5.1.

    Examples
    --------
    >>> polynomial_value((1.0, 0.0, -0.0625), 2.0), polynomial_value((), 2.0)
    (0.75, 0.0)
    """
    total = x * 0
    for coefficient in reversed(coefficients):
        total = total * x + coefficient
    return total
