"""Identification: the right class in noise, intervals that hold the truth, honest doubt, and predictions."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.identification.candidates import (
    LAWS,
    NAMES,
    DampingLaw,
    backbone_model,
    level_at,
    models_of,
    van_der_pol_flow,
)
from ridgeback.compare.identification.confusion import DRAWS, confusion, noisy
from ridgeback.compare.identification.fitting import Fit, fit, prepare, spread_of
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.potentials import POTENTIALS, helmholtz_limit, pendulum_orbits
from ridgeback.compare.identification.prediction import predict
from ridgeback.compare.identification.preparation import prepared, usable
from ridgeback.compare.identification.ranking import criterion, effective_number
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.identification.shown import Outcome
from ridgeback.compare.noise.truth import recording_truth
from ridgeback.compare.recording.recording import compare_recording
from ridgeback.compare.report.recording_summary import forecast
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, pendulum, van_der_pol
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits.potential import peak_limit
from ridgeback.numeric.orbits.slow_flow import motion
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.reconstruction import Reconstruction
from ridgeback.symbolic.systems.catalogue import find


def decay(*, noise: float = 0.01, cycles: float = 40.0, **parameters: float) -> Recording:
    """A Duffing decay from 1 with white noise; eight samples per cycle."""
    rng = np.random.default_rng(7)
    run = integrate(duffing(**parameters), (1.0, 0.0), duration=cycles * 2 * math.pi, rate=4 / math.pi, rtol=1e-9)
    return Recording(run.time, run.u + noise * rng.normal(size=run.u.size), 4 / math.pi, "u", "mm", "decay.csv", "")


@pytest.fixture(scope="module")
def hardening() -> Identification:
    return identify(decay(eps=0.5, mu=0.006), candidates=("linear", "duffing-hardening", "helmholtz-duffing"))


def test_ranking_is_complete_and_in_order(hardening: Identification) -> None:
    deltas = [c.delta for c in hardening.candidates]
    assert deltas == sorted(deltas)
    assert deltas[0] == 0
    assert sum(c.weight for c in hardening.candidates) == pytest.approx(1.0, rel=1e-12)
    assert hardening.candidates[1].weight / hardening.best.weight == pytest.approx(math.exp(-deltas[1] / 2))
    assert {c.name for c in hardening.candidates} == {"linear", "duffing-hardening", "helmholtz-duffing"}


def test_the_best_candidate_leaves_the_noise_and_has_the_parameters(hardening: Identification) -> None:
    best = hardening.best
    assert best.name == "duffing-hardening"
    assert best.residual == pytest.approx(0.01, rel=0.1)
    assert hardening.effective_samples > 0.9 * hardening.samples
    for name, truth in {"k": 1.0, "eps": 0.5, "mu": 0.006, "offset": 0.0}.items():
        parameter = best.parameter(name)
        assert abs(parameter.value - truth) < 3.5 * parameter.standard_deviation, name
    assert best.parameter("eps").unit == "1/(s^2 mm^2)"


def test_bands_hold_the_backbone_and_grow_with_its_deviation(hardening: Identification) -> None:
    """In the fundamental amplitude, from the exact frequency by the first harmonic of the same orbit."""
    from ridgeback.numeric.orbits.orbit_table import orbit_table

    best = hardening.best
    peaks = np.linspace(0.05, 1.2, 200)
    table = orbit_table(duffing(eps=0.5), peaks)
    exact = np.interp(best.amplitude, table.cosine[1], table.omega)
    assert np.all(best.omega_low <= best.omega)
    assert np.mean((best.omega_low <= exact) & (exact <= best.omega_high)) > 0.5
    assert np.abs(best.omega / exact - 1).max() < 1e-3
    assert np.all((best.growth_rate_low < best.growth_rate) & (best.growth_rate < best.growth_rate_high))


def test_a_result_is_frozen_and_json_knows_it(hardening: Identification) -> None:
    text = json.loads(json.dumps(hardening.record()))
    assert text["candidates"][0]["parameters"][0]["name"] == "k"
    assert len(text["data"]["amplitude"]) == hardening.data.amplitude.size
    with pytest.raises(ValueError, match="read-only"):
        hardening.best.omega[0] = 0.0


def test_the_verdict_says_what_was_found_and_no_more(hardening: Identification) -> None:
    best, second, *_ = hardening.candidates
    alone = replace(hardening, indistinguishable=(best.name,))
    assert alone.verdict.startswith(f"{best.named}; next comes {second.title}, BIC")
    alone = replace(hardening, candidates=(best,))
    assert alone.verdict.startswith(f"{best.named}. What it leaves unexplained is")
    poor = replace(alone, unexplained=0.9)
    assert poor.verdict.startswith("No class describes this recording: the best candidate leaves 90% of the signal")
    assert poor.verdict.endswith(f"The nearest is {best.named}.")
    free = replace(alone, candidates=(replace(best, has_equation=False),))
    assert ": no equation among the candidates does as well." in free.verdict


def test_what_cannot_be_told_apart_is_said() -> None:
    """A weakly softening decay in strong noise: pendulum and Duffing agree through the order that can be seen."""
    found = identify(decay(eps=-0.15, mu=0.01, noise=0.03), candidates=("pendulum", "duffing-softening", "linear"))
    assert set(found.indistinguishable) == {"pendulum", "duffing-softening"}
    assert "cannot tell it apart from" in found.verdict
    assert max(c.weight for c in found.candidates) < 0.9


@pytest.mark.parametrize(("law", "name"), [("linear + quadratic", "beta"), ("linear + cubic", "gamma")])
def test_the_damping_law_is_found(law: str, name: str) -> None:
    """u'' + 2 mu u' + c u'|u'|^n + u + 0.4 u^3 = 0, integrated as it stands."""
    power, c = (1, 0.03) if name == "beta" else (2, 0.04)
    conservative = duffing(eps=0.4, mu=0.003)
    dynamics = Dynamics(
        name="damped",
        force=lambda u, v: conservative.force(u, v) + c * v * abs(v) ** power,
        natural_frequency=1.0,
    )
    run = integrate(dynamics, (1.0, 0.0), duration=250.0, rate=1.3, rtol=1e-9)
    values = run.u + 0.003 * np.random.default_rng(2).normal(size=run.u.size)
    found = identify(Recording(run.time, values, 1.3, "u", "", "x", ""), candidates=("duffing-hardening",))
    assert found.best.damping_law == law
    parameter = found.best.parameter(name)
    assert parameter.value == pytest.approx(c, abs=3.5 * parameter.standard_deviation + 0.02 * c)


