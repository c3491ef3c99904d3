"""A force that is analytic on each side of 0: what it is on a side, and whether it has a kink there or beyond."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FUNCTIONS, NumberRing, plain_dot
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.grammar.at_origin import brief, sign_at_origin
from ridgeback.symbolic.grammar.kinks import KINKS, U, V, is_kink, is_straight
from ridgeback.symbolic.systems.structure import without_sizes

MOST_ORDERS: Final = 16
"""A force that begins with a higher power of u than this is none."""


class NoLinearForceError(InputError):
    """There is no natural frequency: the frequency vanishes, or grows without bound, with the amplitude."""


class NoSeriesError(InputError):
    """There is no series about rest that holds for the motions that are asked about: the force has stops."""


def no_linear_force(name: str) -> NoLinearForceError:
    """What is said where a natural frequency is asked for and there is none."""
    return NoLinearForceError(
        f"{name}: there is no linear restoring force at u = 0, so the frequency is no constant at small amplitudes "
        "(u'' + u**3 = 0 has omega proportional to A) and no natural frequency exists; derive gives the series in "
        "powers of A, and derive --at 1 encloses it; for anything else add a linear term k**2*u"
    )


def is_kinked(force: sympy.Expr, *unknowns: sympy.Symbol) -> bool:
    """Whether abs, sign or a broken power of u or u' stands in a force, with its kink at rest or away from it.

    Parameters
    ----------
    force : sympy.Expr
        In ``U``, ``V`` and parameters.
    unknowns : sympy.Symbol, optional
        ``U`` or ``V``, to ask for one of them.

    Returns
    -------
    bool
        Whether there is a kink.

    Examples
    --------
    >>> is_kinked(U * abs(U)), is_kinked(U * abs(U), V), is_kinked(U**3), is_kinked(abs(U - 1))
    (True, False, False, True)
    """
    wanted = unknowns or (U, V)
    return any(kink.args[0].has(*wanted) for kink in kinks_of(force))


def kinks_of(force: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """Every abs and sign of u, u' and a*u + b in a force."""
    return tuple(e for e in force.atoms(sympy.Abs, sympy.sign) if is_kink(e))


def kinked_at_rest(force: sympy.Expr) -> bool:
    """Whether a force has a kink at u = 0.

    >>> kinked_at_rest(abs(U)), kinked_at_rest(abs(U - 1))
    (True, False)
    """
    return bool(force.has(*(kink for kink in KINKS if kink.args[0] == U)))


