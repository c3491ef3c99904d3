"""Which oscillator made this decay?  Every candidate fitted, ranked, and told apart or not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent, within
from ridgeback.compare.identification.candidates import ALL_LAWS, LAWS, NAMES, DampingLaw
from ridgeback.compare.identification.fits import Ranked, rank
from ridgeback.compare.identification.fitting import Data, Fit, prepare
from ridgeback.compare.identification.preparation import Prepared, prepared
from ridgeback.compare.identification.quantities import refuse_another_quantity
from ridgeback.compare.identification.ranking import CLEAR, CRITERIA, ROUNDING, candidate
from ridgeback.compare.identification.results import Identification, MeasuredBackbone, Prediction
from ridgeback.compare.identification.sample_fit import (
    UNKNOWN,
    Misfit,
    SampleFit,
    over_elsewhere,
    over_model,
    sample_fit,
)
from ridgeback.numeric.backbone.hum import hum_of
from ridgeback.numeric.components.tones import Tone
from ridgeback.numeric.recording.recording import Recording

FEWEST_CYCLES = 6
ENDS = (0.0, 0.7, 0.85, 0.9)
"""Shares of the work at which each attempt begins and ends, if it is made."""


def identify(
    recording: Recording | Prepared,
    *,
    candidates: Iterable[str] = NAMES,
    laws: Sequence[str] = LAWS,
    kind: str = "bic",
    span: tuple[float, float] | None = None,
    band: tuple[float, float] | None = None,
    prediction: Prediction | None = None,
    notes: Sequence[str] = (),
    progress: Progress = silent,
) -> Identification:
    """Fit every candidate to a decay and rank them.

    Parameters
    ----------
    recording
        One signal, evenly sampled; or what :func:`prepared` made of it, to share that with :func:`predict`.
    candidates
        Names of oscillator classes, of :data:`NAMES`.
    laws
        Damping laws that are tried, of :data:`ALL_LAWS`.
    kind
        Information criterion: ``bic`` or ``aicc``.
    span
        First and last time to use; all by default.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
    prediction
        What :func:`predict` made of the same recording, to go into the result.
    notes
        Sentences to go into the result.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Identification
        Candidates, best first, with their parameters and intervals, and which the data cannot tell apart.

    Raises
    ------
    InputError
        For unknown names, a span without enough cycles, more samples than fit the budget, and when no candidate can
        be fitted.

    References
    ----------
    G. Schwarz, Ann. Stat. 6 (1978) 461-464 (BIC); R. E. Kass and A. E. Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795.

    Examples
    --------
    >>> t = np.arange(400) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=400)
    >>> decay = Recording(t, np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, 4.0, "u", "mm", "decay.csv", "")
    >>> found = identify(decay, candidates=("linear", "duffing-hardening"))
    >>> found.best.name, bool(abs(found.best.parameter("k").value - np.hypot(1.1, 0.01)) < 5e-4)
    ('linear', True)
    """
    names, allowed = checked(candidates, laws, kind)
    progress(0.0, "frequency track")
    ready = prepared(recording, span=span, band=band) if isinstance(recording, Recording) else recording
    found = attempted(ready, names, allowed, kind, progress)
    if found.hum is None:
        refuse_another_quantity(found.ready, found.data, found.ranked, progress)
    ready, used = found.ready, found.ready.recording
    where = float(used.time[0]), float(used.time[-1])
    measured = () if ready.doubt else found.data.measured.notes
    said = (*ready.notes, *used.drift_notes(where), *used.notes, *measured, *notes)
    return assembled(found, kind, said, prediction)


@dataclass(frozen=True)
class Attempt:
    """The ranking of what a recording may be, and how much more than noise the best leaves."""

    ready: Prepared
    data: Data
    ranked: Ranked
    misfit: Misfit
    hum: Tone | None
    """The steady tone of the mains that the oscillation is: of no class, so that one stands for all."""


def attempted(
    ready: Prepared, names: tuple[str, ...], laws: tuple[DampingLaw, ...], kind: str, progress: Progress
) -> Attempt:
    """The ranking of the oscillation as it was prepared, or of what else it may be.

    That is all that is beside it, too, if only then a class leaves noise alone; and windows, where nothing before them
    can be fitted.  Raises InputError where nothing can be measured, and where there are too few cycles.
    """
    first: Attempt | None = None
    refusal: InputError | None = None
    for i, one in enumerate(chain((ready,), ready.others())):
        try:
            found = attempt(one, names, laws, kind, within(progress, ENDS[i], ENDS[i + 1]))
        except InputError as error:
            refusal = refusal or error
            continue
        first = first or found
        if not found.misfit.out:
            return found
        if one.whole is None:
            break
    if first is None:
        raise refusal or InputError(f"{ready.recording.source}: nothing can be measured")
    return first


def attempt(
    ready: Prepared, names: tuple[str, ...], laws: tuple[DampingLaw, ...], kind: str, progress: Progress
) -> Attempt:
    """Rank the candidates on samples as they were prepared."""
    used = ready.recording
    data = prepare(used, ready.track, models=ready.models, kept=ready.kept)
    cycles = float(data.time[-1]) / data.cycle
    if cycles < FEWEST_CYCLES:
        raise InputError(f"{used.source}: {cycles:.1f} cycles are too few to tell oscillators apart; give 6 or more")
    hum = hum_of(data.measured)
    ranked = rank(data, *((names, laws) if hum is None else (names[:1], laws[:1])), kind, progress)
    return Attempt(ready, data, ranked, misfit(ready, data, ranked.fits[0]), hum)


def checked(
    candidates: Iterable[str], laws: Sequence[str], kind: str
) -> tuple[tuple[str, ...], tuple[DampingLaw, ...]]:
    """The names, once each, when all are known.

    >>> checked(["linear", "linear"], ["linear"], "aic")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: criterion 'aic' is unknown; use one of bic, aicc
    """
    names = tuple(dict.fromkeys(candidates))
    for what, given, known in (("candidate", names, NAMES), ("damping law", tuple(laws), ALL_LAWS)):
        wrong = [name for name in given if name not in known]
        if wrong or not given:
            said = f"{what} {wrong[0]!r} is unknown" if wrong else f"no {what} is named"
            raise InputError(f"{said}; use one of {', '.join(known)}")
    if kind not in CRITERIA:
        raise InputError(f"criterion {kind!r} is unknown; use one of {', '.join(CRITERIA)}")
    return names, tuple(law for law in ALL_LAWS if law in laws)


def assembled(attempt: Attempt, kind: str, notes: tuple[str, ...], prediction: Prediction | None) -> Identification:
    """Put the ranking into its result."""
    ready, data, ranked = attempt.ready, attempt.data, attempt.ranked
    recording = ready.recording
    best, total = ranked.scores[0], float(np.sum(np.exp(-0.5 * (np.array(ranked.scores) - ranked.scores[0]))))
    candidates = tuple(
        candidate(f, data, recording.units, score, best, total)
        for f, score in zip(ranked.fits, ranked.scores, strict=True)
    )
    near = tuple(c.name for c in candidates if c.delta < CLEAR)
    measured, hum = data.measured, attempt.hum
    found = Identification(
        source=recording.source,
        column=recording.name,
        unit=recording.units,
        rate=recording.rate,
        samples=int(data.kept.sum()),
        noise=np.nan if ready.noise is None else ready.noise,
        doubt=ready.doubt,
        hum="" if hum is None else hum.said(),
        effective_samples=ranked.effective,
        criterion_name=kind,
        candidates=candidates,
        data=MeasuredBackbone(
            measured.curve_amplitude,
            measured.curve_omega,
            measured.curve_omega_sd,
            measured.curve_growth_rate,
            measured.curve_growth_rate_sd,
        ),
        unexplained=candidates[0].residual / (data.length * float(np.std(data.x))),
        indistinguishable=near,
        settings={"track": ready.track.method, "sha256": recording.sha256, "length": data.length, "cycle": data.cycle},
        notes=notes,
        failed=ranked.failed,
        prediction=prediction,
        fitted=over_samples(recording, data, ranked.fits[0]),
        misfit=attempt.misfit,
    )
    return found.claiming()


def misfit(ready: Prepared, data: Data, best: Fit) -> Misfit:
    """How much more than noise the best fit leaves: beside a model of the samples, else beside other frequencies."""
    count, whole = best.model.count, np.zeros(data.time.size)
    whole[data.kept] = data.length * best.residual
    beside, colour = UNKNOWN, 1.0
    if ready.models is not None and ready.left is not None:
        model = ready.models.best
        beside, colour = over_model(whole, ready.left, count, model, ROUNDING * data.length), model.colour
        if beside.known and not beside.better:
            return beside
    omega = best.model.motion(best.theta, data.time).omega
    band, floor = (float(omega.min()), float(omega.max())), ROUNDING * data.length
    elsewhere = over_elsewhere(whole, count, data.rate, band, colour, floor)
    return elsewhere if elsewhere.known else beside


def over_samples(recording: Recording, data: Data, best: Fit) -> SampleFit:
    """The best fit in the signal's own unit, its zero where the sensor has it; samples that do not count lie on it."""
    zero = float(np.mean(recording.values - data.length * data.x))
    model = data.length * best.model.signal(best.theta, data.time) + zero
    samples = np.where(data.kept, recording.values, model)
    return sample_fit(recording.time, samples, model, recording.rate, 2 * np.pi / data.cycle)
