"""One time-frequency plane with the track over it, as a PNG."""

from __future__ import annotations

import io

import numpy as np
from matplotlib.figure import Figure

from ridgeback.common.show.picture import Picture, Plane
from ridgeback.common.visible import visible
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.tracking.track import Track
from ridgeback.reports.drawing.theme import SERIES, TOKENS
from ridgeback.reports.pictures import draw

MOST = 1500
"""Columns and rows that are drawn."""


def plane_png(plane: Distribution, track: Track, title: str) -> bytes:
    """Draw a plane in decibels with the valid values of a track.

    Parameters
    ----------
    plane
        Levels over time and frequency.
    track
        Frequency over time.
    title
        Stands above it.

    Returns
    -------
    bytes
        A PNG; the same plane gives the same bytes.
    """
    rows, columns = (slice(None, None, -(-size // MOST)) for size in plane.values.shape)
    levels = Plane(plane.time[columns], plane.frequency_hz[rows], np.abs(plane.values[rows, columns]), plane.name)
    figure = Figure(figsize=(9.6, 5.4), layout="constrained")
    axes = draw(Picture(visible(title), "time, s", "frequency, Hz", plane=levels), figure.subplots())
    omega = np.where(track.valid, track.frequency_hz, np.nan)
    axes.plot(track.time, omega, color=TOKENS[SERIES[1]][0], linewidth=1.2, label=track.method)
    axes.legend(loc="upper left")
    axes.set_ylim(float(plane.frequency_hz[0]), float(plane.frequency_hz[-1]))
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=120, metadata={"Software": None})
    return stream.getvalue()
