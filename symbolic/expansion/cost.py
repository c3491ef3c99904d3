"""What a derivation will take, said before it is begun.

The laws are fits to measured runs on one core of a laptop-class machine (2026): time grows like a power of the order
between the third and the fifth (orders x products x terms x digits), memory like the third, both times the number of
monomials in the parameters left symbolic; reversion and composition of power series, all that the energy integral does,
grow less.  They are empirical; ``python -m benchmarks.speed.costs`` shows each within a factor of three of what comes.
With symbolic parameters it is up to six, on the dear side, because how many monomials occur depends on the equation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

# method: (seconds, its power of the order, bytes, its power), half-way (in the ratio) between the cheapest and the
# dearest of: pendulum A^60 to A^320, Helmholtz-Duffing A^60 to A^160, hardening 160, u exp(u) 80, u/(1+u^2) 120; with
# parameters u^2 and u^3 16 to 26, u^3 40, sin(u) and u^2 24; van der Pol eps^30 to eps^120, Rayleigh 96; multiple
# scales at the damped pendulum 60, 90, two dampings 36, van der Pol 60; theta series at pendulum, hardening 100 to 400;
# energy integral at pendulum A^400 to A^1600, Helmholtz-Duffing A^400, A^800; balls at van der Pol 100, 200, 300, 859
# (0.023, 0.13, 0.25, 3.6 GB),
# of odd forces at pendulum 120 to 360 (0.0022 to 0.016 GB), Duffing 60 to 240 (0.001 to 0.022), cubic-quintic 120
# (0.006); of others at Helmholtz-Duffing 40, 80 (0.002, 0.0066), Toda 40, 80 (0.0009, 0.0032), Morse 50 (0.0023).
_LAWS = {
    "lindstedt": (8e-8, 3.0, 3.0, 3.0),
    "lindstedt with parameters": (1.4e-7, 2.5, 0.8, 3.0),
    "theta series": (2e-8, 3.0, 1.6, 3.0),
    "limit-cycle": (2e-8, 4.0, 80.0, 3.0),
    "multiple-scales": (1.5e-9, 4.0, 2.5, 3.0),
    "energy-integral": (5e-8, 2.63, 5.0, 2.4),
    "balls": (8e-8, 3.5, 640.0, 2.3),
    "balls of an odd force": (5e-7, 2.8, 220.0, 2.0),
    "balls of a force": (8.5e-6, 2.8, 880.0, 2.0),
}


@dataclass(frozen=True)
class Budget:
    """How much time and memory a derivation may take; one that is predicted to need more is refused before it starts.

    Parameters
    ----------
    seconds : float
        Time, 10 minutes by default.
    gigabytes : float
        Memory, 4 GB by default.

    Examples
    --------
    >>> Budget(seconds=3600.0)
    Budget(seconds=3600.0, gigabytes=4.0)
    """

    seconds: float = 600.0
    gigabytes: float = 4.0


@dataclass(frozen=True)
class Cost:
    """Predicted time (``seconds``) and memory (``gigabytes``) of a derivation."""

    seconds: float
    gigabytes: float

    def within(self, budget: Budget) -> bool:
        """Whether both fit."""
        return self.seconds <= budget.seconds and self.gigabytes <= budget.gigabytes


def predict(
    method: str,
    order: int,
    *,
    parameters: int = 0,
    weights: tuple[int, ...] = (),
    effort: float = 1.0,
) -> Cost:
    """Predict what a derivation costs, by laws fitted to measurements.

    Parameters
    ----------
    method : str
        ``lindstedt``, ``theta series``, ``limit-cycle``, ``energy-integral``, ``multiple-scales``, or balls by
        ``balls_of``.
    order : int
        Highest order.
    parameters : int, optional
        How many stay symbolic.
    weights : tuple of int, optional
        Weights of the small parameters (multiple scales).
    effort : float, optional
        How dear the force is, by :func:`effort_of`.

    Returns
    -------
    Cost
        Seconds and gigabytes.

    Examples
    --------
    >>> predict("lindstedt", 50).seconds < 1 < predict("lindstedt", 1000).seconds
    True
    """
    law = f"{method} with parameters"
    seconds, power, size, growth = _LAWS[law if parameters and law in _LAWS else method]
    monomials = math.comb(order // 2 + parameters, parameters) * weighted_monomials(order / 2, weights)
    memory = size * order**growth * monomials / 1e9
    return Cost(effort * seconds * order**power * monomials, memory * effort)


def balls_of(oscillator: Oscillator) -> str:
    """The law of balls for an oscillator: of a limit cycle, of an odd force, or of any other.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [balls_of(find(name)) for name in ("van-der-pol", "pendulum", "toda")]
    ['balls', 'balls of an odd force', 'balls of a force']
    """
    if oscillator.kind == "limit-cycle":
        return "balls"
    force = oscillator.substituted_force
    return "balls of an odd force" if force.subs({U: -U, V: -V}) == -force else "balls of a force"


EVEN_TOO = 6.0
"""How much dearer a force is that is not odd: every order and every harmonic stands, not every other."""


# Measured (seconds over the law, over this effort): pendulum 0.8 to 1.1 at orders 120 to 400, u + u^3 0.6 to 0.7 at 160
# and 320, u/(1 + u^2) 0.7 to 1.4 at 60 to 200, u^2 and u^3 0.8 to 1.0 at 60 to 200, u exp(u) 1.5 to 2.2 at 50 to 140,
# sin(u) exp(u)/(1 + u^2) 1.4 to 1.8 at 50 to 140.
def effort_of(force: sympy.Expr, u: sympy.Symbol) -> float:
    """How dear an order of a conservative force is, against the two products of sin(u) or of u^3.

    >>> u = sympy.Symbol("u")
    >>> effort_of(sympy.sin(u), u), effort_of(u + u**3, u), effort_of(u + u**2, u)
    (1.0, 1.0, 3.0)
    """
    products = sum(_products(part, u) for part in set(sympy.preorder_traversal(force)))
    odd = force.subs(u, -u) == -force
    return max(products / 2.0, 0.5) * (1.0 if odd else EVEN_TOO)


def _products(e: sympy.Expr, u: sympy.Symbol) -> int:
    """Products of series that one node of an expression takes, an order."""
    if not e.has(u):
        return 0
    if isinstance(e, sympy.Mul):
        return sum(1 for factor in e.args if factor.has(u)) - 1
    if isinstance(e, sympy.Pow) and e.exp.is_Integer:
        power = abs(int(e.exp))  # by squaring and multiplying, and one division where it is negative
        return power.bit_length() + power.bit_count() - 2 + (1 if e.exp.is_negative else 0)
    if isinstance(e, sympy.Function | sympy.Pow):
        return 2
    return 0


def weighted_monomials(degree: float, weights: tuple[int, ...]) -> float:
    """About how many monomials in variables of these weights there are up to a weighted degree.

    The volume of the simplex, with the degree raised by half of every weight for the points on its faces.

    >>> weighted_monomials(30, (2,)), weighted_monomials(20, (1, 1)), weighted_monomials(3, ())  # exactly 16, 231, 1
    (15.5, 220.5, 1.0)
    """
    raised = degree + sum(weights) / 2
    return raised ** len(weights) / (math.factorial(len(weights)) * math.prod(weights))


def check(
    method: str,
    order: int,
    budget: Budget,
    *,
    parameters: int = 0,
    weights: tuple[int, ...] = (),
    effort: float = 1.0,
) -> None:
    """Refuse a derivation that is predicted to exceed the budget.

    Parameters
    ----------
    method, order, parameters, weights, effort
        As for ``predict``.
    budget : Budget
        What it may cost.

    Raises
    ------
    InputError
        With the prediction and the highest order that fits.
    """
    predicted = partial(predict, method, parameters=parameters, weights=weights, effort=effort)
    cost = predicted(order)
    if cost.within(budget):
        return
    low, high = 0, order
    while high - low > 1:
        middle = (low + high) // 2
        fits = predicted(middle).within(budget)
        low, high = (middle, high) if fits else (low, middle)
    raise InputError(
        f"order {order} by {method} would take about {duration(cost.seconds)} and {cost.gigabytes:.2g} GB, over the "
        f"--budget of {duration(budget.seconds)} and {budget.gigabytes:.2g} GB; order {low} fits"
    )


def duration(seconds: float) -> str:
    """Return a time in the unit that reads best.

    Parameters
    ----------
    seconds : float
        The time.

    Returns
    -------
    str
        A number and its unit.

    Examples
    --------
    >>> duration(7200)
    '2 h'
    """
    for unit, size in (("years", 3.156e7), ("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size or (unit == "h" and seconds >= size):
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"
