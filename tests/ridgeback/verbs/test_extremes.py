"""Values at the ends of what a double holds, and names that act: one line, exit code 2, never a fault of our own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ridgeback.cli import main
from ridgeback.common.csv_text import csv_text
from ridgeback.common.visible import ACTING
from ridgeback.console.output import write_text

LOGARITHM = ["--equation", "u'' + log(1+u) = 0"]
ROOT = ["--equation", "u''+sqrt(1+u)-1 = 0"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["simulate", *LOGARITHM, "--initial=-2,0", "--duration", "5"], "the force at (u, u') = (-2, 0)"),
        (["simulate", "duffing", "--initial", "1e154,0", "--duration", "2"], "the force at (u, u') = (1e+154, 0)"),
        (["simulate", "pendulum", "--set", "k=1e300", "--duration", "2"], "beyond the largest double"),
        (["report", "duffing", "--initial", "1e154,0"], "the force at (u, u') = (1e+154, 0)"),
        (
            ["derive", "damped-pendulum", "--order", "2", "--transient", "1e300", "--until", "10"],
            "outside 1e-15 .. 1e+15",
        ),
        (["simulate", *ROOT, "--initial=-1.2,0", "--duration", "2"], "-1 < u"),
    ],
)
def test_extreme_values_are_refused_in_one_line(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert captured.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("method", ["auto", "pseudo-wigner", "spectrogram", "harmonic-least-squares", "wigner"])
def test_a_window_shorter_than_a_step_is_refused(
    method: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import math

    path = tmp_path / "run.csv"
    path.write_text("u\n" + "\n".join(repr(math.cos(0.3 * i)) for i in range(300)))
    assert main(["estimate", str(path), "--rate", "20", "--method", method, "--lag", "1e-9"]) == 2
    assert "--lag 1e-09" in capsys.readouterr().err


def test_nothing_in_a_title_or_a_column_acts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    toml = tmp_path / "evil.toml"
    toml.write_text('[oscillator]\nequation = "u\'\' + u + u**3 = 0"\ntitle = "a\\u001b[31mb\\u0007\\u202Ec\\u0000"\n')
    for words in (
        ["systems", str(toml)],
        ["derive", str(toml), "--order", "2"],
        ["systems", str(toml), "--format", "json"],
    ):
        assert main(words) == 0
        captured = capsys.readouterr()
        assert not ACTING.search(captured.out + captured.err)
    page = tmp_path / "page.html"
    write_text(str(page), "<h1>a\x1b\x00\u202e\u2066b\x85</h1>\n")
    assert not ACTING.search(page.read_text(encoding="utf-8"))


def test_names_are_no_formulas_of_a_spreadsheet_and_numbers_stay_numbers() -> None:
    text = csv_text(["=A1", "u"], [["@SUM(1)", -1.5], ["+cmd|' /C calc'!A0", "-3/8"], ["-", 4]])
    assert text.splitlines() == ["'=A1,u", "'@SUM(1),-1.5", "'+cmd|' /C calc'!A0,-3/8", "-,4"]


@pytest.mark.parametrize("change", [{"MPLBACKEND": "no-such-backend"}, {"MPLBACKEND": "module://nowhere"}])
def test_a_backend_that_matplotlib_does_not_know_is_no_matter(change: dict[str, str], tmp_path: Path) -> None:
    script = "import sys; from ridgeback.cli import main; main(['systems', '-o', 'x']); import matplotlib.figure"
    environment = {**os.environ, **change, "PYTHONPATH": str(Path(__file__).parents[3])}
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment, check=True)


def test_a_closed_standard_output_is_one_line(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    command = f"{sys.executable} -m ridgeback systems >&-"
    done = subprocess.run(
        ["sh", "-c", command], cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True, check=False
    )
    assert (done.returncode, done.stderr.count("\n")) == (4, 1)
    assert "standard output is closed" in done.stderr
