"""Everything along one integrated motion: models, expansions and estimates against the cycle frequency."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.binding.heyoka import integrate_heyoka
from ridgeback.compare.motion.error_budget import budget
from ridgeback.compare.motion.error_norms import failure, score
from ridgeback.compare.motion.estimate_curves import NOTHING, RECIPES, WIGNER, Outcome, Recipe, estimates
from ridgeback.compare.motion.harmonics.overtones import FOLDING_DB, Overtones, folding_of, overtones
from ridgeback.compare.motion.model_curves import LOW_ORDERS, model_curves
from ridgeback.compare.motion.motion import CHECKED, Motion, Setting, integrate_motion
from ridgeback.compare.motion.paper_statements import Evidence, statements
from ridgeback.compare.motion.planes import spectrogram_image, wigner_plane
from ridgeback.compare.motion.reconstruction import KnownMotion, known_motion, reconstruct
from ridgeback.compare.motion.results import (
    Amplitudes,
    BudgetRow,
    Curve,
    Image,
    Integrator,
    MotionComparison,
    Score,
    SignedPlane,
)
from ridgeback.compare.motion.wigner_bias import wigner_bias
from ridgeback.compare.study.derived import Derived, derived_or_none
from ridgeback.numeric.tracking.track import Track

HIGH_ORDER = 20
TOP_MULTIPLE = 8
"""Highest multiple of the fundamental that the spectrograms show."""
WHOLE = 11
"""The whole band of the derivative is shown where half the rate is below this multiple: something is folded there."""
SIGNED_TOP = 2.3
"""The same for the Wigner distribution: fundamental, ridge and the cross term with the third harmonic."""


def compare_motion(
    chosen: Setting | Motion,
    *,
    derived: Derived | None = None,
    orders: Iterable[int] = (*LOW_ORDERS, HIGH_ORDER),
    recipes: Sequence[Recipe] = RECIPES,
    known_tracks: Mapping[str, Track] = NOTHING,
    progress: Progress = silent,
) -> MotionComparison:
    """Hold models, expansions and estimates of omega0(t) against the cycle frequency of an integrated motion.

    Parameters
    ----------
    chosen
        What to integrate, or the motion when it is integrated already.
    derived
        The expansion and the slow flow, which must reach the highest of ``orders``; derived here by default.
    orders
        Orders of the expansion that are drawn along the motion.
    recipes
        The estimates that take part; ``LEAN`` leaves out what models the whole signal.
    known_tracks
        Estimates of u by method, without bias, that are there already: those of a benchmark of the same motion.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    MotionComparison
        Complete; an estimate that fails is a score with its reason.

    Raises
    ------
    InputError
        For a motion that cannot be integrated or has too few cycles.

    References
    ----------
    L. Galleani and L. Cohen, whose figures 1 to 9 are the statements of the result.

    Examples
    --------
    >>> from ridgeback.compare.motion.motion import setting
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> swing = setting(find("damped-pendulum"), initial=(1.0, 0.0), duration=60.0, rate=4.0)
    >>> compare_motion(swing, orders=(2,)).scores[0].method
    'closed-form'
    """
    wanted = sorted(set(orders))
    progress(0.0, "integrating the motion twice")
    motion = integrate_motion(chosen) if isinstance(chosen, Setting) else chosen
    exact = derived_or_none(motion.setting.oscillator, max(wanted)) if derived is None else derived
    models = model_curves(motion, exact, orders=wanted)
    outcomes = estimates(motion, _within(progress, 0.2, 0.45), recipes, known_tracks)
    progress(0.45, "harmonics")
    tones = overtones(motion, outcomes)
    known = known_motion(motion)
    rows = budget(motion, models, outcomes, known, _within(progress, 0.55, 0.85))
    progress(0.85, "time-frequency planes and findings")
    return assemble(motion, models, outcomes, tones, rows, known)


def _within(progress: Progress, low: float, high: float) -> Callable[[str], None]:
    """Spread the labels of one stage over a part of the whole: half of what is left at each."""
    reached = low

    def step(label: str) -> None:
        nonlocal reached
        progress(reached, label)
        reached += 0.15 * (high - reached)

    return step


def assemble(
    motion: Motion,
    models: tuple[Curve, ...],
    outcomes: tuple[Outcome, ...],
    tones: Overtones,
    rows: tuple[BudgetRow, ...],
    known: KnownMotion | None,
) -> MotionComparison:
    """Put the parts together: scores, pictures and statements are derived from them here."""
    curves = (*models, *(o.curve for o in outcomes if o.curve is not None))
    scores = _scores(motion, models, outcomes)
    made = reconstruct(motion)
    bias = None if known is None else wigner_bias(motion, _named(curves, WIGNER), known)
    evidence = Evidence(motion, {c.name: c for c in curves}, {s.method: s for s in scores}, made, tones, bias)
    in_u, in_velocity, plane = _images(motion, curves)
    return MotionComparison(
        case=motion.setting.case(),
        time=motion.time,
        u=motion.trajectory.u,
        velocity=motion.trajectory.velocity,
        integrators=_integrators(motion),
        amplitudes=_amplitudes(motion),
        reference=motion.reference_curve,
        frequency_ends=(float(motion.known_omega[0]), float(motion.known_omega[-1])),
        interior=(motion.zone.lower, motion.zone.upper),
        curves=curves,
        scores=scores,
        budget=rows,
        reconstruction=made,
        spectrogram_u=in_u,
        spectrogram_velocity=in_velocity,
        wigner_u=plane,
        harmonics=tones.curves,
        statements=statements(evidence),
        folding=folding_of(motion, tones.of_velocity),
        wigner_bias=bias,
    )


def _named(curves: Iterable[Curve], name: str) -> Curve | None:
    return next((curve for curve in curves if curve.name == name), None)


def _scores(motion: Motion, models: tuple[Curve, ...], outcomes: tuple[Outcome, ...]) -> tuple[Score, ...]:
    scores = [score(curve, motion.reference, motion.zone) for curve in models]
    for outcome in outcomes:
        curve, recipe = outcome.curve, outcome.recipe
        if curve is None:
            scores.append(failure(recipe.name, recipe.label, outcome.failed))
        else:
            scores.append(score(curve, motion.reference, motion.zone))
    return tuple(scores)


def _integrators(motion: Motion) -> tuple[Integrator, ...]:
    run = motion.trajectory
    first = Integrator(run.method, run.rtol, run.evaluations)
    return first, Integrator(motion.precise.method, difference=motion.disagreement), *_third(motion)


def _third(motion: Motion) -> tuple[Integrator, ...]:
    """heyoka's solution beside the Taylor one, where that library is installed and takes the force."""
    case = motion.setting
    try:
        run = integrate_heyoka(case.oscillator, case.initial, duration=case.duration, rate=case.rate / CHECKED)
    except (OSError, InputError):
        return ()
    shared = min(run.u.size, motion.precise.u.size)
    apart = float(np.abs(run.u[:shared] - motion.precise.u[:shared]).max())
    return (Integrator(run.method, difference=apart),)


