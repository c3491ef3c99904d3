"""Bind an oscillator to numbers: the one place where a SymPy equation becomes functions of floats.

The parameters enter as exact rationals (12.566370614359172 means that decimal), so that float64 and mpmath see the
same equation; each constant is rounded once, on entering the arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np
import sympy
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.closures import ARRAY, PRECISE, SCALAR
from ridgeback.compare.binding.taylor_jet import force_jet
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics, duffing_frequency, pendulum_frequency
from ridgeback.numeric.motion.events import Switches
from ridgeback.symbolic.arithmetic.closures import evaluator
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.enclosure.separatrix import ends_of
from ridgeback.symbolic.flow.averaged_losses import undamped
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.elliptic import cubic_force, sine_force
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V, Value
from ridgeback.symbolic.systems.sides import (
    is_kinked,
    kinked_at_rest,
    kinks_of,
    place_of,
    stops_of,
    without_velocity,
)
from ridgeback.symbolic.systems.structure import dissipative_names

Vectorised = Callable[[ArrayLike], Array]


def bind(oscillator: OscillatorLike, *, values: Mapping[str, Value] | None = None) -> Dynamics:
    """Turn an oscillator into the functions that the numeric side works with.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes.
    values : mapping of str to number or str, optional
        Values of parameters by name, exact as they are written.

    Returns
    -------
    Dynamics
        Force, potential, frequency and Taylor coefficients as functions of floats, arrays and mpmath numbers.

    Raises
    ------
    InputError
        For an unknown parameter, for one that has no number, and for a function that has no float, NumPy or mpmath
        form.

    Examples
    --------
    >>> dynamics = bind("pendulum", values={"k": 2})
    >>> dynamics.natural_frequency, dynamics.force(0.0, 1.0)
    (2.0, 0.0)
    """
    oscillator = as_oscillator(oscillator)
    return _bound(oscillator.with_parameters(values) if values else oscillator)


@lru_cache(maxsize=16)
def _bound(bound: Oscillator) -> Dynamics:
    """The functions of one oscillator, which a report asks for several times."""
    _check_numbers(bound)
    try:
        return _in_doubles(bound)
    except OverflowError:
        raise InputError(
            f"{bound.name}: a coefficient of the force is beyond the largest double, 1.8e308; use units in which the "
            "parameters are of order 1"
        ) from None


def _in_doubles(bound: Oscillator) -> Dynamics:
    force, potential = bound.substituted_force, bound.substituted_potential
    potential = potential if bound.is_linear_at_rest else None  # what is made of one supposes a natural frequency
    scalar, precise = evaluator(force, (U, V), SCALAR), evaluator(force, (U, V), PRECISE)
    switches = switches_of(force) if is_kinked(force) else None
    return Dynamics(
        name=bound.name,
        force=lambda u, v: float(scalar((u, v))),
        natural_frequency=_time_scale(bound),
        damping=_linear_damping(force),
        potential=None if potential is None else _vectorised(potential),
        restoring=None if potential is None else _vectorised(without_velocity(force)),
        closed_form=None if potential is None else closed_form(without_velocity(force)),
        precise_force=lambda u, v: precise((u, v)),
        jet=None if switches else force_jet(force),
        switches=switches,
        ends=None if potential is None or switches else lru_cache(lambda: _ends(bound)),
    )


def _ends(oscillator: Oscillator) -> tuple[float, float, float] | None:
    """Where the undamped oscillation ends, left, right and by its peak; None where balls cannot decide."""
    try:
        found = ends_of(undamped(oscillator, dissipative_names(oscillator.force)))
    except InputError:
        return None
    return found.left, found.right, found.peak


def _time_scale(oscillator: Oscillator) -> float:
    """k, or without a linear force omega0 at the peak amplitude that the oscillator's initial u is of, undamped."""
    if oscillator.is_linear_at_rest:
        return float(oscillator.natural_frequency.evalf(30))
    rest = undamped(oscillator, dissipative_names(oscillator.force))
    return float(enclose(rest, abs(oscillator.initial[0]) or 1.0, bits=64).middle)


