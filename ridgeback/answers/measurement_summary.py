"""A recording's measurement in a few lines: frequency, amplitude, growth rate, damping ratio, and what was left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ridgeback.common.quantities import SECOND, Pace, hertz_text, pace_of
from ridgeback.numeric.backbone.damping import damping, with_deviation
from ridgeback.numeric.tracking.track import NORMAL_95

if TYPE_CHECKING:
    from ridgeback.compare.recording.measurement import Measurement
    from ridgeback.numeric.arrays import Array
    from ridgeback.numeric.backbone.curve import Backbone
    from ridgeback.numeric.tracking.track import Track

MOST_ROWS = 30
"""Rows of a table that a terminal is given."""
FEWEST, MOST = 6, 13
"""Digits of a value that is known ever so sharply."""
ROUGH = 1e-3
"""Share of a value below which the width of a range whose error is not known does not count."""
SMALL, SHARP = 1e-4, 1e-6
"""Values below which a power of ten is written; deviations, over values above one, below which they have one."""


def summary(one: Measurement) -> list[str]:
    """The lines above the table."""
    lines = [] if one.track is None or not one.track.valid.any() else track_lines(one.track)
    if one.track is None and one.found.no_interval:
        lines = [f"no interval: {one.found.no_interval}"]
    if one.backbone is not None:
        lines += backbone_lines(one.backbone)
    return lines


def track_lines(track: Track) -> list[str]:
    """Frequency from the first valid time to the last, and the share of the samples for which it is claimed.

    Where there are intervals it is their middle, the estimate less its bias; where none can be claimed the range of
    most values.
    """
    inside = track.inside()
    ends, share = (0, -1), float(track.valid.mean())
    interval = inside.interval
    f = inside.frequency_hz if interval is None else (interval.low + interval.high) / (4 * np.pi)
    pace = pace_of(float(np.median(f)))
    at = [f"{hertz_text(float(f[i]), six_digits)} at t = {moment(float(inside.time[i]), pace)}" for i in ends]
    lines = [f"frequency: {' to '.join(at)}"]
    if interval is not None:
        turn = 2 * np.pi / pace.seconds
        reach = [between(float(interval.low[i]) / turn, float(interval.high[i]) / turn) for i in ends]
        lines[0] += f"; 95 % intervals {' and '.join(reach)} {per(pace)}"
    elif track.no_interval:
        lines = [f"no interval: {track.no_interval}", f"frequency: {most_of(inside.frequency_hz)}"]
    if share < 1.0:
        lines.append(f"left out: {100 * (1 - share):.3g} % of the times, where the estimate is not valid")
    return lines


def six_digits(value: float) -> str:
    """A number to six digits.

    >>> six_digits(20.0), six_digits(1.5 / 86400)
    ('20', '1.73611e-05')
    """
    return f"{value:.6g}"


def moment(seconds: float, pace: Pace) -> str:
    """A time; of a slow motion in its own unit, which is said.

    >>> moment(7.996, SECOND), moment(129600.0, pace_of(1.5 / 86400))
    ('7.996', '1.5 d')
    """
    return six_digits(seconds) if pace is SECOND else f"{six_digits(seconds / pace.seconds)} {pace.sign}"


def per(pace: Pace) -> str:
    """The unit of a frequency.

    >>> per(SECOND), per(pace_of(1.5 / 86400))
    ('Hz', 'per day')
    """
    return "Hz" if pace is SECOND else f"per {pace.name}"


def most_of(values: Array) -> str:
    """The range of nine tenths of values whose error is not known, to the second digit of its width, four at most.

    >>> most_of(np.linspace(4.8, 5.28, 101)), most_of(np.full(9, 2.0400001))
    ('4.82 to 5.26 Hz (nine tenths of the values; no error is claimed)', '2.04 Hz (no error is claimed)')
    >>> most_of(np.full(9, 1.5 / 86400))
    '1.5 per day (no error is claimed)'
    """
    pace = pace_of(float(np.median(values)))
    low, high = (pace.seconds * float(end) for end in np.quantile(values, (0.05, 0.95)))
    wide = max(high - low, ROUGH * high)
    digits = int(np.clip(np.floor(np.log10(high)) - np.floor(np.log10(wide)) + 2, 2, 4))
    ends = [f"{end:.{digits}g}" for end in (low, high)]
    if ends[0] == ends[1]:
        return f"{ends[0]} {per(pace)} (no error is claimed)"
    return f"{ends[0]} to {ends[1]} {per(pace)} (nine tenths of the values; no error is claimed)"


def between(low: float, high: float) -> str:
    """An interval, its ends to the second digit of its width, to six digits at least.

    >>> between(19.99903, 20.00121), between(1.9999999962, 2.0000000031)
    ('[19.999, 20.0012]', '[1.9999999962, 2.0000000031]')
    """
    digits = digits_to(max(abs(low), abs(high)), high - low)
    return f"[{low:.{digits}g}, {high:.{digits}g}]"


def digits_to(value: float, deviation: float) -> int:
    """Significant digits of a value to the second of its deviation: FEWEST at least, MOST at most.

    >>> digits_to(2.0, 3e-9), digits_to(2.0, 0.3), digits_to(2.0, 0.0)
    (11, 6, 13)
    """
    if not (0.0 < deviation < np.inf and value):
        return MOST
    return min(MOST, max(FEWEST, int(np.floor(np.log10(abs(value)))) - int(np.floor(np.log10(deviation))) + 2))


def backbone_lines(curve: Backbone) -> list[str]:
    """Amplitude, growth rate and damping ratio from the largest amplitude to the smallest, with one sigma."""
    top, bottom = int(np.argmax(curve.curve_amplitude)), int(np.argmin(curve.curve_amplitude))
    unit = f" {curve.units}" if curve.units else ""
    ratio = damping(curve.curve_growth_rate, curve.curve_growth_rate_sd, curve.curve_omega, curve.curve_omega_sd)
    pace = pace_of(float(curve.curve_omega[top]) / (2 * np.pi))

    def both(values: Array, deviations: Array) -> str:
        return " to ".join(uncertain(float(values[i]), float(deviations[i])) for i in (top, bottom))

    rate, rate_sd, own = curve.curve_growth_rate, curve.curve_growth_rate_sd, pace.seconds
    return [
        f"amplitude: {both(curve.curve_amplitude, curve.curve_amplitude_sd)}{unit}",
        f"growth rate a'/a: {both(rate, rate_sd)} 1/s"
        + ("" if pace is SECOND else f" ({both(own * rate, own * rate_sd)} per {pace.name})"),
        f"damping ratio: {both(ratio.ratio, ratio.ratio_sd)}",
    ]


def uncertain(value: float, deviation: float) -> str:
    """A value to the second digit of its deviation, to the first of a sharp one; a small one by a power of ten.

    >>> uncertain(3.14159, 0.0123), uncertain(-5.7792e-7, 5.4e-10), uncertain(1.0, float("nan"))
    ('3.142 +- 0.012', '(-5.7792 +- 0.0054)e-07', '1 +- nan')
    >>> uncertain(3.14159265, 2e-9)
    '3.141592650 +- 2e-09'
    >>> uncertain(0.00477464, 1.6e-8), uncertain(3e-5, 4.8e-4), uncertain(-2e-6, 3.4e-5)
    ('0.00477464 +- 2e-08', '0.00003 +- 0.00048', '(-0.2 +- 3.4)e-05')
    """
    size = abs(value)
    if 0.0 < deviation < SHARP * (1.0 if SMALL < size < 1.0 else size):
        return f"{value:#.{digits_to(value, deviation) - 1}g} +- {deviation:.0e}"
    larger = max(size, deviation)
    if not (np.isfinite(deviation) and deviation > 0.0 and 0.0 < larger < SMALL):
        return with_deviation(value, deviation)
    power = int(np.floor(np.log10(larger)))
    return f"({with_deviation(value / 10.0**power, deviation / 10.0**power)})e{power:+03d}"


def pace_of_rows(rows: Sequence[Mapping[str, Any]]) -> Pace:
    """The unit of time of rows, by the median of their frequencies.

    >>> pace_of_rows([{"frequency_hz": 1.5 / 86400}, {"frequency_hz": None}]).name, pace_of_rows([]).name
    ('day', 'second')
    """
    known = [float(row["frequency_hz"]) for row in rows if row.get("frequency_hz") is not None]
    return pace_of(float(np.median(known))) if known else SECOND


def briefly(row: Mapping[str, Any], pace: Pace = SECOND) -> dict[str, Any]:
    """A row for the eye: each value with its deviation, frequencies in Hz, what follows from them left out.

    Times and rates of a slow motion are in its own unit of time.

    >>> briefly({"time_s": 0.5, "frequency_hz": 1.25, "standard_deviation_rad_s": 0.02, "valid": True})
    {'time, s': 0.5, 'frequency, Hz': 1.25, 'valid': True}
    >>> briefly({"amplitude": 2.0, "amplitude_standard_deviation": 0.05})
    {'amplitude': '2.000 +- 0.050'}
    >>> briefly({"time_s": 86400.0, "growth_rate_per_s": -2e-6}, pace_of(1.5 / 86400))
    {'time, d': 1.0, "a'/a, 1/d": -0.1728}
    """
    own, sign = pace.seconds, pace.sign
    found: dict[str, Any] = {f"time, {sign}": row["time_s"] / own} if "time_s" in row else {}
    hertz, growth = "frequency, Hz" if pace is SECOND else f"frequency, 1/{sign}", f"a'/a, 1/{sign}"
    for title, unit, value, deviation in (
        ("amplitude", 1.0, row.get("amplitude"), row.get("amplitude_standard_deviation")),
        (hertz, own, *hertz_of(row)),
        (growth, own, row.get("growth_rate_per_s"), row.get("growth_rate_standard_deviation_per_s")),
        ("damping ratio", 1.0, row.get("damping_ratio"), row.get("damping_ratio_standard_deviation")),
    ):
        if value is not None:
            known = np.isfinite([value, np.nan if deviation is None else deviation]).all()
            rough = float(f"{unit * float(value):.4g}")
            found[title] = uncertain(unit * float(value), unit * float(deviation or 0.0)) if known else rough
    return found | ({"valid": row["valid"]} if "valid" in row else {})


def hertz_of(row: Mapping[str, Any]) -> tuple[float | None, float | None]:
    """A row's frequency in Hz and one sigma of it: by its interval, which lies about the estimate less its bias.

    A row of a track without an interval claims none; one of a backbone has but its deviation.

    >>> row = {"frequency_hz": 1.3, "low_95_rad_s": 2 * np.pi * 1.0, "high_95_rad_s": 2 * np.pi * 1.4}
    >>> [round(value, 6) for value in hertz_of(row)], hertz_of({"frequency_hz": 1.3})
    ([1.2, 0.102043], (1.3, None))
    """
    if row.get("low_95_rad_s") is not None:
        low, high = (float(row[end]) / (2.0 * np.pi) for end in ("low_95_rad_s", "high_95_rad_s"))
        return 0.5 * (low + high), (high - low) / (2.0 * NORMAL_95)
    known = row.get("omega_standard_deviation_rad_s")
    return row.get("frequency_hz"), None if known is None else float(known) / (2.0 * np.pi)


def thinned(count: int) -> list[int]:
    """The rows that are shown of so many: all, or MOST_ROWS evenly spread.

    >>> thinned(3), len(thinned(1000)), thinned(1000)[-1]
    ([0, 1, 2], 30, 999)
    """
    if count <= MOST_ROWS:
        return list(range(count))
    return [int(i) for i in np.linspace(0, count - 1, MOST_ROWS).round()]
