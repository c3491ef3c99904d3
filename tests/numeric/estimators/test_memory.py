"""What an estimate takes is said before: a large record is refused, or does without the part that would be too dear."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators import memory
from ridgeback.numeric.estimators.estimate import estimate


def test_a_method_that_does_not_fit_is_refused_before_it_begins() -> None:
    x = np.cos(0.2 * np.arange(1_000_000))
    with pytest.raises(InputError, match=r"polynomial-wigner of 1000000 samples would take about 3\.6 GB, over 1 GB"):
        estimate(x, 100.0, method="polynomial-wigner")
    with pytest.raises(InputError, match=r"the bias of 1000000 samples would take about 3 GB"):
        estimate(x, 100.0, method="hilbert", remove_bias=True)


def test_a_record_whose_bias_does_not_fit_is_measured_without(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.cos(0.2 * np.arange(2000))
    monkeypatch.setattr(memory, "MEMORY_BUDGET", 5_000_000)
    track = estimate(x, 100.0, method="hilbert")
    assert track.valid.any()
    assert track.interval is None
    assert "the bias of 2000 samples would take" in str(track.no_interval)
