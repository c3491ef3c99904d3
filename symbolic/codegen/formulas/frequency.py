"""How the natural frequency k and what depends on parameters alone enter the code: as arguments, or computed first.

A frequency that is a number or one symbol is the argument ``k``.  One that is an expression, such as sqrt(k/m), is
computed from the parameters in it, which are arguments under their own names; so is every other expression in them that
the coefficients hold by a name of its own (``natural_units``), such as 1/k.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

from flint import fmpq
from sympy import Expr, Symbol

from ridgeback.symbolic.codegen.expressions import valued
from ridgeback.symbolic.codegen.formulas.wording import PARAMETER, frequency_argument
from ridgeback.symbolic.codegen.naming import argument_names
from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.polynomial import K
from ridgeback.symbolic.codegen.program import Argument, Operand, Step, Steps

COMPUTED: Final = "natural_frequency"
FRESH: Final = re.compile(r"y\d+")
"""Names that are given once and read once."""


@dataclass(frozen=True)
class Symbols:
    """The parameters left symbolic, and what the coefficients hold besides."""

    scale: Expr
    """The natural frequency k."""
    names: tuple[str, ...]
    """Symbols of the coefficients."""
    constants: Mapping[str, Expr]
    """Values of those that are no parameters."""
    fixed: bool
    """Whether a numerical k is in the coefficients and is no argument."""
    real: Real

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters that are arguments of their own."""
        own = [name for name in self.names if name not in self.constants]
        inside = {str(s) for value in (*self.constants.values(), self.scale) for s in value.free_symbols}
        return (*own, *sorted(inside - set(own) - {self._whole}))

    @property
    def _whole(self) -> str:
        """The parameter that is the natural frequency itself."""
        return self.scale.name if isinstance(self.scale, Symbol) else ""

    @property
    def computed(self) -> bool:
        """Whether k is computed from parameters or a number, and no argument."""
        return self.fixed or not (self.scale.is_number or self._whole)

    @property
    def k(self) -> str:
        """The name of the natural frequency in the code."""
        return COMPUTED if self.computed else K

    @cached_property
    def called(self) -> dict[str, str]:
        """The arguments' names by the parameters'; ``k`` is free where the natural frequency is computed."""
        return argument_names(self.parameters, free=(K,) if self.computed else ())

    def arguments(self, meanings: Mapping[str, str] | None = None) -> tuple[Argument, ...]:
        """The parameters, and the natural frequency where it is an argument."""
        told = meanings or {}
        own = (Argument(self.called[name], told.get(name, PARAMETER)) for name in self.parameters)
        return (*own, *(() if self.computed else (frequency_argument(self.scale, self.real),)))

    @cached_property
    def inner(self) -> dict[str, str]:
        """The names in the code of the symbols of the coefficients."""
        found, roots, parts = {}, 0, 0
        for name in self.names:
            if name not in self.constants:
                found[name] = self.called[name]
            elif self.constants[name].is_number:
                found[name], roots = f"root_{roots + 1}", roots + 1
            else:
                found[name], parts = f"part_{parts + 1}", parts + 1
        return found

    @cached_property
    def where(self) -> tuple[tuple[str, Expr], ...]:
        """What is computed first, by its name in the code."""
        parts = [(self.inner[name], self.constants[name]) for name in self.names if name in self.constants]
        return ((COMPUTED, self.scale), *parts) if self.computed else tuple(parts)

    def prepared(self) -> Steps:
        """The steps that compute it."""
        steps = Steps(self.real)
        named = self.called | ({self._whole: K} if self._whole else {})
        for name, value in self.where:
            if value.is_number:
                exact = fmpq(int(value.p), int(value.q)) if value.is_Rational else value
                steps.multiply(name, Number(exact, self.real), steps.number(1))
            else:
                under(steps, name, valued(steps, value, named))
        return steps


def under(steps: Steps, name: str, operand: Operand) -> None:
    """Give the value computed last a name; another value is copied by a product with 1."""
    last = steps.taken[-1] if steps.taken else None
    if isinstance(last, Step) and last.name == operand and FRESH.fullmatch(last.name):
        steps.taken[-1] = replace(last, name=name)
        steps.known.add(name)
    else:
        steps.multiply(name, operand, steps.number(1))
