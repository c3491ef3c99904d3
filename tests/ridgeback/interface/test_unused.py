"""From Python too: what was said either counts or is refused by its name."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import ridgeback
from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.interface.signals import as_recording

TIME = np.arange(400) / 20.0
DECAY = np.exp(-0.05 * TIME) * np.cos(6.0 * TIME)
RECORDING = as_recording(DECAY, 20.0)
SERIES = ridgeback.derive("pendulum", 2)
PLAN = plan_of(
    "study.ask = 'error'\ngrid = {orders = 2, amplitudes = 0.5, methods = 'lindstedt'}\n"
    "[[oscillator]]\nsystem = 'pendulum'"
)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: ridgeback.estimate(RECORDING, detrend="linear"), "detrend"),
        (lambda: ridgeback.estimate(DECAY, 20.0, method="hilbert", smoothing_seconds=1.0), "smoothing_seconds"),
        (lambda: ridgeback.estimate(DECAY, 20.0, method="wigner", lag_window="hann"), "lag_window"),
        (lambda: ridgeback.backbone(DECAY, 20.0, method="half-cycles", window_seconds=3.0), "window_seconds"),
        (lambda: ridgeback.backbone(DECAY, 20.0, track=ridgeback.estimate(DECAY, 20.0), method="wigner"), "method"),
        (lambda: ridgeback.backbone(DECAY, 20.0, track=ridgeback.estimate(DECAY, 20.0), band=(1.0, 9.0)), "band"),
        (lambda: ridgeback.derive("damped-pendulum", 2, weight=3, weights={"mu": 2}), "weight 3"),
        (lambda: ridgeback.generate(SERIES, amplitude="trough"), "amplitude"),
        (lambda: ridgeback.generate("pendulum", oscillator="duffing"), "oscillator"),
        (lambda: ridgeback.generate("pendulum", order=2, degrees=(1, 1)), "degrees"),
        (lambda: ridgeback.generate("pendulum", order=2, resummed="pade", growth=Fraction(1)), "growth"),
        (lambda: ridgeback.generate("pendulum", order=2, resummed="agm", terms=4), "terms"),
        (lambda: ridgeback.report(recording=RECORDING, parameters={"k": 2}), "parameters"),
        (lambda: ridgeback.generate("damped-pendulum", order=2, resummed="pade"), "resummed"),
        (lambda: ridgeback.simulate("pendulum", rtol=1e-9, method="taylor"), "rtol"),
    ],
)
def test_an_argument_without_a_meaning_is_refused(call: Callable[[], object], name: str) -> None:
    with pytest.raises(ridgeback.InputError, match=rf"\b{name}\b.*(leave|without)"):
        call()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: ridgeback.simulate("pendulum", digits=20, method="DOP853"), "digits belong to method 'taylor'"),
        (lambda: ridgeback.simulate(ridgeback.bind("pendulum")), "no initial state of its own"),
        (
            lambda: ridgeback.simulate(ridgeback.bind("pendulum"), (1.0, 0.0), method="heyoka"),
            "give the oscillator itself",
        ),
        (lambda: ridgeback.estimate("run.csv", time=TIME), "run.csv has times of its own; leave time out"),
        (lambda: ridgeback.study("pendulum", (2,), None), "a study needs amplitudes"),
        (lambda: ridgeback.run_study(PLAN), "needs the path of a store"),
        (
            lambda: ridgeback.run_study(PLAN, store="s.db", overrides={"orders": 2}),
            "overrides belong to a study from a file",
        ),
    ],
)
def test_what_lacks_something_or_has_too_much_is_refused(call: Callable[[], object], said: str) -> None:
    with pytest.raises(ridgeback.InputError, match=said) as refused:
        call()
    assert "\n" not in str(refused.value)


def test_a_plan_of_no_file_is_run_in_the_store_that_is_named(tmp_path: Path) -> None:
    found = ridgeback.run_study(PLAN, store=tmp_path / "s.db")
    (row,) = ridgeback.study("pendulum", (2,), [0.5]).relative_error
    assert [cell["relative_error"] for cell in found.rows()] == list(row)
