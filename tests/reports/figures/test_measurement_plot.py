"""The picture of a measurement: its texts, units and places, in SVG; sound files in the other forms."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from ridgeback.compare.recording.measurements import Measurements, measure_recordings
from ridgeback.numeric.recording.recording import Recording
from ridgeback.reports.drawing.canvas import Canvas
from ridgeback.reports.drawing.labels import measured
from ridgeback.reports.figures.recordings.measurement import PAGE, drawn, plot_file

RATE = 20.0
T = np.arange(500) / RATE
SVG = "{http://www.w3.org/2000/svg}"


def decay(size: float, name: str = "u", run: str = "", stretch: int = 0) -> Recording:
    a = size * np.exp(-0.05 * T)
    phase = 8.0 * T - 0.3 * size**2 * (1 - np.exp(-0.1 * T)) / 0.1
    return Recording(T, a * np.cos(phase), RATE, name, "mm", "run.csv", "0", run=run, stretch=stretch)


@pytest.fixture(scope="module")
def one() -> Measurements:
    return measure_recordings([decay(1.0)], method="pseudo-wigner", bias=False)


@pytest.fixture(scope="module")
def several() -> Measurements:
    runs = [decay(1.0, run="first.csv"), decay(0.8, run="second <b>.csv")]
    return measure_recordings(runs, method="pseudo-wigner", bias=False)


def texts(picture: bytes) -> list[ET.Element]:
    return list(ET.fromstring(picture).iter(f"{SVG}text"))  # noqa: S314 - our own


def boxes(picture: bytes) -> list[tuple[str, float, float, float, float]]:
    """Text, left, top, right, bottom of each text, measured in the font it is drawn in."""
    (axes,) = Canvas(PAGE).stack()
    found = []
    for element in texts(picture):
        words = element.text or ""
        width, _ = measured(axes, words)
        x, y = float(element.get("x", "nan")), float(element.get("y", "nan"))
        anchor = re.search(r"text-anchor: (\w+)", element.get("style", ""))
        left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor[1] if anchor else "start"] * width
        found.append((words, left, y - 8.0, left + width, y + 2.5))
    return found


@pytest.mark.parametrize("which", ["one", "several"])
def test_no_text_is_cut_off_or_covers_another(which: str, request: pytest.FixtureRequest) -> None:
    picture = plot_file(request.getfixturevalue(which), "svg")
    _, _, width, height = map(float, (ET.fromstring(picture).get("viewBox") or "").split())  # noqa: S314
    placed = boxes(picture)
    for words, left, top, right, bottom in placed:
        assert left >= 0, words
        assert top >= 0, words
        assert right <= width, words
        assert bottom <= height, words
    for i, (words, *a) in enumerate(placed):
        for other, *b in placed[:i]:
            apart = a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
            assert apart, (words, other)


def test_axes_are_named_with_their_units(one: Measurements) -> None:
    words = [element.text for element in texts(plot_file(one, "svg"))]
    assert words.count("t, s") == 2
    assert words.count("ω₀ / 2π, Hz, 95 % band") == 2
    assert words.count("amplitude of u [mm]") == 2
    assert "a′/a, 1/s, 95 % band" in words
    assert "u [mm]" in words


def test_why_nothing_is_claimed_stands_above_the_panels() -> None:
    """Three oscillations whose frequencies cross again and again."""
    t, turn = np.arange(600) / 40.0, 2.0 * np.pi
    x = np.cos(turn * (3.0 * t + 0.06 * t**2)) + 0.9 * np.cos(turn * (5.0 * t - 0.06 * t**2))
    x += 0.8 * np.cos(turn * (4.0 * t + 0.5 * np.sin(0.9 * t))) + 0.01 * np.random.default_rng(2).normal(size=t.size)
    found = measure_recordings([Recording(t, x, 40.0, "u", "mm", "run.csv", "0")])
    placed = boxes(plot_file(found, "svg"))
    said = next(box for box in placed if box[0].startswith("Not claimed: "))
    assert 0.0 <= said[2] < said[4] < min(top for words, _, top, _, _ in placed if words == "u [mm]")
    assert {"ω₀ / 2π, Hz, no interval", "ω₀ / 2π, Hz, not claimed"} <= {words for words, *_ in placed}


def test_runs_and_their_common_curve_are_told_apart(several: Measurements) -> None:
    words = [element.text for element in texts(plot_file(several, "svg"))]
    assert words.count("combined") == 2
    assert "first.csv" in words
    assert "second <b>.csv" in words


def test_the_curves_are_the_values(one: Measurements) -> None:
    """The backbone's panel spans the amplitudes measured, and its curve is there in data units."""
    panel = drawn(one).panels[2]
    curve = one.measured[0].backbone
    assert curve is not None
    drawn_lines = [line.get_xydata() for line in panel.get_lines()]
    expected = np.column_stack([curve.curve_amplitude, curve.curve_omega / (2 * np.pi)])
    assert any(line.shape == expected.shape and np.allclose(line, expected) for line in drawn_lines)
    low, high = panel.get_ylim()
    assert low < expected[:, 1].min() < expected[:, 1].max() < high


def test_a_picture_has_the_pages_colours(one: Measurements) -> None:
    picture = plot_file(one, "svg").decode()
    assert "#0f3c6e" in picture.lower()
    ids = re.findall(r' id="([^"]+)"', picture)
    assert len(ids) == len(set(ids))


@pytest.mark.parametrize(("kind", "begins"), [("png", b"\x89PNG\r\n\x1a\n"), ("pdf", b"%PDF-")])
def test_the_other_forms_are_what_they_are_called_and_the_same_each_time(
    kind: str, begins: bytes, one: Measurements
) -> None:
    picture = plot_file(one, kind)
    assert picture.startswith(begins)
    assert picture == plot_file(one, kind)


def test_many_signals_of_long_names_are_still_drawn() -> None:
    runs = [decay(1.0 + 0.05 * i, name="displacement of the third mass " * 4, run=f"run {i}") for i in range(7)]
    picture = plot_file(measure_recordings(runs, method="pseudo-wigner", bias=False), "svg")
    assert max(right for _, _, _, right, _ in boxes(picture)) <= 72 * PAGE.width
    assert any("…" in words for words, *_ in boxes(picture))
    assert any("5 of 7 signals" in words for words, *_ in boxes(picture))
