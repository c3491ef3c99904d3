"""Order analysis and ripple on signals whose harmonics are known although their frequency moves."""

import numpy as np
import pytest

from ridgeback.compare.motion.harmonics.order_analysis import orders, ripple
from ridgeback.compare.motion.wigner_bias import predicted_bias
from ridgeback.numeric.estimators.estimate import estimate


def chirp(t):
    return 2 * np.pi * (1.0 * t + 0.02 * t**2)


def crossings(cycles):
    """Times at which the phase is -pi/2 + 2 pi n: the cosine rises through zero."""
    phase = (np.arange(1, cycles) - 0.25) * 2 * np.pi
    return (-1 + np.sqrt(1 + 4 * 0.02 * phase / (2 * np.pi))) / 0.04


def test_harmonics_of_a_chirp_are_separated_at_constant_phase():
    def signal(t):
        return np.cos(chirp(t)) + 0.1 * np.cos(3 * chirp(t)) + 0.01 * np.sin(5 * chirp(t)) + 0.3

    found = orders(signal, crossings(30))
    assert found.level_db(3) == pytest.approx(-20, abs=0.05)
    assert found.level_db(5) == pytest.approx(-40, abs=0.05)
    assert found.level_db(2) < -80
    assert found.share[0] / found.share[1] == pytest.approx(2 * 0.3**2, rel=0.05)


def test_ripple_is_counted_per_cycle_although_the_cycle_shortens():
    found = ripple(lambda t: 1 + 0.1 * t + 0.003 * np.cos(2 * chirp(t)), crossings(30))
    assert found.per_cycle == pytest.approx(2.0, abs=0.02)
    assert found.amplitude == pytest.approx(0.003, rel=0.05)


def test_the_curvature_formula_is_met_by_the_wigner_peak_of_a_weakly_curved_chirp():
    t = np.arange(1281) / 64.0
    bend = 0.002
    omega = 2 * np.pi * 1.5 + 0.05 * t + 0.5 * bend * (t - 10) ** 2
    phase = 2 * np.pi * 1.5 * t + 0.025 * t**2 + bend * (t - 10) ** 3 / 6
    track = estimate(np.cos(phase), 64.0, method="wigner", bias=False)
    inside = (t > 6) & (t < 14)
    measured = (track.omega - omega)[inside]
    expected = predicted_bias(t, omega)[inside]
    assert np.mean(measured) == pytest.approx(np.mean(expected), rel=0.1)


def test_rates_between_20_6_and_26_4_fold_the_ninth_and_eleventh_multiple_and_not_the_seventh() -> None:
    """Footnote 3 of the paper: 512 samples in 20 s, 25.6 a second, are among them."""
    from ridgeback.compare.motion.harmonics.folding import folded_sentence, folding
    from ridgeback.compare.motion.harmonics.order_analysis import orders
    from ridgeback.compare.motion.harmonics.overtones import even_sentence, folding_of
    from ridgeback.compare.motion.motion import integrate_motion
    from ridgeback.compare.motion.paper_case import paper_case

    motion = integrate_motion(paper_case(rate=25.6), digits=None)
    levels = orders(lambda t: motion.trajectory.at(t)[1], motion.rising)
    found = folding_of(motion, levels)
    assert (found.folded, found.whole) == ((9, 11), (3, 5, 7))
    assert found.two_fold is not None
    assert [round(rate, 1) for rate in found.two_fold] == [20.6, 26.4]
    said = folded_sentence(found, lambda omega: f"{omega / (2 * np.pi):.3g} Hz")
    assert "multiples 9 and 11 are folded back, 3, 5 and 7 are not. Sampling rates between 20.6 and 26.4" in said
    assert "An odd force has odd multiples only" in even_sentence(motion, levels)
    assert folding((3,), 1.0, 64.0).two_fold is None


def test_leakage_is_no_harmonic_of_an_odd_force() -> None:
    """k = 3, mu = 0.05, 2 rad: the strong decay leaks to even multiples, which an odd force does not have."""
    from ridgeback.compare.motion.harmonics.order_analysis import orders
    from ridgeback.compare.motion.harmonics.overtones import leakage_db, seen
    from ridgeback.compare.motion.motion import integrate_motion, setting
    from ridgeback.symbolic.systems.catalogue import find

    for k, mu, third in (("3", "0.05", True), ("2", "0.05", True), ("3", "0.3", False)):
        system = find("damped-pendulum").with_parameters({"k": k, "mu": mu})
        motion = integrate_motion(setting(system, initial=(2.0, 0.0)), digits=None)
        levels = orders(lambda t, m=motion: m.trajectory.at(t)[0], motion.rising)
        leakage = leakage_db(motion, levels)
        assert leakage is not None
        assert (3 in seen(motion, levels)) is third
        assert all(m % 2 for m in seen(motion, levels))
    helmholtz = setting(find("helmholtz-duffing"), initial=(0.5, 0.0), duration=80.0)
    motion = integrate_motion(helmholtz, digits=None)
    assert 2 in seen(motion, orders(lambda t: motion.trajectory.at(t)[0], motion.rising))


def test_the_wigner_peak_and_the_smoothed_one_part_at_the_kink_of_a_bilinear_oscillator() -> None:
    """Stops with a preload: omega0(t) has a corner where the decay leaves them, as in the appendix of the paper."""
    from ridgeback.compare.motion.estimate_curves import along
    from ridgeback.numeric.motion.bilinear import Bilinear, as_dynamics
    from ridgeback.numeric.motion.bilinear_motion import bilinear_motion
    from ridgeback.numeric.motion.cycle_frequency import cycle_frequency

    stops = Bilinear(2 * np.pi, 4 * np.pi, 1.0, mu=0.03, symmetric=True, preload=6.0)
    run = bilinear_motion(stops, (3.0, 0.0), duration=60.0, rate=24.0)
    reference = cycle_frequency(run, dynamics=as_dynamics(stops)).at(run.time)
    inside = (run.time > 6.0) & (run.time < 54.0)
    assert reference[inside][0] > 1.4 * reference[inside][-1]
    assert reference[inside][-1] == pytest.approx(np.sqrt((2 * np.pi) ** 2 - 0.03**2), rel=1e-6)
    errors = {}
    for method in ("wigner", "smoothed-pseudo-wigner"):
        omega = along(estimate(run.u, run.rate, method=method, bias=False), run.time)
        errors[method] = float(np.sqrt(np.nanmean((omega / reference - 1)[inside] ** 2)))
    assert errors["smoothed-pseudo-wigner"] < 6e-4
    assert errors["wigner"] > 20 * errors["smoothed-pseudo-wigner"]
