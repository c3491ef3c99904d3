"""Estimators of other packages: found by their entry point, their faults their own."""

from __future__ import annotations

from importlib.metadata import EntryPoint, EntryPoints

import numpy as np
import pytest

from ridgeback.common import plugins as common
from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.ways import outsiders as home
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.tracking.track import Track


def mine(x: Array, rate: float) -> Track:
    return estimate(x, rate, method="zero-crossing", bias=False)


def broken(x: Array, rate: float) -> Track:
    raise RuntimeError(f"{x.size} samples at {rate}")


def wrong(_: Array, rate: float) -> float:
    return rate


@pytest.fixture(autouse=True)
def installed(monkeypatch: pytest.MonkeyPatch) -> None:
    names = {"mine": "mine", "broken": "broken", "wrong": "wrong", "wigner": "mine", "gone": "nowhere"}
    entries = [EntryPoint(name, f"{__name__}:{value}", home.GROUP) for name, value in names.items()]
    functions = {"mine": mine, "broken": broken, "wrong": wrong}

    def load(self: EntryPoint) -> object:
        return functions[self.value.partition(":")[2]]

    monkeypatch.setattr(EntryPoint, "load", load)
    monkeypatch.setattr(common, "entry_points", lambda group: EntryPoints(entries) if group == home.GROUP else ())


def test_they_are_found_by_name_and_ours_keep_theirs() -> None:
    assert list(home.outsiders()) == ["broken", "gone", "mine", "wrong"]


def test_one_takes_part_with_the_same_values() -> None:
    x = np.cos(np.arange(400) / 5.0)
    assert np.array_equal(home.outsiders()["mine"](x, 5.0).omega, mine(x, 5.0).omega)


@pytest.mark.parametrize(
    ("name", "said"),
    [("broken", "raised RuntimeError: 9 samples at 2.0"), ("wrong", "returned a float"), ("gone", "raised KeyError")],
)
def test_what_goes_wrong_in_one_is_its_reason(name: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        home.outsiders()[name](np.zeros(9), 2.0)
