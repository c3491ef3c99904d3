"""From an expansion or a slow flow to the coefficient form: which functions there are, and what must be said."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sympy import Expr, Rational, Symbol

from symbolic.amplitude import MEANINGS
from symbolic.codegen.form import Argument, Form, Function, Powers, derivative, function, nearest_double
from symbolic.errors import InputError
from symbolic.rendering import as_sympy

if TYPE_CHECKING:
    from symbolic.expansion import Expansion
    from symbolic.slow_flow import SlowFlow, Term

K = Symbol("k")

SCALING = "The coefficients hold in units where k = 1: another k rescales time, and all parameters with it."

SMALL = "the small parameter of the equation"
NO_NUMBER = "'{system}' has parameters without a number ({names}); set each of them"
OMEGA0 = "Fundamental angular frequency, in radians per unit of time."

# Enough digits that rounding an irrational natural frequency to a double is decided.
DIGITS = 40


def expansion_form(expansion: Expansion, *, equation: str = "", limit: float | None = None) -> Form:
    """Build the functions omega0, omega0_slope and, for a limit cycle, amplitude."""
    variable, per = expansion.variable, scaling(expansion)
    terms = rational_terms(expansion, expansion.coefficients)
    arguments = (Argument(variable, variable_meaning(expansion)), frequency_argument(expansion.scale))
    summary = f"Derivative of omega0 by {variable}."
    # d(k sum c_n (eps/k)^n) / d eps has lost the factor k.
    slope_factor = None if per else K
    functions = [
        function("omega0", OMEGA0, "C", arguments, terms, factor=K, per=per),
        function("omega0_slope", summary, "S", arguments, derivative(terms), factor=slope_factor, per=per),
    ]
    if expansion.amplitude_coefficients is not None:
        series = rational_terms(expansion, expansion.amplitude_coefficients)
        functions.append(function("amplitude", f"Amplitude ({expansion.amplitude}).", "P", arguments, series, per=per))
    facts = (
        *common_facts(expansion.method, equation),
        f"Variable {variable}: {variable_meaning(expansion)}.",
        f"Order: powers of {variable} up to {expansion.order}.",
        SCALING,
        *limit_fact(variable, limit),
    )
    return Form(expansion.system, f"Fundamental frequency of '{expansion.system}'", facts, tuple(functions))


def scaling(expansion: Expansion) -> dict[str, Symbol]:
    """The variables that enter divided by the natural frequency."""
    return {expansion.variable: K} if expansion.scaled_variable else {}


def rational_terms(expansion: Expansion, values: Sequence[object]) -> dict[Powers, Rational]:
    """Coefficients by power, in units where k = 1.

    Raises InputError while a parameter is still symbolic.
    """
    exact = [as_sympy(value, expansion.names) for value in values]
    if any(not c.is_Rational for c in exact):
        raise InputError(NO_NUMBER.format(system=expansion.system, names=", ".join(expansion.names)))
    return {(power,): c for power, c in enumerate(exact)}


def slow_flow_form(flow: SlowFlow, *, equation: str = "", limit: float | None = None) -> Form:
    """Build the functions omega0 and damping of a multiple-scales slow flow with at most one small parameter.

    Raises InputError when it has several, or one that does not scale like a rate.
    """
    if len(flow.weights) > 1 or any(flow.dimensions[name] != 1 for name in flow.weights):
        raise InputError(
            f"'{flow.system}' has the small parameters {', '.join(flow.weights)}; code is written for at most one, "
            "that scales like a rate as mu of 2*mu*u' does: give the others a number and the weight 0"
        )
    arguments = (
        Argument("a", MEANINGS["fundamental"]),
        *(Argument(name, SMALL) for name in flow.weights),
        frequency_argument(flow.scale),
    )
    rate = "Relative rate of change of the amplitude, a'/a, per unit of time."
    functions = (
        slow_function("omega0", OMEGA0, "W", arguments, flow, flow.frequency),
        slow_function("damping", rate, "D", arguments, flow, flow.damping),
    )
    facts = (
        *common_facts(flow.method, equation),
        f"Amplitude a: {MEANINGS['fundamental']}.",
        *(f"Order: terms a^p {name}^q with p + {w} q up to {flow.order}." for name, w in flow.weights.items()),
        *(() if flow.weights else (f"Order: powers of a up to {flow.order}.",)),
        SCALING,
        *limit_fact("a", limit),
    )
    return Form(flow.system, f"Slow flow of '{flow.system}'", facts, functions)


def slow_function(
    name: str, summary: str, prefix: str, arguments: tuple[Argument, ...], flow: SlowFlow, terms: Sequence[Term]
) -> Function:
    """One side of the slow flow; a term a^p m^q carries k^(1 - q), which is taken out of it here."""
    units: dict[Powers, Rational] = {term.powers: term.coefficient / flow.unit(term.powers[1:]) for term in terms}
    if any(not c.is_Rational for c in units.values()):
        names = ", ".join(flow.names[len(flow.weights) :])
        raise InputError(NO_NUMBER.format(system=flow.system, names=names))
    return function(name, summary, prefix, arguments, units, factor=K, per=dict.fromkeys(flow.weights, K))


def frequency_argument(scale: Expr) -> Argument:
    """The natural frequency, by default the one that the expansion was derived with."""
    if not scale.is_number:
        raise InputError(f"the natural frequency {scale} is no number; set its parameters")
    exact = scale if scale.is_Rational else Rational(str(scale.evalf(DIGITS)))
    return Argument("k", "natural (small-amplitude) angular frequency", nearest_double(exact))


def variable_meaning(expansion: Expansion) -> str:
    """What the variable of an expansion stands for."""
    if expansion.variable == "eps":
        return SMALL
    return f"{expansion.amplitude} amplitude, " + MEANINGS[expansion.amplitude]


def common_facts(method: str, equation: str) -> tuple[str, ...]:
    """Equation and method, in a line each."""
    return (*((f"Equation: {equation}.",) if equation else ()), f"Method: {method}, exact rational coefficients.")


def limit_fact(variable: str, limit: float | None) -> tuple[str, ...]:
    """Where the oscillation itself ends; the truncation error is the reader's to look up."""
    if limit is None:
        return ()
    return (f"Meaningful only for |{variable}| below {limit:.6g}, where the oscillation itself ends.",)
