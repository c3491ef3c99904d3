"""Code for quotients of polynomials: Padé approximants, and series in Euler's variable w = x/(x + x0)."""

from __future__ import annotations

from decimal import ROUND_FLOOR, Context
from fractions import Fraction
from typing import Final

from flint import arb, ctx
from sympy import Expr, Mul, Pow, Rational, Symbol

from symbolic.balls import ball, natural_frequency, whole_power
from symbolic.codegen.build import OMEGA0, SCALING, common_facts, frequency_argument, limit_fact, variable_meaning
from symbolic.codegen.form import Argument, Constant, Form, Function, K, Powers, Steps, constants_of, product
from symbolic.codegen.naming import variable_name
from symbolic.codegen.rounding import UNIT, depths, gamma, upwards
from symbolic.enclosure import rounded_down
from symbolic.errors import InputError
from symbolic.mapping import Euler, Identity
from symbolic.pade import RationalForm
from symbolic.rational_function import Coefficients
from symbolic.rendering import as_sympy
from symbolic.resummation import Resummation

BITS: Final = 128
BOXES: Final = 64
FINEST: Final = 30
"""A box is halved so often at most before a zero is suspected in it."""


def quotient_form(
    formula: Resummation, *, up_to: Fraction, equation: str = "", limit: float | None = None, more: tuple[str, ...] = ()
) -> Form:
    """Build omega0 of a resummation that is a quotient of polynomials; rounding is bounded for |variable| <= up_to.

    Raises InputError for formulas with roots or other functions, and for a denominator that may vanish in the range.
    """
    if not isinstance(formula, RationalForm) or not _rational(formula):
        raise InputError(
            f"the {formula.method} of {formula.system} needs roots or other functions; code is written for quotients "
            "of polynomials: pade, or map where that is Euler's, without growth"
        )
    pole = (
        () if formula.pole is None else (f"Not to be used from {formula.variable} = {_down(formula.pole)} on: a pole.",)
    )
    facts = (
        *common_facts(formula.method, equation),
        f"Variable {formula.variable}: {variable_meaning(formula)}.",
        f"Order: agrees with the exact series through the power {formula.order} of {formula.variable}.",
        SCALING,
        *limit_fact(formula.variable, limit),
        *pole,
        *more,
    )
    title = f"Fundamental frequency of '{formula.system}', resummed"
    return Form(formula.system, title, facts, (_function(formula, up_to),))


def _rational(formula: RationalForm) -> bool:
    plain = isinstance(formula.mapping, Identity) or (isinstance(formula.mapping, Euler) and formula.mapping.rate == 1)
    return plain and formula.growth == 0


def _function(formula: RationalForm, up_to: Fraction) -> Function:
    variable = variable_name(formula.variable)
    arguments = (Argument(variable, variable_meaning(formula)), frequency_argument(formula.scale))
    steps, constants = Steps(), list[Constant]()
    w = _inner(formula, variable, steps, constants)
    for name, prefix, coefficients in (("y", "N", formula.numerator), ("z", "D", formula.denominator)):
        terms: dict[Powers, Expr] = {(n,): as_sympy(c) for n, c in enumerate(coefficients) if c != 0}
        constants += constants_of(prefix, terms)
        steps.horner(name, w, {n: Symbol(f"{prefix}{n}") for (n,) in terms})  # both begin with 1
    quotient = steps.assign("quotient", _over(Symbol("y"), Symbol("z")))
    note = _note(formula, depths(constants, steps.taken), up_to)
    return Function("omega0", OMEGA0, arguments, tuple(constants), tuple(steps.taken), product(K, quotient), (note,))


def _inner(formula: RationalForm, variable: str, steps: Steps, constants: list[Constant]) -> Symbol:
    """The variable of the polynomials: x = variable^step, over k^step for limit cycles, or Euler's x/(x + x0)."""
    base = Symbol(steps.measured(variable, 1 if formula.scaled_variable else 0))
    x = base if formula.step == 1 else steps.square(base)
    for n in range(3, formula.step + 1):
        x = steps.once(f"{base.name}_{n}", product(base, x))
    if isinstance(formula.mapping, Identity):
        return x
    constants += constants_of("X", {(0,): Rational(formula.mapping.x0)})  # type: ignore[attr-defined]
    return steps.assign("w", _over(x, x + Symbol("X0")))


def _over(above: Expr, below: Expr) -> Expr:
    return Mul(above, Pow(below, -1))


def _note(formula: RationalForm, count: depths, up_to: Fraction) -> str:
    r"""|computed/exact - 1| <= (1 + gamma_m kappa_N) (1 + u)^2 / (1 - gamma_n kappa_D) - 1 over the whole range."""
    with ctx.workprec(BITS):
        x = ball(up_to) / natural_frequency(formula.scale) if formula.scaled_variable else ball(up_to)
        end = formula.mapping.image(whole_power(x, formula.step)).upper()
        above, below = (condition(c, end) for c in (formula.numerator, formula.denominator))
    numerator = 1 + gamma(count(Symbol("y"))) * above
    denominator = 1 - gamma(count(Symbol("z"))) * below
    if denominator <= 0:
        raise InputError(f"{formula.method} of {formula.system}: rounding swamps the denominator; use a lower order")
    bound = numerator * (1 + UNIT) ** 2 / denominator - 1
    name = formula.variable
    inside = f"|{name}| <= {_down(ball(up_to))}" if formula.step % 2 == 0 else f"0 <= {name} <= {_down(ball(up_to))}"
    inside += " (and k as given by default)" if formula.scaled_variable else ""
    return (
        f"Rounding: for {inside} the relative error is at most {upwards(bound)}, proved in ball arithmetic "
        "(without over- or underflow)."
    )


def condition(coefficients: Coefficients, end: arb) -> Fraction:
    """An upper bound of (sum of |c_n w^n|)/|sum of c_n w^n| for 0 <= w <= end, proved at FLINT's working precision.

    Raises InputError where the polynomial may vanish.

    >>> from flint import fmpq
    >>> 1 <= condition((fmpq(1), fmpq(1)), arb(1)) < 1.02
    True
    >>> 3 <= condition((fmpq(1), fmpq(-1, 2)), arb(1)) < 3.1
    True
    """
    worst = Fraction(0)
    waiting = [(end * i / BOXES, end * (i + 1) / BOXES, 0) for i in range(BOXES)]
    while waiting:
        low, high, depth = waiting.pop()
        value = _horner(coefficients, low.union(high))
        size = _horner(tuple(abs(c) for c in coefficients), arb(high.upper()))
        if not value.contains(0):
            worst = max(worst, _exact((size / value.abs_lower()).upper()))
        elif depth < FINEST:
            middle = ((low + high) / 2).mid()
            waiting += [(low, middle, depth + 1), (middle, high, depth + 1)]
        else:
            raise InputError("the denominator of a formula may vanish in the range; give a shorter one")
    return max(worst, Fraction(1))


def _horner(coefficients: Coefficients, w: arb) -> arb:
    total = arb(0)
    for c in reversed(coefficients):
        total = total * w + c
    return total


def _exact(x: arb) -> Fraction:
    value = x.fmpq()
    return Fraction(int(value.p), int(value.q))


def _down(x: arb) -> str:
    """A positive number in six digits, rounded down."""
    exact = Context(prec=6, rounding=ROUND_FLOOR).create_decimal(rounded_down(x))
    return f"{float(exact):.6g}"
