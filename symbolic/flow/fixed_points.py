r"""Limit cycles as fixed points of the amplitude equation: the zeros s = a^2 > 0 of a'/a = delta(s, m).

With rational values m the right-hand side is an exact polynomial in s and FLINT isolates all its zeros with proof.
They are zeros of the *truncated* equation: far out, where the dropped terms count, they mean nothing, and are said to
be beyond the reach of the order (``reach``), of no stability.  What the
expansion itself asserts is the exact series s(m) of the zero that stays in reach as m -> 0; which of the zeros it
belongs to is proved by following that zero from m = 0 to the value, with interval Newton steps.  Where the terms of a
power of m come to an end (``SlowFlow.complete``), only the powers that have all of theirs enter: a is not small then.

    delta = m P(s, m), P(s_0, 0) = 0, s_0 > 0 rational and simple: s = s_0 + s_1 m + ...   (van der Pol: s_0 = 4)
    delta(0, 0) = 0, d delta/ds(0, 0) != 0:                        s = s_1 m + s_2 m^2 + ...   (Hopf bifurcation)

Stability is the sign of the slope d(a delta)/da = 2 s d delta/ds at the zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import sympy
from flint import arb, ctx, fmpq, fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import number_ball, polynomial_at, rational, whole_power
from ridgeback.symbolic.enclosure.turning_points import real_roots
from ridgeback.symbolic.expansion.ball_expansion import ball_row
from ridgeback.symbolic.flow.reach import Reach, reach_of
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.singularities.limits import Limits
from ridgeback.symbolic.systems.parameters import Value, merged

BITS: Final = 128
DIGITS: Final = 20
"""Digits printed."""
MOST_STEPS: Final = 200
"""Interval Newton steps from m = 0 to the value at most; a branch that needs more is not followed."""
NEWTON_STEPS: Final = 6
"""They square the width each; the last ones are limited by the float that the box is expanded about."""
Plane = dict[tuple[int, int], fmpq]
"""A polynomial in s and m: coefficients by the powers of both."""
Series = tuple[sympy.Expr, ...]


@dataclass(frozen=True, repr=False)
class FixedPoint:
    """One limit cycle of a slow flow, in balls, in the oscillator's own units."""

    amplitude: arb
    """The ``fundamental`` amplitude."""
    frequency: arb
    """phi' there, in rad per time unit."""
    slope: arb
    """d(a')/da there, per time unit: the rate at which neighbouring amplitudes part or meet."""
    stable: bool | None
    """Whether the slope is negative; None when its ball holds 0, and beyond the reach of the order."""
    square_series: tuple[sympy.Expr, ...] | None
    """a^2 in powers of the small parameter, exact for the oscillator itself; None when no such series ends here."""
    reach: Reach
    """Whether this zero of the truncated equation tells of the oscillator at all."""

    def __repr__(self) -> str:
        kind = {True: "stable", False: "unstable", None: "stability not known"}[self.stable]
        amplitude, frequency = (value.str(12, radius=False) for value in (self.amplitude, self.frequency))
        beyond = ", beyond the reach of the order" if self.reach.beyond else ""
        return f"<FixedPoint: a = {amplitude}, phi' = {frequency}, {kind}{beyond}>"

    @property
    def amplitude_series(self) -> tuple[sympy.Expr, ...] | None:
        """a in powers of the small parameter; None without a series, or when a starts with its square root."""
        return None if self.square_series is None else root_series(self.square_series)

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: balls as decimals with their radii; the series of a^2 is null when none ends here.

        The radii are those of the zero of the truncated equation.  ``last_change`` is the relative change by the
        terms of the last two orders; beyond the reach of this one ``beyond_reach`` is true, with the reason, and the
        slope null.
        """
        row: dict[str, object] = {}
        with ctx.workprec(BITS):
            for name in ("amplitude", "frequency", "slope"):
                printed = ball_row(getattr(self, name), DIGITS)
                row |= {name: printed["coefficient"], f"{name}_radius": printed["radius"]}
        series = None if self.square_series is None else [str(c) for c in self.square_series]
        row |= {"stable": self.stable, "square_series": series, "last_change": self.reach.change}
        if not self.reach.beyond:
            return row | {"beyond_reach": False}
        return row | {"slope": None, "slope_radius": None, "beyond_reach": True, "why": self.reach.why}


def fixed_points(
    flow: SlowFlow, values: Mapping[str, Value], *, limits: Limits | None = None
) -> tuple[FixedPoint, ...]:
    """Return every limit cycle of the truncated amplitude equation at rational values of the small parameters.

    Parameters
    ----------
    flow : SlowFlow
        Without symbolic parameters beside the small ones.
    values : mapping of str to number or str
        A value for each small parameter; floats and text count as the decimals they print as.
    limits : Limits, optional
        Those of the frequency that the flow contains (``flow.limits``): a zero outside them is beyond its reach.

    Returns
    -------
    tuple of FixedPoint
        In rising order of amplitude, each certified to be a zero of the truncated equation.

    Raises
    ------
    InputError
        For a missing or unknown name, a parameter that is symbolic, and an amplitude equation whose coefficients are
        not rational.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow = multiple_scales(find("van-der-pol"), 6, weight=1)
    >>> cycle = fixed_points(flow, {"eps": "1/10"})[0]
    >>> cycle.amplitude == 2, cycle.stable, cycle.amplitude_series
    (True, True, (2, 0))
    """
    given = merged(flow.system, dict.fromkeys(flow.small_parameters), values)
    small = tuple(rational(value) for value in flow.values(given))
    with ctx.workprec(BITS):
        entire = flow.entire()
        delta, omega = (_squared(_inserted(terms, small)) for terms in (entire.growth_rate, entire.frequency))
        polynomial = _polynomial(delta, flow)
        zeros = [s for s in real_roots(polynomial) if s > 0] if polynomial.degree() > 0 else []
        branches = tuple(_branches(flow, small[0])) if len(small) == 1 else ()
        numbers = tuple(float(value) for value in flow.values(given))
        reaches = [reach_of(entire, float(s) ** 0.5, numbers, limits=limits) for s in zeros]
        pairs = zip(zeros, reaches, strict=True)
        return tuple(_point(s, polynomial, omega, branches, reach) for s, reach in pairs)


def _point(
    s: arb, delta: fmpq_poly, omega: list[sympy.Expr], branches: tuple[tuple[arb, Series], ...], reach: Reach
) -> FixedPoint:
    slope = 2 * s * polynomial_at(delta.derivative().coeffs(), s)
    frequency = sum((number_ball(c) * whole_power(s, n) for n, c in enumerate(omega)), arb(0))
    stable = None if slope.contains(0) or reach.beyond else bool(slope < 0)
    series = [found for place, found in branches if place.overlaps(s)]
    return FixedPoint(s.sqrt(), frequency, slope, stable, series[0] if series else None, reach)


def _inserted(terms: tuple[Term, ...], small: tuple[fmpq, ...]) -> dict[int, sympy.Expr]:
    """Coefficients by the power of a, with the small parameters inserted."""
    result: dict[int, sympy.Expr] = {}
    for term in terms:
        value = term.coefficient
        for m, power in zip(small, term.powers[1:], strict=True):
            value = value * sympy.Rational(int(m.p), int(m.q)) ** power
        result[term.powers[0]] = sympy.expand(result.get(term.powers[0], sympy.S.Zero) + value)
    return result


def _squared(by_power: dict[int, sympy.Expr]) -> list[sympy.Expr]:
    """Coefficients of powers of s = a^2; a slow flow is even in a, since (a, phi) and (-a, phi + pi) are one state."""
    return [by_power.get(2 * n, sympy.S.Zero) for n in range(max(by_power, default=0) // 2 + 1)]


def _polynomial(coefficients: list[sympy.Expr], flow: SlowFlow) -> fmpq_poly:
    wrong = [c for c in coefficients if not c.is_Rational]
    if wrong:
        raise InputError(
            f"{flow.system}: the amplitude equation holds {wrong[0]}, which is no rational number; give every "
            "parameter one, so that the zeros can be isolated with proof"
        )
    return fmpq_poly([rational(c) for c in coefficients])


def _branches(flow: SlowFlow, m: fmpq) -> Iterator[tuple[arb, Series]]:
    """The zeros that have an exact series, each followed to the value m."""
    plane, reach, starts = _reduced(flow)
    for start in starts:
        place = _followed(plane, start, m)
        if place is not None:
            unit = [sympy.Rational(int(c.p), int(c.q)) for c in _solved(plane, start, reach)]
            yield place, tuple(unit)


def cycle_series(flow: SlowFlow) -> tuple[Series, ...]:
    """Return the exact series of a^2 in the small parameter m, one for each limit cycle that has one as m vanishes.

    Parameters
    ----------
    flow : SlowFlow
        With one small parameter.

    Returns
    -------
    tuple of tuple of sympy.Expr
        Coefficients of the powers 0, 1, ... of the small parameter, through the last that the terms kept in the flow
        determine; empty when there is no such cycle, or not exactly one small parameter.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> cycle_series(multiple_scales(find("rayleigh"), 12, weight=1))
    ((4, 0, 9/16, 0),)
    """
    if len(flow.weights) != 1:
        return ()
    plane, reach, starts = _reduced(flow)
    return tuple(tuple(sympy.Rational(int(c.p), int(c.q)) for c in _solved(plane, start, reach)) for start in starts)


def frequency_series(flow: SlowFlow, square: Series) -> Series:
    """Return phi' on a limit cycle in powers of the small parameter.

    Where the terms of a power of m come to an end, phi' = k + O(m) depends on a through m only and is known one power
    further than a^2.

    Parameters
    ----------
    flow : SlowFlow
        With one small parameter.
    square : tuple of sympy.Expr
        The series of a^2 there, as ``cycle_series`` gives it.

    Returns
    -------
    tuple of sympy.Expr
        Coefficients of the powers 0, 1, ..., in rad per time unit.

    Raises
    ------
    InputError
        When a parameter is symbolic.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow = multiple_scales(find("van-der-pol"), 12, weight=1)
    >>> frequency_series(flow, cycle_series(flow)[0])
    (1, 0, -1/16, 0, 17/3072)
    """
    terms = [(t.powers, sympy.expand(t.coefficient / flow.scale)) for t in flow.entire().frequency]
    if any(not value.is_Rational for _, value in terms):
        raise InputError(f"{flow.system}: the coefficients of phi' hold symbols; give every parameter a number")
    plane = {(powers[0] // 2, powers[1]): rational(value) for powers, value in terms}
    series = [rational(value) for value in square] + [fmpq(0)] * (flow.complete is not None)
    return tuple(flow.scale * sympy.Rational(int(c.p), int(c.q)) for c in _substituted(plane, series))


def _reduced(flow: SlowFlow) -> tuple[Plane, int, list[fmpq]]:
    """The amplitude equation as a polynomial in s and m, the last power of m it determines, and s at m = 0."""
    if any(not term.coefficient.is_Rational for term in flow.growth_rate):
        return {}, 0, []
    plane = {(t.powers[0] // 2, t.powers[1]): rational(t.coefficient) for t in flow.entire().growth_rate}
    lowest = min((r for _, r in plane), default=0)
    if lowest > 0:
        return _detached(plane, flow, lowest)
    if (0, 0) not in plane and (1, 0) in plane:
        return plane, flow.order // max(flow.weight, 2), [fmpq(0)]
    return plane, 0, []


def _detached(plane: Plane, flow: SlowFlow, lowest: int) -> tuple[Plane, int, list[fmpq]]:
    """delta = m^lowest P: the simple positive rational zeros of P(s, 0), when no terms of P were left out."""
    plane = {(i, r - lowest): c for (i, r), c in plane.items()}
    first = fmpq_poly([plane.get((i, 0), fmpq(0)) for i in range(max(i for i, _ in plane) + 1)])
    reach = -1 if flow.complete is None else flow.complete - lowest
    factors = first.factor()[1] if first.degree() > 0 and reach >= 0 else []
    zeros = [-f[0] / f[1] for f, times in factors if f.degree() == 1 and times == 1]
    return plane, reach, sorted(s for s in zeros if s > 0)


def _solved(plane: Plane, start: fmpq, reach: int) -> list[fmpq]:
    """s(m) with P(s(m), m) = 0 through m^reach: coefficient n enters P linearly, with the slope P_s at the start."""
    slope = sum((i * c * start ** (i - 1) for (i, r), c in plane.items() if r == 0 and i > 0), fmpq(0))
    series = [start] + [fmpq(0)] * reach
    for n in range(1, reach + 1):
        series[n] = -_substituted(plane, series)[n] / slope
    return series


def _substituted(plane: Plane, series: list[fmpq]) -> list[fmpq]:
    """P(s(m), m) as a series, by Horner's rule in s."""
    total = [fmpq(0)] * len(series)
    for i in range(max(i for i, _ in plane), -1, -1):
        total = truncated.multiply(total, series)
        for (j, r), c in plane.items():
            if j == i and r < len(total):
                total[r] = total[r] + c
    return total


