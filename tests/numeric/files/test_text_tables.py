"""Text tables: what is no number and no row of the table is refused, by its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.tables.lines import lines_of, with_line_feeds
from ridgeback.numeric.files.tables.text import TextTable, parse_table
from ridgeback.numeric.recording.reading import read_recording


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,u\n0,1\n1,2,3\n", "run.csv, line 3 has 3 cells, the first row 2; is the comma a decimal mark there"),
        ("0 1\n1 2 3\n2 3\n", "run.csv, line 2 has 3 cells, the first row 2"),
        ("t;u\n0;1\n\n1;2;x\n", "run.csv, line 4 has 3 cells"),
    ],
)
def test_a_row_with_more_cells_than_the_header_is_refused(text: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_table(text, source="run.csv")
    assert said in str(caught.value)


def test_empty_cells_at_the_end_of_a_row_are_none() -> None:
    found = parse_table("t,u\n0,1,\n1,2,,\n", source="run.csv")
    assert found.names == ("t", "u")
    assert found.column(1).tolist() == [1.0, 2.0]
    with_tabs = parse_table("time_ms\tx\n0\t1.0\t\n10\t0.9\t\n", source="run.csv")
    assert with_tabs.names == ("time_ms", "x")


def test_times_are_not_guessed_below_lines_that_were_left_out(tmp_path: Path) -> None:
    """What stands above the numbers may say that they are no seconds."""
    path = tmp_path / "run.csv"
    numbers = "".join(f"{10 * i}\t{np.cos(0.3 * i)}\t0\n" for i in range(200))
    path.write_text(f"Serial 7\nMilliseconds\n{numbers}", encoding="utf-8")
    with pytest.raises(InputError, match="has no time column among 1, 2, 3"):
        read_recording(path)


@pytest.mark.parametrize("cell", ["1_05", "1__0", "0x10", "1e5_0"])
def test_what_only_a_programming_language_calls_a_number_is_none(cell: str) -> None:
    table = parse_table(f"t,u\n0,1\n1,{cell}\n", source="run.csv")
    with pytest.raises(InputError, match=f"line 3, column u: '{cell}' is not a number"):
        table.column(1)


VALUES = np.sin(0.3 * np.arange(40)).round(6)


def rows(separator: str, comma: bool, step: float = 0.05) -> str:
    """Rows of times and values."""
    lines = [f"{step * i:.6g}{separator}{v:.6f}" for i, v in enumerate(VALUES)]
    text = "\n".join(lines) + "\n"
    return text.replace(".", ",") if comma else text


PREAMBLE = "Manufacturer: X\nSerial;12\nSampling rate: 20 Hz\n\n"


@pytest.mark.parametrize(
    "data",
    [
        ("Zeit [s];u [mm]\n" + rows(";", True)).encode(),
        ("sep=;\r\nZeit [s];u [mm]\r\n" + rows(";", True).replace("\n", "\r\n")).encode("utf-8-sig"),
        ("Time,u\n(s),(mm)\n" + rows(",", False)).encode(),
        (PREAMBLE + "Zeit [s];u [mm]\n" + rows(";", True)).encode("cp1252"),
        ("% time, u [mm]\n" + rows(",", False)).encode(),
        ("Zeit [ms]\tu [mm]\n" + rows("\t", True, 50.0)).encode("utf-16"),
        ("Zeit [\u00b5s]\tu [mm]\n" + rows("\t", True, 5e4)).encode("latin-1"),
        ("Time /us;u / mm\n" + rows(";", False, 5e4)).encode(),
        ("time_days,u [mm]\n" + rows(",", False, 0.05)).encode(),
        ("Zeit in ms;u in mm\n" + rows(";", True, 50.0)).encode(),
        ("Zeit\tu\nrig 7\trig 8\n(ms)\t(mm)\n" + rows("\t", True, 50.0)).encode(),
        ("t,u [mm]\n" + rows(";", True)).encode(),
        ("X\nt,run,u [mm]\n" + rows(",", False).replace(",", ",a,")).encode(),
        ("timestamp_ms,u [mm]\n" + rows(",", False, 50.0)).encode(),
        ("Channel,u\nTime [s],[mm]\n" + rows(",", False)).encode(),
        (" time (s)   u (mm)\n" + rows("   ", False)).encode(),
        ("time since start [s]   u [mm]\n" + rows("   ", False)).encode(),
        ("Time|u / mm\n" + rows("|", True)).encode(),
        ("Zeit  u [mm]\n" + rows("  ", True)).encode(),
        ("t,u [mm],\n" + rows(",", False).replace("\n", ",\n")).encode(),
        ("t;u [mm]\n" + rows(";", True).replace("-", "\u2212")).encode(),
        (",t,u [mm]\n" + "".join(f"{i},{row}\n" for i, row in enumerate(rows(",", False).split()))).encode(),
        ("SampleRate:\t20 Hz\nTime 1 - default [s]\tu [mm]\n" + rows("\t", True)).encode(),
        ('"t","u [mm]"\n' + "".join(f'"{row}"\n'.replace(",", '","') for row in rows(",", False).split())).encode(),
        ('"t","u [mm]"\n' + "".join(f'"{row}"\n'.replace(";", '","') for row in rows(";", True).split())).encode(),
    ],
)
def test_tables_as_instruments_and_spreadsheets_write_them(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "run.csv"
    path.write_bytes(data)
    found = read_recording(path)
    assert np.array_equal(found.values, VALUES)
    per_day = 86400.0 if b"days" in data else 1.0
    assert found.rate * per_day == pytest.approx(20.0)
    assert (found.name, found.units) == ("u", "mm")
    left_out = any(start in data for start in (b"Serial", b"SampleRate", b"X\n"))
    assert any("before the table" in note for note in found.notes) == left_out


def test_numbers_without_a_header_have_an_even_first_column_for_time_or_need_one(tmp_path: Path) -> None:
    path = tmp_path / "run.txt"
    path.write_text(rows(" ", False))
    found = read_recording(path)
    assert np.array_equal(found.values, VALUES)
    assert found.rate == pytest.approx(20.0)
    assert any("taken for the time" in note for note in found.notes)
    assert not any("taken for" in note for note in read_recording(path, time_column="1").notes)
    path.write_text(rows(" ", False, 1.0))
    with pytest.raises(InputError, match=r"--time-column.*--rate"):
        read_recording(path)


def test_a_workbook_is_read_as_its_first_sheet(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(["Time [s]", "u [mm]"])
    for i, value in enumerate(VALUES):
        book.active.append([0.05 * i, float(value)])
    book.save(tmp_path / "run.xlsx")
    assert np.array_equal(read_recording(tmp_path / "run.xlsx").values, VALUES)
    (tmp_path / "bad.xlsx").write_bytes(b"PK nothing")
    with pytest.raises(InputError, match="not a readable Excel workbook"):
        read_recording(tmp_path / "bad.xlsx")


def test_lines_are_those_of_python_without_empty_ones_and_comments() -> None:
    text = "# a\r\nt,u\r0,1\n\n  \n1,2\v2,3\x85% b\n3,4\u20284,5"
    lines, comments = lines_of(with_line_feeds(text))
    slow = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip() and line[0] not in "#%"]
    assert list(zip(lines.number.tolist(), lines, strict=True)) == slow
    assert [lines[at] for at in range(-1, len(lines))] == [slow[-1][1], *(line for _, line in slow)]
    assert comments == ("# a",)
    assert lines.longest >= 3


def test_blocks_read_as_cell_by_cell(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numbers that numpy's parser reads, missing ones that it does not, and rows too short, in blocks of three."""
    monkeypatch.setattr("ridgeback.numeric.files.tables.lines.BLOCK", 3)
    cells = ["1", " 2.5 ", "-1e-3", "inf", "NaN", "", "n/a", "1e400", "+.5", "7.", "0", "-0"]
    table = parse_table(
        "t;u\n" + "\n".join(f"{i};{cell}" for i, cell in enumerate(cells)) + "\n12\n13;1\n", source="run.csv"
    )
    want = [float(cell) if cell.strip() and cell != "n/a" else np.nan for cell in cells]
    np.testing.assert_array_equal(table.column(1), [*want, np.nan, 1.0])
    assert table.column(0).tolist() == list(range(14))


