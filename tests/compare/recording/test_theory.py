"""A named oscillator's backbone over a measured one: the right one agrees, a wrong one differs, none is said to be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ridgeback.compare.recording.measurement import measure
from ridgeback.compare.recording.theory import Agreement, MeasuredCurve, exact_at, over_curve, over_measured
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.catalogue import find

RATE = 32.0


@pytest.fixture(scope="module")
def measured():
    """A cosine of 2 rad/s with a little seeded noise, decaying slowly: linear with k = 2."""
    time = np.arange(2400) / RATE
    noise = np.random.default_rng(5).normal(scale=2e-3, size=time.size)
    x = np.exp(-0.01 * time) * np.cos(2.0 * time) + noise
    return backbone(estimate(x, RATE, method="harmonic-least-squares"), x, RATE)


def test_the_right_oscillator_agrees_and_a_wrong_one_differs(measured):
    right = over_measured(find("linear").with_parameters({"k": "2"}), measured)
    wrong = over_measured(find("linear").with_parameters({"k": "2.1"}), measured)
    assert right.agreement is Agreement.AGREES
    assert "% of records: they agree" in right.sentence()
    assert wrong.agreement is Agreement.DIFFERS
    assert wrong.mean == pytest.approx(2 / 2.1 - 1, abs=1e-4)
    assert "they differ" in wrong.sentence()


def test_where_no_deviation_is_known_nothing_is_judged(measured):
    found = over_measured(find("linear").with_parameters({"k": "2.1"}), measured, known=False)
    assert found.agreement is Agreement.UNTOLD
    assert found.mean == pytest.approx(2 / 2.1 - 1, abs=1e-4)
    assert "deviations" not in found.sentence()
    assert "differ" not in found.sentence()


def test_a_theory_that_has_no_such_orbits_says_so(measured):
    """The softening Duffing oscillator with a weak spring has its separatrix far below the measured amplitudes."""
    small = find("duffing-softening").with_parameters({"k": "2", "eps": "-400"})
    found = over_measured(small, measured)
    assert found.agreement is Agreement.UNCOVERED
    assert "at none of the measured amplitudes" in found.sentence()


def test_the_pendulum_at_its_fundamental_amplitude():
    """omega0 = 1 - a^2/16 + a^4/1024 with the amplitude of the first harmonic."""
    omega, inside = exact_at(find("pendulum"), np.array([0.2, 0.5]))
    expected = 1 - np.array([0.2, 0.5]) ** 2 / 16 + np.array([0.2, 0.5]) ** 4 / 1024
    assert inside.all()
    np.testing.assert_allclose(omega, expected, atol=2e-5)


def test_a_curve_that_crosses_the_measured_one_does_not_agree():
    """The mean of the differences is 0, each of them ten deviations."""
    amplitude = np.linspace(0.1, 1.0, 10)
    omega = 2.0 + 0.02 * np.sign(amplitude - 0.55)
    curve = MeasuredCurve(amplitude, omega, np.full(10, 0.002), np.zeros(10))
    found = over_curve(find("linear").with_parameters({"k": "2"}), curve)
    assert found.mean == pytest.approx(0.0, abs=1e-12)
    assert found.deviations == pytest.approx(10.0)
    assert found.agreement is Agreement.DIFFERS


def test_a_pendulum_in_degrees_is_told_from_one_in_radians(measured):
    pendulum = find("pendulum").with_parameters({"k": "2"})
    degrees = replace(measured, curve_amplitude=2.0 * measured.curve_amplitude / measured.curve_amplitude.max())
    assert over_measured(pendulum, degrees).sentence().endswith("they differ; an angle in degrees needs --unit deg.")
    assert "--unit" not in over_measured(pendulum, replace(degrees, units="rad")).sentence()
    assert "--unit" not in over_measured(pendulum.with_parameters({"k": "3"}), degrees).sentence()


def test_heavy_losses_do_not_make_the_right_oscillator_differ():
    """Five per cent of damping lowers the frequency by 0.12 %, seven deviations of the measured one."""
    rng, apart = np.random.default_rng(8), []
    time = np.arange(300) / 4.0
    for _ in range(4):
        decay = np.exp(-0.05 * time) * np.cos(np.sqrt(1 - 0.05**2) * time + rng.uniform(0, 6.0))
        curve = measure(Recording.from_arrays(decay + 0.003 * rng.normal(size=time.size), 4.0)).backbone
        apart.append(over_measured(find("linear"), curve))
    assert all(one.agreement is Agreement.AGREES for one in apart)
    assert all(abs(one.mean) < 4e-4 for one in apart)


def test_the_chance_of_a_distance_is_that_of_as_many_values_as_are_independent():
    """1.5 deviations everywhere: of one value in 13 %, of sixteen independent ones in 0.3 % of records."""
    n = np.ones(16)
    curve = MeasuredCurve(0.1 * np.arange(1, 17), 2.003 * n, 0.002 * n, 0.0 * n)
    linear = find("linear").with_parameters({"k": "2"})
    one, many = over_curve(linear, curve), over_curve(linear, replace(curve, independent=16.0))
    assert one.chance == pytest.approx(0.1336, abs=1e-4)
    assert one.agreement is Agreement.AGREES
    assert many.chance == pytest.approx(0.0029, abs=1e-4)
    assert many.agreement is Agreement.DIFFERS
