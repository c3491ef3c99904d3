"""The time-frequency plane behind a track: the distribution that its method follows, near the oscillation."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import Measurement
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.polynomial_wigner import polynomial_wigner
from ridgeback.numeric.distributions.reassigned_spectrogram import reassigned_spectrogram, synchrosqueezed_spectrogram
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.distributions.wigner import pseudo_wigner, smoothed_pseudo_wigner, wigner
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.decimation import Samples, every
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.track import Track

WINDOW_CYCLES = 6.0
"""Length of a spectrogram's window for methods that follow no plane, in cycles."""
LOW, HIGH, TOP = 0.25, 3.5, 1.2
"""Rows from the first of these times the track's lowest frequency, to the second times its median or, if that is more,
the last times its highest."""
PER_CYCLE = 10.0
"""Samples of the fastest cycle that are kept of a record at a far higher rate."""
MOST_COLUMNS = 2000
Drawn = Callable[[Samples, float, Track], Distribution]


def of_spectrogram(samples: Samples, seconds: float, _track: Track) -> Distribution:
    """Every sample's column, or MOST_COLUMNS of a long record."""
    hop = max(1, samples.x.size // MOST_COLUMNS)
    return spectrogram(samples.x, samples.rate, window_seconds=seconds, hop=hop, start=samples.start)


def of_smoothed(samples: Samples, seconds: float, track: Track) -> Distribution:
    """Smoothed as for the track."""
    smoothing = track.used.smoothing_seconds or seconds / WINDOW_CYCLES
    x, rate, start = samples.x, samples.rate, samples.start
    return smoothed_pseudo_wigner(x, rate, lag_seconds=seconds, smoothing_seconds=smoothing, start=start)


def of_polynomial(samples: Samples, seconds: float, track: Track) -> Distribution:
    """Of the track's order."""
    order = track.used.order or 6
    return polynomial_wigner(samples.x, samples.rate, lag_seconds=seconds, order=order, start=samples.start)


PLANES: Mapping[str, Drawn] = MappingProxyType(
    {
        "wigner": lambda s, _seconds, _track: wigner(s.x, s.rate, start=s.start),
        "pseudo-wigner": lambda s, seconds, _: pseudo_wigner(s.x, s.rate, lag_seconds=seconds, start=s.start),
        "smoothed-pseudo-wigner": of_smoothed,
        "polynomial-wigner": of_polynomial,
        "reassigned-spectrogram": lambda s, seconds, _: reassigned_spectrogram(
            s.x, s.rate, window_seconds=seconds, start=s.start
        ),
        "synchrosqueezed": lambda s, seconds, _: synchrosqueezed_spectrogram(
            s.x, s.rate, window_seconds=seconds, start=s.start
        ),
    }
)


def plane_of(one: Measurement) -> Distribution:
    """The plane of a signal that its track's method follows; a spectrogram for methods that follow none.

    Parameters
    ----------
    one
        What was measured of the signal.

    Returns
    -------
    Distribution
        The rows near the track, and its harmonics up to the third.

    Raises
    ------
    InputError
        Without a track, and for a plane over the memory budget.

    Examples
    --------
    >>> from ridgeback.compare.recording.measurement import measure
    >>> t = np.arange(640) / 32.0
    >>> one = measure(Recording.from_arrays(np.exp(-0.05 * t) * np.cos(8.0 * t), 32.0))
    >>> plane = plane_of(one)
    >>> plane.name, bool(abs(plane.omega[plane.values[:, 320].argmax()] - 8.0) < 0.3)
    ('spectrogram', True)
    """
    track = one.track
    if track is None or not track.valid.any():
        raise InputError(f"{one.recording.label}: there is no track, whose plane could be drawn")
    omega = track.omega[track.valid]
    samples = thinned(one.recording, float(omega.max()))
    longest = 0.9 * (samples.x.size - 1) / samples.rate
    seconds = min(track.used.lag_seconds or WINDOW_CYCLES * TWO_PI / float(np.median(omega)), longest)
    whole = PLANES.get(track.method, of_spectrogram)(samples, seconds, track)
    top = max(HIGH * float(np.median(omega)), TOP * float(omega.max()))
    keep = (whole.omega >= LOW * float(omega.min())) & (whole.omega <= top)
    return replace(whole, values=whole.values[keep], omega=whole.omega[keep])


def thinned(recording: Recording, highest: float) -> Samples:
    """A recording's samples, fewer where its rate is far above a frequency."""
    samples = Samples(recording.values, recording.rate, float(recording.time[0]))
    factor = int(TWO_PI * recording.rate / (highest * PER_CYCLE))
    return samples if factor < 2 or samples.x.size <= MOST_COLUMNS else every(samples, factor)


def npz_of(plane: Distribution, track: Track) -> bytes:
    """A plane with its axes, and the track over it, as a NumPy archive without pickles."""
    stream = io.BytesIO()
    np.savez_compressed(
        stream,
        values=plane.values,
        omega_rad_s=plane.omega,
        frequency_hz=plane.frequency_hz,
        time_s=plane.time,
        name=np.array(plane.name),
        track_time_s=track.time,
        track_omega_rad_s=track.omega,
        track_valid=track.valid,
    )
    return stream.getvalue()
