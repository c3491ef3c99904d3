"""Formulas as MathML and tables as cells: sound markup, no command left over, every number in its column."""

from __future__ import annotations

from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.numbers import per_cent
from ridgeback.compare.motion.results import BudgetRow
from ridgeback.compare.study.results import Formula, Range
from ridgeback.reports.text.align import DIGIT, POINT, aligned
from ridgeback.reports.text.mathml import FormulaError, formula_latex, formula_mathml, mathml, term_parts
from ridgeback.reports.text.tables import budget_table, range_table


def letters(markup: str) -> str:
    return "".join(ET.fromstring(markup).itertext())  # noqa: S314 - what was just written


@pytest.mark.parametrize(
    ("latex", "text"),
    [
        (r"\omega_0 = 1 - \frac{1}{16} A^{2}", "ω0=1−116A2"),
        (r"\ddot{u} + \sin u = 0", "u..+sinu=0"),
        (r"\sqrt{1 - \mu^2}", "1−μ2"),
        (r"2 \mathrm{d} t", "2dt"),
    ],
)
def test_a_formula_keeps_each_of_its_signs(latex: str, text: str) -> None:
    assert letters(mathml(latex)) == text


@pytest.mark.parametrize("latex", [r"\nonsense x", r"\href{javascript:alert(1)}{x}", "{", r"\frac{1}{"])
def test_what_is_no_formula_is_refused(latex: str) -> None:
    with pytest.raises(FormulaError):
        mathml(latex)


def test_functions_stand_upright_and_apart() -> None:
    tree = ET.fromstring(mathml(r"2 \sin x"))  # noqa: S314
    sine = next(e for e in tree.iter("mi") if e.text == "sin")
    assert sine.get("mathvariant") in (None, "normal")
    assert len(list(tree.iter("mspace"))) == 2


@settings(deadline=None, max_examples=40)
@given(st.lists(st.integers(-99, 99).filter(bool), min_size=1, max_size=6))
def test_terms_are_signed_once(values: list[int]) -> None:
    terms = tuple(str(value) for value in values)
    parts = term_parts(terms)
    assert sum(map(int, parts)) == sum(values)
    assert all(part[0] in "+-" for part in parts[1:])
    whole = Formula(title="", left="w", terms=terms)
    assert len(formula_mathml(whole)) == len(terms) + 1
    assert formula_latex(whole) == "w = " + " ".join(parts)


def test_ranges_of_use_stand_under_their_targets() -> None:
    ranges = [Range(order, target, up_to) for order, target, up_to in ((2, 0.01, 0.79999), (2, 0.001, None))]
    ranges.append(Range(4, 0.01, 1.5))
    table = range_table(ranges, "A", "rad")
    assert table.head == ("order", "within 1 %", "within 0.1 %")
    assert [row.cells for row in table.rows] == [("2", "0.799", "nowhere"), ("4", "1.500", "–")]


def test_every_row_has_a_cell_for_each_head_and_points_stand_under_each_other() -> None:
    rows = [BudgetRow(name, name, 0.23, None, None, 1e-9, total, 2e-5) for name, total in (("a", 0.23), ("b", 1.2e-5))]
    table = budget_table(rows)
    assert [len(row.cells) for row in table.rows] == [len(table.head)] * 2
    totals = [row.cells[4] for row in table.rows]
    assert totals == [f"23{4 * DIGIT}{POINT} %", "0.0012 %"]
    assert len({cell.index(" %") - (cell.index(".") if "." in cell else 2) for cell in totals}) == 1


@given(st.lists(st.floats(1e-6, 9.0), min_size=1, max_size=8))
def test_padding_adds_nothing_but_space(values: list[float]) -> None:
    cells = [per_cent(value) for value in values]
    padded = aligned(cells)
    assert [cell.replace(POINT, "").replace(DIGIT, "") for cell in padded] == cells
    after = {len(cell) - cell.find(".") for cell in padded if "." in cell}
    assert len(after) <= 1
