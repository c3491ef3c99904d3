from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.io import wavfile

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.tables.text import parse_table
from ridgeback.numeric.recording.reading import read_recording

TIME = np.arange(40) / 20.0
VALUES = np.sin(TIME) + 0.25


def table(path: Path, header: str | None, rows: list[str]) -> Path:
    path.write_text("\n".join(([header] if header else []) + rows) + "\n", encoding="utf-8")
    return path


def two_columns(path: Path, header: str | None = "time_s,u [mm]", sep: str = ",") -> Path:
    return table(path, header, [f"{t!r}{sep}{v!r}" for t, v in zip(TIME.tolist(), VALUES.tolist(), strict=True)])


@pytest.mark.parametrize(
    ("header", "sep"), [("time_s,u [mm]", ","), ("t;u", ";"), ("T\tu", "\t"), ("# a\n\nTime (s),u", ",")]
)
def test_csv_gives_back_what_was_written(tmp_path: Path, header: str, sep: str) -> None:
    path = two_columns(tmp_path / "run.csv", header, sep)
    recording = read_recording(path)
    assert np.array_equal(recording.values, VALUES)
    assert np.abs(recording.time - TIME).max() < 1e-12
    assert recording.rate == pytest.approx(20.0, rel=1e-13)
    assert recording.name == "u"
    assert recording.source == "run.csv"
    assert recording.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    with pytest.raises(ValueError, match="read-only"):
        recording.values[0] = 1.0


def test_unit_in_brackets_decimal_comma_and_byte_order_mark(tmp_path: Path) -> None:
    assert read_recording(two_columns(tmp_path / "a.csv")).units == "mm"
    rows = [f"{t:.3f};{v:.6f}".replace(".", ",") for t, v in zip(TIME, VALUES, strict=True)]
    path = tmp_path / "b.csv"
    path.write_bytes(b"\xef\xbb\xbf" + ("t;x\r\n" + "\r\n".join(rows)).encode())
    assert np.abs(read_recording(path).values - VALUES).max() < 1e-6


@pytest.mark.parametrize(
    ("header", "factor", "word"),
    [("t [ms],u", 1e3, "times in ms"), ("time_us,u", 1e6, "times in us"), ("Time (min),u", 1 / 60, "times in min")],
)
def test_a_unit_of_time_is_converted_and_said(tmp_path: Path, header: str, factor: float, word: str) -> None:
    rows = [f"{t * factor!r},{v!r}" for t, v in zip(TIME.tolist(), VALUES.tolist(), strict=True)]
    found = read_recording(table(tmp_path / "run.csv", header, rows))
    assert found.rate == pytest.approx(20.0, rel=1e-9)
    assert any(word in note for note in found.notes)
    strange = read_recording(table(tmp_path / "odd.csv", "t [frames],u", rows))
    assert any("frames, is not known" in note for note in strange.notes)


def test_columns_by_name_and_number_and_rate_in_place_of_time(tmp_path: Path) -> None:
    rows = [f"{t},{v},{2 * v}" for t, v in zip(TIME, VALUES, strict=True)]
    path = table(tmp_path / "run.csv", "t,u,w", rows)
    assert read_recording(path, column="w").values[3] == pytest.approx(2 * VALUES[3])
    assert read_recording(path, column=3).name == "w"
    assert read_recording(path, column="2").name == "u"
    with pytest.raises(InputError, match=r"time column t has steps of 0.05 s, 20 samples per second, not 5; leave"):
        read_recording(path, column="u", rate=5.0)
    counted = table(tmp_path / "counted.csv", "t,u", [f"{i},{v}" for i, v in enumerate(VALUES)])
    given_rate = read_recording(counted, column="u", rate=5.0)
    assert given_rate.rate == 5.0
    assert given_rate.time[1] == 0.2
    assert "replaced" in given_rate.notes[0]
    bare = table(tmp_path / "bare.csv", None, [f"{v}" for v in VALUES])
    assert read_recording(bare, rate=20.0).values.size == 40
    named = table(tmp_path / "named.csv", "clock,u,w", rows)
    assert read_recording(named, column="u", time_column="clock").rate == pytest.approx(20.0)


