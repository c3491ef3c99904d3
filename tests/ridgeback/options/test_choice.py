"""An oscillator by name, by file, by equation, and about another equilibrium; certificates on demand."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Ridgeback = Callable[..., Any]  # the fixture of conftest.py

MINE = """
[oscillator]
equation = "x'' + 2*mu*x' + x + x**3/3 = 0"
initial = [1.2, 0]
[oscillator.parameters]
mu = 0.02
"""


@pytest.fixture
def mine(tmp_path: Path) -> str:
    file = tmp_path / "mine.toml"
    file.write_text(MINE, encoding="utf-8")
    return str(file)


def frequency(out: str) -> dict[int, str]:
    return {term["powers"]["A"]: term["coefficient"] for term in json.loads(out)["frequency"]}


def test_an_equation_with_symbolic_parameters(ridgeback: Ridgeback) -> None:
    equation = "u'' + u + alpha2*u**2 + alpha3*u**3 = 0"
    done = ridgeback("derive", "--equation", equation, "--order", "2", "--format", "json")
    assert done.code == 0
    assert frequency(done.out) == {0: "1", 2: "-5*alpha2**2/12 + 3*alpha3/8"}


def test_an_equation_with_set_and_about(ridgeback: Ridgeback) -> None:
    done = ridgeback(
        "derive", "--equation", "u'' - k**2*u + u**3 = 0", "--set", "k=2", "--about", "2", "--order", "2",
        "--format", "json",
    )  # fmt: skip
    # Measured from the well at u = 2: w'' + 8 w + 6 w^2 + w^3 = 0; A^2 term (3/8 alpha3 - 5/12 alpha2^2 / k^2) / k.
    assert frequency(done.out) == {0: "2*sqrt(2)", 2: "-3*sqrt(2)/8"}


def test_a_file_serves_every_verb(ridgeback: Ridgeback, mine: str, tmp_path: Path) -> None:
    assert "x'' + 2*mu*x'" in ridgeback("systems", mine).out
    assert json.loads(ridgeback("derive", mine, "--order", "2", "--format", "json").out)["method"] == "multiple-scales"
    assert "def growth_rate" in ridgeback("generate", mine, "--order", "2").out
    assert ridgeback("simulate", mine, "--duration", "1", "--rate", "2").out.splitlines()[1] == "0.0,1.2,0.0"
    rows = ridgeback("study", mine, "--orders", "2", "--amplitudes", "0.5,1", "--format", "csv").out.splitlines()
    assert len(rows) == 3
    page = tmp_path / "mine.html"
    small = [
        "--duration",
        "40",
        "--rate",
        "6",
        "--order",
        "2",
        "--orders",
        "2",
        "--amplitudes",
        "0.2,0.5",
        "--trials",
        "0",
    ]
    assert ridgeback("report", mine, *small, "-o", str(page)).code == 0


def test_a_certificate_is_printed_and_put_into_the_json(ridgeback: Ridgeback) -> None:
    done = ridgeback("derive", "pendulum", "--order", "4", "--verify", "--format", "json")
    assert [check["passed"] for check in json.loads(done.out)["certificate"]] == [True] * 4
    assert "certificate" not in json.loads(ridgeback("derive", "pendulum", "--order", "4", "--format", "json").out)
    text = ridgeback("derive", "pendulum", "--order", "4", "--verify").out
    assert text.count(" holds ") == 4


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["derive"], "name a SYSTEM"),
        (["derive", "pendulum", "--equation", "u'' + u = 0"], "keep one"),
        (["derive", "--equation", "u'' + 2u = 0"], "2*u"),
        (["derive", "--equation", "u'' + u**3 = 0", "--method", "lindstedt"], "no linear restoring force"),
        (["derive", "--equation", "u'' + u + abs(u)*u = 0", "--method", "lindstedt"], "--method energy-integral"),
        (["derive", "--equation", "u'' + abs(u - 1)*u = 0"], "no series about rest holds"),
        (["generate", "--equation", "u'' + u*abs(u) = 0", "--motion"], "frequency only"),
        (["derive", "--equation", "u'' + u*abs(u) = 0", "--resummed", "pade"], "resummations are of power series"),
        (["derive", "pendulum", "--about", "1"], "is not an equilibrium"),
        (["derive", "pendulum", "--about", "pi"], "saddle"),
        (["derive", "--equation", "u'' + u + c*u**3 = 0", "--set", "d=1"], "d"),
        (["simulate", "--equation", "u'' + u + c*u**3 = 0"], "c"),
    ],
)
def test_a_bad_choice_is_refused_in_one_line(ridgeback: Ridgeback, arguments: list[str], words: str) -> None:
    done = ridgeback(*arguments)
    assert done.code == 2
    assert words in done.err
    assert len(done.err.strip().splitlines()) == 1


def test_a_missing_file_is_an_environment_error(ridgeback: Ridgeback, tmp_path: Path) -> None:
    assert ridgeback("derive", str(tmp_path / "none.toml")).code == 4
