"""How numbers are written for a reader: no SI prefixes, relative errors in per cent or as powers of ten.

Text is Unicode (a true minus, superscripts).  A missing number is a dash unless the caller says otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction

NONE = "–"
"""What stands for a missing number."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_LEAST_PER_CENT = 1e-6
_OFF_SCALE = 10.0
_PER_CENT = 1e-4
"""Relative errors from here on are written in per cent, smaller ones as powers of ten."""


def minus(text: str) -> str:
    """Text with a true minus for every hyphen.

    >>> minus(f"{-3.5:g} dB")
    '−3.5 dB'
    """
    return text.replace("-", "−")


def power_of_ten(exponent: int) -> str:
    """A power of ten.

    >>> power_of_ten(-6)
    '10⁻⁶'
    """
    return "10" + str(exponent).translate(_SUPERSCRIPTS)


def scientific(value: float, *, digits: int = 2) -> str:
    """A number as a mantissa of so many digits and a power of ten.

    >>> scientific(5.93e-9), scientific(-2e-14, digits=1)
    ('5.9 × 10⁻⁹', '−2 × 10⁻¹⁴')
    """
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{minus(mantissa)} × {power_of_ten(int(exponent))}"


def exact_text(value: Fraction, *, longest: int = 40) -> str:
    """An exact number; one of more than ``longest`` characters with the powers of ten of a whole number as an exponent.

    >>> exact_text(Fraction(5, 2)), exact_text(Fraction("1.5e300")), exact_text(Fraction("-3e-300"))
    ('5/2', '15e299', '-3e-300')
    >>> exact_text(Fraction(10**300, 3))
    '1e300/3'
    """
    text = str(value)
    if len(text) <= longest:
        return text
    (top, up), (below, down) = (_without_tens(part) for part in (value.numerator, value.denominator))
    power = f"{top}e{up - down}" if up != down else str(top)
    return power if below == 1 else f"{power}/{below}"


def _without_tens(whole: int) -> tuple[int, int]:
    """A whole number but 0 without its zeros at the end, and how many they were."""
    digits = str(whole).rstrip("0")
    return int(digits), len(str(whole)) - len(digits)


