"""What a report says of what made a recording: the ranking, and the rest of the decay foretold from its first part."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.prediction import predict
from ridgeback.compare.identification.results import Identification
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.numeric.recording.recording import Recording

SHARE = 1.0 / 3.0
"""Part of the cycles that foretells the rest unless the caller says how many."""


def identified(
    recording: Recording, found: RecordingComparison, cycles: float | None, progress: Progress
) -> tuple[Identification | None, str]:
    """The identification with its prediction where there are cycles enough; the reason for what is missing."""
    try:
        made = identify(recording, progress=lambda share, step: progress(0.5 * share, step))
    except InputError as refusal:
        return None, f"Not identified: {refusal}."
    used = SHARE * cycles_of(found) if cycles is None else cycles
    try:
        ahead = predict(recording, cycles=used, progress=lambda share, step: progress(0.5 + 0.5 * share, step))
    except InputError as refusal:
        return replace(made, notes=(*made.notes, f"Nothing was foretold: {refusal}.")), ""
    return replace(made, prediction=ahead), ""


def cycles_of(found: RecordingComparison) -> float:
    """Cycles that the chosen track counts."""
    (chosen,) = (curve for curve in found.curves if curve.name == found.chosen)
    omega = chosen.omega[chosen.valid]
    return float(np.mean(omega)) * float(found.time[-1] - found.time[0]) / (2.0 * np.pi)
