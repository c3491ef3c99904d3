"""The fit of an oscillator's own equation: sensitivities, parameters within their deviations, the bound, misfits."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.fit import OPERATIONS, ModelFit, model_fit, smooth_model
from ridgeback.numeric.model_fit.problem import EVALUATIONS, Polar, Problem, inverse_normal
from ridgeback.numeric.model_fit.sensitivity import respond, steps_needed
from ridgeback.numeric.model_fit.track import model_track, omega_slopes
from ridgeback.numeric.model_fit.whiteness import whiteness
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import duffing, pendulum, van_der_pol
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.signal import samples

RATE = 16.0


def pendulum_family(k: float = 1.0, mu: float = 0.0) -> Family:
    """k^2 sin u + 2 mu u', written out by hand."""
    return Family(
        "pendulum",
        ("k", "mu"),
        np.array([k, mu]),
        lambda u, v, p: p[0] ** 2 * math.sin(u) + 2 * p[1] * v,
        lambda u, v, p: p[0] ** 2 * np.sin(u) + 2 * p[1] * v,
        lambda u, v, p: (p[0] ** 2 * math.cos(u), 2 * p[1], 2 * p[0] * math.sin(u), 2 * v),
        lambda p: pendulum(k=p[0], mu=p[1]),
    )


def duffing_family() -> Family:
    return Family(
        "duffing",
        ("k", "eps", "mu"),
        np.array([1.0, 0.1, 0.0]),
        lambda u, v, p: p[0] ** 2 * u + p[1] * u**3 + 2 * p[2] * v,
        lambda u, v, p: p[0] ** 2 * u + p[1] * u**3 + 2 * p[2] * v,
        lambda u, v, p: (p[0] ** 2 + 3 * p[1] * u * u, 2 * p[2], 2 * p[0] * u, u**3, 2 * v),
        lambda p: duffing(k=p[0], eps=p[1], mu=p[2]),
    )


def van_der_pol_family() -> Family:
    return Family(
        "van-der-pol",
        ("eps",),
        np.array([1.0]),
        lambda u, v, p: u - p[0] * (1 - u * u) * v,
        lambda u, v, p: u - p[0] * (1 - u * u) * v,
        lambda u, v, p: (1 + 2 * p[0] * u * v, -p[0] * (1 - u * u), -(1 - u * u) * v),
        lambda p: van_der_pol(p[0]),
    )


K, MU, ANGLE = 2 * math.pi, 0.03, 2.0
CLEAN = integrate(pendulum(k=K, mu=MU), (ANGLE, 0.0), duration=10.0, rate=RATE)
TRUE = np.array([ANGLE, 0.0, 0.0, K, MU])


def fitted(noise: float, seed: int, **options: object) -> ModelFit:
    x = CLEAN.u + noise * np.random.default_rng(seed).standard_normal(CLEAN.u.size)
    return model_fit(x, RATE, pendulum_family(), **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("family", "p", "state"),
    [
        (pendulum_family, (2.0, 0.1), (2.5, 0.3)),
        (duffing_family, (1.5, 0.4, 0.05), (1.2, -0.5)),
        (van_der_pol_family, (0.8,), (0.5, 0.0)),
    ],
)
def test_sensitivities_are_derivatives_of_the_solution(
    family: Callable[[], Family], p: tuple[float, ...], state: tuple[float, float]
) -> None:
    """Against central differences of another integrator, and the solution against that integrator itself."""
    values = np.array([*state, *p])

    def solution(theta: np.ndarray) -> np.ndarray:
        return integrate(family().dynamics(theta[2:]), (theta[0], theta[1]), duration=6.0, rate=10.0).u

    run = respond(family(), p, state, samples=61, rate=10.0, steps=4, bound=100.0)
    np.testing.assert_allclose(run.u, solution(values), atol=1e-8)
    for j in range(values.size):
        step = 1e-5 * np.eye(values.size)[j]
        expected = (solution(values + step) - solution(values - step)) / 2e-5
        np.testing.assert_allclose(run.u_by[:, j], expected, atol=3e-6 * max(1.0, np.abs(expected).max()))


def test_observed_order_of_the_steps_is_eight() -> None:
    family, p = pendulum_family(), (2.0, 0.1)
    errors = []
    for steps in (1, 2):
        run = respond(family, p, (2.5, 0.0), samples=21, rate=2.0, steps=steps, bound=100.0)
        errors.append(np.abs(run.u - integrate(family.dynamics(p), (2.5, 0.0), duration=10.0, rate=2.0).u).max())
    assert 6.5 < math.log2(errors[0] / errors[1]) < 9.5