def test_what_oscilloscopes_write_beside_their_samples() -> None:
    """Tektronix' remarks in the first columns, Keysight's two lines of names, Rigol's start and step in a third."""
    remarks = ("Record Length,40,", "Sample Interval,5.0e-2,", "Source,CH1,")
    lines = (f"{remarks[i] if i < len(remarks) else ',,'},{0.05 * i:.6f},{v}" for i, v in enumerate(VALUES))
    found = parse_table("\n".join(lines), source="run.csv")
    assert (found.names, found.hinted) == (("1", "2"), False)
    assert np.array_equal(found.column(1), VALUES)
    keysight = parse_table("x-axis,1\nsecond,Volt\n" + rows(",", False), source="run.csv")
    assert keysight.names == ("second", "Volt")
    steps = "".join(f"{i},{v},,\n" for i, v in enumerate(VALUES))
    rigol = parse_table("X,CH1,Start,Increment,\nSequence,Volt,0.0,5.0e-02\n" + steps, source="run.csv")
    assert rigol.names == ("X [Sequence]", "CH1 [Volt]")
    assert rigol.note == "Nothing stands in columns Start, Increment, which were left out."
    assert np.array_equal(rigol.column(1), VALUES)


def test_a_column_that_numbers_the_rows_is_no_signal_beside_a_rate(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("frame,u\n" + "".join(f"{i},{v}\n" for i, v in enumerate(VALUES)))
    assert np.array_equal(read_recording(path, rate=20.0).values, VALUES)
    path.write_text("frame,u,v\n" + "".join(f"{i},{v},0\n" for i, v in enumerate(VALUES)))
    with pytest.raises(InputError, match="say which column holds the signal by --column; it has u, v"):
        read_recording(path, rate=20.0)


def test_a_last_row_that_is_cut_off_hides_no_other(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("t,u\n" + rows(",", False) + "2")
    found = read_recording(path)
    assert np.array_equal(found.values, VALUES)
    assert any("1 row has no value" in note for note in found.notes)


def test_a_byte_order_mark_before_a_text_is_no_part_of_it() -> None:
    assert parse_table("\ufefft,u\n0,1\n1,2\n", source="run.csv").names == ("t", "u")
    assert parse_table("\ufeffsep=;\nt;u\n0;1\n1;2\n", source="run.csv").names == ("t", "u")


def test_quoted_numbers_are_read_by_the_block(monkeypatch: pytest.MonkeyPatch) -> None:
    """Quotes in a header, or about numbers, take nothing from numpy's parser."""
    monkeypatch.setattr(TextTable, "one_by_one", None)
    quoted = "".join(f'"{row}"\n'.replace(",", '","') for row in rows(",", False).split())
    for text in ('"t","u"\n' + quoted, '"t","u"\n' + rows(",", False), 't;"u"\n' + rows(";", True)):
        assert np.array_equal(parse_table(text, source="run.csv").column(1), VALUES)


def test_times_are_taken_beneath_a_note_but_not_beneath_words_of_other_units(tmp_path: Path) -> None:
    path = tmp_path / "run.txt"
    path.write_bytes(("# gem\u00e4\u00dfigt\n" + rows(" ", False)).encode("latin-1"))
    assert read_recording(path).rate == pytest.approx(20.0)
    path.write_text("# time in ms\n" + rows(" ", False, 50.0))
    with pytest.raises(InputError, match="has no time column among 1, 2"):
        read_recording(path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,u\n0,1\n0,2\n", r"line 3: time 0 repeats .*--rate takes the place of --time-column"),
        ("t,u\n1,1\n0,2\n1,1\n", r"line 3: time 0 is before .*begin again 1 time; .*--run-column"),
        ("t,u\n2,1\n1,2\n0,1\n", "line 3: time 1 is before .*turn the rows round"),
    ],
)
def test_times_that_do_not_rise_are_refused_with_what_helps(
    tmp_path: Path, text: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ridgeback.numeric.recording.recording.FEWEST_SAMPLES", 2)
    path = tmp_path / "run.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=said):
        read_recording(path)


@pytest.mark.parametrize("data", [bytes(range(256)) * 9, b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"])
def test_what_is_no_text_is_called_so(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "run.csv"
    path.write_bytes(data)
    with pytest.raises(InputError, match="holds no text but binary data"):
        read_recording(path)


@pytest.mark.parametrize(
    ("time", "rate", "said"),
    [
        (0.05 * np.arange(40), 50.0, "steps of 0.05 s, 20 samples per second, not 50; leave --rate out"),
        (np.round(0.05 * np.arange(40), 1), 50.0, "has 19.5 samples per second, not 50; leave --rate out"),
        (0.05 * (np.arange(40) + 9 * (np.arange(40) > 20)), 20.0, "has gaps, which a rate would close; leave"),
    ],
)
def test_a_rate_that_the_times_contradict_is_refused(tmp_path: Path, time: np.ndarray, rate: float, said: str) -> None:
    path = tmp_path / "run.csv"
    path.write_text("t,u\n" + "".join(f"{t!s},{v}\n" for t, v in zip(time, VALUES, strict=True)))
    with pytest.raises(InputError, match=said):
        read_recording(path, rate=rate)


@pytest.mark.parametrize("time", [np.arange(40), np.round(0.05 * np.arange(40), 1), np.arange(40) % 20 * 0.05])
def test_a_rate_takes_the_place_of_times_that_count_are_coarse_or_begin_again(tmp_path: Path, time: np.ndarray) -> None:
    path = tmp_path / "run.csv"
    path.write_text("t,u\n" + "".join(f"{t!s},{v}\n" for t, v in zip(time, VALUES, strict=True)))
    found = read_recording(path, rate=20.0)
    assert found.rate == 20.0
    assert np.array_equal(found.values, VALUES)
