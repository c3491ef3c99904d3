"""From an expansion or a slow flow to the coefficient form: which functions there are, and what must be said."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from sympy import Expr, Integer

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.codegen.form import Argument, Form, Function, K, Powers, derivative, function, nearest_double
from ridgeback.symbolic.codegen.naming import argument_name, variable_name
from ridgeback.symbolic.expansion.amplitude import MEANINGS
from ridgeback.symbolic.flow.ordering import UNITS
from ridgeback.symbolic.flow.slow_flow import rows

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.expansion import Expansion
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.resummation.resummation import Resummation

SCALING = "The coefficients hold in units where k = 1: another k rescales time, and all parameters with it."

SMALL = "the small parameter of the equation"
A_SMALL = "a small parameter of the equation"
PARAMETER = "a parameter of the equation"
OMEGA0 = "Fundamental angular frequency, in radians per unit of time."


def expansion_form(expansion: Expansion, *, equation: str = "", limit: float | None = None) -> Form:
    """Build the functions omega0, omega0_slope and, for a limit cycle, amplitude.

    Parameters left symbolic become arguments; the natural frequency is then a number in the coefficients, since they
    hold for that one only.
    """
    if expansion.scale.free_symbols and expansion.constants:
        raise InputError(
            f"{expansion.system}: the natural frequency {expansion.scale} does not scale out of every term, so no code "
            "takes it as an argument; give it a number"
        )
    if expansion.constants:
        numbers = ", ".join(map(str, expansion.constants.values()))
        raise InputError(
            f"{expansion.system}: the coefficients hold the irrational {numbers}, and code is made from rational ones; "
            "give that number as a decimal"
        )
    variable = variable_name(expansion.variable)
    units = {variable: 1} if expansion.scaled_variable else {}
    scale = expansion.scale if expansion.names else Integer(1)
    terms = exact_terms(expansion, expansion.coefficients, scale)
    arguments: tuple[Argument, ...] = (Argument(variable, variable_meaning(expansion)),)
    arguments += tuple(Argument(argument_name(name), PARAMETER) for name in expansion.names)
    factor = None if expansion.names else K
    if not expansion.names:
        arguments += (frequency_argument(expansion.scale),)
    # d(k sum c_n (eps/k)^n) / d eps has lost the factor k.
    slope_factor = None if units else factor
    summary = f"Derivative of omega0 by {expansion.variable}."
    functions = [
        function("omega0", OMEGA0, "C", arguments, terms, factor=factor, units=units),
        function("omega0_slope", summary, "S", arguments, derivative(terms), factor=slope_factor, units=units),
    ]
    if expansion.amplitude_coefficients is not None:
        series = exact_terms(expansion, expansion.amplitude_coefficients, Integer(1))
        title = f"Amplitude ({expansion.amplitude})."
        functions.append(function("amplitude", title, "P", arguments, series, units=units))
    facts = (
        *common_facts(expansion.method, equation),
        f"Variable {expansion.variable}: {variable_meaning(expansion)}.",
        f"Order: powers of {expansion.variable} up to {expansion.order}.",
        f"The coefficients hold for the natural frequency {expansion.scale} only." if expansion.names else SCALING,
        *limit_fact(expansion.variable, limit),
    )
    return Form(expansion.system, f"Fundamental frequency of '{expansion.system}'", facts, tuple(functions))


def exact_terms(expansion: Expansion, values: Sequence[Any], scale: Expr) -> dict[Powers, Expr]:
    """Coefficients by the powers of the variable and of the parameters, times a number."""
    if not expansion.names:
        return {(power,): as_sympy(value) for power, value in enumerate(values)}
    found: dict[Powers, Expr] = {}
    for power, value in enumerate(values):
        for powers, part in rows(value, len(expansion.names)).items():
            found[(power, *powers)] = as_sympy(part) * scale
    return found


def slow_flow_form(flow: SlowFlow, *, equation: str = "", limit: float | None = None) -> Form:
    """Build the functions omega0 and damping of a multiple-scales slow flow; every symbol is an argument.

    Raises InputError when an irrational natural frequency does not scale out.
    """
    if flow.scale.is_number and any(name in UNITS for name in flow.names):
        raise InputError(
            f"'{flow.system}': the natural frequency {flow.scale} does not scale out of the coefficients; give the "
            "parameters in it numbers whose root is rational, or the other coefficients a name each"
        )
    small = len(flow.weights)
    arguments = (
        Argument("a", MEANINGS["fundamental"]),
        *(Argument(argument_name(name), SMALL if small == 1 else A_SMALL) for name in flow.weights),
        *(Argument(argument_name(name), PARAMETER) for name in flow.names[small:] if name not in UNITS),
        frequency_argument(flow.scale),
    )
    rate = "Relative rate of change of the amplitude, a'/a, per unit of time."
    functions = (
        slow_function("omega0", OMEGA0, "W", arguments, flow, flow.omega),
        slow_function("damping", rate, "D", arguments, flow, flow.delta),
    )
    facts = (
        *common_facts(flow.method, equation),
        f"Amplitude a: {MEANINGS['fundamental']}.",
        order_fact(flow),
        SCALING,
        *limit_fact("a", limit),
    )
    return Form(flow.system, f"Slow flow of '{flow.system}'", facts, functions)


def order_fact(flow: SlowFlow) -> str:
    """Which terms are kept.

    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> order_fact(multiple_scales(find("pendulum"), 4))
    'Order: terms a^p mu^q with p + 2 q up to 4.'
    """
    if not flow.weights:
        return f"Order: powers of a up to {flow.order}."
    letters = ["q", *(f"q_{n}" for n in range(2, len(flow.weights) + 1))]
    pairs = list(zip(flow.weights.items(), letters, strict=True))
    monomial = " ".join(f"{name}^{q}" for (name, _), q in pairs)
    degree = " + ".join(f"{w} {q}" for (_, w), q in pairs)
    return f"Order: terms a^p {monomial} with p + {degree} up to {flow.order}."


def slow_function(
    name: str, summary: str, prefix: str, arguments: tuple[Argument, ...], flow: SlowFlow, grades: Sequence[Any]
) -> Function:
    """One side of the slow flow, in units where k = 1: each symbol enters over its power of k."""
    count, weights = len(flow.names), tuple(flow.weights.values())
    terms: dict[Powers, Expr] = {}
    for n, grade in enumerate(grades):
        for powers, value in rows(grade, count).items():
            degree = sum(w * r for w, r in zip(weights, powers, strict=False))
            terms[(n - degree, *powers)] = as_sympy(value)
    units = {f"({s})" if s in UNITS else argument_name(s): d for s, d in flow.dimensions.items()}
    units = {"a": 0, **units}
    return function(name, summary, prefix, arguments, terms or {(0,) * (count + 1): Integer(0)}, factor=K, units=units)


def frequency_argument(scale: Expr) -> Argument:
    """The natural frequency, by default the one that the expansion was derived with; without, where it has symbols."""
    meaning = "natural (small-amplitude) angular frequency"
    if not scale.is_number:
        return Argument("k", f"{meaning}, {scale} of the equation")
    return Argument("k", meaning, nearest_double(scale))


def variable_meaning(expansion: Expansion | Resummation) -> str:
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
