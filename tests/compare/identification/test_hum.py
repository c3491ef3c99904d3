"""A hum of the mains is no decay: no class, no damping and no forecast of it are claimed."""

import math
from functools import partial

import numpy as np
import pytest

from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.shown import Standing
from ridgeback.compare.recording.recording import compare_recording
from ridgeback.compare.report import identification_part
from ridgeback.compare.report.recording_summary import recording_cards, recording_sentences, recording_title
from ridgeback.numeric.recording.recording import Recording
from ridgeback.verbs.identify import prose

HUM = "a steady tone at 50.0201 Hz (mains hum), amplitude 1"


def recorded(x: np.ndarray, rate: float) -> Recording:
    t = np.arange(x.size) / rate
    noise = 0.01 * np.random.default_rng(5).standard_normal(x.size)
    return Recording(t, x + noise, rate, "u", "", "hum.csv", "")


@pytest.fixture(scope="module")
def hum() -> Recording:
    t = np.arange(1200) / 600.0
    decay = 0.25 * np.exp(-0.008 * 2 * np.pi * 37 * t) * np.cos(2 * np.pi * 37 * t)
    return recorded(decay + np.cos(2 * np.pi * 50.02 * t + 1), 600.0)


def test_a_hum_is_of_no_class(hum: Recording) -> None:
    found = identify(hum, candidates=("linear",))
    assert found.standing is Standing.HUM
    assert HUM in found.verdict
    assert HUM in found.title
    assert found.record()["hum"] == found.hum == HUM
    assert all(math.isnan(p.standard_deviation) for p in found.best.parameters)
    assert "Linear" not in prose(found)


def test_a_report_has_neither_damping_nor_forecast_of_a_hum(hum: Recording, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(identification_part, "identify", partial(identify, candidates=("linear",)))
    compared = compare_recording(hum, methods=("harmonic-least-squares",))
    assert compared.hum == HUM
    assert recording_title(compared) == f"No decay: {HUM}"
    damping = recording_cards(compared)[1]
    assert (damping.heading, damping.value) == ("Damping ratio", "–")
    made = identification_part.identification_part(hum, compared, None, lambda *_: None).found
    assert made is not None
    assert made.prediction is None
    assert "Linear" not in " ".join(recording_sentences(compared, made))


def test_a_decay_of_almost_nothing_has_an_interval_of_its_loss_that_the_samples_allow() -> None:
    t, omega = np.arange(1500) / 300.0, 2 * np.pi * 7
    found = identify(recorded(np.cos(omega * t), 300.0), candidates=("linear",))
    low, high = found.best.parameter("mu").interval()
    # the Cramer-Rao bound of the growth rate: sigma sqrt(24 / N) / (a T)
    assert 0.5 * (high - low) == pytest.approx(1.96 * 0.01 * math.sqrt(24 / 1500) / 5.0, rel=0.25)
    assert low <= 0.0 <= high


def test_a_band_isolates_the_decay_beside_a_hum(hum: Recording) -> None:
    found = identify(hum, candidates=("linear",), band=(200.0, 260.0))
    assert found.standing is Standing.CLAIMED
    low, high = found.best.parameter("mu").interval()
    assert low < 0.008 * 2 * np.pi * 37 < high
    low, high = found.best.parameter("k").interval()
    assert low < 2 * np.pi * 37 * math.sqrt(1 + 0.008**2) < high
    compared = compare_recording(hum, methods=("harmonic-least-squares",), band=(200.0, 260.0))
    assert not compared.hum
    assert recording_title(compared).startswith("37.0")
