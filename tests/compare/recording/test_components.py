"""Every oscillation of a signal with a track of its own: never swapped, none made up."""

from __future__ import annotations

import json

import numpy as np
import pytest

from ridgeback.answers.measurements_text import measurements_text
from ridgeback.compare.recording.components import measured_components
from ridgeback.compare.recording.measurement import measure
from ridgeback.compare.recording.measurements import measure_recordings
from ridgeback.numeric.recording.recording import Recording
from tests.numeric.holding import assert_holds

T = np.arange(800) / 200.0


def two_modes(seed: int) -> Recording:
    """20 Hz and 21.6 Hz, which decay unlike: the weaker is the stronger in the end."""
    noise = 0.01 * np.random.default_rng(seed).normal(size=T.size)
    x = np.exp(-0.8 * T) * np.cos(40.0 * np.pi * T) + 0.5 * np.exp(-0.2 * T) * np.cos(43.2 * np.pi * T + seed)
    return Recording.from_arrays(x + noise, 200.0, name="u")


def test_each_mode_has_a_track_and_a_backbone() -> None:
    found = measured_components(two_modes(1), components=2)
    assert [one.component for one in found] == [1, 2]
    truths = {20.0: -0.8, 21.6: -0.2}
    assert {round(float(np.median(one.track.frequency_hz)), 1) for one in found if one.track} == set(truths)
    for one in found:
        assert one.track is not None
        assert one.track.interval is not None
        assert one.backbone is not None
        f, rate = min(truths.items(), key=lambda pair: abs(pair[0] - float(np.median(one.track.frequency_hz))))
        assert_holds(one.track.interval, np.full(one.track.time.size, 2 * np.pi * f), share=0.7, within=3e-4)
        off = np.abs(one.backbone.curve_growth_rate - rate)
        assert np.median(off / one.backbone.curve_growth_rate_sd) < 2.5
        assert np.median(one.backbone.curve_growth_rate_sd) < 0.05 * abs(rate)


def test_none_is_made_up() -> None:
    x = np.exp(-0.8 * T) * np.cos(40.0 * np.pi * T) + 0.01 * np.random.default_rng(4).normal(size=T.size)
    (only,) = measured_components(Recording.from_arrays(x, 200.0), components=2)
    assert only.track is not None
    assert np.abs(only.track.inside().frequency_hz / 20.0 - 1.0).max() < 2e-3
    assert only.notes[0] == "1 of 2 components that were asked for stand out; none is made up."


@pytest.mark.parametrize("style", ["text", "json", "csv"])
def test_components_are_told_in_every_form(style: str) -> None:
    found = measure_recordings([two_modes(2)], components=2)
    text = measurements_text(found, style, backbone=True)
    if style == "json":
        assert [one["component"] for one in json.loads(text)["signals"]] == [1, 2]
    elif style == "csv":
        lines = text.splitlines()
        at = lines[0].split(",").index("component")
        assert {line.split(",")[at] for line in lines[1:]} == {"1", "2"}
    else:
        assert "u, component 1: 800 samples" in text
        assert "u, component 2: 800 samples" in text
    assert not found.combined


def test_modes_at_one_to_two_are_two_and_neither_is_a_harmonic() -> None:
    t, noise = np.arange(1200) / 1000.0, 0.01 * np.random.default_rng(3).normal(size=1200)
    size = np.exp(-2.5 * t)
    softening = size * np.cos(2 * np.pi * (122.0 * t - 0.244 * (1.0 - size**2)))  # 122 (1 - 0.01 a^2) Hz
    x = softening + 0.6 * np.exp(-4.0 * t) * np.cos(2 * np.pi * 243.0 * t + 1.0) + noise
    first, second = measured_components(Recording.from_arrays(x, 1000.0), components=2)
    for one, omega in ((first, 244 * np.pi * (1.0 - 0.01 * size**2)), (second, np.full(1200, 486 * np.pi))):
        assert one.track is not None
        inside = one.track.inside()
        assert inside.interval is not None
        assert_holds(inside.interval, np.interp(inside.time, t, omega), share=0.7, within=3e-4)
        assert len(one.track.used.tones) == (one is first)


def test_partials_of_a_stiff_string_are_modes_each_over_the_whole_record() -> None:
    t, noise = np.arange(1500) / 2000.0, 0.003 * np.random.default_rng(5).normal(size=1500)
    partials = {110.0 * n * np.sqrt(1.0 + 8e-4 * n**2): 1.2 + 0.5 * n for n in (1, 2, 3, 4)}
    sizes = (0.6, 0.9, 0.5, 0.3)
    waves = (
        a * np.exp(-g * t) * np.cos(2 * np.pi * f * t + f) for a, (f, g) in zip(sizes, partials.items(), strict=True)
    )
    found = measured_components(Recording.from_arrays(sum(waves) + noise, 2000.0), components=4)
    assert len(found) == 4
    assert found[0].track is not None
    assert found[0].track.used.span is None
    for one in found:
        assert one.track is not None
        f = float(np.median(one.track.inside().frequency_hz))
        near = min(partials, key=lambda true: abs(true - f))
        assert abs(f - near) < 0.1
        assert one.backbone is not None
        assert abs(np.median(one.backbone.curve_growth_rate) + partials.pop(near)) < 0.1


def test_a_component_of_a_band_is_in_it() -> None:
    found = measured_components(two_modes(2), components=2, band=(100.0, 130.0))
    assert [one.component for one in found] == [1]
    assert found[0].track is not None
    assert np.abs(found[0].track.inside().frequency_hz / 20.0 - 1.0).max() < 2e-3
    assert found[0].notes[0].startswith("1 of 2 components that were asked for stand out in the band")


def test_what_a_close_mode_leaves_open_widens_the_intervals_of_the_other() -> None:
    t, noise = np.arange(480) / 60.0, 0.01 * np.random.default_rng(3).normal(size=480)
    first, second = (a * np.exp(-0.4 * t) * np.cos(w * np.pi * t) for a, w in ((1.0, 20.0), (0.5, 20.6)))
    alone = measure(Recording.from_arrays(second + noise, 60.0)).backbone
    beside = measured_components(Recording.from_arrays(first + second + noise, 60.0), components=2)[1].backbone
    assert alone is not None
    assert beside is not None
    assert np.median(beside.growth_rate_sd) > 1.05 * np.median(alone.growth_rate_sd)
    assert abs(np.median((beside.growth_rate + 0.4) / beside.growth_rate_sd)) < 2.5
