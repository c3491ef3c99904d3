"""The part of a record that an estimate is of: where the motion stands above the noise and can be followed.

A tone that dies within a few cycles beside an oscillation of nearly its frequency is that oscillation's own swell or
fall, or a second mode: no record tells which, and the amplitude of the oscillation is another in either case.  So the
first cycles, in which there is such a tone, are left out; and those, too, without which a model holds that does not
hold with them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.components.tones import Tone, total
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.signal.decimation import Samples
from ridgeback.numeric.signal.search_band import MARGIN, SearchBand, guide_path
from ridgeback.numeric.signal.steps import rounding_error, step_of
from ridgeback.numeric.tracking.choices import Held
from ridgeback.numeric.tracking.clear_stretch import clear_stretch, followed_stretch
from ridgeback.numeric.tracking.followed import along, lengthened
from ridgeback.numeric.tracking.request import Request, prepared

FEWEST_CYCLES = 8.0
"""Of a record, from which on a part of it is looked for in which a frequency can be followed."""

UNRESOLVED = 0.5
"""Of its growth rate, that the frequency of a tone is away from the oscillation's at least, to be told from it."""
SUNK = 0.05
"""Of the noise, down to which such a tone matters."""
LEFT_OUT, MORE, CROWDED = (4.0, 8.0, 12.0), 2.0, 0.7
"""Cycles at the start without which models are tried where none holds with them; those that are left out beyond; and of
the mean distance of knots the first one there, as it is where the start is what takes them."""
MOST_BACKWARDS = 0.7
"""Logarithm of its growth, over which a mode is followed back to before the samples that it was found in."""
MOST_ROUNDING = 0.5
"""Of the deviations of an interval, that the mean error of rounding may reach, rms: it holds in 92 % then."""
MOST_LEFT_OUT = 0.5
"""Of the samples."""
UNTOLD = (
    "the amplitude swells or falls within a few cycles, which is not told from a mode that dies; give a --span after it"
)


def in_its_stretch(request: Request, samples: Samples) -> Request:
    """The request for the samples whose amplitude stands above the noise."""
    stretch = clear_stretch(request)
    if stretch is not None:
        part = part_of(request, samples, stretch, (Held.CLEAR,))
        return without_others(request, part, samples) if request.options.bias else part
    if not request.options.bias or request.options.band is not None or has_model(request):
        return request
    return near_its_line(request) or along_what_is_followed(request, samples)


def without_others(request: Request, part: Request, samples: Samples) -> Request:
    """The request for a longer part, where what is beside the oscillation hid its end; else for the same part."""
    signal, alone = request.signal, part.separated()
    before = part.signal.start - signal.start
    others = tuple(tone for tone in alone.signal.tones if -tone.growth * before < MOST_BACKWARDS)
    if not others or signal.tones or alone.signal.doubt:
        return part
    bare = signal.x - total(others, signal.time - part.signal.start)
    stretch = clear_stretch(replace(request, signal=replace(signal, x=bare))) or slice(0, bare.size)
    if stretch.stop - stretch.start <= part.signal.x.size:
        return part
    longer = part_of(request, samples, stretch, (Held.CLEAR,) if stretch.stop - stretch.start < bare.size else ())
    found = longer.separated()
    as_many = len(found.signal.tones) >= len(others)
    return longer if found.known_models is not None and not found.signal.doubt and as_many else part


def near_its_line(request: Request) -> Request | None:
    """The request with a guide that keeps near the strongest line; None where no model holds along it.

    Of several modes of like strength the guide goes over to another as the first decays.
    """
    signal = request.signal
    centre, rate = signal.search.centre, signal.rate
    guide = guide_path(signal.x, rate, centre, centre / MARGIN, min(centre * MARGIN, math.pi * rate))
    near = replace(request, signal=replace(signal, search=along(signal.search, guide, rate)))
    found = near.separated()
    return None if found.known_models is None or found.signal.doubt else near


def along_what_is_followed(request: Request, samples: Samples) -> Request:
    """The request for as much of a record as its frequency can be followed over; unchanged where that is hardly any.

    The search band's guide is right in some part of a record that runs away from it: from there it is followed.
    """
    size = request.signal.x.size
    if size < FEWEST_CYCLES * request.signal.cycle * request.signal.rate:
        return request
    shares = (slice(0, round(0.6 * size)), slice(round(0.2 * size), round(0.8 * size)), slice(round(0.4 * size), size))
    for stretch in (followed_stretch(request), *shares):
        part = None if stretch is None else part_of(request, samples, stretch, (Held.FOLLOWED,))
        if stretch is None or part is None or not has_model(part):
            continue
        guide, longer = lengthened(request.signal.x, request.signal.rate, request.signal.search.guide, stretch)
        search = along(request.signal.search, guide, request.signal.rate)
        further = part_of(request, samples, longer, (Held.FOLLOWED,), search)
        return further if has_model(further) else part
    return request


