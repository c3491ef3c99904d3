"""Ticks are round, within their range and told apart; ranges of nothing and of one value have a width."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ridgeback.reports.drawing.canvas import Canvas, linear
from ridgeback.reports.drawing.cells import edges
from ridgeback.reports.drawing.marks import area
from ridgeback.reports.drawing.scale import padded, round_values, tick_labels
from ridgeback.reports.drawing.theme import Variant

SIZES = st.floats(-12.0, 12.0).map(lambda power: 10.0**power)


@given(st.floats(-1e9, 1e9), SIZES, st.integers(1, 12))
def test_round_values_lie_within_and_are_never_too_many(low: float, span: float, most: int) -> None:
    ticks = round_values(low, low + span, most)
    assert len(ticks) <= most or not low + span > low
    assert list(ticks) == sorted(ticks)
    assert all(
        low - 1e-6 * span - 1e-3 * abs(low) * 1e-8 <= tick <= low + 1.000001 * span + 1e-11 * abs(low) for tick in ticks
    )


@pytest.mark.parametrize(
    ("ticks", "labels"),
    [
        ([0.0, 2e-4, 4e-4], ["0", "0.0002", "0.0004"]),
        ([1e6, 2e6], ["1e+06", "2e+06"]),
        ([1_700_000_000.0, 1_700_000_050.0], ["1.70000000e+09", "1.70000005e+09"]),
        ([-2e6, 0.0], ["\u22122e+06", "0"]),
    ],
)
def test_labels_of_large_and_small_numbers_are_told_apart(ticks: list[float], labels: list[str]) -> None:
    """As they were not: seconds since 1970 all read 1.7e+09."""
    assert len(set(tick_labels(ticks))) == len(ticks)
    assert [float(label.replace("\u2212", "-")) for label in tick_labels(ticks)] == [
        float(x.replace("\u2212", "-")) for x in labels
    ]


@given(st.floats(-1e12, 1e12), st.sampled_from([1e-3, 0.25, 1.0, 50.0, 1e6]))
def test_ticks_of_any_size_have_labels_of_their_own(start: float, step: float) -> None:
    ticks = [round(start / step) * step + n * step for n in range(5)]
    labels = tick_labels(ticks)
    assert len(set(labels)) == len(set(ticks)) or max(map(abs, ticks)) < 1e6


def test_a_range_of_nothing_or_of_one_value_has_a_width() -> None:
    assert padded([]) == padded([np.array([np.nan, np.inf])]) == (0.0, 1.0)
    low, high = padded([np.array([3.0])])
    assert low < 3.0 < high
    assert round_values(2.0, 2.0, 5) == (2.0,)
    assert edges(np.array([2.0])).tolist() == [1.5, 2.5]


def test_an_area_is_drawn_in_the_pieces_that_have_a_width() -> None:
    x = np.arange(6.0)
    low = np.array([0.0, 0.0, np.nan, 0.0, np.nan, np.nan])
    assert area(x, low, low + 1.0, "b").count("M") == area(x[:2], low[:2], low[:2] + 1.0, "b").count("M") == 1


def test_ticks_of_a_narrow_range_are_told_apart() -> None:
    """Far from zero each label has the digits that differ; a power of ten that all share stands beside the axis."""
    axes = Canvas(Variant("wide", 4.0, 3.0)).stack()[0]
    linear(axes, "y", 0.949975, 0.950032)
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert len(set(names)) == len(names) >= 4
    linear(axes, "y", 1.73607e-5, 1.73614e-5)
    assert all(label.get_text().startswith("1.736") for label in axes.get_yticklabels())
    assert [text.get_text() for text in axes.texts] == ["× 10⁻⁵"]
