"""The folder in which the cases run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.faults.catalogue import WARM
from tests.faults.samples import write_samples
from tests.faults.trial import tried


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The samples, shared: a case that changes them fails, and its successors see what it did."""
    made = tmp_path_factory.mktemp("faults")
    write_samples(made)
    for case in WARM:
        tried(case, made)
    return made
