"""The small languages of the command line: parameters, initial states, orders and amplitude grids."""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from typing import Any, TypeVar

import click

T = TypeVar("T")

MAX_GRID = 10_000
MAX_ORDERS = 200

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,39}", re.ASCII)
# At most three digits of exponent: an exact 1e999999999 would fill the memory.
DECIMAL = re.compile(r"[+-]?(\d{1,60}(\.\d{0,60})?|\.\d{1,60})([eE][+-]?\d{1,3})?", re.ASCII)
RATIO = re.compile(r"[+-]?\d{1,60}/\d{1,60}", re.ASCII)


def written(read: Callable[[str], T]) -> Callable[[Any], T]:
    """A type for click from a function that reads text and raises ValueError with the rule and the remedy."""

    def convert(value: Any) -> T:
        """Read the text; click names the option in the message."""
        try:
            return read(str(value))
        except ValueError as error:
            raise click.BadParameter(str(error)) from None

    return convert


def shown(text: str) -> str:
    """The text in quotes, cut where it grows too long for one line."""
    return repr(text if len(text) <= 60 else text[:57] + "...")


def rational(text: str) -> Fraction:
    """An exact number from a decimal or a ratio of integers.

    >>> rational("0.01"), rational("-3/8"), rational("2e-3")
    (Fraction(1, 100), Fraction(-3, 8), Fraction(1, 500))
    >>> rational("nan")
    Traceback (most recent call last):
        ...
    ValueError: 'nan' is not a finite number; write a decimal such as 0.01 or a ratio such as 3/8
    """
    word = text.strip()
    if not (DECIMAL.fullmatch(word) or RATIO.fullmatch(word)):
        raise ValueError(f"{shown(text)} is not a finite number; write a decimal such as 0.01 or a ratio such as 3/8")
    try:
        return Fraction(word)
    except ZeroDivisionError:
        raise ValueError(f"{shown(text)} divides by zero; the denominator must not be 0") from None


def number(text: str) -> float:
    """A finite float from a decimal or a ratio.

    >>> number("2.984513"), number("1/4")
    (2.984513, 0.25)
    """
    return rounded(rational(text), text)


def rounded(exact: Fraction, text: str) -> float:
    """The nearest float; ``text`` is what the message shows.

    >>> rounded(Fraction(1, 3), "1/3")
    0.3333333333333333
    """
    try:
        return exact.numerator / exact.denominator
    except OverflowError:
        raise ValueError(f"{shown(text)} is beyond the largest double, 1.8e308; give a smaller number") from None


def assignment(text: str) -> tuple[str, Fraction]:
    """A parameter and its exact value.

    >>> assignment("mu=0.01")
    ('mu', Fraction(1, 100))
    """
    name, sign, value = text.partition("=")
    if not sign or not NAME.fullmatch(name.strip()):
        raise ValueError(f"{shown(text)} is not NAME=VALUE; write for example mu=0.01")
    return name.strip(), rational(value)


def law(text: str) -> tuple[str, str]:
    """A parameter and its law in time, which is read when the oscillator is there.

    >>> law("L = 1+0.01*t")
    ('L', '1+0.01*t')
    """
    name, equals, right = (part.strip() for part in text.partition("="))
    if not (equals and right) or not NAME.fullmatch(name):
        raise ValueError(f"{shown(text)} is no law of a parameter; write for example L=1+0.01*t")
    return name, right


def pair(text: str) -> tuple[float, float]:
    """Two numbers with a comma between.

    >>> pair("2.984513,0")
    (2.984513, 0.0)
    """
    parts = text.split(",")
    if len(parts) != 2:
        raise ValueError(f"{shown(text)} has {len(parts)} numbers, not 2; write for example 2.984513,0")
    return number(parts[0]), number(parts[1])


def band(text: str) -> tuple[float, float]:
    """A frequency band in rad per time unit, low end first.

    >>> band("3,12.5")
    (3.0, 12.5)
    """
    low, high = pair(text)
    if not 0 <= low < high:
        raise ValueError(f"{shown(text)} is not a band; give 0 <= LOW < HIGH, for example 3,12.5")
    return low, high


def span(text: str) -> tuple[float, float]:
    """Two times, the first one first.

    >>> span("-1.5,4")
    (-1.5, 4.0)
    """
    begin, end = pair(text)
    if not begin < end:
        raise ValueError(f"{shown(text)} is no span of time: T0 must be below T1; write for example 1,5")
    return begin, end


