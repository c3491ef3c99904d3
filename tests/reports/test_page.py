"""The page as text: the same bytes each time, nothing dropped, nothing smuggled in, nothing fetched."""

from __future__ import annotations

import base64
import hashlib
import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from ridgeback.compare.report.results import Report
from ridgeback.compare.study.results import Formula, Range
from ridgeback.reports.figures.order_map import order_map
from ridgeback.reports.page import WARN_BYTES, html_page, size_warning
from tests.reports import synthetic
from tests.reports.markup import Element, parse
from tests.reports.synthetic_motion import FAILURE

SVG = "http://www.w3.org/2000/svg"


@pytest.fixture(scope="module")
def tree(full_page: str) -> Element:
    return parse(full_page)


# --- the same report, the same bytes


def test_a_report_made_again_gives_the_same_bytes(full_page: str) -> None:
    assert html_page(synthetic.full_report()) == full_page


def test_another_process_with_another_hash_seed_gives_the_same_bytes(recording_page: str) -> None:
    program = (
        "import sys\nfrom ridgeback.reports.page import html_page\nfrom tests.reports import synthetic\n"
        "sys.stdout.buffer.write(html_page(synthetic.recording_report()).encode())"
    )
    root = Path(__file__).parents[2]
    environment = {**os.environ, "PYTHONHASHSEED": "12345", "PYTHONPATH": str(root)}
    done = subprocess.run([sys.executable, "-c", program], cwd=root, env=environment, capture_output=True, check=True)
    assert done.stdout == recording_page.encode()


# --- names from outside are text, wherever they stand

HOSTILE = (
    "<script>alert(1)</script> ]]>--><!--</style></title></svg>",
    '"\'` onload="alert(1)" x=\' d="M 1.23456" id="stolen" style="fill: #01fe03" href="#gone" url(#gone)',
    r"&lt;b&gt; &#60;i&#62; {{ 7 * 7 }} {% raw %} $5 and \frac{$ and _{$^ 振り子",
)


def _vocabulary(root: Element) -> set[tuple[str, str]]:
    return {(element.tag, name) for element in root.all() for name in ("", *element.attributes)}


@pytest.fixture(scope="module")
def small() -> Report:
    return synthetic.small_report()


@pytest.fixture(scope="module")
def harmless(small: Report) -> Element:
    return parse(html_page(small))


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_names_stay_text(small: Report, harmless: Element, text: str) -> None:
    root = parse(html_page(synthetic.poisoned(small, text)))
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
    assert _plain("closed form (agm)" + text) in labels or any(_plain(text) in label for label in labels)
    assert small.described is not None
    for phrase in (small.title, small.lead, small.summary[0], small.cards[0].value, small.described.given):
        assert _plain(phrase + text) in body
    assert small.derivation is not None
    assert _plain(small.derivation.code["C"] + text) in body
    assert [a.attributes["download"] for a in shown.all("a") if "download" in a.attributes] == ["study.csv" + text]


def _plain(text: str) -> str:
    return " ".join(text.split())


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
    root = parse(html_page(replace(synthetic.empty_report(), derivation=derivation)))
    assert len(root.all("script")) == 1
    assert not [e for e in root.all() for name in e.attributes if name.startswith("on")]
    assert not [e for e in root.all("math") for inner in e.all() if "href" in inner.attributes]
    assert not any("\\" in math.text for math in root.all("math"))
    copied = [button.attributes.get("data-copy", "") for button in root.all("button")]
    assert any(latex in text for text in (*copied, *(code.text for code in root.all("code"))))


# --- parts that are missing are left out; failures are not


def _keys(root: Element) -> list[str]:
    ids = [section.attributes.get("id", "") for section in root.all("section")]
    return [key.removeprefix("section-") for key in ids if key.startswith("section-")]


