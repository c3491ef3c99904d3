"""``ridgeback study FILE.toml``: the contract of the command line around a study from a file."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ridgeback import run_study

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


@pytest.mark.parametrize(("style", "library"), [("parquet", "pyarrow"), ("netcdf", "h5netcdf"), ("zarr", "zarr")])
def test_tables_of_other_libraries_hold_every_cell(
    ridgeback: Ridgeback, study: str, tmp_path: Path, style: str, library: str
) -> None:
    pytest.importorskip(library)
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    output = tmp_path / f"cells.{style}"
    assert ridgeback("study", study, "--format", style, "-o", str(output)).code == 3
    whole = json.loads(ridgeback("study", study, "--format", "json").out)
    expected = [row["relative_error"] for row in whole["cells"]]
    if style == "parquet":
        found = pandas.read_parquet(output).relative_error.tolist()
    else:
        with xarray.open_dataset(output, engine="h5netcdf" if style == "netcdf" else "zarr") as data:
            found = data.relative_error.values.tolist()
            assert data.omega.attrs["units"] == "rad per time unit"
            assert data.attrs["program"].startswith("ridgeback")
    assert [None if value != value else value for value in found] == expected  # noqa: PLR0124 - NaN
    assert ridgeback("study", study, "--format", style).code == 2


def test_a_full_product_becomes_a_dataset_over_its_axes(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    path = tmp_path / "grid.toml"
    one = TEXT[: TEXT.index("[[oscillator]]")] + '[[oscillator]]\nsystem = "pendulum"\nparameters = { k = [3, 1] }\n'
    path.write_text(one, encoding="utf-8")
    found = run_study(path)
    data = found.to_xarray()
    assert dict(data.relative_error.sizes) == {"k": 2, "amplitude": 3, "order": 2}
    assert data.attrs["program"].startswith("ridgeback")
    assert data.amplitude.attrs["units"] == "unit of the unknown"
    for row in found.rows():
        cell = data.sel(k=row["k"], amplitude=row["amplitude"], order=row["order"])
        assert float(cell.omega) == row["omega"]
        assert str(cell.method.values) == row["method"]


def test_two_stores_are_held_against_each_other(ridgeback: Ridgeback, study: str, tmp_path: Path) -> None:
    other = str(tmp_path / "other.db")
    ridgeback("study", study)
    ridgeback("study", study, "--set", "oscillator.2.parameters.eps=-1/2", "--store", other)
    text = ridgeback("study", study, "--against", other).out
    assert "6 cells are equal to the last digit, 0 differ; 6 are in the first store only, 6 in the second only" in text
    assert "subjects.2.system.parameters was" in text
    ridgeback("study", study, "--set", "orders=2,4,6", "--store", str(tmp_path / "more.db"))
    found = json.loads(ridgeback("study", other, "--against", str(tmp_path / "more.db"), "--format", "json").out)
    assert (found["equal"], found["only_first"], found["only_second"]) == (6, 6, 12)
    refused = ridgeback("study", study, "--against", str(tmp_path / "nowhere.db"))
    assert refused.code == 2
    assert "is not there" in refused.err


def test_a_dry_run_counts_and_computes_nothing(ridgeback: Ridgeback, study: str) -> None:
    done = ridgeback("study", study, "--dry-run", "--workers", "2")
    assert done.code == 0
    assert done.out.startswith("12 cells in 2 blocks\n")
    assert not Path(study).with_suffix(".db").exists()


def test_answers_are_drawn(ridgeback: Ridgeback, study: str, tmp_path: Path) -> None:
    picture = tmp_path / "answers.svg"
    assert ridgeback("study", study, "--plot", str(picture)).code == 3
    first = picture.read_bytes()
    # the errors of the first of two oscillators, and the orders that each needs
    assert first.count(b'<g id="axes_') == 3
    ridgeback("study", study, "--plot", str(picture))
    assert picture.read_bytes() == first
