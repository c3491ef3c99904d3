"""Gaps, uneven times, clipping and drift: found, named with their places, and treated by the stated rule."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.recording.clipping import clipped
from ridgeback.numeric.recording.drift import detrended, slow_part, wandering
from ridgeback.numeric.recording.reading import read_recording, read_recordings
from ridgeback.numeric.recording.uniform import Uniform, grid_of, resampled, rms, spline_values
from ridgeback.numeric.signal.search_band import find_search_band

RATE = 20.0
T = np.arange(600) / RATE
X = np.cos(5.0 * T) + 0.2


def wave(t: np.ndarray) -> np.ndarray:
    return np.cos(5.0 * t) + 0.2


def written(path: Path, t: np.ndarray, *columns: np.ndarray, header: str = "t,u") -> Path:
    def cell(value: float) -> str:
        return "" if np.isnan(value) else repr(float(value))

    rows = [",".join(map(cell, row)) for row in zip(t, *columns, strict=True)]
    path.write_text(header + "\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return path


def test_one_missing_value_cuts_the_signal_in_two_and_nothing_else(tmp_path: Path) -> None:
    x = X.copy()
    x[200] = np.nan
    found = read_recordings([written(tmp_path / "a.csv", T, x)])
    assert [r.values.size for r in found] == [200, 399]
    assert [r.stretch for r in found] == [1, 2]
    assert np.array_equal(np.concatenate([r.values for r in found]), np.delete(X, 200))
    assert found[1].time[0] == pytest.approx(T[201])
    assert [r.rate for r in found] == pytest.approx([RATE, RATE])
    assert found[0].facts["missing"] == 1
    assert found[0].facts["gaps"] == [[T[199], T[201]]]
    assert any("1 gap: t = 9.95 to 10.05 (1 missing)" in note for note in found[0].notes)


@pytest.mark.parametrize("lost", ["time", "row"])
def test_a_missing_time_and_a_missing_row_are_gaps_too(tmp_path: Path, lost: str) -> None:
    t = T.copy()
    t[300] = np.nan
    path = written(tmp_path / "a.csv", t, X)
    if lost == "row":
        path.write_text("\n".join(line for line in path.read_text().splitlines() if not line.startswith(",")))
    found = read_recordings([path])
    assert [r.values.size for r in found] == [300, 299]
    assert np.array_equal(found[1].values, X[301:])


def test_the_single_reader_takes_the_longest_stretch_and_says_so(tmp_path: Path) -> None:
    x = X.copy()
    x[100:150] = np.nan
    found = read_recording(written(tmp_path / "a.csv", T, x))
    assert found.values.size == 450
    assert any("longest of 2 stretches" in note for note in found.notes)
    assert any("(50 missing)" in note for note in found.notes)


def test_short_stretches_are_left_out_by_name(tmp_path: Path) -> None:
    x = X.copy()
    x[[100, 110]] = np.nan
    found = read_recordings([written(tmp_path / "a.csv", T, x)])
    assert [r.values.size for r in found] == [100, 489]
    assert any(note.startswith("Left out") and "t = 5.05 to 5.45" in note for note in found[0].notes)
    assert found[0].facts["left_out"] == 1


def test_filling_is_done_when_asked_and_only_as_far_as_asked(tmp_path: Path) -> None:
    x = X.copy()
    x[200], x[300:310] = np.nan, np.nan
    path = written(tmp_path / "a.csv", T, x)
    found = read_recordings([path], fill=0.12)
    assert [r.values.size for r in found] == [300, 290]
    first = found[0]
    assert np.flatnonzero(first.filled).tolist() == [200]
    off = abs(first.values[200] - X[200])
    assert off < 1e-4
    kept = ~first.filled
    assert np.array_equal(first.values[kept], X[:300][kept])
    assert any("1 missing samples were interpolated" in note and "errs by about" in note for note in first.notes)
    (whole,) = read_recordings([path], fill=1.0)
    assert np.count_nonzero(whole.filled) == 11
    off = np.abs(whole.values - X)[whole.filled]
    assert np.sqrt(np.mean(off**2)) < 2 * whole.facts["interpolation_error"] * np.std(X)
    x[100:130] = np.nan  # more than a whole cycle
    with pytest.raises(InputError, match=r"interpolation would err by about \d+% of the rms; --fill shorter gaps"):
        read_recordings([written(tmp_path / "b.csv", T, x)], fill=5.0)


def test_the_slow_part_of_a_short_record_is_a_mean_over_at_most_its_length() -> None:
    """Written out: Blackman's window over 2 * 20 + 1 samples, and of it what lies within the record."""
    x = np.cos(0.3 * np.arange(41.0)) + 0.02 * np.arange(41.0)
    s = np.arange(-20, 21) / 21.0
    w = 0.42 + 0.5 * np.cos(np.pi * s) + 0.08 * np.cos(2 * np.pi * s)
    near = [(max(0, i - 20), min(41, i + 21), i) for i in range(41)]
    means = [np.average(x[a:b], weights=w[a - i + 20 : b - i + 20]) for a, b, i in near]
    assert np.allclose(slow_part(x, 1.0), means, atol=1e-12)


