"""What verbs do beside their usual work: other forms of output, results that are partial, what they refuse."""

from __future__ import annotations

import sys
import webbrowser
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.answers import atlas_table, study_file, study_tables
from ridgeback.answers.at import _true_line, true_cycles
from ridgeback.answers.high_order import kept_until_written
from ridgeback.answers.measurements_text import chance
from ridgeback.answers.monte_carlo import DEFAULT, trials_and_file
from ridgeback.answers.report_text import refuse_incomplete, statement_row
from ridgeback.answers.study_text import markdown_lines
from ridgeback.cli import cli
from ridgeback.common.errors import InputError
from ridgeback.common.show.optional import MissingLibraryError
from ridgeback.compare.binding import generated_code
from ridgeback.compare.study import atlas as charting
from ridgeback.compare.study.results import Checked
from ridgeback.console import browser
from ridgeback.console.failure import PartialError
from ridgeback.interface import benchmark as benchmark_interface
from ridgeback.interface.studies import STORE
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.verbs import report as report_verb
from tests.reports import synthetic, synthetic_several
from tests.ridgeback.conftest import Ridgeback

STUB: Any = SimpleNamespace


@pytest.fixture(scope="module")
def decay(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two channels of a short decay."""
    t = np.arange(320) / 16.0
    x = np.exp(-0.04 * t) * np.cos(6.0 * t)
    path = tmp_path_factory.mktemp("decay") / "decay.csv"
    rows = "\n".join(f"{a:.6g},{b:.8g},{2 * b:.8g}" for a, b in zip(t, x, strict=True))
    path.write_text(f"t,x,y\n{rows}\n", encoding="utf-8")
    return path


# --- study ---


@pytest.mark.parametrize("style", ["text", "json", "csv", "markdown"])
def test_the_atlas_in_every_form(
    style: str, ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    charts = charting.atlas(["duffing", "linear"], orders=(2, 4))
    monkeypatch.setattr(charting, "atlas", lambda **_: charts)
    output = tmp_path / "atlas"
    result = ridgeback("study", "--atlas", "--orders", "2,4", "--format", style, "-o", str(output))
    assert result.code == 0, result.err
    text = output.read_text(encoding="utf-8")
    assert "duffing" in text
    assert "constant" in text or style in ("json", "csv")
    assert "variable" not in str(atlas_table.cells(replace(charts[1], limits=None)))


def test_where_cells_are_computed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    from contextlib import contextmanager

    from ridgeback.console import cluster

    @contextmanager
    def two(_: str) -> Any:
        yield "executor", 2

    monkeypatch.setattr(cluster, "cluster", two)
    with study_file.executing(STUB(scheduler="tcp://x", workers=None)) as (executor, window):
        assert (executor, window) == ("executor", 2 * study_file.EACH)
    folder = tmp_path / "cells.zarr"
    folder.mkdir()
    with pytest.raises(Exception, match="exists already; a Zarr store is a new folder"):
        study_tables.check_table("zarr", str(folder))

    def missing(*_: object) -> None:
        raise MissingLibraryError("xarray is missing")

    monkeypatch.setattr(study_tables, "optional", missing)
    with pytest.raises(InputError, match=r'pip install "ridgeback\[studies\]"'):
        study_tables.needed("xarray", "netcdf")


def test_a_table_of_which_nothing_is_shared_has_no_line_of_it() -> None:
    answer = synthetic_several.make_answer("error")
    lines = list(markdown_lines(answer))
    assert lines[0] == "## What was asked"
    assert not lines[2].endswith(".") or "oscillator" in lines[2]


# --- generate ---


def test_code_into_a_folder_with_its_script_and_its_self_test(ridgeback: Ridgeback, tmp_path: Path) -> None:
    order = ("pendulum", "--order", "2", "--up-to", "1")
    result = ridgeback("generate", *order, "--check", "-o", f"{tmp_path}/clock/")
    assert result.code == 0, result.err
    assert "self-test of the generated code: python: passed" in result.err
    assert list((tmp_path / "clock").rglob("__init__.py"))
    inside = ridgeback("generate", *order, "--language", "c", "--gappa", "-o", f"{tmp_path}/folder/")
    assert inside.code == 0, inside.err
    assert len(list((tmp_path / "folder").rglob("*.gappa"))) == 1
    beside = ridgeback("generate", *order, "--language", "c", "--gappa", "-o", f"{tmp_path}/clock.c")
    assert beside.code == 0, beside.err
    assert "@rnd = float" in (tmp_path / "clock.gappa").read_text(encoding="utf-8")
    assert "name it with -o" in ridgeback("generate", *order, "--language", "c", "--gappa").err


def test_code_that_fails_its_self_test_is_our_fault(ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch) -> None:
    failed = generated_code.Checked("python", "failed", "entry 3")
    monkeypatch.setattr(generated_code, "check", lambda *_: failed)
    result = ridgeback("generate", "pendulum", "--order", "2", "--check")
    assert result.code == 70
    assert "entry 3" in result.err


def test_a_closed_form_has_no_other_in_its_place(ridgeback: Ridgeback) -> None:
    result = ridgeback("generate", "cube-root", "--order", "2", "--resummed", "pade")
    assert result.code == 2
    assert result.err.count("\n") == 1


# --- derive ---


def test_a_cycle_of_which_nothing_is_enclosed_is_said() -> None:
    assert "no true limit cycle is enclosed: too wide" in _true_line({"omega0": None, "refused": "too wide"})
    own = Oscillator.from_equation("u'' - m*(1 - u**2)*u' + u = 0", parameters={"m": None})
    beyond = STUB(square_series=None, reach=STUB(beyond=True))
    assert true_cycles(own, multiple_scales(own, 2, weight=1), [beyond]) == ()


def test_a_stop_before_the_result_is_written_says_where_the_state_is() -> None:
    with pytest.raises(KeyboardInterrupt, match="before the result was written"), kept_until_written("state.txt"):
        raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt, match=r"^$"), kept_until_written(None):
        raise KeyboardInterrupt


# --- report and benchmark ---


def test_pages_of_a_folder_and_of_a_store(
    ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, study_report_page: Any
) -> None:
    from ridgeback.compare.report.several import index, study_report

    monkeypatch.setattr(index, "index_report", lambda folder, **_: replace(study_report_page, title=Path(folder).name))
    monkeypatch.setattr(study_report, "study_report", lambda store, **_: replace(study_report_page, title=store))
    for name in (str(tmp_path), f"kept{STORE}"):
        result = ridgeback("report", name, "-o", f"{tmp_path}/page.html")
        assert result.code == 0, result.err
        assert Path(name).name in (tmp_path / "page.html").read_text(encoding="utf-8")
        assert ridgeback("report", name, "--rate", "9", "-o", f"{tmp_path}/no.html").code == 2


@pytest.fixture
def study_report_page() -> Any:
    return replace(synthetic.empty_report(), answered=synthetic_several.study_report().answered)


def test_a_page_printed_and_opened(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    printed = []
    monkeypatch.setattr(browser, "print_to_pdf", lambda *names: printed.append(names))
    monkeypatch.setattr(webbrowser, "open", lambda _: False)
    report_verb.show("page.html", "page.pdf", opened=True)
    assert printed == [("page.html", "page.pdf")]
    assert "no browser could be opened; the page is page.html" in capsys.readouterr().err
    monkeypatch.setattr(webbrowser, "open", lambda _: True)
    report_verb.show("page.html", None, opened=True)
    report_verb.show("page.html", None, opened=False)
    assert capsys.readouterr().err == ""
    assert (
        report_verb.as_typed(["report", "x", "--open", "--pdf=p", "-o", "y", "--rate", "9"])
        == "ridgeback report x --rate 9"
    )


def test_a_page_whose_certificate_fails_is_partial() -> None:
    full = synthetic.full_report()
    wrong = Checked("residual", "order 4 does not cancel", False)
    assert full.derivation is not None
    failing = replace(full, derivation=replace(full.derivation, certificate=(wrong,)))
    with pytest.raises(PartialError, match="its certificate fails: residual"):
        refuse_incomplete(failing)
    assert full.decay is not None
    assert statement_row(full.decay.statements[4])["curves"] == ["wigner-u", "closed-form", "order-4"]


@pytest.mark.parametrize("refused", [True, False])
def test_a_benchmark_with_its_figure(
    refused: bool, ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    full = synthetic.full_report().benchmark
    assert full is not None
    keep = [i for i, row in enumerate(full.contenders) if refused or not row.refused]
    found = replace(full, contenders=tuple(full.contenders[i] for i in keep), errors=full.errors[keep])
    monkeypatch.setattr(benchmark_interface, "benchmark", lambda *_, **__: found)
    result = ridgeback(
        "benchmark", "pendulum", "--plot", f"{tmp_path}/cost.svg", "-o", f"{tmp_path}/rows.csv", "--format", "csv"
    )
    assert result.code == (3 if refused else 0), result.err
    assert ("1 of the estimates give nothing here" in result.err) is refused
    assert (tmp_path / "cost.svg").read_bytes().startswith(b"<?xml")


# --- recordings ---


@pytest.mark.parametrize("kind", ["npz", "png"])
def test_the_plane_of_one_signal(kind: str, decay: Path, ridgeback: Ridgeback, tmp_path: Path) -> None:
    plane = tmp_path / f"plane.{kind}"
    result = ridgeback("estimate", str(decay), "--column", "x", "--planes", str(plane))
    assert result.code == 0, result.err
    assert plane.stat().st_size > 1000
    if kind == "npz":
        other = tmp_path / "other.csv"
        other.write_bytes(decay.read_bytes())
        both = ridgeback("estimate", str(decay), str(other), "--column", "x", "--planes", str(plane))
        assert both.code == 2
        assert "not of 2; name one --column" in both.err
        assert "does not end in .npz or .png" in ridgeback("estimate", str(decay), "--planes", "plane.pdf").err


def test_an_identification_that_lost_candidates_is_partial(
    decay: Path, ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch
) -> None:
    from ridgeback.interface import identify as interface

    found = synthetic.make_identification()
    monkeypatch.setattr(interface, "identify", lambda *_, **__: replace(found, prediction=None))
    result = ridgeback("identify", str(decay), "--column", "x")
    assert result.code == 3
    assert "1 of the candidates could not be fitted: bilinear: no switch in reach" in result.err


# --- small ---


def test_small_refusals(ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "--truth is for CSV; JSON has the truth" in ridgeback("sample", "decay", "--truth", "--format", "json").err
    drifting = ridgeback("simulate", "pendulum", "--drift", "k=1+t/9", "--energy")
    assert "--energy is of a force that does not change" in drifting.err
    assert trials_and_file(DEFAULT, "x.csv") == (None, "x.csv")
    assert chance(STUB(found=STUB(presence=None))) == ()
    assert cli.get_command(STUB(), "nothing") is None
    monkeypatch.setattr(sys, "stdout", None)
    from ridgeback.cli import main

    assert main(["systems"]) == 4
