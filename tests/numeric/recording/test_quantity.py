"""Displacements from velocities and accelerations: against derivatives in closed form, and of a Duffing oscillator."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import measure
from ridgeback.numeric.recording.quantity import as_displacement
from ridgeback.numeric.recording.reading import read_recording
from ridgeback.numeric.recording.recording import Recording

RATE = 25.0
T = np.arange(500) / RATE


@pytest.mark.parametrize(("quantity", "order"), [("displacement", 0), ("velocity", 1), ("acceleration", 2)])
def test_harmonics_are_divided_each_by_its_own_frequency(quantity: str, order: int) -> None:
    rates = np.array([-0.05 + 8j, -0.15 + 24j])
    waves = np.array([1.0, 0.1])[:, None] * np.exp(np.multiply.outer(rates, T))
    measured = (rates[:, None] ** order * waves).real.sum(axis=0)
    found = as_displacement(Recording.from_arrays(measured, RATE), quantity)
    truth = waves.real.sum(axis=0)
    assert np.abs(found.values - truth)[10:-10].max() < 2e-3


def test_the_acceleration_of_a_duffing_oscillator_gives_its_backbone_and_damping() -> None:
    k, eps, mu = 4 * np.pi, 60.0, 0.05

    def force(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return np.asarray(-2 * mu * v - k**2 * u - eps * u**3)

    run = solve_ivp(lambda _, y: (y[1], force(y[0], y[1])), (0, T[-1]), (1.0, 0.0), t_eval=T, rtol=1e-10, atol=1e-10)
    noise = 0.05 * np.random.default_rng(1).normal(size=T.size)
    found = measure(as_displacement(Recording.from_arrays(force(*run.y) + noise, RATE), "acceleration"))
    curve = found.backbone
    assert curve is not None
    a = curve.curve_amplitude
    assert a[-1] == pytest.approx(0.98, abs=0.02)
    expected = k + 3 * eps * a**2 / (8 * k) - 15 * eps**2 * a**4 / (256 * k**3)
    assert np.abs(curve.curve_omega / expected - 1.0)[a < 0.6].max() < 2e-4
    assert abs(curve.curve_growth_rate[0] + mu) < 1.5e-3


def test_another_quantity_is_refused() -> None:
    with pytest.raises(InputError, match="'jerk' is unknown; use one of displacement, velocity, acceleration"):
        as_displacement(Recording.from_arrays(np.cos(8 * T), RATE), "jerk")


def test_degrees_are_believed(tmp_path: Path) -> None:
    rows = "".join(f"{t},{20 * np.cos(8 * t)}\n" for t in T)
    (tmp_path / "stated.csv").write_text("t,angle [deg]\n" + rows)
    (tmp_path / "bare.csv").write_text("t,angle\n" + rows)
    stated, given = read_recording(tmp_path / "stated.csv"), read_recording(tmp_path / "bare.csv", unit="deg")
    for found in (stated, given):
        assert found.units == "rad"
        assert np.abs(found.values - np.radians(20) * np.cos(8 * T)).max() < 1e-12
        assert any("angles in deg were converted to rad" in note for note in found.notes)
