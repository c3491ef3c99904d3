"""Slow motions in hours, days or years: what was measured in seconds, told in the unit in which it has few digits."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.quantities import pace_of
from ridgeback.numeric.arrays import Array
from ridgeback.reports.figures.clock import TAU, Clock

if TYPE_CHECKING:
    from ridgeback.compare.identification.results import Candidate, Identification, Prediction
    from ridgeback.compare.identification.sample_fit import SampleFit
    from ridgeback.compare.motion.results import Curve, Image
    from ridgeback.compare.recording.results import RecordingComparison


def clock_of(found: RecordingComparison) -> Clock:
    """The clock of a recording, by its chosen track."""
    chosen = next((curve for curve in found.curves if curve.name == found.chosen), found.curves[0])
    return clock_at(chosen.omega[chosen.valid])


def clock_at(omega: Array) -> Clock:
    """The clock of a motion of angular frequencies, rad/s."""
    pace = pace_of(float(np.median(omega)) / TAU if omega.size else 0.0)
    return Clock(pace.sign, pace.seconds)


def recording_in(found: RecordingComparison, clock: Clock) -> RecordingComparison:
    """The same with times in the clock's unit, angular frequencies and rates in rad and 1 per it."""
    s, over = clock.seconds, found.over
    return replace(
        found,
        rate=found.rate * s,
        time=found.time / s,
        curves=tuple(_curve(curve, s) for curve in found.curves),
        theory=tuple(_curve(curve, s) for curve in found.theory),
        spectrogram=_image(found.spectrogram, s),
        amplitude_time=found.amplitude_time / s,
        backbone_omega=found.backbone_omega * s,
        backbone_omega_sd=found.backbone_omega_sd * s,
        growth_rate=found.growth_rate * s,
        growth_rate_sd=found.growth_rate_sd * s,
        over=None if over is None else replace(over, omega=over.omega * s),
    )


def identification_in(made: Identification, clock: Clock) -> Identification:
    """The same of what made it; parameters keep the units that they name."""
    s, data = clock.seconds, made.data
    return replace(
        made,
        data=replace(
            data,
            omega=data.omega * s,
            omega_sd=data.omega_sd * s,
            growth_rate=data.growth_rate * s,
            growth_rate_sd=data.growth_rate_sd * s,
        ),
        candidates=tuple(_candidate(one, s) for one in made.candidates),
        prediction=None if made.prediction is None else _prediction(made.prediction, s),
        fitted=None if made.fitted is None else fit_in(made.fitted, s),
    )


def fit_in(found: SampleFit, seconds: float) -> SampleFit:
    """Samples and fit over times in a unit of so many seconds."""
    return replace(
        found,
        time=found.time / seconds,
        omega=found.omega * seconds,
        fundamental=found.fundamental * seconds,
        line=None if found.line is None else found.line * seconds,
    )


def _curve(curve: Curve, s: float) -> Curve:
    deviation, bias = (None if part is None else part * s for part in (curve.standard_deviation, curve.bias))
    return replace(curve, time=curve.time / s, omega=curve.omega * s, standard_deviation=deviation, bias=bias)


def _image(image: Image, s: float) -> Image:
    overlays = tuple(_curve(curve, s) for curve in image.overlays)
    return replace(image, time=image.time / s, omega=image.omega * s, overlays=overlays)


def _candidate(one: Candidate, s: float) -> Candidate:
    return replace(
        one,
        omega=one.omega * s,
        omega_low=one.omega_low * s,
        omega_high=one.omega_high * s,
        growth_rate=one.growth_rate * s,
        growth_rate_low=one.growth_rate_low * s,
        growth_rate_high=one.growth_rate_high * s,
    )


def _prediction(made: Prediction, s: float) -> Prediction:
    return replace(
        made,
        until=made.until / s,
        time=made.time / s,
        omega=made.omega * s,
        omega_low=made.omega_low * s,
        omega_high=made.omega_high * s,
        measured_omega=made.measured_omega * s,
        measured_omega_sd=made.measured_omega_sd * s,
    )
