"""The unit of time of a record is in no result of an identification."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.compare.identification.identify import identify
from ridgeback.numeric.recording.recording import Recording


def test_no_unit_of_time_is_in_a_fit() -> None:
    """Of a sine in years the steps of a fit were as long as its frequency: van der Pol was claimed."""
    t = np.arange(600) / 12.0
    x = np.cos(1.7 * t) + 0.05 * np.random.default_rng(1).normal(size=t.size)
    found = [
        identify(Recording(t * year, x, 12.0 / year, "u", "", "a.csv", ""), candidates=("linear", "van-der-pol"))
        for year in (1.0, 31_557_600.0)
    ]
    assert [one.candidates[0].name for one in found] == ["linear", "linear"]
    ours, theirs = ({c.name: c.delta for c in one.candidates} for one in found)
    assert theirs == pytest.approx(ours, abs=0.5)
