r"""The decay by losses c(u) |u'|^r sign(u'), such as quadratic damping and dry friction, averaged along the orbit.

Along an undamped orbit of peak A the energy E = u'^2/2 + V(u) loses on the average

    dE/dt = -(omega0 / 2 pi) loop integral of h du,     A'/A = (dE/dt) / (A f(A)),

with h(u, u') the loss and f = V' (N. N. Bogoliubov and Y. A. Mitropolsky, Asymptotic Methods in the Theory of
Non-linear Oscillations, 1961, section 3).  On the side u > 0, where 2V = k^2 y^2, u = y + ..., u'^2 = k^2 (Y^2 - y^2):

    integral of c |u'|^r du = k^r sum_n e_n Y^(n + r) B_n,     c(u) du/dy = sum_n e_n y^(n-1),
    B_n = integral of x^(n-1) (1 - x^2)^(r/2) dx over 0 < x < 1 = B(n/2, r/2 + 1)/2,     B_(n+2) = B_n n/(n + r + 2),

both ways, and on the other side with Y' = rho Y; the loop takes twice their sum.  For k = 1 the leading terms are
-(4/(3 pi)) c a of c |u'| u' and -2F/(pi a) of F sign(u') (A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, 1979,
section 3.2).  What the losses change of phi' is of second order in them; see ``second_order``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.expansion.amplitude import check_definition, check_name
from ridgeback.symbolic.expansion.expansion import check_order
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.quarter_cycles import Travel, TwoSides
from ridgeback.symbolic.flow.loss_flow import LossFlow, SecondOrder
from ridgeback.symbolic.flow.second_order import parts_of, phase_terms
from ridgeback.symbolic.flow.term import LossTerm, Power, by_losses, merged
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.natural_units import Natural, over_leading
from ridgeback.symbolic.systems.oscillator import Oscillator, V
from ridgeback.symbolic.systems.parameters import symbol_of
from ridgeback.symbolic.systems.sides import half, require_one_law, without_velocity
from ridgeback.symbolic.systems.structure import dissipative_names, free_names, positive_root

LEADING = 2
"""Powers of the amplitude that the leading terms of a'/a count, as mu does in multiple scales."""
Growth: TypeAlias = "Mapping[sympy.Rational, list[LossTerm]]"
"""The terms of a'/a by r - 1 of the loss c(u) |u'|^r that they are of."""


@dataclass(frozen=True)
class Loss:
    """One term c(u) |u'|^exponent sign(u') of a loss: c(u) for u > 0, and c(-u) for u < 0."""

    exponent: sympy.Rational
    right: sympy.Expr
    left: sympy.Expr


