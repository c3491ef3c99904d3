"""The estimator study: its cases, its order, and its checkpoint."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import pytest
from scipy.special import ellipk

from ridgeback.answers.estimator_table import row_of, study_text
from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import write_signed
from ridgeback.compare.noise.estimator_study import AXES, Case, CaseResult, cases, estimator_study
from ridgeback.compare.noise.results import Trial, cell_of

SMALL = (Case(length=9.0), Case(axis="snr_db", snr_db=10.0, length=9.0))
METHODS = ("wigner", "hilbert")


def test_cases_differ_from_the_base_in_one_thing() -> None:
    found = cases()
    assert len({case.label for case in found}) == len(found) == 1 + sum(map(len, AXES.values()))
    base = dataclasses.asdict(found[0])
    for case in found[1:]:
        other = dataclasses.asdict(case)
        assert [name for name in base if base[name] != other[name] and name != "axis"] == [case.axis]


def test_truth_of_a_case_is_the_exact_frequency_of_its_amplitude() -> None:
    case = Case(damping=0.0, amplitude=0.8 * math.pi, length=20.0)
    truth = case.truth()
    exact = 2 * math.pi * math.pi / (2 * ellipk(math.sin(0.4 * math.pi) ** 2))
    assert truth.omega == pytest.approx(exact, rel=1e-8)
    assert truth.x.size == 16 * 20 + 1
    assert truth.x[0] == pytest.approx(0.8 * math.pi)


def test_an_interrupted_study_goes_on_from_its_checkpoint(tmp_path: Path) -> None:
    path = tmp_path / "study.json"
    whole = estimator_study(SMALL, methods=METHODS, trials=2)

    def interrupt(fraction: float, _: str) -> None:
        if fraction > 0.5:
            raise KeyboardInterrupt

    part = estimator_study(SMALL, methods=METHODS, trials=2, checkpoint=path, progress=interrupt)
    assert not part.complete
    assert part.results == whole.results[:1]
    assert len(json.loads(path.read_text().splitlines()[0])["done"]) == 1
    steps: list[str] = []
    again = estimator_study(
        SMALL, methods=METHODS, trials=2, checkpoint=path, progress=lambda _, step: steps.append(step)
    )
    assert again == whole
    assert steps
    assert all(step.startswith("SNR = 10 dB") for step in steps)
    assert [entry.name for entry in tmp_path.iterdir()] == ["study.json"]
    with pytest.raises(InputError, match="was made with"):
        estimator_study(SMALL, methods=METHODS, trials=3, checkpoint=path)
    head, *cases, _ = path.read_text().splitlines(keepends=True)
    write_signed(path, [head.replace('"trials": 2', '"trials": 3'), *cases])
    with pytest.raises(InputError, match="claims other settings than its own cases have"):
        estimator_study(SMALL, methods=METHODS, trials=3, checkpoint=path)
    for damaged in (place for place in range(0, path.stat().st_size, 97)):
        text = bytearray(path.read_bytes())
        text[damaged] ^= 1
        other = tmp_path / "damaged"
        other.write_bytes(text)
        with pytest.raises(InputError, match=r"damaged|start again"):
            estimator_study(SMALL, methods=METHODS, trials=2, checkpoint=other)
    path.write_text('{"settings": 1}')
    with pytest.raises(InputError, match="not a checkpoint"):
        estimator_study(SMALL, methods=METHODS, trials=2, checkpoint=path)
    assert [cell.method for cell in whole.results[0].cells] == ["wigner", "hilbert"]
    assert len(study_text(whole, "csv").splitlines()) == 1 + len(whole.rows())
    assert study_text(whole, "markdown").count("\n") == 4


def cell(method: str, *errors: float) -> object:
    return cell_of(method, 30.0, [Trial(e * e, e, None, 5) for e in errors], {(5, 3): 0.01})


def test_a_tie_is_a_matter_of_the_uncertainty() -> None:
    best, near, far = cell("a", 0.010, 0.012), cell("b", 0.011, 0.013), cell("c", 0.030, 0.031)
    refused = cell_of("d", 30.0, [Trial(reason="too short")], {})
    result = CaseResult(Case(), (best, near, far, refused))  # type: ignore[arg-type]
    assert [item.method for item in result.tied()] == ["a", "b"]
    row = row_of(result)
    assert (row["best"], row["as good"], row["its bound"]) == ("a", "b", "-")
    assert result.of("d") is refused
