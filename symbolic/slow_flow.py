r"""The frozen result of multiple scales: ``phi' = omega0(a, m)`` and ``a'/a = damping(a, m)``, exact.

``a`` is the ``fundamental`` amplitude, ``m`` the small parameter (mu or eps).  Internally k = 1 and m stands for m/k;
``frequency`` and ``damping`` are in the oscillator's own units: a term a^p m^r of either carries k^(1-r).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from symbolic.expansion import nearest, series_latex
from symbolic.fourier import Trig
from symbolic.rendering import as_sympy, mathml
from symbolic.spaces import Scalar


@dataclass(frozen=True)
class Term:
    """One term ``coefficient * a^powers[0] * m^powers[1]``."""

    powers: tuple[int, int]
    coefficient: sympy.Expr


@dataclass(frozen=True)
class SlowFlow:
    """phi' and a'/a as exact polynomials in the fundamental amplitude and the small parameter.

    >>> from symbolic.multiple_scales import multiple_scales
    >>> from symbolic.systems import find
    >>> flow = multiple_scales(find("pendulum"), 4)
    >>> flow.frequency_at(1.0, 0.01)
    0.9384265625
    >>> flow.residual()
    []
    """

    system: str
    small: str
    """Name of the small parameter: ``mu`` or ``eps``."""
    order: int
    """Highest weighted degree p + weight r kept."""
    weight: int
    scale: sympy.Expr
    omega: tuple[Scalar, ...]
    """Grades of omega0 in units with k = 1, as polynomials in (x, m, other parameters)."""
    delta: tuple[Scalar, ...]
    waveform: tuple[Trig, ...]
    """Grades of u."""
    names: tuple[str, ...]
    residual_of: Callable[[SlowFlow], list[int]]
    method: str = "multiple-scales"
    amplitude: str = "fundamental"

    @property
    def variables(self) -> tuple[str, str]:
        """Names of the two variables."""
        return ("a", self.small)

    @cached_property
    def frequency(self) -> tuple[Term, ...]:
        """The nonzero terms of phi', in rad per time unit, by weighted degree."""
        return self._terms(self.omega)

    @cached_property
    def damping(self) -> tuple[Term, ...]:
        """The nonzero terms of a'/a, per time unit, by weighted degree."""
        return self._terms(self.delta)

    def _terms(self, grades: tuple[Scalar, ...]) -> tuple[Term, ...]:
        found = []
        for n, grade in enumerate(grades):
            by_power: dict[int, dict[tuple[int, ...], Any]] = {}
            for powers, value in grade.to_dict().items():
                by_power.setdefault(int(powers[1]), {})[(0, 0, *powers[2:])] = value
            for r, rows in sorted(by_power.items()):
                coefficient = sum(
                    (as_sympy(v) * _monomial(self.names[1:], powers[2:]) for powers, v in rows.items()), sympy.S.Zero
                )
                found.append(Term((n - self.weight * r, r), coefficient * self.scale ** (1 - r)))
        return tuple(found)

    def residual(self) -> list[int]:
        """Substitute u and the flow back into the equation; return the grades that do not cancel (none: exact)."""
        return self.residual_of(self)

    def frequency_at(self, a: Any, small: float) -> Any:
        """Evaluate phi' in rad per time unit; ``a`` may be an array."""
        return _evaluate(self.frequency, a, small)

    def damping_at(self, a: Any, small: float) -> Any:
        """Evaluate a'/a per time unit; ``a`` may be an array."""
        return _evaluate(self.damping, a, small)

    def frequency_expression(self) -> sympy.Expr:
        """phi' as one SymPy expression."""
        return sympy.Add(*self.expressions(self.frequency))

    def damping_expression(self) -> sympy.Expr:
        """a'/a as one SymPy expression."""
        return sympy.Add(*self.expressions(self.damping))

    def expressions(self, terms: tuple[Term, ...]) -> tuple[sympy.Expr, ...]:
        """Terms as SymPy expressions, in the order given."""
        a, m = (sympy.Symbol(name, real=True) for name in self.variables)
        return tuple(t.coefficient * a ** t.powers[0] * m ** t.powers[1] for t in terms)

    def latex(self) -> tuple[str, str]:
        r"""LaTeX of the two relations, ``\dot\varphi = ...`` and ``\dot a/a = ...``."""
        return (
            r"\dot{\varphi} = " + series_latex(self.expressions(self.frequency)),
            r"\frac{\dot{a}}{a} = " + series_latex(self.expressions(self.damping)),
        )

    def mathml(self) -> tuple[str, str]:
        """Presentation MathML of the two relations."""
        first, second = self.latex()
        return mathml(first), mathml(second)

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: exact coefficients as strings."""
        return {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            "weight": self.weight,
            "variables": list(self.variables),
            "frequency": self._rows(self.frequency),
            "damping": self._rows(self.damping),
        }

    def _rows(self, terms: tuple[Term, ...]) -> list[dict[str, object]]:
        return [
            {"powers": dict(zip(self.variables, t.powers, strict=True)), "coefficient": str(t.coefficient)}
            for t in terms
        ]


def _monomial(names: tuple[str, ...], powers: tuple[int, ...]) -> sympy.Expr:
    return sympy.Mul(*[sympy.Symbol(name, real=True) ** int(n) for name, n in zip(names, powers, strict=True)])


def _evaluate(terms: tuple[Term, ...], a: Any, small: float) -> Any:
    """Sum the terms by Horner's rule in a, with the small parameter inserted first."""
    by_power: dict[int, float] = {}
    for term in terms:
        p, r = term.powers
        by_power[p] = by_power.get(p, 0.0) + nearest(term.coefficient) * small**r
    result: Any = a * 0.0
    for p in range(max(by_power, default=0), -1, -1):
        result = result * a + by_power.get(p, 0.0)
    return result
