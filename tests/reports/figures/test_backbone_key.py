"""The key of a backbone stands where the fewest curves go, and says no interval where none is claimed."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.reports.figures.recording import Band, side_by_side


def key_of(y: np.ndarray, sd: float) -> tuple[float, str]:
    """Height of the key's first line, from the top, and the text of the figure."""
    x = np.linspace(0.1, 1.0, 40)
    band = Band("omega", x, y, np.full(40, sd), (("another class", y + 1e-3, "el nf"),))
    words = {"key": "k", "x_title": "a", "caption": "c", "label": "l"}
    wide = side_by_side(bands=(band, band), **words).wide
    first = wide[wide.index("measured") - 200 : wide.index("measured")]
    return float(first.split('y="')[-1].split('"')[0]), wide


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_the_key_keeps_clear_of_a_curve_that_fills_half_of_the_panel(way: float) -> None:
    x = np.linspace(0.1, 1.0, 40)
    y = 2.0 + way * np.where(x < 0.9, 0.9 + 0.1 * np.sin(60.0 * x), 0.0)
    top, _ = key_of(y, 1e-3)
    assert top - 14.0 > 95.0 if way > 0.0 else top + 34.0 < 255.0


def test_a_band_that_is_not_claimed_is_not_in_the_key() -> None:
    y = np.linspace(2.0, 3.0, 40)
    assert "measured, 95 %" in key_of(y, 1e-3)[1]
    assert "95 %" not in key_of(y, 0.0)[1]