def root_series(square: tuple[sympy.Expr, ...]) -> tuple[sympy.Expr, ...] | None:
    """The square root of a series with a positive constant term, None without one.

    >>> root_series((sympy.Integer(4), sympy.S.Zero, sympy.Rational(1, 4)))
    (2, 0, 1/16)
    """
    if not square or not square[0].is_positive:
        return None
    ratio = truncated.square_root([rational(c / square[0]) for c in square])
    return tuple(sympy.sqrt(square[0]) * sympy.Rational(int(c.p), int(c.q)) for c in ratio)


def _followed(plane: Plane, start: fmpq, target: fmpq) -> arb | None:
    """The zero of P(., target) reached from the simple zero ``start`` of P(., 0) along [0, target]; None if lost.

    On each stretch of m an interval Newton step proves one and only one zero in a box; the next box holds the zero at
    the stretch's end, so that all of them belong to one continuous branch.
    """
    place, m, step = arb(start), fmpq(0), target
    for _ in range(MOST_STEPS):
        if m == target:
            return place
        step = step if abs(step) < abs(target - m) else target - m
        box = _one_zero(plane, place, m, m + step)
        if box is None:
            step = step / 2
            continue
        place, m, step = _tightened(plane, box, m + step), m + step, step * 2
    return None


def _one_zero(plane: Plane, place: arb, first: fmpq, last: fmpq) -> arb | None:
    """A box around a known zero in which P(., m) has exactly one zero for every m of a stretch, None if unproved.

    P is expanded exactly about the middle, so that balls around 0 enclose it without loss.
    """
    middle, half = fmpq(*float(place).as_integer_ratio()), abs(last - first) / 2
    near, stretch = _shifted(plane, middle, (first + last) / 2), arb(0, arb(half))
    for exponent in (-2, 1, 4, 8):  # the zero moves with some finite speed ds/dm; short stretches then do
        box = arb(0, arb(half) * arb(2) ** exponent)
        inner = _newton(near, box, stretch)
        if inner is not None and box.contains_interior(inner) and box.contains_interior(place - middle):
            return middle + box
    return None


