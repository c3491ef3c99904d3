"""From Python too: what was said either counts or is refused by its name."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

import ridgeback
from ridgeback.interface.signals import as_recording

TIME = np.arange(400) / 20.0
DECAY = np.exp(-0.05 * TIME) * np.cos(6.0 * TIME)
RECORDING = as_recording(DECAY, 20.0)
SERIES = ridgeback.derive("pendulum", 2)


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
        (lambda: ridgeback.generate("damped-pendulum", order=2, motion=True), "motion"),
        (lambda: ridgeback.report(recording=RECORDING, parameters={"k": 2}), "parameters"),
    ],
)
def test_an_argument_without_a_meaning_is_refused(call: Callable[[], object], name: str) -> None:
    with pytest.raises(ridgeback.InputError, match=rf"\b{name}\b.*(leave|without)"):
        call()