def test_noise_free_samples_give_the_parameters_back() -> None:
    told = list[float]()
    fit = fitted(0.0, 0, progress=lambda share, _: told.append(share))
    assert told[0] == 0.0
    assert np.all(np.diff(told) > 0.0)
    assert told[-1] <= 1.0
    np.testing.assert_allclose(fit.theta, TRUE, atol=1e-7)
    assert fit.noise < 1e-7
    assert not fit.misfit


def test_omega_moves_with_the_state_and_the_parameters_as_that_of_moved_solutions_does() -> None:
    """Twin: the frequency of solutions that begin and pull a little otherwise."""
    fit = fitted(0.0, 0)

    def omega(theta: np.ndarray) -> np.ndarray:
        oscillator = pendulum(k=theta[3], mu=theta[4])
        run = integrate(oscillator, (theta[0], theta[1]), duration=10.0, rate=RATE)
        return cycle_frequency(run, dynamics=oscillator).at(CLEAN.time[40:-40:4])

    run = integrate(fit.dynamics, fit.initial, duration=10.0, rate=RATE)
    found = omega_slopes(fit, run, CLEAN.time[40:-40:4])
    for entry in (0, 3, 4):
        step = 1e-4 * np.eye(5)[entry]
        expected = (omega(fit.theta + step) - omega(fit.theta - step)) / 2e-4
        assert np.abs(found[:, entry] - expected).max() < 1e-2 * np.abs(expected).max()


def test_covariance_is_the_inverse_fisher_matrix() -> None:
    """From finite differences of another integrator; the noise level has its own spread, 1 / sqrt(2 n)."""
    fit = fitted(0.15, 0)

    def samples(theta: np.ndarray) -> np.ndarray:
        run = integrate(pendulum(k=theta[3], mu=theta[4]), (theta[0], theta[1]), duration=10.0, rate=RATE)
        return run.u + theta[2]

    steps = 1e-5 * np.eye(5)
    jacobian = np.stack([(samples(fit.theta + s) - samples(fit.theta - s)) / 2e-5 for s in steps], axis=1)
    expected = fit.noise**2 * np.linalg.inv(jacobian.T @ jacobian)
    np.testing.assert_allclose(fit.covariance, expected, rtol=1e-4, atol=1e-6 * np.abs(expected).max())
    assert abs(fit.noise / 0.15 - 1) < 4 / math.sqrt(2 * CLEAN.u.size)


def test_parameters_and_frequency_lie_within_their_deviations() -> None:
    """Pooled over trials, z-scores have unit size; and omega's rms error is what the Fisher matrix says, its bound."""
    scores, errors, deviations, holds = [], [], [], []
    truth = model_track(fitted(0.0, 0)).omega
    for seed in range(5):
        fit = fitted(0.15, seed)
        scores.append((fit.theta - TRUE) / fit.deviations)
        track = model_track(fit)
        errors.append(np.mean((track.omega / truth - 1) ** 2))
        deviations.append(np.mean((track.standard_deviation / truth) ** 2))  # type: ignore[operator]
        holds.append(track.interval.holds(truth).mean())  # type: ignore[union-attr]
    # 25 scores, correlated in groups of at most 5: the mean square has a deviation of at most sqrt(2 / 5) = 0.63.
    assert 0.2 < float(np.mean(np.square(scores))) < 2.5
    assert 0.4 < math.sqrt(np.mean(errors) / np.mean(deviations)) < 1.8
    assert np.mean(holds) > 0.8
    assert np.sqrt(np.mean(errors)) < 3e-3


def test_an_offset_is_found_or_left_out() -> None:
    x = CLEAN.u + 0.4 + 0.02 * np.random.default_rng(3).standard_normal(CLEAN.u.size)
    free = model_fit(x, RATE, pendulum_family(), start=5.0)
    assert free.offset == pytest.approx(0.4, abs=5 * free.deviations[2])
    assert model_track(free).time[0] == 5.0
    held = fitted(0.02, 3, free_offset=False)
    assert held.offset == 0.0
    assert held.deviations[2] == 0.0


def test_three_parameters_and_a_limit_cycle() -> None:
    run = integrate(duffing(k=3.0, eps=4.0, mu=0.04), (1.5, 0.5), duration=20.0, rate=10.0)
    x = run.u + 0.01 * np.random.default_rng(1).standard_normal(run.u.size)
    fit = model_fit(x, 10.0, duffing_family())
    assert np.all(np.abs(fit.theta - [1.5, 0.5, 0.0, 3.0, 4.0, 0.04]) < 5 * fit.deviations)
    assert fit.parameters == dict(zip(("k", "eps", "mu"), fit.theta[3:].tolist(), strict=True))
    cycle = integrate(van_der_pol(0.7), (2.0, 0.0), duration=40.0, rate=4.0)
    found = model_fit(cycle.u + 0.02 * np.random.default_rng(2).standard_normal(161), 4.0, van_der_pol_family())
    assert abs(found.parameters["eps"] - 0.7) < 5 * found.deviations[3]


