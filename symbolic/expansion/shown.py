"""How an expansion shows itself: its leading terms, a table of its coefficients, and omega0 over its variable."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.symbolic.arithmetic.rendering import long_integers, mathml, nearest, series_latex

LEADING = 6
"""Terms of a series that are shown; an ellipsis stands for the rest."""
LINE = 72
"""Characters of a series in one line."""
POINTS = 120
USUAL = 1.0
"""How far a series is drawn when nothing says where it ends."""


def decimal(value: sympy.Expr) -> float:
    """An exact coefficient as the nearest float, NaN where a parameter is still symbolic.

    >>> decimal(sympy.Rational(1, 4)), decimal(sympy.Symbol("c"))
    (0.25, nan)
    """
    return nearest(value) if value.is_number else math.nan


def leading_latex(terms: tuple[sympy.Expr, ...]) -> str:
    r"""The first terms of a series in LaTeX, with dots where there are more.

    >>> A = sympy.Symbol("A")
    >>> leading_latex(tuple(A**n for n in range(9)))
    '1 + A + A^{2} + A^{3} + A^{4} + A^{5} + \\cdots'
    """
    with long_integers():
        return series_latex(terms[:LEADING]) + (r" + \cdots" if len(terms) > LEADING else "")


def leading_text(terms: tuple[sympy.Expr, ...]) -> str:
    """As many of the first terms as go into one line.

    >>> A = sympy.Symbol("A")
    >>> leading_text((sympy.S.One, -(A**2) / 16)), leading_text(tuple(A**n * 10**30 for n in range(9)))[-6:]
    ('1 - A**2/16', ' + ...')
    """
    text = ""
    with long_integers():
        for term in terms:
            word = str(term)
            more = f" - {word[1:]}" if word.startswith("-") and text else f" + {word}" if text else word
            if len(text) + len(more) > LINE:
                return (text or word[:LINE]) + " + ..."
            text += more
    return text or "0"


class ShownExpansion(Displayed):
    """What an expansion shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("power",)

    system: str
    method: str
    variable: str
    amplitude: str
    order: int

    @property
    def frequency(self) -> tuple[sympy.Expr, ...]:
        """Exact coefficients by power."""
        raise NotImplementedError

    def terms(self) -> tuple[sympy.Expr, ...]:
        """The nonzero terms in rising order."""
        raise NotImplementedError

    def rows(self) -> list[dict[str, Any]]:
        """One row per power of the variable: power, the exact coefficient, and it as a decimal."""
        return [{"power": n, "coefficient": c, "decimal": decimal(c)} for n, c in enumerate(self.frequency)]

    def own_units(self) -> Mapping[str, str]:
        """The coefficient of X^n is in rad per time unit over the n-th power of the unit of X."""
        return {"decimal": f"rad per time unit / {self.variable}^power"}

    def headline(self) -> str:
        """System, method, order and the leading terms."""
        meaning = f", {self.amplitude} amplitude" if self.variable == "A" else ""
        return f"{self.system}, {self.method} to order {self.order}{meaning}: omega0 = {leading_text(self.terms())}"

    def formulas(self) -> tuple[str, ...]:
        """The leading terms of the series."""
        name = r"\varepsilon" if self.variable == "eps" else self.variable
        return (rf"\omega_0({name}) = {leading_latex(self.terms())}",)

    def _repr_html_(self) -> str:
        return "".join(mathml(formula) for formula in self.formulas())

    def picture(self) -> Picture:
        """omega0 over the variable, as far as the ratio of the last coefficients lets the series be used."""
        coefficients = [decimal(c) for c in self.frequency]
        if any(math.isnan(c) for c in coefficients):
            raise InputError(f"the series of {self.system} holds parameters without a value; set them to draw it")
        grid = [self.reach() * i / POINTS for i in range(POINTS + 1)]
        curve = [sum(c * x**n for n, c in enumerate(coefficients)) for x in grid]
        axis = f"{self.variable} ({self.amplitude})" if self.variable == "A" else self.variable
        label = f"{self.system}, {self.method} to order {self.order}"
        return Picture(label, axis, "omega0, rad per time unit", (Stroke(grid, curve),))

    def reach(self) -> float:
        """Half of where the last nonzero term would be as large as the first: nothing is claimed beyond it."""
        sizes = [abs(decimal(c)) for c in self.frequency]
        last = max((n for n, size in enumerate(sizes) if size and n), default=0)
        return 0.5 * (sizes[0] / sizes[last]) ** (1.0 / last) if last else USUAL
