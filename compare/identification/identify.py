"""The door: which oscillator made this decay?  Every candidate fitted, ranked, and told apart or not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import signal

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.identification.candidates import (
    BACKBONE,
    LAWS,
    NAMES,
    VAN_DER_POL,
    Model,
    backbone_model,
    models_of,
)
from ridgeback.compare.identification.fitting import Data, Fit, fit, prepare, refit
from ridgeback.compare.identification.ranking import CLEAR, CRITERIA, candidate, criterion, effective_number
from ridgeback.compare.identification.results import Candidate, Identification, MeasuredBackbone
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import Track

MOST_TERMS = 4
WORTH_TRYING = 9.0
"""Other damping laws are tried where the residual's variance is at most this many times the least one."""
PER_CYCLE = 24
"""Samples per cycle that are kept when a recording is thinned."""
ENOUGH = 6000
MOST_SAMPLES = 60_000
FEWEST_CYCLES = 6
POOR = 0.6
"""Share of the signal's rms that the best candidate may leave before the verdict says that none describes it."""
WINDOW_CYCLES = 4.0
"""Window of the local harmonic least squares that start the fits; their border values are one-sided fits."""


@dataclass(frozen=True)
class Ranked:
    """Fits in order of their criterion, with the criteria and the effective samples that they count."""

    fits: tuple[Fit, ...]
    scores: tuple[float, ...]
    effective: float
    failed: tuple[str, ...]

    @property
    def weights(self) -> Array:
        """Akaike weights."""
        raw = np.exp(-0.5 * (np.array(self.scores) - self.scores[0]))
        return np.asarray(raw / raw.sum())


def identify(
    recording: Recording,
    *,
    candidates: Iterable[str] = NAMES,
    laws: Sequence[str] = LAWS,
    kind: str = "bic",
    span: tuple[float, float] | None = None,
    progress: Progress = silent,
) -> Identification:
    """Fit every candidate to a decay and rank them; ``span`` limits the recording to times from .. to.

    ``kind`` is ``bic`` or ``aicc``.  Raises InputError for unknown names, a span without enough cycles, more samples
    than fit the budget, and when no candidate can be fitted.

    >>> t = np.arange(400) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=400)
    >>> decay = Recording(t, np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, 4.0, "u", "mm", "decay.csv", "")
    >>> found = identify(decay, candidates=("linear", "duffing-hardening"))
    >>> found.best.name, bool(abs(found.best.parameter("k").value - np.hypot(1.1, 0.01)) < 5e-4)
    ('linear', True)
    """
    names, laws = checked(candidates, laws, kind)
    used, notes = usable(recording, span)
    progress(0.0, "frequency track")
    track = local_track(used)
    data = prepare(used, track)
    cycles = float(data.time[-1]) / data.cycle
    if cycles < FEWEST_CYCLES:
        raise InputError(f"{used.source}: {cycles:.1f} cycles are too few to tell oscillators apart; give 6 or more")
    ranked = rank(data, names, laws, kind, progress)
    return assembled(used, data, ranked, kind, (*used.notes, *notes, *data.measured.notes), track.method)


def local_track(recording: Recording) -> Track:
    """The fundamental's track by harmonic least squares in windows of four cycles; auto where they hold too little."""
    x, rate, start = recording.values, recording.rate, float(recording.time[0])
    lag = WINDOW_CYCLES * samples_per_cycle(recording) / rate
    try:
        return estimate(x, rate, method="harmonic-least-squares", lag_seconds=lag, start=start, bias=False)
    except InputError:
        return estimate(x, rate, start=start, bias=False)


def samples_per_cycle(recording: Recording) -> float:
    """Samples in one cycle of the strongest component."""
    x = recording.values - recording.values.mean()
    spectrum = np.abs(np.fft.rfft(x * np.hanning(x.size)))
    return float(x.size / max(1, int(spectrum.argmax())))


