"""What an estimate takes is said before: a large record is refused, or does without the part that would be too dear."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators import memory
from ridgeback.numeric.estimators.estimate import estimate

MEASURE = """
import re, sys
from pathlib import Path
import numpy as np
from ridgeback.numeric.estimators.estimate import estimate

def peak():
    return 1024 * int(re.search(r"VmHWM:\\s*(\\d+) kB", Path("/proc/self/status").read_text())[1])

size = int(sys.argv[2])
estimate(np.cos(0.2 * np.arange(2000)), 32.0, method=sys.argv[1], bias=False)
x = np.cos(0.5 * np.arange(size)) + 0.01 * np.random.default_rng(1).normal(size=size)
before = peak()
estimate(x, 32.0, method=sys.argv[1], bias=False)
print(peak() - before)
"""


def test_a_method_that_does_not_fit_is_refused_before_it_begins(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.cos(0.5 * np.arange(200_000))
    monkeypatch.setattr(memory, "MEMORY_BUDGET", memory.FIXED + 70_000_000)
    with pytest.raises(
        InputError, match=r"polynomial-wigner of 200000 samples would take about 0\.2 GB, over 0\.13 GB"
    ):
        estimate(x, 100.0, method="polynomial-wigner")
    with pytest.raises(InputError, match=r"use method auto, which takes fewer .*, or at most"):
        memory.check_memory("wigner", 10**8)
    with pytest.raises(InputError, match=r"over 0\.13 GB; use at most"):
        memory.check_memory("auto", 10**8)
    with pytest.raises(InputError, match=r"the bias of 200000 samples would take about 0\.15 GB"):
        estimate(x, 100.0, method="hilbert", remove_bias=True)


def test_a_record_whose_bias_does_not_fit_is_measured_without(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.cos(0.2 * np.arange(2000))
    monkeypatch.setattr(memory, "MEMORY_BUDGET", memory.FIXED + 700_000)
    track = estimate(x, 100.0, method="hilbert")
    assert track.valid.any()
    assert track.interval is None
    assert "the bias of 2000 samples would take" in str(track.no_interval)
    assert str(track.no_interval).endswith(f"at most {700_000 // memory.WITH_BIAS}")


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say what a process has held")
def test_the_prediction_holds_within_a_factor_of_three() -> None:
    run = subprocess.run([sys.executable, "-c", MEASURE, "hilbert", "250000"], capture_output=True, check=True)
    assert 1 / 3 < int(run.stdout) / memory.predicted_bytes("hilbert", 250_000, bias=False) < 3


def test_a_very_long_record_is_decimated_by_every_method_as_far_as_its_harmonics_allow() -> None:
    t = np.arange(70_000) / 960.0
    x = np.cos(2 * np.pi * 10.0 * t) + 0.01 * np.random.default_rng(1).normal(size=t.size)
    plain = estimate(x, 960.0, method="hilbert", bias=False)
    assert plain.used.decimated_by == 7
    assert np.abs(np.mean(plain.inside().frequency_hz) - 10.0) < 1e-3
    fifth = estimate(x, 960.0, method="hilbert", harmonic=5, bias=False)
    assert float(np.median(np.diff(fifth.time))) == pytest.approx(4 / 960.0)
    assert estimate(x[:60_000], 960.0, method="hilbert", bias=False).used.decimated_by < 2
