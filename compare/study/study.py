"""Accuracy-order study: the error of truncated expansions over order and amplitude.

Each expansion is derived once, to the highest order asked for, and truncated; the reference is exact
(``study.reference``).  A range of use ends at the *first* violation of the target: beyond it an error may
cross zero and look small by accident.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.study.derived import Undamped, without_damping
from ridgeback.compare.study.reference import (
    Reference,
    conservative_reference,
    enclosed_reference,
    integrated_reference,
    limit_cycle_reference,
)
from ridgeback.compare.study.results import Range, Study
from ridgeback.compare.study.truncations import METHODS, Method, usual_method
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.symbolic.enclosure.enclosure import separatrix
from ridgeback.symbolic.enclosure.half_wells import two_sided
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, V, Value

MAX_CELLS = 200_000
MAX_ORBITS = 100
"""Limit cycles, and families of orbits without an energy: each costs an integration, up to half a second."""
MAX_ENCLOSED = 2000
"""Forces with u': each amplitude costs one certified enclosure, some hundredths of a second."""


@dataclass(frozen=True)
class Need:
    """Smallest studied order that serves an amplitude; None when none does."""

    amplitude: float
    order: int | None


def study(
    oscillator: OscillatorLike,
    orders: Sequence[int],
    amplitudes: ArrayLike,
    *,
    method: str | None = None,
    values: Mapping[str, Value] | None = None,
    progress: Progress = silent,
) -> Study:
    """Error of ``omega0`` against the exact frequency over a grid of orders and amplitudes.

    Parameters
    ----------
    oscillator
        An oscillator, or anything that names one; any damping is left out: it is the undamped backbone that is studied.
    orders
        Highest powers of the variable that are kept, any order, each 0 or more.
    amplitudes
        Peak amplitudes of a conservative oscillator in the unit of u, or values of eps for a limit cycle; shape (n,),
        all positive.
    method
        Which series is truncated: ``lindstedt``, ``energy-integral`` or ``multiple-scales``; by default the first, and
        the energy integral for a force with a kink at rest or without a linear part.
    values
        Parameters to set first, by name.
    progress
        Told the share of the work that is done, and the step.

    Returns
    -------
    Study
        Grids ``[order, amplitude]`` with orders and amplitudes rising, the reference and its uncertainty.

    Raises
    ------
    InputError
        For orders below 0, amplitudes that are not positive or reach the separatrix, an unknown method, and a grid that
        is too large.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> result = study(find("pendulum"), (2, 4), [0.5, 1.0])
    >>> result.relative_error.shape, bool(abs(result.relative_error[1, 1]) < 1e-4)
    ((2, 2), True)
    """
    oscillator = as_oscillator(oscillator)
    rest = without_damping(oscillator.with_parameters(values) if values else oscillator)
    name = usual_method(rest.oscillator) if method is None else method
    return study_of(rest, orders, amplitudes, method=name, truncate=_method(name), progress=progress)


def study_of(
    rest: Undamped,
    orders: Sequence[int],
    amplitudes: ArrayLike,
    *,
    truncate: Method,
    method: str = "lindstedt",
    progress: Progress = silent,
) -> Study:
    """The same for an oscillator whose damping is left out already, ``truncate`` giving the series of ``method``."""
    bound = rest.oscillator
    kept, grid = _checked_orders(orders), _checked_amplitudes(amplitudes)
    _check_size(len(kept), grid.size, limit_cycle=bound.kind == "limit-cycle")
    progress(0.0, "exact frequencies")
    limit, exact = _reference(rest, grid)
    progress(0.5, f"expansion to order {max(kept)}")
    series = truncate(rest, kept, grid)
    return Study(
        system=bound.name,
        title=bound.title,
        method=method,
        variable=series.variable,
        amplitude_definition=series.amplitude,
        amplitude_unit=bound.unit if series.variable == "A" else "",
        orders=kept,
        amplitudes=_frozen(grid),
        omega=_frozen(series.omega),
        reference=_frozen(exact.omega),
        reference_error=_frozen(exact.relative_error),
        reference_name=exact.name,
        relative_error=_frozen(series.omega / exact.omega - 1),
        limit=limit,
        convergence_radius=series.radius,
        convergence_uncertainty=series.uncertainty,
        convergence_note=series.note,
        scale=series.scale,
    )


