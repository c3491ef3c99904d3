"""Failures: an exit code for each kind, one line, a traceback only on request.  The cases are in ``tests/faults``."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ridgeback.cli import main
from ridgeback.console.failure import Exit, PartialError, verdict


def test_nothing_is_written_when_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["study", "pendulum", "--amplitudes", "9", "-o", "study.csv"]) == 2
    assert not list(tmp_path.iterdir())
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

    monkeypatch.setattr("ridgeback.symbolic.systems.entries.every.listed", broken)
    assert main(["systems"]) == Exit.BUG
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "please report" in printed


def test_an_interrupt_is_one_line_and_130(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("ridgeback.symbolic.systems.entries.every.listed", interrupted)
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
