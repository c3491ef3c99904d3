"""``ridgeback identify`` as its users meet it."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

Ridgeback = Callable[..., Any]  # the fixture of conftest.py


@pytest.fixture(scope="module")
def decay_csv(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A linear decay in noise, in mm."""
    t = np.arange(300) / 8.0
    x = 3.0 * np.exp(-0.05 * t) * np.cos(6.0 * t) + 0.02 * np.random.default_rng(1).normal(size=300)
    path = tmp_path_factory.mktemp("identify") / "decay.csv"
    path.write_text("t_s,u [mm]\n" + "".join(f"{a!r},{b!r}\n" for a, b in zip(t.tolist(), x.tolist(), strict=True)))
    return path


CHOSEN = ("--candidates", "linear,duffing-hardening")


def test_text_says_what_made_it(ridgeback: Ridgeback, decay_csv: Path) -> None:
    done = ridgeback("identify", str(decay_csv), *CHOSEN, "--predict-from", "12", "--damping", "linear")
    assert done.code == 0
    assert done.err == ""
    assert "Linear oscillator, linear damping" in done.out
    assert "From the first 12 cycles" in done.out
    for word in ("k", "mu", "rad/s", "mm", "weight"):
        assert word in done.out.split()


def test_json_holds_candidates_bands_and_the_measured_backbone(ridgeback: Ridgeback, decay_csv: Path) -> None:
    done = ridgeback("identify", str(decay_csv), *CHOSEN, "--format", "json")
    found = json.loads(done.out)
    best = found["candidates"][0]
    assert best["name"] == "linear"
    assert {"equation", "parameters", "criterion", "delta", "weight", "residual", "note"} <= set(best)
    assert len(best["amplitude"]) == len(best["omega_low"]) == len(best["growth_rate_high"])
    assert len(found["data"]["omega_sd"]) == len(found["data"]["amplitude"])
    k = next(p for p in best["parameters"] if p["name"] == "k")
    assert abs(k["value"] - 6.0) < 4 * k["standard_deviation"] + 1e-3
    assert found["prediction"] is None


def test_csv_has_one_row_per_parameter(ridgeback: Ridgeback, decay_csv: Path, tmp_path: Path) -> None:
    target = tmp_path / "found.csv"
    done = ridgeback("identify", str(decay_csv), "--candidates", "linear", "--format", "csv", "-o", str(target))
    assert (done.code, done.out) == (0, "")
    rows = list(csv.DictReader(io.StringIO(target.read_text())))
    assert [row["parameter"] for row in rows][-3:] == ["a0", "phase0", "offset"]
    assert all(float(row["low_95"]) <= float(row["value"]) <= float(row["high_95"]) for row in rows)


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("--candidates", "linear,cubic"), 2, "candidate 'cubic' is unknown; use one of linear, pendulum"),
        (("--span", "100,200"), 2, "the recording runs from 0 to"),
        (("--span", "5,1"), 2, "T0 must be below T1; write for example 1,5"),
        (("--span", "5,5"), 2, "T0 must be below T1"),
        (("--predict-from", "100"), 2, "predicting from 100 of"),
        (("--column", "v"), 2, "no column v"),
        (("--criterion", "aic"), 2, "--criterion"),
    ],
)
def test_bad_requests_are_one_line(
    ridgeback: Ridgeback, decay_csv: Path, arguments: tuple[str, ...], code: int, said: str
) -> None:
    done = ridgeback("identify", str(decay_csv), *arguments)
    assert done.code == code
    assert done.out == ""
    assert said in done.err
    assert done.err.count("\n") == 1


def test_a_missing_file_is_an_environment_error(ridgeback: Ridgeback) -> None:
    assert ridgeback("identify", "no-such.csv").code == 4
