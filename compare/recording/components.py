"""The oscillations of one signal, each with a track and a backbone of its own: what is beside the strongest, too.

The strongest is a smooth oscillation, each of the others a tone, steady or damped, fitted together with it
(``numeric.components.separation``).  A component's own signal is what all the others leave of the samples.  Tones keep
their frequency, or change it smoothly as they decay, so that tracks which come near each other are not swapped.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.recording.measurement import Measurement, estimated, measure, measured
from ridgeback.numeric.components.shared_error import shared_error
from ridgeback.numeric.components.tones import Tone
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.request import Request

NEAR = 1.25
"""Factor from a component's frequency within which its own signal is searched."""


def measured_components(
    recording: Recording, *, harmonic: int = 1, halves: bool = False, **settings: object
) -> list[Measurement]:
    """Measure a signal, and with ``components`` of 2 or more each of the tones beside its oscillation.

    Parameters
    ----------
    recording
        One signal, evenly sampled.
    harmonic, halves, **settings
        As for :func:`ridgeback.compare.recording.measurement.measure`.

    Returns
    -------
    list of Measurement
        The strongest first; ``component`` counts them where there are several.

    Raises
    ------
    InputError
        Where the strongest cannot be measured.

    Examples
    --------
    >>> t = np.arange(1200) / 40.0
    >>> x = np.exp(-0.05 * t) * np.cos(13.0 * t) + 0.3 * np.exp(-0.02 * t) * np.cos(17.0 * t)
    >>> noisy = x + 0.01 * np.random.default_rng(1).normal(size=t.size)
    >>> found = measured_components(Recording.from_arrays(noisy, 40.0), components=2)
    >>> [(one.component, round(float(np.median(one.track.omega)), 1)) for one in found]
    [(1, 13.0), (2, 17.0)]
    """
    words: Any = settings
    wanted = words.get("components")
    if halves or harmonic > 1 or wanted is None or wanted < 2:
        return [measure(recording, harmonic=harmonic, halves=halves, **words)]
    found = estimated(recording, **words)
    strongest = replace(measured(recording, found, 1, None), component=1)
    tones = [tone for tone in found.track.used.tones if in_band(tone, words.get("band"))]
    ordered = sorted(tones, key=lambda tone: -tone.amplitude)[: wanted - 1]
    told = list(counted(len(ordered) + 1, wanted, words.get("band")))
    others: list[Measurement] = []
    if found.request is not None and found.track.interval is not None:
        for i, tone in enumerate(ordered, start=2):
            try:
                others.append(of_tone(recording, found.request, tone, i))
            except InputError as error:
                told.append(f"Component {i}, {tone.said()}, is not measured by itself: {error}.")
    return [replace(strongest, notes=(*told, *strongest.notes)), *others]


def in_band(tone: Tone, band: tuple[float, float] | None) -> bool:
    """Whether a tone is in the band that was asked for, if one was."""
    return band is None or band[0] <= tone.omega <= band[1]


def counted(found: int, wanted: int, band: tuple[float, float] | None) -> Iterator[str]:
    """That fewer components stand out than were asked for, if so.

    >>> list(counted(1, 2, None)), list(counted(2, 2, None))
    (['1 of 2 components that were asked for stand out; none is made up.'], [])
    """
    if found < wanted:
        where = "" if band is None else " in the band"
        yield f"{found} of {wanted} components that were asked for stand out{where}; none is made up."


def of_tone(recording: Recording, request: Request, tone: Tone, number: int) -> Measurement:
    """A tone measured in what everything else leaves of the samples."""
    signal, model = request.signal, request.models.best
    here = Recording(
        time=signal.time,
        values=signal.x - model.samples() + tone.samples(signal.time - signal.time[0]),
        rate=signal.rate,
        name=recording.name,
        units=recording.units,
        source=recording.source,
        sha256=recording.sha256,
        run=recording.run,
        stretch=recording.stretch,
        facts=recording.facts,
    )
    band = (tone.omega / NEAR, min(tone.omega * NEAR, 0.999 * np.pi * signal.rate))
    how = "measured in what the others leave of the samples; their error is in its own"
    note = f"Component {number}, {tone.said()}: {how}."
    beside = tuple(other for other in signal.tones if other is not tone)
    found = measure(here, band=band, components=1, shared=shared_error(tone, beside, model))
    return replace(found, notes=(note, *found.notes), component=number)
