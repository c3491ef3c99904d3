"""Models of the whole signal on fewer and more knots: what estimators are tried on, corrected by and chosen from."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.local_fit import choose_multiples
from ridgeback.numeric.harmonics.spline_fit import NOTHING_KNOWN, Known, best_model, harmonic_splines
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.harmonics.spline_parts import DEGREE
from ridgeback.numeric.signal.samples import TWO_PI

WINDOW_CYCLES = 4.0
"""Shortest window, in cycles, in which the harmonics of the model are chosen."""
STEPS_BEYOND = 1
"""From the least criterion to the best model.  The criterion weighs errors of the signal; its derivative asks for more
knots.  At the least criterion omega errs 1.3 to 1.9 times its bound on the paper's case, a step beyond 1.0 to 1.1."""
STEPS_FINER = 1
"""From the least criterion to the model that intervals rest on: 92 to 98 % of them hold (measured, in
benchmarks/trials/coverage_of_recordings.py)."""
LEFT = 0.3
"""The same for polynomials of neighbouring degrees."""
WINDOW_HALF = 64
"""Half of its fewest samples, where the record has eight times as many: room for six harmonics."""


@dataclass(frozen=True)
class SignalModels:
    """The best model for omega, one on more knots, and one on fewer: that of the least criterion, as a rule.

    The criterion balances bias and noise of the signal; omega needs more knots, and an interval, whose bias must be
    small against its noise, more still.  Where the most knots that were tried are reached, two of the three are one.
    """

    best: SplineModel
    fine: SplineModel
    coarse: SplineModel
    others: tuple[SplineModel, ...] = ()
    """All that were tried, on more and more knots."""

    def coloured(self, colour: float) -> SignalModels:
        """The same with noise that is so much stronger near the oscillation than elsewhere, in power."""
        best, fine, coarse = (replace(model, colour=colour) for model in (self.best, self.fine, self.coarse))
        return SignalModels(best, best if self.fine is self.best else fine, coarse, self.others)

    def only(self, model: SplineModel) -> SignalModels:
        """The same where one of the models is known to be right, and neither bias nor more knots are to be feared."""
        return SignalModels(model, model, replace(model), self.others)

    # A spline of degree d on knots h apart gives a slope to O(h^d): b_coarse = r^d b_fine, r the ratio of distances.
    @property
    def remainder(self) -> float:
        """Bias of the finer model as a share of its difference from the coarser one."""
        ratio = (self.fine.breaks.size - 1) / (self.coarse.breaks.size - 1)
        return min(LEFT, 1.0 / (ratio**DEGREE - 1.0)) if ratio > 1.0 else LEFT

    @property
    def cycles(self) -> float:
        """How many cycles the record holds."""
        return float(self.best.phase[-1] - self.best.phase[0]) / TWO_PI


def signal_models(
    x: Array,
    rate: float,
    guide: Array,
    *,
    half: int,
    multiples: tuple[int, ...] | None = None,
    known: Known = NOTHING_KNOWN,
) -> SignalModels:
    """Model the signal with the harmonics given, else with those that windows of 2 ``half`` + 1 samples show.

    Raises InputError where no model of the whole signal settles, or the record is too short or too long for one.

    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> x = np.cos(7.0 * t + 0.1 * t**2) + 0.1 * np.random.default_rng(1).normal(size=640)
    >>> models = signal_models(x, 32.0, np.full(640, 8.0), half=40)
    >>> models.coarse.parameters < models.fine.parameters, round(models.cycles, 1)
    (True, 28.6)
    """
    multiples = shown_multiples(x, rate, guide, half=half) if multiples is None else multiples
    return among(harmonic_splines(x, rate, guide, multiples=multiples, known=known))


def among(models: list[SplineModel]) -> SignalModels:
    """The models that are taken of those on more and more knots."""
    least = best_model(models)
    at, last = next(i for i, model in enumerate(models) if model is least), len(models) - 1
    best, fine = models[min(at + STEPS_BEYOND, last)], models[min(at + STEPS_FINER, last)]
    return SignalModels(best, fine, least if fine is not least else models[max(at - 1, 0)], tuple(models))


def shown_multiples(x: Array, rate: float, guide: Array, *, half: int) -> tuple[int, ...]:
    """The harmonics that windows of 2 ``half`` + 1 samples show, or longer ones where those are too short."""
    cycle = TWO_PI / float(guide.min())
    wide = max(half, math.ceil(0.5 * WINDOW_CYCLES * cycle * rate), min(WINDOW_HALF, x.size // 8))
    return choose_multiples(x, rate, guide, half=min((x.size - 1) // 2, wide))


@lru_cache(maxsize=2)
def models_once(
    x: bytes, rate: float, guide: bytes, half: int, multiples: tuple[int, ...] | None = None
) -> SignalModels:
    """``signal_models`` of arrays as their bytes, kept for the next method that asks for the same."""
    return signal_models(np.frombuffer(x), rate, np.frombuffer(guide), half=half, multiples=multiples)
