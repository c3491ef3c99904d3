"""The structure of a force: what multiplies u'', which parameter damps it, which one excites it."""

from __future__ import annotations

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.at_origin import brief
from ridgeback.symbolic.grammar.kinks import KINKS
from ridgeback.symbolic.grammar.parse import U, V, W


def positive_root(square: sympy.Expr) -> sympy.Expr:
    """Return the square root, with symbolic parameters taken as positive: sqrt(k**2) is k.

    Parameters
    ----------
    square : sympy.Expr
        Its square.

    Returns
    -------
    sympy.Expr
        The root.

    Examples
    --------
    >>> positive_root(sympy.Symbol("k", real=True) ** 2)
    k
    """
    return without_sizes(sympy.sqrt(square))


def without_sizes(expression: sympy.Expr) -> sympy.Expr:
    """The expression with symbolic parameters taken as positive, so that the root of a square is the parameter itself.

    >>> without_sizes(sympy.sqrt(sympy.Symbol("l", real=True) ** 2) * abs(U))
    l*Abs(u)
    """
    return expression.replace(lambda e: isinstance(e, sympy.Abs) and not e.has(U, V), lambda e: e.args[0])


def solved_for_acceleration(left: sympy.Expr) -> sympy.Expr:
    """f of u'' + f = 0 from left = 0, dividing by the factor of u'' exactly.

    Raises InputError when u'' cancels, does not enter linearly or has a factor that vanishes at rest.

    >>> solved_for_acceleration(2 * W + 4 * U)
    2*u
    """
    factor = left.diff(W)
    if factor.has(W):
        left = sympy.expand(left)
        factor = left.diff(W)
    if factor == 0:
        raise InputError("the second derivative cancels out of the equation; an oscillator needs it")
    if factor.has(W):
        raise InputError(f"u'' enters through {brief(left)}; it must enter linearly, as in (1 + u**2)*u'' + u = 0")
    if factor.subs({U: 0, V: 0}) == 0:
        raise InputError(
            f"the factor {brief(factor)} of u'' vanishes at rest; there is no oscillation about the origin"
        )
    rest = left.subs(W, 0)
    return rest if factor == 1 else divided(rest, factor)


def divided(expression: sympy.Expr, divisor: sympy.Expr) -> sympy.Expr:
    """Divide term by term, so that common factors cancel without a simplifier.

    >>> divided(2 * U + 4 * V, sympy.Integer(2))
    u + 2*u'
    """
    if divisor == 1:
        return expression
    return sympy.Add(*(term / divisor for term in sympy.Add.make_args(sympy.expand_mul(expression))))


def slope_at_rest(force: sympy.Expr, unknown: sympy.Symbol) -> sympy.Expr:
    """The coefficient of the linear term in u or u'; terms with a kink, such as sign(u'), have none.

    >>> slope_at_rest(3 * V + sympy.sign(V) + U, V)
    3
    """
    smooth = without_kinks(force) if force.has(*KINKS) else force
    return sympy.expand(smooth.diff(unknown).subs({U: 0, V: 0}))


def without_kinks(force: sympy.Expr) -> sympy.Expr:
    """The terms of an expanded force in which neither abs nor sign of u or u' stands.

    >>> without_kinks(U * (1 + abs(U)))
    u
    """
    return sympy.Add(*(term for term in sympy.Add.make_args(sympy.expand(force)) if not term.has(*KINKS)))


def damping_name(force: sympy.Expr) -> str | None:
    """The parameter p when the force is 2*p*u' plus terms without p, else None.

    >>> damping_name(2 * sympy.Symbol("c", real=True) * V + U)
    'c'
    """
    slope = slope_at_rest(force, V)
    symbol = slope / 2
    if not isinstance(symbol, sympy.Symbol) or sympy.expand(force - slope * V).has(symbol):
        return None
    return str(symbol.name)


def small_name(force: sympy.Expr) -> str | None:
    """The parameter p when the force is g(u) + p*h(u, u') with h_u(0, 0) = 0 and h_u'(0, 0) < 0, else None.

    Such a p > 0 feeds energy in near rest, as the eps of van der Pol's and Rayleigh's equations does.

    >>> small_name(U - sympy.Symbol("eps", real=True) * (1 - U**2) * V)
    'eps'
    """
    slope, stiffness = (slope_at_rest(force, unknown) for unknown in (V, U))
    for symbol in sorted(slope.free_symbols, key=lambda s: str(s.name)):
        rate = sympy.expand(slope / symbol)
        linear = not force.diff(symbol).has(symbol) and not stiffness.has(symbol)
        if linear and rate.is_negative and not force.subs(symbol, 0).has(V):
            return str(symbol.name)
    return None


def dissipative_names(force: sympy.Expr) -> tuple[str, ...]:
    """Return the parameters that vanish with all of their terms, which are odd in u' and not all odd in u, sorted.

    Terms odd in u', such as damping, spoil the reversal of time, unless they are odd in u as well: u u' takes as much
    on one side of u = 0 as it gives on the other.

    Parameters
    ----------
    force : sympy.Expr
        In ``U``, ``V`` and parameters.

    Returns
    -------
    tuple of str
        The names.

    Examples
    --------
    >>> c, b = (sympy.Symbol(name, real=True) for name in "cb")
    >>> dissipative_names(c * V**3 + b * U * V + U)
    ('c',)
    """
    return tuple(name for name in free_names(force) if _dissipates(force, sympy.Symbol(name, real=True)))


def _dissipates(force: sympy.Expr, symbol: sympy.Symbol) -> bool:
    change = force.diff(symbol)
    odd_in_u = sympy.expand(change + change.subs(U, -U)) == 0
    if change == 0 or odd_in_u or sympy.expand(change + change.subs(V, -V)) != 0:
        return False
    return not force.subs(symbol, 0).has(sympy.zoo, sympy.nan, sympy.oo)


def free_names(force: sympy.Expr) -> tuple[str, ...]:
    """Return the names of the parameters in a force, sorted; u and u' are not among them.

    Parameters
    ----------
    force : sympy.Expr
        In ``U``, ``V`` and parameters.

    Returns
    -------
    tuple of str
        The names.

    Examples
    --------
    >>> free_names(U + sympy.Symbol("alpha3", real=True) * U**3)
    ('alpha3',)
    """
    return tuple(sorted(symbol.name for symbol in force.free_symbols - {U, V}))


def rewritten(force: sympy.Expr, unknown: str) -> str:
    """The equation that a force belongs to, as text.

    >>> rewritten(4 * U + V / 2, "x")
    "x'' + x'/2 + 4*x = 0"
    >>> rewritten(U * abs(U), "x")  # in the words of the grammar
    "x'' + x*abs(x) = 0"
    """
    turned = force.xreplace({U: sympy.Symbol(unknown, real=True), V: sympy.Symbol(unknown + "'", real=True)})
    return f"{unknown}'' + {sympy.sstr(turned, order='rev-lex')} = 0".replace("+ -", "- ").replace("Abs(", "abs(")
