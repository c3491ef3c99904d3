"""How numbers are written on the page: plain text, no SI prefixes, relative errors in per cent or as powers."""

from __future__ import annotations

import math

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
NONE = "–"


def power_of_ten(exponent: int) -> str:
    """Write a power of ten.

    >>> power_of_ten(-6)
    '10⁻⁶'
    """
    return "10" + str(exponent).translate(_SUPERSCRIPT)


def number(value: float | None, digits: int = 4) -> str:
    """Write a number with so many significant digits, powers of ten beyond 10^6 and below 10^-4.

    >>> number(12.566370614), number(6.02e23, 3), number(-0.00002, 2), number(None), number(0.0)
    ('12.57', '6.02 × 10²³', '−2 × 10⁻⁵', '–', '0')
    """
    if value is None or math.isnan(value):
        return NONE
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    if 1e-4 <= abs(value) < 1e6:
        return f"{value:.{digits}g}".replace("-", "−") if "e" not in f"{value:.{digits}g}" else _plain(value)
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa} × {power_of_ten(int(exponent))}".replace("-", "−")


def _plain(value: float) -> str:
    return f"{value:.0f}".replace("-", "−")


def relative(value: float | None, *, signed: bool = False) -> str:
    """Write a relative error: per cent down to 0.01 %, then a power of ten.

    >>> relative(0.0095), relative(4.8e-5), relative(-0.0102, signed=True), relative(None)
    ('0.95 %', '4.8 × 10⁻⁵', '−1 %', '–')
    """
    if value is None or math.isnan(value):
        return NONE
    sign = "+" if signed and value > 0 else ""
    if value == 0 or math.isinf(value) or abs(value) < 1e-4:
        return sign + number(value, 2)
    return f"{sign}{number(100 * value, 2)} %"


def threshold(value: float) -> str:
    """Write a round threshold.

    >>> threshold(0.1), threshold(1e-3), threshold(1e-4), threshold(1e-6)
    ('10 %', '0.1 %', '10⁻⁴', '10⁻⁶')
    """
    exponent = round(math.log10(value))
    if value < 5e-4 and math.isclose(value, 10.0**exponent, rel_tol=1e-9):
        return power_of_ten(exponent)
    return relative(value)


def listing(items: list[str]) -> str:
    """Join names as a sentence does.

    >>> listing(["a"]), listing(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1] if items else ""
