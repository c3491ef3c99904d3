r"""omega0(A) of a conservative oscillator from its energy integral: series reversion, no oscillator theory.

Landau and Lifshitz, Mechanics, section 12.  With 2 V(u) = s^2, u = U(s) and E the energy,

    T(E) / 2 pi = sum_n [s^(2n)] U'(s) * binom(2n, n) / 4^n * (2E)^n,

in units with k = 1, and 2E = 2 V(A) for the turning point A.  It shares nothing with the perturbation methods but the
Taylor coefficients of the force, so it certifies them.
"""

from __future__ import annotations

import math

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.expansion.amplitude import check_amplitude
from ridgeback.symbolic.expansion.cost import Budget, check
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.expansion import Expansion, check_order
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Scalar, space_for
from ridgeback.symbolic.series.trigonometric import constant
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import U, V
from ridgeback.symbolic.systems.structure import free_names

ALLOWED = ("peak", "trough", "action", "energy")


def energy_integral(
    oscillator: OscillatorLike,
    order: int,
    *,
    amplitude: str = "peak",
    budget: Budget | None = None,
    progress: Wanted = None,
) -> Expansion:
    """Expand omega0 in the amplitude from the energy integral, without oscillator theory.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator whose force does not depend on u'.
    order : int
        Highest power of the amplitude that is kept, 0 or more.
    amplitude : str, optional
        ``peak`` (default), ``trough``, ``action`` or ``energy``; ``fundamental`` needs the waveform, which this method
        does not have.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Expansion
        Exact coefficients of omega0, in rad per time unit; without a waveform.

    Raises
    ------
    InputError
        For a bad order or definition, for forces that depend on u', and when the predicted cost exceeds the budget.

    References
    ----------
    Landau and Lifshitz, Mechanics, section 12.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> energy_integral(find("pendulum"), 4).frequency
    (1, 0, -1/16, 0, 1/3072)
    """
    oscillator = as_oscillator(oscillator)
    if oscillator.by_sides:
        found = energy_on_each_side(oscillator, order, amplitude=amplitude, budget=budget)
        if isinstance(found, Expansion):
            return found
        raise InputError(
            f"{oscillator.name}: omega0 goes in other powers of A, from A^({found.growth}) in steps of "
            f"1/{found.root}; ridgeback.derive, or energy_on_each_side, gives that series"
        )
    order = check_order(order)
    check_amplitude(oscillator, amplitude, ALLOWED)
    natural = oscillator.normalised
    force, names = natural.rational, free_names(natural.rational)
    if force.has(V):
        raise InputError(
            f"{oscillator.name} has terms in u', so its energy is not conserved in this form; "
            "use --method multiple-scales or lindstedt, or set its damping to 0"
        )
    check("energy-integral", order, budget or Budget(), parameters=len(names))
    with showing(progress) as told:
        inverse = _frequency(_twice_potential(force, names, order + 1), amplitude, told)
    return Expansion(
        system=oscillator.name,
        method="energy-integral",
        variable="A",
        amplitude=amplitude,
        order=order,
        scale=natural.scale,
        scaled_variable=False,
        coefficients=tuple(inverse),
        waveform=None,
        amplitude_coefficients=None,
        residual_of=None,
        names=names,
        constants=natural.constants,
    )


def _frequency(twice_potential: list[Scalar], amplitude: str, told: Progress) -> list[Scalar]:
    """omega0 in powers of the amplitude X, from 2 V(u) / u^2: found in powers of e = 2E, and e put in.

    Where e is a series in X^2, as in an even potential, everything is: half as many terms.
    """
    length, even = len(twice_potential), all(c == 0 for c in twice_potential[1::2])
    told(1 / 10, "reversion of the potential")
    period = _period(_even_reversion(twice_potential) if even else _reversion(twice_potential))
    told(1 / 2, f"{amplitude} amplitude in the energy")
    frequency = truncated.reciprocal(period)  # omega0(e)
    if amplitude == "energy":
        return _spread(frequency, length)
    if amplitude == "action":
        return _spread(truncated.compose(frequency, _energy_of_action(period)), length)
    told(7 / 10, "frequency in the amplitude")
    if even:
        return _spread(truncated.compose(frequency, [fmpq(0), *twice_potential[::2]]), length)
    sign = -1 if amplitude == "trough" else 1
    energy = [fmpq(0), fmpq(0), *(sign**n * c for n, c in enumerate(twice_potential))]  # 2 V(A) or 2 V(-A)
    return truncated.compose(frequency + [fmpq(0)] * (length - len(frequency)), energy)


def _spread(in_squares: list[Scalar], length: int) -> list[Scalar]:
    """A series in X^2 as one in X of so many terms."""
    result: list[Scalar] = [fmpq(0)] * length
    result[::2] = in_squares
    return result


def _twice_potential(force: sympy.Expr, names: tuple[str, ...], length: int) -> list[Scalar]:
    """Coefficients of 2 V(u) / u^2, from the Taylor coefficients f_n of the force: 2 f_n / (n + 1)."""
    space = space_for(names)
    ring = TrigRing(space)
    fixed = {sympy.Symbol(name, real=True): [ring.parameter(name)] for name in names}
    u = [constant(space, fmpq(0)), constant(space, fmpq(1))]
    program = Program(force, ring, {}, U, V, fixed={**fixed, U: u})
    taylor = [program.root.get(n).coefficients(0) for n in range(1, length + 1)]
    return [(value[0] if value else fmpq(0)) * fmpq(2, n + 2) for n, value in enumerate(taylor)]


def _reversion(twice_potential: list[Scalar]) -> list[Scalar]:
    """Coefficients of s, s^3, ... in U(s), from s(u) = u sqrt(2 V(u) / u^2)."""
    return truncated.revert([fmpq(0), *truncated.square_root(twice_potential)])[1::2]


def _even_reversion(twice_potential: list[Scalar]) -> list[Scalar]:
    """The same for an even potential: s^2 = 2 V is a series in u^2, its reversion U^2 one in s^2."""
    return truncated.square_root(truncated.revert([fmpq(0), *twice_potential[::2]])[1:])


def _period(of_u: list[Scalar]) -> list[Scalar]:
    """T / 2 pi in powers of e = 2E."""
    return [c * ((2 * n + 1) * fmpq(math.comb(2 * n, n), 4**n)) for n, c in enumerate(of_u)]


def _energy_of_action(period: list[Scalar]) -> list[Scalar]:
    """2E in powers of X^2 = 2J: dJ/dE = T / 2 pi, so 2J = sum t_n e^(n+1) / (n+1), to be reverted."""
    return truncated.revert([fmpq(0), *(t * fmpq(1, n + 1) for n, t in enumerate(period))])[: len(period)]
