"""What a comparison of a recording hands over.

Angular frequency is in rad per time unit throughout; times are in the oscillator's own unit (s for a recording).
Arrays are one-dimensional float64 and read-only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.show.brief import Brief
from ridgeback.compare.motion.results import Curve, Image
from ridgeback.compare.recording.theory import TheoryBackbone
from ridgeback.compare.study.results import Formula
from ridgeback.numeric.arrays import Array


@dataclass(frozen=True, repr=False)
class RecordingComparison(Brief):
    """A user's recording: its tracks, backbone and growth rate, with bands."""

    source: str
    sha256: str
    column: str
    rate: float
    time: Array
    signal: Array
    curves: tuple[Curve, ...]
    chosen: str
    """Name of the curve the backbone is made from, and why in ``notes``."""
    spectrogram: Image
    amplitude_time: Array
    amplitude: Array
    backbone_amplitude: Array
    backbone_omega: Array
    backbone_omega_sd: Array
    growth_rate: Array
    """a'/a at the amplitudes of the backbone, per time unit; negative in a decay."""
    growth_rate_sd: Array
    fit: Formula | None
    notes: tuple[str, ...]
    theory: tuple[Curve, ...] = ()
    over: TheoryBackbone | None = None
    """The named oscillator's backbone over the measured one."""
    remarks: tuple[str, ...] = ()
    """What of the record is no part of the oscillation that is measured: other tones, times, clipped samples."""
    doubt: str = ""
    """Why no deviation is claimed, if so: those of backbone and growth rate are NaN then."""
    unit: str = ""
    """Of the signal and of its amplitudes."""
    hum: str = ""
    """The steady tone of the mains that the strongest component is, if so."""

    @property
    def damping_ratio(self) -> Array:
        """-a'/(a omega0) at the amplitudes of the backbone."""
        return np.asarray(-self.growth_rate / self.backbone_omega)
