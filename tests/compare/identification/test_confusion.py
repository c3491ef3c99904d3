"""The confusion matrix of identification over seeded trials, and how often intervals hold the truth."""

from __future__ import annotations

import pytest

from ridgeback.compare.identification.confusion import Confusion, confusion

SIX = ("linear", "duffing-hardening", "duffing-softening", "helmholtz-duffing", "bilinear-stop", "van-der-pol")


@pytest.fixture(scope="module")
def matrices() -> tuple[Confusion, Confusion]:
    """One trial of each of six classes at 40 dB and at 20 dB, all six being candidates."""
    quiet, loud = (
        confusion(classes=SIX, candidates=SIX, laws=("linear",), trials=1, snr_db=snr, seed=3) for snr in (40.0, 20.0)
    )
    return quiet, loud


def test_the_right_class_comes_first(matrices: tuple[Confusion, Confusion]) -> None:
    """Of wider runs of the same trials at least nine in ten are recovered; here all at 40 dB and 5 of 6 at 20 dB."""
    quiet, loud = matrices
    assert quiet.recovered == 1.0
    assert loud.recovered >= 5 / 6
    assert quiet.tolerated == quiet.trials
    assert loud.tolerated >= 5


def test_intervals_hold_the_truth(matrices: tuple[Confusion, Confusion]) -> None:
    """38 true parameters in all: fewer than 32 inside would have a chance below 1 in 200 at 95 %."""
    inside, intervals = (sum(getattr(m, name) for m in matrices) for name in ("inside", "intervals"))
    assert intervals == 38
    assert inside >= 32


def test_rows_of_the_matrix_count_every_trial(matrices: tuple[Confusion, Confusion]) -> None:
    rows = matrices[0].rows()
    assert [row["true"] for row in rows] == list(SIX)
    assert all(sum(row[name] for name in SIX) == 1 for row in rows)  # type: ignore[misc]
