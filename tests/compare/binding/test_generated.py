"""Generated code, run: the same numbers as the expansion it came from, and times with their spread."""

from pathlib import Path

import numpy as np
import pytest

from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.generated_code import compiled, compiler, python_module
from ridgeback.compare.study.timing import timings
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find

EXPANSION = lindstedt(find("pendulum").with_parameters({"k": "12.566370614359172"}), 8)
PEAKS = np.linspace(0.01, 2.0, 57)


def test_the_generated_module_is_the_expansion():
    with python_module(EXPANSION) as module:
        np.testing.assert_allclose(module.omega0(PEAKS), EXPANSION(PEAKS), rtol=1e-14)


@pytest.mark.skipif(compiler() is None, reason="no C compiler on this machine")
def test_the_compiled_function_is_the_generated_module(tmp_path: Path):
    native = compiled(EXPANSION, tmp_path)
    with python_module(EXPANSION) as module:
        np.testing.assert_array_equal(native(PEAKS), module.omega0(PEAKS))


def test_timings_cover_every_way_and_bracket_their_median():
    found = timings(EXPANSION, bind(find("pendulum")), upper=2.0, pendulum=True, values=64)
    names = [item.name for item in found]
    assert "closed form (agm)" in names
    assert "series (14), 3 terms" in names
    assert "generated Python, NumPy array" in names
    for item in found:
        assert 0 < item.low <= item.nanoseconds <= item.high
        assert item.values == 64


def test_a_limit_cycle_has_no_closed_form_to_time():
    found = timings(lindstedt(find("van-der-pol"), 4), bind(find("van-der-pol")), upper=1.0, pendulum=False, values=16)
    assert not any("closed" in item.name or "series" in item.name for item in found)
