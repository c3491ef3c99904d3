"""Parameters that change slowly with time: laws p(t) in place of numbers p, such as ``L = 1 + t/100``.

The oscillator u'' + f(u, u'; p(t)) = 0 keeps its rest at u = 0.  Its action J = (1/2 pi) times the loop integral of
u' du over the orbit of the frozen parameters is an adiabatic invariant: it stays, up to an oscillation of the order of
the rate, while p changes by as much as it will (V. I. Arnold, Mathematical Methods of Classical Mechanics, 1989, 52).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.parse import U, parse_expression, to_sympy
from ridgeback.symbolic.systems.losses import by_reciprocals
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.parameters import symbol_of, unknown_parameter
from ridgeback.symbolic.systems.sides import is_kinked

CLOCK: Final = "t"
T: Final = sympy.Symbol("t*", real=True)
"""Time, as no parameter can be called."""


@dataclass(frozen=True)
class Drifting:
    """An oscillator some of whose parameters are functions of time.

    Parameters
    ----------
    start : Oscillator
        The oscillator at time 0.
    laws : mapping of str to sympy.Expr
        Each drifting parameter in ``T``.
    force : sympy.Expr
        f(U, V) with the laws inserted.
    stiffness : sympy.Expr
        k^2 = f_u(0, 0) in ``T``.
    potential : sympy.Expr, optional
        P(U) in ``T``, where the force at rest of the others has one.
    """

    start: Oscillator
    laws: Mapping[str, sympy.Expr]
    force: sympy.Expr
    stiffness: sympy.Expr
    potential: sympy.Expr | None

    @property
    def text(self) -> str:
        """The laws as they read.

        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> drifting(find("duffing"), {"eps": "0.1 + t/100"}).text
        'eps = t/100 + 1/10'
        """
        return ", ".join(f"{name} = {law.xreplace({T: sympy.Symbol(CLOCK)})}" for name, law in self.laws.items())


def drifting(oscillator: Oscillator, laws: Mapping[str, str]) -> Drifting:
    """Put laws in time in place of parameters.

    Parameters
    ----------
    oscillator : Oscillator
        Its other parameters have numbers.
    laws : mapping of str to str
        For each parameter an expression in ``t``, in the oscillator's time unit: ``{"L": "1+0.01*t"}``.

    Returns
    -------
    Drifting
        The oscillator with them.

    Raises
    ------
    InputError
        For a name that is no parameter, a law that cannot be read, holds other names or no ``t``, or has no rational
        value at time 0, and for a force with kinks.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.oscillator import Oscillator
    >>> own = drifting(Oscillator.from_equation("x'' + g/L*sin(x) = 0", parameters={"g": 4}), {"L": "1 + t/100"})
    >>> own.stiffness, own.start.parameters["L"]
    (4/(t*/100 + 1), 1)
    """
    if not laws:
        raise InputError("no parameter drifts; give one a law, such as L=1+0.01*t")
    read = _named(oscillator, {name: _law(name, text) for name, text in laws.items()})
    start = _started(oscillator, read)
    if is_kinked(start.force):
        raise InputError(f"{start.name}: a force with kinks (abs, sign, broken powers) is not followed along a drift")
    if not start.is_linear_at_rest:
        raise InputError(
            f"{start.name}: without a linear force there is no natural frequency whose drift could be slow"
        )
    free = start.with_parameters(dict.fromkeys(read))
    inserted = {symbol_of(name): law for name, law in read.items()}
    potential = free.substituted_potential
    return Drifting(
        start=start,
        laws=read,
        force=free.substituted_force.xreplace(inserted),
        stiffness=free.stiffness.xreplace(inserted),
        potential=None if potential is None or start.small is not None else potential.xreplace(inserted),
    )


def _named(oscillator: Oscillator, laws: Mapping[str, sympy.Expr]) -> dict[str, sympy.Expr]:
    """The laws by the oscillator's own names; a parameter that it holds by its reciprocal gets that of the law."""
    turned = by_reciprocals(laws, oscillator.parameters)
    named = {turned.get(name, name): 1 / law if name in turned else law for name, law in laws.items()}
    for name in named:
        if name not in oscillator.parameters:
            raise InputError(unknown_parameter(oscillator.name, name, oscillator.parameters))
    return named


def _started(oscillator: Oscillator, laws: Mapping[str, sympy.Expr]) -> Oscillator:
    """The oscillator with the values at time 0."""
    values = {name: _at_start(name, law) for name, law in laws.items()}
    try:
        return oscillator.with_parameters(values)
    except InputError as error:
        said = ", ".join(f"{name} = {value}" for name, value in values.items())
        raise InputError(f"drift: at t = 0, where {said}: {error}") from None


def _law(name: str, text: str) -> sympy.Expr:
    """The law of one parameter in ``T``."""
    try:
        tree = parse_expression(text, unknown=CLOCK)
    except InputError as error:
        raise InputError(f"drift of {name}: {error}") from None
    try:
        law = to_sympy(tree)
    except InputError:
        raise InputError(
            f"drift of {name}: {text[:60]} has no power series at t = 0, where the motion starts; write one that has, "
            "such as 1+0.01*t"
        ) from None
    others = sorted(str(each) for each in law.free_symbols - {U})
    if others:
        raise InputError(f"drift of {name}: {others[0]} is not known there; write it in t and numbers, as in 1+0.01*t")
    if not law.has(U):
        raise InputError(f"drift of {name}: {text[:60]} does not change with t; give it by --set {name}={text[:60]}")
    return law.xreplace({U: T})


def _at_start(name: str, law: sympy.Expr) -> sympy.Rational:
    """The value at time 0."""
    value = law.subs(T, 0)
    if not value.is_Rational:
        why = f"is irrational ({value}); write it as a decimal" if value.is_finite else "is not finite"
        raise InputError(f"drift of {name}: its value at t = 0 {why}")
    return value
