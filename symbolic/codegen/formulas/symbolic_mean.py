"""omega0 as an arithmetic-geometric mean where parameters have no value: they are arguments.

    m u'' + k u + k3 u^3 = 0:      omega0 = M(sqrt(a + e A^2), sqrt(a + e A^2/2)),     a = k/m, e = k3/m
    L u'' + g sin(b u)/b = 0:      omega0 = sqrt(g/L) M(1, cos(b A/2)),                b a number

(DLMF 19.8.5 with 22.19.2 and 22.19.6).  Beyond the separatrix of a softening force the first root is of a negative
number, and the result none.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import pi
from typing import Final

from sympy import Expr, Poly, S, cancel, sin

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.expressions import valued
from ridgeback.symbolic.codegen.formulas.closed_forms import MeanForm, mean_form, mean_steps
from ridgeback.symbolic.codegen.formulas.frequency import under
from ridgeback.symbolic.codegen.formulas.resummations import means_steps, number_of, slope_of
from ridgeback.symbolic.codegen.formulas.wording import OMEGA0, PARAMETER, titled
from ridgeback.symbolic.codegen.naming import argument_names
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Operand, Steps, needed
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.expansion.amplitude import MEANINGS
from ridgeback.symbolic.grammar.parse import U, V
from ridgeback.symbolic.resummation.elliptic_nome import PendulumMeans
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.structure import free_names

MOST: Final = 10
"""Steps that bring any two numbers of a ratio above 1e-16 together."""


@dataclass(frozen=True)
class SymbolicMean:
    """The closed form of a cubic force, or of a sine."""

    system: str
    linear: Expr
    """a, or of a sine the square of the natural frequency."""
    cubic: Expr
    """e; 0 of a sine."""
    rate: Fraction | None
    """b of a sine."""

    def form(self, request: CodeRequest) -> Form:
        """omega0 and its slope; raises InputError for a range of a sine that goes to its separatrix, or has no end."""
        named = argument_names(sorted({str(s) for e in (self.linear, self.cubic) for s in e.free_symbols}), free=("k",))
        domain, steps = request.domain("A"), Steps(request.real)
        meaning = f"peak amplitude, {MEANINGS['peak']}"
        arguments = (Argument("A", meaning), *(Argument(name, PARAMETER) for name in named.values()))
        high, low, count = self._sine(steps, domain) if self.rate is not None else self._cubic(steps, domain, named)
        for n in range(count):
            total = steps.add("total", high, low)
            if n < count - 1:
                low = steps.root(f"mean_{n}", steps.multiply("area", high, low))
            high = steps.multiply(f"sum_{n}", number_of(steps, Fraction(1, 2)), total)
        if self.rate is not None:
            under(steps, "natural_frequency", valued(steps, self.linear ** (S.One / 2), named))
            high = steps.multiply("result", "natural_frequency", high)
        result = str(high)
        made = Function("omega0", OMEGA0, arguments, needed(steps.taken, result), result, domain)
        facts = (
            *((f"Equation: {request.equation}.",) if request.equation else ()),
            f"Method: closed form, the arithmetic-geometric mean in {count} steps.",
            "Order: none, the formula is exact.",
            f"Variable A: {meaning}.",
            *request.more,
        )
        title = f"Fundamental frequency of {titled(self.system)}"
        return Form(self.system, title, facts, (made, slope_of(made, request.real)))

    def _sine(self, steps: Steps, domain: Domain) -> tuple[Operand, Operand, int]:
        """1, cos(b A/2), and how many steps the range needs."""
        rate = self.rate or Fraction(1)
        if not domain.known or domain.high >= pi / rate:
            raise InputError(f"the closed form of {self.system} needs a range; give --up-to below {pi / rate:.6g}")
        means = PendulumMeans(rate)
        return (*means_steps(means, "A", steps), mean_steps(means, domain.high, steps.real.digits))

    def _cubic(self, steps: Steps, domain: Domain, named: dict[str, str]) -> tuple[Operand, Operand, int]:  # noqa: ARG002
        """The roots of a + e A^2 and of a + e A^2/2."""
        under(steps, "part_1", valued(steps, self.linear, named))
        under(steps, "part_2", valued(steps, self.cubic, named))
        share = steps.multiply("high_share", "part_2", steps.square("A"))
        half = steps.multiply("low_share", number_of(steps, Fraction(1, 2)), share)
        high = steps.root("high", steps.add("high_inside", "part_1", share))
        return high, steps.root("low", steps.add("low_inside", "part_1", half)), MOST


def symbolic_mean(oscillator: Oscillator) -> SymbolicMean:
    """The closed form of a force with parameters left symbolic; raises InputError for another force.

    >>> found = symbolic_mean(Oscillator.from_equation("m*u'' + k*u + k3*u**3 = 0"))
    >>> found.linear, found.cubic
    (k/m, k3/m)
    """
    force = oscillator.substituted_force
    factor, wave = force.as_independent(U, as_Add=False)
    if isinstance(wave, sin) and (rate := cancel(wave.args[0] / U)).is_Rational and rate > 0:
        return SymbolicMean(oscillator.name, factor * rate, S.Zero, Fraction(int(rate.p), int(rate.q)))
    terms = Poly(force, U).as_dict() if not force.has(V) and force.is_polynomial(U) else {}
    if terms and set(terms) <= {(1,), (3,)} and (1,) in terms and (3,) in terms:
        return SymbolicMean(oscillator.name, terms[1,], terms[3,], None)
    raise InputError(
        f"{oscillator.name} is neither c sin(b u) with a number b nor a u + e u^3, the forces with an elliptic "
        "frequency known here; use the series"
    )


def closed_form(oscillator: Oscillator) -> MeanForm | SymbolicMean:
    """The closed form of a pendulum or a Duffing oscillator; parameters without a value become arguments.

    Raises InputError for other forces.

    >>> type(closed_form(Oscillator.from_equation("L*u'' + g*sin(u) = 0"))).__name__
    'SymbolicMean'
    """
    return symbolic_mean(oscillator) if free_names(oscillator.substituted_force) else mean_form(oscillator)
