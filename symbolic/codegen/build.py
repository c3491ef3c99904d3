"""From an expansion or a slow flow to the coefficient form: which functions there are, and what must be said."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq
from sympy import Expr, Integer

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.codegen.motions.motion import motion_functions
from ridgeback.symbolic.codegen.motions.transient import transient_functions
from ridgeback.symbolic.codegen.naming import argument_names, variable_name
from ridgeback.symbolic.codegen.number import FLOAT64, Number, Real
from ridgeback.symbolic.codegen.polynomial import K, derivative, polynomial_function
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Steps, Terms
from ridgeback.symbolic.codegen.request import CodeRequest
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
A_RATE = "Rate of change of the amplitude, a', per unit of time: with omega0 = phi' the slow flow's right-hand side."
OMEGA0 = "Fundamental angular frequency, in radians per unit of time."


def expansion_form(expansion: Expansion, request: CodeRequest) -> Form:
    """Build the functions omega0, omega0_slope and, for a limit cycle, amplitude; u(t) and its harmonics on request.

    Parameters left symbolic become arguments, a symbolic natural frequency too; a natural frequency with a number is
    then in the coefficients, since they hold for that one only.
    """
    series = _Series(expansion, request)
    functions = [series.function("omega0", OMEGA0, expansion.coefficients, rate=1)]
    functions.append(series.slope(f"Derivative of omega0 by {expansion.variable}."))
    if expansion.amplitude_coefficients is not None:
        title = f"Amplitude ({expansion.amplitude})."
        functions.append(series.function("amplitude", title, expansion.amplitude_coefficients, rate=0))
    if request.motion:
        functions += motion_functions(series, expansion)
    facts = (
        *common_facts(expansion.method, request.equation),
        f"Variable {expansion.variable}: {variable_meaning(expansion)}.",
        f"Order: powers of {expansion.variable} up to {expansion.order}.",
        f"The coefficients hold for the natural frequency {expansion.scale} only." if series.fixed else SCALING,
        *limit_fact(expansion.variable, request.limit),
        *request.more,
    )
    return Form(expansion.system, f"Fundamental frequency of '{expansion.system}'", facts, tuple(functions))


class _Series:
    """What all functions of one expansion share: arguments, units, and the values that symbols stand for."""

    def __init__(self, expansion: Expansion, request: CodeRequest) -> None:
        self.expansion, self.real = expansion, request.real
        self.parameters = tuple(name for name in expansion.names if name not in expansion.constants)
        self.called = argument_names(self.parameters)
        self.fixed = bool(self.parameters) and expansion.scale.is_number
        self.variable = variable_name(expansion.variable)
        self.domain: Domain = request.domain(self.variable, even=not expansion.sided)
        self.arguments: tuple[Argument, ...] = (
            Argument(self.variable, variable_meaning(expansion)),
            *(Argument(name, PARAMETER) for name in self.called.values()),
            *(() if self.fixed else (frequency_argument(expansion.scale, self.real),)),
        )
        self.units = {self.variable: 1} if expansion.scaled_variable else {}
        self.variables = (self.variable, *(self._inner(name) for name in expansion.names))

    def _inner(self, name: str) -> str:
        """The name in the code of a symbol of the coefficients: an argument's, or of a value computed from k."""
        constants = self.expansion.constants
        if name not in constants:
            return self.called[name]
        roots = [each for each, value in constants.items() if value.is_number]
        return f"root_{roots.index(name) + 1}" if name in roots else self._by_frequency(constants[name])

    def _by_frequency(self, value: Expr) -> str:
        """The name of 1/k or 1/k^2, which the natural frequency gives; InputError for what it does not."""
        k = self.expansion.scale
        found = {1 / k: "k_inverse", 1 / k**2: "k_squared_inverse"}.get(value)
        if found is None:
            held = ", ".join(sorted(str(s) for s in value.free_symbols))
            raise InputError(
                f"'{self.expansion.system}': the coefficients hold {value}, which neither the parameters left symbolic "
                f"nor the natural frequency give; give {held} a number"
            )
        return found

    def prepared(self) -> Steps:
        """The values of the symbols that are no arguments: 1/k^2, and irrational numbers."""
        steps = Steps(self.real)
        for name in self.expansion.names:
            if name in self.expansion.constants:
                self._prepare(steps, self._inner(name), self.expansion.constants[name])
        return steps

    def _prepare(self, steps: Steps, inner: str, value: Expr) -> None:
        if value.is_number:
            steps.multiply(inner, Number(value, self.real), steps.number(1))
        else:
            steps.divide(inner, steps.number(1), K if inner == "k_inverse" else steps.square(K))

    def terms(self, values: Sequence[Any], *, rate: int) -> Terms:
        """Coefficients by the powers of variable and symbols; in the oscillator's own time where k is fixed."""
        scale = self.expansion.scale if self.fixed and rate else Integer(1)
        found: Terms = {}
        for power, value in enumerate(values):
            for powers, part in rows(value, len(self.expansion.names)).items():
                found[power, *powers] = Number(_scaled(part, scale), self.real)
        return found

    def function(self, name: str, summary: str, values: Sequence[Any], *, rate: int) -> Function:
        """A series of the expansion; ``rate`` is 1 for a quantity per time, 0 for one in u."""
        return self.made(name, summary, self.terms(values, rate=rate), factor=K if rate and not self.fixed else "")

    def slope(self, summary: str) -> Function:
        """The derivative of omega0: d(k sum c_n (eps/k)^n)/d eps has lost the factor k."""
        factor = "" if self.units or self.fixed else K
        return self.made(
            "omega0_slope", summary, derivative(self.terms(self.expansion.coefficients, rate=1)), factor=factor
        )

    def made(self, name: str, summary: str, terms: Terms, *, factor: str = "") -> Function:
        """A polynomial of these variables as a function."""
        used = [any(powers[i] for powers in terms) for i in range(len(self.variables))]
        before = self.prepared() if any(used[1:]) else None
        kept = terms or {(0,) * len(self.variables): Number(fmpq(0), self.real)}
        return polynomial_function(
            name,
            summary,
            self.arguments,
            self.variables,
            kept,
            self.domain,
            factor=factor,
            units=self.units,
            real=self.real,
            before=before,
        )


