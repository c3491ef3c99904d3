"""The part of a record that an estimate is of: where the motion stands above the noise and can be followed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.search_band import SearchBand
from ridgeback.numeric.tracking.clear_stretch import clear_stretch, followed_stretch
from ridgeback.numeric.tracking.followed import along, lengthened
from ridgeback.numeric.tracking.request import Request, prepared

FOLLOWED = "the frequency changes slowly enough to be followed"
FEWEST_CYCLES = 8.0
"""Of a record, from which on a part of it is looked for in which a frequency can be followed."""


def in_its_stretch(request: Request, samples: Samples) -> Request:
    """The request for the samples whose amplitude stands above the noise."""
    stretch = clear_stretch(request)
    if stretch is not None:
        return part_of(request, samples, stretch, "the amplitude stands above the noise")
    if not request.options.bias or request.options.band is not None or has_model(request):
        return request
    return along_what_is_followed(request, samples)


def along_what_is_followed(request: Request, samples: Samples) -> Request:
    """The request for as much of a record as its frequency can be followed over; unchanged where that is hardly any.

    The search band's guide is right in some part of a record that runs away from it: from there it is followed.
    """
    size = request.signal.x.size
    if size < FEWEST_CYCLES * request.signal.cycle * request.signal.rate:
        return request
    shares = (slice(0, round(0.6 * size)), slice(round(0.2 * size), round(0.8 * size)), slice(round(0.4 * size), size))
    for stretch in (followed_stretch(request), *shares):
        part = None if stretch is None else part_of(request, samples, stretch, FOLLOWED)
        if stretch is None or part is None or not has_model(part):
            continue
        guide, longer = lengthened(request.signal.x, request.signal.rate, request.signal.search.guide, stretch)
        search = along(request.signal.search, guide, request.signal.rate)
        further = part_of(request, samples, longer, FOLLOWED, search)
        return further if has_model(further) else part
    return request


def has_model(request: Request) -> bool:
    """Whether a model of all of the samples settles."""
    return request.known_models is not None or request.separated().known_models is not None


def part_of(request: Request, samples: Samples, stretch: slice, why: str, search: SearchBand | None = None) -> Request:
    """The request for some of the samples, within a search band of all of them if there is one; and why it is those."""
    first = samples.start + stretch.start / samples.rate
    wrong = None if samples.wrong is None else samples.wrong[stretch]
    there = (
        None if search is None else search.at(np.arange(samples.x.size)[stretch].astype(float), np.pi * samples.rate)
    )
    part = prepared(replace(samples, x=samples.x[stretch], start=first, wrong=wrong), request.options, search=there)
    return replace(part, signal=replace(part.signal, span_why=why))
