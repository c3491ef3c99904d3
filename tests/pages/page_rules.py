"""The rules of a page, one a test: a module of tests says for which kinds of page."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.pages.look import Look

WIDTHS = pytest.mark.parametrize("width", [1280, 400])
MOST = {1280: 7500, 400: 10_500}
"""Height of a page with its details folded, px."""
LEAST = {1280: 12.0, 400: 9.0}
"""Size of a label in a figure, px."""


def size(cell: str) -> float | None:
    """The size of the number that a cell begins with; None where it holds none."""
    text = cell.replace("\u2007", "").replace("\u2008", "").replace("−", "-").strip().removeprefix("≤ ").strip()
    found = re.match(r"([+-]?[\d.]+)(?: ± [\d.]+)?(?: × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?(?: (%|ns|µs|ms|s))?(?: |$|\()", text)
    if found is None:
        return None
    power = int((found[2] or "0").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))
    unit = {"%": 1e-2, "ns": 1e-9, "µs": 1e-6, "ms": 1e-3}.get(found[3] or "", 1.0)
    return abs(float(found[1])) * 10.0**power * unit


def assert_rectangular(name: str, text: str) -> None:
    """Rows of one length; a figure of two planes holds two tables, one below the other."""
    rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    assert len(rows) > 1, name
    assert len({len(row) for row in rows}) <= (2 if "plane" in name else 1), name


def contrast(ink: list[float], ground: list[float]) -> float:
    """WCAG 2.1, relative luminance and contrast ratio."""

    def luminance(colour: list[float]) -> float:
        channels = [v / 255 for v in colour[:3]]
        red, green, blue = (v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in channels)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted((luminance(ink), luminance(ground)))
    return (high + 0.05) / (low + 0.05)


class PageRules:
    """What is seen of a page, and what is done with it."""

    def test_nothing_is_said_on_the_console_and_nothing_is_fetched(self, look: Look, kind: str) -> None:
        seen = look(kind)
        assert seen["complaints"] == []
        assert seen["requests"] == [seen["page"]]

    @WIDTHS
    def test_nothing_is_beyond_the_width(self, look: Look, kind: str, width: int) -> None:
        seen = look(kind)[str(width)]
        assert seen["beyond"] == []
        assert seen["across"] <= width

    @WIDTHS
    def test_a_page_is_no_longer_than_it_may_be(self, look: Look, kind: str, width: int) -> None:
        assert 900 < look(kind)[str(width)]["height"] <= MOST[width]

    @WIDTHS
    def test_no_label_covers_another(self, look: Look, kind: str, width: int) -> None:
        assert look(kind)[str(width)]["overlaps"] == []

    @WIDTHS
    def test_labels_are_large_enough_and_inside(self, look: Look, kind: str, width: int) -> None:
        labels = look(kind)[str(width)]["texts"]
        assert len(labels) > 10
        assert [label for label in labels if label[2] < LEAST[width]] == []
        assert [label for label in labels if label[3] > 4.0] == []

    @WIDTHS
    def test_no_drawing_and_no_panel_is_empty(self, look: Look, kind: str, width: int) -> None:
        assert look(kind)[str(width)]["empty"] == []

    @WIDTHS
    def test_mathematics_is_large_enough(self, look: Look, kind: str, width: int) -> None:
        found = look(kind)[str(width)]["mathematics"]
        assert found or kind in ("runs", "study")
        assert [one for one in found if one[1] < 12.0] == []

    @WIDTHS
    def test_text_meets_wcag_aa(self, look: Look, kind: str, width: int) -> None:
        pairs = look(kind)[str(width)]["colours"]
        assert len(pairs) >= 4
        assert [pair for pair in pairs if contrast(pair[1], pair[2]) < 4.5] == []

    def test_a_page_without_scripts_is_complete(self, look: Look, kind: str) -> None:
        """Whatever a reader with scripts is shown, figures too, and no button that would do nothing."""
        seen = look(kind)
        assert len(seen["shown"]) > 40
        assert [text for text in seen["shown"] if text not in set(seen["without scripts"])] == []
        assert seen["drawn without scripts"] == [figure["drawn"] for figure in seen["figures"]]
        assert seen["buttons without scripts"] == 0

    def test_every_figure_is_read_by_keys_and_pointer(self, look: Look, kind: str) -> None:
        figures = look(kind)["figures"]
        assert figures
        for figure in figures:
            assert figure["named"], figure["id"]
            assert figure["caption"] > 20, figure["id"]
            assert figure["keyboard"], figure["id"]
            assert all(re.search(r"\d", said or "") for said in (*figure["keys"][:3], figure["pointed"])), figure
            assert figure["keys"][0] != figure["keys"][1], figure
            assert figure["keys"][3] == "", figure["id"]
            assert figure["still"], figure["id"]

    def test_check_boxes_hide_their_series_and_show_them_again(self, look: Look, kind: str) -> None:
        toggles = look(kind)["toggles"]
        assert toggles
        for name, before, without, after in toggles:
            assert before > 0, name
            assert without == 0, name
            assert after == before, name

    def test_columns_sort_by_size_both_ways(self, look: Look, kind: str) -> None:
        """Numbers by their size whatever their unit, what is none last; up, then down."""
        columns = look(kind)["sorted"]
        assert len(columns) > 2
        for name, announced, up, down in columns:
            assert announced == "ascending", name
            assert sorted(up) == sorted(down), name
            sizes = [[size(cell) for cell in cells] for cells in (up, down)]
            numbers = [[v for v in column if v is not None] for column in sizes]
            if numbers[0]:
                assert numbers[0] == sorted(numbers[0]), name
                assert numbers[1] == sorted(numbers[1], reverse=True), name
                assert sizes[0][: len(numbers[0])] == numbers[0], f"{name}: what is no number stands last"
                assert sizes[1][: len(numbers[1])] == numbers[1], f"{name}: what is no number stands last"
            else:
                assert up == sorted(up, key=str.casefold), name

    def test_figures_and_data_are_saved(self, look: Look, kind: str) -> None:
        """Each drawing as an SVG that needs no style sheet, one as a picture, each table as rows of one length."""
        saved, files = look(kind)["saved"]
        assert {Path(name).suffix for name, _ in saved} == {".svg", ".png", ".csv"}
        for name, address in saved:
            kind_of, _, text = address.partition(",")
            match Path(name).suffix:
                case ".svg":
                    assert ElementTree.fromstring(text).tag.endswith("svg"), name  # noqa: S314
                    assert "var(--" not in text, name
                case ".png":
                    assert kind_of == "data:image/png;base64"
                    assert len(text) > 5000
                case ".csv":
                    assert_rectangular(name, text)
        assert files
        for name, address in files:
            assert_rectangular(name, address.partition(",")[2])

    def test_what_is_not_the_pages_own_is_refused(self, look: Look, kind: str) -> None:
        """The content-security policy, as the browser applies it: a script put into the page does not run."""
        assert look(kind)["smuggled"] == [False, ["img-src", "script-src-elem"]]
