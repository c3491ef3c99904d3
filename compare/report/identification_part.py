"""What a report says of what made a recording: the ranking, and the rest of the decay predicted from its first part."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, within
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.prediction import predict
from ridgeback.compare.identification.preparation import Prepared, prepared
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.identification.shown import Standing
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.numeric.recording.recording import Recording

SHARE = 1.0 / 3.0
"""Part of the cycles that predicts the rest unless the caller says how many."""


@dataclass(frozen=True)
class IdentificationPart:
    """Which oscillator made a recording, or why that is not said."""

    found: Identification | None
    left_out: str = ""
    """A sentence; empty when there is an identification."""


def identification_part(
    recording: Recording,
    compared: RecordingComparison,
    cycles: float | None,
    progress: Progress,
    *,
    band: tuple[float, float] | None = None,
) -> IdentificationPart:
    """The identification, with its prediction where there are cycles enough.

    Parameters
    ----------
    recording
        The recording that is reported on.
    compared
        What was measured of it; its chosen track counts the cycles.
    cycles
        How many of the first cycles predict the rest; None for a third of them.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
    """
    used = SHARE * cycles_of(compared) if cycles is None else cycles
    try:
        ready = prepared(recording, band=band)
        made = _as_compared(identify(ready, progress=within(progress, 0.0, 0.5)), compared)
        return IdentificationPart(_with_forecast(made, ready, used, within(progress, 0.5, 1.0)))
    except InputError as refusal:
        return IdentificationPart(None, f"Not identified: {refusal}.")


def _as_compared(made: Identification, compared: RecordingComparison) -> Identification:
    """The same, and no class claimed of what was measured as hum: a page says one thing of it."""
    return replace(made, hum=compared.hum).claiming() if compared.hum and not made.hum else made


def _with_forecast(made: Identification, ready: Prepared, cycles: float, progress: Progress) -> Identification:
    """The same with its prediction, or with the reason why there is none."""
    match made.standing:
        case Standing.HUM:
            why = "a steady tone is no decay"
        case Standing.NONE:
            why = "no class describes this recording"
        case _:
            try:
                return replace(made, prediction=predict(ready, cycles=cycles, progress=progress))
            except InputError as refusal:
                why = str(refusal)
    return replace(made, notes=(*made.notes, f"Nothing was predicted: {why}."))


def cycles_of(found: RecordingComparison) -> float:
    """Cycles that the chosen track counts."""
    (chosen,) = (curve for curve in found.curves if curve.name == found.chosen)
    omega = chosen.omega[chosen.valid]
    return float(np.mean(omega)) * float(found.time[-1] - found.time[0]) / (2.0 * np.pi)
