"""Time-frequency planes for display: level in dB re the maximum, cut to the band that holds the harmonics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.common.numbers import number
from ridgeback.common.quantities import Pace, pace_of
from ridgeback.compare.motion.results import Curve, Image, SignedPlane
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.distributions.wigner import wigner

COLUMNS = 320
"""Columns kept: what a figure of about 800 pixels can show."""
SIGNED_COLUMNS = 480
FLOOR_DB = -70.0
KNEE = 0.035
"""Share of the maximum at which the arcsinh scale of a signed plane turns from linear to logarithmic: fringes, cross
term and ridge are then told apart."""
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
    floor_db: float = FLOOR_DB,
) -> Image:
    """Spectrogram of ``x`` with a window of a few periods, up to the angular frequency ``top``; ``unit`` is of time."""
    seconds = min(WINDOW_CYCLES * period, 0.5 * x.size / rate)
    plane = spectrogram(x, rate, window_seconds=seconds, hop=max(1, x.size // COLUMNS), start=start)
    first, last = start + seconds / 2, start + (x.size - 1) / rate - seconds / 2
    whole = columns(plane, (plane.time >= first) & (plane.time <= last))
    pace = pace_of(1.0 / period) if unit == "s" else Pace(unit or "time unit", unit, 1.0)
    length = f"{seconds / pace.seconds:.3g} {pace.sign or 'time units'}"
    note = (
        f"Hann window of {length}; {number(rate * pace.seconds)} samples per {pace.name}.  Shown from "
        "half a window inside the record: nearer its ends the window would see past them."
    )
    return image(whole, top=top, name=name, overlays=overlays, note=note, floor_db=floor_db)


def columns(plane: Distribution, keep: Mask) -> Distribution:
    """The plane at some of its times."""
    return replace(plane, values=plane.values[:, keep], time=plane.time[keep])


def wigner_plane(
    x: Array, rate: float, *, top: float, name: str, overlays: tuple[Curve, ...] = (), note: str = ""
) -> SignedPlane:
    """Full-length Wigner distribution of the analytic signal of ``x``, signed, on an arcsinh scale.

    The interference between distant times oscillates faster than a figure has columns; picking columns would alias it
    into patterns that are not there, so each column shown is the mean over its block, in which it cancels.
    """
    plane = wigner(x, rate)
    step = max(1, plane.time.size // SIGNED_COLUMNS)
    count = plane.time.size // step
    keep = plane.omega <= top
    blocks = np.real(plane.values)[keep, : count * step].reshape(int(keep.sum()), count, step)
    middle = plane.time[: count * step].reshape(count, step).mean(axis=1)
    values = np.mean(blocks, axis=2)
    share = values / np.abs(values).max()
    scaled = np.arcsinh(share / KNEE) / np.arcsinh(1.0 / KNEE)
    scaled.flags.writeable = False
    told = f"{note}  Each column is the mean over {step} samples.".strip() if step > 1 else note
    return SignedPlane(name, middle, plane.omega[keep], scaled, KNEE, overlays, told)


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
