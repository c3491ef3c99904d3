"""The exact equilibrium that a decimal stands for."""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.nodes import names
from ridgeback.symbolic.grammar.parse import Equation, U, V, W, parse_expression, to_sympy
from ridgeback.symbolic.systems.parameters import Value, merged


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
        A rational number, the root of a quadratic, or a root of a rational number.

    Raises
    ------
    InputError
        When no equilibrium is so near, with the nearest one, or when that has no such form.

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
        raise InputError(f"{leaves}, and no polynomial in u says where it does; give the place exactly")
    given = sympy.Rational(str(to_sympy(parse_expression(about)).evalf(30)))
    found = [(abs(root.evalf(30) - given), root, factor) for factor, root in _real_roots(above)]
    if not found:
        raise InputError(f"{leaves}, and there is none")
    distance, root, factor = min(found, key=lambda each: each[0])
    if distance > _last_place(about):
        raise InputError(f"{leaves}; the nearest equilibrium is at {sympy.N(root, 12)}")
    exact = _closed(factor, root)
    if exact is None:
        raise InputError(
            f"about {about}: the equilibrium {sympy.N(root, 20)} is a root of {factor.as_expr()} and of no quadratic; "
            "only rational numbers and their roots, and roots of quadratics, can be expanded about"
        )
    return exact


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
