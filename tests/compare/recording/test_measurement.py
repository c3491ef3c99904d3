"""Recordings measured: what is measured, left out, failed and combined."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import amplitude_columns, measure
from ridgeback.compare.recording.measurements import measure_recordings
from ridgeback.numeric.backbone.backbone import backbone
from ridgeback.numeric.recording.recording import Recording

RATE = 20.0
T = np.arange(500) / RATE
QUICK = {"method": "pseudo-wigner", "bias": False}


def recording(samples=500, name="u", units="", run="", stretch=0, clip=np.inf, start=0):
    a = 1.2 * np.exp(-0.05 * T)
    x = np.clip(a * np.cos(7.0 * T), -clip, clip)[start : start + samples]
    t = T[start : start + samples]
    return Recording(t, x, RATE, name, units, "a.csv", "0", run=run, stretch=stretch, clipped=np.abs(x) >= clip)


def noisy():
    noise = 0.001 * np.random.default_rng(1).normal(size=T.size)
    return Recording(T, recording().values + noise, RATE, "u", "", "a.csv", "0")


def test_rows_join_frequency_and_amplitude_and_say_where_there_is_none():
    found = measure(recording(), **QUICK)
    rows = found.rows()
    assert len(rows) == 500
    known = [row for row in rows if np.isfinite(row["amplitude"])]
    assert 300 < len(known) < 500
    for row in known:
        assert row["amplitude"] == pytest.approx(1.2 * np.exp(-0.05 * row["time_s"]), rel=1e-3)
        assert row["growth_rate_per_s"] == pytest.approx(-0.05, abs=1e-3)
    assert found.method == "pseudo-wigner"
    assert found.usable


def test_amplitude_is_not_interpolated_across_points_that_were_left_out():
    """The middle of the record is clipped: between the points before and after it no amplitude is claimed."""
    whole = recording()
    flat = (T > 10.0) & (T < 11.0)
    marked = Recording(whole.time, whole.values, RATE, "u", "", "a.csv", "0", clipped=flat)
    found = measure(marked, **QUICK)
    columns = amplitude_columns(found.backbone, found.found.time)
    assert np.isnan(columns["amplitude"][(T > 9.5) & (T < 11.5)]).all()
    assert np.isfinite(columns["amplitude"][(T > 6.0) & (T < 8.0)]).all()
    assert np.isfinite(columns["amplitude"][(T > 14.0) & (T < 20.0)]).all()


def test_every_valid_time_of_a_clean_decay_has_an_amplitude_to_its_ends():
    rows = measure(noisy()).rows()
    assert all(row["valid"] for row in rows)
    for row in rows:
        spread = 5.0 * row["amplitude_standard_deviation"]
        assert row["amplitude"] == pytest.approx(1.2 * np.exp(-0.05 * row["time_s"]), abs=spread)


def test_values_that_their_own_interval_does_not_hold_are_said_to_be_biased():
    found = measure(noisy(), method="hilbert")
    assert any("--remove-bias" in note for note in found.notes)
    less = measure(noisy(), method="hilbert", remove_bias=True)
    assert not any("--remove-bias" in note for note in less.notes)
    assert all(row["low_95_rad_s"] <= row["omega_rad_s"] <= row["high_95_rad_s"] for row in less.rows() if row["valid"])


def test_the_interval_holds_the_truth_and_is_that_of_the_estimator():
    along = measure(recording(), method="pseudo-wigner").frequency()
    inside = np.isfinite(along.low)
    assert inside.sum() > 300
    assert np.all(along.low[inside] <= along.high[inside])
    halves = measure(recording(), halves=True).frequency()
    assert np.all((halves.low <= 7.0 + 1e-3) & (halves.high >= 7.0 - 1e-3))


def test_a_harmonic_has_no_backbone():
    a = np.exp(-0.02 * T)
    x = a * np.cos(4.0 * T) + 0.1 * a**3 * np.cos(12.0 * T)
    found = measure(Recording(T, x, RATE, "u", "", "a.csv", "0"), harmonic=3, **QUICK)
    assert found.backbone is None
    track = found.frequency()
    known = np.isfinite(track.omega)
    assert np.abs(track.omega[known] - 12.0).max() < 0.05
    for row in found.rows()[50:450:20]:
        expected = 0.1 * np.exp(-0.06 * row["time_s"])
        assert row["amplitude"] == pytest.approx(expected, rel=1e-3)
        assert row["amplitude_low_95"] <= row["amplitude"] <= row["amplitude_high_95"]
    second = measure(Recording(T, x, RATE, "u", "", "a.csv", "0"), harmonic=2, **QUICK)
    assert any(note.startswith("No amplitude") for note in second.notes)


def test_a_short_stretch_is_left_out_and_a_short_signal_fails():
    long, short = recording(stretch=1), recording(samples=40, stretch=2, start=450)
    found = measure_recordings([long, short], **QUICK)
    assert len(found.measured) == 1
    assert found.failed == ()
    assert found.notes[0].startswith("Left out, a.csv, u, stretch 2: signal spans")
    other = measure_recordings([long, recording(samples=40, name="w")], **QUICK)
    assert other.failed[0].startswith("a.csv, w: signal spans")
    assert other.notes == ()
    with pytest.raises(InputError, match="signal spans"):
        measure_recordings([short], **QUICK)


def test_what_is_combined():
    runs = [recording(run="1"), recording(run="2"), recording(name="w", run="1")]
    assert [c.channel for c in measure_recordings(runs, **QUICK).combined] == ["u"]
    (every,) = measure_recordings(runs, combine_over="all", **QUICK).combined
    assert (every.channel, len(every.curve.labels)) == ("all channels", 3)
    assert measure_recordings(runs, combine_over="none", **QUICK).combined == ()
    with pytest.raises(InputError, match="combine 'both' is unknown; use one of runs, all, none"):
        measure_recordings(runs, combine_over="both", **QUICK)
    mixed = [recording(units="mm"), recording(name="w", units="V")]
    with pytest.raises(InputError, match="backbones in V and mm cannot be combined"):
        measure_recordings(mixed, combine_over="all", **QUICK)


def test_a_long_record_is_measured_at_the_rate_of_its_decimated_track(monkeypatch):
    """Amplitude and backbone fit the samples that the track used, not a hundred times as many."""
    seen = []

    def watched(track, x, rate, **rest):
        seen.append((x.size, rate))
        return backbone(track, x, rate, **rest)

    monkeypatch.setattr("ridgeback.compare.recording.measurement.backbone", watched)
    rate = 8000.0
    t = np.arange(64_000) / rate
    x = 2.0 * np.exp(-0.1 * t) * np.cos(10 * np.pi * t) + 0.001 * np.random.default_rng(0).normal(size=t.size)
    found = measure(Recording(t, x, rate, "u", "V", "a.wav", "", clipped=t < 1.0))
    factor = found.track.used.decimated_by
    assert factor > 100
    assert seen == [(found.found.time.size, rate / factor)]
    curve = found.backbone
    assert curve.time.min() > 0.9
    assert np.abs(curve.amplitude / (2.0 * np.exp(-0.1 * curve.time)) - 1.0).max() < 3e-4
    assert np.abs(curve.growth_rate + 0.1).max() < 5e-3


def test_hum_that_is_stronger_than_any_decay_is_named() -> None:
    t = np.arange(2000) / 1000.0
    x = np.cos(2 * np.pi * 50.0 * t + 1.0) + 0.01 * np.random.default_rng(1).normal(size=t.size)
    assert "no decay: a steady tone at" in measure(Recording.from_arrays(x, 1000.0)).notes[0]
    decaying = measure(Recording.from_arrays(np.exp(-0.5 * t) * x, 1000.0))
    assert not any("no decay" in note for note in decaying.notes)


def test_the_reason_stands_first_where_nothing_is_claimed() -> None:
    """Three oscillations whose frequencies cross again and again: no model of one, and none of one with tones."""
    t = np.arange(600) / 40.0
    x = np.cos(2 * np.pi * (3.0 * t + 0.06 * t**2)) + 0.9 * np.cos(2 * np.pi * (5.0 * t - 0.06 * t**2))
    x += 0.8 * np.cos(2 * np.pi * (4.0 * t + 0.5 * np.sin(0.9 * t)))
    found = measure(Recording.from_arrays(x + 0.01 * np.random.default_rng(2).normal(size=t.size), 40.0))
    assert found.track is not None
    assert found.track.interval is None
    assert found.backbone is None
    assert found.notes[0].startswith("No ")


def test_a_measurement_says_how_far_it_is() -> None:
    """From nought to nearly one, signal after signal, by the step that it is at."""
    told: list[tuple[float, str]] = []
    signals = [recording(), recording(name="w")]
    measure_recordings(signals, progress=lambda share, step: told.append((share, step)), **QUICK)
    shares = [share for share, _ in told]
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, pytest.approx(0.9))
    assert {step.rpartition(": ")[0] for _, step in told} == {one.label for one in signals}
    assert len(told) >= 8


def test_missing_samples_that_are_filled_enter_no_fit() -> None:
    """20 of 400 samples are missing: whatever is put there changes nothing, and the note of the gaps names --fill."""
    t, w, draw = np.arange(400) / 40.0, 10.0 * np.pi, np.random.default_rng(3)
    x = np.exp(-0.01 * w * t) * np.cos(w * t + 1.0) + 0.01 * draw.normal(size=t.size)
    x[draw.choice(np.arange(1, 399), 20, replace=False)] = np.nan
    assert any("--fill 0.05" in note for note in Recording.from_arrays(x, 40.0).notes)
    filled = Recording.from_arrays(x, 40.0, fill=0.1)
    assert np.count_nonzero(filled.filled) == 20
    other = replace(filled, values=filled.values + 0.03 * filled.filled)
    found, again = measure(filled).backbone, measure(other).backbone
    assert found is not None
    assert again is not None
    assert_allclose(again.growth_rate, found.growth_rate, rtol=1e-4)
    assert found.omega_sd is not None
    assert np.all(np.abs(found.omega - w) < 4.0 * found.omega_sd)


def test_stretches_too_short_to_measure_are_refused_with_the_fill_that_keeps_them_together():
    short = [recording(30, stretch=i + 1, start=31 * i) for i in range(4)]
    with pytest.raises(
        InputError, match=r"of 4 stretches between gaps the longest has 30 samples: --fill 0\.101 keeps"
    ):
        measure_recordings(short)
