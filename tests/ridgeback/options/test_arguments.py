"""The command line's small languages: what they accept, and that nothing else passes or crashes."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import click
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ridgeback.options import arguments

READERS = {
    "assignment": arguments.assignment,
    "pair": arguments.pair,
    "band": arguments.band,
    "orders": arguments.orders,
    "grid": arguments.grid,
    "positive": arguments.positive,
    "order": arguments.order,
}
# Close to the languages, so that the search finds their edges.
NEARLY = st.text(alphabet="0123456789.,:=/eE+-_ kmunaif²٣½\x00\n", max_size=30)


@pytest.mark.parametrize("name", READERS)
@settings(deadline=None, max_examples=200)
@given(text=st.one_of(NEARLY, st.text(max_size=40)))
@example(text="1e999999999")
@example(text="0:1:1000000000")
@example(text="1/0")
@example(text="=1")
@example(text="٣")
@example(text="0\x1f")
def test_any_text_is_read_or_refused_in_one_sentence(name: str, text: str) -> None:
    """Either a finite value or a ValueError that names a remedy; nothing is evaluated, nothing explodes."""
    try:
        value = READERS[name](text)
    except ValueError as error:
        message = str(error)
        assert ";" in message
        assert len(message) < 400  # each character of the text may be an escape of ten
    else:
        flat = value if isinstance(value, tuple) else (value,)
        assert all(math.isfinite(item) for item in flat if not isinstance(item, str))


@settings(deadline=None)
@given(st.integers(-(10**12), 10**12), st.integers(0, 12))
def test_decimals_are_exact(digits: int, places: int) -> None:
    text = f"{digits}e-{places}"
    assert arguments.assignment(f"mu={text}") == ("mu", Fraction(digits, 10**places))
    assert arguments.number(text) == float(text)


@settings(deadline=None)
@given(st.floats(1e-6, 1e6), st.floats(1e-3, 1e6), st.integers(2, 500))
def test_ranges_have_their_ends_and_rise(start: float, width: float, count: int) -> None:
    values = arguments.grid(f"{start!r}:{start + width!r}:{count}")
    assert len(values) == count
    assert values[0] == start
    assert values[-1] == start + width
    assert all(a < b for a, b in itertools.pairwise(values))


@settings(deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False), st.floats(allow_nan=False, allow_infinity=False))
def test_states_come_back_as_they_were_written(u: float, v: float) -> None:
    assert arguments.pair(f"{u!r},{v!r}") == (u, v)


@settings(deadline=None)
@given(st.lists(st.integers(0, 9999), min_size=1, max_size=40))
def test_orders_rise_and_are_unique(orders: list[int]) -> None:
    assert arguments.orders(",".join(map(str, orders))) == tuple(sorted(set(orders)))


def test_a_refusal_reaches_click_with_its_own_words() -> None:
    with pytest.raises(click.BadParameter, match=r"mu=0\.01"):
        arguments.ASSIGNMENT("nonsense")
    assert arguments.ORDER("8") == 8
