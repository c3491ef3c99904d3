"""The frozen result of a derivation in balls: every coefficient enclosed, nothing said about the terms left out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import sympy
from flint import arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import natural_frequency, polynomial_at, scalar_ball
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.series.spaces import Scalar


@dataclass(frozen=True, eq=False, repr=False)
class BallExpansion:
    """omega0 = k sum c_n X^n with every c_n in a ball, X the amplitude A or eps/k; made by ``lindstedt_in_balls``.

    The fields are those of ``Expansion``; ``frequency`` holds the balls in the oscillator's own units.

    Examples
    --------
    >>> from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> lindstedt_in_balls(find("van-der-pol"), 4, digits=12).frequency[2].str(12, radius=False)
    '-0.0625000000000'
    """

    system: str
    variable: str
    amplitude: str
    """Definition of the amplitude: a key of ``ridgeback.symbolic.expansion.amplitude.MEANINGS``."""
    order: int
    scale: sympy.Expr
    """The natural frequency k, in rad per time unit."""
    scaled_variable: bool
    digits: int
    """Decimal digits that were asked for in every coefficient."""
    bits: int
    """The precision that the recursion began with."""
    coefficients: tuple[arb, ...]
    """c_0 ... c_order in units where k = 1."""
    amplitude_coefficients: tuple[arb, ...] | None
    """Limit cycles: the amplitude as a series in the variable, in units where k = 1."""

    method = "lindstedt"
    names = ()
    """Balls have no parameters left symbolic."""

    def __repr__(self) -> str:
        of = f"{self.amplitude} amplitude" if self.variable == "A" else self.variable
        digits = f"{self.digits} digits of each coefficient"
        return f"<BallExpansion: {self.system}, {self.method} to order {self.order} in {of}, {digits}>"

    @property
    def frequency(self) -> tuple[arb, ...]:
        """Balls of the coefficients of variable**0 ... variable**order in the oscillator's own units."""
        with ctx.workprec(self.bits):
            k = natural_frequency(self.scale)
            return tuple(k * c for c in self._rescaled(self.coefficients))

    @property
    def amplitude_series(self) -> tuple[arb, ...] | None:
        """Balls of the coefficients of a limit cycle's amplitude in powers of eps, or None."""
        with ctx.workprec(self.bits):
            return None if self.amplitude_coefficients is None else self._rescaled(self.amplitude_coefficients)

    def _rescaled(self, values: tuple[arb, ...]) -> tuple[arb, ...]:
        """Divide by the powers of k when the variable is eps/k."""
        if not self.scaled_variable or self.scale == 1:
            return values
        k, power, found = natural_frequency(self.scale), arb(1), []
        for c in values:
            found.append(c / power)
            power = power * k
        return tuple(found)

    def in_balls(self, value: arb) -> arb:
        """Return an enclosure of the truncated series, in rad per time unit, at FLINT's working precision.

        The terms left out are not in it: it encloses the series, not the exact frequency.
        """
        return polynomial_at(self.frequency, value)

    def misses(self, exact: Expansion) -> list[int]:
        """Orders at which an exact coefficient, of omega0 or of the amplitude, lies outside its ball (none: good).

        Raises InputError when the two are not the same expansion.
        """
        if (self.system, self.variable, self.amplitude) != (exact.system, exact.variable, exact.amplitude):
            raise InputError(
                f"balls for {self.system} ({self.amplitude}) meet the series of {exact.system} ({exact.amplitude}); "
                "compare expansions of one oscillator in one amplitude definition"
            )
        pairs = [(self.coefficients, exact.coefficients)]
        pairs += [(self.amplitude_coefficients or (), exact.amplitude_coefficients or ())]
        found = [
            n
            for mine, yours in pairs
            for n, (x, c) in enumerate(zip(mine, yours, strict=False))
            if not self._meets(x, c, exact)
        ]
        return sorted(set(found))

    def _meets(self, x: arb, c: Scalar, exact: Expansion) -> bool:
        """Whether an exact coefficient lies in a ball; the ball of an irrational one overlaps it."""
        if not exact.names:
            return holds(x, c)
        with ctx.workprec(self.bits):
            return bool(x.overlaps(scalar_ball(c, exact.names, exact.constants)))

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: balls as text, exact zeros left out.

        ``coefficient`` is decimal, the true value is within ``radius`` of it, ``ball`` is both; ``certain_digits`` is
        what the ball itself holds, of which ``digits`` are printed (None: the number is exact).
        """
        result: dict[str, object] = {
            "system": self.system,
            "method": self.method,
            "arithmetic": "balls",
            "amplitude": self.amplitude,
            "order": self.order,
            "digits": self.digits,
            "variables": [self.variable],
            "frequency": self._rows(self.frequency),
        }
        if self.amplitude_series is not None:
            result["amplitude_series"] = self._rows(self.amplitude_series)
        return result

    def _rows(self, values: tuple[arb, ...]) -> list[dict[str, object]]:
        return [
            {"powers": {self.variable: n}, **ball_row(c, self.digits)} for n, c in enumerate(values) if not c.is_zero()
        ]


def ball_row(x: arb, digits: int) -> dict[str, object]:
    """Return a ball in the public JSON form.

    Parameters
    ----------
    x : arb
        The ball.
    digits : int
        To print.

    Returns
    -------
    dict
        Midpoint, radius (with that of printing), both, and its certain digits.

    Examples
    --------
    >>> with ctx.workprec(100):
    ...     ball_row(arb(17) / 3072, 12)["coefficient"], ball_row(arb(17) / 3072, 12)["radius"]
    ('0.00553385416667', '3.34e-15')
    """
    text = x.str(digits)
    _, sign, radius = text.strip("[]").partition(" +/- ")
    return {
        "coefficient": x.str(digits, radius=False),
        "radius": radius if sign else "0",
        "ball": text,
        "certain_digits": certain_digits(x),
    }


def certain_digits(x: arb) -> int | None:
    """Decimal digits that a ball holds, 0 when it holds none; None when it is an exact number.

    >>> certain_digits(arb(1)), certain_digits(arb(1, 1e-9)), certain_digits(arb(0, 1))
    (None, 8, 0)
    """
    return None if x.is_exact() else max(0, int(x.rel_accuracy_bits() * math.log10(2)))


def holds(x: arb, value: fmpq) -> bool:
    """Whether an exact number lies in a ball, decided exactly at any working precision.

    >>> holds(arb(1, 0.5), fmpq(3, 2)), holds(arb(1, 0.5), fmpq(8, 5))
    (True, False)
    """
    return bool(abs(x.mid().fmpq() - value) <= x.rad().fmpq())


def missing_bits(values: Sequence[arb], digits: int) -> int:
    """Return how many bits more would give every ball so many digits.

    Parameters
    ----------
    values : sequence of arb
        The balls; one that holds 0 is measured against the smallest one that does not.
    digits : int
        Decimal digits wanted of each.

    Returns
    -------
    int
        0 when all have them.

    Examples
    --------
    >>> missing_bits((arb(1), arb(1, 1e-9)), 8), missing_bits((arb(1), arb(0, 1e-3)), 3) > 0
    (0, True)
    """
    sizes = [arb(1) if x.contains(0) else abs(x).abs_lower() for x in values]
    smallest = reduce(arb.min, sizes, arb(1))
    fraction, worst = arb(fmpq(1, 10**digits)), 0
    for x, size in zip(values, sizes, strict=True):
        excess = x.rad() / (fraction * (smallest if x.contains(0) else size))
        if not excess <= 1:
            worst = max(worst, log2(excess.abs_upper()))
    return worst


def log2(x: arb) -> int:
    """Return an integer at or above the binary logarithm of an exact positive number, at most 1 too high.

    >>> log2(arb(5)), log2(arb(4))
    (3, 3)
    """
    mantissa, exponent = x.man_exp()
    return int(mantissa).bit_length() + int(exponent)
