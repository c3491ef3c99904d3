"""Identification of recordings as people have them: borders, clipping, hum, other quantities, and no claim in doubt."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any, NoReturn

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress
from ridgeback.compare.identification import identify as identify_module
from ridgeback.compare.identification import preparation
from ridgeback.compare.identification.candidates import LAWS
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.preparation import prepared
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.identification.shown import Standing
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import duffing, pendulum
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.recording.quantity import as_displacement, as_said
from ridgeback.numeric.recording.recording import Recording

FEW = ("linear", "duffing-hardening")


def near(found: Identification, name: str, truth: float) -> bool:
    """Whether a parameter lies within 3.5 of its deviations."""
    parameter = found.best.parameter(name)
    return abs(parameter.value - truth) < 3.5 * parameter.standard_deviation < 0.05 * abs(truth)


def of(x: Array, rate: float, name: str = "u") -> Recording:
    """A recording with noise of 0.003 of its largest sample."""
    return Recording.from_arrays(
        x + 0.003 * np.abs(x).max() * np.random.default_rng(11).normal(size=x.size), rate, name=name
    )


def test_what_is_held_and_stopped_is_left_out_and_said() -> None:
    t = np.arange(900) / 20.0
    moving = np.exp(-0.01 * (t - 4.0)) * np.cos(6.0 * (t - 4.0))
    found = identify(of(np.where(t < 4.0, 1.0, np.where(t < 40.0, moving, 0.0)), 20.0), candidates=FEW)
    assert found.best.name == "linear"
    assert near(found, "mu", 0.01)
    assert found.unexplained < 0.01
    assert any("the rest is left out" in note for note in found.notes)
    assert not any("wanders" in note for note in found.notes)  # what is held and what is at rest are no drift


def test_clipped_samples_enter_no_fit() -> None:
    t = np.arange(600) / 20.0
    recording = of(np.exp(-0.05 * t) * np.cos(12.0 * t), 20.0)
    clipped = Recording.from_arrays(np.clip(recording.values, -0.6, 0.6), 20.0, name="u")
    found = identify(clipped, candidates=("linear",))
    assert found.samples < 600
    assert near(found, "mu", 0.05)
    assert near(found, "a0", 1.0)


def test_a_span_is_used_alone_and_said() -> None:
    """Too few cycles, too few samples in the span, and too many for fits are refused."""
    t = np.arange(1600) / 20.0
    whole = Recording(t, np.exp(-0.01 * t) * np.cos(6.0 * t), 20.0, "u", "mm", "decay.csv", "")
    part = prepared(whole, span=(10.0, 40.0))
    assert (part.recording.time[0], part.recording.time[-1]) == (10.0, 40.0)
    assert part.notes[0] == "Only times from 10 to 40 were used."
    with pytest.raises(InputError, match=r"decay\.csv: 11 samples lie within 10 to 10\.5"):
        prepared(whole, span=(10.0, 10.5))
    with pytest.raises(InputError, match=r"[45]\.\d cycles are too few to tell oscillators apart; give 6 or more"):
        identify(whole, candidates=("linear",), span=(10.0, 15.0))


def test_more_samples_than_fits_can_hold_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    t = np.arange(1600) / 20.0
    whole = Recording(t, np.exp(-0.01 * t) * np.cos(6.0 * t), 20.0, "u", "mm", "decay.csv", "")
    monkeypatch.setattr(preparation, "MOST_SAMPLES", 400)
    with pytest.raises(InputError, match=r"decay\.csv: \d+ samples are over the budget of 400 for fits"):
        prepared(whole)


def test_a_hum_is_taken_off_and_said() -> None:
    t = np.arange(900) / 15.0
    found = identify(of(np.exp(-0.05 * t) * np.cos(12.0 * t) + 0.05 * np.cos(13.5 * t), 15.0), candidates=FEW)
    assert near(found, "mu", 0.05)
    assert any("a steady tone" in note for note in found.notes)


@pytest.fixture(scope="module")
def accelerated() -> Array:
    dynamics = duffing(k=12.0, eps=60.0, mu=0.05)
    run = integrate(dynamics, (1.0, 0.0), duration=25.0, rate=25.0, rtol=1e-9)
    return np.asarray([-dynamics.force(u, v) for u, v in zip(run.u, run.velocity, strict=True)])


def test_a_waveform_that_contradicts_a_displacement_is_refused(accelerated: Array) -> None:
    recording = of(accelerated, 25.0)
    with pytest.raises(InputError, match="waveform contradicts a displacement, and is that of an acceleration"):
        identify(recording, candidates=FEW)
    found = identify(as_displacement(recording, "acceleration"), candidates=FEW)
    assert found.best.name == "duffing-hardening"
    assert near(found, "mu", 0.05)
    assert near(found, "eps", 60.0)
    insisted = identify(as_displacement(recording, "displacement"), candidates=FEW)
    assert "No class comes down to the noise: the best candidate leaves" in insisted.verdict
    assert all(math.isnan(one.standard_deviation) for one in insisted.best.parameters)


def test_a_swing_from_near_the_separatrix_is_a_displacement() -> None:
    """Turned into that behind a velocity, its amplitude comes out beyond all measure: that speaks for nothing."""
    run = integrate(pendulum(k=1.0, mu=0.01), (2.9845, 0.0), duration=120.0, rate=8.0, rtol=1e-9)
    found = identify(of(run.u, 8.0), candidates=("linear", "pendulum"), laws=LAWS[:1])
    assert found.best.name == "pendulum"


def test_a_name_that_says_another_quantity_is_believed(accelerated: Array) -> None:
    recording = of(accelerated, 25.0, name="acc_z")
    with pytest.raises(InputError, match="give --quantity acceleration"):
        identify(recording, candidates=FEW)
    assert "--quantity acceleration converts it" in as_said(recording, None).notes[0]
    assert as_said(recording, "acceleration").notes[0].startswith("The acceleration was converted")


def test_no_interval_is_claimed_where_no_candidate_describes_the_samples() -> None:
    t = np.arange(240) / 8.0
    jumping = np.where(t < 15.0, np.cos(6.0 * t), np.cos(8.0 * t))
    found = identify(of(jumping, 8.0), candidates=("linear",), laws=LAWS[:1])
    assert found.unclaimed
    assert found.unclaimed in found.verdict
    assert np.isnan(found.best.omega_low).all()


def test_a_struck_twice_record_names_no_class_before_saying_why() -> None:
    t = np.arange(240) / 8.0
    after = np.maximum(t - 13.0, 0.0)
    blow = np.where(t < 13.0, np.exp(-0.05 * t) * np.cos(6.0 * t), np.exp(-0.05 * after) * np.cos(6.0 * after + 2.0))
    found = identify(of(blow, 8.0), candidates=("linear",), laws=LAWS[:1])
    assert found.standing is Standing.DOUBTED
    assert found.title == "No class is claimed: no model of one oscillation holds"
    assert found.verdict.startswith(f"No class is claimed: {found.doubt}. The nearest is Linear oscillator")
    assert all(math.isnan(one.standard_deviation) for one in found.best.parameters)


def test_a_class_whose_waveform_is_another_claims_nothing() -> None:
    """A cosine without the third harmonic of a Duffing oscillator: it leaves but little more than the noise."""
    t = np.arange(800) / 20.0
    a = np.exp(-0.0628 * t)
    cosine = a * np.cos(12.566 * t + 0.628 * (1.0 - a**2) / (2.0 * 0.0628))
    noisy = Recording.from_arrays(cosine + 0.001 * np.random.default_rng(3).normal(size=800), 20.0)
    named = identify(noisy, candidates=("duffing-hardening",))
    assert named.misfit.ratio < 1.5
    assert named.standing is Standing.NEAREST
    assert all(math.isnan(one.standard_deviation) for one in named.best.parameters)
    free = identify(noisy, candidates=("duffing-hardening", "backbone-polynomial"), laws=LAWS[:1])
    assert free.best.name == "backbone-polynomial"
    assert near(free, "mu", 0.0628)
    assert near(free, "a0", 1.0)


def test_a_folded_harmonic_is_no_mode_beside() -> None:
    """Five samples a cycle: the third harmonic comes down as a tone of its own, which goes with the class."""
    run = integrate(duffing(eps=0.8, mu=0.004), (1.0, 0.0), duration=150.0, rate=1.0, rtol=1e-9)
    values = run.u + 0.002 * np.random.default_rng(4).normal(size=run.u.size)
    found = identify(Recording.from_arrays(values, 1.0), candidates=("duffing-hardening",), laws=LAWS[:1])
    assert not any("taken off" in note for note in found.notes)
    assert near(found, "eps", 0.8)


def test_a_zero_that_wanders_is_no_misfit_of_a_class() -> None:
    t = np.arange(600) / 12.0
    recording = of(np.exp(-0.03 * t) * np.cos(6.0 * t) + 0.02 * np.sin(0.12 * t), 12.0)
    found = identify(recording, candidates=("linear",), laws=LAWS[:1])
    assert found.standing is Standing.CLAIMED
    mu = found.best.parameter("mu")
    assert abs(mu.value - 0.03) < 3.5 * mu.standard_deviation


def test_progress_never_goes_back_while_other_readings_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each attempt ranks all candidates again, and tells its own share of the work."""
    seen: list[float] = []

    def refused(ready: object, *rest: Any) -> NoReturn:
        progress: Progress = rest[-1]
        for share in (0.1, 0.5, 0.9):
            progress(share, "fits")
        raise InputError(f"{ready} has too few cycles")

    monkeypatch.setattr(identify_module, "attempt", refused)
    ready: Any = SimpleNamespace(others=lambda: iter(("whole", "windows")))
    with pytest.raises(InputError, match="has too few cycles"):
        identify_module.attempted(ready, ("linear",), ("linear",), "bic", lambda share, _: seen.append(share))
    assert len(seen) == 9
    assert seen == sorted(seen)
    assert seen[-1] < 0.9
