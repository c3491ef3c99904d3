"""Bad input: an exit code, one line that names the value and a remedy, nothing on standard output, no traceback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from ridgeback.cli import main
from ridgeback.console.failure import Exit, PartialError, verdict


class Refusal(NamedTuple):
    """Arguments, the exit code, and words that the one line must hold (the value first, then the remedy)."""

    arguments: str
    code: int
    words: tuple[str, ...]


SINE = "time_s,u\n" + "".join(f"{i / 32!r},{((i * 7) % 32 - 16) / 16!r}\n" for i in range(400))
FILES = {
    "sine.csv": SINE,
    "nan.csv": "time_s,u\n" + "".join(f"{i},{'nan' if i % 9 == 8 else i % 3}\n" for i in range(99)),
    "infinite.csv": "time_s,u\n0,1\n1,inf\n2,0\n" + "".join(f"{i},{i % 3}\n" for i in range(3, 60)),
    "irregular.csv": "time_s,u\n" + "".join(f"{i + (0.4 if i % 5 == 0 else 0)},{i % 3}\n" for i in range(60)),
    "duplicate.csv": "time_s,u\n" + "".join(f"{i - (i > 30)},{i % 3}\n" for i in range(60)),
    "short.csv": "time_s,u\n0,1\n1,0\n2,-1\n",
    "constant.csv": "time_s,u\n" + "".join(f"{i},5\n" for i in range(60)),
    "words.csv": "time_s,u\n0,one\n1,two\n",
    "empty.csv": "",
    "binary.csv": "\x00\x01\x02",
}

REFUSALS = [
    Refusal("derive pendulmu", 2, ("pendulmu", "pendulum")),
    Refusal("simulate nothing-like-it", 2, ("nothing-like-it", "pendulum")),
    Refusal("nosuchverb", 2, ("nosuchverb", "derive")),
    Refusal("derive", 2, ("SYSTEM", "--help")),
    Refusal("derive pendulum --set g=9.81", 2, ("'g'", "k")),
    Refusal("derive pendulum --set k=nan", 2, ("'nan'", "0.01")),
    Refusal("derive pendulum --set k=inf", 2, ("'inf'", "0.01")),
    Refusal("derive pendulum --set k=__import__('os')", 2, ("__import__", "0.01")),
    Refusal("derive pendulum --set k", 2, ("'k'", "mu=0.01")),
    Refusal("derive pendulum --set k=1 --set k=2", 2, ("k", "twice")),
    Refusal("derive pendulum --set k=0", 2, ("frequency",)),
    Refusal("derive pendulum --method averaging", 2, ("averaging", "lindstedt")),
    Refusal("derive pendulum --order -1", 2, ("-1", "0 or more")),
    Refusal("derive pendulum --order 2.5", 2, ("2.5", "integer")),
    Refusal("derive pendulum --order many", 2, ("many", "integer")),
    Refusal("derive pendulum --order 999999999", 2, ("999999999", "order")),
    Refusal("derive van-der-pol --order 100000", 2, ("100000", "order")),
    Refusal("derive damped-pendulum --order 100000", 2, ("100000", "order")),
    Refusal("derive pendulum --method energy-integral --order 10000000", 2, ("10000000", "order")),
    Refusal("derive pendulum --amplitude rms", 2, ("rms", "peak")),
    Refusal("derive pendulum --weight 3", 2, ("weight", "multiple-scales")),
    Refusal("derive pendulum --method multiple-scales --amplitude peak", 2, ("peak", "fundamental")),
    Refusal("derive damped-pendulum --method lindstedt", 2, ("damped-pendulum", "multiple-scales")),
    Refusal("derive damped-pendulum --method energy-integral", 2, ("energy",)),
    Refusal("derive pendulum --format yaml", 2, ("yaml", "json")),
    Refusal("generate pendulum --language fortran", 2, ("fortran", "python")),
    Refusal("simulate pendulum --initial 1", 2, ("'1'", "2.984513,0")),
    Refusal("simulate pendulum --initial nan,0", 2, ("'nan'", "0.01")),
    Refusal("simulate pendulum --initial 3.2,0", 2, ("3.2", "3.14159")),
    Refusal("simulate pendulum --initial 0,0", 2, ("(0, 0)", "start elsewhere")),
    Refusal("simulate pendulum --initial 0,2.5", 2, ("rotation", "less energy")),
    Refusal("simulate duffing-softening --initial 0.9,1", 2, ("escape", "less energy")),
    Refusal("simulate pendulum --duration 0", 2, ("'0'", "positive")),
    Refusal("simulate pendulum --rate -4", 2, ("'-4'", "positive")),
    Refusal("simulate pendulum --duration 1e9 --rate 1e9", 2, ("fit", "rate")),
    Refusal("simulate pendulum --method euler", 2, ("euler", "DOP853")),
    Refusal("simulate pendulum --digits 30", 2, ("--digits", "taylor")),
    Refusal("study pendulum --amplitudes 3.2", 2, ("3.2", "3.14159")),
    Refusal("study pendulum --amplitudes 0.1:3.5:4", 2, ("separatrix", "3.14159")),
    Refusal("study duffing-softening --amplitudes 1", 2, ("amplitude 1", "below 1")),
    Refusal("study pendulum --amplitudes 0.1:3.0", 2, ("0.1:3.0", "0.1:3.0:30")),
    Refusal("study pendulum --amplitudes 3:1:5", 2, ("START 3", "swap")),
    Refusal("study pendulum --amplitudes -1", 2, ("-1", "above 0")),
    Refusal("study pendulum --amplitudes 1 --orders 2,x", 2, ("'x'", "2,4,8,16")),
    Refusal("study pendulum", 2, ("--amplitudes", "--help")),
    Refusal("estimate sine.csv --column nosuch", 2, ("nosuch", "u")),
    Refusal("estimate sine.csv --time-column nosuch", 2, ("nosuch", "time_s")),
    Refusal("estimate sine.csv --method guess", 2, ("guess", "wigner")),
    Refusal("estimate sine.csv --rate 0 --column u", 2, ("'0'", "positive")),
    Refusal("estimate sine.csv --band 5,1", 2, ("5,1", "LOW < HIGH")),
    Refusal("estimate sine.csv --band 1,1000", 2, ("1000",)),
    Refusal("estimate sine.csv --harmonic 50", 2, ("50",)),
    Refusal("estimate sine.csv --lag 1e6", 2, ("1e+06",)),
    Refusal("estimate nan.csv", 2, ("between its", "t = 7 to 9", "16 samples")),
    Refusal("estimate infinite.csv", 2, ("inf",)),
    Refusal("estimate irregular.csv", 2, ("irregular.csv",)),
    Refusal("estimate duplicate.csv", 2, ("duplicate.csv",)),
    Refusal("estimate short.csv", 2, ("3",)),
    Refusal("estimate constant.csv", 2, ("constant", "5")),
    Refusal("estimate words.csv", 2, ("one",)),
    Refusal("estimate empty.csv", 2, ("empty.csv",)),
    Refusal("estimate binary.csv", 2, ("binary.csv",)),
    Refusal("estimate missing.csv", 4, ("missing.csv",)),
    Refusal("estimate folder.csv", 4, ("folder.csv",)),
    Refusal("derive pendulum -o missing/out.txt", 4, ("missing", "path")),
    Refusal("derive pendulum -o .", 4, ("folder", "'.'")),
    Refusal("report -o missing/out.html", 4, ("missing", "path")),
    Refusal("report nosuch", 2, ("nosuch", "pendulum")),
]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files above as the current one."""
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "folder.csv").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("case", REFUSALS, ids=lambda case: case.arguments)
@pytest.mark.usefixtures("folder")
def test_refused_in_one_line(case: Refusal, capsys: pytest.CaptureFixture[str]) -> None:
    code = main(case.arguments.split())
    printed = capsys.readouterr()
    assert code == case.code, printed.err
    assert printed.out == ""
    assert printed.err.startswith("ridgeback: ")
    assert printed.err.count("\n") == 1
    assert "Traceback" not in printed.err
    assert "unexpected" not in printed.err
    for word in case.words:
        assert word in printed.err


