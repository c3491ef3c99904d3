"""What a page shows of several recordings of one experiment: runs, channels, stretches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.numbers import number, uncertain
from ridgeback.common.quantities import size
from ridgeback.common.show.brief import Brief

if TYPE_CHECKING:
    from ridgeback.compare.identification.results import Identification
    from ridgeback.compare.recording.measurement import Measurement
    from ridgeback.compare.recording.measurements import Measurements
    from ridgeback.compare.recording.theory import TheoryBackbone


@dataclass(frozen=True, repr=False)
class Named(Brief):
    """What made one of the signals, or why that is not said."""

    label: str
    made: Identification | None
    why: str = ""


@dataclass(frozen=True, repr=False)
class Runs(Brief):
    """Several signals, measured, combined where they are of one channel, and named."""

    found: Measurements
    labels: tuple[str, ...]
    """What tells each measured signal from the others."""
    theory: TheoryBackbone | None
    """The named oscillator's backbone at the amplitudes of the combined or the first one."""
    named: tuple[Named, ...]

    @property
    def unit(self) -> str:
        """That of the channel whose backbone leads: the first combined one, else that of the first signal with one."""
        leading = [common.channel for common in self.found.combined[:1]]
        own = [one.recording for one in self.found.measured if one.backbone is not None]
        return next((r.units for r in own if not leading or r.channel in leading), "")


def facts(one: Measurement) -> Mapping[str, str]:
    """A signal's row of the table: what it is, and what was measured of it."""
    recording, curve = one.recording, one.backbone
    row = {
        "samples": str(recording.values.size),
        "rate, 1/s": number(recording.rate),
        "method": one.method.replace("-", " "),
    }
    if curve is None:
        return {
            **row,
            "largest amplitude": "",
            "ω₀ at the largest, Hz": "",
            "smallest amplitude": "",
            "ω₀ at the smallest, Hz": "",
            "damping ratio": "",
        }
    a, omega, sd = curve.curve_amplitude, curve.curve_omega / (2 * np.pi), curve.curve_omega_sd / (2 * np.pi)
    high, low = int(np.argmax(a)), int(np.argmin(a))
    ratio = float(np.median(-curve.curve_growth_rate / curve.curve_omega))
    return {
        **row,
        "largest amplitude": size(float(a[high]), recording.units),
        "ω₀ at the largest, Hz": uncertain(float(omega[high]), float(sd[high])),
        "smallest amplitude": size(float(a[low]), recording.units),
        "ω₀ at the smallest, Hz": uncertain(float(omega[low]), float(sd[low])),
        "damping ratio": number(ratio, 3),
    }
