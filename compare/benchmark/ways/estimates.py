"""The contenders that see the samples alone: each estimator as it is, and corrected by its own track.

A row that bears a method's name owes nothing to another method: its correction is made from its own track
(``ridgeback.compare.benchmark.ways.own_correction``), and the row says so.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from functools import partial

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.contenders import Row
from ridgeback.compare.benchmark.ways.contender import Contender, refused
from ridgeback.compare.benchmark.ways.own_correction import corrected
from ridgeback.compare.benchmark.ways.timing import Cost, cost_of, repeated
from ridgeback.compare.motion.estimate_curves import along
from ridgeback.compare.motion.motion import Motion
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimation
from ridgeback.numeric.tracking.track import Track

METHODS = (
    *("wigner", "pseudo-wigner", "smoothed-pseudo-wigner", "polynomial-wigner", "spectrogram"),
    *("zero-crossing", "harmonic-least-squares"),
)
UNCORRECTED = ("harmonic-least-squares",)
"""Methods that model the whole signal: their track is the model, and a correction by it would be no other value."""
OWN_TRACK = "its own track"
ANOTHER = 1.0 + 1e-9
"""Samples times this are others: nothing that is kept of the first run serves a second one."""

Estimator = Callable[[Array], Track]
"""Samples to a track; a user's own takes part under the name that it is given."""


def estimates(
    motion: Motion, own: Mapping[str, Estimator], step: Callable[[str], None], *, timed: bool = True
) -> Iterator[Contender]:
    """Every estimator on the sampled motion, raw and corrected; one that refuses keeps its reason.

    Where times are not wanted, none runs again for the scatter of its time alone.
    """
    rate = motion.trajectory.rate
    known: dict[str, Estimator] = {name: partial(_plain, rate=rate, method=name) for name in METHODS}
    for name, method in {**known, **own}.items():
        step(name)
        yield from _both(motion, name, method, rate, timed=timed)


def _plain(x: Array, rate: float, method: str) -> Track:
    return estimation(x, rate, method=method, bias=False, deviations=False).track


def _both(motion: Motion, name: str, method: Estimator, rate: float, *, timed: bool) -> Iterator[Contender]:
    x, laps = motion.trajectory.u, list[float]()

    def clocked(samples: Array) -> Track:
        began = time.process_time()
        track = method(samples)
        laps.append(time.process_time() - began)
        return track

    try:
        track = clocked(x)
    except InputError as error:
        yield refused(name, name, "estimate", str(error))
        return
    if name in UNCORRECTED:
        again = partial(method, x * ANOTHER)
        yield _contender(motion, track, name, name, repeated(again, laps=laps) if timed else cost_of(laps), None)
        return
    began = time.process_time()
    better = corrected(track, clocked, x, rate)
    whole, one = laps[0] + time.process_time() - began, cost_of(laps)
    yield _contender(motion, track, name, name, one, None)
    every = Cost(whole, one.scatter * one.seconds * len(laps) ** 0.5 / whole)  # that of the runs within it
    yield _contender(motion, better, f"{name}-corrected", f"{name}, bias by its own track removed", every, OWN_TRACK)


def _contender(motion: Motion, track: Track, name: str, label: str, cost: Cost, by: str | None) -> Contender:
    """What a track gives on the motion's samples, and the track itself."""
    row = Row(
        name,
        label,
        "estimate",
        corrected_by=by,
        time_s_per_track=cost.seconds,
        time_ns_per_value=1e9 * cost.per(motion.time.size).seconds,
        time_scatter=cost.scatter,
    )
    return Contender(row, along(track, motion.time), track)
