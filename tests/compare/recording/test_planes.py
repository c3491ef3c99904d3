"""The plane behind a track: what its method follows, near the oscillation, in a file that NumPy and anybody reads."""

from __future__ import annotations

import io

import numpy as np
import pytest

from ridgeback.compare.recording.measurement import measure
from ridgeback.compare.recording.planes import npz_of, plane_of
from ridgeback.numeric.estimators.estimate import METHODS
from ridgeback.numeric.recording.recording import Recording
from ridgeback.reports.plane_file import plane_png

T = np.arange(480) / 24.0
RECORDING = Recording.from_arrays(np.exp(-0.02 * T) * np.cos(2 * np.pi * (1.5 * T + 0.03 * T**2)), 24.0, name="u")


@pytest.mark.parametrize("method", METHODS)
def test_the_ridge_of_the_plane_is_the_track(method: str) -> None:
    one = measure(RECORDING, method=method, bias=False)
    plane = plane_of(one)
    assert plane.name == (method if "wigner" in method else plane.name)
    middle = (plane.time > 6.0) & (plane.time < 14.0)
    ridge = plane.omega[plane.values[:, middle].argmax(axis=0)]
    assert np.median(np.abs(ridge / (2 * np.pi * (1.5 + 0.06 * plane.time[middle])) - 1.0)) < 0.03


def test_an_archive_holds_plane_axes_and_track() -> None:
    one = measure(RECORDING, bias=False)
    assert one.track is not None
    with np.load(io.BytesIO(npz_of(plane_of(one), one.track)), allow_pickle=False) as held:
        assert held["values"].shape == (held["omega_rad_s"].size, held["time_s"].size)
        assert np.array_equal(held["track_omega_rad_s"], one.track.omega)
        assert str(held["name"]) == "spectrogram"
    assert plane_png(plane_of(one), one.track, "u").startswith(b"\x89PNG")