def averaged_losses(oscillator: OscillatorLike, order: int, *, amplitude: str | None = None) -> LossFlow:
    """Average losses that need not be analytic at u' = 0 along the undamped orbit.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        u'' + f(u) + sum of c(u) |u'|^r sign(u') = 0, f and c analytic on each side of u = 0 and f linear at first.
    order : int
        phi' through this power of the amplitude, a'/a of a loss c(u) |u'|^r through the power order - 2 above r - 1.
    amplitude : str, optional
        ``fundamental`` (default) or ``peak``, of the undamped orbit; where the force has a kink at u = 0 ``peak`` only.

    Returns
    -------
    LossFlow
        phi' and a'/a, with what phi' has of the second order in the losses.

    Raises
    ------
    InputError
        For terms even in u', losses that are no sum of powers of u', and forces without a linear part.

    Examples
    --------
    >>> averaged_losses("u'' + 2*mu*u' + c*abs(u')*u' + sin(u) = 0", 4).growth_rate_expression()
    -a**3*c/(80*pi) - a**2*mu/16 - 4*a*c/(3*pi) - mu
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_name(oscillator, "a")
    names = loss_names(oscillator.force)
    force = _with_values(oscillator, names)
    require_one_law(oscillator.name, force)
    losses = losses_of(oscillator.name, force)
    rest = undamped(oscillator, names)
    if not rest.is_linear_at_rest:
        raise InputError(f"{oscillator.name}: averaging needs a linear restoring force; simulate shows the motion")
    average = _Average(rest, losses, names, order)
    frequency, growth = average.rates()
    definition = _definition(rest, amplitude)
    if definition == "fundamental":
        frequency, growth = _in_first_harmonic(rest, order, growth)
    none = tuple(0 for _ in names)
    second, more = average.second_order()
    undamped_terms = merged(LossTerm((n, *none), c) for n, c in enumerate(frequency))
    return LossFlow(
        system=oscillator.name,
        order=order,
        amplitude=definition,
        losses=names,
        undamped_terms=undamped_terms,
        phase_terms=merged([*undamped_terms, *more]),
        growth_terms=merged(term for terms in growth.values() for term in terms),
        second=second,
    )


def _definition(rest: Oscillator, amplitude: str | None) -> str:
    """The amplitude asked for, or the one that there is."""
    known = ("peak",) if rest.is_kinked else ("fundamental", "peak")
    return check_definition(amplitude or known[0], known)


def loss_names(force: sympy.Expr) -> tuple[str, ...]:
    """The parameters that the losses vanish with and are polynomials in, sorted; of the b of F/(1 + b) they are none.

    >>> F, b = (symbol_of(name) for name in "Fb")
    >>> loss_names(F * sympy.sign(V) / (1 + b) + V**3 * b**2 + V * symbol_of("mu"))
    ('F', 'mu')
    """
    lost = force - without_velocity(force)
    return tuple(name for name in dissipative_names(force) if lost.is_polynomial(symbol_of(name)))


def undamped(oscillator: Oscillator, names: Sequence[str]) -> Oscillator:
    """The oscillator without its losses."""
    kept = {name: value for name, value in oscillator.parameters.items() if name not in names}
    force = without_velocity(oscillator.force.subs({symbol_of(name): 0 for name in names}))
    return replace(oscillator, force=force, parameters=kept, defaults=kept, damping=None, small=None)


def losses_of(name: str, force: sympy.Expr) -> tuple[Loss, ...]:
    """The losses in a force, one for each power of u'.

    >>> from ridgeback.symbolic.systems.oscillator import U, V
    >>> [(loss.exponent, loss.right) for loss in losses_of("own", U + V * abs(V) / 3 + 2 * sympy.sign(V))]
    [(0, 2), (2, 1/3)]
    """
    lost = sympy.expand(force - without_velocity(force))
    if sympy.expand(lost + lost.xreplace({V: -V})) != 0:
        raise InputError(f"{name}: averaging is of losses that change sign with u', and {lost} holds terms that do not")
    ahead = sympy.expand(lost.xreplace({sympy.Abs(V): V, sympy.sign(V): sympy.S.One}))
    found: dict[sympy.Rational, sympy.Expr] = {}
    for term in sympy.Add.make_args(ahead):
        rest, power = term.as_coeff_exponent(V)
        if rest.has(V) or not power.is_Rational or power < 0:
            raise InputError(
                f"{name}: the loss {term} is no power of u', as c*abs(u')*u' is; expand it in powers of u'"
            )
        found[power] = found.get(power, sympy.S.Zero) + rest
    return tuple(Loss(power, half(c, 1), -half(c, -1)) for power, c in sorted(found.items()) if c != 0)


def _with_values(oscillator: Oscillator, names: Sequence[str]) -> sympy.Expr:
    values = {symbol_of(n): v for n, v in oscillator.parameters.items() if v is not None and n not in names}
    return oscillator.force.subs(values)


class _Average:
    """One derivation: both sides of the force, the losses on them, and the polynomials that all lives in."""

    def __init__(self, rest: Oscillator, losses: tuple[Loss, ...], names: Sequence[str], order: int) -> None:
        self.rest, self.losses, self.names, self.order = rest, losses, tuple(names), order
        shapes = [tuple(over_leading(side, sympy.S.One) for side in (loss.right, loss.left)) for loss in losses]
        more: dict[str, sympy.Expr | None] = dict.fromkeys(names)
        self.shapes: list[tuple[sympy.Expr, ...]] = []
        for i, pair in enumerate(shapes):
            marked = [_marked(natural, f"loss{i}{where}") for natural, where in zip(pair, "rl", strict=True)]
            self.shapes.append(tuple(shape for shape, _ in marked))
            for shape, values in marked:
                more |= {**dict.fromkeys(free_names(shape)), **values}
        self.betas = {(i, n): _beta(loss.exponent, n) for i, loss in enumerate(losses) for n in (1, 2)}
        more |= {_beta_name(*key): value for key, value in self.betas.items() if not value.is_Rational}
        self.both = TwoSides(rest, more=more)
        if self.both.d != 1:
            raise InputError(f"{rest.name}: averaging is of forces in whole powers of u on each side")

    def rates(self) -> tuple[tuple[sympy.Expr, ...], Growth]:
        """omega0 by powers of A, and the terms of A'/A."""
        here, there = self.both.travels(self.order)
        omega = self.both.frequency(here, there)
        common = truncated.multiply(omega, truncated.reciprocal(here.force))
        k, mean = positive_root(self.both.near.coefficient), self.rest.natural_frequency
        growth: dict[sympy.Rational, list[LossTerm]] = {}
        for i, loss in enumerate(self.losses):
            lifted = truncated.power(here.stretch, _fraction(loss.exponent + 1))
            series = truncated.multiply(common, truncated.multiply(lifted, self._lost(i, here, there)))
            unit = -mean * k ** (loss.exponent - 2)
            first = loss.exponent - 1
            growth[first] = [
                term
                for j, value in enumerate(series[: max(0, self.order - LEADING + 1)])
                for term in by_losses(_whole(first + j), unit * self._exact(value), self.names)
            ]
        return tuple(mean * self._exact(value) for value in omega), growth

    def second_order(self) -> tuple[SecondOrder, list[LossTerm]]:
        """What phi' has of it, and its terms; each loss counts like a^2, as mu does in multiple scales."""
        if self.order < 2 * LEADING:
            return SecondOrder.BELOW, []
        if self.both.exact_ratio != 1 or not all(loss.exponent.is_Integer for loss in self.losses):
            return SecondOrder.UNKNOWN, []
        sides = zip(*(travel.force[1:] for travel in self.both.travels(self.order)), strict=True)
        linear = next((n for n, pair in enumerate(sides) if any(value != 0 for value in pair)), self.order)
        above = min(self.order - 2 * LEADING, linear)
        parts = [p for loss in self.losses for p in parts_of(loss.right, loss.left, int(loss.exponent), above)]
        terms = phase_terms(parts, self.names, positive_root(self.both.near.coefficient), above)
        return SecondOrder.WHOLE if above == self.order - 2 * LEADING else SecondOrder.LINEAR, terms

    def _lost(self, i: int, here: Travel, there: Travel) -> list[Scalar]:
        """The integrals over both sides in powers of A, over k^r Y^(r+1) pi."""
        total: list[Scalar] = [fmpq(0)] * (self.order + 1)
        for shape, travel, ratio in zip(self.shapes[i], (here, there), (fmpq(1), self.both.ratio), strict=True):
            along = truncated.compose(self.both.series(shape, self.order + 1), [fmpq(0), *travel.place[:-1]])
            slope = [place * (n + 1) for n, place in enumerate(travel.place)]
            power = fmpq(1)
            for n, value in enumerate(truncated.multiply(slope, along)):
                power = power * ratio
                total[n] = total[n] + value * self._beta(i, n + 1) * power
        return truncated.compose(total, here.stretched)

    def _beta(self, i: int, n: int) -> Scalar:
        """B_n / pi of one loss."""
        if n > 2:
            return self._beta(i, n - 2) * _fraction(sympy.Integer(n - 2) / (n + self.losses[i].exponent))
        value = self.betas[i, n]
        return _fraction(value) if value.is_Rational else self.both.parameter(_beta_name(i, n))

    def _exact(self, value: Scalar) -> sympy.Expr:
        values = {symbol_of(name): constant for name, constant in self.both.known.items()}
        return sympy.expand(as_sympy(value, self.both.names).subs(values))


