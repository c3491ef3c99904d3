"""Time-frequency planes for display: level in dB re the maximum, cut to the band that holds the harmonics."""

from __future__ import annotations

import numpy as np

from compare.results import Array, Curve, Image
from numeric.distribution import Distribution
from numeric.spectrogram import spectrogram
from numeric.wigner import wigner

COLUMNS = 320
"""Columns kept: what a figure of about 800 pixels can show."""
FLOOR_DB = -70.0
WINDOW_CYCLES = 4.0
"""Spectrogram window in cycles of the slowest fundamental: parts the harmonics and still follows them."""


def spectrogram_image(
    x: Array,
    rate: float,
    *,
    period: float,
    top: float,
    name: str,
    overlays: tuple[Curve, ...] = (),
    start: float = 0.0,
) -> Image:
    """Spectrogram of ``x`` with a window of a few periods, up to the angular frequency ``top``."""
    seconds = min(WINDOW_CYCLES * period, 0.5 * x.size / rate)
    plane = spectrogram(x, rate, window_seconds=seconds, hop=max(1, x.size // COLUMNS), start=start)
    note = f"Hann window of {seconds:.3g} time units; {rate:g} samples per time unit."
    return image(plane, top=top, name=name, overlays=overlays, note=note)


def wigner_image(
    x: Array, rate: float, *, top: float, name: str, overlays: tuple[Curve, ...] = (), note: str = ""
) -> Image:
    """Full-length Wigner distribution of the analytic signal of ``x``; negative values fall below the floor."""
    plane = wigner(x, rate)
    step = max(1, plane.time.size // COLUMNS)
    thin = Distribution(plane.values[:, ::step], plane.omega, plane.time[::step], plane.name, plane.settings)
    return image(thin, top=top, name=name, overlays=overlays, note=note)


def image(plane: Distribution, *, top: float, name: str, overlays: tuple[Curve, ...], note: str) -> Image:
    """Level of a plane up to the angular frequency ``top``, clipped at the floor."""
    keep = plane.omega <= top
    values = plane.values[keep]
    floor = 10 ** (FLOOR_DB / 10) * float(values.max())
    level = 10 * np.log10(np.maximum(values, floor) / values.max())
    level.flags.writeable = False
    return Image(name, plane.time, plane.omega[keep], level, FLOOR_DB, overlays, note)
