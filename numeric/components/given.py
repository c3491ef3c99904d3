"""Samples with an oscillation and what is beside it, with what is known of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.harmonics.signal_model import SignalModels, signal_models
from ridgeback.numeric.harmonics.spline_fit import Known
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.search_band import find_search_band


def residual(x: Array, model: SplineModel, tones: tuple[Tone, ...]) -> Array:
    """What a model and tones leave of samples."""
    return x - model.samples() - total(tones, model.time)


@dataclass(frozen=True)
class Given:
    """Samples with what is known of them: ``separated`` says what each is; ``sound`` those that count."""

    x: Array
    rate: float
    guide: Array
    half: int
    multiples: tuple[int, ...] | None
    sound: Mask
    band: tuple[float, float] | None = None

    @property
    def time(self) -> Array:
        """From the first sample on."""
        return np.arange(self.x.size) / self.rate

    @property
    def known(self) -> Known:
        """In the words of the models."""
        return Known(None if self.sound.all() else self.sound.astype(float))

    def filled(self, x: Array, models: SignalModels, tones: tuple[Tone, ...]) -> Given:
        """The same with samples that do not count as models and tones would have them."""
        return replace(self, x=np.where(self.sound, x, models.best.samples() + total(tones, self.time)))

    def guided(self, tones: tuple[Tone, ...]) -> Given:
        """The same with a guide for what is left without tones: beside them the one of all may follow them."""
        if not tones:
            return self
        left = self.x - total(tones, self.time)
        try:
            search = find_search_band(left, self.rate, band=self.band)
        except InputError:
            return self
        return replace(self, guide=search.guide)

    def beside(self, tones: tuple[Tone, ...]) -> SignalModels:
        """Models of the oscillation beside tones, whose error is in theirs."""
        if not tones:
            return self.models(self.x, self.known)
        left = self.x - total(tones, self.time)
        known = replace(self.known, beside=np.concatenate([tone.tangent(self.time) for tone in tones], axis=1))
        try:
            return self.guided(tones).models(left, known)
        except InputError:
            return self.models(left, known)

    def models(self, x: Array, known: Known) -> SignalModels:
        """Models of samples along the guide."""
        return signal_models(x, self.rate, self.guide, half=self.half, multiples=self.multiples, known=known)
