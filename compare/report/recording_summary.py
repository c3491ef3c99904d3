"""What a report on a recording says first: how its frequency depends on its amplitude, and how well that is known."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ridgeback.common.numbers import relative, signed
from ridgeback.common.quantities import frequency
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.report.results import Card
from ridgeback.compare.study.results import Trend, trend_of
from ridgeback.numeric.arrays import Array


def _ends(found: RecordingComparison) -> tuple[int, int]:
    """Indices of the smallest and the largest amplitude of the backbone."""
    return int(np.argmin(found.backbone_amplitude)), int(np.argmax(found.backbone_amplitude))


def _hertz(value: float) -> str:
    return frequency(value, "s")


def _trend(found: RecordingComparison) -> Trend:
    """From the smallest amplitude to the largest: what lies between is known less well than the ends are apart."""
    ends = list(_ends(found))
    return trend_of(found.backbone_omega[ends], found.backbone_omega_sd[ends])


def recording_title(found: RecordingComparison) -> str:
    """State the frequency at the largest and the smallest amplitude."""
    low, high = _ends(found)
    text = (
        f"{_hertz(found.backbone_omega[high])} at amplitude {found.backbone_amplitude[high]:.3g}, "
        f"{_hertz(found.backbone_omega[low])} at {found.backbone_amplitude[low]:.3g}"
    )
    trend = _trend(found)
    return f"{text}: no dependence beyond the uncertainty" if trend is Trend.CONSTANT else f"{text}: {trend.value}"


def recording_sentences(found: RecordingComparison) -> tuple[str, ...]:
    """Say in plain words what was estimated, how the estimators compare, and what the growth rate is."""
    return tuple(_sentences(found))


def _sentences(found: RecordingComparison) -> Iterator[str]:
    low, high = _ends(found)
    yield (
        f"As the amplitude of the fundamental goes from {found.backbone_amplitude[high]:.3g} to "
        f"{found.backbone_amplitude[low]:.3g}, the frequency goes from {_hertz(found.backbone_omega[high])} to "
        f"{_hertz(found.backbone_omega[low])}."
    )
    yield f"The backbone's relative standard deviation is {relative(_middle(_relative_sd(found)))} in the median."
    yield (
        f"The amplitude changes at a′/a = {signed(found.growth_rate[high])} per second at the largest amplitude and "
        f"{signed(found.growth_rate[low])} at the smallest."
    )
    yield from found.notes


def _relative_sd(found: RecordingComparison) -> Array:
    return np.asarray(found.backbone_omega_sd / found.backbone_omega)


def _middle(values: Array) -> float:
    return float(np.median(values))


def recording_cards(found: RecordingComparison) -> tuple[Card, Card, Card]:
    """Frequency range, growth rate, uncertainty."""
    low, high = _ends(found)
    span = f"{_hertz(found.backbone_omega[high])} to {_hertz(found.backbone_omega[low])}"
    amplitudes = f"{found.backbone_amplitude[high]:.3g} to {found.backbone_amplitude[low]:.3g}"
    growth_rate = float(np.median(found.growth_rate))
    return (
        Card("Fundamental frequency", span, f"Amplitudes {amplitudes} (first harmonic): {_trend(found).value}."),
        Card("Growth rate", f"{signed(growth_rate)} per s", "Median of a′/a over the backbone; see the figure."),
        Card(
            "Uncertainty",
            relative(_middle(_relative_sd(found))),
            "Median relative standard deviation of the backbone's points.",
        ),
    )
