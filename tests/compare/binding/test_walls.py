"""The exact frequency next to a wall, and where the force is nearly gone, with an error that holds: closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable

import mpmath as mp
import pytest

from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.symbolic.systems.catalogue import find

CLOSED: dict[str, Callable[[mp.mpf], mp.mpf]] = {
    "kepler": lambda A: ((1 + 2 * A) / (1 + A) ** 2) ** mp.mpf("1.5"),  # Kepler's third law at angular momentum 1
    "poschl-teller": lambda A: 1 / mp.cos(A),
    "morse": lambda A: mp.sqrt(1 - mp.expm1(-A) ** 2),
}


@pytest.mark.parametrize(
    ("name", "peaks"),
    [("kepler", (0.5, 3.0, 10.0, 100.0)), ("poschl-teller", (0.5, 1.5, 1.55)), ("morse", (0.5, 3.0, 10.0))],
)
def test_the_error_holds_next_to_walls_and_where_the_force_is_nearly_gone(name: str, peaks: tuple[float, ...]) -> None:
    table = exact_frequency(bind(find(name)), peaks)
    with mp.workdps(40):
        for peak, omega, error in zip(peaks, table.omega, table.error, strict=True):
            assert abs(omega - float(CLOSED[name](mp.mpf(peak)))) <= error < 1e-9 * omega


def test_points_that_miss_a_steep_wall_do_not_count_as_settled() -> None:
    """Toda at A = 10: the force is -1 but for the last thousandth of the orbit; an orbit's error is its own."""
    toda = bind(find("toda"))
    alone, table = exact_frequency(toda, [10.0]), exact_frequency(toda, [1.0, 8.0, 10.0])
    assert math.expm1(alone.trough[0]) - alone.trough[0] == pytest.approx(math.expm1(10) - 10, rel=1e-14)
    assert abs(alone.omega[0] / 0.014967483844310 - 1) < 1e-9  # by Dormand and Prince's rule of order 8
    assert abs(alone.omega[0] - table.omega[2]) <= alone.error[0] < 1e-9
    assert table.error[0] < 1e-13
