r"""Lindstedt-Poincaré expansion of a limit cycle in eps: frequency and amplitude, order by order.

Andersen and Geer, SIAM J. Appl. Math. 42 (1982) 678, carried it to eps^24 for the van der Pol oscillator.  Notation as
in ``lindstedt``; u_0 = a_0 cos tau.  At order n the cosine of the right-hand side gives w_n, and the sine gives a_0
(order 1, a polynomial equation Q(a_0) = 0: the averaged equation) or a_(n-1) (a linear one with slope Q'(a_0)).
"""

from __future__ import annotations

from typing import Any

import sympy
from flint import fmpq, fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.expansion import Expansion, first_harmonic
from ridgeback.symbolic.expansion.recursion import BetweenOrders, Recursion, compiled, no_watch, normalise, residual
from ridgeback.symbolic.series.spaces import Scalar, Space, space_for
from ridgeback.symbolic.series.trigonometric import Trig, at_zero, constant, cosine, harmonic, solve_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.structure import free_names


def limit_cycle(oscillator: Oscillator, order: int, amplitude: str, *, watch: BetweenOrders = no_watch) -> Expansion:
    """Expand omega0 and the amplitude of a limit cycle in eps through the power ``order``.

    Raises InputError when the equation is not u'' + k^2 u plus terms in eps, or has no rational first amplitude.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> limit_cycle(find("van-der-pol"), 2, "peak").amplitude_series
    (2, 0, 1/96)
    """
    natural = oscillator.normalised
    recursion = cycle_recursion(oscillator, order, amplitude, space_for((), order + 1), watch=watch)
    read = at_zero if amplitude == "peak" else first_harmonic
    return Expansion(
        system=oscillator.name,
        method="lindstedt",
        variable=str(oscillator.small),
        amplitude=amplitude,
        order=order,
        scale=natural.scale,
        scaled_variable=True,
        coefficients=tuple(recursion.omega[: order + 1]),
        waveform=tuple(recursion.u[: order + 1]),
        amplitude_coefficients=tuple(read(p) for p in recursion.u[: order + 1]),
        residual_of=lambda e: residual(e, natural.force, _with_small(oscillator, recursion.space)),
    )


def cycle_recursion(
    oscillator: Oscillator, order: int, amplitude: str, space: Space, *, watch: BetweenOrders = no_watch
) -> Recursion:
    """Run Lindstedt's recursion for a limit cycle over a given coefficient space.

    Parameters
    ----------
    oscillator : Oscillator
        With a small parameter eps.
    order : int
        Highest power of eps/k kept in omega0.
    amplitude : str
        ``peak`` or ``fundamental``.
    space : Space
        What the coefficients are.
    watch : callable, optional
        Called before each order with the recursion and the order.

    Returns
    -------
    Recursion
        ``omega`` and ``u`` by powers of eps/k, in units with k = 1.

    Raises
    ------
    InputError
        When the equation is not u'' + k^2 u plus terms in eps, or has no rational first amplitude.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> cycle_recursion(find("van-der-pol"), 2, "peak", space_for(())).omega[:3]
    [1, 0, -1/16]
    """
    rest = _rest(oscillator)
    averaged = _averaged_sine(rest, oscillator)
    a0 = _first_amplitude(averaged, oscillator)
    start = cosine(space).scale(a0)
    recursion = Recursion(compiled(rest, (), start, _with_small(oscillator, space)), [start], space)
    for n in range(1, order + 2):
        watch(recursion, n)
        _cycle_step(recursion, n, amplitude, averaged.derivative()(a0))
    return recursion


def in_one_parameter(oscillator: Oscillator) -> bool:
    """Whether an equation is u'' + k^2 u plus terms that carry its small parameter, without other symbols.

    >>> in_one_parameter(Oscillator.from_equation("u'' - eps*(1 - b*u**2)*u' + u = 0"))
    False
    """
    try:
        _rest(oscillator)
    except InputError:
        return False
    return True


def has_series(oscillator: Oscillator) -> bool:
    """Whether a limit cycle is a power series in eps: its equation has the form, and a rational first amplitude.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> has_series(find("van-der-pol")), has_series(Oscillator.from_equation("u'' - eps*(1 - 3*u**2)*u' + u = 0"))
    (True, False)
    """
    try:
        _first_amplitude(_averaged_sine(_rest(oscillator), oscillator), oscillator)
    except InputError:
        return False
    return True


def _rest(oscillator: Oscillator) -> sympy.Expr:
    """The force without its linear part u: all of it must carry eps."""
    rest = sympy.expand(oscillator.normalised.force - U)
    if (
        oscillator.small is None
        or free_names(rest) not in ((), (oscillator.small,))
        or _at_zero_eps(rest, oscillator) != 0
    ):
        raise InputError(
            f"{oscillator.name} is not u'' + k**2*u plus terms that carry one small parameter, with every other "
            "parameter set; write it so, e.g. u'' - eps*(1 - u**2)*u' + u = 0, or use --method multiple-scales"
        )
    return rest


