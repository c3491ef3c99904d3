"""What takes long says how far it is: every public function but those that are quick, from nought towards one."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

import ridgeback
from ridgeback.public import PUBLIC

QUICK = {
    *("oscillator", "bind"),  # an equation is parsed
    "energy_terms",  # one quadrature along a trajectory that is there
    "components",  # one integration, and a sum over each cycle
    *("fixed_points", "cycle_series", "frequency_series"),  # algebra on a flow that is there
    *("read_recording", "read_recordings", "recordings_from_arrays"),  # a million rows in about two seconds
    "sample",  # one integration or a closed form
    "ridge",  # one search along a plane that is there
}
T = np.arange(640) / 32.0
X = 2.0 * np.exp(-0.05 * T) * np.cos(2.5 * np.pi * T)
PLANES: dict[str, Callable[..., object]] = {
    "wigner": lambda progress: ridgeback.wigner(X, 32.0, progress=progress),
    "pseudo_wigner": lambda progress: ridgeback.pseudo_wigner(X, 32.0, lag_seconds=4.0, progress=progress),
    "smoothed_pseudo_wigner": lambda progress: ridgeback.smoothed_pseudo_wigner(
        X, 32.0, lag_seconds=4.0, smoothing_seconds=1.0, progress=progress
    ),
    "polynomial_wigner": lambda progress: ridgeback.polynomial_wigner(X, 32.0, lag_seconds=4.0, progress=progress),
    "cross_wigner": lambda progress: ridgeback.cross_wigner(X, X, 32.0, progress=progress),
    "spectrogram": lambda progress: ridgeback.spectrogram(X, 32.0, window_seconds=4.0, progress=progress),
    "reassigned_spectrogram": lambda progress: ridgeback.reassigned_spectrogram(
        X, 32.0, window_seconds=4.0, progress=progress
    ),
    "synchrosqueezed_spectrogram": lambda progress: ridgeback.synchrosqueezed_spectrogram(
        X, 32.0, window_seconds=4.0, progress=progress
    ),
}
SERIES = ridgeback.lindstedt("pendulum", 8)
WORK: dict[str, Callable[..., object]] = {
    **PLANES,
    "energy_integral": lambda progress: ridgeback.energy_integral("pendulum", 8, progress=progress),
    "enclose": lambda progress: ridgeback.enclose("pendulum", 1, progress=progress),
    "exact_frequency": lambda progress: ridgeback.exact_frequency("relativistic", 1, bits=64, progress=progress),
    "limit_cycles": lambda progress: ridgeback.limit_cycles("van-der-pol", bits=64, progress=progress),
    "certify": lambda progress: ridgeback.certify("pendulum", SERIES, progress=progress),
    "certified_frequencies": lambda progress: ridgeback.certified_frequencies(
        "pendulum", SERIES, [Fraction(1, 2), Fraction(1)], progress=progress
    ),
    "resum": lambda progress: ridgeback.resum("pendulum", SERIES, "pade", progress=progress),
    "limits": lambda progress: ridgeback.limits("pendulum", SERIES, progress=progress),
    "periodic_orbit": lambda progress: ridgeback.periodic_orbit("van-der-pol", progress=progress),
    "precise_orbit": lambda progress: ridgeback.precise_orbit("van-der-pol", digits=15, progress=progress),
    "half_cycles": lambda progress: ridgeback.half_cycles(X, 32.0, progress=progress),
}


def test_every_public_function_that_is_not_quick_takes_a_callback() -> None:
    functions = [entry.name for entry in PUBLIC if inspect.isfunction(getattr(ridgeback, entry.name))]
    without = {name for name in functions if "progress" not in inspect.signature(getattr(ridgeback, name)).parameters}
    assert without == QUICK


@pytest.mark.parametrize("name", WORK)
def test_shares_begin_at_nought_and_never_fall(name: str) -> None:
    told: list[tuple[float, str]] = []
    WORK[name](lambda share, step: told.append((share, step)))
    shares = [share for share, _ in told]
    assert shares
    assert shares == sorted(shares)
    assert 0.0 <= shares[0] <= shares[-1] <= 1.0
    assert all(step.strip() and "\n" not in step for _, step in told)


@pytest.mark.parametrize("name", PLANES)
def test_who_looks_on_changes_nothing(name: str) -> None:
    watched, alone = PLANES[name](lambda *_: None), PLANES[name](None)
    np.testing.assert_array_equal(watched.values, alone.values)
