"""Error budget: each curve's distance from the reference, split into parts that are measured separately.

    model:     omega / ref - 1  =  (omega / exact(A) - 1)  +  (exact(A) / ref - 1)  +  product of both
                                    truncation                 averaging

with ``exact(A)`` the undamped oscillator's frequency at the very amplitude that the model used.  An estimate's part
is the estimator's own bias: its error on a synthetic motion with the same harmonics, whose omega0(t) is known.
What the parts leave is the closure; it should be small beside the total, and is printed so that it can be judged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from ridgeback.compare.motion.error_norms import relative_error, rms
from ridgeback.compare.motion.estimate_curves import Outcome, along, attempt
from ridgeback.compare.motion.model_curves import LINEAR
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.reconstruction import KnownMotion
from ridgeback.compare.motion.results import AmplitudeSource, BudgetRow, Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.energy import is_linearly_damped

SLOW_FLOW = "multiple-scales"
"""How the names of slow flows begin."""


def budget(
    motion: Motion,
    curves: Iterable[Curve],
    outcomes: Iterable[Outcome],
    known: KnownMotion | None,
    progress: Callable[[str], None],
) -> tuple[BudgetRow, ...]:
    """One row per model, expansion and successful estimate; biases are read on the synthetic motion ``known``."""
    rows = [_model_row(motion, curve) for curve in curves if curve.kind != "estimate"]
    rows += [_estimate_row(motion, outcome, known, progress) for outcome in outcomes if outcome.curve is not None]
    return tuple(row for row in rows if row is not None)


def _interior(motion: Motion, curve: Curve, error: Array) -> Array:
    return np.where(motion.zone.interior(curve.time), error, np.nan)


def reference_error(motion: Motion) -> float:
    """Relative numerical error of the reference, rms over the interior."""
    return _relative_rms(motion, motion.interpolation_error)


def definition_spread(motion: Motion) -> float:
    """Relative spread between readings of omega0(t) from different events, rms over the interior."""
    return _relative_rms(motion, motion.spread)


def _relative_rms(motion: Motion, error: Array) -> float:
    inside = motion.zone.interior(motion.time)
    return rms(error[inside] / motion.reference(motion.time)[inside]) or 0.0


def _model_row(motion: Motion, curve: Curve) -> BudgetRow | None:
    total = _interior(motion, curve, relative_error(curve, motion.reference))
    whole = rms(total)
    if whole is None:
        return None
    exact = _exact_for(motion, curve)
    truncation = _interior(motion, curve, curve.omega / exact - 1)
    averaging = _interior(motion, curve, exact / motion.reference(curve.time) - 1)
    return BudgetRow(
        method=curve.name,
        label=curve.label,
        truncation=rms(truncation),
        averaging=rms(averaging),
        estimator=None,
        reference=reference_error(motion),
        definition=definition_spread(motion),
        total=whole,
        closure=rms(total - truncation - averaging) or 0.0,
        note="" if motion.has_backbone else "Averaging: the transient's distance from the limit cycle.",
    )


def _exact_for(motion: Motion, curve: Curve) -> Array:
    """Return the exact frequency at the amplitude that this curve was evaluated at.

    The slow flow and (3) hold mu^2 themselves, so they are held against the damped frequency.
    """
    if not motion.has_backbone:
        return np.full(curve.time.size, float(motion.known_omega[-1]))
    averaged = motion.averaged is not None and curve.amplitude is AmplitudeSource.AVERAGED
    exact = motion.averaged.omega if averaged and motion.averaged is not None else motion.exact_at_energy
    holds_damping = curve.name == LINEAR or curve.name.startswith(SLOW_FLOW)
    return (damped(motion, exact) if holds_damping else exact)[: curve.time.size]


# omega_c = sqrt(omega0^2 - mu^2), eq. (3) at the frequency of a finite amplitude
def damped(motion: Motion, omega: Array) -> Array:
    """The frequency under linear damping, to mu^2; the same where the damping is of another kind."""
    mu = motion.dynamics.damping
    if not mu or not is_linearly_damped(motion.dynamics, float(np.nanmax(np.abs(motion.energy_peak)))):
        return omega
    return np.sqrt(np.maximum(omega**2 - mu**2, 0.0))


def _estimate_row(
    motion: Motion, outcome: Outcome, known: KnownMotion | None, progress: Callable[[str], None]
) -> BudgetRow | None:
    curve = _sampled(outcome, motion.time)
    if curve is None:
        return None
    total = _interior(motion, curve, relative_error(curve, motion.reference))
    whole = rms(total)
    if whole is None:
        return None
    progress(f"bias of {curve.label}")
    own = None if known is None else estimator_error(motion, outcome, known)
    part = None if own is None else _interior(motion, curve, own)
    return BudgetRow(
        method=curve.name,
        label=curve.label,
        truncation=None,
        averaging=None,
        estimator=None if part is None else rms(part),
        reference=reference_error(motion),
        definition=definition_spread(motion),
        total=whole,
        closure=whole if part is None else (rms(total - part) or 0.0),
        note=_estimate_note(whole, definition_spread(motion), known is not None),
    )


def _sampled(outcome: Outcome, time: Array) -> Curve | None:
    """An estimate at the motion's samples, where every other curve is judged: crossings alone are few and uneven."""
    if outcome.curve is None or outcome.track is None:
        return None
    omega = along(outcome.track, time)
    return replace(outcome.curve, time=time, omega=omega, valid=np.isfinite(omega), standard_deviation=None, bias=None)


def _estimate_note(total: float, spread: float, known: bool) -> str:
    """Say when the distance is below what omega0(t) of a decay is defined to, and when the bias is not known."""
    below = "Closer to the crossings' reading than the turning points' reading is." * (total < spread)
    missing = "No synthetic motion with known frequency for this oscillator." * (not known)
    return f"{below} {missing}".strip()


def estimator_error(motion: Motion, outcome: Outcome, known: KnownMotion) -> Array | None:
    """Relative error of the same estimate on the known motion, at the samples; None where it fails there."""
    recipe = outcome.recipe.bare
    signal = known.velocity if recipe.velocity else known.signal
    again = attempt(recipe, signal, motion.trajectory.rate, deviations=False).curve
    if again is None:
        return None
    error = again.omega / np.interp(again.time, motion.time, known.omega) - 1
    return np.interp(motion.time, again.time, np.where(again.valid, error, np.nan))
