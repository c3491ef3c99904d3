"""The measures by name, and which question is answered from which."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.measures import backbone, cost, decay, reach
from ridgeback.compare.studies.tasks import Measure

QUESTIONS: Mapping[str, Measure] = {
    "error": backbone.MEASURE,
    "order-needed": backbone.MEASURE,
    "observed-order": backbone.MEASURE,
    "range": reach.MEASURE,
    "work-precision": cost.MEASURE,
    "decay-error": decay.MEASURE,
    "crossings": decay.MEASURE,
    "best-estimator": decay.MEASURE,
    "error-budget": decay.MEASURE,
}
"""The cells that a question is answered from."""


def measure_of(ask: Sequence[str]) -> Measure:
    """The one measure of some questions.

    >>> measure_of(("error", "order-needed")).name
    'backbone'
    >>> measure_of(("errors",))
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: no question 'errors'; there are error, order-needed, observed-order, ...
    """
    for question in ask:
        if question not in QUESTIONS:
            raise InputError(f"no question {question[:60]!r}; there are {', '.join(QUESTIONS)}")
    found = {QUESTIONS[question].name: question for question in ask}
    if not found:
        raise InputError(f"nothing is asked; ask one of {', '.join(QUESTIONS)}")
    if len(found) > 1:
        one, other, *_ = found.values()
        raise InputError(f"{one} and {other} are answered from different cells; ask them in two studies")
    return QUESTIONS[ask[0]]
