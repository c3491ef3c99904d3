r"""u(t) from a slow flow: every harmonic of the phase, as a polynomial in the amplitude and the small parameters.

    u = a cos phi + sum_j [C_j(a, m) cos(j phi) + S_j(a, m) sin(j phi)],      u' = omega du/dphi + a delta du/da

Damping gives the sines.  C_1 = a and S_1 = 0 by the definition of the ``fundamental`` amplitude.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, NamedTuple, TypeAlias

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rendering import mathml, nearest, series_latex
from ridgeback.symbolic.flow.slow_flow import SlowFlow, evaluate, json_rows, rounded
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.series.trigonometric import degree, harmonic

MOST_ITERATIONS: Final = 200
FARTHEST: Final = 1e6
"""A step of the iteration beyond which it runs away."""
ROUNDING: Final = 1e-14
"""What is left of a state when only rounding is, relative to it."""
Wave: TypeAlias = Callable[[Any], Any]
Rows: TypeAlias = "tuple[tuple[float, tuple[int, ...]], ...]"
PHI: Final = sympy.Symbol("phi", real=True)
"""The phase in expressions."""


@dataclass(frozen=True)
class FlowHarmonic:
    """u holds ``(sum of cosine) cos(multiple phi) + (sum of sine) sin(multiple phi)``; multiple 0 is the mean."""

    multiple: int
    cosine: tuple[Term, ...]
    sine: tuple[Term, ...]


class _Rounded(NamedTuple):
    """A harmonic with its coefficients rounded to floats."""

    multiple: int
    cosine: Rows
    sine: Rows


def _by_amplitude(rows: Rows) -> Rows:
    """a d/da."""
    return tuple((coefficient * powers[0], powers) for coefficient, powers in rows)


@dataclass(frozen=True)
class Reconstruction:
    """The displacement u(a, phi, small parameters) of a slow flow, through its weighted degree + 1.

    A call evaluates it, ``velocity`` its derivative along the flow; ``expression`` and ``latex`` are the formula.

    Parameters
    ----------
    flow : SlowFlow
        Made by ``multiple_scales``.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
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

    def __call__(self, a: Any, phi: Any, *small: float, cos: Wave = math.cos, sin: Wave = math.sin) -> Any:
        """Evaluate u at an amplitude and a phase; for arrays give their own ``cos`` and ``sin``, such as NumPy's.

        Raises InputError when there is not one value for each small parameter.
        """
        values, total = self.flow.checked(small), a * 0.0
        for h in self._rounded:
            total = total + evaluate(h.cosine, a, values) * cos(h.multiple * phi)
            total = total + evaluate(h.sine, a, values) * sin(h.multiple * phi)
        return total

    def velocity(self, a: Any, phi: Any, *small: float, cos: Wave = math.cos, sin: Wave = math.sin) -> Any:
        """Evaluate u' = omega du/dphi + a delta du/da along the flow; errors and arrays as for u itself."""
        omega, delta = self.flow.frequency_at(a, *small), self.flow.growth_rate_at(a, *small)
        total = a * 0.0
        for h in self._rounded:
            wave, slope = cos(h.multiple * phi), sin(h.multiple * phi)
            c, s = evaluate(h.cosine, a, small), evaluate(h.sine, a, small)
            total = total + omega * h.multiple * (s * wave - c * slope)
            total = total + delta * evaluate(_by_amplitude(h.cosine), a, small) * wave
            total = total + delta * evaluate(_by_amplitude(h.sine), a, small) * slope
        return total

    def start(self, u: float, v: float, *small: float) -> tuple[float, float]:
        """The amplitude and phase of the state (u, u') = (u, v), by fixed-point iteration from the linear motion.

        Raises InputError when the iteration does not settle: the state is too large for this order.

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> wave = Reconstruction(multiple_scales(find("duffing"), 2))
        >>> wave.start(0.50390625, 0.0, 0.0)
        (0.5, 0.0)
        """
        k = nearest(self.flow.scale)
        x, y, last = u, v / k, math.inf
        for _ in range(MOST_ITERATIONS):
            a, phi = math.hypot(x, y), math.atan2(-y, x)
            change = (u - self(a, phi, *small), (v - self.velocity(a, phi, *small)) / k)
            x, y, size = x + change[0], y + change[1], math.hypot(*change)
            if not size < FARTHEST:
                break
            if last <= size <= ROUNDING * (abs(u) + abs(v) / k):  # it shrinks no more
                return math.hypot(x, y), math.atan2(-y, x) + 0.0
            last = size
        raise InputError(
            f"{self.flow.system}: no amplitude and phase of this order give u = {u:g}, u' = {v:g}; start closer to rest"
        )

    @cached_property
    def _rounded(self) -> tuple[_Rounded, ...]:
        return tuple(_Rounded(h.multiple, rounded(h.cosine), rounded(h.sine)) for h in self.harmonics)

    def expression(self) -> sympy.Expr:
        """u as one SymPy expression in ``a``, ``phi`` and the small parameters."""
        parts = []
        for h in self.harmonics:
            parts.append(sympy.Add(*self.flow.expressions(h.cosine)) * sympy.cos(h.multiple * PHI))
            parts.append(sympy.Add(*self.flow.expressions(h.sine)) * sympy.sin(h.multiple * PHI))
        return sympy.Add(*parts)

    def velocity_expression(self) -> sympy.Expr:
        """u' along the flow, as it stands: terms beyond the order are not cut off.

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> Reconstruction(multiple_scales(find("damped-linear"), 2)).velocity_expression()
        -a*mu*cos(phi) - a*sin(phi)
        """
        return along(self.flow, self.expression())

    def latex(self) -> tuple[str, ...]:
        r"""LaTeX of u as the sum of its harmonics, then of each amplitude: ``C_3 = \frac{a^{3}}{32}``.

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
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

    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> along(multiple_scales(find("pendulum"), 2), PHI)
    1 - a**2/16
    """
    a = sympy.Symbol("a", real=True)
    rate = flow.frequency_expression() * expression.diff(PHI)
    return sympy.expand(rate + a * flow.growth_rate_expression() * expression.diff(a))
