"""Estimators that other packages bring, by the entry point ``ridgeback.estimators``: they take part by their names.

An entry point names a function ``(x, rate)`` of samples, shape ``(N,)``, and samples per time unit, which returns a
Track.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from importlib.metadata import EntryPoint
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.common.plugins import guarded, plugins, told
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import ESTIMATORS, MODEL_FIT
from ridgeback.numeric.tracking.track import Track

GROUP = "ridgeback.estimators"
Outsider = Callable[[Array, float], Track]


def outsiders() -> Mapping[str, Outsider]:
    """The estimators of other packages by name; one that bears a name of ours is left out.

    >>> sorted(outsiders())
    []
    """
    found = plugins(GROUP, (*ESTIMATORS, MODEL_FIT))
    return MappingProxyType({name: partial(_called, point) for name, point in found.items()})


def _called(point: EntryPoint, x: Array, rate: float) -> Track:
    """Load the estimator and run it; what it raises is the reason why it gives nothing, and stops no other method."""
    function = guarded(point, point.load)
    if not callable(function):
        raise InputError(f"{told(point)} is a {type(function).__name__}, not a function of samples and rate")
    track = guarded(point, function, x, rate)
    if not isinstance(track, Track):
        raise InputError(f"{told(point)} returned a {type(track).__name__}, not a ridgeback.Track")
    return track