@pytest.mark.parametrize("slower", [1.0, 200.0])
def test_nearly_even_times_are_interpolated_and_say_so(tmp_path: Path, slower: float) -> None:
    t = T + 0.06 / RATE * np.sin(T)
    found = read_recording(written(tmp_path / "a.csv", slower * t, wave(t)))
    assert found.facts["interpolation_error"] < 1e-3
    assert found.facts["filled"] == 0
    assert slower * found.rate == pytest.approx(RATE, rel=1e-3)
    assert np.abs(found.values - wave(found.time / slower)).max() < 1e-4
    assert any("uneven times were resampled" in note.lower() for note in found.notes)


def test_uneven_times_are_refused_until_a_rate_is_given(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    t = np.cumsum(rng.uniform(0.5, 1.5, 800)) / 40.0
    path = written(tmp_path / "a.csv", t, wave(t))
    with pytest.raises(InputError, match=r"\d+ of 799 steps .*for instance by --resample 40\.\d+, or"):
        read_recording(path)
    found = read_recording(path, resample=40.0)
    inside = slice(20, -20)
    error = np.abs(found.values - wave(found.time))[inside]
    assert found.rate == 40.0
    assert error.max() < 1e-3
    assert np.sqrt(np.mean(error**2)) < found.facts["interpolation_error"]  # the cubic errs more than the quintic
    with pytest.raises(InputError, match="would alias"):
        read_recording(path, resample=10.0)


def test_times_scattered_at_random_are_resampled_with_the_error_that_is_stated(tmp_path: Path) -> None:
    t = np.sort(np.random.default_rng(3).uniform(0.0, 30.0, 1500))
    path = written(tmp_path / "a.csv", t, wave(t))
    with pytest.raises(InputError, match="of 1499 steps of the time differ"):
        read_recording(path)
    found = read_recording(path, resample=60.0, fill=0.3)
    error = (found.values - wave(found.time))[10:-10]
    stated = found.facts["interpolation_error"] * np.std(X)
    assert np.sqrt(np.mean(error**2)) < stated < 0.02


def test_a_gap_among_uneven_times_stays_a_gap(tmp_path: Path) -> None:
    rng = np.random.default_rng(6)
    t = np.cumsum(rng.uniform(0.5, 1.5, 800)) / 40.0
    t[400:] += 2.0
    found = read_recordings([written(tmp_path / "a.csv", t, wave(t))], resample=40.0)
    assert len(found) == 2
    assert found[1].time[0] == pytest.approx(t[400])


def test_a_lower_rate_is_filtered_first(tmp_path: Path) -> None:
    """What lies above the new Nyquist frequency is gone, what lies below is kept."""
    high = 0.5 * np.cos(2 * np.pi * 8.0 * T)
    found = read_recording(written(tmp_path / "a.csv", T, X + high), resample=10.0)
    assert any("which took off 20 % of the signal's energy" in note for note in found.notes)
    assert found.rate == 10.0
    assert np.abs(found.values - wave(found.time)).max() < 5e-3
    finer = read_recording(written(tmp_path / "b.csv", T, X), resample=50.0)
    assert np.abs(finer.values - wave(finer.time)).max() < 1e-4


def test_clipping_is_found_in_samples_and_places(tmp_path: Path) -> None:
    a = 1.5 * np.exp(-0.1 * T)
    x = np.clip(a * np.cos(5.0 * T), -1.0, 1.0)
    found = read_recording(written(tmp_path / "a.csv", T, x))
    truth = np.abs(x) >= 1.0
    assert np.array_equal(found.clipped, truth & clipped(x))
    assert np.count_nonzero(found.clipped) == pytest.approx(np.count_nonzero(truth), abs=2)
    assert any("flat tops are clipped: t = 0 to" in note for note in found.notes)


@pytest.mark.parametrize("bits", [4, 6, 8, 12, 16])
@pytest.mark.parametrize("rate", [8, 40, 200])
def test_a_digitised_sine_is_not_taken_for_clipped(bits: int, rate: int) -> None:
    t = np.arange(20 * rate) / rate
    rounded = np.round(np.sin(2 * np.pi * t + 0.1) * 2 ** (bits - 1)) / 2 ** (bits - 1)
    assert not clipped(rounded).any()
    cut = np.clip(rounded, -0.7, 0.7)
    if bits > 4 and rate > 8:
        assert clipped(cut).any()


@given(st.integers(3, 12), st.floats(8.0, 300.0), st.floats(0.0, 6.3), st.floats(0.2, 1.0), st.floats(0.0, 0.2))
@settings(deadline=None, max_examples=200)
def test_no_sine_or_decay_of_any_resolution_is_taken_for_clipped(
    bits: int, rate: float, phase: float, size: float, mu: float
) -> None:
    t = np.arange(int(6 * rate)) / rate
    x = size * np.exp(-mu * t) * np.sin(2 * np.pi * t + phase)
    assert not clipped(np.round(x * 2 ** (bits - 1)) / 2 ** (bits - 1)).any()


def test_drift_is_named_and_removed_only_when_asked(tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", T, X + 0.05 * T)
    plain = read_recording(path)
    assert np.array_equal(plain.values, X + 0.05 * T)
    assert any("local mean wanders" in note for note in plain.drift_notes())
    for how in ("linear", "slow"):
        found = read_recording(path, detrend=how)
        inside = slice(100, -100)
        assert np.abs(found.values - np.cos(5.0 * T))[inside].max() < 0.03
        assert any("was removed" in note for note in found.notes)
    assert wandering(X, RATE) < 0.02
    with pytest.raises(InputError, match="detrend 'cubic' is unknown; use one of none, linear, slow"):
        read_recording(path, detrend="cubic")


def test_the_slow_part_of_a_slow_curve_is_the_curve() -> None:
    curve = 0.3 * np.sin(0.1 * T)
    assert np.abs(slow_part(np.cos(5.0 * T) + curve, RATE) - curve)[100:-100].max() < 0.02
    assert np.abs(detrended(2.0 + 3.0 * T, RATE, "linear")).max() < 1e-9


def test_runs_by_a_column_and_by_files(tmp_path: Path) -> None:
    run = np.where(np.arange(600) < 250, 7.0, 3.0)
    t = np.where(run == 7.0, T, T - T[250])
    path = written(tmp_path / "a.csv", t, run, X, 2 * X, header="t,shot,u [mm],w [mm]")
    found = read_recordings([path], columns="u,w", run_column="shot")
    assert [(r.run, r.name, r.values.size) for r in found] == [
        ("shot 7", "u", 250),
        ("shot 3", "u", 350),
        ("shot 7", "w", 250),
        ("shot 3", "w", 350),
    ]
    assert found[0].channel == "u [mm]"
    other = written(tmp_path / "b.csv", T, X)
    both = read_recordings([other, written(tmp_path / "c.csv", T, 2 * X)])
    assert [r.run for r in both] == ["b.csv", "c.csv"]
    assert both[0].label == "b.csv, u"
    (tmp_path / "again").mkdir()
    same = read_recordings([other, written(tmp_path / "again" / "b.csv", T, X)])
    assert [r.run for r in same] == [str(other), str(tmp_path / "again" / "b.csv")]
    second = written(tmp_path / "d.csv", t, run, X, header="t,shot,u")
    shots = read_recordings([path, second], columns="u", run_column="shot")
    assert [r.run for r in shots] == ["a.csv, shot 7", "a.csv, shot 3", "d.csv, shot 7", "d.csv, shot 3"]
    assert shots[0].label == "a.csv, shot 7, u"
    assert found[0].label == "a.csv, shot 7, u"
    with pytest.raises(InputError, match=r"column shot is the run|has no column"):
        read_recordings([path], columns="shot", run_column="shot")


def test_all_channels_and_names_with_commas(tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", T, X, 2 * X, header='t,"u, left",w')
    assert [r.name for r in read_recordings([path], columns="all")] == ["u, left", "w"]
    assert [r.name for r in read_recordings([path], columns="u, left")] == ["u, left"]
    assert [r.name for r in read_recordings([path], columns=[3, "u, left"])] == ["w", "u, left"]


@given(st.integers(2, 60), st.floats(0.01, 100.0), st.floats(-1e3, 1e3))
@settings(deadline=None, max_examples=60)
def test_a_grid_with_rows_missing_is_counted(count: int, step: float, start: float) -> None:
    k = np.arange(3 * count)
    k = k[(k % 7 != 3) & (k % 11 != 5)]
    grid = grid_of(start + step * k, step * 1.001)
    assert np.array_equal(grid.k, k - k[0])
    assert grid.step == pytest.approx(step, rel=1e-9)


def test_the_spline_error_falls_as_the_step() -> None:
    """The stated error is the cubic spline's, of order four in the step."""
    at = np.linspace(2.0, 8.0, 501)
    errors = [rms(spline_values(t := np.linspace(0.0, 10.0, n), np.sin(t), at)[1]) for n in (51, 101, 201)]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([4.0, 4.0], abs=0.3)


def test_resampling_there_and_back_gives_the_signal() -> None:
    none = np.zeros(T.size, dtype=bool)
    finer = resampled(Uniform(0.0, RATE, X, none, none, 0.0, ""), 3 * RATE)
    back = resampled(finer, RATE)
    assert back.start == pytest.approx(10 / RATE)  # the ends that the low-pass sees incompletely are gone
    assert np.abs(back.values - wave(back.time)).max() < 2e-3  # its ripple


def test_the_guide_of_a_thinned_record_is_that_of_the_whole() -> None:
    """A chirp of 150,000 samples, more than two hundred a cycle: its search band follows it all the same."""
    rate = 2500.0
    t = np.arange(150_000) / rate
    omega = 2 * np.pi * (6.0 + 0.05 * t)
    x = np.cos(2 * np.pi * (6.0 * t + 0.025 * t**2))
    search = find_search_band(x, rate)
    inside = (t > 1.0) & (t < 59.0)
    assert np.abs(search.guide / omega - 1.0)[inside].max() < 0.02
    assert search.guide.size == t.size


@pytest.mark.parametrize("seed", range(4))
def test_the_rate_that_is_suggested_for_scattered_times_passes(tmp_path: Path, seed: int) -> None:
    t = np.sort(np.random.default_rng(seed).uniform(0.0, 20.0, 801))
    path = written(tmp_path / "a.csv", t, wave(t))
    with pytest.raises(InputError, match="for instance by --resample") as refused:
        read_recordings([path])
    rate = float(str(refused.value).split("by --resample ")[1].split(",")[0])
    assert {found.rate for found in read_recordings([path], resample=rate)} == {rate}
    with pytest.raises(InputError, match=rf"would alias; use for instance --resample {rate:.4g}"):
        read_recordings([path], resample=0.5 * rate)


def test_a_rate_below_the_signal_is_refused_with_one_that_fits(tmp_path: Path) -> None:
    x = np.cos(2 * np.pi * 2.1 * T) + 0.05 * np.random.default_rng(1).normal(size=T.size)
    path = written(tmp_path / "a.csv", T, x)
    message = r"take off [19]\d+.* % of the signal's energy, .* Nyquist frequency 1.5; use"
    with pytest.raises(InputError, match=message) as no:
        read_recording(path, resample=3.0)
    enough = float(str(no.value).rpartition(" ")[2])
    assert 4.2 < enough < 6.5
    found = read_recording(path, resample=enough)
    assert np.std(found.values) == pytest.approx(np.std(x), rel=0.02)


@pytest.mark.parametrize("scale", [1e200, 1e-200])
def test_extreme_values_are_refused_on_reading(tmp_path: Path, scale: float) -> None:
    with pytest.raises(InputError, match=r"a.csv, column u swings by 1e[+-]200, outside"):
        read_recordings([written(tmp_path / "a.csv", T, scale * np.cos(5.0 * T))])


def test_a_span_keeps_its_times_and_says_so(tmp_path: Path) -> None:
    file = written(tmp_path / "a.csv", T, X)
    found = read_recording(file, span=(5.0, 20.0))
    assert (found.time[0], found.time[-1]) == (5.0, 20.0)
    np.testing.assert_array_equal(found.values, X[100:401])
    assert "301 of 600 samples lie in the span" in " ".join(found.notes)
    assert not any("span" in note for note in read_recording(file, span=(-1.0, 99.0)).notes)
    with pytest.raises(InputError, match="span 40 to 50 holds 0 samples, 16 are needed; the recording runs from 0 to"):
        read_recording(file, span=(40.0, 50.0))
    with pytest.raises(InputError, match="span 9 to 3 is empty"):
        read_recording(file, span=(9.0, 3.0))
