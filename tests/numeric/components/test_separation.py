"""What shares a band with an oscillation is found, and the intervals of the oscillation hold beside it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.lines import clearest_line, colour
from ridgeback.numeric.components.separation import separated
from ridgeback.numeric.components.tones import Tone, fitted_tone
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.spline_basis import normal_equations, spline_basis
from tests.numeric.holding import assert_holds, excess

RATE, OMEGA = 400.0, 40 * np.pi
T = np.arange(800) / RATE


def decay(seed: int, noise: float = 0.01, ratio: float = 0.01) -> Array:
    """A damped oscillation in white noise."""
    rng = np.random.default_rng(seed)
    clean = np.exp(-ratio * OMEGA * T) * np.cos(OMEGA * T + rng.uniform(0, 6))
    return np.asarray(clean + noise * rng.normal(size=T.size))


def test_the_variance_beside_other_columns_is_that_of_the_whole_matrix() -> None:
    rng = np.random.default_rng(1)
    weights, beside = rng.normal(size=(T.size, 2)), rng.normal(size=(T.size, 3))
    basis = spline_basis(T, np.array([0.0, 0.7, T[-1]]))
    equations = normal_equations(basis, lambda part: weights[part.rows], 2)
    alone = equations.variance(0, slopes=True)
    equations = replace(equations, beside=beside)
    every = np.arange(T.size)
    values, slopes = (basis.rows_at(every, slopes=wanted).toarray() for wanted in (False, True))
    dense = (values[:, :, None] * weights[:, None, :]).reshape(T.size, -1)
    both, size = np.c_[dense, beside], dense.shape[1]
    covariance = np.linalg.inv(both.T @ both)[:size:2, :size:2]
    expected = np.einsum("nk,kl,nl->n", slopes, covariance, slopes)
    assert_allclose(equations.variance(0, slopes=True), expected, rtol=1e-6)
    few = basis.rows_at(every[::100], slopes=True)
    assert_allclose(equations.variance_of(few, 0), expected[::100], rtol=1e-6)
    assert np.all(equations.variance(0, slopes=True) > alone)


@pytest.mark.parametrize(("at", "growth"), [(22.5, 0.0), (21.5, -0.5), (30.0, -3.0)])
def test_a_component_beside_the_oscillation_is_found_for_what_it_is(at: float, growth: float) -> None:
    other = 0.3 * np.exp(growth * T) * np.cos(2 * np.pi * at * T + 1.0)
    found = separated(decay(2) + other, RATE, np.full(T.size, OMEGA), half=40, multiples=None)
    (tone,) = found.tones
    assert tone.omega / (2 * np.pi) == pytest.approx(at, abs=0.05)
    assert tone.growth == pytest.approx(growth, abs=0.3)
    assert (tone.growth == 0.0) == (growth == 0.0)
    assert np.abs(tone.samples(T) - other).max() < 0.02
    assert found.models.best.noise == pytest.approx(0.01, rel=0.1)
    assert found.reason == ""


@pytest.mark.parametrize("at", [21.5, 30.0])
def test_a_mode_that_dies_in_two_cycles_is_found_and_does_not_bend_the_start(at: float) -> None:
    other = 0.4 * np.exp(-30.0 * T) * np.cos(2 * np.pi * at * T + 1.0)
    found = separated(decay(2, noise=1e-3) + other, RATE, np.full(T.size, OMEGA), half=40, multiples=None)
    (tone,) = found.tones
    assert tone.growth == pytest.approx(-30.0, rel=0.05)
    assert found.models.best.omega[0] == pytest.approx(OMEGA, abs=0.1)
    assert found.models.best.multiples == ()
    assert found.reason == ""


def test_intervals_hold_beside_hum() -> None:
    hits, widths = [], []
    for seed in range(5):
        hum = 0.1 * np.cos(2 * np.pi * 22.5 * T + seed)
        track = estimate(decay(seed) + hum, RATE)
        assert track.interval is not None
        hits.append(track.interval.holds(np.full(track.time.size, OMEGA)))
        widths.append(excess(track.interval.low, track.interval.high, OMEGA))
        assert len(track.used.tones) == 1
    assert np.mean(np.concatenate(hits)) > 0.85
    assert np.median(widths) < 4.0
    assert estimate(decay(0), RATE).used.tones == ()


def test_spikes_are_counted_and_do_not_bend_a_fit() -> None:
    x = decay(3)
    x[[100, 333, 600]] += [1.0, -1.5, 0.8]
    track = estimate(x, RATE)
    assert track.used.spikes == 3
    assert track.used.noise == pytest.approx(0.01, rel=0.1)
    assert estimate(decay(3), RATE).used.spikes == 0


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("share", [0.01, 0.03])
def test_large_spikes_among_the_samples_leave_a_model(share: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    odd = np.flatnonzero(rng.random(T.size) < share)
    x = decay(5, ratio=0.004)
    x[odd] += rng.choice([-1.0, 1.0], odd.size) * rng.uniform(0.5, 8.0, odd.size)
    track = estimate(x, RATE)
    assert track.used.spikes == odd.size
    assert track.used.noise == pytest.approx(0.01, rel=0.1)
    assert track.interval is not None
    assert track.interval.holds(np.full(T.size, OMEGA)).mean() > 0.6


def test_noise_that_grows_holds_no_spikes() -> None:
    rng = np.random.default_rng(1)
    x = decay(6, noise=0.0, ratio=0.004) + rng.normal(size=T.size) * np.where(T < 1.0, 0.004, 0.04)
    assert estimate(x, RATE).used.spikes == 0


@pytest.mark.parametrize("kind", ["jitter", "of the signal", "growing"])
def test_intervals_hold_in_noise_that_is_not_the_same_everywhere(kind: str) -> None:
    hits = []
    for seed in range(4):
        rng = np.random.default_rng(seed)
        time = T + 2e-4 * rng.normal(size=T.size) * (kind == "jitter")
        x = np.exp(-0.004 * OMEGA * time) * np.cos(OMEGA * time + rng.uniform(0, 6))
        x *= 1.0 + 0.05 * rng.normal(size=T.size) * (kind == "of the signal")
        loud = np.where(T < 1.0, 0.004, 0.04) if kind == "growing" else 0.002
        track = estimate(x + loud * rng.normal(size=T.size), RATE)
        assert track.used.spikes == 0
        assert track.interval is not None
        hits.append(track.interval.holds(np.full(T.size, OMEGA)).mean())
    assert np.mean(hits) > 0.9


def test_clipped_samples_enter_no_model() -> None:
    x = decay(4, noise=0.002, ratio=0.004)
    flat = np.abs(x) >= 0.7
    clipped = np.clip(x, -0.7, 0.7)
    right = separated(clipped, RATE, np.full(T.size, OMEGA), half=40, multiples=None, excluded=flat)
    assert right.models.best.multiples == ()
    assert np.abs(right.models.best.size / np.exp(-0.004 * OMEGA * T) - 1.0).max() < 0.01
    assert np.abs(right.x - x)[flat].max() < 0.02


def test_noise_is_judged_near_the_oscillation() -> None:
    rng = np.random.default_rng(5)
    white = rng.normal(size=4000)
    assert 0.8 < colour(white, RATE, OMEGA, 6) < 1.25
    steps = np.cumsum(white)
    spectrum = np.abs(np.fft.rfft(steps)) ** 2
    near = spectrum[150:250].mean() / spectrum[1:].mean()
    assert colour(steps, RATE, OMEGA, 6) == pytest.approx(near, rel=0.5)
    assert all(clearest_line(np.random.default_rng(s).normal(size=500), RATE) is None for s in range(30))


def test_a_tone_meets_its_bound() -> None:
    true = Tone(50.0, -0.4, 0.2 * np.exp(1j))
    bound = 0.01 * np.sqrt(np.diag(np.linalg.inv(true.tangent(T).T @ true.tangent(T))))
    found = [
        fitted_tone(true.samples(T) + 0.01 * np.random.default_rng(s).normal(size=T.size), T, 50.5, np.ones(T.size))
        for s in range(40)
    ]
    assert np.std([tone.omega for tone in found]) == pytest.approx(bound[2], rel=0.3)
    assert np.std([tone.growth for tone in found]) == pytest.approx(bound[3], rel=0.3)


def test_close_modes_are_told_apart_by_a_plain_oscillation() -> None:
    """Two beats a record: many knots could follow them, which leave no line."""
    t = np.arange(2400) / RATE
    rng = np.random.default_rng(2)
    x = sum(a * np.exp(-0.38 * t) * np.cos(2 * np.pi * f * t) for a, f in ((1.0, 20.0), (0.5, 20.4)))
    track = estimate(x + 0.01 * rng.normal(size=t.size), RATE)
    assert [round(tone.omega / (2 * np.pi), 1) for tone in track.used.tones] == [20.4]
    assert track.interval is not None
    assert_holds(track.interval, np.full(t.size, 2 * np.pi * 20.0), share=0.8, within=1e-4)


@pytest.mark.parametrize("seed", [1, 2])
def test_modes_that_cross_claim_nothing(seed: int) -> None:
    """A frequency that falls from 22 through a mode at 21.5."""
    t = np.arange(1600) / RATE
    a = np.exp(-0.4 * t)
    phase = 2 * np.pi * 20.0 * (t + 0.1 * (1.0 - a**2) / 0.8)
    other = 0.3 * np.exp(-0.54 * t) * np.cos(2 * np.pi * 21.5 * t + seed)
    x = a * np.cos(phase) + other + 0.01 * np.random.default_rng(seed).normal(size=t.size)
    assert estimate(x, RATE).no_interval is not None


def test_a_frequency_that_jumps_claims_nothing() -> None:
    t = np.arange(240) / 8.0
    x = np.where(t < 15.0, np.cos(6.0 * t), np.cos(8.0 * t)) + 0.003 * np.random.default_rng(1).normal(size=240)
    assert estimate(x, 8.0).no_interval is not None


def test_a_band_isolates_the_weaker_of_two_modes_up_to_the_ends() -> None:
    t = np.arange(1200) / RATE
    rng = np.random.default_rng(6)
    x = sum(a * np.exp(-0.6 * t) * np.cos(2 * np.pi * f * t) for a, f in ((1.0, 20.0), (0.4, 31.0)))
    band = (2 * np.pi * 25.0, 2 * np.pi * 37.0)
    track = estimate(x + 0.01 * rng.normal(size=t.size), RATE, band=band)
    assert track.interval is not None
    assert_holds(track.interval, np.full(t.size, 2 * np.pi * 31.0), share=0.8, within=2e-4)
    assert np.abs(track.omega / (2 * np.pi * 31.0) - 1.0).max() < 0.01
    assert any(abs(tone.omega / (2 * np.pi) - 20.0) < 0.1 for tone in track.used.tones)


@pytest.mark.parametrize(("method", "within"), [("auto", 1.5e-3), ("pseudo-wigner", 0.06), ("zero-crossing", 0.12)])
def test_a_band_holds_what_is_in_it_beside_a_stronger_hum_just_beyond(method: str, within: float) -> None:
    t = np.arange(1600) / RATE
    hum = np.cos(2 * np.pi * 50.02 * t + 1.0) + 0.01 * np.random.default_rng(5).normal(size=t.size)
    band = (200.0, 260.0)
    x = 0.25 * np.exp(-1.86 * t) * np.cos(2 * np.pi * 37.0 * t) + hum
    track = estimate(x, RATE, band=band, method=method).inside()
    assert track.interval is not None
    assert track.time.size > 4
    assert ((track.omega > band[0]) & (track.omega < band[1])).all()
    assert_holds(track.interval, np.full(track.time.size, 2 * np.pi * 37.0), share=0.8, within=within)
    assert [tone.mains for tone in track.used.tones] == [True]


def test_a_band_holds_a_weaker_mode_near_twice_one_that_softens() -> None:
    t = np.arange(1200) / RATE
    size = np.exp(-0.9 * t)
    softening = size * np.cos(2 * np.pi * (20.0 * t - 0.2 * (1.0 - size**2) / 1.8))
    x = (
        softening
        + 0.2 * np.exp(-0.6 * t) * np.cos(2 * np.pi * 40.5 * t)
        + 0.01 * np.random.default_rng(6).normal(size=1200)
    )
    track = estimate(x, RATE, band=(220.0, 290.0)).inside()
    assert track.interval is not None
    assert_holds(track.interval, np.full(track.time.size, 2 * np.pi * 40.5), share=0.8, within=4e-4)
    (tone,) = track.used.tones
    assert tone.bends
    assert np.abs(tone.samples(t) - softening).max() < 0.03


def test_what_a_band_cannot_hold_is_refused() -> None:
    t = np.arange(1600) / RATE
    x = np.cos(2 * np.pi * 50.0 * t) + 0.01 * np.random.default_rng(5).normal(size=t.size)
    assert not estimate(x, RATE, band=(200.0, 260.0)).valid.any()


def test_a_frequency_that_jumps_by_a_few_per_cent_gets_no_interval_and_one_that_swings_does() -> None:
    t = np.arange(800) / 40.0
    noise = 0.01 * np.random.default_rng(53).normal(size=800)
    jumping = np.cos(6 * np.pi * (t + 0.035 * np.maximum(t - 11.75, 0.0)))
    swinging = np.cos(6 * np.pi * t + 0.3 * np.sin(0.5 * t))
    jumps, swings = (estimate(x + noise, 40.0).no_interval for x in (jumping, swinging))
    assert (jumps or "").startswith("the frequency jumps near t = 11.7")
    assert swings is None


def test_a_mode_that_is_not_linear_is_taken_off_as_it_changes() -> None:
    """26 (1 + 0.3 a^2) from a = 0.4 on beside 20: its frequency at first, and an interval for the other."""
    t, fall = np.arange(1200) / 400.0, 0.98
    turned = 2 * np.pi * 26.0 * (t + 0.3 * 0.16 * (1.0 - np.exp(-2 * fall * t)) / (2 * fall))
    noise = 0.012 * np.random.default_rng(7).normal(size=t.size)
    x = np.exp(-0.75 * t) * np.cos(40 * np.pi * t) + 0.4 * np.exp(-fall * t) * np.cos(turned + 1.0) + noise
    track = estimate(x, 400.0)
    (mode,) = track.used.tones
    assert mode.bends
    assert mode.omega == pytest.approx(2 * np.pi * 26.0 * 1.048, rel=3e-3)
    assert track.interval is not None
    assert np.mean(track.interval.holds(40 * np.pi)[track.valid]) > 0.8


@pytest.mark.parametrize(
    ("mode", "others"),
    [(26.0, (50.0,)), (33.0, (50.0,)), (48.0, (50.0, 150.0)), (22.37, (100.0,)), (20.0, (40.6,)), (20.0, (61.0,))],
    ids=["near twice", "just outside the search band", "two at once", "out of the band", "2.03 times", "3.05 times"],
)
def test_a_tone_anywhere_in_the_spectrum_is_found_and_intervals_hold_beside_it(
    mode: float, others: tuple[float, ...]
) -> None:
    t = np.arange(1600) / 800.0
    w, noise = 2 * np.pi * mode, 0.006 * np.random.default_rng(round(mode)).normal(size=t.size)
    tones = sum(0.05 * np.cos(2 * np.pi * at * t + 1.0) for at in others)
    track = estimate(np.exp(-0.008 * w * t) * np.cos(w * t + 0.3) + tones + noise, 800.0)
    assert [
        tone.omega / (2 * np.pi) for tone in sorted(track.used.tones, key=lambda tone: tone.omega)
    ] == pytest.approx(others, abs=0.02)
    assert all(tone.growth == 0.0 for tone in track.used.tones)
    assert track.interval is not None
    assert np.mean(track.interval.holds(np.full(track.time.size, w))[track.valid]) > 0.8
    assert np.median(track.standard_deviation) < 0.05
    assert mode > 33.0 or track.used.span is None  # a steady tone does not hide the end of a decay


def test_harmonics_of_an_oscillation_are_no_tones_beside_it() -> None:
    """Phase-locked to a frequency that falls with the amplitude by 2 %, the third one folded."""
    t = np.arange(900) / 100.0
    a = np.exp(-0.3 * t)
    phase = 2 * np.pi * (20.0 * t - 0.4 * (1.0 - a**2) / 0.6)
    x = a * np.cos(phase) + 0.05 * a**2 * np.cos(2 * phase + 1.0) + 0.05 * a**3 * np.cos(3 * phase)
    track = estimate(x + 0.003 * np.random.default_rng(1).normal(size=t.size), 100.0)
    assert track.used.tones == ()
    assert track.interval is not None


def test_a_hum_is_found_beside_a_clipped_oscillation() -> None:
    hum = 0.1 * np.cos(2 * np.pi * 24.0 * T + 1.0)
    x = np.clip(decay(3, 0.004, 0.005) + hum, -0.6, 0.6)
    found = separated(x, RATE, np.full(T.size, OMEGA), half=40, multiples=None, excluded=np.abs(x) == 0.6)
    (tone,) = found.tones
    assert found.reason == ""
    assert np.abs(tone.samples(T) - hum).max() < 0.005