def _amplitudes(motion: Motion) -> Amplitudes:
    turnings = motion.trajectory.turnings
    note = "Definition peak: the positive turning point of the undamped motion with the energy of that instant."
    if not motion.has_backbone:
        note = "Envelope of the turning points: there is no potential, so no amplitude by energy."
    return Amplitudes(
        time=motion.time,
        energy=motion.energy_peak,
        averaged=None if motion.averaged is None else motion.averaged.peak,
        turning_time=turnings.time,
        turning_value=turnings.value,
        note=note,
    )


def _images(motion: Motion, curves: tuple[Curve, ...]) -> tuple[Image, Image, SignedPlane]:
    run = motion.trajectory
    fastest, slowest = float(motion.known_omega.max()), float(motion.known_omega.min())
    top, period = TOP_MULTIPLE * fastest, 2 * np.pi / slowest
    name, nyquist = motion.setting.case().symbol, np.pi * run.rate
    wigner, unit = _named(curves, WIGNER), motion.setting.time_unit
    return (
        spectrogram_image(run.u, run.rate, period=period, top=top, name=f"Spectrogram of {name}", unit=unit),
        spectrogram_image(
            run.velocity,
            run.rate,
            period=period,
            top=max(top, nyquist) if nyquist < WHOLE * fastest else top,
            name=f"Spectrogram of {name}′",
            unit=unit,
            floor_db=FOLDING_DB,
        ),
        wigner_plane(
            run.u,
            run.rate,
            top=SIGNED_TOP * fastest,
            name=f"Wigner distribution of {name}",
            overlays=(motion.reference_curve, *(() if wigner is None else (wigner,))),
            note="Between two components lies their cross term, which oscillates along time.",
        ),
    )