def checked(candidates: Iterable[str], laws: Sequence[str], kind: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The names, once each, when all are known.

    >>> checked(["linear", "linear"], ["linear"], "aic")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: criterion 'aic' is unknown; use one of bic, aicc
    """
    names = tuple(dict.fromkeys(candidates))
    for what, given, known in (("candidate", names, NAMES), ("damping law", tuple(laws), LAWS)):
        wrong = [name for name in given if name not in known]
        if wrong or not given:
            said = f"{what} {wrong[0]!r} is unknown" if wrong else f"no {what} is named"
            raise InputError(f"{said}; use one of {', '.join(known)}")
    if kind not in CRITERIA:
        raise InputError(f"criterion {kind!r} is unknown; use one of {', '.join(CRITERIA)}")
    return names, tuple(law for law in LAWS if law in laws)


def usable(recording: Recording, span: tuple[float, float] | None) -> tuple[Recording, tuple[str, ...]]:
    """The part asked for, thinned where it has far more samples per cycle than a fit needs."""
    notes: list[str] = []
    if span is not None:
        keep = (recording.time >= span[0]) & (recording.time <= span[1])
        if np.count_nonzero(keep) < 16:
            raise InputError(
                f"{recording.source}: {np.count_nonzero(keep)} samples lie within {span[0]:g} to {span[1]:g}; "
                f"the recording runs from {recording.time[0]:g} to {recording.time[-1]:g}"
            )
        recording = part_of(recording, recording.time[keep], recording.values[keep], recording.rate)
        notes.append(f"Only times from {span[0]:g} to {span[1]:g} were used.")
    factor = thinning(recording)
    if factor > 1:
        values = signal.decimate(recording.values, factor, ftype="fir", zero_phase=True)
        recording = part_of(recording, recording.time[::factor], values, recording.rate / factor)
        notes.append(f"Every {factor}th sample was used, after a low-pass filter.")
    if recording.values.size > MOST_SAMPLES:
        raise InputError(
            f"{recording.source}: {recording.values.size} samples are over the budget of {MOST_SAMPLES} for fits; "
            f"use a span of {MOST_SAMPLES / recording.rate:.4g} time units or less"
        )
    return recording, tuple(notes)


def part_of(recording: Recording, time: Array, values: Array, rate: float) -> Recording:
    """The same recording with other samples."""
    return Recording(
        time, values, rate, recording.name, recording.units, recording.source, recording.sha256, recording.notes
    )


def thinning(recording: Recording) -> int:
    """Factor by which samples may be thinned and still leave PER_CYCLE in each cycle of the strongest component."""
    if recording.values.size <= ENOUGH:
        return 1
    return max(1, min(int(samples_per_cycle(recording) / PER_CYCLE), math.ceil(recording.values.size / ENOUGH)))


def rank(data: Data, names: tuple[str, ...], laws: tuple[str, ...], kind: str, progress: Progress) -> Ranked:
    """Fit every candidate with the first damping law, the promising ones with the others, and order them."""
    first, failed = [], []
    for i, name in enumerate(names):
        progress(0.1 + 0.6 * i / len(names), name)
        try:
            first.append(best_with(name, laws[0], data))
        except InputError as error:
            failed.append(str(error))
    if not first:
        raise InputError("no candidate could be fitted: " + "; ".join(failed))
    least = min(f.sum_of_squares for f in first)
    kept = []
    for i, found in enumerate(first):
        progress(0.7 + 0.2 * i / len(first), f"{found.model.name}, other damping laws")
        tried = polished(found, laws[1:], data) if found.sum_of_squares <= WORTH_TRYING * least else [found]
        kept.append(min(tried, key=lambda f: criterion(f, f.residual.size, kind)))
    best = min(kept, key=lambda f: criterion(f, f.residual.size, kind))
    effective = min(float(data.x.size), effective_number(best.residual) + best.model.count)
    scored = sorted(((criterion(f, effective, kind), i) for i, f in enumerate(kept)))
    return Ranked(tuple(kept[i] for _, i in scored), tuple(s for s, _ in scored), effective, tuple(failed))


def best_with(name: str, law: str, data: Data) -> Fit:
    """The fit of a candidate; a polynomial backbone with as many terms as BIC asks for."""
    if name != BACKBONE:
        return fit(models_of(name, law), data)
    fits = [fit(backbone_model(terms, law), data) for terms in range(1, MOST_TERMS + 1)]
    return min(fits, key=lambda f: criterion(f, f.residual.size, "bic"))


def polished(found: Fit, laws: tuple[str, ...], data: Data) -> list[Fit]:
    """The fit to rounding, and the same class with other damping laws, started from it."""
    fine = refit(found.model, data, found.theta)
    if found.model.name == VAN_DER_POL:
        return [fine]
    tried = [fine]
    for law in laws:
        model = with_law(found, law)
        if model.size > found.model.size:
            theta = np.insert(fine.theta, 1 + found.model.size, 0.05 * abs(fine.theta[found.model.size]))
            tried.append(refit(model, data, theta))
        else:
            tried.append(fit(model, data))
    return tried


def with_law(found: Fit, law: str) -> Model:
    """The model of a fit with another damping law."""
    if found.model.name == BACKBONE:
        return backbone_model(found.model.size - found.model.rates - 2, law)
    return models_of(found.model.name, law)


def assembled(
    recording: Recording, data: Data, ranked: Ranked, kind: str, notes: tuple[str, ...], method: str
) -> Identification:
    """Put the ranking into its result."""
    best, total = ranked.scores[0], float(np.sum(np.exp(-0.5 * (np.array(ranked.scores) - ranked.scores[0]))))
    candidates = tuple(
        candidate(f, data, recording.units, score, best, total)
        for f, score in zip(ranked.fits, ranked.scores, strict=True)
    )
    near = tuple(c.name for c in candidates if c.delta < CLEAR)
    measured = data.measured
    return Identification(
        source=recording.source,
        column=recording.name,
        unit=recording.units,
        rate=recording.rate,
        samples=data.x.size,
        effective_samples=ranked.effective,
        criterion_name=kind,
        candidates=candidates,
        data=MeasuredBackbone(
            measured.curve_amplitude,
            measured.curve_omega,
            measured.curve_omega_sd,
            measured.curve_damping,
            measured.curve_damping_sd,
        ),
        verdict=verdict(candidates, near, kind, data),
        indistinguishable=near,
        settings={"track": method, "sha256": recording.sha256, "length": data.length, "cycle": data.cycle},
        notes=notes,
        failed=ranked.failed,
    )


def verdict(candidates: tuple[Candidate, ...], near: tuple[str, ...], kind: str, data: Data) -> str:
    """Which class, how sure, and which others cannot be told apart from it."""
    best, name = candidates[0], kind.upper() if kind == "bic" else "AICc"
    share = best.residual / (data.length * float(np.std(data.x)))
    text = f"{best.title}, damping {best.damping_law}"
    if share > POOR:
        text = "No candidate describes this recording; the nearest is " + text
    if best.name == BACKBONE and len(near) == 1:
        text += ": no equation among the candidates does as well"
    others = [c for c in candidates[1:] if c.name in near]
    if others:
        listed = ", ".join(f"{c.title} ({name} {c.delta:.1f} higher)" for c in others)
        text += f"; the data cannot tell it apart from: {listed}"
    elif len(candidates) > 1:
        second = candidates[1]
        text += f"; next comes {second.title}, {name} {second.delta:.4g} higher"
    text += f". What it leaves unexplained is {share:.2g} of the signal's rms"
    return text + "."
