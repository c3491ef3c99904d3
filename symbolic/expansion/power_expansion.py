r"""omega0 in rational powers of the amplitude, where the force does not begin linearly or holds broken powers.

    omega0 = sum_n c_n A^(g + n/d),    g = (p - 1)/2 of a force that begins like |u|^p

``order`` is the highest n/d kept, the power relative to the leading one.  Where the force begins linearly g = 0.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import sympy
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.common.horner import polynomial_value
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.symbolic.arithmetic.balls import number_ball, rational, scalar_ball
from ridgeback.symbolic.arithmetic.rendering import (
    as_sympy,
    coefficient_row,
    long_integers,
    mathml,
    nearest,
    series_latex,
)
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.shown import POINTS, decimal, leading_latex, leading_text
from ridgeback.symbolic.series.spaces import Scalar


@dataclass(frozen=True, repr=False)
class PowerExpansion(Displayed):
    """omega0 as a series in rational powers of the amplitude.

    Made by ``energy_on_each_side``.

    Parameters
    ----------
    system, method : str
        Names of the oscillator and of the derivation.
    amplitude : str
        Definition of the amplitude: ``peak`` or ``trough``.
    order : int
        Highest power kept, relative to the leading one.
    lead : sympy.Expr
        The coefficient of the leading power, in the oscillator's own units.
    growth : sympy.Rational
        The leading power g.
    root : int
        d: powers rise in steps of 1/d.
    coefficients : tuple of Scalar
        c_n over ``lead``: FLINT rationals, or polynomials in ``names``.
    names : tuple of str
        Symbols that the coefficients hold.
    constants : mapping of str to sympy.Expr
        Values of those that are no parameters: quotients of gamma functions, 2/pi and other irrational numbers.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.each_side import energy_on_each_side
    >>> cubic = energy_on_each_side("u'' + u**3 = 0", 2)
    >>> round(cubic(2.0), 12), cubic.terms()[0]
    (1.694426169588, sqrt(2)*sqrt(pi)*A*gamma(3/4)/gamma(1/4))
    """

    INDEX: ClassVar[tuple[str, ...]] = ("power",)

    system: str
    method: str
    amplitude: str
    order: int
    lead: sympy.Expr
    growth: sympy.Rational
    root: int
    coefficients: tuple[Scalar, ...]
    names: tuple[str, ...] = ()
    constants: Mapping[str, sympy.Expr] = field(default_factory=dict)
    variable: str = "A"

    @cached_property
    def powers(self) -> tuple[sympy.Rational, ...]:
        """The power of A that each coefficient belongs to."""
        return tuple(self.growth + sympy.Rational(n, self.root) for n in range(len(self.coefficients)))

    @cached_property
    def frequency(self) -> tuple[sympy.Expr, ...]:
        """Exact coefficients of A**powers[n], in rad per time unit over that power of the unit of A."""
        values = {sympy.Symbol(name, real=True): c for name, c in self.constants.items()}
        exact = [as_sympy(c, self.names).subs(values) for c in self.coefficients]
        return tuple(self.lead * sympy.expand(c) for c in exact)

    @property
    def symbolic_names(self) -> tuple[str, ...]:
        """Parameters left symbolic."""
        own = {name for name in self.names if name not in self.constants}
        return tuple(sorted(own | {str(symbol) for symbol in self.lead.free_symbols}))

    @property
    def is_power_law(self) -> bool:
        """Whether one term alone is left."""
        return all(c == 0 for c in self.coefficients[1:])

    def terms(self) -> tuple[sympy.Expr, ...]:
        """The nonzero terms of omega0 in rising order."""
        A = sympy.Symbol("A", positive=True)
        named = sympy.Symbol("A", real=True)
        pairs = zip(self.frequency, self.powers, strict=True)
        return tuple((c * A**p).xreplace({A: named}) for c, p in pairs if c != 0)

    def expression(self) -> sympy.Expr:
        """omega0 as one SymPy expression."""
        return sympy.Add(*self.terms())

    def __call__(self, value: Any) -> Any:
        """Evaluate omega0 in rad per time unit at a positive number or an array."""
        x = value ** float(sympy.Rational(1, self.root))
        return polynomial_value(self._rounded, x) * value ** float(self.growth)

    @cached_property
    def _rounded(self) -> tuple[float, ...]:
        return tuple(nearest(c) for c in self.frequency)

    def in_balls(self, value: arb) -> arb:
        """Return an enclosure of this truncated series, in rad per time unit, at FLINT's working precision.

        Raises InputError when a parameter is still symbolic.
        """
        if self.symbolic_names:
            raise InputError(
                f"the coefficients hold {', '.join(self.symbolic_names)} as symbols; set them before evaluating"
            )
        total, x = arb(0), value.root(self.root)
        for c in reversed(self.coefficients):
            total = total * x + scalar_ball(c, self.names, self.constants)
        return number_ball(self.lead) * total * value ** arb(rational(self.growth))

    def truncated(self, order: int) -> PowerExpansion:
        """Keep the terms up to a lower order; raises InputError when it is not between 0 and the present one."""
        if not 0 <= order <= self.order:
            raise InputError(f"order {order} is not within 0..{self.order} of this expansion; derive it again")
        return replace(self, order=order, coefficients=self.coefficients[: order * self.root + 1])

    def harmonic_rows(self) -> list[dict[str, Any]]:
        """Raise InputError: the energy integral has no waveform."""
        raise InputError(
            f"{self.method} gives the frequency only, and {self.system} has no series for the harmonics of u"
        )

    def refusal(self) -> str:
        """Why no other formula is made of it."""
        return (
            f"{self.system}: omega0 begins with A^({self.growth}) and rises in steps of A^(1/{self.root}), and "
            "resummations are of power series in A only; use the series itself"
        )

    def beside_leading(self) -> Expansion:
        """omega0 over its leading term, as a power series in A^(1/root)."""
        return Expansion(
            system=self.system,
            method=self.method,
            variable="A",
            amplitude=self.amplitude,
            order=len(self.coefficients) - 1,
            scale=sympy.S.One,
            scaled_variable=False,
            coefficients=self.coefficients,
            waveform=None,
            amplitude_coefficients=None,
            residual_of=None,
            names=self.names,
            constants=self.constants,
        )

    def latex(self) -> str:
        r"""LaTeX of the whole relation, ``\omega_0(A) = ...`` in rising order."""
        with long_integers():
            return r"\omega_0(A) = " + series_latex(self.terms())

    def mathml(self) -> str:
        """Presentation MathML of the whole relation."""
        return mathml(self.latex())

    def rows(self) -> list[dict[str, Any]]:
        """One row per power of A: the power, the exact coefficient, and it as a decimal."""
        pairs = zip(self.powers, self.frequency, strict=True)
        return [{"power": p, "coefficient": c, "decimal": decimal(c)} for p, c in pairs if c != 0]

    def own_units(self) -> Mapping[str, str]:
        """The coefficient of A^p is in rad per time unit over the p-th power of the unit of A."""
        return {"decimal": "rad per time unit / A^power"}

    def to_dict(self) -> dict[str, object]:
        """The public JSON form; a power that is no whole number is text such as ``"1/2"``."""
        with long_integers():
            rows = [
                {"powers": {"A": int(p) if p.is_Integer else str(p)}, **coefficient_row(c)}
                for p, c in zip(self.powers, self.frequency, strict=True)
                if c != 0
            ]
        return {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            "variables": ["A"],
            "frequency": rows,
        }

    def headline(self) -> str:
        """System, method, order and the leading terms."""
        return (
            f"{self.system}, {self.method} to order {self.order}, {self.amplitude} amplitude: "
            f"omega0 = {leading_text(self.terms())}"
        )

    def formulas(self) -> tuple[str, ...]:
        """The leading terms of the series."""
        return (rf"\omega_0(A) = {leading_latex(self.terms())}",)

    def picture(self) -> Picture:
        """omega0 over the amplitude up to 1."""
        if self.symbolic_names:
            raise InputError(f"the series of {self.system} holds parameters without a value; set them to draw it")
        grid = [(i + 1) / POINTS for i in range(POINTS)]
        curve = [float(self(x)) for x in grid]
        if not all(map(math.isfinite, curve)):
            raise InputError(f"the series of {self.system} has no finite value up to A = 1; evaluate it elsewhere")
        label = f"{self.system}, {self.method} to order {self.order}"
        return Picture(label, f"A ({self.amplitude})", "omega0, rad per time unit", (Stroke(grid, curve),))
