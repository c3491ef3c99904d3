"""The oscillator u'' + f(u, u') = 0: one frozen value, validated when it is made.

Symbols: ``U`` is the unknown, ``V`` its first and ``W`` its second time derivative, whatever the unknown is called in
the text; each parameter is one real symbol of its own name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal, TypeAlias

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.at_origin import brief, sign_at_origin, value_at_origin
from ridgeback.symbolic.grammar.parse import Equation, U, V, W, names, parse_equation, to_sympy
from ridgeback.symbolic.systems import sides
from ridgeback.symbolic.systems.equation_latex import equation_latex
from ridgeback.symbolic.systems.losses import by_reciprocals, with_named_losses
from ridgeback.symbolic.systems.natural_units import Normalised, in_natural_units
from ridgeback.symbolic.systems.parameters import Parameters, Value, merged, reciprocal, symbol_of
from ridgeback.symbolic.systems.potential import force_potential, potential_of
from ridgeback.symbolic.systems.sides import Half
from ridgeback.symbolic.systems.structure import (
    damping_name,
    divided,
    positive_root,
    rewritten,
    slope_at_rest,
    small_name,
    solved_for_acceleration,
    without_sizes,
)

__all__ = ["Kind", "Oscillator", "U", "V", "Value", "W"]

Kind: TypeAlias = Literal["conservative", "reversible", "damped", "limit-cycle"]
"""``reversible``: orbits close by a symmetry under (u, t) -> (-u, -t), without an energy."""


@dataclass(frozen=True, repr=False)
class Oscillator:
    """A named equation of motion with exact parameters.

    Made by :func:`ridgeback.oscillator`, :meth:`from_equation` or the catalogue.

    Parameters
    ----------
    name, title : str
        What it is called in files and on pages.
    equation : str
        The equation of motion as text.
    force : sympy.Expr
        f(U, V, parameters) of u'' + f = 0, with V = u'.
    parameters : mapping of str to rational or None
        The exact value of each parameter; None for one that stays symbolic.
    defaults : mapping of str to rational or None
        What the catalogue gave.
    potential : sympy.Expr, optional
        P(U), P(0) = 0, of the restoring force f(u, 0); None for limit cycles, for forces with conservative terms in
        u', and where no rule integrates it.
    potential_note : str
        Why there is no potential.
    small : str, optional
        The expansion parameter of a limit cycle.
    damping : str, optional
        The mu of a linear damping term 2*mu*u'.
    symbol : str
        The unknown in LaTeX.
    unit : str
        The unit of u, such as ``"rad"``; may be empty.
    reference, description : str
        Where it is from, and what it is.
    initial : (float, float)
        State (u, u') at time 0, in the unit of u and that per time unit.
    aliases : tuple of str
        Other names in the catalogue.

    Raises
    ------
    InputError
        When the origin is not an equilibrium with a restoring force, or f is not analytic on each side of it.

    Examples
    --------
    >>> Oscillator.from_equation("x'' + 4*x + x**3", name="mine").natural_frequency
    2
    """

    name: str
    title: str
    equation: str
    force: sympy.Expr
    parameters: Parameters = field(hash=False)
    defaults: Parameters = field(hash=False)
    potential: sympy.Expr | None = None
    potential_note: str = ""
    small: str | None = None
    damping: str | None = None
    symbol: str = "u"
    unit: str = ""
    reference: str = ""
    description: str = ""
    initial: tuple[float, float] = (1.0, 0.0)
    aliases: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("parameters", "defaults"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))
        self.check_at_origin()

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {value}" for name, value in self.parameters.items() if value is not None)
        return f"<Oscillator: {self.name}, {self.equation}{f' ({values})' if values else ''}>"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.equation_latex}$"

    def __reduce__(self) -> tuple[Callable[..., Oscillator], tuple[type[Oscillator], dict[str, Any]]]:
        """Pickle by value (a mapping proxy cannot be), so that work can be sent to other processes."""
        values = {item.name: getattr(self, item.name) for item in fields(self)}
        return _rebuilt, (type(self), {**values, "parameters": dict(self.parameters), "defaults": dict(self.defaults)})

    @classmethod
    def from_equation(
        cls,
        text: str,
        *,
        name: str = "equation",
        parameters: Mapping[str, Value] | None = None,
        potential: str | None = None,
        **about: Any,
    ) -> Oscillator:
        """Read u'' + ... = 0 from text; parameters that are given no value stay symbolic.

        Parameters
        ----------
        text : str
            The equation.  The second derivative may carry a factor, which is divided out; ``mu`` of a term 2*mu*u' and
            the ``eps`` of a limit cycle are recognised under any name.  A
            linear loss written as a number, or through a reciprocal, gets a parameter (see ``losses``), and the
            equation is then rewritten with it.
        name : str, optional
            What to call it.
        parameters : mapping of str to number or str, optional
            Values by name, exact as they are written.
        potential : str, optional
            P(u), checked by differentiation; without it, it is integrated by rule when the force allows.
        **about
            Title, reference, description, initial, symbol, unit and aliases.

        Returns
        -------
        Oscillator
            The oscillator.

        Raises
        ------
        InputError
            For what cannot be read or has no oscillation about the origin.

        Examples
        --------
        >>> own = Oscillator.from_equation("2*x'' + 2*c*x' + 8*sin(x) = 0", parameters={"c": "0.1"})
        >>> own.force, own.damping, own.potential
        (c*u' + 4*sin(u), None, 4 - 4*cos(u))
        """
        return cls.from_tree(parse_equation(text), name=name, parameters=parameters, potential=potential, **about)

    @classmethod
    def from_tree(
        cls,
        equation: Equation,
        *,
        name: str = "equation",
        parameters: Mapping[str, Value] | None = None,
        potential: str | None = None,
        **about: Any,
    ) -> Oscillator:
        """Make an oscillator of an equation that has been read already; see ``from_equation``."""
        values = merged(name, dict.fromkeys(names(equation.left)), parameters or {})
        left = to_sympy(equation.left)
        value_at_origin(left, values)  # before SymPy is asked for any value there, which it may never finish
        lossy = with_named_losses(solved_for_acceleration(left), values)
        force = lossy.force
        integral, note = force_potential(force, potential, equation.unknown)
        about.setdefault("title", name)
        about.setdefault("symbol", sympy.latex(sympy.Symbol(equation.unknown)))
        return cls(
            name=name,
            equation=equation.text if lossy.parameters == values else rewritten(force, equation.unknown),
            force=force,
            parameters=lossy.parameters,
            defaults=lossy.parameters,
            potential=integral,
            potential_note=note,
            small=small_name(force),
            damping=damping_name(force),
            **about,
        )

    def with_parameters(self, values: Mapping[str, Value]) -> Oscillator:
        """Return the same oscillator with other parameter values.

        Parameters
        ----------
        values : mapping of str to number, str or None
            Text and floats become the decimal rational that they print as ("0.1" and 0.1 are 1/10); None leaves the
            parameter symbolic.

        Returns
        -------
        Oscillator
            A new one; this one is unchanged.

        Raises
        ------
        InputError
            For unknown names, for values that are not finite numbers, and when the origin stops being a centre.

        Examples
        --------
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> find("pendulum").with_parameters({"k": "12.5", "mu": 0.01}).parameters["mu"]
        1/100
        """
        turned = by_reciprocals(values, self.parameters)
        direct = merged(self.name, dict.fromkeys(turned), {name: values[name] for name in turned})
        inverted = {turned[name]: None if value is None else reciprocal(name, value) for name, value in direct.items()}
        rest = {name: value for name, value in values.items() if name not in turned}
        return replace(self, parameters=merged(self.name, self.parameters, {**rest, **inverted}))

    @cached_property
    def substituted_force(self) -> sympy.Expr:
        """The force with every parameter that has a value inserted."""
        return self._inserted(self.force)

    @cached_property
    def substituted_potential(self) -> sympy.Expr | None:
        """The potential, values inserted; integrated where these leave no u' at all, or tell the order of stops."""
        if self.stops and not self.potential_note:
            return potential_of(sides.without_velocity(self.substituted_force))
        if self.potential is None:
            force = self.substituted_force
            return None if force.has(V) else potential_of(force)
        return self._inserted(self.potential)

    @cached_property
    def is_conservative(self) -> bool:
        """Whether the force is even in u', so that motion is reversible and every orbit near the origin closes."""
        force = self.substituted_force
        return bool(sympy.expand(force - force.subs(V, -V)) == 0)

    @cached_property
    def is_reversible(self) -> bool:
        """Whether the force is odd in u at fixed u', so that (u, t) -> (-u, -t) maps motions to motions.

        An orbit that crosses u = 0 twice is its own image then and closes, as of u'' + u u' + u = 0 (R. L. Devaney,
        Reversible diffeomorphisms and flows, Transactions of the AMS 218 (1976) 89-113).
        """
        force = self.substituted_force
        return bool(sympy.expand(force + force.subs(U, -U)) == 0)

    @property
    def closes(self) -> bool:
        """Whether a symmetry closes every orbit near the origin, so that there is a frequency for each amplitude."""
        return self.is_conservative or self.is_reversible

    @property
    def kind(self) -> Kind:
        """``limit-cycle`` when there is an expansion parameter or negative linear damping, else by the force."""
        if self.small is not None:
            return "limit-cycle"
        if self.closes:
            return "conservative" if self.is_conservative else "reversible"
        slope = sign_at_origin(slope_at_rest(self._near_rest, V), self.parameters)
        return "limit-cycle" if slope is not None and slope < 0 else "damped"

    @cached_property
    def stiffness(self) -> sympy.Expr:
        """The linear restoring coefficient f_u(0, 0) = k**2, parameters inserted; see ``natural_frequency``."""
        if self.is_kinked:
            return sympy.expand(self.natural_frequency**2)
        return without_sizes(sympy.expand(self._inserted(self._near_rest.diff(U)).subs({U: 0, V: 0})))

    @cached_property
    def _near_rest(self) -> sympy.Expr:
        """The force within its stops; the force itself where it has none."""
        return sides.on_stretch(self.substituted_force, sympy.S.Zero) if self.stops else self.force

    @cached_property
    def is_kinked(self) -> bool:
        """Whether the force has a kink at u = 0: abs, sign or a broken power of u."""
        return sides.kinked_at_rest(self.substituted_force)

    @cached_property
    def stops(self) -> tuple[sympy.Expr, ...]:
        """Where the force has kinks away from rest, such as abs(u - 1); rising where these are numbers."""
        return sides.stops_of(self.substituted_force)

    @cached_property
    def is_linear_at_rest(self) -> bool:
        """Whether the force begins linearly in u on both sides of rest, so that there is a natural frequency."""
        if self.is_kinked:
            return all(found.exponent == 1 for found in self.halves)
        return bool(self.stiffness != 0)

    @property
    def has_rough_losses(self) -> bool:
        """Whether energy is lost or gained beside a kink, in u or u', so that averaging is what there is."""
        return sides.is_kinked(self.substituted_force) and not self.is_conservative

    @property
    def by_sides(self) -> bool:
        """Whether each side of rest has a motion of its own: the force has a kink there or no linear part."""
        return self.is_kinked or not self.is_linear_at_rest

    @cached_property
    def halves(self) -> tuple[Half, Half]:
        """The restoring force f(u, 0) on each side of rest up to its first stop, u > 0 first, parameters inserted."""
        return sides.restoring_halves(self.name, sides.without_velocity(self.substituted_force))

    @cached_property
    def natural_frequency(self) -> sympy.Expr:
        """k, the positive root of the stiffness, exact; a symbolic parameter under the root is taken as positive.

        With another stiffness on each side, half a cycle takes pi/k1 and half pi/k2: k = 2 k1 k2 / (k1 + k2).
        """
        if not self.is_linear_at_rest:
            raise sides.no_linear_force(self.name)
        if not self.is_kinked:
            return positive_root(self.stiffness)
        return sides.harmonic_mean(*(positive_root(side.coefficient) for side in self.halves))

    @cached_property
    def linear_damping(self) -> sympy.Expr:
        """Half of f_u'(0, 0), parameters inserted: the mu of the linearised equation, whatever it is called."""
        return sympy.expand(self._inserted(slope_at_rest(self._near_rest, V)) / 2)

    @property
    def equation_latex(self) -> str:
        """The equation in LaTeX: acceleration, damping, restoring; terms with a parameter of value 0 are left out."""
        zero = {symbol_of(name): 0 for name, value in self.parameters.items() if value == 0}
        return equation_latex(self.force.subs(zero), self.symbol)

    def check_at_origin(self) -> None:
        """Raise InputError unless u = 0 is an equilibrium with a restoring force, f analytic on each side of it."""
        value_at_origin(self.force, self.parameters)
        sides.require_rest(self.name, sympy.expand(self._inserted(self._near_rest).subs({U: 0, V: 0})))
        if self.by_sides:
            _ = self.halves
            return
        sign = sign_at_origin(self._near_rest.diff(U), self.parameters)
        if sign == -1 or self.stiffness.is_nonpositive:
            raise InputError(
                f"{self.name}: the origin is a saddle, since the linear restoring coefficient "
                f"{brief(self.stiffness)} is negative; measure the unknown from a stable equilibrium"
            )

    @cached_property
    def normalised(self) -> Normalised:
        """The equation in natural units, k = 1, worked out once; see ``Normalised``.

        >>> own = Oscillator.from_equation("u'' + 2*mu*u' + k**2*sin(u)", parameters={"k": 4, "mu": "0.01"})
        >>> own.normalised.force, own.normalised.damping
        (2*mu*u' + sin(u), 1/400)
        """
        sides.require_no_kinks(self.name, self.substituted_force, conservative=self.is_conservative)
        k, kept = self.natural_frequency, [name for name in (self.damping, self.small) if name]
        symbols = {name: symbol_of(name) for name in kept}
        force = self._inserted(self.force, keep=kept).subs({V: k * V, **{s: k * s for s in symbols.values()}})
        values = {name: self._inserted(symbol) / k for name, symbol in symbols.items()}
        potential = self.substituted_potential
        bound = force.subs({symbols[name]: value for name, value in values.items()})
        rational = in_natural_units(bound, self.stiffness)
        return Normalised(
            force=divided(force, self.stiffness),
            bound=divided(bound, self.stiffness),
            scale=k,
            damping=values.get(self.damping or "", sympy.S.Zero),
            small=values.get(self.small or ""),
            potential=None if potential is None else divided(potential, self.stiffness),
            rational=rational.force,
            constants={n: value for n, value in sorted(rational.values.items()) if rational.force.has(symbol_of(n))},
        )

    def _inserted(self, expression: sympy.Expr, keep: list[str] | None = None) -> sympy.Expr:
        values = {
            symbol_of(name): value
            for name, value in self.parameters.items()
            if value is not None and name not in (keep or ())
        }
        return expression.subs(values)


def _rebuilt(cls: type[Oscillator], values: dict[str, Any]) -> Oscillator:
    return cls(**values)
