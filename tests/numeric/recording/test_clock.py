"""Times without a unit: since 1970, a spreadsheet's days, dates without times of day, and what cannot be told."""

from __future__ import annotations

from datetime import date, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.tables.encoding import decoded
from ridgeback.numeric.recording.reading import read_recording

HOURS = np.arange(48) / 24.0
VALUES = np.cos(0.3 * np.arange(48))


def table(path: Path, header: str, times: list[str]) -> Path:
    rows = [f"{t},{v:.6f}" for t, v in zip(times, VALUES, strict=False)]
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(("power", "seconds"), [(9, 1.0), (12, 1e-3), (15, 1e-6), (18, 1e-9)])
def test_times_since_1970_are_of_the_unit_of_their_size_and_counted_from_the_first(
    tmp_path: Path, power: int, seconds: float
) -> None:
    times = [str((1_772_359_200 + 2 * i) * 10 ** (power - 9)) for i in range(48)]
    found = read_recording(table(tmp_path / "run.csv", "timestamp,u", times))
    assert found.rate == pytest.approx(0.5, rel=1e-9)
    assert found.time[0] == 0.0
    assert "counted from the first" in found.notes[0]
    assert "2026-03-01 10:00:00" in found.notes[0]
    assert seconds * 10**power == pytest.approx(1e9)


@pytest.mark.parametrize("header", ["Date,u", "Datum,u", "Time,u", "t [d],u"])
def test_days_of_a_spreadsheet_are_days(tmp_path: Path, header: str) -> None:
    found = read_recording(table(tmp_path / "run.csv", header, [f"{46_082 + t:.8f}" for t in HOURS]))
    assert found.rate == pytest.approx(1 / 3600.0, rel=1e-6)
    assert found.time[0] == 0.0
    assert "2026-03-01 00:00:00" in found.notes[0]


def test_seconds_that_begin_in_the_middle_of_a_day_stay_seconds(tmp_path: Path) -> None:
    found = read_recording(table(tmp_path / "run.csv", "time,u", [f"{45_000 + 0.01 * i:.2f}" for i in range(48)]))
    assert (found.time[0], round(found.rate, 6)) == (45_000.0, 100.0)


def test_what_may_be_seconds_or_days_is_refused_with_a_rate_for_either_that_works(tmp_path: Path) -> None:
    path = table(tmp_path / "run.csv", "Time,u", [f"{46_082 + 0.25 * i:.2f}" for i in range(48)])
    with pytest.raises(InputError, match=r"--rate 4 for seconds or --rate 4\.62963e-05 for days"):
        read_recording(path)
    assert [read_recording(path, rate=rate).rate for rate in (4.0, 4.62963e-05)] == [4.0, 4.62963e-05]
    with pytest.raises(InputError, match="leave --rate out"):
        read_recording(path, rate=7.0)


@pytest.mark.parametrize("style", ["%Y-%m-%d", "%d.%m.%Y", "%d.%m.%y"])
def test_dates_without_a_time_of_day_are_times(tmp_path: Path, style: str) -> None:
    times = [f"{date(2026, 1, 5) + timedelta(days=7 * i):{style}}" for i in range(48)]
    found = read_recording(table(tmp_path / "run.csv", "Date,co2", times))
    assert 1.0 / found.rate == pytest.approx(7 * 86_400.0)
    assert found.name == "co2"


def test_a_column_of_dates_is_no_signal_beside_a_time(tmp_path: Path) -> None:
    times = [f"{datetime(2026, 3, 1) + timedelta(hours=i)},2026-03-01" for i in range(48)]
    assert read_recording(table(tmp_path / "run.csv", "timestamp,tested on,u", times)).name == "u"


def test_a_unit_behind_the_name_of_times_of_day_is_none_of_theirs(tmp_path: Path) -> None:
    found = read_recording(table(tmp_path / "run.csv", "Time (hh:mm:ss),u", [f"10:00:{i:02d}" for i in range(48)]))
    assert found.rate == pytest.approx(1.0)
    assert not any("unit of time" in note for note in found.notes)


