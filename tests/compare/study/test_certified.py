"""Proved errors in the report agree with the study's floats and know where they do not apply."""

import numpy as np
import pytest

from ridgeback.compare.study.certified import certified, certified_rows
from ridgeback.compare.study.study import study
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("name", ["pendulum", "duffing-softening", "helmholtz-duffing"])
def test_the_series_row_is_what_the_study_measures(name: str) -> None:
    found = certified(find(name), 6, 0.4)
    assert found is not None
    measured = study(find(name), [6], found.amplitudes).relative_error[0]
    proved = np.array(found.rows[0].errors, dtype=float)
    assert found.rows[0].method == "truncated series"
    assert np.allclose(proved, measured, rtol=1e-6, atol=1e-13)
    assert all(row.radius < 1e-30 for row in found.rows)


def test_the_nome_beats_the_series_it_is_made_from() -> None:
    found = certified(find("pendulum"), 8, 3.0)
    assert found is not None
    rows = {row.method: np.array(row.errors, dtype=float) for row in found.rows}
    nome = next(errors for method, errors in rows.items() if "nome" in method)
    assert np.all(np.abs(nome) < 0.02 * np.abs(rows["truncated series"]))


@pytest.mark.parametrize("equation", ["u'' + u + c*u**3", "u'' - eps*(1 - u**2)*u' + u - u**3"])
def test_nothing_is_claimed_where_there_is_no_enclosure(equation: str) -> None:
    assert certified(Oscillator.from_equation(equation), 4, 1.0) is None


def test_the_errors_of_a_limit_cycle_are_those_against_the_orbit_found_by_shooting() -> None:
    rows = [row for row in certified_rows(find("van-der-pol"), (4, 8), [1.0]) if row["method"] == "truncated series"]
    measured = study(find("van-der-pol"), (4, 8), [1.0]).rows()
    for row, other in zip(rows, measured, strict=True):
        assert row["eps"] == other["eps"] == 1.0
        assert row["relative_error"] == pytest.approx(other["relative_error"], rel=1e-5)
        assert float(row["error_radius"] or 1) < 1e-18
