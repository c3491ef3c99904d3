"""What a report on a recording says first: how its frequency depends on its amplitude, and how well that is known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.numbers import NONE, listing, number, per_cent, uncertain
from ridgeback.common.quantities import SECOND, frequency, pace_of, size
from ridgeback.compare.identification.results import Identification, Prediction
from ridgeback.compare.identification.shown import Outcome
from ridgeback.compare.report.results import Card
from ridgeback.compare.study.results import Trend, trend_of
from ridgeback.numeric.arrays import Array

if TYPE_CHECKING:
    from ridgeback.compare.recording.results import RecordingComparison

Indices = NDArray[np.intp]
KNOWN = 2.0
"""A point of the backbone is spoken of when its deviation is at most this many times the median one."""


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
    a, omega = found.backbone_amplitude, found.backbone_omega
    text = at_amplitudes((a[high], a[low]), (omega[high], omega[low]), found.unit)
    if found.doubt:
        return f"{text}: no uncertainty is claimed"
    way = trend(found)
    if way is Trend.CONSTANT:
        middle = _hertz(_middle(omega[_known(found)]))
        return f"{middle} at every fundamental amplitude from {size(a[high], found.unit)} to {size(a[low], found.unit)}"
    return f"{text}: {way.value}"


def recording_lead(found: RecordingComparison) -> str:
    """What the recording is, and how finely it is sampled."""
    pace = pace_of(_middle(found.backbone_omega) / (2 * np.pi))
    return (
        f"{found.source}, {found.column}: {found.time.size} samples shown, {number(found.rate * pace.seconds)} per "
        f"{pace.name}."
    )


def at_amplitudes(sizes: tuple[float, float], omega: tuple[float, float], unit: str) -> str:
    """Frequencies at two amplitudes of the fundamental, rad per s and in the signal's unit, for a title.

    >>> at_amplitudes((1.9, 0.5), (6.0, 6.2), "rad")
    '0.9549 Hz at a fundamental amplitude of 1.9 rad, 0.9868 Hz at 0.5 rad'
    """
    first, second = (_hertz(value) for value in omega)
    return f"{first} at a fundamental amplitude of {size(sizes[0], unit)}, {second} at {size(sizes[1], unit)}"


def recording_sentences(found: RecordingComparison, made: Identification | None) -> tuple[str, ...]:
    """Doubts, the theory named, what of the record was left out, what made it, and the forecast."""
    return tuple(_sentences(found, made))


def _sentences(found: RecordingComparison, made: Identification | None) -> Iterator[str]:
    if found.hum:
        yield f"What is measured is no decay: {found.hum}."
    if found.doubt:
        yield f"{found.doubt}."
    ahead = None if made is None else made.prediction
    if ahead is not None and ahead.outcome is not Outcome.HELD:
        yield forecast(ahead)
    if found.over is not None:
        yield found.over.sentence()
    yield from found.remarks
    if made is not None:
        yield f"What made it: {lowered(made)}."
    if ahead is not None and ahead.outcome is Outcome.HELD:
        yield forecast(ahead)


def lowered(made: Identification) -> str:
    """What made a recording, as far as it is claimed, within a sentence."""
    title = made.title
    return title[:1].lower() + title[1:] if made.standing.refusal else title


def forecast(ahead: Prediction) -> str:
    """The forecast and what became of it, from the share of later values in its bands."""
    said = f"The forecast from the first {number(ahead.cycles, 3)} cycles {ahead.outcome.verb}"
    if ahead.outcome is Outcome.OPEN:
        off = listing([f"{per_cent(ahead.errors.get(name))} in {name_}" for name, name_ in _SINGULAR.items()])
        return (
            f"{said}: its 95 % bands are wider than half of what is forecast, or not known. It was off by {off}, rms."
        )
    shares = ahead.coverage
    names = [_PLURAL.get(name, name) for name in shares]
    all_of = all(share == 1.0 for share in shares.values())
    told = [f"{100 * share:.0f} % of {name}" for share, name in zip(shares.values(), names, strict=True)]
    who = f"all {listing(names)}" if all_of else listing(told)
    return f"{said}: {who} that were measured later lie as near to it as the 95 % bands of both allow."


_PLURAL = {"amplitude": "amplitudes", "omega": "frequencies", "phase": "phases"}
_SINGULAR = {"amplitude": "amplitude", "omega": "frequency"}


def _relative_sd(found: RecordingComparison) -> Array:
    return np.asarray(found.backbone_omega_sd / found.backbone_omega)


def _middle(values: Array) -> float:
    return float(np.median(values))


def recording_cards(found: RecordingComparison) -> tuple[Card, Card, Card]:
    """Frequency, growth rate and damping ratio, uncertainty, each with its ends."""
    low, high = ends(found)
    sizes = [f"at {size(found.backbone_amplitude[i], found.unit)}" for i in (high, low)]
    pace = pace_of(_middle(found.backbone_omega) / (2 * np.pi))
    turn, per = 2 * np.pi / pace.seconds, pace.sign if pace is SECOND else pace.name
    omega = [uncertain(found.backbone_omega[i] / turn, found.backbone_omega_sd[i] / turn) for i in (high, low)]
    rates, deviations = found.growth_rate * pace.seconds, found.growth_rate_sd * pace.seconds
    growth = [uncertain(rates[i], deviations[i]) for i in (high, low)]
    ratio = [uncertain(found.damping_ratio[i], found.growth_rate_sd[i] / found.backbone_omega[i]) for i in (high, low)]
    middle = _middle(found.damping_ratio[_known(found)])
    return (
        Card(
            "Fundamental frequency",
            _hertz(_middle(found.backbone_omega[_known(found)])),
            "median" if found.doubt else f"median; {trend(found).value}",
            tuple(
                (size, f"{value} {'Hz' if pace is SECOND else f'per {per}'}")
                for size, value in zip(sizes, omega, strict=True)
            ),
        ),
        Card("Damping ratio", NONE, "a steady tone is no decay", ())
        if found.hum
        else Card(
            "Damping ratio",
            per_cent(middle, signed=middle < 0),
            "median of −a′/(aω₀)",
            (
                *((size, value) for size, value in zip(sizes, ratio, strict=True)),
                ("a′/a", f"{growth[0]} and {growth[1]} per {per}"),
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
