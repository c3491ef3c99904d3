"""What is printed of a limit cycle and of the series held against it."""

from __future__ import annotations

from fractions import Fraction

from flint import arb, ctx

from ridgeback.symbolic.certificates.at_cycles import CertifiedCycle, certified_cycles
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find


def test_the_bound_of_the_error_is_the_next_float_above_it() -> None:
    """The bits of the enclosure, few as they are, are not those that its bound is rounded with."""
    series = lindstedt(find("van-der-pol"), 8)
    (row,) = certified_cycles(find("van-der-pol"), [Fraction(1, 2)], formula=series, bits=48)
    assert isinstance(row, CertifiedCycle)
    assert row.error is not None
    bound = row.to_dict(12)["error_bound"]
    assert isinstance(bound, float)
    with ctx.workprec(200):
        above = abs(row.error).upper()
        assert above <= bound
        assert bound <= above * (1 + arb(2) ** -50)
