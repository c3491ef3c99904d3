"""The page as text: the same bytes each time, nothing dropped, nothing smuggled in, nothing fetched."""

from __future__ import annotations

import base64
import dataclasses
import hashlib
import itertools
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from compare.results import Formula, Report
from reports.page import WARN_BYTES, render, size_warning
from reports.sections import sections
from reports.theme import SERIES, TOKENS, variables_css
from tests.reports import synthetic
from tests.reports.markup import Element, parse

SVG = "http://www.w3.org/2000/svg"


@pytest.fixture(scope="module")
def report() -> Report:
    return synthetic.full_report()


@pytest.fixture(scope="module")
def page(report: Report) -> str:
    return render(report)


@pytest.fixture(scope="module")
def tree(page: str) -> Element:
    return parse(page)


# --- the same report, the same bytes


def test_a_second_rendering_has_the_same_bytes(report: Report, page: str) -> None:
    assert render(report) == page


def test_another_process_with_another_hash_seed_has_the_same_bytes() -> None:
    here = hashlib.sha256(render(synthetic.recording_report()).encode()).hexdigest()
    program = (
        "import hashlib\nfrom reports.page import render\nfrom tests.reports import synthetic\n"
        "print(hashlib.sha256(render(synthetic.recording_report()).encode()).hexdigest())"
    )
    root = Path(__file__).parents[2]
    environment = {**os.environ, "PYTHONHASHSEED": "12345", "PYTHONPATH": str(root)}
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=root, env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == here


# --- names from outside are text, wherever they stand

HOSTILE = (
    "<script>alert(1)</script>",
    "]]>--><!--</style></title></svg>",
    '"\'` onload="alert(1)" x=\'',
    ' d="M 1.23456" id="stolen" style="fill: #01fe03" href="#gone" url(#gone)',
    "&lt;b&gt; &amp; &#60;i&#62; {{ 7 * 7 }} {% raw %}",
    r"$5 and \frac{$ and _{$^",
)
# Strings that choose among meanings instead of being shown.
FIXED = {"variable", "kind", "name", "chosen", "symbol", "curves", "time_unit", "csv"}


def _poisoned(value: Any, text: str, key: str = "") -> Any:
    """The same value with ``text`` appended to every string that is shown."""
    if isinstance(value, str):
        return value if key in FIXED else value + text
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = [f.name for f in dataclasses.fields(value)]
        return replace(value, **{f: _poisoned(getattr(value, f), text, _key(value, f)) for f in fields})
    if isinstance(value, Mapping):
        return {name + text: _poisoned(inner, text, key) for name, inner in value.items()}
    if isinstance(value, tuple):
        return tuple(_poisoned(inner, text, key) for inner in value)
    return value


def _key(owner: object, name: str) -> str:
    """``curves`` of a statement are names; of anything else they are curves with labels."""
    return "" if name == "curves" and type(owner).__name__ != "Statement" else name


def _vocabulary(root: Element) -> set[tuple[str, str]]:
    return {(element.tag, name) for element in root.all() for name in ("", *element.attributes)}


@pytest.fixture(scope="module")
def small() -> Report:
    """Everything a page can show, of little size."""
    study = synthetic.make_study(8, (2, 4, 8))
    decay, recording = synthetic.make_decay(), synthetic.make_recording()
    decay = replace(
        decay, curves=decay.curves[::4], statements=tuple(s for s in decay.statements if s.figure in (2, 4, 9))
    )
    return replace(
        synthetic.full_report(),
        study=study,
        ranges=synthetic.make_ranges(study),
        decay=decay,
        recording=recording,
    )


@pytest.fixture(scope="module")
def harmless(small: Report) -> Element:
    return parse(render(small))


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_names_stay_text(small: Report, harmless: Element, text: str) -> None:
    root = parse(render(_poisoned(small, text)))
    formulas = {("code", "")} | {(tag, name) for tag, name in _vocabulary(root) if tag in ("math", "mtext", "mo")}
    assert _vocabulary(root) <= _vocabulary(harmless) | formulas
    assert len(root.all("script")) == len(harmless.all("script"))
    assert len(root.all("svg")) == len(harmless.all("svg"))
    for block in root.all("script")[:-1]:
        json.loads(block.text)
    _shown_unchanged(small, root.all("body")[0], text)