def after_its_start(request: Request, samples: Samples) -> Request:
    """The request for what follows the first cycles, where those are not those of one smooth oscillation.

    Parameters
    ----------
    request : Request
        For one oscillation alone, with models of it.
    samples : Samples
        Of the whole record.
    """
    if request.known_models is None or Held.FOLLOWED in request.signal.span_why:
        return request
    first, size = round((request.signal.start - samples.start) * samples.rate), request.signal.x.size
    why = (Held.STARTED, *request.signal.span_why)

    def without(begin: int) -> Request:
        try:
            return part_of(request, samples, slice(first + begin, first + size), why).separated()
        except InputError:
            return replace(request, known_models=None)

    for tried, begin in begins(request):
        if begin <= MOST_LEFT_OUT * size and is_one(without(tried)) and is_one(found := without(begin)):
            return found
    doubt = request.signal.doubt or (UNTOLD if untold(request) else "")
    return replace(request, signal=replace(request.signal, doubt=doubt))


def begins(request: Request) -> Iterator[tuple[int, int]]:
    """Samples at the start without which models are tried, and that are left out; none where nothing is wrong."""
    models, rate = request.models, request.signal.rate
    dying = untold(request)
    if dying:
        left = [math.log(tone.amplitude / (SUNK * models.best.noise)) / -tone.growth for tone in dying]
        yield math.ceil(max(left) * rate), math.ceil(max(left) * rate)
    turned = (models.best.phase - models.best.phase[0]) / (2 * np.pi)
    knots = np.interp(models.best.breaks, models.best.time, turned)
    if request.signal.doubt and knots[1] < CROWDED * knots[-1] / (knots.size - 1):
        for cycles in LEFT_OUT:
            yield int(np.searchsorted(turned, cycles)), int(np.searchsorted(turned, cycles + MORE))


def is_one(request: Request) -> bool:
    """Whether models of one oscillation hold for all of the samples."""
    return request.known_models is not None and not request.signal.doubt and not untold(request)


def untold(request: Request) -> tuple[Tone, ...]:
    """The tones that die and are above the noise, of nearly the frequency of the oscillation."""
    best = request.models.best
    base = best.mean_omega
    return tuple(
        tone
        for tone in request.signal.tones
        if abs(tone.omega - base) < -UNRESOLVED * tone.growth and tone.amplitude > SUNK * best.noise
    )


def has_model(request: Request) -> bool:
    """Whether a model of all of the samples settles."""
    return request.known_models is not None or request.separated().known_models is not None


def part_of(
    request: Request, samples: Samples, stretch: slice, why: tuple[Held, ...], search: SearchBand | None = None
) -> Request:
    """The request for some of the samples, within a search band of all of them if there is one; and why it is those."""
    first = samples.start + stretch.start / samples.rate
    wrong = None if samples.wrong is None else samples.wrong[stretch]
    there = (
        None if search is None else search.at(np.arange(samples.x.size)[stretch].astype(float), np.pi * samples.rate)
    )
    part = prepared(replace(samples, x=samples.x[stretch], start=first, wrong=wrong), request.options, search=there)
    return replace(part, signal=replace(part.signal, span_why=why))


# An error e in the samples changes the coefficients of a model as noise does, by (J^T J)^-1 J^T e.
def doubting_steps(request: Request, samples: Samples) -> Request:
    """The request with a doubt, before all others, where samples come in steps that err by much of what noise does."""
    signal = request.signal
    if step_of(samples.x) is None or not has_model(request):
        return request
    best, first = request.models.best, round((signal.start - samples.start) * samples.rate)
    values = samples.x[first : first + signal.x.size]
    predicted = best.samples() + total(signal.tones, best.time) + signal.offset
    found = rounding_error(values, predicted, best.noise)
    if found is None:
        return request
    change, _ = best.response(found[0] if signal.wrong is None else np.where(signal.wrong, 0.0, found[0]))
    off = max(off_by(best, change, family, slopes=slopes) for family, slopes in ((0, False), (0, True), (-1, True)))
    if off < MOST_ROUNDING:
        return request
    doubt = (
        f"the samples come in steps of {found[1]:.3g}, {float(best.size.max()) / found[1]:.2g} to the amplitude, whose "
        f"rounding errs alike again and again, by {off:.2g} times what noise does; record finer steps"
    )
    return replace(request, signal=replace(signal, doubt=doubt))


def off_by(model: SplineModel, change: Array, family: int, *, slopes: bool) -> float:
    """The root mean square of a change of a model, in its deviations, where the amplitude is above the noise."""
    basis = model.basis
    off = (basis.slopes if slopes else basis.values)(change[:, family])
    deviation = model.band_noise * np.sqrt(model.information.variance(family % model.families, slopes=slopes))
    above = model.size > model.noise
    return float(np.sqrt(np.mean((off / np.maximum(deviation, 1e-300))[above] ** 2))) if above.any() else 0.0