def _at_zero_eps(rest: sympy.Expr, oscillator: Oscillator) -> sympy.Expr:
    return rest.subs(sympy.Symbol(str(oscillator.small), real=True), 0)


def _with_small(oscillator: Oscillator, space: Space) -> dict[sympy.Symbol, list[Trig]]:
    """eps as the series 0 + 1 eps."""
    return {sympy.Symbol(str(oscillator.small), real=True): [constant(space, fmpq(0)), constant(space, fmpq(1))]}


def _cycle_step(recursion: Recursion, n: int, amplitude: str, slope: Scalar) -> None:
    """Find a_(n-1), w_n and u_n but for its cos tau part a_n, which the next order decides."""
    program = recursion.program
    inertia = recursion.inertia(n, n - 1)
    if n > 1:
        inertia = _settle_amplitude(recursion, n, slope, inertia)
    particular, p, q = solve_oscillator(-program.root.get(n) - inertia)
    if q != 0:
        raise AssertionError(f"secular sine left at order {n}")
    recursion.extend_omega(-p / harmonic(recursion.u[0], 1)[0])
    recursion.append(normalise(particular, amplitude, size=False))
    program.supply(U, recursion.u[n])
    program.supply(V, recursion.velocity(n, 0, n))


def _settle_amplitude(recursion: Recursion, n: int, slope: Scalar, inertia: Trig) -> Trig:
    """Remove the secular sine of order n by the cos tau part of u_(n-1); return the inertia with it."""
    program, space = recursion.program, recursion.space
    q = harmonic(-program.root.get(n) - inertia, 1)[1]
    change = cosine(space).scale(-q / slope)
    program.forget(n)
    program.correct(n - 1, change, change.derivative())
    recursion.u[n - 1] = recursion.u[n - 1] + change
    recursion.slope[n - 1] = recursion.slope[n - 1] + change.derivative()
    recursion.curve[n - 1] = recursion.curve[n - 1] - change
    return inertia - change.scale(recursion.squared[1])


def _averaged_sine(rest: sympy.Expr, oscillator: Oscillator) -> fmpq_poly:
    """Return Q(a), the secular sine of order 1 for u_0 = a cos tau: the first-order averaged equation."""
    space = space_for(("a",))
    start = cosine(space).scale(space.gen("a"))
    _, _, q = solve_oscillator(-compiled(rest, (), start, _with_small(oscillator, space)).root.get(1))
    rows = {powers[1]: value for powers, value in q.to_dict().items()} if q != 0 else {}
    return fmpq_poly([rows.get(n, fmpq(0)) for n in range(max(rows, default=-1) + 1)])


def _first_amplitude(averaged: fmpq_poly, oscillator: Oscillator) -> fmpq:
    """Return the smallest positive simple rational zero of Q."""
    factors = averaged.factor()[1] if averaged.degree() > 0 else []
    roots = [-f[0] / f[1] for f, times in factors if f.degree() == 1 and times == 1]
    positive = sorted(r for r in roots if r > 0)
    if not positive:
        raise _no_amplitude(averaged, oscillator.name)
    return positive[0]


class FirstAmplitudeError(InputError):
    """No power series of a limit cycle begins at eps = 0."""

    def __init__(self, name: str, why: str, instead: str = "") -> None:
        super().__init__(f"{name}: {why}{instead}")
        self.why = why


def _no_amplitude(averaged: fmpq_poly, name: str) -> FirstAmplitudeError:
    """Why the averaged equation gives no amplitude to start from, and what there is to do."""
    equation = f"the averaged equation is {averaged} = 0 in a"
    found: Any = averaged.complex_roots() if averaged.degree() > 0 else []  # pairs, which its annotation does not say
    real = [(root.real, count) for root, count in found if root.imag.is_zero() and root.real > 0]
    if not real:
        return FirstAmplitudeError(
            name, f"{equation} and has no positive zero, so that no limit cycle begins at eps = 0"
        )
    if all(count > 1 for _, count in real):
        why = f"{equation}, whose positive zeros are double: limit cycles meet there, and no power series begins"
        return FirstAmplitudeError(name, why)
    simple = min(float(root.mid()) for root, count in real if count == 1)
    scaled = f"rescale u so that it is rational (measure u in units of {simple:.6g})"
    instead = f"; {scaled}, or use --method multiple-scales"
    return FirstAmplitudeError(name, f"{equation}, with the irrational zero a = {simple:.6g}", instead)
