"""omega0 by its closed form, the arithmetic-geometric mean, and the pendulum's series in sin(A/2) with a few terms.

    omega0 = k M(a, b),        omega0 = k / sum_n (binom(2n, n)/4^n)^2 z^(2n),   z = sin(c A/2),   n < terms

for the force sin(c u)/c (DLMF 19.5.1 and 19.8.5); a and b as in ``ridgeback.symbolic.resummation.elliptic_nome``.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import comb
from typing import Final

from flint import arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.formulas.resummations import means_steps, number_of, slope_of
from ridgeback.symbolic.codegen.formulas.wording import (
    OMEGA0,
    SCALING,
    frequency_argument,
    limit_fact,
    titled,
    variable_meaning,
)
from ridgeback.symbolic.codegen.motions.trigonometry import sine_of_small
from ridgeback.symbolic.codegen.naming import variable_name
from ridgeback.symbolic.codegen.polynomial import K
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Operand, Steps, needed
from ridgeback.symbolic.codegen.proofs.bounds import upper
from ridgeback.symbolic.codegen.proofs.notes import upwards
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.resummation.elliptic_nome import Means, NomeForm, PendulumMeans, nome
from ridgeback.symbolic.systems.oscillator import Oscillator

AGM_BITS: Final = 4
"""Bits beyond the format at which the arithmetic-geometric mean has converged."""
MOST_STEPS: Final = 20
MOST_TERMS: Final = 500
ANY_ORDER: Final = 8
"""The nome is asked for its means only, which do not depend on an order."""


@dataclass(frozen=True)
class MeanForm:
    """omega0 as an arithmetic-geometric mean."""

    source: NomeForm

    def form(self, request: CodeRequest) -> Form:
        """The function; the number of steps is what the end of the domain needs, decided in balls."""
        domain, steps = _domain(self.source, request), Steps(request.real)
        high, low = means_steps(self.source.means, domain.argument, steps)
        count = mean_steps(self.source.means, domain.high, request.real.digits)
        for n in range(count):
            total = steps.add("total", high, low)
            if n < count - 1:
                low = steps.root(f"mean_{n}", steps.multiply("area", high, low))
            high = steps.multiply(f"sum_{n}", number_of(steps, Fraction(1, 2)), total)
        result = steps.multiply("result", K, high)
        method = f"Method: closed form, the arithmetic-geometric mean in {count} steps."
        return _form(self.source, request, steps, result, domain, (method, "Order: none, the formula is exact."))


@dataclass(frozen=True)
class SineSeries:
    """omega0 of the pendulum by the first terms of its period's series in sin(A/2)."""

    source: NomeForm
    terms: int

    def form(self, request: CodeRequest) -> Form:
        """The function, with the bound of what the terms left out add."""
        domain, steps, means = _domain(self.source, request), Steps(request.real), self.source.means
        assert isinstance(means, PendulumMeans)  # noqa: S101 - ``sine_series`` sees to it
        half = steps.multiply("half_angle", number_of(steps, means.c / 2), domain.argument)
        z = sine_of_small(steps, "z", half)
        coefficients: dict[int, Operand] = {2 * n: steps.number(squared_binomial(n)) for n in range(self.terms)}
        result = steps.divide("result", K, steps.horner("total", str(z), coefficients))
        facts = (
            f"Method: series of the period in sin({means.c} A/2), {self.terms} terms, exact rational coefficients.",
            f"Truncation: for |{domain.argument}| <= {domain.high!r} the relative error against the exact frequency is "
            f"at most {upwards(tail(means, self.terms, domain.high))}, proved.",
        )
        return _form(self.source, request, steps, result, domain, facts)


def mean_form(oscillator: Oscillator) -> MeanForm:
    """The closed form of a pendulum or a Duffing oscillator; raises InputError for others.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> mean_form(find("pendulum")).source.means
    PendulumMeans(c=Fraction(1, 1))
    """
    return MeanForm(nome(oscillator, ANY_ORDER))


def sine_series(oscillator: Oscillator, terms: int) -> SineSeries:
    """The series of a pendulum; raises InputError for others and for a number of terms that is none.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> sine_series(find("pendulum"), 20).terms
    20
    """
    if not 1 <= terms <= MOST_TERMS:
        raise InputError(f"{terms} terms are not within 1..{MOST_TERMS}; use e.g. 20")
    source = nome(oscillator, ANY_ORDER)
    if not isinstance(source.means, PendulumMeans):
        raise InputError(f"{oscillator.name} is no pendulum, so that its period is no series in sin(A/2); use agm")
    return SineSeries(source, terms)


def squared_binomial(n: int) -> fmpq:
    """(binom(2n, n)/4^n)^2, the coefficient of z^(2n) in 2 K(z)/pi (DLMF 19.5.1).

    >>> [squared_binomial(n) for n in range(3)]
    [1, 1/4, 9/64]
    """
    return fmpq(comb(2 * n, n) ** 2, 16**n)


def tail(means: PendulumMeans, terms: int, end: float) -> Fraction:
    """An upper bound of what the terms left out add, relative to the frequency: the coefficients fall.

    With S the sum kept and R the rest, k/S exceeds the exact k/(S + R) by the share R/S <= R, since S >= 1.

    >>> float(tail(PendulumMeans(Fraction(1)), 20, 2.0)) < 1e-4
    True
    """
    with ctx.workprec(128):
        square = (ball(means.c) * ball(end) / 2).sin() ** 2
        return upper(arb(squared_binomial(terms)) * square**terms / (1 - square))


def _domain(source: NomeForm, request: CodeRequest) -> Domain:
    domain = request.domain(variable_name(source.variable))
    if not domain.known:
        raise InputError(f"the closed form of {source.system} needs the end of its range; give --up-to")
    return domain


def _form(
    source: NomeForm, request: CodeRequest, steps: Steps, result: str, domain: Domain, told: tuple[str, ...]
) -> Form:
    arguments = (
        Argument(domain.argument, variable_meaning(source)),
        frequency_argument(source.scale, request.real),
    )
    facts = (
        *((f"Equation: {request.equation}.",) if request.equation else ()),
        *told,
        f"Variable {source.variable}: {variable_meaning(source)}.",
        SCALING,
        *limit_fact(source.variable, request.limit),
        *request.more,
    )
    made = Function("omega0", OMEGA0, arguments, needed(steps.taken, result), result, domain)
    functions = (made, slope_of(made, request.real))
    return Form(source.system, f"Fundamental frequency of {titled(source.system)}", facts, functions)


def mean_steps(means: Means, end: float, digits: int) -> int:
    """How many steps (a, b) -> ((a + b)/2, sqrt(a b)) leave no difference that the format would show.

    After a step the difference is (sqrt a - sqrt b)^2/2, so that it is decided at the end of the range, where it is
    largest, and the last arithmetic mean errs by less than the difference of the pair before it squared over 8 b.

    >>> mean_steps(PendulumMeans(Fraction(1)), 3.0, 53)
    6
    """
    with ctx.workprec(4 * digits):
        a, b = means.in_balls(arb(end))
        for count in range(1, MOST_STEPS):
            if not b > 0:
                break
            if (a - b) ** 2 / (8 * b * b) < arb(2) ** -(digits + AGM_BITS):
                return count
            a, b = (a + b) / 2, (a * b).sqrt()
    raise InputError(f"the oscillation may end before {end:.10g}; give a shorter range")
