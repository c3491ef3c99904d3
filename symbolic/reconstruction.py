r"""u(t) from a slow flow: every harmonic of the phase, as a polynomial in the amplitude and the small parameters.

    u = a cos phi + sum_j [C_j(a, m) cos(j phi) + S_j(a, m) sin(j phi)],      u' = omega du/dphi + a delta du/da

Damping gives the sines.  C_1 = a and S_1 = 0 by the definition of the ``fundamental`` amplitude.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from symbolic.expansion import series_latex
from symbolic.fourier import degree, harmonic
from symbolic.rendering import mathml
from symbolic.slow_flow import SlowFlow, Term, evaluate, json_rows, rounded

PHI = sympy.Symbol("phi", real=True)
"""The phase in expressions."""


@dataclass(frozen=True)
class FlowHarmonic:
    """u holds ``(sum of cosine) cos(multiple phi) + (sum of sine) sin(multiple phi)``; multiple 0 is the mean."""

    multiple: int
    cosine: tuple[Term, ...]
    sine: tuple[Term, ...]


@dataclass(frozen=True)
class Reconstruction:
    """The displacement u(a, phi, small parameters) of a slow flow, through its weighted degree + 1.

    >>> from symbolic.multiple_scales import multiple_scales
    >>> from symbolic.systems import find
    >>> u = Reconstruction(multiple_scales(find("duffing"), 2))
    >>> u.expression()
    a**3*cos(3*phi)/32 + a*cos(phi)
    >>> u(0.5, 0.0, 0.0)
    0.50390625
    """

    flow: SlowFlow

    @cached_property
    def harmonics(self) -> tuple[FlowHarmonic, ...]:
        """The harmonics of u that do not vanish, the mean first."""
        waveform, found = self.flow.waveform, []
        for multiple in range(max(degree(p) for p in waveform) + 1):
            cosine, sine = (
                self.flow.terms(tuple(harmonic(p, multiple)[part] for p in waveform), rate=0) for part in (0, 1)
            )
            if cosine or sine:
                found.append(FlowHarmonic(multiple, cosine, sine))
        return tuple(found)

    def __call__(
        self,
        a: Any,
        phi: Any,
        *small: float,
        cos: Callable[[Any], Any] = math.cos,
        sin: Callable[[Any], Any] = math.sin,
    ) -> Any:
        """Evaluate u at an amplitude and a phase; for arrays give their own ``cos`` and ``sin``, such as NumPy's.

        Raises InputError when there is not one value for each small parameter.
        """
        values, total = self.flow.checked(small), a * 0.0
        for multiple, cosine, sine in self._rounded:
            total = total + evaluate(cosine, a, values) * cos(multiple * phi)
            if sine:
                total = total + evaluate(sine, a, values) * sin(multiple * phi)
        return total

    @cached_property
    def _rounded(self) -> tuple[tuple[int, Any, Any], ...]:
        return tuple((h.multiple, rounded(h.cosine), rounded(h.sine)) for h in self.harmonics)

    def expression(self) -> sympy.Expr:
        """u as one SymPy expression in ``a``, ``phi`` and the small parameters."""
        parts = []
        for h in self.harmonics:
            parts.append(sympy.Add(*self.flow.expressions(h.cosine)) * sympy.cos(h.multiple * PHI))
            parts.append(sympy.Add(*self.flow.expressions(h.sine)) * sympy.sin(h.multiple * PHI))
        return sympy.Add(*parts)

    def velocity_expression(self) -> sympy.Expr:
        """u' along the flow, as it stands: terms beyond the order are not cut off.

        >>> from symbolic.multiple_scales import multiple_scales
        >>> from symbolic.systems import find
        >>> Reconstruction(multiple_scales(find("damped-linear"), 2)).velocity_expression()
        -a*mu*cos(phi) - a*sin(phi)
        """
        return along(self.flow, self.expression())

    def latex(self) -> tuple[str, ...]:
        r"""LaTeX of u as the sum of its harmonics, then of each amplitude: ``C_3 = \frac{a^{3}}{32}``.

        >>> from symbolic.multiple_scales import multiple_scales
        >>> from symbolic.systems import find
        >>> Reconstruction(multiple_scales(find("duffing"), 2)).latex()
        ('u = a \\cos \\varphi + C_{3} \\cos 3 \\varphi', 'C_{3} = \\frac{a^{3}}{32}')
        """
        total, rows = r"a \cos \varphi", []
        for h in self.harmonics:
            for letter, name, terms in (("C", "cos", h.cosine), ("S", "sin", h.sine)):
                if terms and h.multiple != 1:
                    wave = rf" \{name} {h.multiple} \varphi" if h.multiple else ""
                    total += rf" + {letter}_{{{h.multiple}}}{wave}"
                    rows.append(rf"{letter}_{{{h.multiple}}} = " + series_latex(self.flow.expressions(terms)))
        return (f"u = {total}", *rows)

    def mathml(self) -> tuple[str, ...]:
        """Presentation MathML of the same."""
        return tuple(mathml(text) for text in self.latex())

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: exact coefficients as strings, by harmonic."""
        variables = self.flow.variables
        return {
            "system": self.flow.system,
            "amplitude": self.flow.amplitude,
            "variables": list(variables),
            "harmonics": [
                {"multiple": h.multiple, "cosine": json_rows(variables, h.cosine), "sine": json_rows(variables, h.sine)}
                for h in self.harmonics
            ],
        }


def along(flow: SlowFlow, expression: sympy.Expr) -> sympy.Expr:
    """d/dt of an expression in a and phi along a slow flow: omega d/dphi + a delta d/da.

    >>> from symbolic.multiple_scales import multiple_scales
    >>> from symbolic.systems import find
    >>> along(multiple_scales(find("pendulum"), 2), PHI)
    1 - a**2/16
    """
    a = sympy.Symbol("a", real=True)
    rate = flow.frequency_expression() * expression.diff(PHI)
    return sympy.expand(rate + a * flow.damping_expression() * expression.diff(a))
