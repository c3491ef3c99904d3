"""Sample recordings: made the same each time, read back the same, and measured as they were made."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import ridgeback
from ridgeback.compare.recording.samples import NAMES, sample
from ridgeback.verbs.sample import command


@pytest.mark.parametrize("name", NAMES)
def test_a_saved_sample_is_read_back_the_same(name: str, tmp_path: Path) -> None:
    found = sample(name)
    assert found.csv() == sample(name).csv()
    read = ridgeback.read_recording(str(found.save(tmp_path / "sample.csv")))
    np.testing.assert_array_equal(read.values, found.recording.values)
    np.testing.assert_array_equal(read.time, found.recording.time)
    assert (read.units, read.name) == (found.recording.units, found.recording.name)


def test_the_command_knows_the_samples() -> None:
    assert tuple(command.params[0].type.choices) == NAMES  # type: ignore[attr-defined]


def test_the_decay_solves_its_equations() -> None:
    """Its closed form against the integrated equations of amplitude and phase."""
    found = sample("decay")
    w, c, mu, nu = (found.parameters[key] for key in ("w", "c", "mu", "nu"))
    time = found.recording.time
    run = solve_ivp(
        lambda _, y: [-y[0] * (mu + nu * y[0] ** 2), w + c * y[0] ** 2],
        (0.0, time[-1]),
        [5.0, 0.0],
        t_eval=time,
        rtol=1e-11,
        atol=1e-12,
    )
    a, phase = run.y
    clean = a * np.cos(phase) + 0.01 * a**2 * np.cos(2 * phase) + 0.001 * a**3 * np.cos(3 * phase)
    np.testing.assert_allclose(found.amplitude, a, rtol=1e-9)
    np.testing.assert_allclose(found.omega, w + c * a**2, rtol=1e-9)
    np.testing.assert_allclose(np.gradient(np.log(a), time)[5:-5], found.growth_rate[5:-5], rtol=1e-4)
    assert np.std(found.values - clean) == pytest.approx(0.02, rel=0.05)


def test_the_pendulum_is_measured_as_it_was_made() -> None:
    """The truth against the exact frequency on the averaged action, and the measured backbone against the truth."""
    found = sample("pendulum")
    k, mu = found.parameters["k"], found.parameters["mu"]
    start = math.radians(found.parameters["start_deg"])
    middle = found.omega.size // 2
    # by averaging dJ/dt = -2 mu J, J of the exact orbit: E - B form of the pendulum's action, by quadrature
    peaks = np.linspace(0.2, start, 400)
    angle = np.linspace(0.0, np.pi / 2, 400)
    u = peaks[:, None] * np.sin(angle)
    speed = np.sqrt(2 * k**2 * np.clip(np.cos(u) - np.cos(peaks)[:, None], 0, None))
    action = np.trapezoid(speed * peaks[:, None] * np.cos(angle), angle, axis=1)
    now = np.interp(action[-1] * math.exp(-2 * mu * found.recording.time[middle]), action, peaks)
    exact = float(ridgeback.bind(ridgeback.oscillator("pendulum")).closed_form(now)) * k
    assert found.omega[middle] == pytest.approx(exact, rel=2e-5)
    curve = ridgeback.backbone(found.recording)
    order = np.argsort(found.amplitude)
    rows = curve.rows()
    at = [row["amplitude"] for row in rows]
    truth = np.interp(at, found.amplitude[order], found.omega[order])
    z = [(row["omega_rad_s"] - w) / row["omega_standard_deviation_rad_s"] for row, w in zip(rows, truth, strict=True)]
    assert np.sqrt(np.mean(np.square(z))) < 2.0


def test_the_hammer_rings_from_the_blow_on() -> None:
    found = sample("hammer")
    before = found.recording.time < found.parameters["blow_s"]
    assert np.isnan(found.omega[before]).all()
    assert np.isfinite(found.omega[~before]).all()
    assert np.std(found.values[before]) == pytest.approx(0.05, rel=0.15)


def test_an_unknown_sample_is_refused_with_those_there_are() -> None:
    with pytest.raises(ridgeback.InputError, match="did you mean pendulum"):
        sample("pendulums")
