"""Code for resummations: quotients of polynomials in a mapped variable, and the elliptic nome."""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_FLOOR, Context
from fractions import Fraction
from typing import Final

from flint import arb, ctx
from sympy import Expr, Integer, Mul, Pow, Rational, Symbol, cos, sqrt

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.arithmetic.rational_function import Coefficients
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.codegen.build import (
    OMEGA0,
    SCALING,
    common_facts,
    frequency_argument,
    limit_fact,
    variable_meaning,
)
from ridgeback.symbolic.codegen.form import Argument, Constant, Form, Function, K, Powers, Steps, constants_of, product
from ridgeback.symbolic.codegen.forward import relative_bound
from ridgeback.symbolic.codegen.naming import variable_name
from ridgeback.symbolic.codegen.rounding import upwards
from ridgeback.symbolic.enclosure.enclosure import rounded_down
from ridgeback.symbolic.resummation.elliptic_nome import DuffingMeans, NomeForm, PendulumMeans, theta_3
from ridgeback.symbolic.resummation.mapping import CutPlane, Euler, Identity, Mapping, Pair
from ridgeback.symbolic.resummation.pade import RationalForm
from ridgeback.symbolic.resummation.resummation import Resummation

BITS: Final = 128


class Writer:
    """Steps and constants as they are collected."""

    def __init__(self) -> None:
        self.steps, self.constants = Steps(), list[Constant]()

    def constant(self, prefix: str, value: Fraction | int) -> Symbol:
        """A constant of its own."""
        self.constants += constants_of(prefix, {(0,): Rational(value)})
        return Symbol(f"{prefix}0")

    def polynomial(self, name: str, prefix: str, variable: Symbol, coefficients: Coefficients) -> Expr:
        """Horner's steps of a polynomial."""
        terms: dict[Powers, Expr] = {(n,): as_sympy(c) for n, c in enumerate(coefficients) if c != 0}
        self.constants += constants_of(prefix, terms)
        return self.steps.horner(name, variable, {n: Symbol(f"{prefix}{n}") for (n,) in terms})


def resummation_form(
    formula: Resummation, *, up_to: Fraction, equation: str = "", limit: float | None = None, more: tuple[str, ...] = ()
) -> Form:
    """Build omega0 of a resummation; its rounding is bounded for 0 <= variable <= up_to.

    Raises InputError for a formula with other operations than + - * / sqrt cos, and where one may fail in the range.
    """
    pole = formula.pole if isinstance(formula, RationalForm) else None
    facts = (
        *common_facts(formula.method, equation),
        f"Variable {formula.variable}: {variable_meaning(formula)}.",
        f"Order: agrees with the exact series through the power {formula.order} of {formula.variable}.",
        SCALING,
        *limit_fact(formula.variable, limit),
        *(() if pole is None else (f"Not to be used from {formula.variable} = {_down(pole)} on: a pole.",)),
        *more,
    )
    title = f"Fundamental frequency of '{formula.system}', resummed"
    return Form(formula.system, title, facts, (_function(formula, up_to),))


def _function(formula: Resummation, up_to: Fraction) -> Function:
    variable, writer = variable_name(formula.variable), Writer()
    arguments = (Argument(variable, variable_meaning(formula)), frequency_argument(formula.scale))
    base = Symbol(writer.steps.measured(variable, 1 if formula.scaled_variable else 0))
    value = _nome(formula, base, writer) if isinstance(formula, NomeForm) else _quotient(formula, base, writer)
    result = product(K, value)
    with ctx.workprec(BITS):
        given = {"k": arguments[1].default or 1.0}
        bound = relative_bound(writer.constants, writer.steps.taken, result, variable, up_to, given)
    note = _note(formula, up_to, bound)
    return Function("omega0", OMEGA0, arguments, tuple(writer.constants), tuple(writer.steps.taken), result, (note,))


def _note(formula: Resummation, up_to: Fraction, bound: Fraction) -> str:
    name, even = formula.variable, not isinstance(formula, RationalForm) or formula.step % 2 == 0
    end = _down(ball(up_to))
    inside = f"|{name}| <= {end}" if even else f"0 <= {name} <= {end}"
    inside += " (and k as given by default)" if formula.scaled_variable else ""
    pendulum = isinstance(formula, NomeForm) and isinstance(formula.means, PendulumMeans)
    cosine = ", with a cosine right to one unit in the last place" if pendulum else ""
    return (
        f"Rounding: for {inside} the relative error is at most {upwards(bound)}, proved in ball arithmetic "
        f"(without over- or underflow{cosine})."
    )


# --- quotients of polynomials ---