def orders(text: str) -> tuple[int, ...]:
    """Orders with commas between, rising and unique in the result.

    >>> orders("8,2,4")
    (2, 4, 8)
    """
    words = [word.strip() for word in text.split(",")]
    wrong = [word for word in words if not re.fullmatch(r"\d{1,5}", word, re.ASCII)]
    if wrong:
        raise ValueError(f"{shown(wrong[0])} is not an order; give integers from 0 to 99999, for example 2,4,8,16")
    if len(words) > MAX_ORDERS:
        raise ValueError(f"{len(words)} orders are more than {MAX_ORDERS}; give fewer")
    return tuple(sorted({int(word) for word in words}))


def amplitudes(text: str) -> tuple[Fraction, ...]:
    """Exact amplitudes, as a list with commas or as START:STOP:COUNT with both ends.

    >>> amplitudes("1,2.5"), amplitudes("0.1:0.3:3")
    ((Fraction(1, 1), Fraction(5, 2)), (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10)))
    """
    values = spaced(text) if ":" in text else tuple(rational(word) for word in text.split(","))
    if len(values) > MAX_GRID:
        raise ValueError(f"{len(values)} amplitudes are more than {MAX_GRID}; give fewer")
    if any(value <= 0 for value in values):
        raise ValueError(f"{shown(text)} holds {min(values)}; every amplitude must be above 0")
    return values


def spaced(text: str) -> tuple[Fraction, ...]:
    """COUNT equidistant fractions from START to STOP.

    >>> spaced("1:2:3")
    (Fraction(1, 1), Fraction(3, 2), Fraction(2, 1))
    """
    parts = text.split(":")
    if len(parts) != 3:
        raise ValueError(f"{shown(text)} is not START:STOP:COUNT; write for example 0.1:3.0:30")
    start, stop, count = rational(parts[0]), rational(parts[1]), parts[2].strip()
    if not re.fullmatch(r"\d{1,6}", count, re.ASCII) or not 2 <= int(count) <= MAX_GRID:
        raise ValueError(f"{shown(count)} is not a count; give an integer from 2 to {MAX_GRID}")
    if not start < stop:
        raise ValueError(f"START {parts[0].strip()} is not below STOP {parts[1].strip()}; swap them")
    last = int(count) - 1
    return tuple(start + (stop - start) * Fraction(i, last) for i in range(last + 1))


def grid(text: str) -> tuple[float, ...]:
    """Amplitudes as floats, each rounded once from its exact value.

    >>> grid("0.5:1.5:3"), grid("0.1,2")
    ((0.5, 1.0, 1.5), (0.1, 2.0))
    """
    return tuple(rounded(value, text) for value in amplitudes(text))


def positive(text: str) -> float:
    """A finite number above 0.

    >>> positive("64")
    64.0
    """
    value = number(text)
    if value <= 0:
        raise ValueError(f"{shown(text)} is not above 0; give a positive number")
    return value


def order(text: str) -> int:
    """An order: an integer of 0 or more.

    >>> order("8")
    8
    >>> order("-1")
    Traceback (most recent call last):
        ...
    ValueError: '-1' is not an order; give an integer of 0 or more, for example 8
    """
    if not re.fullmatch(r"\d{1,9}", text.strip(), re.ASCII):
        raise ValueError(f"{shown(text)} is not an order; give an integer of 0 or more, for example 8")
    return int(text.strip())


ASSIGNMENT = written(assignment)


def weights(text: str) -> dict[str, int]:
    """Weights of small parameters by name.

    >>> weights("mu=2,c3=1")
    {'mu': 2, 'c3': 1}
    """
    found: dict[str, int] = {}
    for word in text.split(","):
        name, _, value = (part.strip() for part in word.partition("="))
        if not NAME.fullmatch(name) or not re.fullmatch(r"\d{1,3}", value, re.ASCII) or name in found:
            raise ValueError(f"{shown(text)} does not give each name one whole weight; write e.g. mu=2,c3=1")
        found[name] = int(value)
    return found


LAW = written(law)
PAIR = written(pair)
WEIGHTS = written(weights)
BAND = written(band)
SPAN = written(span)
ORDERS = written(orders)
GRID = written(grid)
POSITIVE = written(positive)
ORDER = written(order)
