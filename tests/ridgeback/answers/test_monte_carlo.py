"""``estimate --monte-carlo``: the table in its three forms, with a file and without, and what it refuses."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest

from ridgeback.answers.monte_carlo import uncertain
from ridgeback.cli import main
from ridgeback.compare.noise import monte_carlo as noise
from ridgeback.compare.noise.results import Trial, read_study

QUICK = ["--method", "hilbert", "--snr", "10,30"]


def printed(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["estimate", *words]) == 0, capsys.readouterr().err
    return capsys.readouterr().out


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    t = np.arange(160) / 16.0
    u = np.exp(-0.02 * t) * np.cos(2 * np.pi * 1.5 * t) + 0.01 * np.random.default_rng(1).standard_normal(t.size)
    path = tmp_path / "run.csv"
    path.write_text("time_s,u\n" + "".join(f"{a!r},{b!r}\n" for a, b in zip(t.tolist(), u.tolist(), strict=True)))
    return path


def test_the_forms_agree(capsys: pytest.CaptureFixture[str]) -> None:
    study = read_study(json.loads(printed(capsys, "--monte-carlo", "2", *QUICK, "--format", "json")))
    rows = list(csv.DictReader(io.StringIO(printed(capsys, "--monte-carlo", "2", *QUICK, "--format", "csv"))))
    assert [float(row["rms"]) for row in rows] == [cell.rms for cell in study.cells]
    text = printed(capsys, "--monte-carlo", "2", *QUICK, "--seed", "2")
    assert "2 trials, seed 2" in text
    lines = [line.split() for line in text.splitlines() if line.startswith("hilbert")]
    assert [line[1] for line in lines] == ["10", "30"]
    assert uncertain(study.cells[0].rms, study.cells[0].rms_sd) not in text


def test_a_file_may_stand_before_or_after(capsys: pytest.CaptureFixture[str], recording: Path) -> None:
    before = printed(capsys, str(recording), "--monte-carlo", "2", *QUICK)
    assert "run.csv, u: 160 samples" in before
    assert "smooth harmonic model" in before
    assert printed(capsys, "--monte-carlo", "2", str(recording), *QUICK) == before
    after = printed(capsys, "--method", "hilbert", "--snr", "20", "--format", "json", "--monte-carlo", str(recording))
    assert json.loads(after)["trials"] > 2


def test_a_system_takes_the_place_of_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--system", "duffing-hardening", "--method", "hilbert", "--snr", "20", "--format", "json"]
    study = read_study(json.loads(printed(capsys, "--monte-carlo", "2", *words)))
    assert "Duffing" in study.title
    assert study.samples == 40 * 32 + 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--monte-carlo", "many", "run.csv"], "not a number of trials"),
        (["--monte-carlo", "1"], "1 trials are not between 2"),
        (["--monte-carlo", "5", "--snr", "loud"], "'loud' is not a finite number"),
        (["--monte-carlo", "5", "--method", "pseudo-wigner,guess"], "method 'guess' is unknown"),
        (["--monte-carlo", "5", "--backbone"], "has no use for --backbone"),
        (["--monte-carlo", "99999", *QUICK], "over the budget"),
        (["run.csv", "--workers", "2"], "an estimate without --monte-carlo has no use for --workers"),
        ([], "name the FILE"),
    ],
)
def test_refusals_are_one_line(words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["estimate", *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_workers_give_the_same_table(capsys: pytest.CaptureFixture[str], recording: Path) -> None:
    words = [str(recording), "--monte-carlo", "6", *QUICK, "--format", "json"]
    assert printed(capsys, *words, "--workers", "2") == printed(capsys, *words)


def test_an_interrupt_leaves_what_was_done(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    done = iter(range(3))

    def pressed(work: noise.Work) -> list[Trial]:
        if next(done) == 2:
            raise KeyboardInterrupt
        return run(work)

    run = noise.run
    monkeypatch.setattr(noise, "run", pressed)
    assert main(["estimate", "--monte-carlo", "8", *QUICK, "--format", "csv"]) == 130
    captured = capsys.readouterr()
    assert "interrupted: 5 or more of 8 trials were done in each cell" in captured.err
    assert [row["trials"] for row in csv.DictReader(io.StringIO(captured.out))] == ["5", "5"]
