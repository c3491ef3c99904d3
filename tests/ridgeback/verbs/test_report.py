"""``ridgeback report``: one file, what it says on the terminal, and the command that makes it again."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ridgeback.compare.motion.paper_case import paper_case
from ridgeback.console import browser
from ridgeback.console.failure import PartialError
from ridgeback.options.system import Choice
from ridgeback.verbs import report

Ridgeback = Callable[..., Any]  # the fixture of conftest.py

NONE = Choice(None, None, None, None, ())
SMALL = [
    "--duration",
    "40",
    "--rate",
    "6",
    "--order",
    "2",
    "--orders",
    "2,4",
    "--amplitudes",
    "0.2,0.5",
    "--trials",
    "0",
]


def test_a_system(ridgeback: Ridgeback, tmp_path: Path) -> None:
    page = tmp_path / "duffing.html"
    done = ridgeback("report", "damped-duffing", "--set", "eps=1/2", "--initial", "0.8,0", *SMALL, "-o", str(page))
    assert (done.code, done.err) == (0, "")
    text = page.read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>") or text.startswith("<!doctype html>")
    assert text.rstrip().endswith("</html>")
    title = done.out.splitlines()[2]
    assert f"wrote {page}" in done.out
    assert "ω₀(t)" in title
    assert html.escape(title) in text or title in html.unescape(text)
    # The page tells how to make it again, without the place it was written to.
    assert "ridgeback report damped-duffing --set eps=1/2 --initial 0.8,0" in html.unescape(text)
    assert str(tmp_path) not in text


def test_the_page_alone_on_standard_output(ridgeback: Ridgeback) -> None:
    done = ridgeback("report", "linear", *SMALL, "-o", "-")
    assert done.code == 0
    assert done.out.lstrip().lower().startswith("<!doctype html>")
    assert done.out.rstrip().endswith("</html>")


def test_without_an_argument_it_is_the_papers_case() -> None:
    nothing = report.Motion(NONE, None, None, None)
    paper = paper_case()
    assert report.setting_of(nothing) == paper
    assert paper.initial == (0.95 * math.pi, 0.0)
    assert {n: float(v) for n, v in paper.oscillator.parameters.items()} == {"mu": 0.01, "k": 12.566370614359172}


def test_the_papers_case_can_be_varied() -> None:
    varied = report.setting_of(report.Motion(NONE, (1.0, 0.0), None, 32.0))
    assert (varied.initial, varied.duration, varied.rate) == ((1.0, 0.0), 20.0, 32.0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("report --column u", ("--column", "--recording")),
        ("report --recording run.csv --initial 1,0", ("--initial", "simulation")),
        ("report --recording run.csv --order 4", ("--order", "study")),
        ("report --recording run.csv --set k=2", ("--set", "SYSTEM")),
        ("report --recording run.csv --title mine", ("--title", "SYSTEM")),
        ("report --set k=1 --set k=2", ("k", "twice")),
        ("report --set q=1", ("'q'", "mu")),
        ("report --initial 4,0", ("4", "3.14159")),
        ("report pendulum --amplitudes 4", ("4", "3.14159")),
        ("report --target 2", ("2", "0.001")),
        ("report --rate 2", ("2",)),
        ("report --duration 0.1", ("0.1",)),
    ],
)
def test_requests_that_cannot_be_met(
    ridgeback: Ridgeback, tmp_path: Path, arguments: str, words: tuple[str, ...]
) -> None:
    page = tmp_path / "page.html"
    done = ridgeback(*arguments.split(), "-o", str(page))
    assert done.code == 2
    assert done.out == ""
    assert done.err.count("\n") == 1
    assert "unexpected" not in done.err
    for word in words:
        assert word in done.err
    assert not page.exists()


def test_missing_results_are_owned_up_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from types import SimpleNamespace

    monkeypatch.setattr("ridgeback.reports.page.html_page", lambda _: "<html></html>")
    rows = (
        SimpleNamespace(label="Wigner peak", refused="too short", kind="estimate"),
        SimpleNamespace(label="model", refused=None, kind="estimate"),
    )
    benchmark = SimpleNamespace(contenders=rows)
    made = SimpleNamespace(title="t", lead="", cards=(), summary=(), decay=None, benchmark=benchmark, derivation=None)
    page = tmp_path / "page.html"
    with pytest.raises(PartialError, match="Wigner peak"):
        report.publish(made, str(page), "text")  # type: ignore[arg-type]
    assert page.exists()


def test_a_recording_with_a_system_and_its_findings_as_json(ridgeback: Ridgeback, tmp_path: Path) -> None:
    """1.25 Hz, decaying as exp(-0.05 t): a linear oscillator, whatever the amplitude.

    Five estimates and one curve of theory are six tracks: all must find a colour or stay out.
    """
    samples = [math.exp(-0.05 * i / 32) * math.cos(2 * math.pi * 1.25 * i / 32) for i in range(960)]
    recording = tmp_path / "decay.csv"
    recording.write_text("t,x\n" + "".join(f"{i / 32!r},{x!r}\n" for i, x in enumerate(samples)), encoding="utf-8")
    page = tmp_path / "decay.html"
    words = ["--recording", str(recording), "--column", "x", "linear", "--set", "k=7.85398", "--format", "json"]
    words += ["--trials", "2", "--predict-from", "12"]
    done = ridgeback("report", *words, "-o", str(page))
    assert (done.code, done.err) == (0, "")
    found = json.loads(done.out)
    assert found["output"] == str(page)
    assert "1.25" in found["title"]
    assert any(line.startswith("What made it: Linear oscillator") for line in found["summary"])
    text = page.read_text(encoding="utf-8")
    for part in ("section-identification", "sample-fit", "residual-spectrum", "forecast", "noise"):
        assert f'id="{part}"' in text


def test_two_runs_are_combined_on_one_page(ridgeback: Ridgeback, tmp_path: Path) -> None:
    """Two decays of one oscillator agree; what belongs to a single recording is refused by name."""
    words = ["report"]
    for size in (1.0, 0.6):
        path = tmp_path / f"run{size:g}.csv"
        samples = [size * math.exp(-0.05 * i / 16) * math.cos(2 * math.pi * 1.25 * i / 16) for i in range(400)]
        path.write_text("t,x\n" + "".join(f"{i / 16!r},{x!r}\n" for i, x in enumerate(samples)), encoding="utf-8")
        words += ["--recording", str(path)]
    page = tmp_path / "runs.html"
    done = ridgeback(*words, "linear", "--set", "k=7.85398", "-o", str(page))
    assert (done.code, done.err) == (0, "")
    assert "2 signals agree: 1.2500 Hz" in done.out
    text = page.read_text(encoding="utf-8")
    for part in ("runs-backbone", "runs-tracks", "runs-samples", "section-identification"):
        assert f'id="{part}"' in text
    refused = ridgeback(*words, "--predict-from", "9", "-o", str(page))
    assert refused.code == 2
    assert "a page on several recordings has no use for --predict-from" in refused.err


def test_options_that_belong_elsewhere_are_refused(ridgeback: Ridgeback) -> None:
    assert "--predict-from belongs to --recording" in ridgeback("report", "--predict-from", "9").err
    assert "--trials 1 shows no spread" in ridgeback("report", "--trials", "1").err


def test_an_overdamped_motion_is_refused_by_name(ridgeback: Ridgeback, tmp_path: Path) -> None:
    done = ridgeback("report", "--set", "mu=20", "-o", str(tmp_path / "x.html"))
    assert done.code == 2
    assert "overdamped" in done.err


def test_a_title_of_ones_own_and_no_measured_times(ridgeback: Ridgeback, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    words = [
        "report",
        "--equation",
        "u'' + 2*mu*u' + u + u**3/4 = 0",
        "--set",
        "mu=1/100",
        "--initial",
        "0.5,0",
        *SMALL,
    ]
    done = ridgeback(*words, "--title", "My <b>spring</b>", "--no-timings", "-o", str(page))
    assert (done.code, done.err) == (0, "")
    text = page.read_text(encoding="utf-8")
    assert "My &lt;b&gt;spring&lt;/b&gt;" in text
    assert " a value</dd>" not in text
    assert "<dt>time, " not in text
    assert "not timed" in text


def test_a_page_is_not_printed_where_there_is_no_browser(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OSError, match="no browser to print with"):
        browser.print_to_pdf("page.html", str(tmp_path / "page.pdf"))


def test_what_a_browser_prints_is_moved_to_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in for the browser that writes what it was asked to, or nothing; smaller print is one sheet less."""
    script, page = tmp_path / "chromium", tmp_path / "page.html"
    page.write_text("<html><head></head><body>two sheets</body></html>")
    script.write_text(
        '#!/bin/sh\nfor word; do case $word in --print-to-pdf=*) at="${word#*=}";; file:*) page="${word#file://}";; '
        'esac; done\necho "/Type /Page" > "$at"\ngrep -q "zoom:0.95" "$page" || echo "/Type /Page" >> "$at"\n'
    )
    script.chmod(0o755)
    monkeypatch.setattr(browser, "chromium", lambda: str(script))
    browser.print_to_pdf(str(page), str(tmp_path / "page.pdf"))
    assert browser.sheets((tmp_path / "page.pdf").read_bytes()) == 1
    script.write_text("#!/bin/sh\n")
    with pytest.raises(OSError, match="printed nothing"):
        browser.print_to_pdf(str(page), str(tmp_path / "other.pdf"))
    assert not (tmp_path / "other.pdf").exists()
