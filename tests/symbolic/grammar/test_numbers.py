"""Numbers as they are typed: exact, and nothing else is one."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.parse import (
    parse_number,
)

QUICK = settings(deadline=None, max_examples=150)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("12.566370614359172", Fraction(12566370614359172, 10**15)),
        ("-0.01", Fraction(-1, 100)),
        ("+3", Fraction(3)),
        (" 7/12 ", Fraction(7, 12)),
        ("1 / -4", Fraction(-1, 4)),
        ("1e-3", Fraction(1, 1000)),
        ("2.5E+2", Fraction(250)),
        (".5", Fraction(1, 2)),
        ("5.", Fraction(5)),
    ],
)
def test_numbers_mean_exactly_what_they_say(text, value):
    assert parse_number(text) == value


NOT_NUMBERS = "nan inf -inf 1/0 1/2/3 1e101 1e 0x10 1_000 1,5 ١ --1 1e-999999999999 pi 1e5.5"


@pytest.mark.parametrize("text", [*NOT_NUMBERS.split(), "", "1 2", "\x00", "9" * 61, "9" * 3000])
def test_other_numbers_are_refused_in_one_line(text):
    with pytest.raises(InputError) as caught:
        parse_number(text)
    assert str(caught.value).isprintable()


@QUICK
@given(st.fractions(max_denominator=10**12))
def test_fractions_read_back(value):
    assert parse_number(str(value)) == value


@QUICK
@given(st.floats(min_value=1e-90, max_value=1e90))
def test_decimals_are_the_shortest_that_round_to_the_float(value):
    assert float(parse_number(repr(value))) == value
