"""``ridgeback.simulate`` and ``energy_terms``: a trajectory by any of the integrators, and the energy along it."""

from __future__ import annotations

from collections.abc import Mapping

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen
from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.drift import bind_drift
from ridgeback.compare.binding.heyoka import integrate_heyoka
from ridgeback.interface.orbits import bound
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.taylor import integrate_taylor
from ridgeback.numeric.motion.trajectory import METHODS, Trajectory, integrate
from ridgeback.numeric.orbits import energy
from ridgeback.numeric.orbits.energy import EnergyTerms
from ridgeback.symbolic.flow.drift import drifting
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value

ALL = (*METHODS, "taylor", "heyoka")
DIGITS = 30


def simulate(
    oscillator: OscillatorLike | Dynamics,
    initial: tuple[float, float] | None = None,
    *,
    duration: float = 20.0,
    rate: float = 64.0,
    method: str = "DOP853",
    digits: int | None = None,
    rtol: float | None = None,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    drift: Mapping[str, str] | None = None,
    progress: Wanted = None,
) -> Trajectory:
    """Integrate the equation of motion.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq, sympy.Expr or Dynamics
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes, or one that is bound to numbers.
    initial : (float, float), optional
        The state (u, u') at time 0, in the unit of u and that per time unit; by default the oscillator's own.
    duration : float
        Time to integrate over.
    rate : float
        Samples per time unit.
    method : {"DOP853", "auto", "RK45", "Radau", "BDF", "LSODA", "taylor", "heyoka"}
        The integrator: one of SciPy's (``auto`` turns to Radau where the equation is stiff), a Taylor method at any
        precision, or heyoka where it is installed.
    digits : int, optional
        Digits that ``taylor`` works with (30 by default).
    rtol : float, optional
        Relative tolerance of SciPy's methods (1e-12 by default).
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    drift : mapping of str to str, optional
        Parameters that change with the time t, such as ``{"L": "1+0.01*t"}``, by SciPy's methods;
        :func:`ridgeback.drift` holds omega0 by the action against such a motion.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.  heyoka tells nothing.

    Returns
    -------
    Trajectory
        Samples ``time``, ``u``, ``velocity``, and located zero crossings and turning points.

    Raises
    ------
    InputError
        For a parameter without a value, a state that is not usable, a motion that leaves the well, work beyond the
        budget.
    OSError
        For ``heyoka`` where it is not installed.

    Examples
    --------
    >>> run = simulate("pendulum", (0.5, 0.0), duration=10.0)
    >>> run.u.size, round(float(run.crossings.time[0]), 4)
    (641, 1.5957)
    """
    name = chosen(method, ALL, "method")
    if digits is not None and name != "taylor":
        raise InputError(f"digits belong to method 'taylor'; {name} works in double precision")
    if rtol is not None and name not in METHODS:
        raise InputError(f"rtol belongs to {', '.join(METHODS)}, not to {name}; leave it out")
    if drift:
        return drifted(oscillator, drift, initial, duration, rate, name, rtol, parameters, about, progress)
    if isinstance(oscillator, Dynamics):
        with showing(progress) as told:
            return of_dynamics(oscillator, initial, duration, rate, name, digits, rtol, told)
    system = as_oscillator(oscillator, parameters=parameters, about=about)
    start = system.initial if initial is None else initial
    if name == "heyoka":
        return integrate_heyoka(system, start, duration=duration, rate=rate)
    with showing(progress) as told:
        return of_dynamics(bind(system), start, duration, rate, name, digits, rtol, told)


def drifted(
    oscillator: OscillatorLike | Dynamics,
    laws: Mapping[str, str],
    initial: tuple[float, float] | None,
    duration: float,
    rate: float,
    method: str,
    rtol: float | None,
    parameters: Mapping[str, Value] | None,
    about: str | None,
    progress: Wanted,
) -> Trajectory:
    """Integrate an oscillator some of whose parameters change with time."""
    if isinstance(oscillator, Dynamics):
        raise InputError("an oscillator that is bound to numbers has no parameters left to drift; give it unbound")
    if method not in METHODS:
        raise InputError(f"{method} follows no drift; use one of {', '.join(METHODS)}")
    own = drifting(as_oscillator(oscillator, parameters=parameters, about=about), laws)
    dynamics, law = bind_drift(own, duration)
    start = own.start.initial if initial is None else initial
    tolerance = 1e-12 if rtol is None else rtol
    with showing(progress) as told:
        return integrate(
            dynamics, start, duration=duration, rate=rate, method=method, rtol=tolerance, drift=law, progress=told
        )


def of_dynamics(
    dynamics: Dynamics,
    initial: tuple[float, float] | None,
    duration: float,
    rate: float,
    method: str,
    digits: int | None,
    rtol: float | None,
    told: Progress,
) -> Trajectory:
    """Integrate an oscillator that is bound to numbers."""
    if initial is None:
        raise InputError("an oscillator that is bound to numbers has no initial state of its own; give initial=(u, u')")
    if method == "heyoka":
        raise InputError("heyoka forms its own derivatives; give the oscillator itself rather than its dynamics")
    if method == "taylor":
        return integrate_taylor(dynamics, initial, duration=duration, rate=rate, digits=digits or DIGITS, progress=told)
    tolerance = 1e-12 if rtol is None else rtol
    return integrate(dynamics, initial, duration=duration, rate=rate, method=method, rtol=tolerance, progress=told)


def energy_terms(
    oscillator: OscillatorLike | Dynamics, trajectory: Trajectory, *, parameters: Mapping[str, Value] | None = None
) -> EnergyTerms:
    """Return the terms of the energy balance along a trajectory: E_k + E_p + E_d = E_k(0).

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq, sympy.Expr or Dynamics
        The oscillator that the trajectory is of, in any of the forms that :func:`ridgeback.oscillator` takes.
    trajectory : Trajectory
        The motion.
    parameters : mapping of str to number or str, optional
        Values of parameters, those that the trajectory was made with.

    Returns
    -------
    EnergyTerms
        Kinetic, potential, dissipated and mechanical energy per unit of mass, and what the balance misses (the error of
        integrator and quadrature together), each of shape (N,), in the unit of u'^2.

    Raises
    ------
    InputError
        For an oscillator without a potential, and for a parameter without a value.

    Examples
    --------
    >>> run = simulate("damped_pendulum", (1.0, 0.0), duration=10.0)
    >>> terms = energy_terms("damped_pendulum", run)
    >>> bool(terms.dissipated[-1] > 0), bool(abs(terms.balance).max() < 1e-11)
    (True, True)
    """
    return energy.energy_terms(bound(oscillator, parameters), trajectory)