def test_every_part_has_its_section(tree: Element) -> None:
    assert _keys(tree) == [
        *("time", "order", "expansion", "motion", "paper", "noise", "errors", "code", "data", "provenance"),
    ]
    names = [link.attributes["href"] for link in tree.all("nav")[0].all("a")]
    assert names == ["#top", *(f"#section-{key}" for key in _keys(tree))]


@pytest.mark.parametrize(
    ("part", "wanted"),
    [
        ({}, []),
        ({"study"}, []),
        ({"study", "grid", "finding"}, ["order"]),
        ({"decay"}, ["motion", "errors"]),
        ({"decay", "benchmark"}, ["time", "motion", "errors"]),
        ({"decay", "paper"}, ["motion", "paper", "errors"]),
        ({"recording"}, ["record", "tracks", "recording"]),
        ({"derivation"}, ["expansion", "code"]),
        ({"noise"}, ["noise"]),
        ({"identification"}, ["identification", "fit", "forecast"]),
        ({"csv"}, ["data"]),
    ],
)
def test_missing_parts_are_left_out(small: Report, part: set[str], wanted: list[str]) -> None:
    only = replace(synthetic.empty_report(), **{name: getattr(small, name) for name in part})
    assert _keys(parse(html_page(only))) == [*wanted, "provenance"]


def test_the_papers_sentences_stand_only_in_the_papers_case(full: Report) -> None:
    assert full.decay is not None
    said = full.decay.statements[0].paper
    assert said in parse(html_page(full)).text
    other = parse(html_page(replace(full, paper=False))).text
    assert said not in other
    assert "The paper, claim by claim" not in other


def test_a_decay_without_models_or_estimates_still_renders() -> None:
    decay = synthetic.make_decay()
    bare = replace(
        decay,
        curves=(),
        scores=(),
        budget=(),
        harmonics=(),
        integrators=(),
        amplitudes=replace(decay.amplitudes, averaged=None),
        reconstruction=replace(decay.reconstruction, multicomponent=None, rms_multicomponent=None),
        statements=tuple(replace(s, curves=()) for s in decay.statements),
    )
    parse(html_page(replace(synthetic.empty_report(), decay=bare)))


def test_tracks_that_are_nowhere_valid_still_render() -> None:
    decay = synthetic.make_decay()
    blind = tuple(replace(c, valid=np.zeros(c.time.size, bool)) for c in decay.curves)
    parse(html_page(replace(synthetic.empty_report(), decay=replace(decay, curves=blind))))


@pytest.mark.parametrize(("count", "orders"), [(2, (2,)), (3, (2, 4)), (40, tuple(range(2, 62, 2)))])
def test_studies_of_any_shape_render(count: int, orders: tuple[int, ...]) -> None:
    study = synthetic.make_study(count, orders)
    ranges = synthetic.make_ranges(study)
    for grid in (synthetic.make_grid(study), replace(synthetic.make_grid(study), observed=(), certified=False)):
        shown = replace(synthetic.empty_report(), study=study, ranges=ranges, grid=grid, finding=ranges[0])
        assert len(parse(html_page(shown)).all("figure")) == 1


def test_an_order_without_values_is_kept_and_marked() -> None:
    """Its row of cells is drawn in the colour of what is left out, and the sliders are told that nothing is known."""
    study = synthetic.make_study(8, (2, 4, 8))
    error, omega = np.array(study.relative_error), np.array(study.omega)
    error[1], omega[1] = np.nan, np.nan
    holed = replace(study, relative_error=error, omega=omega)
    ranges = synthetic.make_ranges(study)
    shown = replace(
        synthetic.empty_report(), study=holed, ranges=ranges, grid=synthetic.make_grid(holed), finding=ranges[0]
    )
    (figure,) = parse(html_page(shown)).all("figure")
    assert json.loads(figure.all("script")[0].text)["bounds"][1] == [None] * 8
    assert [p for p in figure.all("path") if p.attributes.get("class") == "band"]


