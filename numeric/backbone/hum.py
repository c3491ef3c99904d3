"""Mains hum: an oscillation of constant amplitude at a multiple of 50 or 60 Hz is no decay of any oscillator."""

from __future__ import annotations

import numpy as np

from ridgeback.numeric.backbone.curve import Backbone
from ridgeback.numeric.components.tones import Tone

STEADY = 0.05
"""Relative change of the amplitude over a record of a tone that is called steady."""
LEAST_FALL, TOLD = 0.01, 3.0
"""A fall over the record by less than this share, or by less than this many of its deviations, is none."""


def hum_of(curve: Backbone) -> Tone | None:
    """The steady tone of the mains that an oscillation is; None for a decay, and at any other frequency.

    Parameters
    ----------
    curve
        Amplitude and frequency of the oscillation over time, in seconds.

    Examples
    --------
    >>> from ridgeback.numeric.backbone.backbone import backbone
    >>> from ridgeback.numeric.estimators.estimate import estimate
    >>> t = np.arange(1000) / 1000.0
    >>> def hum(x):
    ...     return hum_of(backbone(estimate(x, 1000.0, method="pseudo-wigner", bias=False), x, 1000.0))
    >>> hum(2.0 * np.cos(314.0 * t)).said()
    'a steady tone at 49.9747 Hz (mains hum), amplitude 2'
    >>> hum(np.cos(300.0 * t)) is None, hum(np.exp(-0.1 * t) * np.cos(314.0 * t)) is None
    (True, True)
    """
    a, sd = curve.amplitude, curve.amplitude_sd
    fall, deviation = float(a[0] - a[-1]), float(np.hypot(sd[0], sd[-1]))
    decays = fall > max(LEAST_FALL * float(a[0]), TOLD * deviation)
    tone = Tone(float(np.median(curve.omega)), 0.0, complex(float(a.max())))
    steady = not decays and float(np.ptp(a)) < STEADY * float(a.max())
    return tone if steady and tone.mains else None
