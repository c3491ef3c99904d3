"""Taylor coefficients of the solution of ``u'' + f(u, u') = 0``, by recurrences on truncated power series.

Automatic differentiation in Taylor arithmetic: every operation has a recurrence that gives its coefficient
``n`` from the coefficients ``0..n`` of its arguments (Moore 1966; Griewank and Walther 2008, chapter 13), so
that the equation is solved coefficient by coefficient, exactly up to rounding at mpmath's precision.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath
import sympy

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.closures import mp_constant

Series = list[Any]
Step = Callable[[int], None]
"""Appends coefficient n to the series it stands for; called with n = 0, 1, 2, ..."""

Jet = Callable[[Any, Any, int], list[Any]]


def solution_jet(force: sympy.Expr, u: sympy.Symbol, v: sympy.Symbol) -> Jet:
    """Return the jet ``(u0, v0, degree) -> [u0, v0, u''/2!, ...]`` of the solution through ``(u0, v0)``.

    >>> u, v = sympy.symbols("u v")
    >>> [int(6 * c) for c in solution_jet(u, u, v)(1, 0, 3)]      # cos t
    [6, 0, -3, 0]
    """
    Program({u: [], v: []}).node(force)  # an unusable force is refused here, not in the middle of an integration

    def jet(u0: Any, v0: Any, degree: int) -> list[Any]:
        position, velocity = [mpmath.mpf(u0)], [mpmath.mpf(v0)]
        program = Program({u: position, v: velocity})
        value = program.node(force)
        for n in range(degree):
            program.advance(n)
            position.append(velocity[n] / (n + 1))
            velocity.append(-value[n] / (n + 1))
        return position[: degree + 1]

    return jet


def compose_jet(expression: sympy.Expr, symbol: sympy.Symbol, series: Sequence[Any]) -> list[Any]:
    """Taylor coefficients of ``expression`` with ``symbol`` replaced by a power series, to the same length.

    >>> u = sympy.Symbol("u")
    >>> [int(c) for c in compose_jet(u**2, u, [1, 1, 0])]
    [1, 2, 1]
    """
    given = [mpmath.mpf(coefficient) for coefficient in series]
    program = Program({symbol: given})
    value = program.node(expression)
    for n in range(len(given)):
        program.advance(n)
    return list(value[: len(given)])


def convolve(left: Series, right: Series, n: int) -> Any:
    """Cauchy product, coefficient n: sum of left[j] right[n-j]."""
    return mpmath.fdot(left[: n + 1], right[n::-1])


class Program:
    """The operations of an expression in the order in which their coefficients become known.

    Equal subexpressions share one series.  A builder that lives for one jet: the one object here that grows.
    """

    def __init__(self, known: dict[sympy.Expr, Series]) -> None:
        self._known = dict(known)
        self._slopes: dict[int, Series] = {}
        self._steps: list[Step] = []

    def advance(self, n: int) -> None:
        """Compute coefficient n of every series."""
        for step in self._steps:
            step(n)

    def node(self, expression: sympy.Expr) -> Series:
        """Return the series of ``expression``, its steps added if it is new."""
        if expression not in self._known:
            self._known[expression] = self._build(expression)
        series: Series = self._known[expression]
        return series

    def _emit(self, coefficient: Callable[[int], Any]) -> Series:
        out: Series = []
        self._steps.append(lambda n: out.append(coefficient(n)))
        return out

    def _build(self, expression: sympy.Expr) -> Series:
        if expression.is_number and not expression.free_symbols:
            value = mp_constant(expression)
            return self._emit(lambda n: value if n == 0 else mpmath.mpf(0))
        if isinstance(expression, sympy.Add):
            parts = [self.node(part) for part in expression.args]
            return self._emit(lambda n: mpmath.fsum(part[n] for part in parts))
        if isinstance(expression, sympy.Mul):
            return self._product(expression)
        if isinstance(expression, sympy.Pow):
            return self._power(expression)
        return self._function(expression)

    def _product(self, expression: sympy.Expr) -> Series:
        number, rest = expression.as_coeff_Mul()
        if number != 1:
            factor, inner = mp_constant(number), self.node(rest)
            return self._emit(lambda n: factor * inner[n])
        first, second = expression.args[0], expression.func(*expression.args[1:])
        left, right = self.node(first), self.node(second)
        return self._emit(lambda n: convolve(left, right, n))

    def _power(self, expression: sympy.Expr) -> Series:
        base, exponent = expression.args
        if not exponent.is_Rational:
            return self.node(sympy.exp(exponent * sympy.log(base), evaluate=False))
        if exponent.is_Integer and exponent > 0:
            half, rest = self.node(base ** (exponent // 2)), self.node(base ** (exponent - exponent // 2))
            return self._emit(lambda n: convolve(half, rest, n))
        return self._general_power(self.node(base), mp_constant(exponent), expression)

    # p = a^r:  a p' = r a' p,  so  n a_0 p_n = sum_{j=1}^{n} (r j - (n - j)) a_j p_{n-j}
    def _general_power(self, base: Series, exponent: Any, expression: sympy.Expr) -> Series:
        out: Series = []

        def coefficient(n: int) -> Any:
            if base[0] == 0 or (exponent != int(exponent) and base[0] < 0):
                raise InputError(f"{expression} is not analytic where its base is {mpmath.nstr(base[0], 6)}")
            if n == 0:
                return mpmath.power(base[0], exponent)
            weights = [(exponent * j - (n - j)) * base[j] for j in range(1, n + 1)]
            return mpmath.fdot(weights, out[n - 1 :: -1]) / (n * base[0])

        self._steps.append(lambda n: out.append(coefficient(n)))
        return out

    def _slope(self, series: Series) -> Series:
        """Return j a_j, the coefficients of t a'(t), shared by all functions of the same argument."""
        if id(series) not in self._slopes:
            self._slopes[id(series)] = self._emit(lambda n: n * series[n])
        return self._slopes[id(series)]

    def _function(self, expression: sympy.Expr) -> Series:
        name = type(expression).__name__
        if len(expression.args) != 1 or name not in _RULES:
            raise InputError(
                f"{expression} has no Taylor recurrence here; known functions: {', '.join(sorted(_RULES))}"
            )
        return _RULES[name](self, expression)

    # y' = q(a) a' with q a function of a alone:  n y_n = sum_{j=1}^{n} j a_j q_{n-j}
    def integral(self, expression: sympy.Expr, derivative: sympy.Expr) -> Series:
        """Return the series of a function from that of its derivative, which is built from the argument."""
        argument = expression.args[0]
        inner, factor = self.node(argument), self.node(derivative)
        slope, start = self._slope(inner), getattr(mpmath, type(expression).__name__)

        def coefficient(n: int) -> Any:
            return start(inner[0]) if n == 0 else mpmath.fdot(slope[1 : n + 1], factor[n - 1 :: -1]) / n

        return self._emit(coefficient)

    # e = exp a:  e' = e a'
    def exponential(self, expression: sympy.Expr) -> Series:
        """Return the exponential, which is the factor of its own derivative."""
        inner = self.node(expression.args[0])
        slope = self._slope(inner)
        out: Series = []

        def step(n: int) -> None:
            out.append(mpmath.exp(inner[0]) if n == 0 else mpmath.fdot(slope[1 : n + 1], out[n - 1 :: -1]) / n)

        self._steps.append(step)
        return out

    # the pairs sin, cos and sinh, cosh:  first' = second a',  second' = sign first a'
    def pair(self, argument: sympy.Expr, first: str, second: str, sign: int) -> tuple[Series, Series]:
        """Both members of a pair with first' = second, second' = sign * first."""
        inner = self.node(argument)
        slope = self._slope(inner)
        one: Series = []
        two: Series = []

        def step(n: int) -> None:
            if n == 0:
                one.append(getattr(mpmath, first)(inner[0]))
                two.append(getattr(mpmath, second)(inner[0]))
                return
            rise = slope[1 : n + 1]
            following = mpmath.fdot(rise, two[n - 1 :: -1]) / n
            two.append(sign * mpmath.fdot(rise, one[n - 1 :: -1]) / n)
            one.append(following)

        self._steps.append(step)
        return one, two

    def member(self, expression: sympy.Expr, first: type, second: type, sign: int) -> Series:
        """One member of a pair; the other is remembered for later use."""
        argument = expression.args[0]
        if first(argument) not in self._known:
            one, two = self.pair(argument, first.__name__, second.__name__, sign)
            self._known[first(argument)], self._known[second(argument)] = one, two
        return self.node(expression)

    # t = tan a: t' = (1 + t^2) a';  t = tanh a: t' = (1 - t^2) a'
    def tangent(self, expression: sympy.Expr, sign: int) -> Series:
        """Tangent (sign +1) or hyperbolic tangent (sign -1) with its own square alongside."""
        inner = self.node(expression.args[0])
        slope, start = self._slope(inner), getattr(mpmath, type(expression).__name__)
        out: Series = []
        growth: Series = []

        def step(n: int) -> None:
            out.append(start(inner[0]) if n == 0 else mpmath.fdot(slope[1 : n + 1], growth[n - 1 :: -1]) / n)
            growth.append((1 if n == 0 else 0) + sign * convolve(out, out, n))

        self._steps.append(step)
        return out


