"""Estimators that other packages bring, by the entry point ``ridgeback.estimators``: they take part by their names.

An entry point names a function ``(x, rate)`` of samples, shape ``(N,)``, and samples per time unit, which returns a
Track.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from importlib.metadata import entry_points
from types import MappingProxyType
from typing import Any

from ridgeback.common.errors import InputError
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
    found = {entry.name: entry for entry in entry_points(group=GROUP) if entry.name not in (*ESTIMATORS, MODEL_FIT)}
    return MappingProxyType({name: partial(_called, entry) for name, entry in sorted(found.items())})


def _called(entry: Any, x: Array, rate: float) -> Track:
    """Load the estimator and run it; what it raises is the reason why it gives nothing."""
    try:
        track = entry.load()(x, rate)
    except InputError:
        raise
    except Exception as error:  # somebody else's code: its faults are its own, and stop no other method
        raise InputError(f"{entry.name} ({entry.value}) raised {type(error).__name__}: {error}") from error
    if not isinstance(track, Track):
        raise InputError(f"{entry.name} ({entry.value}) returned a {type(track).__name__}, not a ridgeback.Track")
    return track