def _shown_unchanged(small: Report, shown: Element, text: str) -> None:
    body = _plain(shown.text)
    labels = [_plain(label.text) for label in shown.all("text")]
    assert any(_plain("reference" + text) == label or _plain("3 × ω₀" + text) == label for label in labels)
    for phrase in (small.title, small.lead, small.summary[0], small.cards[0].value, synthetic.FAILURE):
        assert _plain(phrase + text) in body
    assert small.derivation is not None
    assert _plain(small.derivation.code["C"] + text) in body
    assert [a.attributes["download"] for a in shown.all("a") if "download" in a.attributes] == ["study.csv" + text]


def _plain(text: str) -> str:
    return " ".join(text.split())


def test_letters_that_the_measuring_font_lacks_are_no_obstacle(small: Report) -> None:
    assert "振り子" in render(_poisoned(small, " 振り子"))


HOSTILE_FORMULAS = (
    r"\text{<script>alert(1)</script>}",
    r"\href{javascript:alert(1)}{x}",
    r"x</mi><script>alert(1)</script>",
    "]]>",
    r"\unknowncommand x",
    r"\frac{1}{",
    '"onload="alert(1)',
)


@pytest.mark.parametrize("latex", HOSTILE_FORMULAS)
def test_hostile_formulas_stay_text(latex: str) -> None:
    derivation = replace(synthetic.make_derivation(), formulas=(Formula("f", "u", ("1", latex), python=latex),))
    root = parse(render(replace(synthetic.empty_report(), derivation=derivation)))
    assert len(root.all("script")) == 1
    assert not [e for e in root.all() for name in e.attributes if name.startswith("on")]
    assert not [e for e in root.all("math") for inner in e.all() if "href" in inner.attributes]
    assert any(latex in code.text for code in root.all("code"))


# --- parts that are missing are left out; failures are not


def _keys(report: Report) -> list[str]:
    return [section.key.removeprefix("section-") for section in sections(report)]


def test_every_part_has_its_section(report: Report, tree: Element) -> None:
    wanted = [
        *("backbone", "formula", "error", "map", "tracks", "paper"),
        *("budget", "timing", "code", "data", "provenance"),
    ]
    assert _keys(report) == wanted
    ids = [e.attributes.get("id", "") for e in tree.all("section")]
    assert [key.removeprefix("section-") for key in ids if key.startswith("section-")] == wanted


@pytest.mark.parametrize(
    ("part", "wanted"),
    [
        ({}, []),
        ({"study"}, ["backbone", "error", "map"]),
        ({"decay"}, ["tracks", "paper", "budget"]),
        ({"recording"}, ["recording"]),
        ({"derivation"}, ["formula", "code"]),
        ({"timings"}, ["timing"]),
        ({"csv"}, ["data"]),
    ],
)
def test_missing_parts_are_left_out(small: Report, part: set[str], wanted: list[str]) -> None:
    only = replace(synthetic.empty_report(), **{name: getattr(small, name) for name in part})
    assert _keys(only) == [*wanted, "provenance"]
    parse(render(only))


def test_a_decay_without_models_or_estimates_still_renders() -> None:
    decay = synthetic.make_decay()
    bare = replace(
        decay,
        curves=(),
        scores=(),
        budget=(),
        harmonics=(),
        disagreement=None,
        amplitudes=replace(decay.amplitudes, averaged=None),
        reconstruction=replace(decay.reconstruction, multicomponent=None, rms_multicomponent=None),
        statements=tuple(replace(s, curves=()) for s in decay.statements),
    )
    parse(render(replace(synthetic.empty_report(), decay=bare)))


def test_tracks_that_are_nowhere_valid_still_render() -> None:
    decay = synthetic.make_decay()
    blind = tuple(replace(c, valid=np.zeros(c.time.size, bool)) for c in decay.curves)
    parse(render(replace(synthetic.empty_report(), decay=replace(decay, curves=blind))))


@pytest.mark.parametrize(("count", "orders"), [(2, (2,)), (3, (2, 4)), (40, tuple(range(2, 62, 2)))])
def test_studies_of_any_shape_render(count: int, orders: tuple[int, ...]) -> None:
    study = synthetic.make_study(count, orders)
    for ranges in ((), synthetic.make_ranges(study)):
        parse(render(replace(synthetic.empty_report(), study=study, ranges=ranges)))