def ranges(result: Study, target: float) -> tuple[Range, ...]:
    """How far each order may be used: the amplitude at which its error first passes a target.

    Parameters
    ----------
    result
        A study.
    target
        Relative error that must hold at every studied amplitude up to the one returned, which is interpolated.

    Raises
    ------
    InputError
        For a target that is not positive.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> grid = np.linspace(0.1, 3.0, 30)
    >>> [round(item.up_to, 3) for item in ranges(study(find("pendulum"), (2, 8), grid), 1e-3)]
    [1.358, 2.214]
    """
    if not target > 0:
        raise InputError(f"target {target} is not positive; give a relative error such as 0.001")
    rising = np.argsort(result.amplitudes)
    grid, errors = result.amplitudes[rising], result.relative_error[:, rising]
    return tuple(
        Range(order, target, first_violation(grid, error, target))
        for order, error in zip(result.orders, errors, strict=True)
    )


def first_violation(grid: Array, relative_error: Array, target: float) -> float | None:
    """The amplitude at which an error first passes the target; the last studied one when it never does.

    Between two studied amplitudes ln |error| is interpolated over ln A, in which a truncated series is nearly
    straight.  Where the error changes sign between them, the last amplitude at which the target holds is returned.

    Parameters
    ----------
    grid
        Rising amplitudes, shape (M,).
    relative_error
        Signed relative errors there, shape (M,).
    target
        Size of the error that must hold.

    Returns
    -------
    float or None
        None when the first amplitude violates the target already.

    Examples
    --------
    >>> first_violation(np.array([1.0, 2.0, 3.0]), np.array([1e-5, 1e-4, 1e-2]), 1.0)
    3.0
    """
    error, sign = np.abs(relative_error), np.sign(relative_error)
    broken = np.flatnonzero(~(error <= target))
    if not broken.size:
        return float(grid[-1])
    first = int(broken[0])
    if first == 0:
        return None
    around = slice(max(0, first - 2), min(grid.size, first + 2))
    x, y = np.log(grid[around]), error[around]
    steady = np.isfinite(y).all() and (y > 0).all() and np.all(sign[around] == sign[first]) and x.size > 1
    if not steady:
        return float(grid[first - 1])
    curve = PchipInterpolator(x, np.log(y) - math.log(target))
    low, high = math.log(grid[first - 1]), math.log(grid[first])
    if curve(low) >= 0:
        return float(grid[first - 1])
    return float(math.exp(brentq(lambda x: float(curve(x)), low, high, xtol=1e-12)))


def order_needed(result: Study, target: float) -> tuple[Need, ...]:
    """Smallest studied order whose target holds at each amplitude *and at every smaller studied one*.

    The condition on the smaller amplitudes is the first-violation rule of :func:`ranges`: an error that passes
    through zero at one amplitude does not count as accuracy there.

    Parameters
    ----------
    result
        A study.
    target
        Relative error.

    Returns
    -------
    tuple of Need
        One per studied amplitude, rising.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [need.order for need in order_needed(study(find("pendulum"), (2, 4), [0.5, 1.0, 2.0]), 1e-4)]
    [2, 4, None]
    """
    reach = {item.order: item.up_to for item in ranges(result, target)}
    return tuple(Need(float(a), _smallest(reach, float(a))) for a in result.amplitudes)


def _smallest(reach: Mapping[int, float | None], amplitude: float) -> int | None:
    serving = [order for order, up_to in reach.items() if up_to is not None and amplitude <= up_to]
    return min(serving, default=None)


