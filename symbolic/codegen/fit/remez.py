r"""Remez's exchange for polynomials without a constant term: the best p(x) = sum_(i >= 1) c_i x^i on (0, X].

At d + 1 points of a reference the error takes one size with alternating signs; points are moved to the extrema of the
error until these are level (M. J. D. Powell, Approximation Theory and Methods, Cambridge, 1981, chapters 8 and 9).
Powers without a constant are a Chebyshev system on (0, X], so that the best fit is unique and found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from flint import arb, arb_mat, arb_poly

from ridgeback.common.errors import InputError

Function: TypeAlias = Callable[[arb], arb]
LEVEL: Final = arb("1e-4")
"""The extrema are level when they differ by less than this share."""
ROUNDS: Final = 40
DENSITY: Final = 24
"""Points looked at for each power."""


@dataclass(frozen=True)
class Best:
    """Coefficients of the free powers, and the size of the error on the reference."""

    coefficients: tuple[arb, ...]
    size: arb
    reference: tuple[arb, ...]


def remez(target: Function, end: arb, powers: Sequence[int], weight: Function | None = None) -> Best:
    """The best fit of a function on (0, end] by the powers given, to the working precision's centre values.

    Errors are measured in units of ``weight``, a positive function; 1 when there is none.  Raises InputError when the
    exchange does not settle.

    >>> found = remez(lambda x: x * x, arb(1), (1,))      # x^2 by c x: c = 2 (sqrt(2) - 1)
    >>> abs(float(found.coefficients[0]) - 2 * (2**0.5 - 1)) < 1e-4
    True
    """
    count = len(powers) + 1
    grid = [
        end * (1 + arb.cos_pi(arb(DENSITY * count - j) / (DENSITY * count))) / 2 for j in range(1, DENSITY * count + 1)
    ]
    grid = [x.mid() for x in grid]
    unit = weight or (lambda _: arb(1))
    wanted = [(target(x).mid(), unit(x).mid()) for x in grid]
    reference = _first(end, count)
    for _ in range(ROUNDS):
        best = _level(target, unit, powers, reference)
        fitted = _polynomial(powers, best.coefficients)
        errors = [((value - fitted(x)) / size).mid() for x, (value, size) in zip(grid, wanted, strict=True)]
        extrema = _alternating(_extrema(grid, errors), errors, count)
        if extrema is None:
            raise InputError(f"no fit of {len(powers)} coefficients alternates; ask for a lower degree")
        reference = [_peak(grid, errors, i) for i in extrema]
        sizes = [abs((target(x) - fitted(x)) / unit(x)).mid() for x in reference]
        if max(sizes) - min(sizes) < LEVEL * max(sizes):
            return _level(target, unit, powers, reference)
    raise InputError("the exchange of points does not settle; ask for a lower degree or a shorter range")


def _first(end: arb, count: int) -> list[arb]:
    """Extrema of a Chebyshev polynomial that vanishes at 0."""
    inner = ((end * (1 - arb.cos_pi(arb(2 * j + 1) / (2 * count))) / 2).mid() for j in range(count - 1))
    return [*inner, end.mid()]


def _level(target: Function, unit: Function, powers: Sequence[int], reference: Sequence[arb]) -> Best:
    """The fit whose error on the reference is +E, -E, +E, ... units."""
    rows = [[x**p for p in powers] + [unit(x) * (-1) ** i] for i, x in enumerate(reference)]
    solved = arb_mat(rows).solve(arb_mat([[target(x)] for x in reference]))
    values = [solved[i, 0].mid() for i in range(len(reference))]
    return Best(tuple(values[:-1]), abs(values[-1]), tuple(reference))


def _polynomial(powers: Sequence[int], coefficients: Sequence[arb]) -> arb_poly:
    dense = [arb(0)] * (max(powers) + 1)
    for p, c in zip(powers, coefficients, strict=True):
        dense[p] = c
    return arb_poly(dense)


def _extrema(grid: Sequence[arb], errors: Sequence[arb]) -> list[int]:
    """The largest error of every stretch of one sign."""
    found: list[int] = []
    for i in range(len(grid)):
        if found and (errors[i] > 0) == (errors[found[-1]] > 0):
            if abs(errors[i]) > abs(errors[found[-1]]):
                found[-1] = i
        else:
            found.append(i)
    return found


def _alternating(extrema: list[int], errors: Sequence[arb], count: int) -> list[int] | None:
    """As many neighbours as are needed: what is too much is dropped from the end where the error is smaller."""
    while len(extrema) > count:
        extrema = extrema[1:] if abs(errors[extrema[0]]) < abs(errors[extrema[-1]]) else extrema[:-1]
    return extrema if len(extrema) == count else None


def _peak(grid: Sequence[arb], errors: Sequence[arb], i: int) -> arb:
    """The place of an extremum by the parabola through its neighbours."""
    if not 0 < i < len(grid) - 1:
        return grid[i]
    (x0, x1, x2), (e0, e1, e2) = grid[i - 1 : i + 2], errors[i - 1 : i + 2]
    first, second = (e1 - e0) / (x1 - x0), (e2 - e1) / (x2 - x1)
    bend = (second - first) / (x2 - x0)
    if not abs(bend) > 0:
        return x1
    place = ((x0 + x1) / 2 - first / (2 * bend)).mid()
    return place if x0 < place < x2 else x1
