"""Zeros in intervals, and precisions tried one after the other."""

from __future__ import annotations

import pytest
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.enclosure.walk import ATTEMPTS, UndecidedError, decided, root
from ridgeback.symbolic.enclosure.well import MAX_DEGREE, exact_polynomial
from ridgeback.symbolic.systems.oscillator import U


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("place", [fmpq(1, 2), fmpq(-1, 3), fmpq(1, 4)])
def test_a_zero_is_found_where_the_slope_may_vanish(sign: int, place: fmpq) -> None:
    """x^3 = c^3 on either side of the flat place, and where the first cut of the interval hits the zero."""
    found = root(lambda x: sign * (x**3 - place**3), lambda x: sign * 3 * x**2, arb(-1), arb(fmpq(3, 2)))
    assert found.contains(place)
    assert found.rad() < 1e-12


def test_what_is_done_is_told_by_the_precisions_that_are_left() -> None:
    """Each costs twice the one before: 1 + 2 + ... + 2^(d-1) of 1 + 2 + ... + 2^(ATTEMPTS-1)."""
    told: list[tuple[float, str]] = []

    def attempt(_: int) -> None:
        raise UndecidedError

    with pytest.raises(InputError, match="cannot decide"):
        decided(attempt, "none", 64, lambda share, step: told.append((share, step)))
    total = sum(2**d for d in range(ATTEMPTS))
    assert [share for share, _ in told] == [sum(2**e for e in range(d)) / total for d in range(ATTEMPTS)]
    assert told[1][1] == "balls of 128 bits"


def test_the_highest_degree_is_taken_and_the_next_is_refused() -> None:
    found = exact_polynomial(U**MAX_DEGREE)
    assert found is not None
    assert found.degree() == MAX_DEGREE
    with pytest.raises(InputError, match=f"degree {MAX_DEGREE + 1}, and certified roots are kept to {MAX_DEGREE}"):
        exact_polynomial(U ** (MAX_DEGREE + 1))