def test_a_bound_is_never_printed_smaller_than_it_is() -> None:
    grid = synthetic.make_grid(synthetic.make_study(8, (2, 4, 8)))
    drawn = order_map(synthetic.make_study(8, (2, 4, 8)), grid, Range(4, 1e-3, 1.0), None)
    printed = np.array(drawn.data["bounds"], dtype=float)
    assert (printed >= grid.bounds).all()
    assert (printed <= 1.011 * grid.bounds).all()


def test_a_refused_contender_keeps_its_row_and_says_why(tree: Element) -> None:
    (table,) = (table for table in tree.all("table") if table.attributes.get("id") == "contenders")
    rows = table.all("tr")
    failed = next(i for i, row in enumerate(rows) if row.attributes.get("class") == "failed")
    assert "Hilbert phase" in rows[failed].text
    assert f"Refused: {FAILURE}" in rows[failed + 1].text


def test_a_page_without_times_shows_none(full: Report) -> None:
    """The first figure then ranks errors alone, and the table has no column of costs."""
    assert full.benchmark is not None
    rows = tuple(replace(r, time_ns_per_value=None, time_s_per_track=None) for r in full.benchmark.contenders)
    root = parse(html_page(replace(full, benchmark=replace(full.benchmark, contenders=rows))))
    (drawn,) = (figure for figure in root.all("figure") if figure.attributes["id"] == "accuracy-cost")
    assert "cost" not in drawn.text.replace(drawn.all("figcaption")[0].text, "")
    (table,) = (table for table in root.all("table") if table.attributes.get("id") == "contenders")
    assert "a track" not in table.text


def test_every_number_of_a_table_stands_under_its_head(tree: Element) -> None:
    for table in (table for table in tree.all("table") if "id" in table.attributes):
        head = [cell.text for cell in table.all("thead")[0].all("th")]
        for row in table.all("tbody")[0].all("tr"):
            if row.attributes.get("class") != "remark":
                assert [cell.attributes["data-name"] for cell in row.all("td")] == head[1:]


def test_a_recording_shows_tracks_backbone_damping_and_fit(recording_page: str) -> None:
    root = parse(recording_page)
    assert _keys(root) == ["identification", "fit", "forecast", "record", "tracks", "recording", "provenance"]
    for wanted in ("displacement_percent", "pseudo-Wigner, 8 s", "The longest window"):
        assert wanted in root.text
    ids = [figure.attributes["id"] for figure in root.all("figure")]
    drawn = [name.removeprefix("recording-") for name in ids if name.startswith("recording-")]
    assert drawn == ["backbone", "signal", "plane", "tracks"]
    assert len(root.all("math")) == 5


def _cells(root: Element, table: str) -> list[list[str]]:
    (found,) = (t for t in root.all("table") if t.attributes.get("id") == table)
    rows = found.all("tbody")[0].all("tr")
    return [[re.sub("[\u2007\u2008]", "", cell.text) for cell in row.all("th") + row.all("td")] for row in rows]


def test_an_identification_shows_its_ranking_parameters_and_prediction(recording_page: str) -> None:
    root = parse(recording_page)
    ranked = _cells(root, "candidates")
    assert [row[0] for row in ranked] == [
        "Duffing, softening, linear + quadratic damping",
        "pendulum-like, linear + quadratic damping",
        "bilinear: no switch in reach",
    ]
    assert ranked[0][1:3] == ["0", "90.0 %"]
    assert _cells(root, "parameters")[0][:3] == ["k, natural frequency, in rad/s", "7.8500", "7.8461 to 7.8539"]
    ids = {figure.attributes["id"] for figure in root.all("figure")}
    assert ids >= {"identify-backbone", "forecast", "sample-fit", "residual-spectrum"}
    assert "at 2 times the fundamental: a harmonic that the class does not give" in root.text


