"""``estimate --method model-fit``: fitted parameters with deviations, and what does not go together."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ridgeback.numeric.motion.dynamics import duffing
from ridgeback.numeric.motion.trajectory import integrate

Ridgeback = Callable[..., Any]  # the fixture of conftest.py
EQUATION = "u'' + 2*mu*u' + k**2*u + eps*u**3 = 0"


@pytest.fixture(scope="module")
def decay(tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = integrate(duffing(k=3.0, eps=2.0, mu=0.05), (1.5, 0.0), duration=20.0, rate=8.0)
    u = run.u + 0.02 * np.random.default_rng(1).standard_normal(run.u.size)
    path = tmp_path_factory.mktemp("model") / "run.csv"
    rows = zip(run.time.tolist(), u.tolist(), strict=True)
    path.write_text("t,u\n" + "".join(f"{a!r},{b!r}\n" for a, b in rows))
    return path


def test_parameters_are_found_with_their_deviations(ridgeback: Ridgeback, decay: Path) -> None:
    words = ["--method", "model-fit", "--equation", EQUATION, "--set", "k=2.5", "--free", "k,eps,mu"]
    done = ridgeback("estimate", str(decay), *words, "--format", "json")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    assert found["method"] == "model-fit"
    for name, true in (("k", 3.0), ("eps", 2.0), ("mu", 0.05)):
        assert abs(found["settings"][name] - true) < 5 * found["settings"][f"{name}_sd"] < 0.2
    assert found["settings"]["residual_white"] is True
    assert len(found["track"]) == 161


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--system pendulum", "belong to --method model-fit"),
        ("--method model-fit", "name it by --system or --equation"),
        ("--method model-fit --free k", "name the oscillator"),
        ("--method model-fit --system pendulum --lag 2", "has no use for --lag"),
        ("--method model-fit --system pendulum --free k,g", "no parameter g to be freed"),
        ("--method model-fit --system pendulum --free k;mu", "not the name of a parameter"),
        ("--method model-fit --system nothing", "nothing"),
    ],
)
def test_refusals(ridgeback: Ridgeback, decay: Path, words: str, message: str) -> None:
    done = ridgeback("estimate", str(decay), *words.split())
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1


@pytest.mark.parametrize("style", ["text", "json", "csv"])
def test_a_misfit_is_said_and_not_certified(ridgeback: Ridgeback, decay: Path, style: str) -> None:
    """A linear oscillator cannot have made a hardening decay: the results are printed, the exit code is 3."""
    words = ["--method", "model-fit", "--equation", "u'' + 2*mu*u' + k**2*u = 0", "--set", "k=3.5", "--free", "k,mu"]
    done = ridgeback("estimate", str(decay), *words, "--format", style)
    assert done.code == 3
    said = [line for line in done.err.splitlines() if line.startswith("ridgeback: run.csv, u: Misfit: ")]
    assert said == done.err.splitlines()[-1:]
    assert ("frequency, Hz" if style == "text" else "omega_rad_s") in done.out
    if style == "json":
        found = json.loads(done.out)
        assert any(note.startswith("Misfit: ") for note in found["notes"])
        assert found["settings"]["residual_white"] is False
    assert ("Misfit: " in done.out) is (style != "csv")
