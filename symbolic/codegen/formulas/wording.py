"""What the documentation of generated code says of a formula, and the arguments that all have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sympy import Expr

from ridgeback.symbolic.codegen.expressions import exact_number
from ridgeback.symbolic.codegen.number import FLOAT64, Number, Real
from ridgeback.symbolic.codegen.polynomial import K
from ridgeback.symbolic.codegen.program import Argument
from ridgeback.symbolic.expansion.amplitude import MEANINGS

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.resummation.resummation import Resummation

SCALING = "The coefficients hold in units where k = 1: another k rescales time, and all parameters with it."
SMALL = "the small parameter of the equation"
A_SMALL = "a small parameter of the equation"
PARAMETER = "a parameter of the equation"
OMEGA0 = "Fundamental angular frequency, in radians per unit of time."
GROWTH = "Relative rate of change of the amplitude, a'/a, per unit of time."
A_RATE = "Rate of change of the amplitude, a', per unit of time; with omega0 the slow flow's right side."


UNNAMED = "equation"
"""The name of an oscillator that was given as an equation."""


def titled(system: str) -> str:
    """An oscillator in a title: by its name, where it has one.

    >>> titled("pendulum"), titled(UNNAMED)
    ("'pendulum'", 'an oscillator given by its equation')
    """
    return "an oscillator given by its equation" if system == UNNAMED else f"'{system}'"


def frequency_argument(scale: Expr, real: Real = FLOAT64) -> Argument:
    """The natural frequency, by default the one that the expansion was derived with; without, where it has symbols."""
    meaning = "natural (small-amplitude) angular frequency"
    if not scale.is_number:
        return Argument(K, f"{meaning}, {scale} of the equation")
    return Argument(K, meaning, Number(exact_number(scale), real).nearest)


def variable_meaning(expansion: Expansion | PowerExpansion | Resummation) -> str:
    """What the variable of an expansion stands for."""
    if expansion.variable == "eps":
        return SMALL
    return f"{expansion.amplitude} amplitude, " + MEANINGS[expansion.amplitude]


def common_facts(method: str, equation: str, *, rational: bool = True) -> tuple[str, ...]:
    """Equation and method, in a line each."""
    kind = "exact rational coefficients" if rational else "exact coefficients"
    return (*((f"Equation: {equation}.",) if equation else ()), f"Method: {method}, {kind}.")


def limit_fact(variable: str, limit: float | None) -> tuple[str, ...]:
    """Where the oscillation itself ends; the truncation error is the reader's to look up."""
    if limit is None:
        return ()
    return (f"Meaningful only for |{variable}| below {limit:.6g}, where the oscillation itself ends.",)