@pytest.mark.parametrize(("law", "name", "power"), [(LAWS[1], "beta", 1), (LAWS[2], "gamma", 2)])
def test_a_damping_law_by_itself_starts_from_the_measured_growth_rate(law: str, name: str, power: int) -> None:
    c, conservative = 0.03, duffing(eps=0.4, mu=0.003)
    dynamics = Dynamics(
        name="damped",
        force=lambda u, v: conservative.force(u, v) + c * v * abs(v) ** power,
        natural_frequency=1.0,
    )
    run = integrate(dynamics, (1.0, 0.0), duration=150.0, rate=1.3, rtol=1e-8)
    values = run.u + 0.003 * np.random.default_rng(2).normal(size=run.u.size)
    recording = Recording(run.time, values, 1.3, "u", "", "x", "")
    best = identify(recording, candidates=("duffing-hardening",), laws=(law,)).best
    assert best.damping_law == law
    assert abs(best.parameter(name).value - c) < 4.0 * best.parameter(name).standard_deviation + 0.02 * c
    with pytest.raises(KeyError, match="none"):
        best.parameter("none")


def test_a_polynomial_backbone_locks_on_over_many_cycles() -> None:
    """What only shapes the wave is not moved while phases and amplitudes alone are fitted: it would go astray."""
    t = np.arange(2400) * 0.02
    a = np.exp(-0.03 * t) / (1 + 0.04 * t)
    phase = 0.02 * np.cumsum(6 * np.pi * (1 - 0.06 * a**2))
    x = a * np.cos(phase) + 0.02 * a**3 * np.cos(3 * phase) + 0.01 * np.random.default_rng(3).normal(size=t.size)
    ready = prepared(Recording(t, x, 50.0, "u", "", "decay.csv", ""))
    data = prepare(ready.recording, ready.track, models=ready.models, kept=ready.kept)
    found = fit(backbone_model(2, DampingLaw.QUADRATIC), data)
    assert data.length * float(np.std(found.residual)) < 0.0105
    assert found.theta[1] * found.theta[0] / data.length**2 == pytest.approx(-0.36 * np.pi, rel=0.02)