def _marked(natural: Natural, mark: str) -> tuple[sympy.Expr, dict[str, sympy.Expr]]:
    """A named expression with its names made its own."""
    renamed = {name: f"{mark}{name}" for name in natural.values}
    swap = {symbol_of(a): symbol_of(b) for a, b in renamed.items()}
    return natural.force.xreplace(swap), {renamed[name]: value for name, value in natural.values.items()}


def _beta_name(i: int, n: int) -> str:
    return f"lost{i}_{n}*"


def _beta(exponent: sympy.Rational, n: int) -> sympy.Expr:
    """B_n / pi = B(n/2, r/2 + 1) / (2 pi) of |u'|^r, exactly."""
    half, top = sympy.Rational(n, 2), exponent / 2 + 1
    return sympy.gammasimp(sympy.gamma(half) * sympy.gamma(top) / sympy.gamma(half + top)) / (2 * sympy.pi)


def _fraction(value: sympy.Expr) -> fmpq:
    return fmpq(int(value.p), int(value.q))


def _whole(power: Power) -> Power:
    return int(power) if sympy.Rational(power).is_Integer else power


def _in_first_harmonic(rest: Oscillator, order: int, growth: Growth) -> tuple[tuple[sympy.Expr, ...], Growth]:
    """omega0 and the growth rate in the first harmonic a: a'/a = G(A(a)) * (A/a) / (dA/da) of the peak A."""
    series = lindstedt(rest, order, amplitude="fundamental")
    peak = series.amplitude_as("peak")[1:]  # A/a
    slope = [c * (n + 1) for n, c in enumerate(peak)]
    change = _product(peak, _power(slope, sympy.S.NegativeOne))
    rows: dict[sympy.Rational, list[LossTerm]] = {first: [] for first in growth}
    for first, terms in growth.items():
        for term in terms:
            p, small = sympy.Rational(term.powers[0]), term.powers[1:]
            shape = _product(change, _power(peak, p))[: order - LEADING - int(p - first) + 1]
            rows[first] += [LossTerm((_whole(p + n), *small), term.coefficient * c) for n, c in enumerate(shape)]
    return series.frequency, rows


def _product(x: Sequence[sympy.Expr], y: Sequence[sympy.Expr]) -> list[sympy.Expr]:
    return [sympy.expand(sympy.Add(*(x[j] * y[n - j] for j in range(n + 1)))) for n in range(min(len(x), len(y)))]


def _power(x: Sequence[sympy.Expr], r: sympy.Rational) -> list[sympy.Expr]:
    """x^r for x_0 = 1, as ``truncated.power``."""
    result = [sympy.S.One]
    for n in range(1, len(x)):
        inner = sympy.Add(*(((r + 1) * j - n) * x[j] * result[n - j] for j in range(1, n + 1)))
        result.append(sympy.expand(inner / n))
    return result
