"""Curves omega0(t) estimated from the sampled signal alone, one per method; a method that fails keeps its reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ridgeback.common.errors import InputError
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.results import Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimation
from ridgeback.numeric.tracking.track import Track

NOTHING: Mapping[str, Track] = MappingProxyType({})


@dataclass(frozen=True)
class Recipe:
    """One estimate: its name, which signal it sees, and the options of ridgeback.numeric.estimators.estimate."""

    name: str
    label: str
    method: str
    velocity: bool = False
    options: Mapping[str, object] | None = None

    @property
    def bare(self) -> Recipe:
        """The same values without an estimate of their bias, which costs more than they do, unless it is taken off."""
        options = dict(self.options or {})
        return self if options.get("remove_bias") else replace(self, options={**options, "bias": False})


WIGNER, WIGNER_OF_VELOCITY, SMOOTHED = "wigner", "wigner-velocity", "smoothed-pseudo-wigner"
PSEUDO_WIGNER, CORRECTED = "pseudo-wigner", "pseudo-wigner-corrected"
"""Names of the estimates that the paper's figures and the summary speak of."""
RECIPES = (
    Recipe(WIGNER, "Wigner peak of u", "wigner", options={"bias": False}),
    Recipe(WIGNER_OF_VELOCITY, "Wigner peak of u'", "wigner", velocity=True, options={"bias": False}),
    Recipe(PSEUDO_WIGNER, "pseudo-Wigner peak of u", "pseudo-wigner"),
    Recipe(CORRECTED, "pseudo-Wigner, bias removed", "pseudo-wigner", options={"remove_bias": True}),
    Recipe(SMOOTHED, "smoothed pseudo-Wigner", "smoothed-pseudo-wigner"),
    Recipe("spectrogram", "spectrogram peak of u", "spectrogram"),
    Recipe("hilbert", "Hilbert phase of u", "hilbert"),
    Recipe("harmonic-least-squares", "harmonic least squares on u", "harmonic-least-squares"),
    Recipe("zero-crossing", "zero crossings of u", "zero-crossing"),
)
LEAN = tuple(recipe.bare for recipe in RECIPES if recipe.name != CORRECTED)
"""The same without a bias taken from a model of the whole signal: each is that method alone, and costs less."""
SHORT = tuple(
    recipe for recipe in LEAN if recipe.name in (WIGNER, PSEUDO_WIGNER, "harmonic-least-squares", "zero-crossing")
)
"""The few of them that tell how estimates err, where the paper's figures are not wanted."""


@dataclass(frozen=True)
class Outcome:
    """What a recipe gave: a curve, or the reason why there is none."""

    recipe: Recipe
    track: Track | None
    failed: str = ""

    @property
    def curve(self) -> Curve | None:
        """The track as a curve under the recipe's name."""
        return None if self.track is None else curve_of(self.track, self.recipe.name, self.recipe.label)


def signal_of(motion: Motion, recipe: Recipe) -> Array:
    """The samples that a recipe sees."""
    return motion.trajectory.velocity if recipe.velocity else motion.trajectory.u


def run(recipe: Recipe, x: Array, rate: float, start: float = 0.0, *, deviations: bool = True) -> Track:
    """Run one recipe on samples; InputError from the estimator passes through."""
    options: dict[str, Any] = dict(recipe.options or {})
    return estimation(x, rate, method=recipe.method, start=start, deviations=deviations, **options).track


def attempt(recipe: Recipe, x: Array, rate: float, *, deviations: bool = True) -> Outcome:
    """Run one recipe; a refusal (InputError) becomes an Outcome with its text."""
    try:
        return Outcome(recipe, run(recipe, x, rate, deviations=deviations))
    except InputError as error:
        return Outcome(recipe, None, str(error))


def estimates(
    motion: Motion,
    progress: Callable[[str], None],
    recipes: Sequence[Recipe] = RECIPES,
    known: Mapping[str, Track] = NOTHING,
) -> tuple[Outcome, ...]:
    """Run every recipe on the sampled motion; ``known`` holds, by method, bare tracks of u that are there already."""
    outcomes = []
    for recipe in recipes:
        progress(recipe.label)
        if recipe.method in known and recipe == recipe.bare and not recipe.velocity:
            outcomes.append(Outcome(recipe, known[recipe.method]))
        else:
            outcomes.append(attempt(recipe, signal_of(motion, recipe), motion.trajectory.rate))
    return tuple(outcomes)


def curve_of(track: Track, name: str, label: str) -> Curve:
    """Turn a track into a curve under a name, with the label that a reader sees."""
    return Curve(
        name=name,
        label=label,
        kind="estimate",
        time=track.time,
        omega=track.omega,
        valid=track.valid & np.isfinite(track.omega),
        standard_deviation=track.standard_deviation,
        bias=track.bias,
    )


def along(track: Track, time: Array) -> Array:
    """The valid part of a track at other times, NaN where its nearest valid samples lie too far apart."""
    keep = track.valid & np.isfinite(track.omega)
    if keep.sum() < 2:
        return np.full(time.size, np.nan)
    t, w = track.time[keep], track.omega[keep]
    step = 2.5 * float(np.median(np.diff(track.time)))
    covered = _within_reach(time, t, step)
    return np.where(covered, PchipInterpolator(t, w, extrapolate=False)(time), np.nan)


def _within_reach(time: Array, known: Array, step: float) -> Array:
    """Whether each time lies between two known ones no farther apart than ``step``."""
    right = np.clip(np.searchsorted(known, time), 1, known.size - 1)
    gap = known[right] - known[right - 1]
    inside = (time >= known[0]) & (time <= known[-1])
    return np.asarray(inside & (gap <= step))
