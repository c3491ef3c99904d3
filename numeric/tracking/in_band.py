"""A track in the band that was asked for: no value outside of it is valid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.components.beyond import nothing_in
from ridgeback.numeric.tracking.track import Track


def in_its_band(track: Track, band: tuple[float, float] | None) -> Track:
    """The track, valid only in the band that was asked for; refused where most of it is beyond.

    >>> track = Track(np.arange(3.0), np.array([5.0, 6.0, 9.0]), np.ones(3, bool), "example")
    >>> in_its_band(track, (4.0, 8.0)).valid.tolist()
    [True, True, False]
    >>> in_its_band(track, (8.0, 12.0))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: example: the band 8 to 12 rad/s (1.273 to 1.91 Hz) holds no ...
    """
    if band is None:
        return track
    inside = (track.omega >= band[0]) & (track.omega <= band[1])
    if 2 * np.count_nonzero(track.valid & inside) < np.count_nonzero(track.valid):
        beyond = float(np.median(track.omega[track.valid & ~inside]))
        raise InputError(f"{track.method}: {nothing_in(band, beyond)}")
    return replace(track, valid=track.valid & inside)
