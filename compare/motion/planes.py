"""Time-frequency planes for display: level in dB re the maximum, cut to the band that holds the harmonics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.compare.motion.results import Curve, Image
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.distributions.wigner import wigner

COLUMNS = 320
"""Columns kept: what a figure of about 800 pixels can show."""
FLOOR_DB = -70.0
WIGNER_FLOOR_DB = -35.0
"""Below this the interference of the whole record covers the plane."""
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
    unit: str = "",
) -> Image:
    """Spectrogram of ``x`` with a window of a few periods, up to the angular frequency ``top``; ``unit`` is of time."""
    seconds = min(WINDOW_CYCLES * period, 0.5 * x.size / rate)
    plane = spectrogram(x, rate, window_seconds=seconds, hop=max(1, x.size // COLUMNS), start=start)
    first, last = start + seconds / 2, start + (x.size - 1) / rate - seconds / 2
    whole = columns(plane, (plane.time >= first) & (plane.time <= last))
    note = (
        f"Hann window of {seconds:.3g} {unit or 'time units'}; {rate:g} samples per {unit or 'time unit'}.  Shown from "
        "half a window inside "
        "the record: nearer its ends the window would see past them."
    )
    return image(whole, top=top, name=name, overlays=overlays, note=note)


def columns(plane: Distribution, keep: Mask) -> Distribution:
    """The plane at some of its times."""
    return replace(plane, values=plane.values[:, keep], time=plane.time[keep])


def wigner_image(
    x: Array, rate: float, *, top: float, name: str, overlays: tuple[Curve, ...] = (), note: str = ""
) -> Image:
    """Size of the full-length Wigner distribution of the analytic signal of ``x``.

    The interference between distant times oscillates faster than a figure has columns; picking columns would alias it
    into patterns that are not there, so each column shown is the rms over its block.
    """
    plane = wigner(x, rate)
    step = max(1, plane.time.size // COLUMNS)
    count = plane.time.size // step
    blocks = plane.size()[:, : count * step].reshape(plane.omega.size, count, step)
    size = np.sqrt(np.mean(blocks**2, axis=2))
    middle = plane.time[: count * step].reshape(count, step).mean(axis=1)
    thin = replace(plane, values=size, time=middle)
    told = f"{note}  Each column is the rms over {step} samples.".strip()
    return image(thin, top=top, name=name, overlays=overlays, note=told, floor_db=WIGNER_FLOOR_DB)


def image(
    plane: Distribution, *, top: float, name: str, overlays: tuple[Curve, ...], note: str, floor_db: float = FLOOR_DB
) -> Image:
    """Level of a plane up to the angular frequency ``top``, clipped at the floor."""
    keep = plane.omega <= top
    values = plane.size()[keep]
    floor = 10 ** (floor_db / 10) * float(values.max())
    level = 10 * np.log10(np.maximum(values, floor) / values.max())
    level.flags.writeable = False
    return Image(name, plane.time, plane.omega[keep], level, floor_db, overlays, note)
