"""The questions by name, each with what answers it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.questions import (
    best_estimator,
    crossings,
    decay_error,
    error,
    error_budget,
    observed_order,
    order_needed,
    reach,
    work_precision,
)
from ridgeback.compare.studies.tasks import Finished

Answering = Callable[[Plan, Iterable[Finished]], Answer]
ANSWERS: Mapping[str, Answering] = {
    "error": error.answer,
    "order-needed": order_needed.answer,
    "observed-order": observed_order.answer,
    "range": reach.answer,
    "work-precision": work_precision.answer,
    "decay-error": decay_error.answer,
    "crossings": crossings.answer,
    "best-estimator": best_estimator.answer,
    "error-budget": error_budget.answer,
}


def answers(plan: Plan, blocks: Callable[[], Iterable[Finished]]) -> Iterator[Answer]:
    """The answer to each question of a plan; ``blocks`` gives its finished cells, from the beginning each time."""
    for question in plan.ask:
        yield ANSWERS[question](plan, blocks())
