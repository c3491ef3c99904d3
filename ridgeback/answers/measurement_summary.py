"""A recording's measurement in a few lines: frequency, amplitude, growth rate, damping ratio, and what was left out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ridgeback.compare.recording.measurement import Measurement
    from ridgeback.numeric.backbone.curve import Backbone
    from ridgeback.numeric.tracking.track import Track

MOST_ROWS = 30
"""Rows of a table that a terminal is given."""
SLOW = 0.05
"""Frequencies below which cycles are counted per day."""
DAY = 86_400.0


def summary(one: Measurement) -> list[str]:
    """The lines above the table."""
    lines = [] if one.track is None or not one.track.valid.any() else track_lines(one.track)
    if one.backbone is not None:
        lines += backbone_lines(one.backbone)
    return lines


def track_lines(track: Track) -> list[str]:
    """Frequency from the first valid time to the last, and the share of the samples for which it is claimed."""
    inside = track.inside()
    ends, share = (0, -1), float(track.valid.mean())
    interval, f = inside.interval, inside.frequency_hz
    at = [f"{frequency(float(f[i]))} at t = {inside.time[i]:.6g}" for i in ends]
    lines = [f"frequency: {' to '.join(at)}"]
    if interval is not None:
        reach = [f"[{interval.low[i] / (2 * np.pi):.6g}, {interval.high[i] / (2 * np.pi):.6g}]" for i in ends]
        lines[0] += f"; 95 % intervals {' and '.join(reach)} Hz"
    elif track.no_interval:
        lines.insert(0, f"no interval: {track.no_interval}")
    if share < 1.0:
        lines.append(f"left out: {100 * (1 - share):.3g} % of the times, where the estimate is not valid")
    return lines


def frequency(hertz: float) -> str:
    """A frequency for reading.

    >>> frequency(20.0), frequency(1.5 / 86400)
    ('20 Hz', '1.73611e-05 Hz (1.5 per day)')
    """
    return f"{hertz:.6g} Hz" if hertz >= SLOW else f"{hertz:.6g} Hz ({hertz * DAY:.6g} per day)"


def backbone_lines(curve: Backbone) -> list[str]:
    """Amplitude, growth rate and damping ratio from the largest amplitude to the smallest, with one sigma."""
    top, bottom = int(np.argmax(curve.curve_amplitude)), int(np.argmin(curve.curve_amplitude))
    unit = f" {curve.units}" if curve.units else ""
    ratio = -curve.curve_growth_rate / curve.curve_omega
    rate, sd = curve.curve_growth_rate, curve.curve_growth_rate_sd
    slow = float(curve.curve_omega[top]) < 2 * np.pi * SLOW
    per_day = [f"{DAY * rate[i]:.5g} +- {DAY * sd[i]:.2g}" for i in (top, bottom)]
    return [
        f"amplitude: {curve.curve_amplitude[top]:.6g} to {curve.curve_amplitude[bottom]:.6g}{unit}",
        "growth rate a'/a: "
        + " to ".join(f"{rate[i]:.5g} +- {sd[i]:.2g} 1/s" for i in (top, bottom))
        + (f" ({' to '.join(per_day)} per day)" if slow else ""),
        "damping ratio: " + " to ".join(f"{ratio[i]:.4g} +- {sd[i] / curve.curve_omega[i]:.2g}" for i in (top, bottom)),
    ]


def thinned(count: int) -> list[int]:
    """The rows that are shown of so many: all, or MOST_ROWS evenly spread.

    >>> thinned(3), len(thinned(1000)), thinned(1000)[-1]
    ([0, 1, 2], 30, 999)
    """
    if count <= MOST_ROWS:
        return list(range(count))
    return [int(i) for i in np.linspace(0, count - 1, MOST_ROWS).round()]
