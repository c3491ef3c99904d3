"""What a page of several signals says where they agree, scatter, share no amplitude, or have none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.common.progress import silent
from ridgeback.compare.recording.measurements import Measurements, measure_recordings
from ridgeback.compare.report.several import runs_report
from ridgeback.compare.report.several.runs import Named, Runs, facts
from ridgeback.numeric.recording.recording import Recording
from tests.reports import synthetic_several


@pytest.fixture(scope="module")
def runs() -> Runs:
    made = synthetic_several.runs_report().runs
    assert made is not None
    return replace(made, found=scattered(made.found, 0.0), named=())


def scattered(found: Measurements, times: float) -> Measurements:
    """The same with a scatter between the runs of so many times their own deviation."""
    one = found.combined[0]
    curve = replace(one.curve, omega_between=times * one.curve.omega_sd)
    return replace(found, combined=(replace(one, curve=curve),))


def alone(found: Measurements, *keep: int) -> Measurements:
    """Nothing combined, and backbones of the signals named only."""
    measured = (one if i in keep else replace(one, backbone=None) for i, one in enumerate(found.measured))
    return replace(found, combined=(), measured=tuple(measured))


def test_signals_that_agree_and_signals_that_scatter(runs: Runs) -> None:
    assert runs_report.runs_title(runs).startswith("2 signals agree: ")
    assert "they agree within their own errors" in " ".join(runs_report._sentences(runs))
    assert [card.value for card in runs_report._cards(runs)][2] == "within errors"
    apart = replace(runs, found=scattered(runs.found, 5.0))
    relative, _ = runs_report.between(apart.found) or (0.0, 0.0)
    curve = runs.found.combined[0].curve
    assert relative == pytest.approx(5.0 * np.median(curve.omega_sd / curve.omega))
    assert "2 signals differ by" in runs_report.runs_title(apart)
    assert "scatters by" in " ".join(runs_report._sentences(apart))
    assert [card.text for card in runs_report._cards(apart)][2] == "scatter of ω₀ between runs"


def test_two_signals_of_other_frequencies_do_not_agree() -> None:
    """Their scatter widens the combined deviation, against which any two would agree."""
    t, rng = np.arange(640) / 32.0, np.random.default_rng(1)
    recordings = [
        Recording(t, np.exp(-0.05 * t) * np.cos(w * t) + 0.001 * rng.normal(size=640), 32.0, "u", "mm", f"{w}.csv", "")
        for w in (6.0, 6.3)
    ]
    apart = Runs(measure_recordings(recordings, method="zero-crossing"), ("6.0", "6.3"), None, ())
    assert runs_report.runs_title(apart).startswith("2 signals differ by 3.")
    assert "scatters by" in " ".join(runs_report._sentences(apart))


def test_signals_that_share_no_amplitude_stand_alone(runs: Runs) -> None:
    unshared = replace(runs, found=scattered(runs.found, np.nan))
    assert runs_report.between(unshared.found) is None
    assert runs_report.runs_title(unshared).startswith("2 signals: ")
    second = replace(runs, found=alone(runs.found, 1))
    curve = runs.found.measured[1].backbone
    assert curve is not None
    found = runs_report._leading(second.found)
    assert found is not None
    assert np.array_equal(found[1], curve.curve_omega)
    assert len(list(runs_report._cards(second))) == 2
    assert dict(runs_report._files(second))["backbones.csv"].count("first") == 0
    assert facts(second.found.measured[0])["damping ratio"] == ""


def test_signals_without_an_amplitude_have_no_cards(runs: Runs) -> None:
    bare = replace(runs, found=alone(runs.found))
    assert runs_report.runs_title(bare) == "2 signals: none has an amplitude clear of the noise"
    assert list(runs_report._cards(bare)) == list(runs_report._named(bare.found, None, silent)) == []


def test_a_signal_that_no_class_fits_is_named_with_the_reason(runs: Runs, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(_: object) -> None:
        raise InputError("too few cycles")

    monkeypatch.setattr(runs_report, "identify", refused)
    named = list(runs_report._named(runs.found, None, silent))
    assert named == [Named(label, None, "too few cycles") for label in ("first", "second")]
