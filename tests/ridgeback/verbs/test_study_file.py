"""``ridgeback study FILE.toml``: the contract of the command line around a study from a file."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Ridgeback = Callable[..., Any]

TEXT = """
[study]
title = "Two"
ask = ["error", "order-needed"]
[grid]
orders = [2, 4]
amplitudes = [0.5, 1, 2]
[[oscillator]]
system = "pendulum"
[[oscillator]]
system = "duffing-softening"
"""


@pytest.fixture
def study(tmp_path: Path) -> str:
    path = tmp_path / "two.toml"
    path.write_text(TEXT, encoding="utf-8")
    return str(path)


def test_cells_as_csv_and_json_agree_with_the_verb_s_own_table(ridgeback: Ridgeback, study: str) -> None:
    done = ridgeback("study", study, "--format", "csv")
    assert done.code == 3, done.err
    assert "4 of 12 cells have no value" in done.err
    rows = list(csv.DictReader(io.StringIO(done.out)))
    assert Path(study).with_suffix(".db").is_file()
    whole = json.loads(ridgeback("study", study, "--format", "json").out)
    assert [row["relative_error"] for row in whole["cells"]] == [
        float(row["relative_error"]) if row["relative_error"] else None for row in rows
    ]
    assert whole["columns"]["omega"]["unit"] == "rad per time unit"
    assert whole["failures"][0]["cells"] == 2
    plain = ridgeback("study", "pendulum", "--orders", "2,4", "--amplitudes", "0.5,1,2", "--format", "csv")
    known = {(r["order"], r["amplitude"]): r["relative_error"] for r in csv.DictReader(io.StringIO(plain.out))}
    mine = {(r["order"], r["amplitude"]): r["relative_error"] for r in rows if r["oscillator"] == "pendulum"}
    assert mine == known


def test_answers_in_words_and_with_two_processes_the_same_bytes(
    ridgeback: Ridgeback, study: str, tmp_path: Path
) -> None:
    alone = ridgeback("study", study)
    assert "order-needed: smallest order within a tolerance" in alone.out
    assert "4 cells have no value and are left out:" in alone.out
    pair = ridgeback("study", study, "--workers", "2", "--store", str(tmp_path / "pair.db"))
    assert pair.out == alone.out
    assert pair.code == alone.code == 3


def test_another_setting_needs_another_store(ridgeback: Ridgeback, study: str, tmp_path: Path) -> None:
    assert ridgeback("study", study).code == 3
    refused = ridgeback("study", study, "--set", "orders=2")
    assert refused.code == 2
    assert "orders was [2, 4], is [2]" in refused.err
    done = ridgeback(
        *("study", study, "--set", "orders=2", "--set", "oscillator.2.parameters.eps=-1/100"),
        *("--store", str(tmp_path / "other.db"), "--format", "csv"),
    )
    assert done.code == 0, done.err
    assert len(done.out.splitlines()) == 7


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("STUDY", "--orders", "2"), "use --set to change them"),
        (("STUDY", "--format", "markdown"), "does not belong to a study file"),
        (("STUDY", "--set", "orders"), "is not KEY=VALUE"),
        (("STUDY", "--set", "orders=1.5"), "--set grid.orders: holds 1.5"),
        (("pendulum", "--amplitudes", "1", "--workers", "2"), "belong to a study file"),
        (("pendulum", "--amplitudes", "1", "--set", "k=x"), "is not a finite number"),
    ],
)
def test_what_does_not_belong_together_is_refused(
    ridgeback: Ridgeback, study: str, arguments: tuple[str, ...], said: str
) -> None:
    done = ridgeback("study", *(study if word == "STUDY" else word for word in arguments))
    assert done.code == 2
    assert said in done.err
    assert len(done.err.strip().splitlines()) == 1


def test_an_example_is_printed_and_runs_through_its_checks(ridgeback: Ridgeback) -> None:
    from ridgeback.compare.studies.examples import NAMES
    from ridgeback.options.study import EXAMPLES

    assert EXAMPLES == NAMES
    for name in NAMES:
        assert ridgeback("study", "--example", name).out.startswith("# ")
