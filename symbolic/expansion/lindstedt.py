r"""Lindstedt-Poincaré expansions of periodic orbits, to any order.

Nayfeh and Mook, Nonlinear Oscillations (1979), 2.3.  Rescaled time ``tau = omega t``, ' = d/dtau, units with k = 1:

    omega^2 u'' + f(u, omega u') = 0,      u = sum X^n u_n(tau),      omega^2 = sum X^n w_n

At order n:  u_n'' + u_n = -[rest]_n - sum_(0<j<n) w_j u''_(n-j), and the right-hand side may hold no multiple of
cos tau or sin tau (solvability).

* Conservative: X = A, u_0 = 0, u_1 = cos tau.  cos: w_(n-1) follows.  sin: must vanish by itself, or there is damping.
* Limit cycle: X = eps, u_0 = a_0 cos tau.  cos: w_n follows.  sin: a_0 follows at order 1 from a polynomial
  equation, then a_(n-1) from a linear one.

The homogeneous part of u_n is fixed by the amplitude definition: ``peak`` (u'(0) = 0, and u(0) = A) or
``fundamental`` (first harmonic A cos tau).

Long series of motions that Jacobi's theta functions give in closed form are read off those (``theta_motion``): the same
coefficients, sooner.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.common.recurrences import Element
from ridgeback.symbolic.expansion.amplitude import DEFINITIONS, check_amplitude
from ridgeback.symbolic.expansion.cost import Budget, check, effort_of
from ridgeback.symbolic.expansion.expansion import Expansion, check_order
from ridgeback.symbolic.expansion.limit_cycle import limit_cycle
from ridgeback.symbolic.expansion.recursion import BetweenOrders, Recursion, compiled, no_watch, normalise, residual
from ridgeback.symbolic.expansion.theta_motion import is_theta_series, theta_motion, waveform
from ridgeback.symbolic.series.spaces import Scalar, Space, is_zero, space_for
from ridgeback.symbolic.series.trigonometric import Trig, constant, cosine, solve_oscillator
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.parameters import symbol_of
from ridgeback.symbolic.systems.structure import free_names

DIRECT = ("peak", "fundamental")
"""Definitions that fix the homogeneous solution order by order; the others are reached by conversion."""


def lindstedt(
    oscillator: OscillatorLike,
    order: int,
    *,
    amplitude: str = "peak",
    budget: Budget | None = None,
    progress: Wanted = None,
) -> Expansion:
    """Expand omega0 in the amplitude (conservative) or in eps (limit cycle) by Lindstedt's recursion.

    From order 50 on, motions in the peak amplitude that are theta series, of c sin(b u) and a u + e u^3 with rational
    coefficients once k = 1, are taken from those.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator; its orbits must close by a symmetry, or it must have a limit cycle with a parameter
        eps.
    order : int
        Highest power of the amplitude A (of eps for a limit cycle) that is kept, 0 or more.
    amplitude : str, optional
        What A means: ``peak`` (default), ``trough``, ``fundamental``, ``action`` or ``energy``; ``peak`` or
        ``fundamental`` for a limit cycle.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share of the work that is done and the order about to be found.

    Returns
    -------
    Expansion
        Exact coefficients of omega0, in rad per time unit, with the waveform u in omega0 t and the residual.

    Raises
    ------
    InputError
        For a bad order or definition, for an oscillator without a family of periodic orbits, and, before any work, when
        the predicted cost exceeds the budget.

    References
    ----------
    Nayfeh and Mook, Nonlinear Oscillations (1979), section 2.3.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> lindstedt(find("van-der-pol"), 4).frequency
    (1, 0, -1/16, 0, 17/3072)
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_amplitude(oscillator, amplitude, DIRECT if oscillator.kind == "limit-cycle" else DEFINITIONS)
    budget = budget or Budget()
    with showing(progress) as told:
        if oscillator.kind == "limit-cycle":
            check("limit-cycle", order, budget)
            return limit_cycle(oscillator, order, amplitude, watch=watching(told, order))
        if amplitude not in DIRECT:
            return _conservative(oscillator, order, "peak", budget, told).convert(amplitude)
        return _conservative(oscillator, order, amplitude, budget, told)


STEEPNESS = 4
"""Power of the order that the time of a derivation follows (``cost``): what is done is said by it."""


def watching(progress: Progress, order: int) -> BetweenOrders:
    """Tell the progress as each order begins.

    >>> watching(lambda share, step: print(f"{share:.2f}", step), 3)(None, 2)
    0.06 order 2 of 3
    """
    return lambda _, n: progress((n / (order + 1)) ** STEEPNESS, f"order {min(n, order)} of {order}")


