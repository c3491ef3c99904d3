"""Generated code, run: the same numbers as the expansion it came from, and times with their spread."""

from pathlib import Path

import numpy as np
import pytest

from ridgeback.compare.binding import compiled_code
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.compiled_code import compiled, compiler
from ridgeback.compare.binding.generated_code import python_module
from ridgeback.compare.report.summary import _cost_card
from ridgeback.compare.study.timing import timings
from ridgeback.reports.text.tables import timing_table
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find

EXPANSION = lindstedt(find("pendulum").with_parameters({"k": "12.566370614359172"}), 8)
PEAKS = np.linspace(0.01, 2.0, 57)


def test_the_generated_module_is_the_expansion():
    np.testing.assert_allclose(python_module(EXPANSION).omega0(PEAKS), EXPANSION(PEAKS), rtol=1e-14)


@pytest.mark.skipif(compiler() is None, reason="no C compiler on this machine")
def test_the_compiled_function_is_the_generated_module():
    with compiled(EXPANSION) as native:
        np.testing.assert_array_equal(native(PEAKS), python_module(EXPANSION).omega0(PEAKS))


def fake(folder: Path, script: str) -> str:
    path = folder / "cc"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return str(path)


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        (None, "there is no C compiler"),
        ("exit 1", "the C compiler failed"),
        ("sleep 60 & sleep 60", "did not finish within 0.2 s"),
        ('while [ "$1" != -o ]; do shift; done; echo none > "$2"', "does not serve for compiled code"),
        ("exit 0", "does not serve for compiled code"),
    ],
)
def test_no_fault_of_the_compiler_costs_more_than_its_timing(script, reason, tmp_path, monkeypatch):
    found = None if script is None else fake(tmp_path, script)
    monkeypatch.setattr(compiled_code, "compiler", lambda: found)
    monkeypatch.setattr(compiled_code, "PATIENCE", 0.2)
    first, *others = timings(EXPANSION, bind(find("pendulum")), upper=2.0, pendulum=True, values=16)
    assert first.name == "generated C"
    assert np.isnan(first.nanoseconds)
    assert reason in first.note
    assert all(item.nanoseconds > 0 for item in others)
    assert "generated Python" in _cost_card((first, *others)).text + _cost_card((first, *others)).value
    row = timing_table((first, *others)).rows[0]
    assert "nan" not in row.cells
    assert reason in row.remark


def test_a_temporary_folder_that_cannot_be_written_costs_no_more(monkeypatch):
    def full(**_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(compiled_code, "compiler", lambda: "/bin/true")
    monkeypatch.setattr(compiled_code, "TemporaryDirectory", full)
    with compiled(EXPANSION) as native:
        assert isinstance(native, compiled_code.NotCompiled)
        assert "Permission denied" in native.reason


def test_timings_cover_every_way_and_bracket_their_median():
    found = timings(EXPANSION, bind(find("pendulum")), upper=2.0, pendulum=True, values=64)
    names = [item.name for item in found]
    assert "closed form (agm)" in names
    assert "series (14), 3 terms" in names
    assert "generated Python, NumPy array" in names
    for item in found[compiler() is None :]:
        assert 0 < item.low <= item.nanoseconds <= item.high
        assert item.values == 64


def test_a_limit_cycle_has_no_closed_form_to_time():
    found = timings(lindstedt(find("van-der-pol"), 4), bind(find("van-der-pol")), upper=1.0, pendulum=False, values=16)
    assert not any("closed" in item.name or "series" in item.name for item in found)
