"""Vectorised bracketed root finding: Newton's step, kept inside a shrinking bracket by bisection."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ridgeback.numeric.arrays import Array, Mask

ValueAndSlope = Callable[[Array], tuple[Array, Array]]


def bracketed_newton(
    function: ValueAndSlope,
    low: Array,
    high: Array,
    *,
    guess: Array | None = None,
    rising: Mask | bool | None = None,
) -> Array:
    """Return the root of a function in each bracket ``[low, high]`` with a sign change (all 1-D, one shape).

    ``function(x)`` gives value and slope; ``rising`` says whether it goes from negative to positive, and is found
    from the values at both ends when not given.  A Newton step that leaves its bracket is replaced by bisection
    (Press et al., Numerical Recipes, section 9.4, ``rtsafe``), so that every bracket converges.

    >>> import numpy as np
    >>> root = bracketed_newton(lambda x: (x * x - [2.0, 9.0], 2 * x), np.zeros(2), np.full(2, 10.0))
    >>> [round(float(r), 12) for r in root]
    [1.414213562373, 3.0]
    >>> bracketed_newton(lambda x: (2.0 - x, -np.ones(1)), np.zeros(1), np.full(1, 10.0)).tolist()
    [2.0]
    """
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    if low.size == 0:
        return low
    if rising is None:
        rising = function(high)[0] >= function(low)[0]
    sign = np.where(rising, 1.0, -1.0)
    x = 0.5 * (low + high)
    if guess is not None:  # one outside is no better than the end, which may be a pole, where Newton's steps are tiny
        x = np.where((guess > low) & (guess < high), guess, x)
    for _ in range(120):
        value, slope = function(x)
        below = sign * value <= 0
        low, high = np.where(below, x, low), np.where(below, high, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = x - value / slope
        step = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        step = np.where(value == 0, x, step)
        moved = np.abs(step - x)
        x = step
        if np.all(moved <= 4e-15 * np.abs(x)):  # quadratic: the step just made leaves rounding only
            break
    return x