def test_the_wrong_oscillator_is_called_a_misfit_and_claims_no_interval() -> None:
    run = integrate(duffing(k=3.0, eps=4.0, mu=0.04), (1.5, 0.0), duration=10.0, rate=10.0)
    x = run.u + 0.01 * np.random.default_rng(1).standard_normal(run.u.size)
    fit = model_fit(x, 10.0, Family(**{**vars(duffing_family()), "names": ("k", "mu"), "start": np.array([3.0, 0.0]),
        "force": lambda u, v, p: p[0] ** 2 * u + 2 * p[1] * v,
        "forces": lambda u, v, p: p[0] ** 2 * u + 2 * p[1] * v,
        "partials": lambda u, v, p: (p[0] ** 2, 2 * p[1], 2 * p[0] * u, 2 * v),
        "dynamics": lambda p: duffing(k=p[0], eps=0.0, mu=p[1])}))  # fmt: skip
    assert fit.misfit
    assert model_track(fit).interval is None


def test_whiteness_has_the_level_that_it_says() -> None:
    rng = np.random.default_rng(7)
    found = np.array([whiteness(rng.standard_normal(300)).probability for _ in range(300)])
    assert abs(np.mean(found < 0.1) - 0.1) < 4 * math.sqrt(0.09 / 300)


def test_what_cannot_be_fitted_is_refused() -> None:
    with pytest.raises(InputError, match="constant"):
        model_fit(np.ones(100), RATE, pendulum_family())
    with pytest.raises(InputError, match="do not go together"):
        estimate(CLEAN.u, RATE, method="model-fit")
    with pytest.raises(InputError, match="do not go together"):
        estimate(CLEAN.u, RATE, method="wigner", family=pendulum_family())
    t = np.arange(80) / 8.0
    with pytest.raises(InputError, match="no fit of eps locks on to the signal"):
        model_fit(np.cos(4.0 * t), 8.0, van_der_pol_family())
    columns = np.stack([t, np.ones(80), t + 1e-13], axis=1)
    with pytest.raises(InputError, match="do not tell k from mu"):
        inverse_normal(columns, ("k", "offset", "mu"))
    with pytest.raises(InputError, match="mu has no effect"):
        inverse_normal(columns * [1.0, 1.0, 0.0], ("k", "offset", "mu"))
    with pytest.raises(InputError, match="no finite value to start from"):
        pendulum_family(k=math.nan)
    with pytest.raises(InputError, match="steps per sample do not follow"):
        steps_needed(pendulum_family(), (900.0, 0.0), (1.0, 0.0), samples=20, rate=1.0, bound=10.0, tolerance=1e-9)


def test_what_a_fit_costs_is_seen_before_it_begins(monkeypatch: pytest.MonkeyPatch) -> None:
    time = np.arange(400) / RATE
    monkeypatch.setattr(samples, "WORK_BUDGET", 1e6)
    with pytest.raises(InputError, match="the fit of pendulum to 400 samples needs about") as refusal:
        model_fit(np.cos(0.98 * time), RATE, pendulum_family())
    said = re.search(r"about (\S+) operations", str(refusal.value))
    assert said is not None
    assert float(said[1]) >= 400 * OPERATIONS * EVALUATIONS


@pytest.mark.parametrize("turns", [-1, 0, 3])
@pytest.mark.parametrize("lead", [-3.0, 0.2, 3.0])
def test_angles_are_compared_within_half_a_turn_at_the_start(lead: float, turns: int) -> None:
    """Of cos(2 t) and a motion that leads it by an angle, whole turns counting as none."""
    t, shift = np.arange(9) / 3.0, 2.0 * math.pi * turns
    limits = (np.full(6, -np.inf), np.full(6, np.inf))
    problem = Problem(np.cos(2.0 * t), 3.0, duffing_family(), True, 9.0, 4, limits)
    weight = np.linspace(0.2, 1.0, 9)
    goal = Polar(0.0, 2.0, 2.0 * t + shift, np.zeros(9), weight)
    gap, _ = problem.polar_gap(np.array([math.cos(lead), -2.0 * math.sin(lead), 0.0, 2.0, 0.0, 0.0]), goal)
    assert gap[:9] == pytest.approx(lead * weight, abs=1e-6)
    assert gap[9:] == pytest.approx(np.zeros(9), abs=1e-6)


def test_a_record_of_three_cycles_has_harmonics_too() -> None:
    t = np.arange(101) / 20.0
    signal = smooth_model(np.cos(2.0 * math.pi * 0.65 * t), 20.0)
    assert np.median(signal.omega) == pytest.approx(2.0 * math.pi * 0.65, rel=0.01)
