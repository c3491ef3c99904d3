r"""Which parameters of an oscillator are small, of what weight, and the equation in natural units that goes with it.

Small by default is every parameter all of whose terms are odd in u' and not all odd in u (linear damping under any
name, cubic damping, the eps of van der Pol's equation; not the b of b*u*u', which takes as much as it gives), unless it
only ever multiplies another one of them (the b of eps*(1 - b*u^2)*u'), and the expansion parameter of a limit cycle.
Weights given by name override this: a weight above 0 makes any parameter small, the weight 0 makes it a coefficient
like the others, symbolic or with its value.

Units: time is tau = k t, so that u' = k du/dtau.  A parameter m whose lowest term holds u'^q is measured in k^(2 - q):
mu = k mu^ for linear damping, c3 = c3^ / k for cubic damping, alpha = k^2 alpha^ for stiffness.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.natural_units import in_natural_units
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.parameters import symbol_of
from ridgeback.symbolic.systems.structure import dissipative_names, divided, free_names, positive_root, without_sizes

ROOT: Final = "k*"
INVERSE: Final = "1/k*"
"""Stand for k and 1/k where they do not scale out: an irrational k (known by its square) as in u'' + 2*u + u'**3, a
symbolic one as in u'' + k**2*u + u**3.  No parameter can have these names."""
UNITS: Final = {ROOT: -1, INVERSE: 1}
"""The power of k in the unit of each: the same bookkeeping as for parameters puts k back."""
HIGHEST_POWER: Final = 8
"""Powers of u' beyond this one are not looked for when a unit is chosen; any unit is right, some need a root of k^2."""


