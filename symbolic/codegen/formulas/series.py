"""A series in one variable as functions: omega0 and its slope, the amplitude of a limit cycle, and the motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq
from sympy import Expr, Integer

from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.codegen.formulas.frequency import Symbols
from ridgeback.symbolic.codegen.formulas.wording import (
    OMEGA0,
    SCALING,
    common_facts,
    limit_fact,
    titled,
    variable_meaning,
)
from ridgeback.symbolic.codegen.motions.motion import motion_functions
from ridgeback.symbolic.codegen.naming import variable_name
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.polynomial import derivative, polynomial_function
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Terms
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.flow.slow_flow import rows

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.expansion import Expansion


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
        *series.frequency_fact(),
        *limit_fact(expansion.variable, request.limit),
        *request.more,
    )
    return Form(expansion.system, f"Fundamental frequency of {titled(expansion.system)}", facts, tuple(functions))


class _Series:
    """What all functions of one expansion share: arguments, units, and the values that symbols stand for."""

    def __init__(self, expansion: Expansion, request: CodeRequest) -> None:
        self.expansion, self.real = expansion, request.real
        scale, constants = expansion.scale, expansion.constants
        symbols = Symbols(scale, expansion.names, constants, False, self.real)
        self.fixed = bool(symbols.parameters) and scale.is_number
        self.symbols = Symbols(scale, expansion.names, constants, True, self.real) if self.fixed else symbols
        self.variable = variable_name(expansion.variable)
        self.domain: Domain = request.domain(self.variable, even=not expansion.sided)
        variable = Argument(self.variable, variable_meaning(expansion))
        self.arguments: tuple[Argument, ...] = (variable, *self.symbols.arguments())
        self.units = {self.variable: 1} if expansion.scaled_variable else {}
        self.variables = (self.variable, *(self.symbols.inner[name] for name in expansion.names))

    def frequency_fact(self) -> tuple[str, ...]:
        """What the natural frequency has to do with the coefficients."""
        scale = self.expansion.scale
        if self.fixed:
            return (f"The coefficients hold for the natural frequency {scale} only.",)
        return (f"Natural frequency: {scale}.",) if self.symbols.computed else (SCALING,)

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
        factor = self.symbols.k if rate and not self.fixed else ""
        return self.made(name, summary, self.terms(values, rate=rate), factor=factor)

    def slope(self, summary: str) -> Function:
        """The derivative of omega0: d(k sum c_n (eps/k)^n)/d eps has lost the factor k."""
        factor = "" if self.units or self.fixed else self.symbols.k
        return self.made(
            "omega0_slope", summary, derivative(self.terms(self.expansion.coefficients, rate=1)), factor=factor
        )

    def made(self, name: str, summary: str, terms: Terms, *, factor: str = "") -> Function:
        """A polynomial of these variables as a function."""
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
            before=self.symbols.prepared(),
            where=self.symbols.where,
            k=self.symbols.k,
        )


def _scaled(part: fmpq, scale: Expr) -> fmpq | Expr:
    if scale == 1:
        return part
    if scale.is_Rational:
        return part * fmpq(int(scale.p), int(scale.q))
    return as_sympy(part) * scale
