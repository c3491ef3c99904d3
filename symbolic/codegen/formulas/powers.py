r"""Sums of rational powers of the amplitude as functions: omega0 of a force like u^3 or u^(1/3), and averaged losses.

    sum_j c_j a^(p_j) m_1^(q_1) ...,      p_j = n_j/d:      a polynomial in y = a^(1/d), times the lowest power of y

The coefficients are closed expressions; what parameters bring into them is computed first, each such factor once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Final, TypeAlias

from sympy import Add, Expr, Rational, Symbol, ceiling, expand

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.expressions import exact_number, rooted, valued
from ridgeback.symbolic.codegen.formulas.frequency import under
from ridgeback.symbolic.codegen.formulas.wording import (
    A_RATE,
    A_SMALL,
    GROWTH,
    OMEGA0,
    PARAMETER,
    SMALL,
    common_facts,
    limit_fact,
    titled,
    variable_meaning,
)
from ridgeback.symbolic.codegen.motions.transient import transient_functions
from ridgeback.symbolic.codegen.naming import argument_names
from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.polynomial import nested
from ridgeback.symbolic.codegen.program import (
    Argument,
    Domain,
    Form,
    Function,
    Operand,
    Polynomial,
    Steps,
    Terms,
    needed,
)
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.expansion.amplitude import MEANINGS

if TYPE_CHECKING:
    from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
    from ridgeback.symbolic.flow.loss_flow import LossFlow
    from ridgeback.symbolic.flow.term import LossTerm

Power: TypeAlias = "int | Rational"
Sum: TypeAlias = "list[tuple[tuple[Power, ...], Expr]]"
"""Powers of the amplitude and of the small parameters, each with its coefficient."""
ROOT: Final = "root_of_amplitude"


def power_form(series: PowerExpansion, request: CodeRequest) -> Form:
    """Build omega0 and its slope; raises InputError for a motion, which an energy integral has none of."""
    if request.motion:
        raise InputError(f"{series.method} gives the frequency only, so that no motion is written; leave it out")
    terms: Sum = [((p,), c) for p, c in zip(series.powers, series.frequency, strict=True) if c != 0]
    slope: Sum = [((p - 1,), p * c) for (p,), c in terms if p != 0]
    made = _Powers(series.variable, variable_meaning(series), (), (*terms, *slope), request)
    functions = (
        made.function("omega0", OMEGA0, terms),
        made.function("omega0_slope", f"Derivative of omega0 by {series.variable}.", slope),
    )
    facts = (
        *common_facts(series.method, request.equation, rational=False),
        f"Variable {series.variable}: {variable_meaning(series)}.",
        f"Order: powers of {series.variable} from {series.growth} to {series.growth + series.order} that are there.",
        *limit_fact(series.variable, request.limit),
        *request.more,
    )
    return Form(series.system, f"Fundamental frequency of {titled(series.system)}", facts, functions)


def loss_form(flow: LossFlow, request: CodeRequest) -> Form:
    """Build omega0, growth_rate, amplitude_rate, amplitude_after and phase_after of averaged losses.

    Raises InputError for a motion: averaging gives amplitude and phase only.
    """
    if request.motion:
        raise InputError(f"'{flow.system}': averaged losses give amplitude and phase and no motion; leave it out")
    omega, growth = _sum(flow.frequency), _sum(flow.growth_rate)
    rate: Sum = [((p + 1, *others), c) for (p, *others), c in growth]
    made = _Powers("a", MEANINGS[flow.amplitude], flow.losses, (*omega, *growth, *rate), request)
    phase, change = made.function("omega0", OMEGA0, omega), made.function("amplitude_rate", A_RATE, rate)
    functions = (phase, made.function("growth_rate", GROWTH, growth), change)
    after = transient_functions(
        phase, change, made.domain, request.real, stops=bool(min(p for (p, *_), _ in rate) <= 0)
    )
    facts = (
        *common_facts(f"{flow.method}, {flow.losses_to()}", request.equation, rational=False),
        f"Amplitude a: {MEANINGS[flow.amplitude]}.",
        f"Order: powers of a up to {flow.order}.",
        *limit_fact("a", request.limit),
        *request.more,
    )
    return Form(flow.system, f"Slow flow of {titled(flow.system)}, averaged", facts, (*functions, *after))


def _sum(terms: Iterable[LossTerm]) -> Sum:
    return [(term.powers, term.coefficient) for term in terms]


@dataclass(frozen=True)
class _Powers:
    """What the functions of one result share."""

    variable: str
    meaning: str
    small: tuple[str, ...]
    whole: tuple[tuple[tuple[Power, ...], Expr], ...]
    """All terms of all functions."""
    request: CodeRequest

    @property
    def real(self) -> Real:
        """Format of the numbers."""
        return self.request.real

    @cached_property
    def degree(self) -> int:
        """d: every power is a multiple of 1/d."""
        return math.lcm(*(int(Rational(powers[0]).q) for powers, _ in self.whole))

    @cached_property
    def domain(self) -> Domain:
        """Amplitudes from 0 on; where a power is negative or broken, from where it is a number of full precision."""
        domain = self.request.domain(self.variable, even=False)
        lowest = min(Rational(powers[0]) for powers, _ in self.whole)
        if self.degree == 1 and lowest >= 0:
            return domain
        smallest = (self.real.low + 2 * self.real.digits) / max(1, -lowest)
        return replace(domain, low=math.ldexp(1.0, int(ceiling(smallest))))

    @cached_property
    def called(self) -> dict[str, str]:
        """Arguments' names by the parameters', the small ones first; there is no natural frequency among them."""
        held = sorted({str(s) for _, c in self.whole for s in c.free_symbols} - set(self.small))
        return argument_names((*self.small, *held), free=("k",))

    @cached_property
    def arguments(self) -> tuple[Argument, ...]:
        """The amplitude, then the parameters."""
        told = SMALL if len(self.small) == 1 else A_SMALL
        own = (Argument(name, told if n in self.small else PARAMETER) for n, name in self.called.items())
        return (Argument(self.variable, self.meaning), *own)

    def function(self, name: str, summary: str, terms: Sum) -> Function:
        """One sum as a function."""
        steps, parts = Steps(self.real), _Parts(self.called)
        sums: dict[tuple[int, ...], Expr] = {}
        for (power, *others), coefficient in terms:
            for factor, index in parts.split(coefficient):
                rise = int(Rational(power) * self.degree)
                key = (rise, *map(int, others), index)
                sums[key] = sums.get(key, 0) + factor
        inner: Terms = {key: Number(exact_number(total), self.real) for key, total in sums.items() if total != 0}
        for part, value in parts.where:
            under(steps, part, valued(steps, value, self.called))
        root = self.variable if self.degree == 1 else ROOT
        if self.degree > 1:
            under(steps, ROOT, rooted(steps, self.variable, 1, self.degree))
        rows = {
            (*powers, *(int(index == i) for i in range(1, len(parts.where) + 1))): c
            for (*powers, index), c in inner.items()
        }
        names = (root, *(self.called[n] for n in self.small), *(part for part, _ in parts.where))
        result = _polynomial(steps, names, rows) if rows else steps.number(0)
        where = (*((ROOT, Symbol(self.variable) ** Rational(1, self.degree)),) * (self.degree > 1), *parts.where)
        told = Polynomial(names, rows, "", where)
        body = needed(steps.taken, result)
        whole = self.degree == 1 and all(powers[0] >= 0 for powers in rows)  # else a root or quotient at rest
        return Function(name, summary, self.arguments, body, result, self.domain, (), told, bounded=whole)


@dataclass
class _Parts:
    """The factors that parameters bring into coefficients, by their names in the code, as they are met."""

    called: dict[str, str]
    where: list[tuple[str, Expr]] = field(default_factory=list)

    def split(self, coefficient: Expr) -> list[tuple[Expr, int]]:
        """A coefficient as numbers times such factors, each by its place from 1 on, 0 for none."""
        found: dict[int, Expr] = {}
        for term in Add.make_args(expand(coefficient)):
            number, rest = term.as_independent(*term.free_symbols, as_Add=False) if term.free_symbols else (term, None)
            index = 0 if rest is None else self._place(rest)
            found[index] = found.get(index, 0) + number
        return [(number, index) for index, number in found.items()]

    def _place(self, value: Expr) -> int:
        for index, (_, known) in enumerate(self.where, start=1):
            if known == value:
                return index
        self.where.append((f"part_{len(self.where) + 1}", value))
        return len(self.where)


def _polynomial(steps: Steps, names: Sequence[str], rows: Terms) -> Operand:
    """A sum whose first powers may be negative: a polynomial in the first name, times its lowest power."""
    low = min(powers[0] for powers in rows)
    raised = {(powers[0] - low, *powers[1:]): c for powers, c in rows.items()}
    value = nested(steps, "y", tuple(names), raised)
    if low > 0:
        return steps.multiply("result", steps.power(names[0], low), value)
    return steps.divide("result", value, steps.power(names[0], -low)) if low < 0 else value