def switches_of(force: sympy.Expr) -> Switches:
    """The laws of a force with kinks, each smooth.

    >>> laws = switches_of(U * abs(U) + sympy.sign(V))
    >>> laws.force(0, 1)(-2.0, 0.5), laws.force(1, -1)(2.0, -0.5)
    (-3.0, 3.0)
    >>> laws = switches_of(U + abs(U - 1) - 1)
    >>> laws.places, laws.force(0, 1)(0.5, 0.0), laws.force(1, 1)(2.0, 0.0)
    ((1.0,), 0.0, 2.0)
    """
    stops = stops_of(force)
    exact = sorted((*stops, *((sympy.S.Zero,) if kinked_at_rest(force) else ())), key=float)
    places = tuple(float(place.evalf(30)) for place in exact)
    laws = {(n, side): _law(force, exact, n, side) for n in range(len(exact) + 1) for side in (1, -1)}
    return Switches(places, is_kinked(force, V), lambda stretch, side: laws[stretch, side])


def _law(force: sympy.Expr, places: list[sympy.Expr], stretch: int, side: int) -> Callable[[float, float], float]:
    """The force on one stretch of u and one side of u'; broken powers are held at 0 beyond it."""
    kinks = kinks_of(force)
    where = {kink: _side_of(kink.args[0], places, stretch, side) for kink in kinks}
    sizes = {kink: sympy.Symbol(str(kink), real=True) for kink in kinks if isinstance(kink, sympy.Abs)}
    signs = {kink: sympy.Integer(where[kink]) for kink in kinks if kink not in sizes}
    smooth = force.xreplace({**signs, **sizes})
    value = evaluator(smooth, (U, V, *sizes.values()), SCALAR)
    distances = [evaluator(where[kink] * kink.args[0], (U, V), SCALAR) for kink in sizes]
    held = any(power.exp.is_Integer is False for power in smooth.atoms(sympy.Pow) if power.base in sizes.values())

    def law(u: float, v: float) -> float:
        found = [distance((u, v)) for distance in distances]
        return float(value((u, v, *((max(x, 0.0) for x in found) if held else found))))

    return law


def _side_of(argument: sympy.Expr, places: list[sympy.Expr], stretch: int, side: int) -> int:
    """The sign of what abs or sign is taken of: u', or a*u + b on a stretch of u."""
    if not argument.has(U):
        return side
    above = places.index(place_of(argument)) < stretch
    return 1 if above == bool(argument.diff(U) > 0) else -1


def _check_numbers(oscillator: Oscillator) -> None:
    missing = [name for name, value in oscillator.parameters.items() if value is None]
    if missing:
        raise InputError(f"{oscillator.name}: parameter {missing[0]} has no number; set it, e.g. {missing[0]}=1")


def _vectorised(expression: sympy.Expr) -> Vectorised:
    """Return the function of u over an array; a constant expression still gives an array of u's shape."""
    function = evaluator(expression, (U,), ARRAY)

    def values(u: ArrayLike) -> Array:
        points = np.asarray(u, dtype=np.float64)
        return np.asarray(function((points,)) + np.zeros_like(points), dtype=np.float64)

    return values


def _linear_damping(force: sympy.Expr) -> float:
    """Return mu when the velocity enters as 2 mu u' and in no other way, else 0."""
    velocity_part = sympy.expand(force - without_velocity(force))
    rate = sympy.cancel(velocity_part / V)
    return float(rate / 2) if rate.is_number else 0.0


def closed_form(restoring: sympy.Expr) -> Vectorised | None:
    """Exact omega0 against peak amplitude where the restoring force has one: c sin(b u), or a u + b u^3.

    Recognised by the form of the expression, not by name.  The result is NaN where no oscillation has that peak.

    >>> u = U
    >>> round(float(closed_form(9 * sympy.sin(u))(np.pi / 2)), 12)
    2.541639254382
    """
    sine, cubic = sine_force(restoring), cubic_force(restoring)
    if sine is not None:
        factor, rate = float(sine.factor), float(sine.rate)
        return lambda peak: pendulum_frequency(peak, scale=math.sqrt(factor * rate), rate=rate)
    if cubic is not None:
        linear, cube = float(cubic.linear), float(cubic.cubic)
        return lambda peak: duffing_frequency(peak, linear=linear, cubic=cube)
    return None