def _shifted(plane: Plane, s: fmpq, m: fmpq) -> Plane:
    """P(s + x, m + y) as a polynomial in x and y."""
    return _transposed(_shifted_first(_transposed(_shifted_first(plane, s)), m))


def _shifted_first(plane: Plane, s: fmpq) -> Plane:
    top, moved = max(i for i, _ in plane), fmpq_poly([s, 1])
    result = {}
    for r in {r for _, r in plane}:
        row = fmpq_poly([plane.get((i, r), fmpq(0)) for i in range(top + 1)])(moved)
        result.update({(i, r): c for i, c in enumerate(row.coeffs())})
    return result


def _transposed(plane: Plane) -> Plane:
    return {(r, i): c for (i, r), c in plane.items()}


def _newton(plane: Plane, box: arb, m: arb) -> arb | None:
    middle = arb(box.mid())
    slope = _value(plane, box, m, derivative=True)
    return None if slope.contains(0) else middle - _value(plane, middle, m) / slope


def _tightened(plane: Plane, box: arb, m: fmpq) -> arb:
    """The zero at one m, by Newton steps inside the box that holds it alone."""
    for _ in range(NEWTON_STEPS):
        middle = fmpq(*float(box).as_integer_ratio())
        inner = _newton(_shifted(plane, middle, m), box - middle, arb(0))
        if inner is None or not box.overlaps(middle + inner):
            return box
        box = box.intersection(middle + inner)
    return box


def _value(plane: Plane, s: arb, m: arb, *, derivative: bool = False) -> arb:
    if derivative:
        plane = {(i - 1, r): c * i for (i, r), c in plane.items() if i > 0}
    return sum((c * whole_power(s, i) * whole_power(m, r) for (i, r), c in plane.items()), arb(0))
