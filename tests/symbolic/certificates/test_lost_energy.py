"""The energy that a loss takes on an enclosed orbit, against the beta function."""

from __future__ import annotations

import pytest
from flint import arb, ctx, fmpq

from ridgeback.symbolic.certificates.lost_energy import _lost
from ridgeback.symbolic.enclosure.half_wells import HalfWell, two_sided
from ridgeback.symbolic.systems.oscillator import Oscillator, U


@pytest.mark.parametrize("exponent", [0, 1, 2, 3])
@pytest.mark.parametrize("power", [0, 8, 20])
def test_a_linear_force_loses_what_the_beta_function_says_to_all_bits(power: int, exponent: int) -> None:
    """u^n (W^2 - u^2)^(r/2) from 0 to W = 1/2 is W^(n + r + 1) B((n + 1)/2, r/2 + 1)/2."""
    for bits in (60, 120):
        with ctx.workprec(bits + 40):
            well = HalfWell(two_sided(Oscillator.from_equation("u'' + u = 0")).near)
            found = _lost(well, arb(1) / 2, U**power, exponent, bits)
            first, second = arb(fmpq(power + 1, 2)), arb(fmpq(exponent + 2, 2))
            beta = first.gamma() * second.gamma() / (first + second).gamma()
            assert found.overlaps(beta / arb(2) ** (power + exponent + 2))
            assert found.rel_accuracy_bits() >= bits