def test_npz(tmp_path: Path) -> None:
    path = tmp_path / "run.npz"
    np.savez(path, t=TIME, u=VALUES, label=np.array("text"))
    assert np.array_equal(read_recording(path).values, VALUES)
    np.savez(path, evil=np.array([{}], dtype=object))
    with pytest.raises(InputError, match=r"evil.npy is not an NPY file of plain numbers: it holds objects"):
        read_recording(path)
    np.savez(path, cube=np.ones((3, 3, 3)))
    with pytest.raises(InputError, match=r"no real array of one or two axes; it has cube float64\[3, 3, 3\]"):
        read_recording(path)
    path.write_bytes(b"not a zip")
    with pytest.raises(InputError, match="not an NPZ archive"):
        read_recording(path)


@pytest.mark.parametrize(("dtype", "full"), [(np.int16, 2**15), (np.int32, 2**31), (np.float32, 1)])
def test_wav_is_scaled_to_full_scale_and_says_so(tmp_path: Path, dtype: type, full: int) -> None:
    samples = (0.5 * np.sin(np.arange(64)) * full).astype(dtype)
    path = tmp_path / "take.wav"
    wavfile.write(path, 800, np.stack([samples, -samples], axis=1))
    recording = read_recording(path, column=2)
    assert recording.rate == 800.0
    assert recording.name == "channel 2"
    assert np.array_equal(recording.values, -samples.astype(float) / full)
    assert (recording.units == "full scale") == (full > 1)
    with pytest.raises(InputError, match="say which column holds the signal by --column; it has channel 1, channel 2"):
        read_recording(path)
    with pytest.raises(InputError, match="states 800 samples per second, not 3"):
        read_recording(path, column=1, rate=3.0)
    with pytest.raises(InputError, match="no time column"):
        read_recording(path, column=1, time_column="t")


def test_unsigned_bytes_are_centred(tmp_path: Path) -> None:
    wavfile.write(tmp_path / "b.wav", 8, np.array([0, 128] * 10, dtype=np.uint8))
    assert read_recording(tmp_path / "b.wav").values[:2].tolist() == [-1.0, 0.0]


def with_cell(row: int, cell: str) -> list[str]:
    rows = [f"{t:.2f},{v:.6f}" for t, v in zip(TIME, VALUES, strict=True)]
    rows[row] = cell
    return rows


