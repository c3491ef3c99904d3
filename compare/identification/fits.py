"""Every candidate fitted to one decay, in order of its criterion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress
from ridgeback.compare.identification.candidates import (
    BACKBONE,
    VAN_DER_POL,
    DampingLaw,
    Model,
    backbone_model,
    models_of,
)
from ridgeback.compare.identification.fitting import Data, Fit, fit, refit
from ridgeback.compare.identification.ranking import criterion, effective_number
from ridgeback.numeric.arrays import Array

MOST_TERMS = 4
WORTH_TRYING = 9.0
"""Other damping laws are tried where the residual's variance is at most this many times the least one."""


@dataclass(frozen=True)
class Ranked:
    """Fits in order of their criterion, with the criteria and the effective samples that they count."""

    fits: tuple[Fit, ...]
    scores: tuple[float, ...]
    effective: float
    failed: tuple[str, ...]

    @property
    def weights(self) -> Array:
        """Akaike weights."""
        raw = np.exp(-0.5 * (np.array(self.scores) - self.scores[0]))
        return np.asarray(raw / raw.sum())


def rank(data: Data, names: tuple[str, ...], laws: tuple[DampingLaw, ...], kind: str, progress: Progress) -> Ranked:
    """Fit every candidate with the first damping law, the promising ones with the others, and order them."""
    first, failed = [], []
    for i, name in enumerate(names):
        progress(0.1 + 0.6 * i / len(names), name)
        try:
            first.append(best_with(name, laws[0], data))
        except InputError as error:
            failed.append(str(error))
    if not first:
        raise InputError("no candidate could be fitted: " + "; ".join(failed))
    least = min(f.sum_of_squares for f in first)
    kept = []
    for i, found in enumerate(first):
        progress(0.7 + 0.2 * i / len(first), f"{found.model.name}, other damping laws")
        tried = polished(found, laws[1:], data) if found.sum_of_squares <= WORTH_TRYING * least else [found]
        kept.append(min(tried, key=lambda f: criterion(f, f.residual.size, kind)))
    best = min(kept, key=lambda f: criterion(f, f.residual.size, kind))
    effective = min(float(best.residual.size), effective_number(best.residual) + best.model.count)
    scored = sorted(((criterion(f, effective, kind), i) for i, f in enumerate(kept)))
    return Ranked(tuple(kept[i] for _, i in scored), tuple(s for s, _ in scored), effective, tuple(failed))


def best_with(name: str, law: DampingLaw, data: Data) -> Fit:
    """The fit of a candidate; a polynomial backbone with as many terms as BIC asks for."""
    if name != BACKBONE:
        return fit(models_of(name, law), data)
    fits = [fit(backbone_model(terms, law), data) for terms in range(1, MOST_TERMS + 1)]
    return min(fits, key=lambda f: criterion(f, f.residual.size, "bic"))


def polished(found: Fit, laws: tuple[DampingLaw, ...], data: Data) -> list[Fit]:
    """The fit to rounding, and the same class with other damping laws, started from it."""
    fine = refit(found.model, data, found.theta)
    if found.model.name == VAN_DER_POL:
        return [fine]
    tried = [fine]
    for law in laws:
        model = with_law(found, law)
        if model.size > found.model.size:
            theta = np.insert(fine.theta, 1 + found.model.size, 0.05 * abs(fine.theta[found.model.size]))
            tried.append(refit(model, data, theta))
        else:
            tried.append(fit(model, data))
    return tried


def with_law(found: Fit, law: DampingLaw) -> Model:
    """The model of a fit with another damping law."""
    if found.model.name == BACKBONE:
        return backbone_model(found.model.size - found.model.rates - 2, law)
    return models_of(found.model.name, law)
