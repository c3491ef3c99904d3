r"""What a resummed expansion is: omega0 by another formula than the truncated power series, with the same interface.

    omega0 = k * F(X),       X = A, or eps/k for limit cycles

It keeps the amplitude definition and the order of the expansion it was made from.  Sums live in ``pade`` (rational
functions, also in a mapped variable) and ``nome`` (elliptic nome).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from html import escape
from typing import Any

import sympy
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import evaluated, natural_frequency
from ridgeback.symbolic.arithmetic.rendering import long_integers, mathml

LONGEST_SHOWN = 2000
"""Characters of LaTeX beyond which a notebook shows the line in place of the formula."""


@dataclass(frozen=True, repr=False)
class Resummation(ABC):
    """omega0 as a closed formula in one variable, exact coefficients throughout; made by ``resum``.

    A call evaluates it in rad per time unit, correct but for one rounding; ``in_balls`` encloses it; ``expression`` and
    ``latex`` are the formula.
    """

    system: str
    method: str
    variable: str
    """``A`` (amplitude) or ``eps``."""
    amplitude: str
    """Definition of the amplitude, as for expansions."""
    order: int
    """Highest power of the variable through which the formula was made to agree with the exact frequency."""
    scale: sympy.Expr
    """The natural frequency k, in rad per time unit."""
    scaled_variable: bool
    """True when X is the printed variable divided by k."""

    @abstractmethod
    def normalised(self, x: arb) -> arb:
        """Return omega0/k at X = x, enclosed; not finite where the formula does not hold."""

    @abstractmethod
    def formula(self, x: sympy.Expr) -> sympy.Expr:
        """Return omega0/k as an expression in X."""

    def refusal(self, value: arb) -> str | None:  # noqa: ARG002  (a formula that holds everywhere has none)
        """Say why the formula does not hold at this value of the printed variable, or return None."""
        return None

    def in_balls(self, value: arb) -> arb:
        """Return an enclosure of this formula, in rad per time unit, at the working precision of FLINT.

        It encloses the formula, not the exact frequency.  Raises InputError where the formula does not hold.
        """
        k = natural_frequency(self.scale)
        x = value / k if self.scaled_variable else value
        result = k * self.normalised(x)
        why = self.refusal(value)
        if why is not None or not result.is_finite():
            place = f"{self.variable} = {value.str(10, radius=False)}"
            raise InputError(
                f"{self.method} of {self.system} does not hold at {place}: {why or 'it is not real there'}"
            )
        return result

    def __call__(self, value: Any) -> Any:
        """Evaluate omega0 in rad per time unit at a number or an array, correct but for one rounding."""
        return evaluated(self.in_balls, value)

    def error_against(self, value: arb, reference: arb) -> arb:
        """Return an upper bound of the relative error at ``value`` against an enclosure of the true frequency.

        It is as good as the reference: certified when that is a certified enclosure.
        """
        return relative_error(self.in_balls(value), reference)

    def expression(self) -> sympy.Expr:
        """omega0 as one SymPy expression."""
        x = sympy.Symbol(self.variable, real=True)
        return self.scale * self.formula(x / self.scale if self.scaled_variable else x)

    def latex(self) -> str:
        r"""LaTeX of the whole relation, ``\omega_0(A) = ...``."""
        name = r"\varepsilon" if self.variable == "eps" else self.variable
        names = {sympy.Symbol(self.variable, real=True): name}
        return rf"\omega_0({name}) = " + str(sympy.latex(self.expression(), symbol_names=names))

    def mathml(self) -> str:
        """Presentation MathML of the whole relation."""
        return mathml(self.latex())

    def headline(self) -> str:
        """System, method, order and variable in one line."""
        meaning = f"{self.amplitude} amplitude" if self.variable == "A" else self.variable
        return f"{self.system}, {self.method} of the series to order {self.order} in {meaning}"

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.headline()}>"

    def _repr_latex_(self) -> str:
        """The formula for a notebook; the line where the formula would fill pages."""
        with long_integers():
            formula = self.latex()
        return f"$\\displaystyle {formula}$" if len(formula) <= LONGEST_SHOWN else self.headline()

    def _repr_html_(self) -> str:
        """The line, and the formula where it is not pages long."""
        with long_integers():
            formula = self.latex()
        return f"<p>{escape(self.headline())}</p>" + (mathml(formula) if len(formula) <= LONGEST_SHOWN else "")

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: exact numbers as strings."""
        return {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            "variables": [self.variable],
            "expression": str(self.expression()),
        }


def relative_error(value: arb, reference: arb) -> arb:
    """Return an upper bound of |value - reference| / reference over both balls.

    Raises InputError when the reference may be zero.

    >>> float(relative_error(arb(3), arb(2)))
    0.5
    """
    if not reference > 0:
        raise InputError(f"the reference {reference} is not positive, so no relative error exists; enclose it tighter")
    return (abs(value - reference) / reference).upper()