def test_the_corrected_criterion_counts_few_samples() -> None:
    """Hurvich and Tsai: 2 p n / (n - p - 1) in place of p log n, and nothing to compare with too few samples."""
    of_three = Fit(SimpleNamespace(count=3), np.zeros(3), np.ones(20), np.eye(3))  # type: ignore[arg-type]
    apart = criterion(of_three, 10.0, "aicc") - criterion(of_three, 10.0, "bic")
    assert apart == pytest.approx(2 * 3 * 10 / 6 - 3 * math.log(10.0))
    assert criterion(of_three, 4.0, "aicc") == math.inf
    assert effective_number(np.full(50, 2.0)) == 1.0


def test_prediction_from_the_first_cycles() -> None:
    ahead = predict(decay(eps=0.5, mu=0.006), cycles=15, candidates=("linear", "duffing-hardening"), laws=("linear",))
    assert ahead.candidate == "duffing-hardening"
    assert ahead.until == pytest.approx(15 * 2 * math.pi / 1.13, rel=0.05)
    assert ahead.time[0] > ahead.until
    assert ahead.errors["omega"] < 5e-3
    assert ahead.errors["phase"] < 0.3
    assert min(ahead.coverage.values()) > 0.6
    half = 0.5 * (ahead.amplitude_high - ahead.amplitude_low)
    assert np.all(half > 0)
    assert ahead.phase_band[-1] > ahead.phase_band[0]


def test_a_linear_decay_is_predicted_down_to_its_tail() -> None:
    """The phase that a forecast is held against is the model's own, with its deviation, not that of a short window."""
    t = np.arange(900) / 15.0
    x = np.exp((-0.0628 + 4j * np.pi) * t).real + 0.001 * np.random.default_rng(4).normal(size=t.size)
    found = predict(
        Recording(t, x, 15.0, "u", "", "decay.csv", ""), cycles=40, candidates=("linear",), laws=("linear",)
    )
    assert found.errors["phase"] < 0.003
    assert min(found.coverage.values()) > 0.8


def test_a_class_that_the_samples_do_not_ask_for_leaves_a_forecast_as_it_is() -> None:
    """A pendulum of hardly any angle bends as little as a Duffing oscillator of hardly any cubic stiffness may."""
    t = np.arange(500) / 12.0
    x = np.exp((-0.02 + 6j) * t).real + 0.001 * np.random.default_rng(14).normal(size=t.size)
    recording = Recording(t, x, 12.0, "u", "", "decay.csv", "")
    bends, alone = (
        predict(recording, cycles=13, candidates=(name,), laws=("linear",))
        for name in ("duffing-softening", "pendulum")
    )
    for name in ("amplitude_high", "omega_high", "phase_band"):
        assert getattr(alone, name) == pytest.approx(getattr(bends, name), rel=0.05), name
    both = predict(recording, cycles=13, candidates=("linear", "pendulum"), laws=("linear",))
    assert both.outcome is alone.outcome is Outcome.HELD
    # the phase at the border of the part that was fitted is not what the bands are widened by
    assert both.phase_band[-1] < 0.05
    assert "phase 1." in both.note


def test_a_forecast_that_says_nothing_has_not_held() -> None:
    ahead = predict(decay(eps=0.0, mu=0.006), cycles=15, candidates=("linear",), laws=("linear",))
    assert ahead.outcome is Outcome.HELD
    assert ahead.record()["outcome"] == "held"
    assert replace(ahead, amplitude_high=1.6 * ahead.amplitude).outcome is Outcome.OPEN
    assert replace(ahead, omega_high=np.full_like(ahead.omega, np.nan)).outcome is Outcome.OPEN
    assert replace(ahead, coverage={}).outcome is Outcome.OPEN
    missed = replace(ahead, coverage={"amplitude": 1.0, "omega": 0.7})
    assert missed.outcome is Outcome.MISSED
    assert "did not hold: 100 % of amplitudes and 70 % of frequencies" in forecast(missed)
    assert "says nothing" in forecast(replace(ahead, coverage={}))


