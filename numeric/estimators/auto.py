"""Which method, over which window: chosen by the error that each should have on a model of the signal at hand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.global_harmonics import spline_error
from ridgeback.numeric.estimators.window_choice import Window, best_window, expected_error, lengths
from ridgeback.numeric.harmonics.noise import Level, peak_deviation
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.harmonics.window_steps import Shape
from ridgeback.numeric.signal.windows import window
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.curvature_bias import curvature_bias
from ridgeback.numeric.tracking.request import Request

AS_GOOD = 4.0
"""Expected errors that differ by less than this share count as equal; the first of the candidates is taken then: a
model of the whole record knows the error of everything that is measured along it."""
SHORT = 0.4
"""Share of the record from which on a window leaves too little between the borders for a peak."""
NOTHING = 1e-9
"""A relative error that is none."""


@dataclass(frozen=True)
class Candidate:
    """A method with its request, the relative rms error expected of it, and its name in words."""

    method: str
    request: Request
    expected: float
    words: str


def for_least_squares(request: Request) -> Request:
    """Settle the scope of harmonic least squares, and the window and the degree where it is local.

    Without a scope: local where a window was asked for, else global, else local again where no global model settles.
    """
    scope = request.options.scope
    if scope is Scope.GLOBAL or (scope is None and not request.lag_given):
        try:
            return with_plan(request, scope=Scope.GLOBAL)
        except InputError as error:
            if scope is Scope.GLOBAL:
                raise
            why = f"local, over {request.plan.lag_seconds:.4g}: {error}"
            return replace(request, plan=replace(request.plan, why=why))
    return request if request.lag_given else in_best_window(request)


def in_best_window(request: Request) -> Request:
    """The request over the window that has the least expected error; unchanged where the signal has no model."""
    try:
        models = request.models
    except InputError:
        return request
    found = best_window(models.best, request.signal.cycle, models.best.multiples, request.margin)
    return request if found is None else with_window(request, found)


def with_window(request: Request, found: Window) -> Request:
    """The request with a window and a degree of the phase in it."""
    return with_plan(request, lag_seconds=2.0 * found.half / request.signal.rate, phase_degree=found.degree)


def with_plan(request: Request, **changes: Any) -> Request:
    """The request with another plan, and with the models that belong to the plan so far."""
    return replace(request, plan=replace(request.plan, **changes), known_models=request.models)


def for_auto(request: Request) -> tuple[str, Request]:
    """The method, and its request with the reason in it."""
    try:
        candidates = list(candidates_of(request))
    except InputError as error:
        if request.plan.lag_seconds * request.signal.rate > SHORT * request.signal.x.size:
            why = f"harmonic least squares over {request.plan.lag_seconds:.4g}: there is no model of the whole: {error}"
            return "harmonic-least-squares", replace(request, plan=replace(request.plan, why=why))
        why = f"pseudo-Wigner, because harmonic least squares cannot: {error}"
        return "pseudo-wigner", replace(request, plan=replace(request.plan, why=why))
    least = min(candidate.expected for candidate in candidates)
    best = next(candidate for candidate in candidates if candidate.expected <= (1.0 + AS_GOOD) * least + NOTHING)
    listed = ", ".join(f"{c.words} {c.expected:.2g}" for c in candidates)
    why = f"{best.words}: relative rms errors expected on a model of the signal: {listed}"
    return best.method, with_plan(best.request, why=why)


def candidates_of(request: Request) -> Iterator[Candidate]:
    """Harmonic least squares, global and local, and the pseudo-Wigner peak, each over its best window.

    The peak gives nothing within half a window of either end: its error counts per share of the record that it covers.
    """
    models = request.models
    known = replace(request, known_models=models)
    if not request.lag_given:
        whole = with_plan(known, scope=Scope.GLOBAL)
        yield Candidate(
            "harmonic-least-squares", whole, spline_error(known), "harmonic least squares of the whole record"
        )
    halves = [request.half] if request.lag_given else list(lengths(models.best, request.signal.cycle))
    shape = Shape(models.best.multiples)
    if request.lag_given and 2 * request.half + 1 >= 1.5 * shape.size:
        expected = expected_error(models.best, request.half, shape.phase_degree, request.margin)
        yield Candidate(
            "harmonic-least-squares", known, expected, f"harmonic least squares over {request.plan.lag_seconds:.3g}"
        )
    elif (local := best_window(models.best, request.signal.cycle, models.best.multiples, request.margin)) is not None:
        words = f"harmonic least squares over {2 * local.half / request.signal.rate:.3g}"
        yield Candidate("harmonic-least-squares", with_window(known, local), local.expected, words)
    if halves:
        half = min(halves, key=lambda half: peak_error(models.best, request, half))
        peak = with_plan(known, lag_seconds=2.0 * half / request.signal.rate)
        words = f"pseudo-Wigner over {peak.plan.lag_seconds:.3g}"
        covered = max(1.0 - peak.plan.lag_seconds * request.signal.rate / request.signal.x.size, 1e-3)
        yield Candidate("pseudo-wigner", peak, peak_error(models.best, request, half) / covered, words)


def peak_error(model: SplineModel, request: Request, half: int) -> float:
    """Relative rms error that a pseudo-Wigner peak should have: its curvature bias and its noise."""
    omega, amplitude = model.tone(1)
    h = window(request.options.lag_window, half)[half:]
    bias = curvature_bias(model.time, omega, np.linspace(0.0, 2.0 * half / request.signal.rate, half + 1), h)
    level = Level(np.maximum(np.abs(amplitude), 1e-3 * np.abs(amplitude).max()), model.noise)
    noise = peak_deviation(level, request.signal.rate, h)
    inner = slice(request.margin, omega.size - request.margin)
    return float(np.sqrt(np.mean(((bias**2 + noise**2) / omega**2)[inner])))
