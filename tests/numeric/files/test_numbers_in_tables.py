"""Numbers as people write them: marks of decimals and of thousands, dates, and what is asked where they may be two."""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.readers import columns_of_file
from ridgeback.numeric.files.tables.numbers import COMMA, POINT, fits, mark_in, number
from ridgeback.numeric.files.tables.text import parse_table
from ridgeback.numeric.recording.reading import read_recording

FINITE = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e12, max_value=1e12)


@given(FINITE, st.sampled_from([POINT, COMMA]), st.sampled_from(["", "'", " ", "\u00a0", "other"]), st.integers(0, 6))
def test_a_number_reads_back_under_its_mark(value: float, mark: str, between: str, places: int) -> None:
    """Thousands parted or not, decimals many or none: what is read is what was written."""
    other = COMMA if mark == POINT else POINT
    parted = f"{value:,.{places}f}"
    spelled = "".join({",": other if between == "other" else between, ".": mark}.get(sign, sign) for sign in parted)
    assert number(spelled, mark) == float(parted.replace(",", ""))
    if fits(spelled, other) and any(sign in spelled for sign in (POINT, COMMA)):
        assert mark_in([spelled]) == ("", spelled)  # as 1,234 or 1.234: neither is proved
    elif mark in spelled:
        assert mark_in([spelled])[0] == mark


@given(FINITE)
def test_numbers_of_a_program_read_as_python_reads_them(value: float) -> None:
    assert number(repr(value), POINT) == value
    assert number(repr(value).replace(".", ","), COMMA) == value
    assert number(f"{value:.17E}".replace("E", "D"), POINT) == value


def column(text: str, decimal: str = "auto") -> list[float]:
    """The second column of a table."""
    return parse_table(text, source="run.csv", decimal=decimal).column(1).tolist()


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("t;u\n0;1.234,5\n1;2.000,25\n", [1234.5, 2000.25]),
        ("t;u\n0;1 234,5\n1;2 000,25\n", [1234.5, 2000.25]),
        ("t;u\n0;1'234.5\n1;2'000.25\n", [1234.5, 2000.25]),
        ("t\tu\n0.5\t1,234\n1.0\t12,345\n", [1234.0, 12345.0]),
        ("t\tu\n0,5\t1,234\n1,0\t2,345\n", [1.234, 2.345]),
        ("t\tu\n0.5\t1,25\n1.5\t2,5\n", [1.25, 2.5]),
        ("t\tu\n0\t1,234,567\n1\t2,000\n", [1234567.0, 2000.0]),
        ('t,u\n0,"1,234.5"\n1,"2,000"\n', [1234.5, 2000.0]),
        ('t,u\n0,"1,25"\n1,"2,5"\n', [1.25, 2.5]),
        ("t;u\n0;1.234\n1;2.345\n", [1.234, 2.345]),
    ],
)
def test_the_mark_is_what_the_cells_prove(text: str, values: list[float]) -> None:
    assert column(text) == values


def test_where_nothing_proves_the_mark_it_is_asked_for() -> None:
    text = "n\tu\n0\t1,234\n1\t2,345\n"
    with pytest.raises(InputError, match=r"column u: 1,234 may be 1.234 or 1234; say by --decimal comma or --decimal"):
        column(text)
    assert column(text, COMMA) == [1.234, 2.345]
    assert column(text, POINT) == [1234.0, 2345.0]


def test_a_stated_mark_is_kept_to() -> None:
    assert column("t;u\n0;1.234\n1;2.345\n", COMMA) == [1234.0, 2345.0]
    with pytest.raises(InputError, match=r"column u: '1,5' is not a number with a decimal point \(--decimal comma"):
        column("t;u\n0;1,5\n", POINT)
    with pytest.raises(InputError, match=r"column u: '1\.5' is not a number with a decimal comma \(--decimal point"):
        column("t;u\n0;1.5\n", COMMA)
    with pytest.raises(InputError, match="commas separate its cells, and are its decimal marks"):
        column("t,u\n0,1,5\n1,2,5\n", COMMA)


def test_one_column_with_decimal_commas_is_not_taken_for_two() -> None:
    text = "u\n1,25\n2,5\n"
    with pytest.raises(InputError, match="--decimal comma that it is, or by --decimal point"):
        parse_table(text, source="run.csv")
    assert parse_table(text, source="run.csv", decimal=COMMA).column(0).tolist() == [1.25, 2.5]
    assert parse_table(text, source="run.csv", decimal=POINT).column(1).tolist() == [25.0, 5.0]


def test_a_file_of_numbers_has_no_decimal_mark(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"run\.npy holds numbers, no text with a decimal mark; leave --decimal out"):
        columns_of_file(b"", ".npy", "run.npy", COMMA)
    with pytest.raises(InputError, match="decimal mark 'colon' is unknown; use one of auto, point"):
        read_recording(written(tmp_path, "t;u\n0;1\n"), decimal="colon")


def written(folder: Path, text: str) -> Path:
    """A file with a text."""
    path = folder / "run.csv"
    path.write_text(text)
    return path


START = datetime(2026, 11, 22, 23, 59, 58)
STEPS = [timedelta(seconds=0.25 * i) for i in range(16)]


@pytest.mark.parametrize(
    "form",
    [
        *("%Y-%m-%dT%H:%M:%S.%f", "%Y-%m-%d %H:%M:%S.%fZ", "%Y/%m/%d %H:%M:%S.%f", "%d.%m.%Y %H:%M:%S.%f"),
        *("%m/%d/%Y %H:%M:%S.%f", "%d/%m/%Y %H:%M:%S.%f", "%m/%d/%Y %I:%M:%S.%f %p", "%d.%m.%y %H:%M:%S.%f"),
        "%Y-%m-%dT%H:%M:%S.%f+01:00",
    ],
)
@pytest.mark.parametrize("comma", [True, False])
def test_dates_of_every_country_are_seconds_after_the_first(form: str, comma: bool) -> None:
    stamps = [(START + step).strftime(form) for step in STEPS]
    cells = [stamp.replace(".", ",") if comma and "%d.%m" not in form else stamp for stamp in stamps]
    found = parse_table("Zeit;u\n" + "".join(f"{cell};1\n" for cell in cells), source="run.csv")
    assert np.allclose(found.column(0), [step.total_seconds() for step in STEPS], atol=1e-9, rtol=0.0)


def test_times_of_day_are_seconds_and_days_are_no_signal(tmp_path: Path) -> None:
    rows = [f"22.11.2026;10:00:{0.25 * i:06.3f};{(-1) ** (i // 4)}" for i in range(200)]
    found = read_recording(written(tmp_path, "Datum;Uhrzeit;u\n" + "\n".join(rows[:100]) + "\n"))
    assert (found.name, found.rate) == ("u", pytest.approx(4.0))
    assert parse_table("t,u\n00:59.5,1\n01:00.0,2\n", source="run.csv").column(0).tolist() == [0.0, 0.5]


def test_days_and_months_that_cannot_be_told_apart_are_asked_for() -> None:
    table = parse_table("t,u\n03/04/2026 23:59:59,1\n04/04/2026 00:00:00,2\n", source="run.csv")
    with pytest.raises(InputError, match="column t: '03/04/2026 23:59:59' may begin with its day or its month; write"):
        table.column(0)
    same = parse_table("t,u\n03/04/2026 23:59:58,1\n03/04/2026 23:59:59,2\n", source="run.csv")
    assert same.column(0).tolist() == [0.0, 1.0]  # whichever it is
