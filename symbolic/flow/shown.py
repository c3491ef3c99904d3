"""How a slow flow shows itself: the leading terms of its two equations, a table of their terms, and a picture."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.symbolic.arithmetic.rendering import mathml
from ridgeback.symbolic.expansion.shown import POINTS, decimal, leading_latex, leading_text
from ridgeback.symbolic.flow.term import Term


class ShownSlowFlow(Displayed):
    """What a slow flow shows of itself."""

    system: str
    method: str
    order: int
    amplitude: str
    weights: Mapping[str, int]

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables: the amplitude, then the small parameters."""
        raise NotImplementedError

    @property
    def frequency(self) -> tuple[Term, ...]:
        """The terms of phi'."""
        raise NotImplementedError

    @property
    def backbone(self) -> tuple[Term, ...]:
        """The terms of phi' without small parameters."""
        return tuple(term for term in self.frequency if not any(term.powers[1:]))

    @property
    def growth_rate(self) -> tuple[Term, ...]:
        """The terms of a'/a."""
        raise NotImplementedError

    def expressions(self, terms: tuple[Term, ...]) -> tuple[sympy.Expr, ...]:
        """Terms as SymPy expressions."""
        raise NotImplementedError

    def rows(self) -> list[dict[str, Any]]:
        """One row per term: the relation, the power of each variable, the exact coefficient and it as a decimal."""
        return [
            {
                "relation": relation,
                **dict(zip((f"power_{name}" for name in self.variables), term.powers, strict=True)),
                "coefficient": term.coefficient,
                "decimal": decimal(term.coefficient),
            }
            for relation, terms in (("phi'", self.frequency), ("a'/a", self.growth_rate))
            for term in terms
        ]

    def own_units(self) -> Mapping[str, str]:
        """Coefficients are per time unit over the powers of the variables."""
        return {"decimal": "rad per time unit / powers of the variables"}

    def headline(self) -> str:
        """System, method, order and the leading terms of both equations."""
        phase, growth = (leading_text(self.expressions(terms)) for terms in (self.frequency, self.growth_rate))
        return f"{self.system}, {self.method} to order {self.order}: phi' = {phase}; a'/a = {growth}"

    def formulas(self) -> tuple[str, ...]:
        """The leading terms of both equations."""
        return (
            r"\dot{\varphi} = " + leading_latex(self.expressions(self.frequency)),
            r"\frac{\dot{a}}{a} = " + leading_latex(self.expressions(self.growth_rate)),
        )

    def _repr_html_(self) -> str:
        return "<br>".join(mathml(formula) for formula in self.formulas())

    def picture(self) -> Picture:
        """phi' over a where every small parameter vanishes: the undamped backbone."""
        terms = [(decimal(t.coefficient), t.powers[0]) for t in self.backbone]
        if any(math.isnan(c) for c, _ in terms):
            raise InputError(f"the flow of {self.system} holds parameters without a value; set them to draw it")
        first = next((c for c, power in terms if power == 0), 0.0)
        last, top = max(((c, power) for c, power in terms if power), key=lambda term: term[1], default=(0.0, 0))
        reach = 0.5 * abs(first / last) ** (1.0 / top) if top and last else 1.0
        grid = [reach * i / POINTS for i in range(POINTS + 1)]
        curve = [sum(c * a**power for c, power in terms) for a in grid]
        small = ", ".join(f"{name} = 0" for name in self.variables[1:])
        label = f"{self.system}, {self.method} to order {self.order}{f' ({small})' if small else ''}"
        return Picture(label, f"a ({self.amplitude})", "phi', rad per time unit", (Stroke(grid, curve),))