def test_zeros_at_the_end_of_a_text_are_left_out_and_within_it_are_damage() -> None:
    assert decoded(b"t,u\n" + bytes(4), "run.csv") == ("t,u\n", "4 bytes of 0 at the end were left out.")
    with pytest.raises(InputError, match="byte 6000 is 0"):
        decoded(b"1" * 6000 + b"\0" + b"1" * 9, "run.csv")


def test_names_in_a_comment_may_hold_single_blanks(tmp_path: Path) -> None:
    rows = "".join(f"{0.1 * i:.1f}   {v:.6f}\n" for i, v in enumerate(VALUES))
    (tmp_path / "run.txt").write_text(f"% Model: beam\n% Time (ms)   w (mm), Point: 5\n{rows}", encoding="utf-8")
    found = read_recording(tmp_path / "run.txt")
    assert (found.name, round(found.rate)) == ("w (mm), Point: 5", 10_000)


def test_a_header_of_half_the_cells_says_what_works(tmp_path: Path) -> None:
    (tmp_path / "two.csv").write_text("t,u\n" + "".join(f"0,{i:03d},1,{i:03d}\n" for i in range(48)), encoding="utf-8")
    with pytest.raises(InputError, match="export the table with ; between them"):
        read_recording(tmp_path / "two.csv")
    (tmp_path / "one.csv").write_text("u\n" + "".join(f"{i % 7},{i:03d}\n" for i in range(48)), encoding="utf-8")
    with pytest.raises(InputError, match="--decimal comma"):
        read_recording(tmp_path / "one.csv", rate=1.0)
    assert read_recording(tmp_path / "one.csv", rate=1.0, decimal=",").values[1] == pytest.approx(1.001)
    assert read_recording(tmp_path / "one.csv", rate=1.0, decimal=".", column=2).values[1] == 1.0


@pytest.mark.parametrize(
    ("header", "seconds", "unit"),
    [("t/ms,phi/°", 1e-3, "rad"), ('"Time, s","Displacement, mm"', 1.0, "mm"), ("Year,spots", 31_557_600.0, "")],
)
def test_units_as_the_headers_of_laboratories_have_them(tmp_path: Path, header: str, seconds: float, unit: str) -> None:
    found = read_recording(table(tmp_path / "run.csv", header, [f"{1900 + 0.25 * i:.2f}" for i in range(48)]))
    assert 1.0 / found.rate == pytest.approx(0.25 * seconds)
    assert found.units == unit


def test_times_of_half_days_go_on_over_midnight(tmp_path: Path) -> None:
    times = [f"{datetime(2026, 3, 1, 23, 59, 40) + timedelta(seconds=i):%I:%M:%S %p}" for i in range(48)]
    found = read_recording(table(tmp_path / "run.csv", "Time,u", times))
    assert (found.rate, found.time[-1]) == (1.0, 47.0)


def test_a_column_that_numbers_the_rows_is_no_signal_beside_a_time(tmp_path: Path) -> None:
    times = [f"{i},{0.1 * i:.1f}" for i in range(48)]
    assert read_recording(table(tmp_path / "run.csv", "No.,Zeit,u", times)).name == "u"


@pytest.mark.parametrize(
    ("cell", "said"), [("1.5 mm", "write its unit into the header"), ("u", "the header stands there again")]
)
def test_a_cell_that_is_no_number_is_refused_with_what_helps(tmp_path: Path, cell: str, said: str) -> None:
    rows = [f"{0.1 * i:.1f},{cell if i == 20 else f'{v:.6f}'}" for i, v in enumerate(VALUES)]
    (tmp_path / "run.csv").write_text("\n".join(["t,u", *rows]), encoding="utf-8")
    with pytest.raises(InputError, match=said):
        read_recording(tmp_path / "run.csv")
