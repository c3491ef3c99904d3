"""Text tables: what is no number and no row of the table is refused, by its line."""

from __future__ import annotations

import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.text import parse_table


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,u\n0,1\n1,2,3\n", "run.csv, line 3 has 3 cells, the first row 2; is a comma a decimal point there"),
        ("0 1\n1 2 3\n2 3\n", "run.csv, line 2 has 3 cells, the first row 2"),
        ("t;u\n0;1\n\n1;2;x\n", "run.csv, line 4 has 3 cells"),
    ],
)
def test_a_row_with_more_cells_than_the_header_is_refused(text: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_table(text, source="run.csv")
    assert said in str(caught.value)


def test_empty_cells_at_the_end_of_a_row_are_none() -> None:
    assert parse_table("t,u\n0,1,\n1,2,,\n", source="run.csv").column(1).tolist() == [1.0, 2.0]


@pytest.mark.parametrize("cell", ["1_05", "1__0", "0x10", "1e5_0"])
def test_what_only_a_programming_language_calls_a_number_is_none(cell: str) -> None:
    table = parse_table(f"t,u\n0,1\n1,{cell}\n", source="run.csv")
    with pytest.raises(InputError, match=f"line 3, column u: '{cell}' is not a number"):
        table.column(1)
