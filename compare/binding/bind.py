"""Bind an oscillator to numbers: the one place where a SymPy equation becomes functions of floats.

The parameters enter as exact rationals (12.566370614359172 means that decimal), so that float64 and mpmath see the
same equation; each constant is rounded once, on entering the arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import sympy
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.closures import ARRAY, PRECISE, SCALAR, evaluator
from ridgeback.compare.binding.taylor_jet import force_jet
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics, agm
from ridgeback.symbolic.systems.door import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V, Value

Vectorised = Callable[[ArrayLike], Array]


def bind(oscillator: OscillatorLike, *, values: Mapping[str, Value] | None = None) -> Dynamics:
    """Turn an oscillator into the functions that the numeric side works with.

    ``values`` replaces parameters by name.  Raises InputError for an unknown parameter, for one that has no number,
    and for a function that has no float, NumPy or mpmath form.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> dynamics = bind(find("pendulum"), values={"k": 2})
    >>> dynamics.natural_frequency, dynamics.force(0.0, 1.0)
    (2.0, 0.0)
    """
    oscillator = as_oscillator(oscillator)
    bound = oscillator.with_parameters(values) if values else oscillator
    _check_numbers(bound)
    force, potential = bound.substituted_force, bound.substituted_potential
    scalar, precise = evaluator(force, (U, V), SCALAR), evaluator(force, (U, V), PRECISE)
    return Dynamics(
        name=bound.name,
        force=lambda u, v: float(scalar((u, v))),
        natural_frequency=float(bound.natural_frequency.evalf(30)),
        damping=_linear_damping(force),
        potential=None if potential is None else _vectorised(potential),
        restoring=None if potential is None else _vectorised(sympy.diff(potential, U)),
        closed_form=None if potential is None else closed_form(force.subs(V, 0)),
        precise_force=lambda u, v: precise((u, v)),
        jet=force_jet(force),
    )


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
    velocity_part = sympy.expand(force - force.xreplace({V: sympy.Integer(0)}))
    rate = sympy.cancel(velocity_part / V)
    return float(rate / 2) if rate.is_number else 0.0


def closed_form(restoring: sympy.Expr) -> Vectorised | None:
    """Exact omega0 against peak amplitude where the restoring force has one: c sin(b u), or a u + b u^3.

    Recognised by the form of the expression, not by name.  The result is NaN where no oscillation has that peak.

    >>> u = U
    >>> round(float(closed_form(9 * sympy.sin(u))(np.pi / 2)), 12)
    2.541639254382
    """
    inside = _sine_form(restoring)
    if inside is not None:
        return _pendulum_frequency(*inside)
    cubic = _cubic_form(restoring)
    return None if cubic is None else _duffing_frequency(*cubic)


def _sine_form(restoring: sympy.Expr) -> tuple[float, float] | None:
    """Return (c, b) of c sin(b u) with c b > 0."""
    factor, rest = restoring.as_independent(U, as_Add=False)
    if not isinstance(rest, sympy.sin):
        return None
    rate = sympy.cancel(rest.args[0] / U)
    return (float(factor), float(rate)) if rate.is_number and factor * rate > 0 else None


def _cubic_form(restoring: sympy.Expr) -> tuple[float, float] | None:
    """Return (a, b) of a u + b u^3 with a > 0."""
    if not restoring.is_polynomial(U):
        return None
    terms = sympy.Poly(restoring, U).as_dict()
    if not set(terms) <= {(1,), (3,)} or not terms.get((1,), 0) > 0:
        return None
    return float(terms[(1,)]), float(terms.get((3,), 0))


# c sin(b u):  omega0 = sqrt(b c) pi / (2 K(sin(b A / 2))) = sqrt(b c) agm(1, cos(b A / 2))
def _pendulum_frequency(factor: float, rate: float) -> Vectorised:
    scale = math.sqrt(factor * rate)

    def frequency(peak: ArrayLike) -> Array:
        half = np.minimum(np.abs(np.asarray(peak, dtype=np.float64) * rate) / 2, math.pi)
        return np.asarray(scale * agm(1.0, np.cos(half)))

    return frequency


# a u + b u^3, u = A sin(phi):  T = 4 int_0^(pi/2) dphi / sqrt(a + b A^2 (1 + sin^2 phi) / 2), hence
# omega0 = agm(sqrt(a + b A^2 / 2), sqrt(a + b A^2));  b = 0 gives sqrt(a).
def _duffing_frequency(linear: float, cubic: float) -> Vectorised:
    def frequency(peak: ArrayLike) -> Array:
        square = cubic * np.asarray(peak, dtype=np.float64) ** 2
        inside = np.where(linear + square > 0, square, np.nan)
        return agm(np.sqrt(linear + inside / 2), np.sqrt(linear + inside))

    return frequency
