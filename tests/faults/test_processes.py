"""The cases that need a process of their own: environment, streams, limits, disks, workers."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.faults.catalogue import BY_BASH
from tests.faults.trial import Case, faults, tried


@pytest.mark.parametrize("case", BY_BASH, ids=lambda case: case.command)
def test_a_fault_is_handled(case: Case, folder: Path) -> None:
    assert faults(case, tried(case, folder)) == ()