def stops_of(force: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """Where a force has kinks away from rest, rising where these are numbers.

    >>> stops_of(U + abs(2 * U - 1) - abs(U + 3))
    (-3, 1/2)
    """
    places = {place_of(kink.args[0]) for kink in kinks_of(force) if is_straight(kink.args[0])} - {sympy.S.Zero}
    return tuple(sorted(places, key=lambda place: (float(place) if place.is_number else math.inf, str(place))))


def place_of(argument: sympy.Expr) -> sympy.Expr:
    """The u at which a*u + b vanishes."""
    return sympy.expand(-argument.subs(U, 0) / argument.diff(U))


def on_stretch(force: sympy.Expr, point: sympy.Expr) -> sympy.Expr:
    """The law that holds at a place between kinks in u, without them; parameters left symbolic count as positive.

    Parameters
    ----------
    force : sympy.Expr
        In ``U``, ``V`` and parameters.
    point : sympy.Expr
        The place; 0 for the law about rest, where kinks at u = 0 stay.

    Returns
    -------
    sympy.Expr
        The force, abs and sign replaced by what they are there.

    Raises
    ------
    InputError
        Where a symbolic parameter hides on which side of a kink the place is.

    Examples
    --------
    >>> on_stretch(U + abs(U - 1), sympy.S.Zero), on_stretch(U + abs(U - 1), sympy.Integer(2))
    (1, 2*u - 1)
    """
    beyond = [kink for kink in kinks_of(force) if kink.args[0].has(U) and kink.args[0].subs(U, point) != 0]
    if not beyond:
        return force
    values = {kink: _on_side(kink, point) for kink in beyond}
    return sympy.expand(force.xreplace(values))


def _on_side(kink: sympy.Expr, point: sympy.Expr) -> sympy.Expr:
    (argument,) = kink.args
    there = argument.subs(U, point)
    bold = there.subs({s: sympy.Symbol(s.name, positive=True) for s in there.free_symbols})
    if not (bold.is_positive or bold.is_negative):
        raise InputError(
            f"on which side of rest {brief(kink)} has its kink depends on parameters; give them numbers, e.g. "
            f"{min(s.name for s in there.free_symbols)}=1"
        )
    side = 1 if bold.is_positive else -1
    return side * argument if isinstance(kink, sympy.Abs) else sympy.Integer(side)


def require_one_law(name: str, force: sympy.Expr) -> None:
    """Raise NoSeriesError for a force with a kink away from rest, which no series about rest holds beyond.

    >>> require_one_law("mine", U + abs(U - 1) - 1)
    Traceback (most recent call last):
        ...
    ridgeback.symbolic.systems.sides.NoSeriesError: mine: the force has a kink at u = 1, away from rest, beyond ...
    """
    stops = stops_of(force)
    if not stops:
        return
    places = f"{'a kink' if len(stops) == 1 else 'kinks'} at u = {', '.join(brief(place) for place in stops)}"
    raise NoSeriesError(
        f"{name}: the force has {places}, away from rest, beyond which no series about rest holds; up to there "
        f"it is f = {brief(on_stretch(force, sympy.S.Zero))}, which derive takes as an equation of its own; simulate, "
        "estimate, benchmark, report and study integrate this one from kink to kink"
    )


def half(force: sympy.Expr, side: int) -> sympy.Expr:
    """The restoring force at the distance u > 0 on one side of rest, counted positive towards rest.

    Parameters
    ----------
    force : sympy.Expr
        f(u) in ``U`` and parameters.
    side : int
        1 for u > 0, -1 for u < 0.

    Returns
    -------
    sympy.Expr
        side * f(side * u), without abs and sign; parameters left symbolic are taken as positive.

    Examples
    --------
    >>> half(U * abs(U) + U**2, 1), half(U * abs(U) + U**2, -1)
    (2*u**2, 0)
    """
    near = on_stretch(force, sympy.S.Zero)
    seen = near.xreplace({sympy.Abs(U): U, sympy.sign(U): sympy.Integer(side), U: side * U})
    return sympy.expand(side * parameters_positive(seen))


def parameters_positive(expression: sympy.Expr) -> sympy.Expr:
    """Without abs and sign of parameters that are left symbolic: they are taken as positive."""
    bare = without_sizes(expression)
    return bare.replace(lambda e: isinstance(e, sympy.sign) and not e.has(U, V), lambda _: sympy.S.One)


def whole(right: sympy.Expr, left: sympy.Expr) -> sympy.Expr:
    """The even continuation of two functions of the distance, such as a potential: ``right`` for u > 0, else ``left``.

    >>> whole(U**3, U**3), whole(3 * U**2, U**2)
    (u**2*Abs(u), u**2*sign(u) + 2*u**2)
    """
    size = sympy.Abs(U)
    one, other = (e.xreplace({U: size}) for e in (right, left))
    mean, half_difference = sympy.expand((one + other) / 2), sympy.expand((one - other) / 2)
    return mean + sympy.expand(half_difference * sympy.sign(U))


def without_velocity(force: sympy.Expr) -> sympy.Expr:
    """f(u, 0), with sign(0) = 0."""
    return force.xreplace({V: sympy.S.Zero})


def kink_advice(force: sympy.Expr, *, conservative: bool) -> str:
    """What to do with a force that has a kink at rest, where an expansion about rest is asked for."""
    if not conservative:
        return (
            f"the losses in {brief(force)} are not analytic at rest, so no power series in u' holds them; derive "
            "(averaged_losses) averages them along the undamped orbit"
        )
    if is_kinked(force, V):
        return f"{brief(force)} has a kink in u' that takes no energy, for which there is no method here; leave it out"
    return (
        f"{brief(force)} is analytic on each side of u = 0 and not at it; --method energy-integral gives the series, "
        "in the peak or trough amplitude"
    )


def require_no_kinks(name: str, force: sympy.Expr, *, conservative: bool) -> None:
    """Raise InputError for a force with kinks, at rest or away from it."""
    require_one_law(name, force)
    if is_kinked(force):
        raise InputError(f"{name}: {kink_advice(force, conservative=conservative)}")


def require_rest(name: str, force: sympy.Expr) -> None:
    """Raise InputError unless the force at u = u' = 0 is 0."""
    if force != 0:
        raise InputError(
            f"{name}: u = 0 is not at rest, since f(0, 0) = {brief(force)} and not 0; measure the unknown from the "
            "equilibrium"
        )


def harmonic_mean(one: sympy.Expr, other: sympy.Expr) -> sympy.Expr:
    """2 a b / (a + b), the frequency of half a cycle at a and half at b.

    >>> harmonic_mean(sympy.Integer(2), sympy.Integer(1))
    4/3
    """
    mean = one if one == other else 2 * one * other / (one + other)
    return sympy.radsimp(mean) if mean.is_number else mean


def root_of_u(*forces: sympy.Expr) -> int:
    """The d for which forces of u > 0 are analytic in w = u^(1/d): the common denominator of the powers of u.

    >>> root_of_u(U ** sympy.Rational(1, 3), sympy.sqrt(U) + U)
    6
    """
    powers = {p for force in forces for p in force.atoms(sympy.Pow) if p.base == U and p.exp.is_Rational}
    return math.lcm(1, *(int(p.exp.q) for p in powers))


def in_root(force: sympy.Expr, d: int) -> sympy.Expr:
    """The force of u = w^d, w named ``U``.

    >>> in_root(U ** sympy.Rational(1, 3) + U**2, 3)
    u**6 + u
    """
    if d == 1:
        return force
    w = sympy.Dummy("w", positive=True)
    return force.subs(U, w**d).xreplace({w: U})


@dataclass(frozen=True)
class Half:
    """The restoring force on one side of rest, and how it begins.

    ``force`` is that of u = w^root at the distance u, w named ``U`` and the force analytic in it; it begins with
    ``coefficient`` * w^power, and ``sign`` is that of the coefficient, None where a symbolic parameter hides it.
    """

    force: sympy.Expr
    root: int
    power: int
    coefficient: sympy.Expr
    sign: int | None

    @property
    def exponent(self) -> sympy.Rational:
        """The power of u that the force begins with."""
        return sympy.Rational(self.power, self.root)


def halves(force: sympy.Expr) -> tuple[Half | None, Half | None]:
    """Both sides of a restoring force, u > 0 first, in one root of u; None where there is no force.

    Parameters
    ----------
    force : sympy.Expr
        f(u), the parameters that have values inserted.

    Returns
    -------
    pair of Half or None
        The right and the left side.

    Examples
    --------
    >>> right, left = halves(2 * U + U**2 + abs(U))
    >>> (right.coefficient, right.exponent), (left.coefficient, left.exponent)
    ((3, 1), (1, 1))
    >>> halves(U - sympy.sin(U))[0].exponent
    3
    """
    sides = [half(force, side) for side in (1, -1)]
    d = root_of_u(*sides)
    right, left = (_begun(in_root(side, d), d) for side in sides)
    return right, left


def restoring_halves(name: str, force: sympy.Expr) -> tuple[Half, Half]:
    """Both sides of a force f(u) that restores, u > 0 first; InputError where it does not."""
    right, left = (
        _restoring(name, found, where) for where, found in zip(("u > 0", "u < 0"), halves(force), strict=True)
    )
    return right, left


def _restoring(name: str, found: Half | None, where: str) -> Half:
    if found is None or found.sign == -1:
        raise InputError(f"{name}: the force does not restore for {where}, so nothing oscillates about 0")
    return found


def _begun(force: sympy.Expr, d: int) -> Half | None:
    """A side with its first term, from its power series."""
    if force.has(sympy.I, sympy.oo, -sympy.oo, sympy.zoo, sympy.nan):
        raise InputError(
            f"the force on one side of rest, {brief(force)}, is not finite and real; keep what roots, "
            "logarithms and inverse functions are taken of within their range"
        )
    ring = _Expressions(
        sympy.Integer, {name: getattr(sympy, name) for name in FUNCTIONS}, _dot, sympy.Pow, number=lambda e: e
    )
    fixed = {symbol: [symbol] for symbol in force.free_symbols - {U}}
    series = Program(force, ring, {}, U, V, fixed={**fixed, U: [sympy.S.Zero, sympy.S.One]}).root
    for n in range(MOST_ORDERS * d if force != 0 else 0):
        value = sympy.expand(series.get(n))
        sign = None if value == 0 else sign_at_origin(value, {})
        if value != 0 and sign != 0:
            return Half(force, d, n, value, sign)
    return None


def _dot(left: Sequence[sympy.Expr], right: Sequence[sympy.Expr]) -> sympy.Expr:
    """The sum of products, expanded so that zeros show."""
    return sympy.expand(plain_dot(left, right))


class _Expressions(NumberRing):
    """Coefficients that are SymPy expressions in the parameters; whether they are real was seen before."""

    def power(self, element: sympy.Expr, numerator: int, denominator: int) -> sympy.Expr:
        return element ** sympy.Rational(numerator, denominator)
