"""``ridgeback simulate --drift``: the columns and errors that are written, and what is refused in one line."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import ridgeback as library

Ridgeback = Callable[..., Any]
SPRING = ("--equation", "x'' + 9.81/L*x = 0")
SWING = ("--equation", "x'' + 9.81/L*sin(x) = 0", "--initial", "1,0")


def test_the_command_writes_what_the_library_finds(ridgeback: Ridgeback) -> None:
    words = ("simulate", *SWING, "--drift", "L=1+0.01*t", "--duration", "40", "--rate", "8")
    found = library.drift("x'' + 9.81/L*sin(x) = 0", {"L": "1+0.01*t"}, (1.0, 0.0), duration=40.0, rate=8.0)
    done = ridgeback(*words)
    assert done.code == 0
    rows = list(csv.DictReader(io.StringIO(done.out)))
    assert [float(row["omega0"]) for row in rows] == found.adiabatic.omega.tolist()
    assert float(rows[50]["cycle_omega0"]) == found.reference.omega[50]
    assert "of second order in the rates" in done.err
    answer = json.loads(ridgeback(*words, "--format", "json").out)
    assert answer["drift"] == "L = t/100 + 1"
    assert answer["slow"] is True
    assert answer["max_error"] == found.max_error < 2e-6
    assert answer["expected_error"] == pytest.approx(answer["max_error"], rel=0.2)
    assert answer["error_without_drift"] > 0.1
    assert answer["samples"][9] == found.rows()[9]
    assert found.plot().get_ylabel() == "omega0, rad/s"


def test_without_a_potential_the_motion_stands_alone(ridgeback: Ridgeback) -> None:
    done = ridgeback("simulate", "van-der-pol", "--drift", "eps=1+0.01*t", "--duration", "2", "--rate", "2")
    assert done.code == 0
    assert done.out.startswith("time_s,u,velocity\n")
    assert "without a potential no action is conserved" in done.err


def test_a_fast_drift_is_not_relied_on(ridgeback: Ridgeback) -> None:
    done = ridgeback("simulate", *SPRING, "--drift", "L=1+4*t", "--duration", "60", "--rate", "8")
    assert done.code == 3
    assert "not to be relied on" in done.err.splitlines()[-1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--drift", "L"), "write for example L=1+0.01*t"),
        (("--drift", "L=1-0.1*t"), "stops restoring by t = 9.99"),
        (("--drift", "L=1+0.01*t", "--set", "L=2"), "--set and --drift both give L"),
        (("--drift", "L=1+0.01*t", "--drift", "L=2+t"), "--drift gives L twice"),
        (("--drift", "L=1+0.01*t", "--method", "taylor"), "follows no drift"),
        (("--drift", "L=1+0.01*t", "--digits", "30"), "follows no drift"),
        (("--drift", "m=1+0.01*t"), "no parameter 'm'"),
    ],
)
def test_what_cannot_drift_is_refused_in_one_line(ridgeback: Ridgeback, words: tuple[str, ...], said: str) -> None:
    done = ridgeback("simulate", *SWING, *words)
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert said in done.err


def test_a_report_holds_the_action_against_the_motion(ridgeback: Ridgeback, tmp_path: Path) -> None:
    page = tmp_path / "swing.html"
    words = (*SWING, "--drift", "L=1+0.01*t", "--duration", "40", "--rate", "8", "--no-timings")
    done = ridgeback("report", *words, "-o", str(page))
    assert done.code == 0
    text = page.read_text(encoding="utf-8")
    assert "The conserved action follows" in text
    assert text.count("<svg") >= 7  # three figures, wide and narrow, and the plane
    assert "drift.csv" in text
    found = library.report(
        "x'' + 9.81/L*sin(x) = 0", drift={"L": "1+0.01*t"}, initial=(1.0, 0.0), duration=40.0, rate=8.0, timed=False
    )
    assert found.drift is not None
    assert found.title in done.out
    for refused, said in (
        (("report", "--drift", "k=1+t/100"), "needs a SYSTEM"),
        (("report", *words, "--order", "4"), "--order"),
        (("report", *words, "--recording", "a.csv"), "--recording"),
    ):
        answer = ridgeback(*refused)
        assert answer.code == 2
        assert said in answer.err
