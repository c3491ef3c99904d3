"""The exact equilibrium that a decimal stands for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.roots import NAME, Root, reduced
from ridgeback.symbolic.grammar.nodes import names
from ridgeback.symbolic.grammar.parse import Equation, U, V, W, parse_expression, to_sympy
from ridgeback.symbolic.systems.losses import with_named_losses
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.parameters import Parameters, Value, merged
from ridgeback.symbolic.systems.potential import force_potential
from ridgeback.symbolic.systems.structure import damping_name, rewritten, small_name, solved_for_acceleration

EXACTLY: Final = sympy.Rational(1, 10**25)
"""Distance to an equilibrium, of the thirty digits of an exact number, within which that number is it."""


def near_equilibrium(tree: Equation, about: str, parameters: Mapping[str, Value]) -> sympy.Expr:
    """The exact equilibrium that a decimal stands for, from the roots of the polynomial that the force vanishes with.

    Parameters
    ----------
    tree : Equation
        The equation.
    about : str
        A decimal such as ``"0.1127"``: an equilibrium within a unit of its last place is meant.
    parameters : mapping of str to number or str
        Values of parameters.

    Returns
    -------
    sympy.Expr
        A rational number, the root of a quadratic, a root of a rational number, or a :class:`Root`.

    Raises
    ------
    InputError
        When no equilibrium is so near, with the nearest one.

    Examples
    --------
    >>> from ridgeback.symbolic.grammar.parse import parse_equation
    >>> near_equilibrium(parse_equation("u'' - 1 + 10*u - 10*u**2 = 0"), "0.1127", {})
    1/2 - sqrt(15)/10
    """
    leaves = f"about {about} is not an equilibrium: the equation does not vanish there"
    still = sympy.together(to_sympy(tree.left).subs({V: 0, W: 0}).subs(numbers(tree, parameters)))
    above, _ = sympy.fraction(still)
    if not above.is_polynomial(U) or above.free_symbols - {U}:
        raise InputError(f"{leaves}, and no polynomial in u says where it does{_near(still, about)}")
    given = sympy.Rational(str(to_sympy(parse_expression(about)).evalf(30)))
    found = [(abs(root.evalf(30) - given), root, factor) for factor, root in _real_roots(above)]
    if not found:
        raise InputError(f"{leaves}, and there is none")
    distance, root, factor = min(found, key=lambda each: each[0])
    if distance > max(_last_place(about), EXACTLY):
        raise InputError(f"{leaves}; the nearest equilibrium is at {sympy.N(root, 12)}")
    return _closed(factor, root) or Root(*root.args)


def _near(still: sympy.Expr, about: str) -> str:
    """Where a force that is no polynomial vanishes, as far as numbers tell, and what can be done about it."""
    way = "give the place exactly, or write the Taylor polynomial of the force about it"
    try:
        place = sympy.nsolve(still, U, sympy.N(to_sympy(parse_expression(about)), 20), prec=20)
    except (ValueError, TypeError, ZeroDivisionError):
        return f"; {way}"
    return f" (it does near {place}); {way}"


def about_root(tree: Equation, root: Root, parameters: Mapping[str, Value], **details: Any) -> Oscillator:
    """An oscillator about an equilibrium that is known as the root of a polynomial only.

    Parameters
    ----------
    tree : Equation
        The equation.
    root : Root
        Where its force vanishes.
    parameters : mapping of str to number or str
        Values of parameters; those that the equilibrium depends on are inserted.
    **details
        Title, reference and the like, as ``Oscillator.from_equation``.

    Returns
    -------
    Oscillator
        Coefficients are polynomials in the root, called ``r``.

    Raises
    ------
    InputError
        For an equation that calls something else ``r``, and when the equilibrium is no centre.

    Examples
    --------
    >>> from ridgeback.symbolic.grammar.parse import parse_equation
    >>> tree = parse_equation("x'' + x**3 + x - 1 = 0")
    >>> about_root(tree, near_equilibrium(tree, "0.68", {}), {}).natural_frequency
    sqrt(1 + 3*r**2)
    """
    if NAME in (tree.unknown, *names(tree.left)):
        raise InputError(f"the equilibrium is {root.told}: rename the {NAME} of the equation, so that both can be told")
    values, left = numbers(tree, parameters), to_sympy(tree.left)
    still = left.subs({V: 0, W: 0})
    inserted = {name: value for name, value in values.items() if name in still.free_symbols}
    above, below = sympy.fraction(sympy.together(still.subs(inserted)))
    moving = sympy.expand((left - still).subs(inserted))
    if not moving.is_polynomial(U):
        raise InputError(f"about the equilibrium {root.told}: the terms in u' and u'' must be polynomials in u")
    moved = _over_rest(_moved_to(above, root), _moved_to(below, root), root) + _moved_to(moving, root).as_expr()
    kept = {str(name): value for name, value in values.items() if name not in inserted}
    kept |= dict.fromkeys((str(name) for name in moved.free_symbols - {U, V, W, *values}), None)
    try:
        return _oscillator(moved, kept, tree.unknown, root, details)
    except InputError as error:
        places = sorted(sympy.N(each, 12) for _, each in _real_roots(above.subs({V: 0, W: 0})))
        every = ", ".join(map(str, places))
        raise InputError(f"about the equilibrium {root.told}: {error}; the equilibria are {every}") from None


def _oscillator(
    left: sympy.Expr, values: Parameters, unknown: str, root: Root, details: Mapping[str, Any]
) -> Oscillator:
    """The oscillator left = 0 about its rest, with the words that say which that is."""
    lossy = with_named_losses(solved_for_acceleration(left), values)
    integral, note = force_potential(lossy.force, None, unknown)
    named = {"name": "equation", "title": "equation", "symbol": sympy.latex(sympy.Symbol(unknown)), **details}
    return Oscillator(
        equation=f"{rewritten(lossy.force, unknown)}, {root.told}",
        force=lossy.force,
        parameters=lossy.parameters,
        defaults=lossy.parameters,
        potential=integral,
        potential_note=note,
        small=small_name(lossy.force),
        damping=damping_name(lossy.force),
        **named,
    )


def _moved_to(polynomial: sympy.Expr, root: Root) -> sympy.Poly:
    """A polynomial in u about the root, its coefficients of lowest degree in it: what vanishes there is gone."""
    terms = sympy.Poly(sympy.expand(polynomial.subs(U, U + root)), U).as_dict()
    return sympy.Poly({power: reduced(coefficient, root) for power, coefficient in terms.items()}, U)


def _over_rest(above: sympy.Poly, below: sympy.Poly, root: Root) -> sympy.Expr:
    """A quotient whose denominator is 1 at rest, where it is a number there."""
    start = below.nth(0)
    if start.free_symbols or start == 0:
        return above.as_expr() / below.as_expr()
    inverse = reduced(1 / start, root)
    over = (part.as_dict().items() for part in (above, below))
    top, bottom = (sympy.Add(*(reduced(c * inverse, root) * U**power for (power,), c in part)) for part in over)
    return top / bottom


def numbers(tree: Equation, parameters: Mapping[str, Value]) -> dict[sympy.Symbol, sympy.Rational]:
    """The parameters of an equation that have values, by their symbols; raises InputError for unknown names.

    >>> from ridgeback.symbolic.grammar.parse import parse_equation
    >>> numbers(parse_equation("u'' + b*u = 0"), {"b": "0.5"})
    {b: 1/2}
    """
    values = merged("equation", dict.fromkeys(names(tree.left)), parameters)
    return {sympy.Symbol(name, real=True): value for name, value in values.items() if value is not None}


def _real_roots(polynomial: sympy.Expr) -> list[tuple[sympy.Poly, sympy.Expr]]:
    """The real roots with the factors over the rationals that they belong to."""
    _, factors = sympy.factor_list(sympy.Poly(polynomial, U))
    return [(factor, root) for factor, _ in factors for root in sympy.real_roots(factor)]


def _last_place(about: str) -> sympy.Rational:
    """A unit of the last decimal place that a number is written with; a number without a point is exact.

    >>> _last_place("0.1127"), _last_place("2")
    (1/10000, 0)
    """
    _, point, decimals = about.partition(".")
    return sympy.Rational(1, 10 ** len(decimals)) if point else sympy.Integer(0)


def _closed(factor: sympy.Poly, root: sympy.Expr) -> sympy.Expr | None:
    """A root in closed form: of a polynomial of degree 1 or 2, or of a u^n + b."""
    n = factor.degree()
    if n <= 2:
        return sympy.nsimplify(root) if root.is_Rational else sympy.radsimp(sympy.expand(root))
    if set(factor.as_dict()) != {(n,), (0,)}:
        return None
    size = sympy.root(sympy.Abs(factor.nth(0) / factor.nth(n)), n)
    return size if root.evalf() > 0 else -size
