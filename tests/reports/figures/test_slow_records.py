"""A slow motion is told in the unit in which it has few digits: its times, frequencies and rates, on every figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ridgeback.compare.report.recording_summary import recording_cards, recording_lead, recording_title
from ridgeback.reports.figures.clock import TAU, Clock
from ridgeback.reports.figures.recordings.slow_records import clock_of, identification_in, recording_in
from ridgeback.reports.page import html_page
from tests.reports import synthetic

SLOWER = 86_400.0 / 1.5
"""The recording goes at about 1.2 Hz; so many times slower it has about 1.8 cycles a day."""


@pytest.fixture(scope="module")
def page() -> str:
    stretched = Clock("s", 1.0 / SLOWER)
    found = recording_in(synthetic.make_recording(), stretched)
    made = identification_in(synthetic.make_identification(), stretched)
    return html_page(replace(synthetic.recording_report(), recording=found, identification=made))


def test_a_slow_recording_has_its_clock_and_its_numbers() -> None:
    fast = synthetic.make_recording()
    slow = recording_in(fast, Clock("s", 1.0 / SLOWER))
    clock = clock_of(slow)
    assert clock == Clock("d", 86_400.0)
    told = recording_in(slow, clock)
    assert told.backbone_omega * clock.factor == pytest.approx(1.5 * fast.backbone_omega / TAU)
    assert told.time == pytest.approx(fast.time / 1.5)
    assert told.damping_ratio == pytest.approx(fast.damping_ratio)
    assert told.spectrogram.omega / told.curves[0].omega.max() == pytest.approx(
        fast.spectrogram.omega / fast.curves[0].omega.max()
    )
    assert clock_of(fast) == Clock("s")
    values = [value for card in recording_cards(slow)[:2] for _, value in card.rows]
    assert all(value.endswith("per day") or "per" not in value for value in values)
    assert float(np.median(told.rate)) == pytest.approx(1.5 * fast.rate)
    assert f"{told.rate:.4g} per day" in recording_lead(slow)
    assert "per day)" in recording_title(slow)


def test_no_figure_of_a_slow_recording_is_in_seconds(page: str) -> None:
    assert "cycles per day" in page
    assert ">t, d<" in page
    for said in (">t, s<", "Hz<", "1/s<"):
        assert said not in page, said
