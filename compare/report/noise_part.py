"""The noise study of a report: few trials, no intervals, and never more than it may take."""

from __future__ import annotations

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress
from ridgeback.compare.motion.motion import Setting
from ridgeback.compare.noise.monte_carlo import monte_carlo
from ridgeback.compare.noise.results import NoiseStudy
from ridgeback.compare.noise.truth import oscillator_truth
from ridgeback.numeric.recording.recording import Recording

TRIALS = 5
"""Noisy records a point: enough for a figure, whose bands say how well each point is known."""
NOISE_SECONDS = 120.0
NOISE_METHODS = ("harmonic-least-squares", "pseudo-wigner", "wigner", "spectrogram", "zero-crossing")


def noise_of_motion(case: Setting, trials: int, progress: Progress) -> NoiseStudy | None:
    """The estimators in noise on this motion; None for a motion that has no reference to hold them against."""
    try:
        truth = oscillator_truth(
            case.oscillator, case.initial, duration=case.duration, rate=case.rate, title=case.oscillator.title
        )
    except InputError:
        return None
    return monte_carlo(truth, methods=NOISE_METHODS, trials=trials, intervals=False, progress=progress)


def noise_of_recording(recording: Recording, trials: int, progress: Progress) -> tuple[NoiseStudy | None, str]:
    """The estimators on the recording's own smooth model in noise, or why there is no such study."""
    try:
        study = monte_carlo(
            recording,
            methods=NOISE_METHODS,
            trials=trials,
            intervals=False,
            budget_seconds=NOISE_SECONDS,
            progress=progress,
        )
    except InputError as refusal:
        return None, f"No noise study: {refusal}."
    return study, ""