def test_the_papers_pendulum_is_a_pendulum() -> None:
    """From 0.95 pi, where the swing is nearly square and the frequency doubles within the record."""
    k, mu = 4 * math.pi, 0.01
    run = integrate(pendulum(k=k, mu=mu), (0.95 * math.pi, 0.0), duration=20.0, rate=32.0)
    values = run.u + 0.02 * np.random.default_rng(0).normal(size=run.u.size)
    recording = Recording(run.time, values, 32.0, "theta", "rad", "paper", "")
    found = identify(recording, candidates=("pendulum", "duffing-softening"), laws=("linear",))
    assert found.best.name == "pendulum"
    assert found.best.residual < 0.03
    for name, truth in {"k": k, "b": 1.0, "mu": mu}.items():
        parameter = found.best.parameter(name)
        assert abs(parameter.value - truth) < 3.5 * parameter.standard_deviation, name
        assert parameter.standard_deviation < 0.01 * truth, name


def test_the_waveform_of_a_swing_has_all_its_harmonics() -> None:
    """From 2.5 rad in noise of 1e-4: with four harmonics it left fifty times that, and claimed what it did not hold."""
    run = integrate(pendulum(k=1.0, mu=0.003), (2.5, 0.0), duration=150.0, rate=3.0, rtol=1e-10)
    values = run.u + 2e-4 * np.random.default_rng(5).normal(size=run.u.size)
    found = identify(Recording.from_arrays(values, 3.0), candidates=("pendulum",), laws=("linear",))
    assert found.best.residual < 2.2e-4
    for name, truth in {"k": 1.0, "b": 1.0, "mu": 0.003}.items():
        parameter = found.best.parameter(name)
        assert abs(parameter.value - truth) < 3.5 * parameter.standard_deviation < 1e-3, name


def test_tables_are_fine_up_to_their_end_next_to_the_separatrix() -> None:
    """The pendulum's up to 0.992 pi against its closed form; the last nodes stand where it bends most."""
    orbits = pendulum_orbits((math.pi**2,))
    peak = orbits.peak * math.pi
    assert peak[-1] == pytest.approx(0.992 * math.pi)
    assert np.abs(orbits.omega / np.asarray(pendulum().closed_form(peak)) - 1).max() < 3e-5


def test_signals_that_keep_what_they_share_are_those_of_the_model_to_the_bit() -> None:
    """Whatever comes before: the same, another phase, another offset, another start."""
    time = np.arange(300) / 20.0
    model = models_of("duffing-hardening", DampingLaw.QUADRATIC)
    signal = model.signals(time)
    theta = np.array([2.0, 0.1, 0.05, 0.02, np.log(0.8), 0.3, 0.01])
    for changed in (None, -1, -2, -3, -1, 0, -2, None):
        if changed is not None:
            theta[changed] += 0.01
        assert np.array_equal(signal(theta), model.signal(theta, time))


def test_effective_number_of_a_narrow_band() -> None:
    """White noise kept in a tenth of the band counts as a tenth of its samples, wherever the band lies."""
    rng = np.random.default_rng(5)
    spectrum = np.fft.rfft(rng.normal(size=8000))
    for first in (0, 1500):
        kept = np.zeros_like(spectrum)
        kept[first : first + 400] = spectrum[first : first + 400]
        assert effective_number(np.fft.irfft(kept)) == pytest.approx(800, rel=0.15)


def test_spread_is_the_covariance_of_least_squares() -> None:
    """For a straight line: (J^T J)^-1 by hand."""
    t = np.arange(5.0)
    assert np.allclose(spread_of(np.column_stack((np.ones(5), t))), np.linalg.inv([[5, 10], [10, 30]]), rtol=1e-9)


@pytest.mark.parametrize(("alpha", "eps"), [(0.3, 0.2), (1.2, 0.1), (-1.2, 0.1), (0.5, -0.4), (-0.7, 0.0), (0.0, -1.0)])
def test_the_end_of_the_well_in_closed_form(alpha: float, eps: float) -> None:
    exact = peak_limit(helmholtz_duffing(alpha=alpha, eps=eps))
    assert helmholtz_limit(alpha, eps) == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize("potential", POTENTIALS, ids=lambda p: p.name)
def test_every_potential_is_linear_at_small_amplitude_and_mirrors(potential: object) -> None:
    model = models_of(potential.name, "linear")  # type: ignore[attr-defined]
    shape = {0: (), 1: (0.5,), 2: (0.1, 0.2)}[len(potential.lower)]  # type: ignore[attr-defined]
    shape = (-0.3,) if model.name == "duffing-softening" else (1.3, 0.5) if "stop" in model.name else shape
    flow = model.flow(np.array([2.0, *shape, 0.02, 0.0]), 100.0)
    expected = 2 / (1 + 1 / 0.5) * 2 if model.name == "bilinear" else 2.0
    assert flow.omega[-1] == pytest.approx(expected, rel=1e-3)
    assert flow.growth[-1] == pytest.approx(-0.01, rel=1e-3)
    assert np.allclose(flow.cosine[1], 1.0)