def _scaled(part: fmpq, scale: Expr) -> fmpq | Expr:
    if scale.is_Rational:
        return part * fmpq(int(scale.p), int(scale.q))
    return as_sympy(part) * scale


def slow_flow_form(flow: SlowFlow, request: CodeRequest) -> Form:
    """Build the functions omega0 and growth_rate of a multiple-scales slow flow; every symbol is an argument.

    Raises InputError when an irrational natural frequency does not scale out, and for a motion, which it has none of.
    """
    if flow.constants or (flow.scale.is_number and any(name in UNITS for name in flow.names)):
        raise InputError(
            f"'{flow.system}': the natural frequency {flow.scale} does not scale out of the coefficients; give the "
            "parameters in it numbers whose root is rational, or the other coefficients a name each"
        )
    if request.motion:
        raise InputError(
            f"'{flow.system}': motion writes u(t) of a series; a slow flow gives amplitude and phase, leave motion out"
        )
    small = len(flow.weights)
    called = argument_names(name for name in flow.names if name not in UNITS)
    arguments = (
        Argument("a", MEANINGS["fundamental"]),
        *(Argument(called[name], SMALL if small == 1 else A_SMALL) for name in flow.weights),
        *(Argument(called[name], PARAMETER) for name in flow.names[small:] if name in called),
        frequency_argument(flow.scale, request.real),
    )
    rate = "Relative rate of change of the amplitude, a'/a, per unit of time."
    domain = request.domain("a")
    functions: tuple[Function, ...] = (
        slow_function("omega0", OMEGA0, arguments, domain, flow, flow.omega, request.real),
        slow_function("growth_rate", rate, arguments, domain, flow, flow.delta, request.real),
        slow_function("amplitude_rate", A_RATE, arguments, domain, flow, flow.delta, request.real, more=1),
    )
    functions += transient_functions(functions[0], functions[2], domain, request.real)
    facts = (
        *common_facts(flow.method, request.equation),
        f"Amplitude a: {MEANINGS['fundamental']}.",
        order_fact(flow),
        SCALING,
        *limit_fact("a", request.limit),
        *request.more,
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
    name: str,
    summary: str,
    arguments: tuple[Argument, ...],
    domain: Domain,
    flow: SlowFlow,
    by_degree: Sequence[Any],
    real: Real = FLOAT64,
    *,
    more: int = 0,
) -> Function:
    """One side of the slow flow, times a^more, in units where k = 1: each symbol enters over its power of k."""
    count, weights = len(flow.names), tuple(flow.weights.values())
    called = argument_names(symbol for symbol in flow.names if symbol not in UNITS)
    terms: Terms = {}
    for n, coefficient in enumerate(by_degree):
        for powers, value in rows(coefficient, count).items():
            degree = sum(w * r for w, r in zip(weights, powers, strict=False))
            terms[n - degree + more, *powers] = Number(value, real)
    units = {f"({s})" if s in UNITS else called[s]: d for s, d in flow.dimensions.items()}
    kept = terms or {(0,) * (count + 1): Number(fmpq(0), real)}
    return polynomial_function(name, summary, arguments, ("a", *units), kept, domain, factor=K, units=units, real=real)


def frequency_argument(scale: Expr, real: Real = FLOAT64) -> Argument:
    """The natural frequency, by default the one that the expansion was derived with; without, where it has symbols."""
    meaning = "natural (small-amplitude) angular frequency"
    if not scale.is_number:
        return Argument(K, f"{meaning}, {scale} of the equation")
    exact = fmpq(int(scale.p), int(scale.q)) if scale.is_Rational else scale
    return Argument(K, meaning, Number(exact, real).nearest)


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
