"""Figures, formulas and colours of the page: sound markup, nothing lost in setting, legible in both themes."""

from __future__ import annotations

import itertools
import json
import re
from xml.etree import ElementTree as ET

import pytest

from ridgeback.compare.report.results import Report
from ridgeback.compare.study.derivation import derivation
from ridgeback.compare.study.derived import derive
from ridgeback.compare.study.results import Formula
from ridgeback.reports.drawing.theme import SERIES, TOKENS, variables_css
from ridgeback.reports.text.mathml import formula_latex, formula_mathml
from ridgeback.symbolic.systems.catalogue import catalogue
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.reports.markup import parse

CLASSICAL = 12  # of the catalogue: the classical oscillators and their damped twins


def test_every_drawing_is_sound_xml_with_a_name_and_a_description(full_page: str) -> None:
    drawings = [
        svg for figure in parse(full_page).all("figure") for svg in figure.all("svg") if "role" in svg.attributes
    ]
    assert len(drawings) >= full_page.count("<figure ")
    for svg in drawings:
        assert svg.attributes["role"] == "img"
        assert len(svg.attributes["aria-label"]) > 5


def test_colours_are_variables_that_the_style_declares(full_page: str) -> None:
    assert "#01fe" not in full_page
    declared = set(re.findall(r"--([A-Za-z0-9]+):", variables_css()))
    assert declared == set(TOKENS)
    assert set(re.findall(r"var\(--([A-Za-z0-9]+)\)", full_page)) <= {*declared, "c"}
    for svg in parse(full_page).all("svg"):
        for element in svg.all():
            fixed = [element.attributes.get(name, "none") for name in ("fill", "stroke", "color")]
            assert all(colour.startswith(("none", "url(#")) for colour in fixed), element.attributes
            colours = re.findall(r"(?:fill|stroke|color):\s*([^;]+)", element.attributes.get("style", ""))
            assert all(colour.startswith(("var(", "none", "url(")) for colour in colours), element.attributes


MATHML = frozenset(
    [
        *("math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup"),
        *("mover", "munder", "munderover", "mstyle", "mtable", "mtr", "mtd", "mpadded", "mphantom"),
    ]
)


@pytest.mark.parametrize("oscillator", catalogue()[:CLASSICAL], ids=lambda o: o.name)
def test_equations_and_derived_formulas_lose_nothing(oscillator: Oscillator) -> None:
    """All that the catalogue can print becomes sound MathML with every number of its LaTeX, in order."""
    exact = derive(oscillator, 4, flow_order=2)
    formulas = (*derivation(exact).formulas, Formula("equation", "", (oscillator.equation_latex,)))
    for formula in formulas:
        latex = re.sub(r"\\[a-zA-Z]+", " ", formula_latex(formula))
        text = "".join(" ".join(ET.fromstring(math).itertext()) for math in formula_mathml(formula))  # noqa: S314
        assert "\\" not in text
        assert re.findall(r"\d+", text) == re.findall(r"\d+", latex)


def test_every_formula_is_sound_mathml(full_page: str, full: Report) -> None:
    assert full.derivation is not None
    found = re.findall(r"<math\b.*?</math>", full_page, flags=re.DOTALL)
    table = full.derivation.harmonics
    assert table is not None
    cells = len(table.powers) + sum(1 + len([cell for cell in row.cells if cell]) for row in table.rows)
    assert len(found) == 1 + cells + sum(1 + len(formula.terms) for formula in full.derivation.formulas)
    for text in found:
        root = ET.fromstring(text)  # noqa: S314
        assert {element.tag for element in root.iter()} <= MATHML
        assert "\\" not in "".join(root.itertext())


@pytest.mark.parametrize("variant", ["wide", "narrow"])
def test_the_readout_knows_where_the_curves_are(full_page: str, variant: str) -> None:
    """The first point of the signal, by the axes that the script is given, is where its path begins."""
    figure = next(f for f in parse(full_page).all("figure") if f.attributes["id"] == "motion")
    data = json.loads(figure.all("script")[0].text)
    (svg,) = (s for s in figure.all("svg") if s.attributes.get("class") == variant)
    path = next(p for p in svg.all("path") if p.attributes.get("class") == "ul nf")
    x, y = (float(v) for v in re.findall(r"-?\d+(?:\.\d+)?", path.attributes["d"])[:2])
    left, top, right, bottom, low, high, below, above = data["boxes"][variant == "narrow"][0]
    name, _, values = data["series"][0]
    assert name == "θ"
    expected = left + (right - left) * (data["at"][0] - low) / (high - low)
    assert (x, y) == pytest.approx(
        (expected, bottom - (bottom - top) * (values[0] - below) / (above - below)), abs=0.11
    )


# --- colours that can be read


def _contrast(first: str, second: str) -> float:
    """WCAG 2.1, relative luminance and contrast ratio, written out apart from the theme's own."""

    def luminance(colour: str) -> float:
        red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
        channel = [v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in (red, green, blue)]
        return 0.2126 * channel[0] + 0.7152 * channel[1] + 0.0722 * channel[2]

    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_has_the_published_values() -> None:
    """#767676 is the lightest grey that passes AA on white, #777777 the first that does not."""
    assert _contrast("#767676", "#FFFFFF") >= 4.5 > _contrast("#777777", "#FFFFFF")


@pytest.mark.parametrize("theme", [0, 1])
@pytest.mark.parametrize(
    ("text", "ground"),
    [
        *((text, ground) for text in ("fg", "muted", "link") for ground in ("bg", "card")),
        *((series, "bg") for series in (*SERIES, "E", "S", "T")),
        *((series, "card") for series in ("E", "S", "T")),
        *((text, "shade") for text in ("fg", "muted", "T")),
    ],
)
def test_text_meets_wcag_aa(theme: int, text: str, ground: str) -> None:
    assert _contrast(TOKENS[text][theme], TOKENS[ground][theme]) >= 4.5


@pytest.mark.parametrize("theme", [0, 1])
def test_bands_grow_from_the_page_towards_the_ink(theme: int) -> None:
    steps = [_contrast(TOKENS[f"b{i}"][theme], TOKENS["bg"][theme]) for i in range(6)]
    assert steps == sorted(steps)
    assert all(later > 1.15 * earlier for earlier, later in itertools.pairwise(steps))
