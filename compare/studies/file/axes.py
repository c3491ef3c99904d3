"""The values along an axis of a study: one number, a list, or a range; exact as they are written."""

from __future__ import annotations

import math
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeVar

from ridgeback.common.errors import InputError

MOST = 1_000_000
"""Values on one axis."""
SHAPES = ("linear", "log")
RULE = "a number, a list of numbers, or a range such as { from = 0.1, to = 3, count = 30 }"


Number = TypeVar("Number", Fraction, float)


def exact_values(given: Any) -> tuple[Fraction, ...]:
    """The values of an axis as exact numbers, in the order given.

    >>> exact_values({"from": Decimal("0.1"), "to": Decimal("0.3"), "count": 3})
    (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10))
    >>> exact_values({"from": 1, "to": 100, "count": 3, "spacing": "log"}) == (1, 10, 100)
    True
    """
    if isinstance(given, Mapping):
        return spaced(given)
    items = given if isinstance(given, list | tuple) else [given]
    if not items:
        raise InputError(f"is an empty list; give {RULE}")
    if len(items) > MOST:
        raise InputError(f"has {len(items)} values, more than {MOST}; give fewer")
    return tuple(exact(item) for item in items)


def exact(given: Any) -> Fraction:
    """One exact number: an integer, a decimal as written, or text such as "1/3".

    >>> exact(Decimal("0.01")), exact("3/8")
    (Fraction(1, 100), Fraction(3, 8))
    """
    if isinstance(given, bool) or not isinstance(given, int | float | Decimal | Fraction | str):
        raise InputError(f"{shown(given)} is not a number; give {RULE}")
    text = str(given).strip()
    if (isinstance(given, float) and not math.isfinite(given)) or (
        isinstance(given, Decimal) and not given.is_finite()
    ):
        raise InputError(f"{text} is not a finite number; give {RULE}")
    if isinstance(given, Decimal) and given and abs(given.adjusted()) > 400:
        raise InputError(f"{shown(text)} has an exponent beyond 400; give a number of moderate size")
    if isinstance(given, str) and ("e" in text.lower() or len(text) > 120):
        raise InputError(f'{shown(text)} is not a number; write it without quotes, or as a ratio such as "1/3"')
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise InputError(f"{shown(text)} is not a number; give {RULE}") from None


def spaced(given: Mapping[str, Any]) -> tuple[Fraction, ...]:
    """The values of a range; both ends belong to it."""
    unknown = sorted(set(given) - {"from", "to", "count", "spacing"})
    missing = [name for name in ("from", "to", "count") if name not in given]
    if unknown or missing:
        what = f"has {unknown[0]!r}" if unknown else f"lacks {missing[0]!r}"
        raise InputError(f'{what}; a range is {{ from = 0.1, to = 3, count = 30, spacing = "linear" or "log" }}')
    start, stop, count, shape = exact(given["from"]), exact(given["to"]), given["count"], given.get("spacing", "linear")
    if type(count) is not int or not 2 <= count <= MOST:
        raise InputError(f"count = {shown(count)} is not a whole number from 2 to {MOST}")
    if shape not in SHAPES:
        raise InputError(f'spacing = {shown(shape)} is neither "linear" nor "log"')
    if not start < stop:
        raise InputError(f"from = {float(start):g} is not below to = {float(stop):g}; swap them")
    if shape == "linear":
        return tuple(start + (stop - start) * Fraction(i, count - 1) for i in range(count))
    if start <= 0:
        raise InputError(f'from = {float(start):g} has no logarithm; give a number above 0, or spacing = "linear"')
    step = math.log(stop / start) / (count - 1)
    inner = (Fraction(f"{float(start) * math.exp(i * step):.15g}") for i in range(1, count - 1))
    return (start, *inner, stop)


def floats(given: Any, *, low: float = -math.inf, high: float = math.inf, closed: bool = False) -> tuple[float, ...]:
    """The values of an axis as floats, each within its limits and none twice.

    >>> floats([1, Decimal("2.5")], low=0.0)
    (1.0, 2.5)
    """
    values = tuple(rounded(value) for value in exact_values(given))
    for value in values:
        if not (low < value < high or (closed and value in (low, high))):
            raise InputError(f"holds {value:g}; {within(low, high, closed=closed)}")
    return once(values)


def once(values: tuple[Number, ...]) -> tuple[Number, ...]:
    """The values, none of which is there twice.

    >>> once((1, 2))
    (1, 2)
    """
    if len(set(values)) < len(values):
        twice = next(value for i, value in enumerate(values) if value in values[:i])
        raise InputError(f"holds {float(twice):g} twice; give each value once")
    return values


def within(low: float, high: float, *, closed: bool) -> str:
    """The limits in words.

    >>> within(0.0, math.inf, closed=False), within(0.0, 1.0, closed=True)
    ('give numbers above 0', 'give numbers from 0 to 1')
    """
    if high == math.inf:
        return f"give numbers {'from' if closed else 'above'} {low:g}{' up' if closed else ''}"
    return f"give numbers {'from' if closed else 'between'} {low:g} {'to' if closed else 'and'} {high:g}"


def rounded(value: Fraction) -> float:
    """The nearest float."""
    try:
        return value.numerator / value.denominator
    except OverflowError:
        raise InputError("holds a number beyond the largest double, 1.8e308; give a smaller one") from None


def whole_numbers(given: Any, *, low: int, high: int) -> tuple[int, ...]:
    """Whole numbers of an axis, each once, rising.

    >>> whole_numbers([8, 2], low=0, high=99)
    (2, 8)
    """
    values = exact_values(given)
    wrong = [v for v in values if v.denominator != 1 or not low <= v <= high]
    if wrong:
        raise InputError(f"holds {float(wrong[0]):g}; give whole numbers from {low} to {high}")
    return tuple(sorted(int(v) for v in once(values)))


def shown(given: Any) -> str:
    """A value in quotes, cut where it grows too long for a line."""
    text = repr(str(given) if isinstance(given, Decimal) else given)
    return text if len(text) <= 60 else text[:57] + "..."
