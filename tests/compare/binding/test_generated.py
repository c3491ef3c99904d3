"""Generated code, run: the numbers of the expansion it came from; a compiler that fails is no more than a reason."""

from pathlib import Path

import numpy as np
import pytest

from ridgeback.compare.binding import compiled_code
from ridgeback.compare.binding.compiled_code import compiled, compiler
from ridgeback.compare.binding.generated_code import python_module
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
def test_no_fault_of_the_compiler_is_more_than_a_reason(script, reason, tmp_path, monkeypatch):
    found = None if script is None else fake(tmp_path, script)
    monkeypatch.setattr(compiled_code, "compiler", lambda: found)
    monkeypatch.setattr(compiled_code, "PATIENCE", 0.2)
    with compiled(EXPANSION) as native:
        assert isinstance(native, compiled_code.NotCompiled)
        assert reason in native.reason


def test_a_temporary_folder_that_cannot_be_written_costs_no_more(monkeypatch):
    def full(**_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(compiled_code, "compiler", lambda: "/bin/true")
    monkeypatch.setattr(compiled_code, "TemporaryDirectory", full)
    with compiled(EXPANSION) as native:
        assert isinstance(native, compiled_code.NotCompiled)
        assert "Permission denied" in native.reason
