"""Intervals against the truth in seeded trials, the ambiguity near the separatrix, and what the pieces add up to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.amplitude import estimate_amplitude
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import duffing
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.search_band import SearchBand
from ridgeback.numeric.tracking.request import Options, Request, prepared, refuse_cross_term
from ridgeback.numeric.tracking.uncertainty import (
    Trial,
    few_sample_factor,
    moving_mean,
    pooled,
    replicated,
    replicates_needed,
)
from tests.numeric.holding import assert_holds, excess

RATE = 32.0
T = np.arange(641) / RATE
Source = Callable[..., Any]
Signal = tuple[np.ndarray, Callable[[np.ndarray], np.ndarray]]


def signal(name: str, pendulum_decay: Callable[..., Any]) -> Signal:
    """Samples at 32 Hz over 20 s, and the true omega(t)."""
    if name == "pendulum":
        decay = pendulum_decay()
        return decay.u, decay.omega
    if name == "duffing":
        oscillator = duffing(k=2 * np.pi, eps=10.0, mu=0.05)
        run = integrate(oscillator, (2.0, 0.0), duration=20.0, rate=RATE)
        return run.u, cycle_frequency(run, dynamics=oscillator).at
    phase = 2 * np.pi * (1.0 * T + 0.36 * np.sin(0.5 * T) + 0.01 * T * T)
    return np.cos(phase), lambda t: 2 * np.pi * (1.0 + 0.18 * np.cos(0.5 * t) + 0.02 * t)


def noisy(x: np.ndarray, decibel: float, seed: int) -> np.ndarray:
    power = np.mean((x - x.mean()) ** 2)
    noise = np.random.default_rng(seed).normal(size=x.size)
    return np.asarray(x + np.sqrt(power / 10 ** (decibel / 10)) * noise)


# Neighbouring samples share their noise, so that a trial of 20 s tells about as much as ten independent values: six
# trials know the share to some four percent.  benchmarks/trials/test_coverage.py has the table of many.
@pytest.mark.parametrize("method", ["harmonic-least-squares", "pseudo-wigner", "hilbert"])
def test_intervals_hold_the_truth(method: str, pendulum_decay: Source) -> None:
    shares, widths, seed = [], [], 500
    for name in ("pendulum", "chirp", "duffing"):
        x, omega = signal(name, pendulum_decay)
        for decibel in (12.0, 35.0):
            track = estimate(noisy(x, decibel, seed := seed + 1), RATE, method=method).inside()
            if track.interval is None:
                assert track.no_interval
                continue
            truth = omega(track.time)
            known = np.isfinite(truth)
            shares.append(np.mean(track.interval.holds(truth)[known]))
            widths.append(excess(track.interval.low[known], track.interval.high[known], truth[known]))
    assert len(shares) >= 5  # a fast chirp in little noise may ask for finer knots than there are
    assert 0.88 < np.mean(shares) < 0.995
    assert 1.4 < np.median(widths) < 4.0


def test_noise_alone_does_not_hold_a_biased_estimate(pendulum_decay: Source) -> None:
    x, omega = signal("pendulum", pendulum_decay)
    track = estimate(noisy(x, 40.0, 3), RATE, method="wigner").inside()
    assert track.interval is not None
    assert track.standard_deviation is not None
    truth = omega(track.time)
    assert np.mean(np.abs(track.omega - truth) < 1.96 * track.standard_deviation) < 0.2
    assert_holds(track.interval, truth, share=0.8, within=6e-4)


def test_interval_is_the_same_before_and_after_the_bias_is_removed() -> None:
    x = noisy(np.cos(7.0 * T + 2.0 * np.sin(0.4 * T)), 30.0, 5)
    plain = estimate(x, RATE, method="pseudo-wigner")
    removed = estimate(x, RATE, method="pseudo-wigner", remove_bias=True)
    assert plain.interval is not None
    assert removed.interval is not None
    assert np.allclose(plain.interval.low, removed.interval.low, rtol=1e-12)
    assert plain.settings["seed"] == removed.settings["seed"]
    again = estimate(x, RATE, method="pseudo-wigner")
    assert again.interval is not None
    assert np.array_equal(again.interval.high, plain.interval.high)


def test_a_peak_that_jumps_claims_no_interval(pendulum_decay: Source) -> None:
    x, _ = signal("chirp", pendulum_decay)
    track = estimate(noisy(x, 10.0, 111_001), RATE, method="wigner")
    assert track.bias is not None
    assert track.interval is None
    assert "are jumps to other peaks" in str(track.no_interval)


def test_no_bias_no_interval() -> None:
    track = estimate(np.cos(7.0 * T), RATE, method="pseudo-wigner", bias=False)
    assert track.bias is None
    assert track.interval is None


def test_first_cycles_near_the_separatrix_are_ambiguous(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    track = estimate(decay.u, RATE)
    assert track.ambiguous is not None
    assert track.bias_deviation is not None
    # omega' 2 pi / omega^2 falls to a tenth one second after the start
    assert 0.6 < track.time[track.ambiguous].max() < 1.4
    assert track.ambiguous[0]
    first, later = track.bias_deviation[8], track.bias_deviation[200]
    assert first / track.omega[8] > 3e-3
    assert later / track.omega[200] < 1e-4
    assert track.rows()[0]["ambiguous"] is True


def test_every_method_reaches_the_borders_once_its_bias_is_off(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    for method in ("harmonic-least-squares", "pseudo-wigner", "spectrogram", "hilbert"):
        track = estimate(decay.u, RATE, method=method, remove_bias=True)
        assert decay.error(track.time, track.omega, low=18.0, high=20.0) < 1e-4
        assert decay.error(track.time, track.omega, low=0.0, high=2.0) < 5e-3


def test_velocity_gives_the_third_harmonic_with_an_interval(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    track = estimate(decay.velocity, RATE, harmonic=3).inside()
    assert decay.error(track.time, track.omega, multiple=3) < 1e-3
    assert track.interval is not None
    noise = estimate(noisy(decay.velocity, 25.0, 1), RATE, harmonic=3).inside()
    assert noise.interval is not None
    assert_holds(noise.interval, 3.0 * decay.omega(noise.time), share=0.85, within=8e-3)


def test_harmonic_that_the_data_do_not_show_has_no_interval() -> None:
    track = estimate(noisy(np.cos(7.0 * T), 20.0, 1), RATE, harmonic=3)
    assert track.interval is None
    assert "harmonic 3 is not in the model" in str(track.no_interval)


@pytest.mark.parametrize("harmonic", [1, 3])
def test_amplitudes_have_bias_deviation_and_interval(harmonic: int) -> None:
    phase, decay = 2 * np.pi * (1.2 * T + 0.01 * T * T), np.exp(-0.1 * T)
    clean = decay * (2.0 * np.cos(phase) + 0.5 * np.cos(3 * phase + 0.2))
    truth = decay * {1: 2.0, 3: 0.5}[harmonic]
    held, errors, claimed = [], [], []
    for seed in range(8):
        track = estimate_amplitude(
            clean + 0.1 * np.random.default_rng(seed).normal(size=T.size), RATE, harmonic=harmonic
        )
        assert track.interval is not None
        assert track.standard_deviation is not None
        held.append(np.mean(track.interval.holds(truth)))
        errors.append(track.amplitude - truth)
        claimed.append(track.standard_deviation)
    assert 0.85 < np.mean(held) < 0.995
    assert np.sqrt(np.mean(np.square(errors)) / np.mean(np.square(claimed))) == pytest.approx(1.0, abs=0.35)
    assert track.definition == ("fundamental" if harmonic == 1 else "harmonic 3")


def with_search(request: Request, omega: float) -> Request:
    """A request for what is about a frequency, whatever else is in the samples."""
    guide = np.full(request.signal.x.size, omega)
    return replace(
        request, signal=replace(request.signal, search=SearchBand(0.9 * guide, 1.1 * guide, guide, omega, ""))
    )


@pytest.mark.parametrize("method", ["wigner", "pseudo-wigner", "smoothed-pseudo-wigner", "polynomial-wigner"])
def test_raw_wigner_peak_at_a_harmonic_is_that_of_the_harmonic(method: str) -> None:
    """In its band the harmonic is alone: no cross term of what is beyond bends it."""
    x = np.cos(2 * np.pi * 1.5 * T) + 0.3 * np.cos(2 * np.pi * 4.5 * T) + 0.2 * np.cos(2 * np.pi * 7.5 * T)
    band = (25.0, 32.0)
    off = x + 0.2 * (np.cos(2 * np.pi * 7.9 * T) - np.cos(2 * np.pi * 7.5 * T))  # its cross term: 4.7 Hz, in the band
    here = estimate(off, RATE, method=method, band=band).inside()
    assert np.abs(here.omega / (9 * np.pi) - 1.0).max() < (1e-2 if method == "wigner" else 1e-3)
    request = prepared(Samples(x, RATE, 0.0), Options())
    with pytest.raises(
        InputError, match=r"round 3 times the strongest component.*harmonics 1 and 5 falls; use --harmonic 3"
    ):
        refuse_cross_term(with_search(request, 9 * np.pi), method)
    alone = estimate(x, RATE, method="spectrogram", band=band, lag_seconds=3.0, bias=False).inside()
    assert np.abs(alone.omega / (9 * np.pi) - 1.0).max() < 1e-3
    if method != "polynomial-wigner":
        limited = estimate(x, RATE, method=method, band=band, lag_seconds=3.0, band_limited=True, bias=False).inside()
        assert np.abs(limited.omega / (9 * np.pi) - 1.0).max() < 2e-3


def test_long_record_is_decimated_by_auto_and_says_so() -> None:
    t = np.arange(60_000) / 8000.0
    frequency = 100.0 + 2.0 * t
    phase = 2 * np.pi * (100.0 * t + 1.0 * t * t)
    x = np.cos(phase) + 0.2 * np.cos(2 * phase) + 0.05 * np.random.default_rng(1).normal(size=t.size)
    track = estimate(x, 8000.0, start=10.0)
    assert track.used.decimated_by == 6
    assert track.details["rate_given"] == pytest.approx(8000.0)
    expected = np.interp(track.time - 10.0, t, frequency)
    assert np.abs(track.frequency_hz / expected - 1.0)[50:-50].max() < 1e-4
    assert track.interval is not None
    assert_holds(track.interval, 2 * np.pi * expected, share=0.85, within=3e-6)


def test_lag_and_degree_follow_the_noise() -> None:
    phase = 2 * np.pi * 1.5 * T + 2.0 * np.sin(0.8 * T)
    quiet, loud = (
        estimate(noisy(np.cos(phase), decibel, 2), RATE, method="harmonic-least-squares", scope="local", bias=False)
        for decibel in (60.0, 5.0)
    )
    shape = [(t.used.lag_seconds, t.used.phase_degree) for t in (quiet, loud)]
    assert shape[0][0] < shape[1][0] or shape[0][1] > shape[1][1]


def test_work_over_the_budget_is_a_reason_for_another_method(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_operations: float, what: str, _remedy: str) -> None:
        raise InputError(f"{what} needs about 1e+13 operations, over the budget of 1e+12; decimate first")

    monkeypatch.setattr("ridgeback.numeric.harmonics.spline_fit.checked_work", refuse)
    track = estimate(np.cos(7.0 * T), RATE)
    assert track.method == "pseudo-wigner"
    assert "pseudo-Wigner, because harmonic least squares cannot: harmonic splines on 641" in track.used.why
    assert "over the budget" in str(track.no_interval)


def test_pieces() -> None:
    assert replicates_needed(2.0) == 24
    assert replicates_needed(1000.0) == 4
    assert replicates_needed(5000.0) == 2
    assert few_sample_factor(5.0) == pytest.approx(2.5706 / 1.95996, rel=1e-4)  # Student's table
    assert moving_mean(np.array([0.0, 0.0, 9.0]), 3).tolist() == [0.0, 3.0, 6.0]
    rng = np.random.default_rng(1)
    shape = np.linspace(1.0, 5.0, 400)
    assert np.abs(pooled(shape * rng.normal(size=(30, 400)), shape, 100) / shape - 1.0).max() < 0.1


def test_replicates_of_one_model_have_no_difference_between_models() -> None:
    """An estimator that returns its samples, and a model that takes up a quarter of any noise."""
    time = np.arange(50.0)
    omega, samples = 6.0 + 0.1 * np.sin(time), np.cos(time)

    def tone(_: int, change: np.ndarray | None = None) -> tuple[np.ndarray, None]:
        return omega + (0.0 if change is None else change), None

    def response(noise: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return 0.5 * noise, 0.25 * noise

    model: Any = SimpleNamespace(time=time, band_noise=0.1, samples=lambda: samples, tone=tone, response=response)
    models: Any = SimpleNamespace(fine=model, coarse=model)
    found = replicated(Trial(time, lambda x: x), models, samples, 4)
    assert np.abs(found.between).max() < 1e-12
    assert np.allclose(found.corrected, 1.25 * found.plain, atol=1e-12)
    assert float(np.std(found.plain)) == pytest.approx(0.1, rel=0.2)
