"""How amplitudes, frequencies, times and symbols are written for a reader, with their units."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from ridgeback.common.numbers import NONE, number

# fmt: off
_GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "tau": "τ", "upsilon": "υ", "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
    "eps": "ε", "varepsilon": "ε", "vartheta": "θ", "varphi": "φ",
}
# fmt: on
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
LEAST_SCATTER = 1e-2
"""What a measured time is uncertain by at least, as a share of it."""
SLOW, LARGE = 0.05, 1000.0
"""Frequencies below and above which four decimals are too few or too many; slow ones are told per hour, day or year."""


@dataclass(frozen=True)
class Pace:
    """A unit of time in which the times and rates of a motion have few digits: its name, sign and length in seconds."""

    name: str
    sign: str
    seconds: float


SECOND, HOUR, DAY = Pace("second", "s", 1.0), Pace("hour", "h", 3600.0), Pace("day", "d", 86_400.0)
YEAR = Pace("year", "yr", 31_557_600.0)
"""The Julian year."""
LONGEST = ((HOUR, 0.5 * HOUR.seconds), (DAY, 20.0 * DAY.seconds))
"""Units of time and the longest period, in seconds, that is told in them."""


def pace_of(hertz: float) -> Pace:
    """The unit of time of a motion by its frequency.

    >>> [pace_of(hertz).name for hertz in (7.3, 1 / 60, 1.5 / 86400, 1 / 31_557_600)]
    ['second', 'hour', 'day', 'year']
    """
    if not 0.0 < abs(hertz) < SLOW:
        return SECOND
    return next((pace for pace, longest in LONGEST if abs(hertz) * longest >= 1.0), YEAR)


def hertz_text(hertz: float, write: Callable[[float], str]) -> str:
    """A frequency in Hz, a slow one in its own unit too.

    >>> hertz_text(20.0, "{:g}".format), hertz_text(1.5 / 86400, "{:.6g}".format)
    ('20 Hz', '1.73611e-05 Hz (1.5 per day)')
    """
    pace = pace_of(hertz)
    return f"{write(hertz)} Hz" + ("" if pace is SECOND else f" ({write(hertz * pace.seconds)} per {pace.name})")


def in_pi(value: float, *, digits: int = 3) -> str:
    """An angle in units of π.

    >>> in_pi(0.6589 * math.pi)
    '0.659 π'
    """
    return f"{value / math.pi:.{digits}f} π"


def amplitude(value: float, unit: str) -> str:
    """An amplitude with its unit, an angle also in units of π.

    >>> amplitude(2.1, "rad"), amplitude(2.1, "")
    ('2.1 rad (0.668 π)', '2.1')
    """
    text = f"{value:.4g}"
    return f"{text} rad ({in_pi(value)})" if unit == "rad" else f"{text} {unit}".strip()


def size(value: float, unit: str) -> str:
    """A measured amplitude in its signal's unit.

    >>> size(0.87612, "mm"), size(2.0, "")
    ('0.876 mm', '2')
    """
    return f"{value:.3g} {unit_text(unit)}".strip()


def short_amplitude(value: float, unit: str) -> str:
    """An amplitude with its unit, an angle in units of π only.

    >>> short_amplitude(2.1, "rad"), short_amplitude(2.1, "mm")
    ('0.668 π', '2.1 mm')
    """
    return in_pi(value) if unit == "rad" else amplitude(value, unit)


def frequency(omega: float, time_unit: str) -> str:
    """Angular frequency as a reader meets it: hertz when time is in seconds, else rad per time unit.

    A slow one is told per hour, day or year too.

    >>> frequency(2 * math.pi, "s"), frequency(2.0, ""), frequency(2 * math.pi * 25e3, "s")
    ('1.0000 Hz', '2.0000', '25000 Hz')
    >>> frequency(2 * math.pi * 1.5 / 86400, "s")
    '1.7361 × 10⁻⁵ Hz (1.5000 per day)'
    """
    if time_unit != "s":
        return f"{_rounded(omega)} rad/{time_unit}" if time_unit else _rounded(omega)
    return hertz_text(omega / (2 * math.pi), _rounded)


def _rounded(value: float) -> str:
    """Four decimals, but five digits of a small value and seven of a large one."""
    return (
        f"{value:.4f}" if value == 0.0 or SLOW <= abs(value) < LARGE else number(value, 5 if abs(value) < SLOW else 7)
    )


def sampling_text(rate: float) -> str:
    """Samples per second, of a slow record per hour, day or year too.

    >>> sampling_text(250.0), sampling_text(20 / 86400)
    ('250 per second', '0.000231481 per second (20 per day)')
    """
    pace = pace_of(rate)
    return f"{rate:g} per second" + ("" if pace is SECOND else f" ({rate * pace.seconds:g} per {pace.name})")


def angular(*omega: float) -> str:
    """An angular frequency, or the ends of a band, as --band takes them, and in Hz.

    >>> angular(31.416), angular(31.4, 47.1)
    ('31.42 rad/s (5 Hz)', '31.4 to 47.1 rad/s (4.997 to 7.496 Hz)')
    """
    each = (" to ".join(f"{w / turn:.4g}" for w in omega) for turn in (1.0, 2.0 * math.pi))
    return "{} rad/s ({} Hz)".format(*each)


def symbol(name: str) -> str:
    r"""The name of a parameter or of an unknown as it is printed in text; LaTeX names lose their backslash.

    >>> symbol("mu"), symbol("alpha3"), symbol("c_1"), symbol(r"\theta"), symbol("x_{1}")
    ('μ', 'α₃', 'c₁', 'θ', 'x₁')
    """
    plain = re.sub(r"[\\{}]|_(?=\{?\d)", "", name)
    stem = plain.rstrip("0123456789")
    return _GREEK.get(stem, stem) + plain[len(stem) :].translate(_SUBSCRIPTS)


def unit_text(unit: str) -> str:
    """A unit as it is printed in text, its powers above the line.

    >>> unit_text("rad/(s u^2)"), unit_text("m/s^2"), unit_text("mm")
    ('rad/(s u²)', 'm/s²', 'mm')
    """
    return re.sub(r"\^(-?\d+)", lambda power: power[1].translate(_SUPERSCRIPTS), unit)


def about(seconds: float) -> str:
    """A measured time to one digit, as no two runs agree on a second one.

    >>> about(3.4e-9), about(0.0026), about(1.6), about(0.48), about(9.6e-4)
    ('3 ns', '3 ms', '2 s', '0.5 s', '1 ms')
    """
    rounded = float(f"{seconds:.1g}")
    size, unit = _unit_of(rounded)
    return f"{rounded / size:.1g} {unit}" if rounded < 10 * size else f"{rounded / size:.0f} {unit}"


def measured_time(seconds: float | None, scatter: float | None) -> str:
    """A measured time and its scatter from run to run, to one digit of that; to one digit where none is known.

    >>> measured_time(1.234e-8, 0.03), measured_time(0.252, 0.099), measured_time(2e-6, 0.0), measured_time(5e-4, 0.3)
    ('12.3 ± 0.4 ns', '0.25 ± 0.02 s', '2.00 ± 0.02 µs', '500 ± 200 µs')
    >>> measured_time(0.252, None), measured_time(None, None)
    ('0.3 s', '–')
    """
    if seconds is None:
        return NONE
    if scatter is None or math.isnan(scatter) or not seconds > 0.0:
        return about(seconds)
    size, unit = _unit_of(seconds)
    spread = float(f"{max(scatter, LEAST_SCATTER) * seconds / size:.1g}")
    places = -math.floor(math.log10(spread))
    value, digits = round(seconds / size, places), max(0, places)
    return f"{value:.{digits}f} ± {spread:.{digits}f} {unit}"


def _unit_of(seconds: float) -> tuple[float, str]:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= (0.1 if unit == "s" else 1.0) * size:
            return size, unit
    return 1e-9, "ns"