def test_an_order_without_values_is_kept_and_marked() -> None:
    study = synthetic.make_study(8, (2, 4, 8))
    error, omega = np.array(study.relative_error), np.array(study.omega)
    error[1], omega[1] = np.nan, np.nan
    holed = replace(study, relative_error=error, omega=omega)
    root = parse(render(replace(synthetic.empty_report(), study=holed)))
    drawn = next(figure for figure in root.all("figure") if figure.attributes["id"] == "map")
    assert "not available" in drawn.text


def test_a_failed_method_keeps_its_row_and_says_why(tree: Element) -> None:
    (table,) = (table for table in tree.all("table") if table.attributes["id"] == "methods")
    rows = table.all("tr")
    failed = next(i for i, row in enumerate(rows) if row.attributes.get("class") == "failed")
    assert "Hilbert phase" in rows[failed].text
    assert f"Failed: {synthetic.FAILURE}" in rows[failed + 1].text


def test_every_number_of_a_table_stands_under_its_head(tree: Element) -> None:
    for table in tree.all("table"):
        head = [cell.text for cell in table.all("thead")[0].all("th")]
        for row in table.all("tbody")[0].all("tr"):
            if row.attributes.get("class") != "remark":
                assert [cell.attributes["data-name"] for cell in row.all("td")] == head[1:]


def test_a_recording_shows_tracks_backbone_damping_and_fit() -> None:
    recording = synthetic.recording_report()
    root = parse(render(recording))
    assert _keys(recording) == ["recording", "provenance"]
    text = root.text
    for wanted in ("decay.csv", "displacement_percent", "pseudo-Wigner, 8 s", "The longest window"):
        assert wanted in text
    assert len(root.all("figure")) >= 4
    assert len(root.all("math")) == 3


# --- nothing leaves the file


def test_the_page_refers_to_nothing_outside(page: str, tree: Element) -> None:
    assert set(re.findall(r"https?:[^\s\"'<>)]*", page)) <= {SVG}
    names = ("src", "href", "xlink:href", "action", "data", "poster", "srcset")
    targets = [e.attributes[name] for e in tree.all() for name in names if name in e.attributes]
    assert targets
    assert all(target.startswith(("#", "data:")) for target in targets)
    assert "@import" not in page
    assert not tree.all("link")


def test_the_policy_admits_the_one_script_and_nothing_from_a_network(tree: Element) -> None:
    (policy,) = (
        e.attributes["content"]
        for e in tree.all("meta")
        if e.attributes.get("http-equiv", "").lower() == "content-security-policy"
    )
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    (script,) = (e for e in tree.all("script") if "type" not in e.attributes)
    digest = base64.b64encode(hashlib.sha256(script.text.encode()).digest()).decode()
    assert rules["default-src"] == "'none'"
    assert rules["script-src"] == f"'sha256-{digest}'"
    assert rules["img-src"] == "data:"
    assert rules["base-uri"] == rules["form-action"] == "'none'"
    assert "http" not in policy


def test_ids_are_unique_and_references_resolve(page: str, tree: Element) -> None:
    ids = [e.attributes["id"] for e in tree.all() if "id" in e.attributes]
    assert len(ids) == len(set(ids))
    used = set(re.findall(r"url\(#([^)]+)\)", page)) | {
        name
        for e in tree.all()
        for name in (*e.attributes.get("aria-labelledby", "").split(), e.attributes.get("href", "")[1:])
        if name and not e.attributes.get("href", "#").startswith("data:")
    }
    assert used
    assert used <= set(ids)


# --- figures and formulas


def _svgs(page: str) -> Iterator[ET.Element]:
    for text in re.findall(r"<svg\b.*?</svg>", page, flags=re.DOTALL):
        yield ET.fromstring(text)  # noqa: S314


def test_every_drawing_is_sound_xml_with_a_name_and_a_description(page: str) -> None:
    drawings = [svg for svg in _svgs(page) if svg.get("class") != "store"]
    assert len(drawings) == 2 * page.count("<figure ")
    for svg in drawings:
        assert svg.get("role") == "img"
        named = {e.get("id"): e.text for e in svg.iter() if e.tag in ("title", "desc")}
        assert all(named[key] for key in (svg.get("aria-labelledby") or "").split())


