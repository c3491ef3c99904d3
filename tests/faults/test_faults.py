"""Every case of the catalogue: the right exit code, one line that names what and where, and nothing lost."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import pytest

from tests.faults.catalogue import CASES, IN_PROCESS
from tests.faults.trial import Case, Outcome, changes, faults, snapshot, tried


@pytest.fixture(scope="module", autouse=True)
def _loaded() -> None:
    """Load what the verbs need beforehand: importing SciPy is no time that a case takes."""
    for needed in ("interface.benchmark", "interface.identify", "interface.report", "compare.study.study"):
        import_module(f"ridgeback.{needed}")


@pytest.mark.parametrize("case", IN_PROCESS, ids=lambda case: case.command)
def test_a_fault_is_handled(case: Case, folder: Path) -> None:
    assert faults(case, tried(case, folder)) == ()


def test_there_are_enough() -> None:
    assert len(CASES) >= 300
    assert len({(case.command, tuple(case.environment.items())) for case in CASES}) == len(CASES)


def test_the_judge_sees(tmp_path: Path) -> None:
    """Each thing that may be wrong is found."""
    refusal = Case("derive x", 2, ("x",))
    well = Outcome(2, "", "ridgeback: no x\n", 0.1, ())
    assert faults(refusal, well) == ()
    bad = Outcome(70, "rows", "Traceback\n\x1b[31m\n", 3.0, ("decay.csv",))
    assert len(faults(refusal, bad)) == 9
    before = snapshot(tmp_path)
    (tmp_path / ".run.csv.1.part").touch()
    assert changes(before, snapshot(tmp_path)) == (".run.csv.1.part",)
