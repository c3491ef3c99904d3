"""Every method on chirps, on the paper's pendulum, in noise, and at the border of what it can do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.estimate import METHODS, estimate, estimation
from ridgeback.numeric.harmonics.local_fit import harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.tracking.choices import Scope

PEAKS = (
    "wigner",
    "pseudo-wigner",
    "smoothed-pseudo-wigner",
    "spectrogram",
    "reassigned-spectrogram",
    "synchrosqueezed",
)
Source = Callable[..., Any]


def chirp(rate: float = 32.0, seconds: float = 20.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    t = np.arange(int(rate * seconds) + 1) / rate
    return t, np.cos(2 * np.pi * (1.0 * t + 0.01 * t * t) + 0.4), 2 * np.pi * (1.0 + 0.02 * t)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_follows_a_chirp_and_fills_the_same_track(method: str) -> None:
    t, x, _ = chirp()
    track = estimate(3.0 + x, 32.0, method=method, start=100.0)
    inside = track.inside()
    assert inside.time.size > 30
    expected = 2 * np.pi * (1.0 + 0.02 * (inside.time - 100.0))
    middle = (inside.time > 104.0) & (inside.time < 116.0)
    tolerance = 1e-2 if method == "hilbert" else 2e-3  # the jump from the end of the record to its beginning ripples
    assert np.abs(inside.omega / expected - 1.0)[middle].max() < tolerance
    assert track.standard_deviation is not None
    assert np.all(np.isfinite(track.standard_deviation))
    assert track.start == 100.0
    assert track.details["offset_removed"] == pytest.approx(3.0, abs=0.1)
    assert track.bias_removed is False
    assert t.size == 641


def test_auto_says_what_it_chose_and_why() -> None:
    track = estimate(chirp()[1], 32.0)
    assert track.method == "harmonic-least-squares"
    assert track.used.scope is Scope.GLOBAL
    assert track.used.why.startswith("harmonic least squares of the whole record: relative rms errors")
    assert "pseudo-Wigner over" in track.used.why
    assert estimate(np.cos(2 * np.pi * 1.1 * np.arange(48) / 8.0), 8.0).used.scope is Scope.GLOBAL
    short = estimate(np.cos(2 * np.pi * 1.1 * np.arange(26) / 8.0), 8.0)
    assert short.method == "harmonic-least-squares"
    assert short.used.scope is Scope.LOCAL
    assert "there is no model of the whole: signal holds" in short.used.why
    assert short.interval is None
    assert "needs more than" in str(short.no_interval)


# Relative rms over 2 .. 18 s of the paper's case at 32 Hz, noise free, against the phase of the zero crossings.
@pytest.mark.parametrize(
    ("method", "remove_bias", "low", "high"),
    [
        ("wigner", False, 9.2e-3, 9.8e-3),
        ("pseudo-wigner", False, 3.8e-4, 4.9e-4),
        ("pseudo-wigner", True, 0.0, 1.8e-5),
        ("smoothed-pseudo-wigner", True, 0.0, 1.8e-5),
        ("wigner", True, 0.0, 1.8e-5),
        ("hilbert", True, 0.0, 1.8e-5),
        ("polynomial-wigner", False, 0.0, 3.5e-5),
        ("spectrogram", True, 0.0, 1.8e-5),
        ("reassigned-spectrogram", False, 4.5e-4, 6.5e-4),
        ("reassigned-spectrogram", True, 0.0, 1.8e-5),
        ("synchrosqueezed", False, 5.5e-4, 7.5e-4),
        ("synchrosqueezed", True, 0.0, 1.8e-5),
        ("zero-crossing", False, 0.9e-4, 1.5e-4),
        ("zero-crossing", True, 0.0, 1.2e-5),
        ("harmonic-least-squares", False, 0.0, 2.5e-5),
    ],
)
def test_paper_case(pendulum_decay: Source, method: str, remove_bias: bool, low: float, high: float) -> None:
    decay = pendulum_decay()
    track = estimate(decay.u, 32.0, method=method, remove_bias=remove_bias)
    error = decay.error(track.time, track.omega)
    assert low <= error < high
    if track.bias is not None and method in ("wigner", "pseudo-wigner", "zero-crossing") and not remove_bias:
        part = track.between(2, 18)
        assert part.bias is not None
        predicted = np.sqrt(np.mean((part.bias / part.omega) ** 2))
        assert predicted == pytest.approx(error, rel=0.1)


@pytest.mark.parametrize("method", ["wigner", "pseudo-wigner", "smoothed-pseudo-wigner"])
def test_band_limited_track_is_the_track_where_the_band_holds_all(method: str) -> None:
    t, x, omega = chirp()
    bare = estimate(x, 32.0, method=method, bias=False)
    limited = estimate(x, 32.0, method=method, bias=False, band_limited=True)
    assert limited.settings["band_limited"] is True
    assert limited.standard_deviation is not None
    assert bare.standard_deviation is not None
    middle = (t > 5.0) & (t < 15.0)  # the band filter, like the analytic signal, errs near the ends of the record
    assert np.count_nonzero(limited.valid) < np.count_nonzero(bare.valid)
    assert np.abs(limited.omega / omega - 1.0)[middle].max() < 1e-3
    assert limited.standard_deviation[middle] == pytest.approx(bare.standard_deviation[middle], rel=1e-3)


@pytest.mark.parametrize("method", ["wigner", "pseudo-wigner", "smoothed-pseudo-wigner"])
def test_single_precision_track_is_the_track_to_six_digits(method: str) -> None:
    t, x, _ = chirp()
    double = estimate(x, 32.0, method=method, bias=False)
    single = estimate(x, 32.0, method=method, bias=False, single=True)
    assert single.settings["single"] is True
    middle = (t > 4.0) & (t < 16.0)
    assert 1e-13 < np.abs(single.omega / double.omega - 1.0)[middle].max() < 1e-6


def test_harmonic_least_squares_reaches_the_borders(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    whole = estimate(decay.u, 32.0, method="harmonic-least-squares")
    local = estimate(decay.u, 32.0, method="harmonic-least-squares", scope="local", bias=False)
    for track in (whole, local):
        assert decay.error(track.time, track.omega, low=18.0, high=20.0) < 1e-4
        assert decay.error(track.time, track.omega, low=0.0, high=2.0) < 5e-3
    assert (whole.valid[0], local.valid[0]) == (True, False)


def test_one_percent_of_the_full_wigner_is_curvature_and_not_harmonics(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    full = estimate(decay.u, 32.0, method="wigner")
    error = (full.omega / decay.omega(full.time) - 1.0)[64:-64]
    assert error.mean() == pytest.approx(-8.0e-3, rel=0.1)
    # The fundamental alone, its amplitude and phase as fitted: no harmonic is left, the error stays.
    fit = harmonic_fit(decay.u, 32.0, decay.omega(decay.time), half=50, shape=Shape((3, 5, 7)))
    phase = decay.omega.antiderivative()(decay.time)
    alone = estimate(fit.amplitude * np.cos(phase), 32.0, method="wigner")
    error_alone = (alone.omega / decay.omega(alone.time) - 1.0)[64:-64]
    assert np.sqrt(np.mean((error - error_alone) ** 2)) < 0.1 * np.sqrt(np.mean(error**2))
    # The same harmonics on a constant frequency: they stay, the error goes.
    constant = pendulum_decay(mu=0.0)
    flat = estimate(constant.u, 32.0, method="wigner")
    assert decay.error(decay.time, full.omega) > 30 * constant.error(constant.time, flat.omega)


def test_velocity_serves_as_well_as_the_angle(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    track = estimate(decay.velocity, 32.0, method="harmonic-least-squares")
    assert decay.error(track.time, track.omega) < 1e-4


@pytest.mark.parametrize("method", [*PEAKS, "harmonic-least-squares"])
def test_standard_deviation_is_that_of_repeated_trials(method: str) -> None:
    t = np.arange(321) / 32.0
    clean, omega = np.cos(2 * np.pi * (1.2 * t + 0.02 * t * t)), 2 * np.pi * (1.2 + 0.04 * t)
    middle = (t > 3.0) & (t < 7.0)
    errors, claimed = [], []
    for seed in range(16):
        x = clean + 0.1 * np.random.default_rng(seed).normal(size=t.size)
        lag = 3.0 if method == "harmonic-least-squares" else None
        track = estimate(x, 32.0, method=method, bias=False, lag_seconds=lag)
        errors.append((track.omega - omega)[middle])
        assert track.standard_deviation is not None
        claimed.append(track.standard_deviation[middle])
    # 16 trials of about two independent windows each: the ratio itself is uncertain by about 15 %.
    assert np.sqrt(np.mean(np.square(errors)) / np.mean(np.square(claimed))) == pytest.approx(1.0, abs=0.35)


def test_deviation_falls_with_the_noise_and_with_the_window() -> None:
    t, x, _ = chirp()
    rng = np.random.default_rng(8)
    noise = rng.normal(size=t.size)

    def typical(level: float, lag: float) -> float:
        track = estimate(x + level * noise, 32.0, method="pseudo-wigner", lag_seconds=lag, bias=False)
        assert track.standard_deviation is not None
        return float(np.median(track.standard_deviation))

    assert typical(0.02, 4.0) / typical(0.01, 4.0) == pytest.approx(2.0, rel=0.05)
    # var = 12 (noise/signal) / (n T^2) times a window constant: the deviation falls with T^(-3/2)
    assert typical(0.01, 3.0) / typical(0.01, 6.0) == pytest.approx(2.0**1.5, rel=0.1)


def test_given_band_picks_the_weaker_of_two_tones() -> None:
    t = np.arange(641) / 32.0
    x = np.cos(2 * np.pi * 1.0 * t) + 0.2 * np.cos(2 * np.pi * 4.3 * t)
    assert np.median(estimate(x, 32.0, method="spectrogram").frequency_hz) == pytest.approx(1.0, abs=1e-3)
    for method in ("spectrogram", "hilbert"):
        track = estimate(x, 32.0, method=method, band=(22.0, 32.0), lag_seconds=3.0)
        assert np.median(track.frequency_hz) == pytest.approx(4.3, abs=2e-3)


def test_bias_is_left_out_or_taken_off_on_request() -> None:
    x = np.cos(2 * np.pi * 1.2 * np.arange(641) / 32.0 + 2.0 * np.sin(0.4 * np.arange(641) / 32.0))
    plain = estimate(x, 32.0, method="pseudo-wigner")
    removed = estimate(x, 32.0, method="pseudo-wigner", remove_bias=True)
    assert plain.bias is not None
    assert np.array_equal(removed.omega, plain.omega - plain.bias)
    assert removed.bias_removed is True
    assert estimate(x, 32.0, method="pseudo-wigner", bias=False).bias is None


def test_harmonic_is_followed_on_request(pendulum_decay: Source) -> None:
    decay = pendulum_decay()
    track = estimate(decay.velocity, 32.0, harmonic=3).inside()
    assert track.method == "phase-locked"
    assert decay.error(track.time, track.omega, multiple=3) < 1e-3


@pytest.mark.parametrize(
    ("x", "arguments", "message"),
    [
        (chirp()[1], {"method": "guess"}, "method 'guess' is unknown; use one of auto, wigner, pseudo-wigner"),
        (np.full(100, 2.0), {}, "signal is constant at 2"),
        (np.r_[chirp()[1], np.nan], {}, r"signal\[641\] is nan"),
        (1e300 * chirp()[1], {}, r"reaches 1e\+300"),
        (1e80 * chirp()[1], {}, r"swings by 1e\+80.*scale it"),
        (1e-80 * chirp()[1], {}, "swings by 1e-80"),
        (np.ones(4), {}, "4 samples; at least 16"),
        (chirp()[1] + 0j, {}, "complex"),
        (chirp()[1], {"band": (5.0, 900.0)}, r"band \(5, 900\).*Nyquist"),
        (chirp()[1], {"band": (9.0, 5.0)}, r"band \(9, 5\).*low < high"),
        (chirp()[1], {"lag_seconds": 30.0, "method": "pseudo-wigner"}, "the signal has 641"),
        (chirp()[1], {"lag_seconds": 20.0, "method": "pseudo-wigner"}, "pseudo-wigner: .* give a longer record"),
        (chirp()[1], {"lag_window": "flat", "method": "pseudo-wigner"}, "window 'flat' is unknown"),
        (chirp()[1], {"lag_window": "gaussian", "method": "synchrosqueezed"}, "window 'gaussian' does not end at zero"),
        (
            chirp()[1],
            {"band_limited": True, "method": "spectrogram"},
            "'spectrogram' has no use for band_limited, which",
        ),
        (chirp()[1], {"single": True}, "'auto' has no use for single, which wigner"),
        (chirp()[1], {"harmonic": 30}, "harmonic 30 reaches .* Nyquist"),
        (
            chirp()[1],
            {"scope": "wide", "method": "harmonic-least-squares"},
            "scope 'wide' is unknown; use one of local",
        ),
        (chirp()[1], {"harmonics": 40, "method": "harmonic-least-squares"}, "window of .* samples is too short"),
        (np.arange(64.0), {"band": (1.0, 2.0)}, r"signal spans .* cycles .* 2\.6 are needed"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(x: np.ndarray, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        estimate(x, 32.0, **arguments)
    assert "\n" not in str(caught.value)


def test_a_band_beyond_what_decimation_leaves_is_cut_off_there() -> None:
    """The search band is found once, on the whole record, and thinned with it."""
    rate = 4000.0
    t = np.arange(40_000) / rate
    x = np.cos(2 * np.pi * 20.0 * t) + 1e-3 * np.random.default_rng(3).normal(size=t.size)
    found = estimation(x, rate, band=(60.0, 6000.0))
    assert found.samples.factor > 4
    assert found.request is not None
    assert found.request.signal.search.limits == pytest.approx((60.0, np.pi * found.samples.rate))
    assert np.abs(found.track.inside().omega / (40.0 * np.pi) - 1.0).max() < 1e-4