def test_an_identification_without_a_prediction_still_renders() -> None:
    found = replace(synthetic.make_identification(), prediction=None, failed=(), notes=())
    root = parse(html_page(replace(synthetic.empty_report(), identification=found)))
    assert not [f for f in root.all("figure") if f.attributes["id"] == "forecast"]


def test_a_noise_study_shows_each_cell_with_its_uncertainty_and_the_refusals(tree: Element) -> None:
    rows = _cells(tree, "noise-table")
    assert rows[0][0] == "Harmonic least squares"
    assert [cell.partition(" (")[0] for cell in rows[0][1:]] == ["2.1 %", "0.66 %", "0.21 %", "0.066 %", "0.021 %"]
    assert rows[0][1] == "2.1 % (1.050 ± 0.050)"
    assert rows[-2] == ["Wigner peak", *("–",) * 5]
    assert "12 of 12 trials refused: the record is too short" in rows[-1][0]


def test_a_recording_without_a_backbone_still_renders() -> None:
    recording = synthetic.make_recording()
    nothing = np.empty(0)
    bare = replace(
        recording,
        backbone_amplitude=nothing,
        backbone_omega=nothing,
        backbone_omega_sd=nothing,
        growth_rate=nothing,
        growth_rate_sd=nothing,
        fit=None,
        notes=(),
    )
    parse(html_page(replace(synthetic.empty_report(), recording=bare)))


# --- nothing leaves the file


def test_the_page_refers_to_nothing_outside(full_page: str, tree: Element) -> None:
    assert set(re.findall(r"https?:[^\s\"'<>)]*", full_page)) <= {SVG}
    names = ("src", "href", "xlink:href", "action", "data", "poster", "srcset")
    targets = [e.attributes[name] for e in tree.all() for name in names if name in e.attributes]
    assert targets
    assert all(target.startswith(("#", "data:")) for target in targets)
    assert "@import" not in full_page
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


def test_ids_are_unique_when_a_page_has_everything(harmless: Element) -> None:
    ids = [e.attributes["id"] for e in harmless.all() if "id" in e.attributes]
    assert sorted(ids) == sorted(set(ids))


def test_ids_are_unique_and_references_resolve(full_page: str, tree: Element) -> None:
    ids = [e.attributes["id"] for e in tree.all() if "id" in e.attributes]
    assert len(ids) == len(set(ids))
    used = set(re.findall(r"url\(#([^)]+)\)", full_page)) | {
        name
        for e in tree.all()
        for name in (*e.attributes.get("aria-labelledby", "").split(), e.attributes.get("href", "")[1:])
        if name and not e.attributes.get("href", "#").startswith("data:")
    }
    assert used
    assert used <= set(ids)


# --- weight


def test_a_nearly_empty_page_is_light() -> None:
    assert len(html_page(synthetic.empty_report()).encode()) <= 60_000


def test_a_full_page_keeps_its_budget(full_page: str) -> None:
    assert len(full_page.encode()) <= 1_000_000
    assert size_warning(full_page) is None


def test_a_heavy_page_is_warned_of_in_bytes_not_letters() -> None:
    assert size_warning("x" * WARN_BYTES) is None
    assert "2.0 MB" in str(size_warning("x" * (WARN_BYTES + 1)))
    assert size_warning("θ" * (WARN_BYTES // 2)) is None
    assert size_warning("θ" * (WARN_BYTES // 2 + 1)) is not None


def test_a_page_about_a_motion_loads_nothing_that_reads_or_identifies_recordings() -> None:
    """Nor scipy.signal, which brings scipy.stats: a tenth of the time that the page takes."""
    late = ("scipy.signal", "scipy.io", "matplotlib", "ridgeback.numeric.files", "ridgeback.compare.studies")
    late += ("ridgeback.compare.identification.candidates", "ridgeback.numeric.backbone")
    program = (
        "import sys, ridgeback.compare.report.system_report, ridgeback.reports.page\n"
        f"print([name for name in {late!r} if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
