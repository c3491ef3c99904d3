"""Samples in memory: every container gives the recording that a file of the same numbers gives."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.recording.reading import read_recording
from ridgeback.numeric.recording.recording import Recording, recordings_from_arrays

RATE = 16.0
T = np.arange(200) / RATE
X = 1.5 * np.exp(-0.05 * T) * np.cos(2.0 * np.pi * 1.1 * T)


def same(recording: Recording, *, values: Any = X) -> None:
    np.testing.assert_array_equal(recording.values, values)
    assert recording.rate == pytest.approx(RATE, rel=1e-12)
    np.testing.assert_allclose(recording.time - recording.time[0], np.arange(len(values)) / RATE, atol=1e-12)


def test_rate_and_time_say_the_same() -> None:
    same(Recording.from_arrays(X, RATE))
    same(Recording.from_arrays(X.tolist(), rate=RATE))
    same(Recording.from_arrays(X, time=T))
    same(Recording.from_arrays(tuple(X), time=list(T + 3.0)))
    assert Recording.from_arrays(X, time=T + 3.0).time[0] == 3.0


def test_a_file_of_the_same_numbers_gives_the_same(tmp_path: Path) -> None:
    file = tmp_path / "run.csv"
    file.write_text("t_s,u [mm]\n" + "".join(f"{t!r},{x!r}\n" for t, x in zip(T.tolist(), X.tolist(), strict=True)))
    read, made = read_recording(file), Recording.from_arrays(X, time=T, name="u", units="mm")
    np.testing.assert_array_equal(read.values, made.values)
    np.testing.assert_array_equal(read.time, made.time)
    assert (read.channel, read.rate, read.notes) == (made.channel, made.rate, made.notes)
    assert dict(read.facts) == dict(made.facts)


@pytest.mark.parametrize("missing", ["nan", "mask", "none"])
def test_what_is_missing_cuts_the_signal(missing: str) -> None:
    gap = np.arange(X.size) == 120
    holed: Any = np.where(gap, np.nan, X)
    if missing == "mask":
        holed = np.ma.array(np.where(gap, 77.0, X), mask=gap)
    elif missing == "none":
        holed = [None if hole else value for hole, value in zip(gap.tolist(), X.tolist(), strict=True)]
    first, second = recordings_from_arrays(holed, RATE)
    np.testing.assert_array_equal(first.values, X[:120])
    np.testing.assert_array_equal(second.values, X[121:])
    longest = Recording.from_arrays(holed, RATE)
    same(longest, values=X[:120])
    assert any("longest of 2 stretches" in note for note in longest.notes)
    filled = Recording.from_arrays(holed, RATE, fill=2.0 / RATE)
    assert filled.values.size == X.size
    assert filled.filled.sum() == 1
    assert abs(filled.values[120] - X[120]) < 0.02


def test_pandas_gives_its_index_its_name_and_its_missing_values() -> None:
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    series = pandas.Series(X, index=T, name="u")
    same(Recording.from_arrays(series))
    assert Recording.from_arrays(series).name == "u"
    assert Recording.from_arrays(series, name="angle").name == "angle"
    same(Recording.from_arrays(pandas.Series(X), RATE))
    same(Recording.from_arrays(pandas.Series(X), time=pandas.Series(T)))
    stamps = pandas.Timestamp("2026-03-01") + pandas.to_timedelta(T, unit="s")
    same(Recording.from_arrays(pandas.Series(X, index=stamps)))
    nullable = pandas.array(np.round(1000 * X).astype(int), dtype="Int64")
    nullable[5] = pandas.NA
    assert Recording.from_arrays(pandas.Series(nullable), RATE).values.size == X.size - 6
    frame = pandas.DataFrame({"t_ms": 1000 * T, "u [mm]": X, "w": X**2, "label": "a"})
    same(Recording.from_arrays(frame, column="u"))
    assert Recording.from_arrays(frame, column="u").units == "mm"
    assert [found.name for found in recordings_from_arrays(frame, column="all")] == ["u", "w"]
    same(Recording.from_arrays(pandas.DataFrame({"u": X}, index=T)))
    with pytest.raises(InputError, match="which column"):
        Recording.from_arrays(frame)
    with pytest.raises(InputError, match="names of their own"):
        Recording.from_arrays(frame, name="u")


def test_xarray_gives_its_coordinate_and_its_unit() -> None:
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    array = xarray.DataArray(X, dims="time", coords={"time": T}, name="u", attrs={"units": "mm"})
    same(Recording.from_arrays(array))
    assert Recording.from_arrays(array).channel == "u [mm]"
    same(Recording.from_arrays(xarray.DataArray(X, dims="x"), RATE))
    coordinate = xarray.DataArray(1000 * T, dims="time", attrs={"units": "ms"})
    same(Recording.from_arrays(array.assign_coords(time=coordinate)))
    data = xarray.Dataset({"u": array, "w": array**2})
    same(Recording.from_arrays(data, column="u"))
    beside = data.drop_vars("time").assign(place=("other", np.arange(3.0)), offset=1.0)
    same(Recording.from_arrays(beside, RATE, column="u"))
    assert [found.name for found in recordings_from_arrays(beside, RATE, column="all")] == ["u", "w"]
    with pytest.raises(InputError, match="dimensions"):
        Recording.from_arrays(xarray.DataArray(np.zeros((20, 2)), dims=("time", "channel")), RATE)


@pytest.mark.parametrize(
    ("given", "how", "message"),
    [
        (X, {}, "give the sampling rate"),
        (X, {"rate": RATE, "time": T}, "keep one"),
        (X, {"time": T[:-1]}, "199 times"),
        (X, {"rate": 0.0}, "not positive"),
        (X, {"time": T[::-1]}, "must increase"),
        (X * 1j, {"rate": RATE}, "complex"),
        (np.stack([X, X]), {"rate": RATE}, "one column"),
        (["a"] * 40, {"rate": RATE}, "'a', which is no number"),
        ([1.0] * 40, {"rate": RATE}, "constant"),
        (np.where(T == 1.0, np.inf, X), {"rate": RATE}, "index 16"),
        (X[:9], {"rate": RATE}, "at least"),
        (np.full(40, np.nan), {"rate": RATE}, "at least"),
        (X, {"time": np.full(X.size, "NaT", dtype="datetime64[s]")}, "every one of the dates is missing"),
    ],
)
def test_what_is_no_signal_is_refused_in_one_line(given: Any, how: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message) as refused:
        Recording.from_arrays(given, **how)
    assert "\n" not in str(refused.value)


def test_no_library_is_imported_for_the_sake_of_arrays() -> None:
    code = (
        "import sys, numpy as np\n"
        "from ridgeback.numeric.recording.recording import Recording\n"
        "Recording.from_arrays(np.cos(np.arange(99.0)), 4.0)\n"
        "print(sorted({'pandas', 'xarray'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.strip() == "[]"
