"""The noise study of a report: few trials, no intervals, and never more than it may take."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress
from ridgeback.compare.noise.monte_carlo import monte_carlo
from ridgeback.compare.noise.results import NoiseStudy
from ridgeback.compare.noise.truth import Truth

TRIALS = 4
"""Noisy records a point: enough for a figure, whose bands say how well each point is known."""
NOISE_SECONDS = 120.0
SNR_DB = (0.0, 20.0, 40.0)
NOISE_METHODS = ("harmonic-least-squares", "pseudo-wigner", "wigner", "spectrogram", "zero-crossing")


@dataclass(frozen=True)
class NoisePart:
    """The noise study, or why there is none."""

    study: NoiseStudy | None
    left_out: str = ""
    """A sentence; empty when there is a study, or when none was asked for."""


def noise_part(truth: Callable[[], Truth], trials: int, progress: Progress) -> NoisePart:
    """The estimators in noise, within the budget of a report.

    Parameters
    ----------
    truth
        Makes the noise-free record with its true frequency; it may refuse.
    trials
        Noisy records a point; 0 for no study.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.
    """
    if not trials:
        return NoisePart(None)
    try:
        study = monte_carlo(
            truth(),
            methods=NOISE_METHODS,
            snr_db=SNR_DB,
            trials=trials,
            intervals=False,
            budget_seconds=NOISE_SECONDS,
            progress=progress,
        )
    except InputError as refusal:
        return NoisePart(None, f"No noise study: {refusal}.")
    return NoisePart(study)
