"""The exact frequency fitted by a polynomial with coefficients of the format, and its error proved.

In A^2 where the potential is even, in A where it is not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from flint import arb, ctx, fmpq
from sympy import Expr

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.fit.over_range import balls, largest_error
from ridgeback.symbolic.codegen.fit.remez import Best, remez
from ridgeback.symbolic.codegen.fit.surrogate import Surrogate, surrogate
from ridgeback.symbolic.codegen.formulas.wording import OMEGA0, SCALING, frequency_argument, limit_fact, titled
from ridgeback.symbolic.codegen.number import FLOAT64, Number, Real, fraction, rounded
from ridgeback.symbolic.codegen.polynomial import K, derivative, polynomial_function
from ridgeback.symbolic.codegen.program import Argument, Form, Terms
from ridgeback.symbolic.codegen.proofs.notes import upwards
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.expansion.amplitude import MEANINGS
from ridgeback.symbolic.systems.oscillator import Oscillator

MOST_DEGREE: Final = 40
HARDLY: Final = Fraction(101, 100)
"""Coefficients are rounded with care where plain rounding makes the error larger than this share."""


@dataclass(frozen=True)
class Fit:
    """omega0 = k (1 + c_1 X + ... + c_d X^d), X = A^step, up to A = end; relative error at most ``error``, proved."""

    system: str
    scale: Expr
    end: Fraction
    coefficients: tuple[Fraction, ...]
    """c_0 = 1, c_1, ..., c_d, each a number of the format."""
    error: Fraction
    optimum: float
    """The relative error of the best fit with real coefficients."""
    real: Real = FLOAT64
    step: int = 2

    @property
    def variable(self) -> str:
        """X."""
        return "A^2" if self.step == 2 else "A"

    @property
    def range(self) -> str:
        """Where the fit holds."""
        return f"{'|A|' if self.step == 2 else '0 <= A'} <= {float(self.end)!r}"

    @property
    def degree(self) -> int:
        """d, in X."""
        return len(self.coefficients) - 1

    def to_dict(self) -> dict[str, object]:
        """The public JSON form."""
        return {
            "system": self.system,
            "method": "minimax",
            "amplitude": "peak",
            "up_to": str(self.end),
            "variable": self.variable,
            "degree": self.degree,
            "coefficients": [str(c) for c in self.coefficients],
            "error_bound": float(self.error),
        }

    def form(self, request: CodeRequest) -> Form:
        """omega0 and its derivative as code."""
        terms: Terms = {
            (self.step * n,): Number(fmpq(c.numerator, c.denominator), request.real)
            for n, c in enumerate(self.coefficients)
        }
        domain = request.domain("A", even=self.step == 2)
        meaning = f"peak amplitude, {MEANINGS['peak']}"
        arguments = (Argument("A", meaning), frequency_argument(self.scale, request.real))
        functions = (
            polynomial_function("omega0", OMEGA0, arguments, ("A",), terms, domain, factor=K, real=request.real),
            polynomial_function(
                "omega0_slope",
                "Derivative of omega0 by A.",
                arguments,
                ("A",),
                derivative(terms),
                domain,
                factor=K,
                real=request.real,
            ),
        )
        facts = (
            *((f"Equation: {request.equation}.",) if request.equation else ()),
            f"Method: minimax fit of degree {self.degree} in {self.variable} to the exact frequency, k at A = 0.",
            f"Variable A: {meaning}.",
            f"Fit: for {self.range} the relative error against the exact frequency is at most "
            f"{upwards(self.error, 3)}, proved over the whole range in ball arithmetic.",
            SCALING,
            *limit_fact("A", request.limit),
            *request.more,
        )
        return Form(self.system, f"Fundamental frequency of {titled(self.system)}, fitted", facts, functions)


def minimax(
    oscillator: Oscillator,
    up_to: Fraction,
    *,
    degree: int | None = None,
    tolerance: Fraction | None = None,
    real: Real = FLOAT64,
    exact: Surrogate | None = None,
) -> Fit:
    """Fit omega0(A) of a conservative oscillator up to an amplitude, in A^2 where its potential is even, else in A.

    Parameters
    ----------
    oscillator
        Its parameters have values.
    up_to
        The largest amplitude.
    degree
        Degree of the polynomial.
    tolerance
        In place of a degree: the lowest degree is taken whose proved relative error is at most this.
    real
        Format of the coefficients.
    exact
        What encloses the frequency over the range, where that is known already: the same for every degree.

    Raises
    ------
    InputError
        For both or none of degree and tolerance, a force that u' changes, a range that cannot be enclosed, and a
        tolerance that no degree up to 40 meets.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = minimax(find("duffing"), Fraction(1), degree=4)
    >>> found.coefficients[0], float(found.error) < 1e-4
    (Fraction(1, 1), True)
    """
    if (degree is None) == (tolerance is None):
        raise InputError("a fit needs a degree or a tolerance, one of them")
    if degree is not None and not 1 <= degree <= MOST_DEGREE:
        raise InputError(f"degree {degree} is not within 1..{MOST_DEGREE}; use e.g. 6")
    if up_to <= 0:
        raise InputError(f"the range up to {float(up_to):.6g} is empty; it must end above 0")
    well = well_of(oscillator)
    exact = exact or surrogate(well, up_to)
    reached = "none of them alternates"
    with ctx.workprec(exact.bits):
        for d in (degree,) if degree is not None else range(1, MOST_DEGREE + 1):
            try:
                best = _best(exact, d)
            except InputError:
                if tolerance is None:
                    raise
                break  # the fit is as near as the exact frequency is known, and no number of the format is
            if tolerance is not None and best.size > ball(tolerance):
                continue
            values, error = _represented(exact, best, d, real)
            if tolerance is None or error <= tolerance:
                return Fit(oscillator.name, well.scale, up_to, values, error, float(best.size), real, exact.step)
            reached = f"degree {d} comes to {float(error):.3g}"
    raise InputError(
        f"no degree up to {MOST_DEGREE} is within {float(tolerance or 0):.3g} with {real.name} coefficients: {reached}"
    )


def _target(exact: Surrogate) -> Callable[[arb], arb]:
    """omega0/k - 1 as a function of X."""
    half = exact.half
    return lambda x: exact.polynomial(x / half - 1) - 1


def _best(exact: Surrogate, degree: int) -> Best:
    """The best fit; of a frequency that does not depend on the amplitude, 0."""
    if all(abs(c) <= exact.remainder for c in (exact.polynomial - 1).coeffs()):
        return Best((arb(0),) * degree, arb(0), ())
    target = _target(exact)
    return remez(target, 2 * exact.half, range(1, degree + 1), lambda x: 1 + target(x))


def _represented(exact: Surrogate, best: Best, degree: int, real: Real) -> tuple[tuple[Fraction, ...], Fraction]:
    """Coefficients of the format: each rounded by itself, or one after the other where that loses too much."""
    plain = (Fraction(1), *(nearest(c, real) for c in best.coefficients))
    error, *_ = largest_error(exact, balls(plain))
    if error <= HARDLY * fraction(best.size.fmpq()):
        return plain, error
    careful = _one_by_one(exact, best, degree, real)
    other, *_ = largest_error(exact, balls(careful))
    return (careful, other) if other < error else (plain, error)


def nearest(value: arb, real: Real) -> Fraction:
    """The number of the format next to the centre of a ball.

    >>> nearest(arb(0.5), FLOAT64)
    Fraction(1, 2)
    """
    return Fraction(rounded(fraction(value.mid().fmpq()), real))


def _one_by_one(exact: Surrogate, best: Best, degree: int, real: Real) -> tuple[Fraction, ...]:
    """Round the coefficient of the lowest power, whose rounding weighs most, fit the others again, and go on.

    What a rounding did is so made good by the coefficients that are still free, as far as they can.
    """
    target, end = _target(exact), 2 * exact.half
    fixed: list[Fraction] = []
    free: Sequence[arb] = best.coefficients
    for n in range(1, degree + 1):
        fixed.append(nearest(free[0], real))
        if n == degree:
            break

        def rest(x: arb, fixed: tuple[Fraction, ...] = tuple(fixed)) -> arb:
            return target(x) - sum((ball(c) * x ** (i + 1) for i, c in enumerate(fixed)), arb(0))

        try:
            free = remez(rest, end, range(n + 1, degree + 1), lambda x: 1 + target(x)).coefficients
        except InputError:
            free = free[1:]
    return (Fraction(1), *fixed)