_RULES: dict[str, Callable[[Program, sympy.Expr], Series]] = {
    "exp": lambda p, e: p.exponential(e),
    "sin": lambda p, e: p.member(e, sympy.sin, sympy.cos, -1),
    "cos": lambda p, e: p.member(e, sympy.sin, sympy.cos, -1),
    "sinh": lambda p, e: p.member(e, sympy.sinh, sympy.cosh, 1),
    "cosh": lambda p, e: p.member(e, sympy.sinh, sympy.cosh, 1),
    "tan": lambda p, e: p.tangent(e, 1),
    "tanh": lambda p, e: p.tangent(e, -1),
    "log": lambda p, e: p.integral(e, 1 / e.args[0]),
    "asin": lambda p, e: p.integral(e, (1 - e.args[0] ** 2) ** sympy.Rational(-1, 2)),
    "acos": lambda p, e: p.integral(e, -((1 - e.args[0] ** 2) ** sympy.Rational(-1, 2))),
    "atan": lambda p, e: p.integral(e, 1 / (1 + e.args[0] ** 2)),
    "asinh": lambda p, e: p.integral(e, (1 + e.args[0] ** 2) ** sympy.Rational(-1, 2)),
    "atanh": lambda p, e: p.integral(e, 1 / (1 - e.args[0] ** 2)),
}
