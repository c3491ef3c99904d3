"""Fourier coefficients along a decay, between Chebyshev points, against those computed orbit by orbit."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.orbits import waveform
from ridgeback.symbolic.systems.catalogue import find


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("pendulum", 2.07, 0.95 * np.pi),
        ("helmholtz-duffing", 0.2, 0.5),
        ("bilinear", 0.5, 1.0),
        ("duffing-hardening", 1.0, 1.0),
    ],
)
def test_interpolated_coefficients_are_those_of_each_orbit(name: str, low: float, high: float) -> None:
    dynamics = bind(find(name))
    peaks = np.linspace(low, high, 300)
    found = waveform.harmonics_along(dynamics, peaks, count=5).cosine
    some = slice(None, None, 37)
    direct = waveform.orbit_harmonics(dynamics, peaks[some], count=5).cosine
    assert found.shape == (6, 300)
    np.testing.assert_allclose(found[:, some], direct, rtol=0, atol=3e-12 * high)


def test_few_points_suffice_and_are_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []
    real = waveform.orbit_harmonics

    def counted(dynamics: object, peak: np.ndarray, *, count: int) -> waveform.OrbitHarmonics:
        asked.append(np.size(peak))
        return real(dynamics, peak, count=count)  # type: ignore[arg-type]

    monkeypatch.setattr(waveform, "orbit_harmonics", counted)
    waveform.harmonics_along(bind(find("duffing-hardening")), np.linspace(0.5, 1.0, 1000), count=5)
    assert sum(asked) < 100
