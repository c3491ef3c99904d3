"""The force of u'' + f(u, u') = 0 and its slopes: on real and complex balls, and as recurrences over any ring."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import sympy
from flint import acb, arb

from ridgeback.common.number_ring import NumberRing
from ridgeback.common.recurrences import Input, Node
from ridgeback.symbolic.arithmetic.balls import REAL_FUNCTIONS, number_ball
from ridgeback.symbolic.arithmetic.closures import evaluator
from ridgeback.symbolic.arithmetic.expression_series import Program, check_expandable
from ridgeback.symbolic.enclosure.ball_functions import COMPLEX, REAL
from ridgeback.symbolic.systems.oscillator import U, V

Ball: TypeAlias = Any
"""An ``arb`` or an ``acb``."""
OnBalls: TypeAlias = Callable[[Ball, Ball], Ball]
"""Takes u and u'; the answer holds the value at each point of both, and is not finite where that cannot be said."""

BALLS: Final = NumberRing(whole=arb, functions=REAL_FUNCTIONS, number=number_ball)
"""Balls at FLINT's working precision of the moment, as the ring of the recurrences."""


@dataclass(frozen=True)
class Field:
    """One oscillator with numbers for its parameters, its constants known to the precision at which it was made.

    Parameters
    ----------
    force, along_v : sympy.Expr
        f and df/du' in ``U`` and ``V``, without further symbols.
    value, slope_u, slope_v, curve_uv, curve_vv : callable
        f, its two slopes, and those of df/du', on real balls.
    complex_value, complex_slope : callable
        f and df/du' on complex balls; a finite answer proves them analytic there.
    unit : arb
        A velocity per unit of u, in which u' is weighed: about k, in rad per time unit.
    """

    force: sympy.Expr
    along_v: sympy.Expr
    value: OnBalls
    slope_u: OnBalls
    slope_v: OnBalls
    curve_uv: OnBalls
    curve_vv: OnBalls
    complex_value: OnBalls
    complex_slope: OnBalls
    unit: arb

    def node(self, expression: sympy.Expr, u: Input, v: Input) -> Node:
        """An expression in u and u' as a recurrence over the ring of its inputs."""
        return Program(expression, u.ring, {U: u, V: v}, U, V).root  # type: ignore[arg-type]  # the rings here know numbers


def field_of(force: sympy.Expr, unit: arb) -> Field:
    """Compile a force at the working precision of the moment.

    Parameters
    ----------
    force : sympy.Expr
        f(U, V) without further symbols.
    unit : arb
        About k, exact.

    Returns
    -------
    Field
        Its value and slopes.

    Raises
    ------
    InputError
        For a symbol without a value and a function that has no recurrence or no balls.

    Examples
    --------
    >>> field = field_of(U + U**2 * V, arb(1))
    >>> field.value(arb(2), arb(3)), field.slope_v(arb(2), arb(3))
    (14.0000000000000, 4.00000000000000)
    """
    check_expandable(force, {U, V})
    along_u, along_v = force.diff(U), force.diff(V)
    return Field(
        force=force,
        along_v=along_v,
        value=_real(force),
        slope_u=_real(along_u),
        slope_v=_real(along_v),
        curve_uv=_real(along_v.diff(U)),
        curve_vv=_real(along_v.diff(V)),
        complex_value=_complex(force),
        complex_slope=_complex(along_v),
        unit=unit,
    )


def _real(expression: sympy.Expr) -> OnBalls:
    values = evaluator(expression, (U, V), REAL)
    return lambda u, v: arb(values((u, v)))


def _complex(expression: sympy.Expr) -> OnBalls:
    values = evaluator(expression, (U, V), COMPLEX)
    return lambda u, v: acb(values((u, v)))