@dataclass(frozen=True)
class Ordered:
    """An oscillator in natural units with its small parameters: u'' + force = 0, ' = d/dtau."""

    force: sympy.Expr
    """f(u, k u')/k^2 in the hatted parameters; the small ones and those without a value are symbols."""
    scale: sympy.Expr
    """k, the natural frequency when every small parameter vanishes."""
    weights: Mapping[str, int]
    """Weight of each small parameter against the amplitude, in the order of the variables."""
    dimensions: Mapping[str, int]
    """The power of k in the unit of each parameter left symbolic, the small ones first."""
    constants: Mapping[str, sympy.Expr]
    """Values of the symbols that stand for what is not polynomial in the parameters; see ``systems.natural_units``."""

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters left symbolic, the small ones first."""
        return tuple(self.dimensions)


def ordered(oscillator: Oscillator, *, weight: int = 2, weights: Mapping[str, int] | None = None) -> Ordered:
    """Choose the small parameters and measure everything in natural units.

    ``weight`` is that of the parameters small by default, ``weights`` overrides it by name.  Raises InputError for a
    weight that is no whole number, an unknown name, and damping or excitation that no small parameter carries.

    >>> own = Oscillator.from_equation("u'' + c*u' + d*u'**3 + 4*u + g*u**3")
    >>> found = ordered(own, weights={"d": 1})
    >>> found.force, dict(found.weights), dict(found.dimensions)
    (c*u' + d*u'**3 + g*u**3 + u, {'c': 2, 'd': 1}, {'c': 1, 'd': -1, 'g': 2})
    """
    chosen = _weights(oscillator, check_weight(weight), dict(weights or {}))
    values = {symbol_of(n): v for n, v in oscillator.parameters.items() if v is not None and n not in chosen}
    force = oscillator.force.subs(values)
    scale = _natural_frequency(force, oscillator, chosen)
    symbolic = [n for n in free_names(force) if n not in chosen and not scale.has(symbol_of(n))]
    dimensions = {name: _dimension(force, symbol_of(name)) for name in (*chosen, *symbolic)}
    natural = _scaled(force, scale, dimensions)
    constants: dict[str, sympy.Expr] = {}
    if not _scales_out(natural, scale):
        dimensions = {name: dimensions[name] for name in chosen}
        natural, constants = _named(force, scale, dimensions)
        dimensions |= dict.fromkeys((n for n in free_names(natural) if n not in {*chosen, *UNITS}), 0)
    _check(natural, oscillator, tuple(chosen))
    dimensions.update({name: power for name, power in UNITS.items() if natural.has(symbol_of(name))})
    return Ordered(force=natural, scale=scale, weights=chosen, dimensions=dimensions, constants=constants)


def small_parameters(oscillator: Oscillator) -> tuple[str, ...]:
    """Return the parameters that are small by default, in the order of the equation.

    Parameters
    ----------
    oscillator : Oscillator
        Any oscillator.

    Returns
    -------
    tuple of str
        Their names.

    Examples
    --------
    >>> small_parameters(Oscillator.from_equation("x'' - eps*(1 - b*x**2)*x' + x + g*x**3"))
    ('eps',)
    """
    force = oscillator.force
    lossy = dissipative_names(force)
    odd = [name for name in oscillator.parameters if name in lossy]
    known = [name for name in (oscillator.small, oscillator.damping) if name and name not in odd]
    kept = [name for name in odd if not any(_within(force, name, other, odd) for other in odd if other != name)]
    small = {*kept, *known, *_carrying(force, oscillator, {*odd, *known})}
    return tuple(name for name in oscillator.parameters if name in small)


def _carrying(force: sympy.Expr, oscillator: Oscillator, small: set[str]) -> list[str]:
    """Parameters that the rest of the linear damping vanishes with, and the stiffness not: that of eps*(u' + u**3)."""
    left = force.subs({symbol_of(name): 0 for name in small})
    damping, stiffness = (sympy.expand(left.diff(s).subs({U: 0, V: 0})) for s in (V, U))
    if damping == 0:
        return []
    carriers = [name for name in oscillator.parameters if damping.subs(symbol_of(name), 0) == 0]
    return [name for name in carriers if stiffness.subs(symbol_of(name), 0) != 0]


def check_weight(weight: object, name: str = "") -> int:
    """Return a weight of a small parameter, above 0; of a named one also 0, for a coefficient that is not small.

    Raises InputError for anything else.

    >>> check_weight(2)
    2
    """
    lowest = 0 if name else 1
    if isinstance(weight, bool) or not isinstance(weight, int) or weight < lowest:
        whose = f" of {name}" if name else ""
        raise InputError(
            f"weight {weight!r}{whose} is not a whole number from {lowest} on; use 2 to count a parameter like the "
            "amplitude squared" + (", 0 for one that is not small" if name else "")
        )
    return weight


def check_both(oscillator: Oscillator, weight: int | None, weights: Mapping[str, int] | None) -> None:
    """Raise InputError where weights by name leave no parameter that the weight of all others could be of.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> check_both(find("damped-pendulum"), 3, {"mu": 2})
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: weight 3 is left without a parameter: weights names mu; leave one of them out
    """
    small = small_parameters(oscillator)
    if weight is not None and weights and set(small) <= set(weights):
        raise InputError(
            f"weight {weight} is left without a parameter: weights names {', '.join(weights)}; leave one of them out"
        )


def _weights(oscillator: Oscillator, weight: int, given: dict[str, int]) -> dict[str, int]:
    for name, value in given.items():
        check_weight(value, name)
        if name not in oscillator.parameters:
            known = ", ".join(oscillator.parameters) or "none"
            raise InputError(f"{oscillator.name} has no parameter {name[:60]!r} to weigh; its parameters: {known}")
    merged = {**dict.fromkeys(small_parameters(oscillator), weight), **given}
    return {name: merged[name] for name in oscillator.parameters if merged.get(name, 0)}


def _within(force: sympy.Expr, name: str, other: str, order: list[str]) -> bool:
    """Whether the parameter occurs only in terms with the other one (of two that always go together, the later)."""
    inside = not force.subs(symbol_of(other), 0).has(symbol_of(name))
    outside = not force.subs(symbol_of(name), 0).has(symbol_of(other))
    return inside and (not outside or order.index(other) < order.index(name))


def _natural_frequency(force: sympy.Expr, oscillator: Oscillator, small: Mapping[str, int]) -> sympy.Expr:
    slope = force.diff(U).subs({symbol_of(name): 0 for name in small}).subs({U: 0, V: 0})
    stiffness = without_sizes(sympy.expand(slope))
    if stiffness.is_nonpositive or stiffness.has(sympy.zoo, sympy.nan):
        raise InputError(
            f"{oscillator.name} has no positive linear restoring force when {', '.join(small)} vanish; a small "
            "parameter may not carry it: give weight 0 to the one that does"
        )
    return positive_root(stiffness)


def _dimension(force: sympy.Expr, symbol: sympy.Symbol) -> int:
    """2 - q, with u'^q the lowest power of u' in the terms of a parameter."""
    term = force.diff(symbol)
    for power in range(HIGHEST_POWER + 1):
        if sympy.expand(term.subs(V, 0)) != 0:
            return 2 - power
        term = term.diff(V)
    return 2


def _scaled(force: sympy.Expr, scale: sympy.Expr, dimensions: Mapping[str, int]) -> sympy.Expr:
    """f(u, k u')/k^2 with parameters in units of k; the powers of k that stay are powers of ROOT and INVERSE."""
    irrational = scale.is_number and not scale.is_Rational
    k = symbol_of(ROOT) if irrational else scale
    units = {symbol_of(name): k**power * symbol_of(name) for name, power in dimensions.items() if power}
    natural = divided(force.subs({V: k * V, **units}), k**2)
    if irrational:
        square = sympy.expand(scale**2)
        return _with_powers(natural, k, lambda n: square ** (n // 2) * k ** (n % 2))
    if not scale.is_Symbol:
        return natural
    return _with_powers(natural, k, lambda n: symbol_of(ROOT) ** n if n > 0 else symbol_of(INVERSE) ** -n)


def _scales_out(natural: sympy.Expr, scale: sympy.Expr) -> bool:
    """Whether no root, denominator or irrational number is left, and not both k and 1/k, which no ring would cancel."""
    free = natural.free_symbols
    both = {symbol_of(name) for name in UNITS} <= free
    return not (scale.free_symbols & free) and not both and not in_natural_units(natural, sympy.S.One, free).values


def _named(
    force: sympy.Expr, scale: sympy.Expr, dimensions: Mapping[str, int]
) -> tuple[sympy.Expr, dict[str, sympy.Expr]]:
    """The same with names for all that is not polynomial; k by its square, but for one power of it."""
    k, square = symbol_of(ROOT), sympy.expand(scale**2)
    units = {symbol_of(name): k**power * symbol_of(name) for name, power in dimensions.items() if power}
    turned = _with_powers(
        sympy.expand_mul(force.subs({V: k * V, **units})), k, lambda n: square ** (n // 2) * k ** (n % 2)
    )
    found = in_natural_units(turned, square, [symbol_of(name) for name in dimensions])
    return found.force, dict(found.values)


def _with_powers(expression: sympy.Expr, k: sympy.Symbol, power: Callable[[sympy.Integer], sympy.Expr]) -> sympy.Expr:
    """Replace every whole power of k."""
    marked = expression.replace(lambda e: e.is_Pow and e.base == k and e.exp.is_Integer, lambda e: power(e.exp))
    return marked if power(sympy.S.One) == k else marked.subs(k, power(sympy.S.One))


def _check(force: sympy.Expr, oscillator: Oscillator, small: tuple[str, ...]) -> None:
    resting = {**{symbol_of(name): 0 for name in small}, U: 0, V: 0}
    if sympy.expand(force.diff(V).subs(resting)) != 0:
        raise InputError(
            f"{oscillator.name} has linear damping that does not vanish with a small parameter; write its coefficient "
            "as a parameter and set that, as in 2*mu*u' with mu = 1/100"
        )


def undamped(oscillator: Oscillator) -> Oscillator:
    """Return the oscillator with its damping set to zero: the one that has a backbone curve.

    Parameters
    ----------
    oscillator : Oscillator
        Any oscillator.

    Returns
    -------
    Oscillator
        Limit cycles, and oscillators whose orbits close as they are, unchanged.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> undamped(find("damped-pendulum")).is_conservative
    True
    """
    if oscillator.kind != "damped":
        return oscillator
    return oscillator.with_parameters(dict.fromkeys(small_parameters(oscillator), 0))
