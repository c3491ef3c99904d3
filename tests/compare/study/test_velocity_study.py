"""A study of a force a(u) + b(u) u'^2: its reference is the certified enclosure."""

from __future__ import annotations

import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.study.certified import certified_rows
from ridgeback.compare.study.study import MAX_ENCLOSED, study
from ridgeback.symbolic.systems.oscillator import Oscillator

HEAVY = Oscillator.from_equation("u'' + u + u*u'**2 = 0", name="heavy", potential="u**2/2")


def test_the_study_is_held_against_enclosures() -> None:
    result = study(HEAVY, (4, 8), [0.5, 1.0])
    assert result.reference_name == "certified enclosure"
    proved = [row for row in certified_rows(HEAVY, (4, 8), [0.5, 1.0]) if row["method"] == "truncated series"]
    assert [row["omega_reference"] for row in proved] == pytest.approx([*result.reference, *result.reference])
    assert [row["relative_error"] for row in proved] == pytest.approx([*result.relative_error.flat], rel=1e-5)


def test_the_closed_form_of_mathews_and_lakshmanan_is_the_reference() -> None:
    own = Oscillator.from_equation("(1 - u**2/4)*u'' + u*u'**2/4 + u")
    result = study(own, (2,), [0.5, 1.5])
    assert result.reference == pytest.approx([(1 - 0.25 * a * a) ** -0.5 for a in (0.5, 1.5)], rel=1e-15)


def test_what_has_no_enclosure_is_integrated_and_too_many_amplitudes_are_refused() -> None:
    result = study(Oscillator.from_equation("u'' + u + u*u'**4"), (8,), [0.2])
    assert result.reference_name.startswith("one cycle integrated")
    assert abs(result.relative_error[0, 0]) < 1e-8
    with pytest.raises(InputError, match=f"use at most {MAX_ENCLOSED}"):
        study(HEAVY, (2,), [0.1 + 1e-4 * n for n in range(MAX_ENCLOSED + 1)])
