"""The list of mutants that change nothing stays true to the code."""

from __future__ import annotations

from tests.mutants.__main__ import ROOT
from tests.mutants.changes import places
from tests.mutants.equivalent import equivalents


def test_every_equivalent_mutant_is_one_of_the_files_and_has_its_reason() -> None:
    known = equivalents()
    files = {name.partition(": ")[0] for name in known}
    found = {mutant.name for file in files for mutant in places(ROOT, ROOT / file)}
    assert sorted(known.keys() - found) == []
    assert all(reason.endswith(".") and len(reason) > 20 for reason in known.values())
