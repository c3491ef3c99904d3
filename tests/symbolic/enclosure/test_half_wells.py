"""One side of a well with a kink at rest."""

from __future__ import annotations

import pytest
from flint import acb, arb, ctx, fmpq

from ridgeback.symbolic.enclosure.half_wells import HalfWell, _radius, two_sided
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("force", ["u*abs(u)", "u + abs(u)*u/3 + u**2/5", "sin(u) + u*abs(u)", "2*u + abs(u)"])
@pytest.mark.parametrize("place", [fmpq(1), fmpq(3, 4), fmpq(1, 3)])
def test_a_turning_point_is_found_from_its_energy(force: str, place: fmpq) -> None:
    """V(w) = V(w0) at w0, where a stride ends, or not."""
    with ctx.workprec(64):
        sides = two_sided(Oscillator.from_equation(f"u'' + {force} = 0"))
        for well in (HalfWell(sides.near), HalfWell(sides.far)):
            for unit in (place, place / 4, place * 5 / 3):
                found = well.turning(well.energy(arb(place)), arb(unit))
                assert found is not None
                assert found.overlaps(arb(place))
                assert found.rad() < 1e-9


def test_a_complex_ball_lies_within_its_radius() -> None:
    """Its corners: 3, 4, 5."""
    assert 5 <= _radius(acb(arb(1, 3), arb(-2, 4))) < 5.0001


@pytest.mark.parametrize("place", [fmpq(1, 8), fmpq(2), fmpq(3), fmpq(311, 100)])
def test_the_time_from_rest_is_the_elliptic_integral(place: fmpq) -> None:
    """Of the pendulum: K(sin^2(W/2))."""
    for bits in (60, 120):
        with ctx.workprec(bits + 60):
            well = HalfWell(two_sided(Oscillator.from_equation("u'' + sin(u) = 0")).near)
            found = well.time(arb(place), bits)
            assert found.overlaps(acb((arb(place) / 2).sin() ** 2).elliptic_k().real)
            assert found.rel_accuracy_bits() >= bits - 8
