"""What a report says first: its title is the finding, then a plain-language summary and three figures to take away."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ridgeback.common.numbers import offset, relative, rounded_down, scientific
from ridgeback.common.quantities import amplitude, frequency, nanoseconds, short_amplitude
from ridgeback.compare.motion.estimate_curves import CORRECTED, PSEUDO_WIGNER, WIGNER
from ridgeback.compare.motion.model_curves import AVERAGED_ACTION, CLOSED_FORM, expansion_name
from ridgeback.compare.motion.results import BiasCause, DecayComparison, Score
from ridgeback.compare.report.results import Card
from ridgeback.compare.study.results import Range, Study, Timing


def study_title(study: Study, found: Range) -> str:
    """The range of use of one order, as a sentence without a full stop.

    The target is a relative error that holds everywhere up to the amplitude named.
    """
    target = relative(found.target)
    if found.up_to is None:
        return f"Order {found.order} misses {target} at every amplitude studied for {study.title}"
    symbol = _symbol(study)
    reach = amplitude(rounded_down(found.up_to, 4), study.amplitude_unit)
    extent = "on all of the range studied, up to" if found.up_to >= study.amplitudes[-1] else "up to"
    return f"Order {found.order} stays within {target} {extent} {symbol} = {reach}"


def _symbol(study: Study) -> str:
    return "ε" if study.variable == "eps" else study.variable


def study_sentences(study: Study, found: Sequence[Range]) -> tuple[str, ...]:
    """What the accuracy-order study says, in plain words."""
    return tuple(_study_sentences(study, found))


def _study_sentences(study: Study, found: Sequence[Range]) -> Iterator[str]:
    symbol = _symbol(study)
    reached = [item for item in found if item.up_to is not None]
    target = relative(found[0].target)
    listed = ", ".join(f"order {item.order} up to {symbol} = {_reach(item)}" for item in _sample(reached))
    yield f"The relative error stays within {target}, counted to the first violation, for {listed or 'no order'}."
    known = scientific(float(study.reference_error.max()), digits=1)
    yield f"The exact frequency is the {study.reference_name}, known to {known}."
    if study.convergence_note:
        yield study.convergence_note


def _reach(found: Range) -> str:
    return "0" if found.up_to is None else f"{rounded_down(found.up_to, 3):g}"


def _sample(found: Sequence[Range]) -> Sequence[Range]:
    """At most four of the orders, the first and the last among them."""
    if len(found) <= 4:
        return found
    picks = np.linspace(0, len(found) - 1, 4).round().astype(int)
    return [found[i] for i in picks]


def cards(study: Study, found: Range, timings: Sequence[Timing]) -> tuple[Card, Card, Card]:
    """Range of use, worst error and where, cost."""
    return _range_card(study, found), _worst_card(study, found.order), _cost_card(timings)


def _range_card(study: Study, found: Range) -> Card:
    symbol = _symbol(study)
    value = "none" if found.up_to is None else f"{symbol} ≤ {_reach(found)} {study.amplitude_unit}".strip()
    ends = (
        ""
        if study.limit is None
        else f"  The oscillation itself ends at {amplitude(study.limit, study.amplitude_unit)}."
    )
    text = (
        f"Order {found.order} keeps its relative error within {relative(found.target)} below this, at every amplitude."
    )
    return Card("Range of use", value, text + ends)


def _worst_card(study: Study, order: int) -> Card:
    row = study.relative_error[study.orders.index(order)]
    at = int(np.argmax(np.abs(row)))
    symbol = _symbol(study)
    where = f"{symbol} = {amplitude(float(study.amplitudes[at]), study.amplitude_unit)}"
    text = f"Order {order} against the exact frequency ({study.reference_name}), at {where}."
    return Card("Worst error", relative(float(row[at]), signed=True), text)


def _cost_card(timings: Sequence[Timing]) -> Card:
    timed = [item for item in timings if math.isfinite(item.nanoseconds)]
    if not timed:
        return Card("Cost", "not measured", "No evaluation time was taken in this run.")
    best = min(timed, key=lambda item: item.nanoseconds)
    others = [item for item in timed if item is not best]
    listed = "; ".join(f"{item.name} {nanoseconds(item.nanoseconds)}" for item in others)
    text = f"{_capital(best.name)}, {best.note}." + (f"  For comparison: {listed}." if listed else "")
    return Card("Cost per value", nanoseconds(best.nanoseconds), text)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def decay_sentences(decay: DecayComparison) -> tuple[str, ...]:
    """What was compared along the motion and how it came out, in plain words."""
    return tuple(_decay_sentences(decay))


def _decay_sentences(decay: DecayComparison) -> Iterator[str]:
    yield _motion_sentence(decay)
    yield _reference_sentence(decay)
    scores = {score.method: score for score in decay.scores}
    for name, words in _HEADLINES:
        score = scores.get(name)
        if score is not None and score.rms_interior is not None:
            yield words.format(label=score.label, rms=relative(score.rms_interior), mean=offset(score.mean_interior))
            if name == WIGNER:
                yield from _cause_of_bias(decay)
    yield from _best_and_failed(decay.scores)


def _cause_of_bias(decay: DecayComparison) -> Iterator[str]:
    """Why the Wigner peak is off, where the cause is known."""
    if decay.wigner_bias is not None and decay.wigner_bias.cause is BiasCause.CURVATURE:
        yield _CURVATURE


_CURVATURE = (
    "The cause of that bias is the curvature of ω₀(t), not harmonics: a signal without harmonics shows the same."
)

_HEADLINES = (
    (CLOSED_FORM, "The exact backbone at the amplitude from the energy follows it within {rms} rms."),
    (AVERAGED_ACTION, "The averaged-action model, which needs no integration, follows it within {rms} rms."),
    (expansion_name(4), "The fourth-order expansion is {rms} rms off, {mean} on average."),
    (WIGNER, "The peak of the full-length Wigner distribution lies {mean} on average ({rms} rms)."),
    (PSEUDO_WIGNER, "A windowed (pseudo-)Wigner peak comes within {rms} rms."),
    (CORRECTED, "With its computable curvature bias removed, within {rms} rms."),
)


def _motion_sentence(decay: DecayComparison) -> str:
    unit, time_unit = decay.case.unit, decay.case.time_unit
    start, end = (short_amplitude(float(x), unit) for x in (decay.amplitudes.energy[0], decay.amplitudes.energy[-1]))
    first, last = (frequency(omega, time_unit) for omega in decay.frequency_ends)
    return f"The amplitude goes from {start} to {end} while the frequency goes from {first} to {last}."


def _reference_sentence(decay: DecayComparison) -> str:
    low, high = decay.interior
    span = f"from {low:g} to {high:g} {decay.case.time_unit}".strip()
    text = f"Every curve is held against the cycle frequency of the integrated solution, {span} unless said otherwise."
    if decay.disagreement is None:
        return text
    return f"{text} Two integrators agree within {scientific(decay.disagreement)} {decay.case.unit}".strip() + "."


def _best_and_failed(scores: Sequence[Score]) -> Iterator[str]:
    measured = [score for score in scores if score.kind == "estimate" and score.rms_interior is not None]
    if measured:
        best = min(measured, key=lambda score: score.rms_interior or 0.0)
        yield f"The closest estimate from the signal is {best.label}, within {relative(best.rms_interior)} rms."
    failed = [score.label for score in scores if score.failed]
    if failed:
        yield f"No result from: {', '.join(failed)} (the reasons are in the table)."