def _quotient(formula: Resummation, base: Symbol, writer: Writer) -> Expr:
    if not isinstance(formula, RationalForm):
        raise InputError(f"no code is written for the {formula.method} of {formula.system}; use pade, map or nome")
    steps = writer.steps
    x = base if formula.step == 1 else steps.square(base)
    for n in range(3, formula.step + 1):
        x = steps.once(f"{base.name}_{n}", product(base, x))
    w = _mapped(formula.mapping, x, writer)
    value = writer.polynomial("y", "N", w, formula.numerator)
    if len(formula.denominator) > 1:
        below = writer.polynomial("z", "D", w, formula.denominator)
        value = steps.assign("quotient", _over(value, below))
    return value if formula.growth == 0 else _grown(formula, w, value, writer)


def _mapped(mapping: Mapping, x: Symbol, writer: Writer) -> Symbol:
    """w(x), as ``Mapping.image`` has it."""
    steps, one = writer.steps, Integer(1)
    match mapping:
        case Identity():
            return x
        case Euler(x0=x0, rate=rate) if rate == 1:
            return steps.assign("w", _over(x, x + writer.constant("X", x0)))
        case CutPlane(x_c=x_c):
            scaled = steps.assign("scaled", _over(x, writer.constant("X", x_c)))
            rest = steps.assign("rest", one - scaled)
            root = steps.assign("root", sqrt(rest))
            above, below = (one - root, one + root) if x_c > 0 else (root - one, one + root)
            return steps.assign("w", _over(steps.assign("fall", above), steps.assign("rise", below)))
        case Pair(modulus=modulus, half_sum=half):
            twice, square = writer.constant("H", -2 * half), writer.constant("R", modulus * modulus)
            inner = steps.assign("inner", product(x, steps.assign("moved", x + twice)))
            root = steps.assign("root", sqrt(steps.assign("distance", inner + square)))
            return steps.assign("w", _over(x, root))
    raise InputError(f"no code is written for the {mapping.name}; use pade, or a map of rate 1")


def _grown(formula: RationalForm, w: Symbol, value: Expr, writer: Writer) -> Expr:
    """value * vanishing(w)^p for a p that is a multiple of 1/2."""
    exponent = -formula.growth / formula.mapping.rate
    if exponent.denominator > 2:
        raise InputError(f"growth {formula.growth} needs a power {exponent}; code is written for multiples of 1/2")
    steps = writer.steps
    # 1 - w or 1 - w^2, the two that maps have.
    own = w if len(formula.mapping.vanishing) == 2 else steps.square(w)
    factor: Expr = steps.assign("vanishing", Integer(1) - own)
    if exponent.denominator == 2:
        factor = steps.assign("vanishing", sqrt(factor))
    for _ in range(abs(exponent.numerator)):
        value = steps.assign("grown", product(factor, value) if exponent > 0 else _over(value, factor))
    return value


def _over(above: Expr, below: Expr) -> Expr:
    return Mul(above, Pow(below, -1))


# --- the elliptic nome ---


def _nome(formula: NomeForm, A: Symbol, writer: Writer) -> Expr:
    """k a/theta_3(q)^2 by the steps of ``ridgeback.symbolic.resummation.elliptic_nome``."""
    if formula.steps < 1:
        raise InputError("the nome without a Landen step loses digits by cancellation; take one step or more")
    steps = writer.steps
    _means(formula, A, writer)
    high, low, half = Symbol("high"), Symbol("low"), writer.constant("E", Fraction(1, 2))
    for _ in range(formula.steps):
        total, gap = steps.assign("total", high + low), steps.assign("gap", high - low)
        steps.assign("low", sqrt(steps.assign("area", product(high, low))))
        steps.assign("high", product(half, total))
    ratio = steps.assign("ratio", _over(gap, total))
    sixteenth = writer.constant("F", Fraction(1, 16))
    ell = steps.assign("ell", product(sixteenth, steps.assign("m", product(ratio, ratio))))
    q = steps.assign("q", writer.polynomial("y", "Q", ell, formula.nome_series))
    theta = writer.polynomial("z", "T", q, theta_3(len(formula.nome_series) - 1))
    return steps.assign("quotient", _over(high, steps.assign("squared", product(theta, theta))))


def _means(formula: NomeForm, A: Symbol, writer: Writer) -> None:
    """high and low, the two numbers whose mean is omega0/k."""
    assign: Callable[[str, Expr], Symbol] = writer.steps.assign
    if isinstance(formula.means, PendulumMeans):
        assign("half_angle", product(writer.constant("C", formula.means.c / 2), A))
        assign("low", cos(Symbol("half_angle")))
        assign("high", Integer(1))
    elif isinstance(formula.means, DuffingMeans):
        square = writer.steps.square(A)
        for name, part in (("high", formula.means.e), ("low", formula.means.e / 2)):
            share = assign("share", product(writer.constant("G" if name == "high" else "L", part), square))
            assign(name, sqrt(assign("inside", Integer(1) + share)))


def _down(x: arb) -> str:
    """A positive number in six digits, rounded down."""
    exact = Context(prec=6, rounding=ROUND_FLOOR).create_decimal(rounded_down(x))
    return f"{float(exact):.6g}"