@pytest.mark.parametrize(
    ("header", "rows", "arguments", "message"),
    [
        ("t,u", with_cell(5, "0.25,-inf"), {}, r"line 7, column u: -inf is not finite.*1 such"),
        ("t,u", with_cell(5, "0.25,inf"), {}, "line 7, column u: inf is not finite"),
        ("t,u", with_cell(5, "0.25,abc"), {}, "line 7, column u: 'abc' is not a number"),
        (
            "t,u",
            [f"{t},{'' if i % 9 == 8 else i}" for i, t in enumerate(TIME)],
            {},
            r"no stretch between its 4 gaps.*16",
        ),
        ("t,u", [f"{t}," for t in TIME], {}, "column u has 40 samples, 40 of them without a value; at least 16"),
        ("t,u", with_cell(5, "0.20,1"), {}, r"line 7: time 0\.2 repeats the one above \(0\.2\)"),
        ("t,u", with_cell(5, "0.10,1"), {}, r"line 7: time 0\.1 is before the one above"),
        ("t,u", with_cell(5, "0.27,1"), {}, r"line 7: time 0\.27 comes 0\.07 after.*usual step is 0\.05.*agree to 4%"),
        ("t,u", with_cell(5, "inf,1"), {}, "line 7, column t: inf is not finite"),
        ("t,u", with_cell(0, "0,1")[:9], {}, "9 samples; at least 16"),
        ("t,u", [f"{t},3" for t in TIME], {}, "column u is constant at 3"),
        ("t,u,w", [f"{t},{t},1" for t in TIME], {}, "say which column holds the signal by --column; it has u, w"),
        ("t,u", with_cell(0, "0,1"), {"column": "velocity"}, "no column velocity; it has t, u"),
        ("t,u", with_cell(0, "0,1"), {"column": 3}, "no column 3; it has t, u"),
        ("t,u", with_cell(0, "0,1"), {"column": "t"}, "column t is the time"),
        (
            "a,b",
            with_cell(0, "0,1"),
            {"column": "b"},
            r"no time column among a, b; name it \(--time-column\), or give the sampling rate",
        ),
        ("t,u", with_cell(0, "0,1"), {"rate": 0.0}, "sampling rate 0.0 is not positive"),
        ("t,u", with_cell(0, "0,1"), {"rate": -2.0}, r"sampling rate -2\.0 is not positive"),
        ("u,u", with_cell(0, "0,1"), {"rate": 2.0, "column": "u"}, "has 2 columns u; name one by its number"),
        ("t,u", [], {}, "no row of numbers below its header"),
        (None, [], {}, "holds no data"),
    ],
)
def test_faults_in_a_table_are_named_by_line_column_and_value(
    tmp_path: Path, header: str | None, rows: list[str], arguments: dict[str, object], message: str
) -> None:
    path = table(tmp_path / "bad.csv", header, rows)
    with pytest.raises(InputError, match=message) as caught:
        read_recording(path, **arguments)  # type: ignore[arg-type]
    assert "\n" not in str(caught.value)


def test_stamps_rounded_to_decimals_are_accepted_but_a_slow_drift_is_not(tmp_path: Path) -> None:
    rounded = table(tmp_path / "a.csv", "t,u", [f"{i / 30:.4f},{np.sin(i)}" for i in range(60)])
    assert read_recording(rounded).rate == pytest.approx(30.0, rel=1e-4)
    drifting = table(tmp_path / "b.csv", "t,u", [f"{0.1 * i + 1e-4 * i * i},{np.sin(i)}" for i in range(60)])
    with pytest.raises(InputError, match="line 3: time"):
        read_recording(drifting)


def test_missing_file_is_an_operating_system_error_and_suffix_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read_recording(tmp_path / "none.csv")
    with pytest.raises(InputError, match=r"suffix '.pkl' is unknown; export a table"):
        read_recording(tmp_path / "none.pkl")
    (tmp_path / "latin.csv").write_bytes(b"t,u\n0,\xff\n")
    with pytest.raises(InputError, match="line 2, column u: 'ÿ' is not a number"):
        read_recording(tmp_path / "latin.csv")
    (tmp_path / "x.wav").write_bytes(b"RIFFnothing")
    with pytest.raises(InputError, match="not a readable WAV"):
        read_recording(tmp_path / "x.wav")


@given(st.text(max_size=200))
@settings(deadline=None, max_examples=150)
def test_any_text_is_a_table_or_an_input_error(text: str) -> None:
    message = ""
    try:
        found = parse_table(text, source="any")
        for index in range(len(found.names)):
            found.column(index)
    except InputError as error:
        message = str(error)
    assert "\n" not in message


def test_a_truncated_wav_file_is_bad_input(tmp_path: Path) -> None:
    file = tmp_path / "bad.wav"
    file.write_bytes(b"RIFFxx")
    with pytest.raises(InputError, match="not a readable WAV"):
        read_recording(file)


@pytest.mark.parametrize("header", ["t_s,P [dBm]", "t_s,envelope_dB", "t_s;Pegel [dB(A)]"])
def test_a_level_in_decibels_is_refused_unless_its_unit_is_said_to_be_another(tmp_path: Path, header: str) -> None:
    path = two_columns(tmp_path / "ringdown.csv", header, ";" if ";" in header else ",")
    with pytest.raises(InputError, match=r"a level in dB is an envelope, .* over 8\.686 is the growth rate"):
        read_recording(path)
    assert read_recording(path, unit="mV").units == "mV"
