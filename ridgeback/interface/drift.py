"""``ridgeback.drift``: a motion under slowly drifting parameters, and omega0(t) by the action beside it."""

from __future__ import annotations

from collections.abc import Mapping

from ridgeback.common.names import chosen
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.drift.comparison import compare_drift
from ridgeback.compare.drift.results import DriftComparison
from ridgeback.numeric.motion.trajectory import METHODS
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value


def drift(
    oscillator: OscillatorLike,
    laws: Mapping[str, str],
    initial: tuple[float, float] | None = None,
    *,
    duration: float | None = None,
    rate: float | None = None,
    method: str = "auto",
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    progress: Wanted = None,
) -> DriftComparison:
    """Hold omega0 at the conserved action against a motion whose parameters drift.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes; what drifts needs no value.
    laws : mapping of str to str
        For each drifting parameter an expression in the time t: ``{"L": "1+0.01*t"}``.
    initial : (float, float), optional
        The state (u, u') at time 0; by default the oscillator's own.
    duration : float, optional
        Time to integrate over; by default forty natural periods of time 0.
    rate : float, optional
        Samples per time unit; by default 32 in such a period.
    method : str
        SciPy's integrator; ``auto`` is DOP853, or Radau where the equation is stiff.
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    DriftComparison
        ``adiabatic.omega`` beside ``reference.omega``, both in rad per time unit, their relative ``error``, and the
        ``expected_error`` of second order in the rate.

    Raises
    ------
    InputError
        For laws that cannot be read or stop the oscillation, an oscillator without a potential, and a motion that
        leaves the well or has too few cycles.

    References
    ----------
    V. I. Arnold, Mathematical Methods of Classical Mechanics (1989), section 52.

    Examples
    --------
    >>> swing = drift("x'' + 9.81/L*sin(x) = 0", {"L": "1+0.01*t"}, (1.0, 0.0), duration=40.0, rate=8.0)
    >>> swing.max_error < 2e-6, swing.frozen_error > 0.1
    (True, True)
    """
    with showing(progress) as told:
        return compare_drift(
            as_oscillator(oscillator, parameters=parameters, about=about),
            laws,
            initial=initial,
            duration=duration,
            rate=rate,
            method=chosen(method, METHODS, "method"),
            progress=told,
        )