def number(value: float | None, digits: int = 4) -> str:
    """A number with so many significant digits, as a power of ten from 10^6 on and below 10^-4.

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
        text = f"{value:.{digits}g}"
        return minus(text if "e" not in text else f"{value:.0f}")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return f"{minus(mantissa)} × {power_of_ten(int(exponent))}"


def two_digits(value: float) -> str:
    """Two significant digits without an exponent.

    >>> two_digits(0.1934), two_digits(12.3), two_digits(1.04), two_digits(9.96)
    ('0.19', '12', '1.0', '10')
    """
    mantissa, exponent = f"{value:.1e}".split("e")
    return minus(f"{float(mantissa) * 10 ** int(exponent):.{max(0, 1 - int(exponent))}f}")


def relative(value: float | None, *, signed: bool = False, missing: str = NONE) -> str:
    """A relative error to two digits: per cent down to 0.01 %, below that a power of ten.

    >>> relative(0.0019), relative(-0.0102, signed=True), relative(1.7e-5), relative(None), relative(0.0)
    ('0.19 %', '−1.0 %', '1.7 × 10⁻⁵', '–', '0')
    """
    if value is None or math.isnan(value):
        return missing
    sign = "+" if signed and value > 0 else ""
    if value == 0 or math.isinf(value):
        return sign + number(value)
    return sign + (f"{two_digits(100 * value)} %" if abs(value) >= _PER_CENT else scientific(value))


def per_cent(value: float | None, *, signed: bool = False, missing: str = NONE) -> str:
    """A relative error on a page: two digits in per cent from 0.0001 % to 1000 %, a power of ten only below that.

    >>> per_cent(0.0019), per_cent(-0.0102, signed=True), per_cent(1.7e-5), per_cent(2.3e-8), per_cent(66.0)
    ('0.19 %', '−1.0 %', '0.0017 %', '2.3 × 10⁻⁸', 'over 1000 %')
    """
    if value is not None and abs(value) > _OFF_SCALE:
        return f"over {100 * _OFF_SCALE:.0f} %"
    if value is None or not math.isfinite(value) or value == 0 or abs(value) >= _PER_CENT:
        return relative(value, signed=signed, missing=missing)
    sign = "+" if signed and value > 0 else ""
    return sign + (f"{two_digits(100 * value)} %" if abs(value) >= _LEAST_PER_CENT else scientific(value))


def powers(value: float | None, *, signed: bool = False, missing: str = NONE) -> str:
    """A relative error as two digits and a power of ten, however large.

    >>> powers(0.0019), powers(-2.3e-8, signed=True), powers(None), powers(0.0)
    ('1.9 × 10⁻³', '−2.3 × 10⁻⁸', '–', '0')
    """
    if value is None or not math.isfinite(value) or value == 0:
        return relative(value, signed=signed, missing=missing)
    return ("+" if signed and value > 0 else "") + scientific(value)


def alike(values: Iterable[float | None]) -> Callable[..., str]:
    """How the relative errors of one column are written: in per cent, or all as powers of ten where one is below those.

    >>> alike([0.5, 1e-3]) is per_cent, alike([0.5, None, 1e-9]) is powers
    (True, True)
    """
    return powers if any(value and abs(value) < _LEAST_PER_CENT for value in values) else per_cent


def offset(value: float | None) -> str:
    """A signed relative error as a size and a direction.

    >>> offset(-0.008), offset(0.021), offset(None)
    ('0.80 % low', '2.1 % high', 'no value')
    """
    if value is None or not math.isfinite(value):
        return "no value"
    return f"{relative(abs(value))} {'low' if value < 0 else 'high'}"


def threshold(value: float) -> str:
    """A round limit of a relative error.

    >>> threshold(0.1), threshold(1e-3), threshold(1e-4), threshold(1e-6), threshold(0.0025)
    ('10 %', '0.1 %', '10⁻⁴', '10⁻⁶', '0.25 %')
    """
    exponent = round(math.log10(value))
    if value < 5e-4 and math.isclose(value, 10.0**exponent, rel_tol=1e-9):
        return power_of_ten(exponent)
    return f"{100 * value:.2g} %" if value >= _PER_CENT else relative(value)


def signed(value: float, digits: int = 4) -> str:
    """A number with its sign and so many decimals.

    >>> signed(-0.05), signed(0.12345)
    ('−0.0500', '+0.1235')
    """
    return minus(f"{value:+.{digits}f}")


def decibels(level: float) -> str:
    """A level to the decibel.

    >>> decibels(-35.4)
    '−35 dB'
    """
    return minus(f"{level + 0.0:.0f} dB")


def rounded_down(value: float, digits: int) -> float:
    """A positive limit rounded down to significant digits, so that what is printed still holds.

    >>> rounded_down(2.1991, 3), rounded_down(0.5, 3), rounded_down(2.64, 3)
    (2.19, 0.5, 2.64)
    """
    scale = 10.0 ** (digits - 1 - math.floor(math.log10(value)))
    return math.floor(value * scale * (1 + 1e-12)) / scale


def uncertain(value: float | None, deviation: float | None, *, plain: bool = False) -> str:
    """A value and its standard deviation, to two digits of that; ``plain`` keeps to ASCII, as a terminal may have to.

    >>> uncertain(0.0123456, 0.00034), uncertain(3.2e-6, 1.1e-7), uncertain(0.98, 0.05), uncertain(None, None)
    ('0.01235 ± 0.00034', '(3.20 ± 0.11) × 10⁻⁶', '0.980 ± 0.050', '–')
    >>> uncertain(-3.2e-6, 1.1e-7, plain=True), uncertain(1.5, None, plain=True), uncertain(None, 1.0, plain=True)
    ('(-3.20 +- 0.11)e-6', '1.5', '-')
    """
    if value is None:
        return "-" if plain else NONE
    if deviation is None or not deviation > 0.0:
        return f"{value:.4g}" if plain else number(value)
    size = max(abs(value), deviation)
    exponent = math.floor(math.log10(size)) if size < 1e-3 or size >= 1e5 else 0
    scale = 10.0**exponent
    digits = max(0, 1 - math.floor(math.log10(deviation / scale)))
    mean, spread = f"{value / scale:.{digits}f}", f"{deviation / scale:.{digits}f}"
    text = f"{mean} +- {spread}" if plain else f"{minus(mean)} ± {spread}"
    if exponent == 0:
        return text
    return f"({text})e{exponent}" if plain else f"({text}) × {power_of_ten(exponent)}"


def how_many(count: int, thing: str) -> str:
    """How many there are of something.

    >>> how_many(1, "oscillator"), how_many(5, "oscillator")
    ('1 oscillator', '5 oscillators')
    """
    return f"{count} {thing}{'' if count == 1 else 's'}"


def listing(items: Sequence[str]) -> str:
    """Names joined as a sentence does.

    >>> listing(["a"]), listing(["a", "b", "c"]), listing([])
    ('a', 'a, b and c', '')
    """
    return " and ".join(part for part in (", ".join(items[:-1]), *items[-1:]) if part)