def _checked_orders(orders: Sequence[int]) -> tuple[int, ...]:
    if not isinstance(orders, Sequence | np.ndarray):
        raise InputError(f"orders {orders!r} are not a list of whole numbers; use orders such as (2, 4, 8)")
    if len(orders) == 0:
        raise InputError("no orders given; give at least one, such as 2,4,8")
    for order in orders:
        if isinstance(order, bool) or not isinstance(order, int | np.integer) or order < 0:
            raise InputError(f"order {order} is not a whole number from 0 up; use orders such as 2,4,8")
    return tuple(sorted({int(order) for order in orders}))


def _checked_amplitudes(amplitudes: ArrayLike) -> Array:
    grid = np.atleast_1d(np.asarray(amplitudes, dtype=np.float64))
    if grid.ndim != 1 or grid.size == 0:
        raise InputError(f"amplitudes of shape {grid.shape} are not a list of numbers; use e.g. 0.1:3.0:30")
    wrong = grid[~(np.isfinite(grid) & (grid > 0))]
    if wrong.size:
        raise InputError(f"amplitude {wrong[0]:g} is not a positive number; use amplitudes above 0")
    return np.unique(grid)


def _check_size(orders: int, amplitudes: int, *, limit_cycle: bool) -> None:
    if orders * amplitudes > MAX_CELLS:
        raise InputError(f"{orders} orders x {amplitudes} amplitudes exceed {MAX_CELLS} cells; use fewer of either")
    if limit_cycle and amplitudes > MAX_ORBITS:
        raise InputError(f"{amplitudes} values of eps exceed {MAX_ORBITS} orbits to be found; use at most {MAX_ORBITS}")


def _method(method: str) -> Method:
    if method not in METHODS:
        raise InputError(f"method {method!r} is not known to the study; use {' or '.join(METHODS)}")
    return METHODS[method]


def _reference(rest: Undamped, grid: Array) -> tuple[float | None, Reference]:
    oscillator = rest.oscillator
    if oscillator.kind == "limit-cycle":
        return None, limit_cycle_reference(oscillator, grid)
    dynamics = rest.dynamics
    if oscillator.substituted_force.has(V) or dynamics.restoring is None:  # f(u, 0) alone does not set the motion
        return _enclosed(oscillator, grid) if _has_well(oscillator) else (None, _integrated(dynamics, grid))
    _check_inside(dynamics, grid, math.inf if rest.limit is None else rest.limit)
    return rest.limit, conservative_reference(dynamics, grid)


def _has_well(oscillator: Oscillator) -> bool:
    """Whether an energy is known that certified enclosures can be made from."""
    try:
        two_sided(oscillator) if oscillator.by_sides else well_of(oscillator)
    except InputError:
        return False
    return True


def _integrated(dynamics: Dynamics, grid: Array) -> Reference:
    """The reference where no energy is known, one cycle integrated at each amplitude."""
    if grid.size > MAX_ORBITS:
        raise InputError(
            f"{grid.size} amplitudes exceed {MAX_ORBITS} orbits to be integrated; use at most {MAX_ORBITS}"
        )
    return integrated_reference(dynamics, grid)


def _enclosed(oscillator: Oscillator, grid: Array) -> tuple[float | None, Reference]:
    """The reference where u' is in the force, by certified enclosures."""
    if grid.size > MAX_ENCLOSED:
        raise InputError(f"{grid.size} amplitudes exceed {MAX_ENCLOSED} enclosures; use at most {MAX_ENCLOSED}")
    exact = enclosed_reference(oscillator, grid)
    try:
        limit = separatrix(oscillator).peak
    except InputError:  # balls need not decide how far the well goes; every amplitude here has its enclosure
        limit = None
    return (None if limit is None else float(limit)), exact


def _check_inside(dynamics: Dynamics, grid: Array, limit: float) -> None:
    beyond = grid[grid >= limit]
    if beyond.size:
        raise InputError(
            f"amplitude {beyond[0]:.12g} is at or beyond the separatrix of {dynamics.name} at {limit:.12g}; "
            f"use amplitudes below {limit:.6g}"
        )


def _frozen(values: Array) -> Array:
    copy = np.array(values, dtype=np.float64)
    copy.flags.writeable = False
    return copy
