"""How code is asked for: everything beside the formula itself."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.number import FLOAT64, Real, rounded
from ridgeback.symbolic.codegen.polynomial import whole_domain
from ridgeback.symbolic.codegen.program import Domain, Mode


@dataclass(frozen=True, kw_only=True)
class CodeRequest:
    """Options of generated code; complete at construction."""

    equation: str = ""
    """For the documentation."""
    limit: float | None = None
    """The amplitude at which the oscillation itself ends."""
    up_to: Fraction | None = None
    """The end of the domain, which nothing is claimed beyond."""
    more: tuple[str, ...] = ()
    """Further lines of documentation."""
    name: str = ""
    """Identifier of what is generated; by default the system's name."""
    mode: Mode = "strict"
    real: Real = FLOAT64
    motion: bool = False
    """Whether u(t) and its harmonics are generated too."""

    def domain(self, argument: str, *, even: bool = True) -> Domain:
        """Where the variable may lie: up to ``up_to`` or just below ``limit``, on both sides of 0 or above it only."""
        limit = None if self.limit is None else Fraction(self.limit)
        if self.up_to is not None and limit is not None and self.up_to > limit:
            raise InputError(
                f"the range up to {argument} = {float(self.up_to):.10g} goes beyond {argument} = {self.limit:.10g}, "
                "where the oscillation ends; give a shorter one"
            )
        last = limit if self.up_to is None else self.up_to
        if last is None:
            whole = whole_domain(argument, self.real)
            return whole if even else replace(whole, low=0.0)
        end = not_above(last, self.real, open_end=last == limit)
        return Domain(argument, -end if even else 0.0, end)


def not_above(end: Fraction, real: Real, *, open_end: bool) -> float:
    """The largest number of the format that is not above ``end``, or below it at an open end.

    >>> not_above(Fraction(1), FLOAT64, open_end=True).hex(), not_above(Fraction(1), FLOAT64, open_end=False)
    ('0x1.fffffffffffffp-1', 1.0)
    """
    step = Fraction(1)
    value = rounded(end, real)
    while Fraction(value) > end or (open_end and Fraction(value) == end):
        value = rounded(Fraction(value) * (1 - step * real.unit), real)
    return value
