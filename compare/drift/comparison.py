"""Integrate a motion under drifting parameters and hold omega0 by the action against its cycle frequency."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.binding.drift import bind_drift
from ridgeback.compare.drift.results import DriftComparison
from ridgeback.compare.motion.error_norms import zones
from ridgeback.compare.motion.motion import CHECKED, setting
from ridgeback.compare.motion.planes import spectrogram_image
from ridgeback.compare.motion.results import AmplitudeSource, Curve
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.integration import Drift
from ridgeback.numeric.motion.trajectory import AUTO, Trajectory, integrate, sample_times
from ridgeback.numeric.orbits.adiabatic import SLOW, AdiabaticMotion, adiabatic_motion
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.symbolic.flow.drift import Drifting, drifting
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator

SECOND = "LSODA"
"""The second integrator, of another kind than the first."""
TOP = 3.5
"""Multiple of the fundamental up to which the plane is shown."""


def compare_drift(
    oscillator: OscillatorLike,
    laws: Mapping[str, str],
    *,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    rate: float | None = None,
    time_unit: str = "",
    method: str = AUTO,
    progress: Progress = silent,
) -> DriftComparison:
    """Hold omega0(J; p(t)) against the integrated motion under p(t).

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator; a parameter that drifts needs no value.
    laws : mapping of str to str
        For each drifting parameter an expression in t: ``{"L": "1+0.01*t"}``.
    initial, duration, rate, time_unit : optional
        As for :func:`ridgeback.compare.motion.motion.setting`.
    method : str
        SciPy's integrator of the motion.
    progress : callable
        Told the share of the work that is done, and the step.

    Returns
    -------
    DriftComparison
        Both frequencies with their error, and the error that is expected to leading order.

    Raises
    ------
    InputError
        For laws that cannot be read or stop the oscillation, an oscillator without a potential, and a motion that
        cannot be integrated or has too few cycles.

    References
    ----------
    V. I. Arnold, Mathematical Methods of Classical Mechanics (1989), section 52.

    Examples
    --------
    >>> found = compare_drift("linear", {"k": "1 + t/100"}, duration=100.0, rate=4.0)
    >>> found.max_error < 1.02 * found.expected_error < 1e-4
    True
    """
    own = drifting(as_oscillator(oscillator), laws)
    chosen = setting(own.start, initial=initial, duration=duration, rate=rate, time_unit=time_unit)
    dynamics, drift = bind_drift(own, chosen.duration)
    require_potential(own, dynamics)
    time = np.minimum(sample_times(chosen.duration, chosen.rate), chosen.duration)
    found = adiabatic_motion(dynamics, drift, chosen.initial, time)
    run = integrate(
        dynamics,
        chosen.initial,
        duration=chosen.duration,
        rate=chosen.rate,
        method=method,
        drift=drift,
        progress=progress,
    )
    reference = _reference(run, dynamics)
    return DriftComparison(
        case=chosen.case(),
        laws=own.text,
        trajectory=run,
        adiabatic=found,
        reference=reference,
        frozen=averaged_decay(dynamics, chosen.initial, run.time).omega,
        interior=zones(0.0, float(run.time[-1])),
        disagreement=_disagreement(dynamics, drift, run),
        spectrogram=spectrogram_image(
            run.u,
            run.rate,
            period=2 * np.pi / float(found.omega.min()),
            top=min(TOP * float(found.omega.max()), np.pi * run.rate),
            name=f"Spectrogram of {chosen.case().symbol}",
            unit=chosen.time_unit,
            overlays=(by_action(found),),
        ),
    )


def require_potential(own: Drifting, dynamics: Dynamics) -> None:
    """Raise InputError for an oscillator that has no action to be conserved."""
    if own.potential is None or dynamics.restoring is None:
        why = own.start.potential_note or "a limit cycle is not set by its potential"
        raise InputError(
            f"{own.start.name}: no action is conserved along a drift ({why}); only an oscillator with a potential and "
            "losses odd in u' has one"
        )


def by_action(found: AdiabaticMotion) -> Curve:
    """omega0(J; p(t)) as a curve."""
    return Curve(
        "adiabatic",
        "omega0 by the action",
        "model",
        found.time,
        found.omega,
        np.isfinite(found.omega),
        bias=found.expected_error * found.omega,
        note="omega0(J; p(t)), J conserved but for the averaged losses; no integration of the equation.",
        amplitude=AmplitudeSource.AVERAGED,
    )


def _reference(run: Trajectory, dynamics: Dynamics) -> Curve:
    cycles = cycle_frequency(run, dynamics=dynamics)
    omega = cycles.at(run.time)
    return Curve(
        "reference",
        "cycle frequency",
        "reference",
        run.time,
        omega,
        np.isfinite(omega),
        standard_deviation=cycles.interpolation_error_at(run.time),
        note="From the event-located zero crossings of the solution integrated with p(t) in the equation.",
    )


def _disagreement(dynamics: Dynamics, drift: Drift, run: Trajectory) -> float:
    """Largest difference of u from a second integrator, at every eighth sample."""
    other = integrate(dynamics, run.initial, duration=run.duration, rate=run.rate / CHECKED, method=SECOND, drift=drift)
    shared: Array = run.u[::CHECKED][: other.u.size]
    return float(np.max(np.abs(shared - other.u[: shared.size])))


def sentences(found: DriftComparison) -> tuple[str, ...]:
    """What was found, in words."""
    slow = f"omega0 changes by at most {found.rate:.2g} of itself in a radian"
    told = [f"{slow}." if found.adiabatic.is_slow else f"{slow}, more than {SLOW:g}: this is no slow drift."]
    if found.max_error is not None:
        told.append(
            f"omega0 by the action errs by {found.rms_error:.2g} rms and {found.max_error:.2g} at most, against the "
            "cycle frequency of the integrated motion."
        )
    if found.expected_error is not None:
        told.append(
            f"Expected is {found.expected_error:.2g}: of second order in the rates of drift and damping, exact to "
            "leading order for a linear oscillator."
        )
    if found.frozen_error is not None:
        told.append(f"The parameters of t = 0 throughout would err by {found.frozen_error:.2g}.")
    return tuple(told)
