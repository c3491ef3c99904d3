"""Code for resummations and closed forms: quotients of polynomials, the elliptic nome, the agm."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rational_function import Coefficients
from ridgeback.symbolic.codegen.formulas.derivative import differentiated
from ridgeback.symbolic.codegen.formulas.wording import (
    OMEGA0,
    SCALING,
    common_facts,
    frequency_argument,
    limit_fact,
    titled,
    variable_meaning,
)
from ridgeback.symbolic.codegen.motions.trigonometry import cosine_to_quarter
from ridgeback.symbolic.codegen.naming import variable_name
from ridgeback.symbolic.codegen.number import Number, Real
from ridgeback.symbolic.codegen.polynomial import K, measured
from ridgeback.symbolic.codegen.program import Argument, Form, Function, Operand, Steps, needed
from ridgeback.symbolic.codegen.proofs.notes import rounded_down_text
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.resummation.elliptic_nome import DuffingMeans, Means, NomeForm, PendulumMeans, theta_3
from ridgeback.symbolic.resummation.mapping import CutPlane, Euler, Identity, Mapping, Pair
from ridgeback.symbolic.resummation.pade import RationalForm
from ridgeback.symbolic.resummation.resummation import Resummation


def resummation_form(formula: Resummation, request: CodeRequest) -> Form:
    """Build omega0 of a resummation.

    Raises InputError for a formula with other operations than + - * / sqrt cos.
    """
    pole = formula.pole if isinstance(formula, RationalForm) else None
    facts = (
        *common_facts(formula.method, request.equation),
        f"Variable {formula.variable}: {variable_meaning(formula)}.",
        f"Order: agrees with the exact series through the power {formula.order} of {formula.variable}.",
        SCALING,
        *limit_fact(formula.variable, request.limit),
        *(() if pole is None else (f"Not to be used from {formula.variable} = {rounded_down_text(pole)} on: a pole.",)),
        *request.more,
    )
    title = f"Fundamental frequency of {titled(formula.system)}, resummed"
    omega = _function(formula, request)
    return Form(formula.system, title, facts, (omega, slope_of(omega, request.real)))


def slope_of(omega: Function, real: Real) -> Function:
    """The derivative of omega0 by its variable, operation by operation."""
    return differentiated(omega, "omega0_slope", f"Derivative of omega0 by {omega.domain.argument}.", real)


def _function(formula: Resummation, request: CodeRequest) -> Function:
    variable, steps = variable_name(formula.variable), Steps(request.real)
    arguments = (
        Argument(variable, variable_meaning(formula)),
        frequency_argument(formula.scale, request.real),
    )
    base = measured(steps, variable, 1 if formula.scaled_variable else 0)
    value = _nome(formula, base, steps) if isinstance(formula, NomeForm) else _quotient(formula, base, steps)
    result = steps.multiply("result", K, value)
    even = not isinstance(formula, RationalForm) or formula.step % 2 == 0
    return Function(
        "omega0", OMEGA0, arguments, needed(steps.taken, result), result, request.domain(variable, even=even)
    )


def number_of(steps: Steps, value: Fraction | int) -> Number:
    """An exact fraction in the format of the code."""
    exact = Fraction(value)
    return steps.number(fmpq(exact.numerator, exact.denominator))


def _series(steps: Steps, name: str, at: str, coefficients: Coefficients) -> Operand:
    return steps.horner(name, at, {n: steps.number(fmpq(c)) for n, c in enumerate(coefficients) if c != 0})


# --- quotients of polynomials ---


def _quotient(formula: Resummation, base: str, steps: Steps) -> Operand:
    if not isinstance(formula, RationalForm):
        raise InputError(f"no code is written for the {formula.method} of {formula.system}; use pade, map or nome")
    w = _mapped(formula.mapping, steps.power(base, formula.step), steps)
    value = _series(steps, "y", w, formula.numerator)
    if len(formula.denominator) > 1:
        value = steps.divide("quotient", value, _series(steps, "z", w, formula.denominator))
    return value if formula.growth == 0 else _grown(formula, w, value, steps)


def _mapped(mapping: Mapping, x: str, steps: Steps) -> str:
    """w(x), as ``Mapping.image`` has it."""
    one = steps.number(1)
    match mapping:
        case Identity():
            return x
        case Euler(x0=x0, rate=rate) if rate == 1:
            return steps.divide("w", x, steps.add("moved", x, number_of(steps, x0)))
        case CutPlane(x_c=x_c):
            scaled = steps.divide("scaled", x, number_of(steps, x_c))
            root = steps.root("root", steps.subtract("rest", one, scaled))
            above, below = (one, root) if x_c > 0 else (root, one)
            return steps.divide("w", steps.subtract("fall", above, below), steps.add("rise", one, root))
        case Pair(modulus=modulus, half_sum=half):
            moved = steps.add("moved", x, number_of(steps, -2 * half))
            inner = steps.multiply("inner", x, moved)
            root = steps.root("root", steps.add("distance", inner, number_of(steps, modulus * modulus)))
            return steps.divide("w", x, root)
    raise InputError(f"no code is written for the {mapping.name}; use pade, or a map of rate 1")


def _grown(formula: RationalForm, w: str, value: Operand, steps: Steps) -> Operand:
    """value * vanishing(w)^p for a p that is a multiple of 1/2."""
    exponent = -formula.growth / formula.mapping.rate
    if exponent.denominator > 2:
        raise InputError(f"growth {formula.growth} needs a power {exponent}; code is written for multiples of 1/2")
    # 1 - w or 1 - w^2, the two that maps have.
    own = w if len(formula.mapping.vanishing) == 2 else steps.square(w)
    factor = steps.subtract("vanishing", steps.number(1), own)
    if exponent.denominator == 2:
        factor = steps.root("vanishing", factor)
    for _ in range(abs(exponent.numerator)):
        value = steps.multiply("grown", factor, value) if exponent > 0 else steps.divide("grown", value, factor)
    return value


# --- the elliptic nome ---


def _nome(formula: NomeForm, A: str, steps: Steps) -> Operand:
    """a/theta_3(q)^2 by the steps of ``ridgeback.symbolic.resummation.elliptic_nome``."""
    if formula.steps < 1:
        raise InputError("the nome without a Landen step loses digits by cancellation; take one step or more")
    high, low = means_steps(formula.means, A, steps)
    for n in range(formula.steps):
        total, gap = steps.add(f"total_{n}", high, low), steps.subtract("gap", high, low)
        low = steps.root(f"low_{n}", steps.multiply("area", high, low))
        high = steps.multiply(f"high_{n}", number_of(steps, Fraction(1, 2)), total)
    ratio = steps.divide("ratio", gap, total)
    ratio_squared = steps.multiply("ratio_squared", ratio, ratio)
    ell = steps.multiply("ell", number_of(steps, Fraction(1, 16)), ratio_squared)
    q = _series(steps, "y", ell, formula.nome_series)
    theta = _series(steps, "z", str(q), theta_3(len(formula.nome_series) - 1))
    return steps.divide("quotient", high, steps.multiply("theta_squared", theta, theta))


def means_steps(means: Means, A: str, steps: Steps) -> tuple[Operand, Operand]:
    """high and low, the two numbers whose mean is omega0/k."""
    if isinstance(means, PendulumMeans):
        half_angle = steps.multiply("half_angle", number_of(steps, means.c / 2), A)
        return steps.number(1), cosine_to_quarter(steps, "low", half_angle)
    if isinstance(means, DuffingMeans):
        square, one = steps.square(A), steps.number(1)
        pair = []
        for name, part in (("high", means.e), ("low", means.e / 2)):
            share = steps.multiply(f"{name}_share", number_of(steps, part), square)
            pair.append(steps.root(name, steps.add(f"{name}_inside", one, share)))
        return pair[0], pair[1]
    raise InputError("no code is written for this arithmetic-geometric mean")