def test_a_stop_below_mirrors_a_stop_above() -> None:
    above, below = (models_of(name, "linear").flow(np.array([1.0, 1.5, 0.4, 0.01, 0.0]), 1.0) for name in STOPS)
    signs = (-1.0) ** (1.0 + np.arange(above.cosine.shape[0]))[:, None]
    assert np.allclose(above.cosine, signs * below.cosine)
    assert np.array_equal(above.omega, below.omega)


STOPS = ("bilinear-stop", "bilinear-stop-below")


@pytest.mark.parametrize("start", [0.4, 3.5])
def test_van_der_pol_flow_follows_the_equation(start: float) -> None:
    """Into the limit cycle from inside and outside: the phase error is of the order eps^3 t that was left out."""
    eps = 0.1
    run = integrate(van_der_pol(eps), (start, 0.0), duration=120.0, rate=4.0)
    cycles = cycle_frequency(run, dynamics=van_der_pol(eps))
    time = np.linspace(8.0, 110.0, 12)
    wave = Reconstruction(multiple_scales(find("van-der-pol").with_parameters({"k": 1, "eps": None}), 9, weight=1))
    a0, phase0 = wave.start(start, 0.0, eps)
    flow = van_der_pol_flow(1.0, eps, 1.0, a0, 120.0)
    samples = motion(flow, level_at(flow, math.log(a0)), phase0, run.time)
    assert np.abs(samples.u - run.u).max() < 5e-3 * start
    at = motion(flow, level_at(flow, math.log(a0)), phase0, time)
    assert np.abs(at.omega / cycles.at(time) - 1).max() < 2e-3
    assert float(at.amplitude[-1]) == pytest.approx(2.0, abs=0.02)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"candidates": ("linear", "cubic")}, "candidate 'cubic' is unknown"),
        ({"candidates": ()}, "no candidate is named"),
        ({"laws": ("viscous",)}, "damping law 'viscous' is unknown"),
        ({"kind": "aic"}, "criterion 'aic' is unknown"),
        ({"span": (500.0, 600.0)}, "the recording runs from 0 to"),
    ],
)
def test_unusable_requests_are_refused(options: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        identify(decay(eps=0.0, mu=0.01), **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("cycles", [3.0, 38.0])
def test_a_prediction_needs_cycles_on_both_sides(cycles: float) -> None:
    with pytest.raises(InputError, match="use 6 to 34"):
        predict(decay(eps=0.0, mu=0.01), cycles=cycles)


def test_a_class_without_draws_is_refused() -> None:
    with pytest.raises(InputError, match="cannot be drawn"):
        confusion(classes=("backbone-polynomial",), trials=1)


def test_long_recordings_are_thinned_and_said() -> None:
    t = np.arange(40_000) / 200.0
    x = np.exp(-0.01 * t) * np.cos(2 * math.pi * 0.5 * t)
    used, notes = usable(Recording(t, x, 200.0, "u", "", "long.csv", ""), None)
    factor = round(200.0 / used.rate)
    assert 2 <= factor <= 16
    assert used.values.size < 6100
    assert np.abs(used.values - x[::factor]).max() < 2e-4
    assert notes == (f"Every {factor}th sample was used, after a low-pass filter.",)


def test_trials_are_seeded_and_noise_has_its_level() -> None:
    first, again = (DRAWS["linear"](np.random.default_rng(4)) for _ in range(2))
    assert np.array_equal(first.u, again.u)
    added = noisy(first, 40.0, np.random.default_rng(1)).values - first.u
    assert added.std() == pytest.approx(0.01 / math.sqrt(2), rel=0.15)
    assert set(DRAWS) < set(NAMES)


def test_noise_is_called_noise() -> None:
    time = np.arange(800) / 20.0
    noise = Recording(time, np.random.default_rng(3).normal(size=800), 20.0, "u", "mm", "noise.csv", "")
    for reading in (identify, recording_truth_of, compare_recording):
        with pytest.raises(InputError, match=r"no oscillation stands out of the noise: .* with probability"):
            reading(noise)


def recording_truth_of(recording: Recording) -> object:
    return recording_truth(recording.values, recording.rate)