def _conservative(oscillator: Oscillator, order: int, amplitude: str, budget: Budget, progress: Progress) -> Expansion:
    natural = oscillator.normalised
    force, names = natural.rational, free_names(natural.rational)
    omega: Sequence[Scalar]
    waves: Sequence[Trig]
    if in_closed_form(oscillator, order, amplitude):
        check("theta series", order, budget)
        omega, waves = _by_theta_series(force, order, progress)
    else:
        check("lindstedt", order, budget, parameters=len(names), effort=effort_of(force, U))
        found = conservative_recursion(
            oscillator, order, amplitude, space_for(names, order + 1), watch=watching(progress, order)
        )
        omega, waves = found.omega, found.u
    return Expansion(
        system=oscillator.name,
        method="lindstedt",
        variable="A",
        amplitude=amplitude,
        order=order,
        scale=natural.scale,
        scaled_variable=False,
        coefficients=tuple(omega),
        waveform=tuple(waves),
        amplitude_coefficients=None,
        residual_of=lambda e: residual(e, force, {}),
        names=names,
        constants=natural.constants,
        velocity=force.has(V),
    )


FROM: Final = 50
"""Order from which theta series are read off; the recursion is as quick below."""


def in_closed_form(oscillator: Oscillator, order: int, amplitude: str) -> bool:
    """Whether an expansion of a conservative oscillator is read off theta series.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> in_closed_form(find("pendulum"), 200, "peak"), in_closed_form(find("helmholtz"), 200, "peak")
    (True, False)
    """
    return order >= FROM and amplitude == "peak" and is_theta_series(oscillator.normalised.rational)


def _by_theta_series(force: sympy.Expr, order: int, progress: Progress) -> tuple[list[Scalar], list[Trig]]:
    """omega_0 ... omega_order and u_0 ... u_(order+1)."""
    progress(0, "the nome in the amplitude")
    motion = theta_motion(force, (order + 1) // 2 + 1)
    progress(1 / 10, "theta series")
    omega: list[Scalar] = [fmpq(0)] * (order + 1)
    omega[::2] = motion.omega[: order // 2 + 1]
    return omega, waveform(motion, space_for((), order + 1), order + 1)


def conservative_recursion(
    oscillator: Oscillator,
    order: int,
    amplitude: str,
    space: Space,
    *,
    watch: BetweenOrders = no_watch,
    constants: Mapping[str, Scalar] | None = None,
) -> Recursion:
    """Run Lindstedt's recursion for a conservative oscillator over a given coefficient space.

    Parameters
    ----------
    oscillator : Oscillator
        With periodic orbits.
    order : int
        Highest power of the amplitude kept in omega0.
    amplitude : str
        ``peak`` or ``fundamental``.
    space : Space
        What the coefficients are: rationals, polynomials in parameters, balls.
    watch : callable, optional
        Called before each order with the recursion and the order.
    constants : mapping of str to coefficient, optional
        Values of names in the force that are none of the space's: what is irrational, in balls.

    Returns
    -------
    Recursion
        ``omega`` through ``order`` and ``u`` through ``order + 1``, in units with k = 1.

    Raises
    ------
    InputError
        When the oscillator has no family of periodic orbits.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> conservative_recursion(find("duffing"), 2, "peak", space_for(())).omega
    [1, 0, 3/8]
    """
    force = oscillator.normalised.rational
    fixed: dict[sympy.Symbol, list[Element]] = {
        symbol_of(name): [constant(space, value)] for name, value in (constants or {}).items()
    }
    program = compiled(force, space.names, constant(space, fmpq(0)), fixed)
    if program.root.slopes()[1]:
        raise InputError(_no_family(oscillator))
    recursion = Recursion(program, [constant(space, fmpq(0)), cosine(space)], space)
    program.supply(U, recursion.u[1])
    program.supply(V, recursion.slope[1])
    for n in range(2, order + 2):
        watch(recursion, n)
        _family_step(recursion, n, amplitude, oscillator)
    return recursion


def _family_step(recursion: Recursion, n: int, amplitude: str, oscillator: Oscillator) -> None:
    """Find u_n and omega_(n-1)."""
    program, space = recursion.program, recursion.space
    zero = constant(space, fmpq(0))
    program.supply(U, zero)
    program.supply(V, recursion.velocity(n, 1, n - 2) if program.uses_velocity else zero)
    right = -program.root.get(n) - recursion.inertia(n, n - 2)
    particular, p, q = solve_oscillator(right)
    if not is_zero(q):  # a ball around 0 is no proof that sin tau vanishes
        raise InputError(_no_family(oscillator) if q != 0 else _undecided(oscillator))
    recursion.extend_omega(-p)  # right + w_(n-1) cos tau must hold no cos tau
    recursion.append(normalise(particular, amplitude, size=True))
    program.correct(n, recursion.u[n], recursion.slope[n] + recursion.slope[1].scale(recursion.omega[n - 1]))


def _undecided(oscillator: Oscillator) -> str:
    return (
        f"{oscillator.name}: balls cannot prove that no secular sin tau survives, since no symmetry of the force "
        "removes it; use the exact series"
    )


def _no_family(oscillator: Oscillator) -> str:
    return (
        f"{oscillator.name} loses or gains energy (a secular sin tau survives), so it has no family of periodic "
        "orbits; use --method multiple-scales, or set its damping to 0"
    )