def test_nothing_is_written_when_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = sorted(folder.iterdir())
    assert main(["study", "pendulum", "--amplitudes", "9", "-o", "study.csv"]) == 2
    assert sorted(folder.iterdir()) == before
    assert "9" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("error", "code", "word"),
    [
        (KeyboardInterrupt(), Exit.INTERRUPTED, "interrupted"),
        (MemoryError(), Exit.ENVIRONMENT, "lower order"),
        (OSError(28, "No space left on device", "out.csv"), Exit.ENVIRONMENT, "out.csv"),
        (PartialError("1 of 4 cells"), Exit.PARTIAL, "1 of 4 cells"),
        (ZeroDivisionError("division by zero"), Exit.BUG, "report"),
    ],
)
def test_every_failure_has_its_exit_code(error: BaseException, code: Exit, word: str) -> None:
    found, message = verdict(error)
    assert found == code
    assert word in message


@pytest.mark.parametrize("wanted", ["", "1"])
def test_the_traceback_is_shown_only_on_request(
    wanted: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("RIDGEBACK_DEBUG", wanted)
    assert main(["derive", "nosuch"]) == 2
    assert ("Traceback" in capsys.readouterr().err) == bool(wanted)


def test_an_unexpected_error_is_owned_in_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise AssertionError("a\nb")

    monkeypatch.setattr("ridgeback.symbolic.systems.catalogue.catalogue", broken)
    assert main(["systems"]) == Exit.BUG
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "please report" in printed


def test_an_interrupt_is_one_line_and_130(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("ridgeback.symbolic.systems.catalogue.catalogue", interrupted)
    assert main(["systems"]) == 130
    assert capsys.readouterr().err == "ridgeback: interrupted; nothing was written\n"


def shell(command: str, folder: Path, unbuffered: str) -> subprocess.CompletedProcess[str]:
    """Run a shell line in which ``$R`` is the command, as a user would."""
    environment = {**os.environ, "R": f"{sys.executable} -m ridgeback", "PYTHON": sys.executable}
    environment["PYTHONUNBUFFERED"] = unbuffered  # without a buffer, Python leaves a partial write at that
    environment.pop("RIDGEBACK_DEBUG", None)
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", command],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX shell")
@pytest.mark.parametrize(
    ("command", "code", "said"),
    [
        ("$R simulate linear --duration 300 --rate 300 | head -n 1", 141, ""),
        ("$R systems > /dev/full", 4, "space"),
        ("$R derive pendulum --format json | $PYTHON -m json.tool --compact", 0, ""),
    ],
    ids=["broken pipe", "full device", "whole pipe"],
)
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_in_a_shell(command: str, code: int, said: str, unbuffered: str, tmp_path: Path) -> None:
    if "/dev/full" in command and not Path("/dev/full").exists():
        pytest.skip("no /dev/full on this system")
    done = shell(command, tmp_path, unbuffered)
    assert done.returncode == code, done.stderr
    assert said in done.stderr
    assert done.stderr.count("\n") == (1 if said else 0)
