"""What a report on a recording says first: how its frequency depends on its amplitude, and how well that is known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.numbers import NONE, number, per_cent, uncertain
from ridgeback.common.quantities import frequency
from ridgeback.compare.identification.results import Identification, Standing
from ridgeback.compare.report.results import Card
from ridgeback.compare.study.results import Trend, trend_of
from ridgeback.numeric.arrays import Array

if TYPE_CHECKING:
    from ridgeback.compare.recording.results import RecordingComparison

Indices = NDArray[np.intp]
KNOWN = 2.0
"""A point of the backbone is spoken of when its deviation is at most this many times the median one."""
HELD = 0.8
"""Share of what was measured later that must lie near a forecast, by the 95 % bands of both, for it to have held."""


def _known(found: RecordingComparison) -> Indices:
    """Indices of the points that are known about as well as most: the noisiest are never in a headline."""
    if found.doubt:
        return np.arange(found.backbone_amplitude.size)
    limit = KNOWN * float(np.median(found.backbone_omega_sd))
    kept = np.flatnonzero(found.backbone_omega_sd <= limit)
    return kept if kept.size > 1 else np.arange(found.backbone_amplitude.size)


def ends(found: RecordingComparison) -> tuple[int, int]:
    """Indices of the smallest and the largest amplitude that are known about as well as most."""
    kept = _known(found)
    sizes = found.backbone_amplitude[kept]
    return int(kept[np.argmin(sizes)]), int(kept[np.argmax(sizes)])


def _hertz(value: float) -> str:
    return frequency(value, "s")


def trend(found: RecordingComparison) -> Trend:
    """From the smallest amplitude to the largest: what lies between is known less well than the ends are apart."""
    pair = list(ends(found))
    return trend_of(found.backbone_omega[pair], found.backbone_omega_sd[pair])


def recording_title(found: RecordingComparison) -> str:
    """State the frequency at the largest and the smallest amplitude."""
    low, high = ends(found)
    if found.hum:
        return f"No decay: {found.hum}"
    text = (
        f"{_hertz(found.backbone_omega[high])} at amplitude {found.backbone_amplitude[high]:.3g}, "
        f"{_hertz(found.backbone_omega[low])} at {found.backbone_amplitude[low]:.3g}"
    )
    if found.doubt:
        return f"{text}: no uncertainty is claimed"
    way = trend(found)
    return f"{text}: no dependence beyond the uncertainty" if way is Trend.CONSTANT else f"{text}: {way.value}"


def recording_sentences(found: RecordingComparison, made: Identification | None) -> tuple[str, ...]:
    """Doubts, the theory named, what of the record was left out, what made it, and the forecast."""
    return tuple(_sentences(found, made))


def _sentences(found: RecordingComparison, made: Identification | None) -> Iterator[str]:
    if found.hum:
        yield f"What is measured is no decay: {found.hum}."
    if found.doubt:
        yield f"{found.doubt}."
    told = made is not None and made.prediction is not None
    if made is not None and told and not held(made):
        yield forecast(made)
    if found.over is not None:
        yield found.over.sentence()
    yield from found.remarks
    if made is not None:
        yield _what_made_it(made)
        if told and held(made):
            yield forecast(made)


def _what_made_it(made: Identification) -> str:
    """The class in a sentence; its section says how sure that is."""
    others = len(made.indistinguishable) - 1
    match made.standing:
        case Standing.NONE:
            return f"What made it: no candidate describes this recording; the nearest is {made.best.title}."
        case Standing.HUM:
            return "What made it: no class is claimed, since it is no decay."
        case Standing.DOUBTED:
            return "What made it: no class is claimed, since no model of one oscillation holds."
        case Standing.NEAREST:
            return f"What made it: no candidate comes down to the noise; the nearest is {made.best.title}."
    rest = f"; {others} other {'class fits' if others == 1 else 'classes fit'} as well" if others else ""
    return f"What made it: {made.best.title}, damping {made.best.damping_law}{rest}."


def held(made: Identification) -> bool:
    """Whether what was measured later lies as near to the forecast as their bands allow."""
    return made.prediction is not None and min(made.prediction.coverage.values(), default=0.0) >= HELD


def forecast(made: Identification) -> str:
    """The forecast and whether it held, from the share of later values in its bands."""
    ahead = made.prediction
    if ahead is None:
        return "Nothing was forecast."
    shares = ", ".join(f"{100 * share:.0f} % of {_PLURAL.get(name, name)}" for name, share in ahead.coverage.items())
    verb = "held" if held(made) else "did not hold"
    return (
        f"The forecast from the first {number(ahead.cycles, 3)} cycles {verb}: {shares} that were measured later "
        "lie as near to it as the 95 % bands of both allow."
    )


_PLURAL = {"amplitude": "amplitudes", "omega": "frequencies", "phase": "phases"}


def _relative_sd(found: RecordingComparison) -> Array:
    return np.asarray(found.backbone_omega_sd / found.backbone_omega)


def _middle(values: Array) -> float:
    return float(np.median(values))


def recording_cards(found: RecordingComparison) -> tuple[Card, Card, Card]:
    """Frequency, growth rate and damping ratio, uncertainty, each with its ends."""
    low, high = ends(found)
    sizes = [f"at {found.backbone_amplitude[i]:.3g}" for i in (high, low)]
    omega = [
        uncertain(found.backbone_omega[i] / (2 * np.pi), found.backbone_omega_sd[i] / (2 * np.pi)) for i in (high, low)
    ]
    growth = [uncertain(found.growth_rate[i], found.growth_rate_sd[i]) for i in (high, low)]
    ratio = [uncertain(found.damping_ratio[i], found.growth_rate_sd[i] / found.backbone_omega[i]) for i in (high, low)]
    middle = _middle(found.damping_ratio[_known(found)])
    return (
        Card(
            "Fundamental frequency",
            _hertz(_middle(found.backbone_omega[_known(found)])),
            "median" if found.doubt else f"median; {trend(found).value}",
            tuple((size, f"{value} Hz") for size, value in zip(sizes, omega, strict=True)),
        ),
        Card("Damping ratio", NONE, "a steady tone is no decay", ())
        if found.hum
        else Card(
            "Damping ratio",
            per_cent(middle, signed=middle < 0),
            "median of −a′/(aω₀)",
            (
                *((size, value) for size, value in zip(sizes, ratio, strict=True)),
                ("a′/a", f"{growth[0]} and {growth[1]} per s"),
            ),
        ),
        _uncertainty(found),
    )


def _uncertainty(found: RecordingComparison) -> Card:
    if found.doubt:
        return Card("Uncertainty of ω₀", "–", "none is claimed", ())
    relative = _relative_sd(found)[_known(found)]
    return Card(
        "Uncertainty of ω₀",
        per_cent(_middle(relative)),
        "one standard deviation, median",
        (("best", per_cent(float(relative.min()))), ("worst", per_cent(float(_relative_sd(found).max())))),
    )