def test_colours_are_variables_that_the_style_declares(page: str) -> None:
    assert "#01fe" not in page
    declared = set(re.findall(r"--([a-z0-9]+):", variables_css()))
    assert set(re.findall(r"var\(--([a-z0-9]+)\)", page)) <= declared == set(TOKENS)
    for svg in _svgs(page):
        for element in svg.iter():
            colours = re.findall(r"(?:fill|stroke):\s*([^;]+)", element.get("style", ""))
            assert all(colour.startswith(("var(", "none", "url(")) for colour in colours), element.attrib


MATHML = frozenset(
    [
        *("math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup"),
        *("mover", "munder", "munderover", "mstyle", "mtable", "mtr", "mtd", "mpadded", "mphantom"),
    ]
)


def test_every_formula_is_sound_mathml(page: str, report: Report) -> None:
    assert report.derivation is not None
    found = re.findall(r"<math\b.*?</math>", page, flags=re.DOTALL)
    assert len(found) == 1 + sum(1 + len(formula.terms) for formula in report.derivation.formulas)
    for text in found:
        root = ET.fromstring(text)  # noqa: S314
        assert {element.tag for element in root.iter()} <= MATHML
        assert "\\" not in "".join(root.itertext())


def test_the_readout_knows_where_the_curves_are(page: str) -> None:
    """The first and last point of each curve, by the axes that the script is given, lie on the drawn path."""
    root = parse(page)
    figure = next(f for f in root.all("figure") if f.attributes["id"] == "backbone")
    data = json.loads(figure.all("script")[0].text)
    for variant in ("wide", "narrow"):
        (svg,) = (s for s in figure.all("svg") if s.attributes.get("class") == variant)
        for series in data["series"]:
            paths = [g.all("path")[0] for g in svg.all("g") if g.attributes.get("class") == series["c"] != ""]
            if paths:
                x, y = _path_start(paths[0].attributes["d"])
                ax, ay = _pixel(data["axes"][variant][0], data["xs"][series["x"]][0], series["y"][0])
                assert (x, y) == (pytest.approx(ax, abs=0.1), pytest.approx(ay, abs=0.1))


def _path_start(path: str) -> tuple[float, float]:
    x, y = re.findall(r"-?\d+(?:\.\d+)?", path)[:2]
    return float(x), float(y)


def _pixel(axes: dict[str, Any], x: float, y: float) -> tuple[float, float]:
    left, top, right, bottom = axes["box"]
    (x0, x1), (y0, y1) = axes["x"], axes["y"]
    return left + (right - left) * (x - x0) / (x1 - x0), bottom - (bottom - top) * (y - y0) / (y1 - y0)


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
        *((series, "bg") for series in SERIES),
    ],
)
def test_text_meets_wcag_aa(theme: int, text: str, ground: str) -> None:
    assert _contrast(TOKENS[text][theme], TOKENS[ground][theme]) >= 4.5


@pytest.mark.parametrize("theme", [0, 1])
def test_bands_grow_from_the_page_towards_the_ink(theme: int) -> None:
    steps = [_contrast(TOKENS[f"b{i}"][theme], TOKENS["bg"][theme]) for i in range(6)]
    assert steps == sorted(steps)
    assert all(later > 1.15 * earlier for earlier, later in itertools.pairwise(steps))


# --- weight


def test_a_nearly_empty_page_is_light() -> None:
    assert len(render(synthetic.empty_report()).encode()) <= 60_000


def test_a_full_page_keeps_its_budget(page: str) -> None:
    assert len(page.encode()) <= 1_000_000
    assert size_warning(page) is None


def test_a_heavy_page_is_warned_of_in_bytes_not_letters() -> None:
    assert size_warning("x" * WARN_BYTES) is None
    assert "2.0 MB" in str(size_warning("x" * (WARN_BYTES + 1)))
    assert size_warning("θ" * (WARN_BYTES // 2)) is None
    assert size_warning("θ" * (WARN_BYTES // 2 + 1)) is not None
