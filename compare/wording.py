"""Numbers as a reader meets them: relative errors in per cent or as a power of ten, angles in units of π."""

from __future__ import annotations

import math


def relative(value: float | None, *, signed: bool = False) -> str:
    """Relative error: per cent down to 0.01 %, below that in powers of ten; never an SI prefix.

    >>> relative(0.0019), relative(-0.0102, signed=True), relative(1.7e-5), relative(None)
    ('0.19 %', '−1.0 %', '1.7 × 10⁻⁵', 'no value')
    """
    if value is None or not math.isfinite(value):
        return "no value"
    size = abs(value)
    sign = "−" if value < 0 else "+" if signed else ""
    if size >= 1e-4:
        return f"{sign}{_two_digits(100 * size)} %"
    return f"{sign}{scientific(size)}" if size else "0"


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def scientific(value: float, *, digits: int = 2) -> str:
    """A number as a mantissa and a power of ten.

    >>> scientific(5.93e-9), scientific(2e-14, digits=1)
    ('5.9 × 10⁻⁹', '2 × 10⁻¹⁴')
    """
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa} × 10{str(int(exponent)).translate(_SUPERSCRIPTS)}"


def offset(value: float | None) -> str:
    """A signed relative error as a size and a direction.

    >>> offset(-0.008), offset(0.021)
    ('0.80 % low', '2.1 % high')
    """
    if value is None or not math.isfinite(value):
        return relative(value)
    return f"{relative(abs(value))} {'low' if value < 0 else 'high'}"


def _two_digits(value: float) -> str:
    """Return two significant digits without an exponent.

    >>> _two_digits(0.1934), _two_digits(12.3), _two_digits(1.04)
    ('0.19', '12', '1.0')
    """
    places = max(0, 1 - math.floor(math.log10(value) + 1e-12))
    return f"{value:.{places}f}"


def in_pi(value: float, *, digits: int = 3) -> str:
    """Angle in units of π.

    >>> in_pi(0.6589 * math.pi)
    '0.659 π'
    """
    return f"{value / math.pi:.{digits}f} π"


def amplitude(value: float, unit: str) -> str:
    """Amplitude with its unit, angles also in units of π.

    >>> amplitude(2.1, "rad"), amplitude(2.1, "")
    ('2.1 rad (0.668 π)', '2.1')
    """
    text = f"{value:.4g}"
    return f"{text} rad ({in_pi(value)})" if unit == "rad" else f"{text} {unit}".strip()


def rounded_down(value: float, digits: int) -> float:
    """Round a positive limit down to significant digits, so that what is printed still holds.

    >>> rounded_down(2.1991, 3), rounded_down(0.5, 3), rounded_down(2.64, 3)
    (2.19, 0.5, 2.64)
    """
    scale = 10.0 ** (digits - 1 - math.floor(math.log10(value)))
    return math.floor(value * scale * (1 + 1e-12)) / scale


def frequency(omega: float, time_unit: str) -> str:
    """Angular frequency as a reader meets it: hertz when time is in seconds, else rad per time unit.

    >>> frequency(2 * math.pi, "s"), frequency(2.0, "")
    ('1.0000 Hz', '2.0000')
    """
    if time_unit == "s":
        return f"{omega / (2 * math.pi):.4f} Hz"
    return f"{omega:.4f} rad/{time_unit}" if time_unit else f"{omega:.4f}"


_GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eps": "ε", "epsilon": "ε", "lambda": "λ", "mu": "μ"}
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def symbol(name: str) -> str:
    """A parameter's name as it is printed in text.

    >>> symbol("mu"), symbol("alpha3"), symbol("c")
    ('μ', 'α₃', 'c')
    """
    stem = name.rstrip("0123456789")
    return _GREEK.get(stem, stem) + name[len(stem) :].translate(_SUBSCRIPTS)


def nanoseconds(value: float) -> str:
    """Time per value, three digits.

    >>> nanoseconds(6.234), nanoseconds(1234.0)
    ('6.23 ns', '1230 ns')
    """
    return f"{float(f'{value:.3g}'):g} ns"
