"""The two sides of a restoring force, and the time that each takes, as power series; see ``each_side``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Scalar, space_for
from ridgeback.symbolic.series.trigonometric import constant
from ridgeback.symbolic.systems.natural_units import over_leading
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.sides import Half, require_one_law
from ridgeback.symbolic.systems.structure import free_names, positive_root

RATIO = "rho*"
SHARE = "share*"
BETA = "beta"
"""Names of symbols that stand for rho, 1/(1 + rho^d) and I_n / I_d."""


@dataclass(frozen=True)
class Side:
    """One side over the rationals: its force over its leading coefficient, and what its names stand for."""

    half: Half
    force: sympy.Expr
    values: Mapping[str, sympy.Expr]


def restoring_sides(oscillator: Oscillator, *, trough: bool) -> tuple[Half, Half]:
    """The side of the amplitude and the other one."""
    name = oscillator.name
    require_one_law(name, oscillator.substituted_force)
    if oscillator.substituted_force.has(V):
        raise InputError(
            f"{name} has terms in u', so its energy is not conserved in this form; "
            "use --method multiple-scales or lindstedt, or set its damping to 0"
        )
    right, left = oscillator.halves
    if right.exponent != left.exponent:
        raise InputError(
            f"{name}: the force begins like u^({right.exponent}) for u > 0 and like |u|^({left.exponent}) for u < 0, "
            "and only a series in one power of A is known; derive --at A encloses omega0"
        )
    return (left, right) if trough else (right, left)


def _named_side(half: Half, mark: str) -> Side:
    found = over_leading(half.force, half.coefficient)
    renamed = {name: f"{mark}{name}" for name in found.values}
    swap = {sympy.Symbol(a, real=True): sympy.Symbol(b, real=True) for a, b in renamed.items()}
    return Side(half, found.force.xreplace(swap), {renamed[name]: value for name, value in found.values.items()})


def _like(side: Side, other: Side) -> sympy.Expr | None:
    """The force of a side in the names of another one with the same leading coefficient; None where it has others."""
    if side.half.coefficient != other.half.coefficient or [*side.values.values()] != [*other.values.values()]:
        return None
    pairs = zip(side.values, other.values, strict=True)
    return side.force.xreplace({sympy.Symbol(a, real=True): sympy.Symbol(b, real=True) for a, b in pairs})


@dataclass(frozen=True)
class Travel:
    """One side through some order, lists of coefficients.

    ``time`` is the time in powers of y over its first term, ``place`` is x/y in powers of y, ``stretch`` is y/x in
    powers of x, and ``force`` is f over its first term in powers of x.
    """

    time: list[Scalar]
    place: list[Scalar]
    stretch: list[Scalar]
    force: list[Scalar]

    @property
    def stretched(self) -> list[Scalar]:
        """y in powers of x."""
        return [fmpq(0), *self.stretch[:-1]]


class TwoSides:
    """Both sides of one force, the polynomials that their coefficients live in, and the constants among the variables.

    Parameters
    ----------
    oscillator : Oscillator
        Its force depends on u alone.
    trough : bool, optional
        Whether the amplitude is the turning point at u < 0.
    more : mapping of str to sympy.Expr or None, optional
        Further names among the variables, with their values; None for parameters.
    """

    def __init__(
        self, oscillator: Oscillator, *, trough: bool = False, more: Mapping[str, sympy.Expr | None] | None = None
    ) -> None:
        self.near, self.far = restoring_sides(oscillator, trough=trough)
        self.d, self.m = d, m = self.near.root, self.near.power + self.near.root
        first, second = _named_side(self.near, "p"), _named_side(self.far, "q")
        self.same = first.force == _like(second, first)
        self.first, self.second = first, first if self.same else second
        sides = [first] if self.same else [first, second]
        values = {name: value for side in sides for name, value in side.values.items()}
        self.exact_ratio = sympy.S.One if self.same else _ratio(first.half, second.half, m)
        if not self.exact_ratio.is_Rational:
            share = 1 / (1 + self.exact_ratio**d)
            values |= {RATIO: self.exact_ratio, SHARE: sympy.radsimp(share) if share.is_number else share}
        self.betas = {f"{BETA}{n}*": _beta(n, d, m) for n in range(d + 1, d + m)}
        given = {name: value for name, value in (more or {}).items() if value is not None}
        self.known = {**values, **{n: value for n, value in self.betas.items() if not value.is_Rational}, **given}
        own = {name for side in sides for name in free_names(side.force)} | set(more or {})
        self.names = tuple(sorted(own | set(self.known)))
        self.space = space_for(self.names)
        self.ring = TrigRing(self.space)

    def travels(self, order: int) -> tuple[Travel, Travel]:
        """The side of the amplitude and the other one, through an order of x."""
        here = self._travel(self.first, order)
        return here, here if self.same else self._travel(self.second, order)

    def frequency(self, here: Travel, there: Travel) -> list[Scalar]:
        """omega0 over its leading term, in powers of x."""
        share, power, total = self.share, fmpq(1), []
        for one, other in zip(here.time, there.time, strict=True):
            total.append(share * one + (1 - share) * power * other)
            power = power * self.ratio
        travel = truncated.compose(total, here.stretched)
        rising = truncated.power(here.stretch, fmpq(self.m - 2 * self.d, 2))
        return truncated.multiply(rising, truncated.reciprocal(travel))

    def lead(self) -> sympy.Expr:
        """pi / (sqrt(m/(2 a d)) I_d d (1 + rho^d)), with I_d = B(d/m, 1/2)/m: the leading coefficient of omega0."""
        d, m = self.d, self.m
        part = sympy.Rational(d, m)
        beta = sympy.gamma(part) * sympy.sqrt(sympy.pi) / sympy.gamma(part + sympy.Rational(1, 2)) / m
        root = sympy.sqrt(sympy.Rational(2 * d, m)) * positive_root(self.near.coefficient)
        return sympy.pi * root / (beta * d * (1 + self.exact_ratio**d))

    @property
    def ratio(self) -> Scalar:
        """rho."""
        return self._scalar(RATIO, self.exact_ratio)

    @property
    def share(self) -> Scalar:
        """1 / (1 + rho^d)."""
        return self._scalar(SHARE, 1 / (1 + self.exact_ratio**self.d))

    def _scalar(self, name: str, value: sympy.Expr) -> Scalar:
        return fmpq(int(value.p), int(value.q)) if value.is_Rational else self.parameter(name)

    def parameter(self, name: str) -> Scalar:
        """A named constant as a member."""
        return self.ring.parameter(name).coefficients(0)[0]

    def _travel(self, side: Side, order: int) -> Travel:
        d, m, length = self.d, self.m, order + 1
        start = side.half.power
        force = [fmpq(1), *self.series(side.force, start + length)[start + 1 :]]
        rising = [f * fmpq(m, m + j) for j, f in enumerate(force)]
        stretch = truncated.power(rising, fmpq(1, m))
        x_of_y = truncated.revert([fmpq(0), *stretch])[1:]
        u_of_y = truncated.power(x_of_y, fmpq(d))
        time = [u * fmpq(d + j, d) * self.beta(d + j) for j, u in enumerate(u_of_y)]
        return Travel(time, x_of_y, stretch, force)

    def series(self, expression: sympy.Expr, length: int) -> list[Scalar]:
        """Taylor coefficients of an expression in ``U`` and the names, from that of U^0 on."""
        names = free_names(expression)
        fixed = {sympy.Symbol(name, real=True): [self.ring.parameter(name)] for name in names}
        w = [constant(self.space, fmpq(0)), constant(self.space, fmpq(1))]
        program = Program(expression, self.ring, {}, U, V, fixed={**fixed, U: w})
        found = [program.root.get(n).coefficients(0) for n in range(length)]
        return [value[0] if value else fmpq(0) for value in found]

    def beta(self, n: int) -> Scalar:
        """I_n / I_d."""
        if n == self.d:
            return fmpq(1)
        if n >= self.d + self.m:
            return self.beta(n - self.m) * fmpq(2 * (n - self.m), 2 * n - self.m)
        return self._scalar(f"{BETA}{n}*", self.betas[f"{BETA}{n}*"])


def _ratio(near: Half, far: Half, m: int) -> sympy.Expr:
    """rho = (a/a')^(1/m)."""
    quotient = sympy.cancel(near.coefficient / far.coefficient)
    return sympy.powdenest(sympy.root(quotient, m), force=True)


def _beta(n: int, d: int, m: int) -> sympy.Expr:
    """I_n / I_d as an exact number."""
    half = sympy.Rational(1, 2)
    one, other = sympy.Rational(n, m), sympy.Rational(d, m)
    ratio = sympy.gamma(one) * sympy.gamma(other + half) / (sympy.gamma(one + half) * sympy.gamma(other))
    return sympy.expand_func(ratio)
