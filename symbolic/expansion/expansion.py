r"""The frozen result of a derivation in one variable: ``omega0`` as an exact series, and ``u`` that goes with it.

    omega0 = k * sum_n c_n X^n,      u = sum_n X^n u_n(tau),      tau = omega0 t

``X`` is the amplitude ``A`` (conservative oscillators) or ``eps/k`` (limit cycles, k the natural frequency).
The coefficients ``c_n`` are held in units where k = 1; ``frequency`` gives them in the oscillator's own units.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, Final

import sympy
from flint import arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.horner import polynomial_value
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import natural_frequency, number_ball, polynomial_at, scalar_ball
from ridgeback.symbolic.arithmetic.rendering import (
    as_sympy,
    coefficient_row,
    long_integers,
    mathml,
    nearest,
    series_latex,
)
from ridgeback.symbolic.arithmetic.roots import in_field, root_in
from ridgeback.symbolic.arithmetic.tidy import tidy
from ridgeback.symbolic.expansion.amplitude import (
    check_definition,
    check_velocity,
    counted_from_its_own,
    measured,
    same_definition,
)
from ridgeback.symbolic.expansion.shown import ShownExpansion
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.series.trigonometric import Trig, degree, harmonic

ROUNDING: Final = 32
"""Bits beyond those of a number of mpmath, with which an irrational coefficient is rounded to it."""


@dataclass(frozen=True)
class Harmonic:
    """``u`` contains ``(sum_n cosine[n] X^n) cos(multiple tau) + (sum_n sine[n] X^n) sin(multiple tau)``."""

    multiple: int
    cosine: tuple[sympy.Expr, ...]
    sine: tuple[sympy.Expr, ...]


@dataclass(frozen=True, repr=False)
class Expansion(ShownExpansion):
    """omega0 as a power series in one variable, with the amplitude definition it holds for.

    Made by ``lindstedt`` and ``energy_integral``.  ``frequency`` holds the exact coefficients in the oscillator's own
    units; a call evaluates the series; ``convert`` changes the amplitude's definition, ``truncated`` the order;
    ``harmonics`` is the waveform; ``residual`` what is left of the equation.

    Parameters
    ----------
    system, method : str
        Names of the oscillator and of the derivation.
    variable : str
        ``A`` (amplitude) or ``eps``.
    amplitude : str
        Definition of the amplitude: a key of ``ridgeback.symbolic.expansion.amplitude.MEANINGS``.
    order : int
        Highest power of the variable kept.
    scale : sympy.Expr
        The natural frequency k, in rad per time unit.
    scaled_variable : bool
        Whether the series variable is the printed variable divided by k (limit cycles).
    coefficients : tuple of Scalar
        c_0 ... c_order in units where k = 1: FLINT rationals, or polynomials in the parameters.
    waveform : tuple of Trig, optional
        u_0, u_1, ... as trigonometric polynomials, one order beyond the frequency; None if the method has none.
    amplitude_coefficients : tuple of Scalar, optional
        Limit cycles: the amplitude as a series in the variable.
    residual_of : callable, optional
        Substitutes the expansion into its equation.
    names : tuple of str
        Symbols that the coefficients hold: parameters without a value, and those of ``constants``.
    constants : mapping of str to sympy.Expr
        Values of the symbols that stand for irrational numbers and for 1/k^2; see ``natural_units.Normalised``.
    velocity : bool
        Whether the force holds u', so that two amplitude definitions do not exist.
    sided : bool
        Whether the force has a kink at rest, so that the series holds for A >= 0 only.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> pendulum = lindstedt("pendulum", 4)
    >>> pendulum.frequency, pendulum.amplitude
    ((1, 0, -1/16, 0, 1/3072), 'peak')
    >>> pendulum.residual()
    []
    """

    system: str
    method: str
    variable: str
    amplitude: str
    order: int
    scale: sympy.Expr
    scaled_variable: bool
    coefficients: tuple[Scalar, ...]
    waveform: tuple[Trig, ...] | None
    amplitude_coefficients: tuple[Scalar, ...] | None
    residual_of: Callable[[Expansion], list[int]] | None
    names: tuple[str, ...] = ()
    constants: Mapping[str, sympy.Expr] = field(default_factory=dict)
    velocity: bool = False
    sided: bool = False

    @cached_property
    def frequency(self) -> tuple[sympy.Expr, ...]:
        """Exact coefficients of variable**0 ... variable**order in the oscillator's own units."""
        return self._in_own_units(self.coefficients, rate=1)

    @cached_property
    def amplitude_series(self) -> tuple[sympy.Expr, ...] | None:
        """Exact coefficients of the amplitude of a limit cycle in powers of eps, or None."""
        if self.amplitude_coefficients is None:
            return None
        return self._in_own_units(self.amplitude_coefficients, rate=0)

    def _in_own_units(self, values: tuple[Scalar, ...], *, rate: int) -> tuple[sympy.Expr, ...]:
        """Coefficients times k to the power ``rate``, and over that of the variable's own k."""
        exact = [self.exact(c) for c in values]
        step = int(self.scaled_variable)
        if not self.constants:
            return tuple(c * self.scale ** (rate - step * n) for n, c in enumerate(exact))
        return tuple(tidy(c, self.scale, rate - step * n) for n, c in enumerate(exact))

    def exact(self, coefficient: Scalar) -> sympy.Expr:
        """A coefficient in natural units as an expression in the parameters left symbolic, k among them."""
        root = root_in(sympy.Add(*self.constants.values()))
        if root is not None and not isinstance(coefficient, fmpq | int) and set(self.names) == set(self.constants):
            terms = {powers[1:]: value for powers, value in coefficient.to_dict().items()}
            return in_field(terms, [self.constants[name] for name in self.names], root)
        value = as_sympy(coefficient, self.names)
        if not self.constants:
            return value
        return sympy.expand(value.subs({sympy.Symbol(name, real=True): c for name, c in self.constants.items()}))

    @property
    def symbolic_names(self) -> tuple[str, ...]:
        """Parameters left symbolic, by the names that the equation has for them."""
        own = {name for name in self.names if name not in self.constants}
        return tuple(sorted(own | {str(symbol) for symbol in self.scale.free_symbols}))

    @cached_property
    def harmonics(self) -> tuple[Harmonic, ...]:
        """Fourier coefficients of u itself (mean offset first), those that vanish left out.

        Raises InputError for a method that has no waveform.
        """
        if self.waveform is None:
            raise InputError(f"{self.method} gives the frequency only; use lindstedt for the harmonics of u")
        top = max(degree(p) for p in self.waveform)
        found = []
        for multiple in range(top + 1):
            pairs = [harmonic(p, multiple) for p in self.waveform]
            if any(p != 0 or q != 0 for p, q in pairs):
                cosine = self._in_own_units(tuple(p for p, _ in pairs), rate=0)
                sine = self._in_own_units(tuple(q for _, q in pairs), rate=0)
                found.append(Harmonic(multiple, cosine, sine))
        return tuple(found)

    def harmonic_rows(self) -> list[dict[str, Any]]:
        """The harmonics of u in omega0 t in the public JSON form; raises InputError as ``harmonics`` does."""
        return [
            {"multiple": h.multiple, "cosine": self._rows(h.cosine), "sine": self._rows(h.sine)} for h in self.harmonics
        ]

    def residual(self) -> list[int]:
        """Substitute u and omega0 back into the equation; return the orders that do not cancel (none: exact)."""
        if self.residual_of is None:
            raise InputError(f"{self.method} has no waveform to substitute; compare it with lindstedt instead")
        return self.residual_of(self)

    def in_balls(self, value: arb) -> arb:
        """Return an enclosure of this truncated series, in rad per time unit, at FLINT's working precision.

        It encloses the series, not the exact frequency.  Raises InputError when a parameter is still symbolic.
        """
        coefficients = self.coefficients
        if self.symbolic_names:
            raise InputError(
                f"the coefficients hold {', '.join(self.symbolic_names)} as symbols; set them before evaluating"
            )
        k = natural_frequency(self.scale)
        x = value / k if self.scaled_variable else value
        if self.constants:
            coefficients = tuple(scalar_ball(c, self.names, self.constants) for c in coefficients)
        return k * polynomial_at(coefficients, x)

    def __call__(self, value: Any) -> Any:
        """Evaluate omega0 in rad per time unit, at a number or an array (float), or exactly at a Fraction.

        The coefficients are rounded once to the nearest float; mpmath numbers keep their own precision.
        """
        if isinstance(value, Fraction | sympy.Rational):
            return sum((c * sympy.Rational(value) ** n for n, c in enumerate(self.frequency)), sympy.S.Zero)
        rounded, even = self._rounded
        if type(value).__module__.startswith("mpmath"):
            return polynomial_value([_like(c, value) for c in self.frequency], value)
        return polynomial_value(rounded, value * value if even else value)

    @cached_property
    def _rounded(self) -> tuple[tuple[float, ...], bool]:
        """The coefficients as floats; of even powers only where the others vanish."""
        even = all(c == 0 for c in self.frequency[1::2])
        return tuple(nearest(c) for c in self.frequency[:: 2 if even else 1]), even

    def truncated(self, order: int) -> Expansion:
        """Keep the terms up to a lower order.

        Raises InputError when ``order`` is not between 0 and the present order.
        """
        if not 0 <= order <= self.order:
            raise InputError(f"order {order} is not within 0..{self.order} of this expansion; derive it again")
        return replace(
            self,
            order=order,
            coefficients=self.coefficients[: order + 1],
            waveform=None if self.waveform is None else self.waveform[: order + 2 - self.scaled_variable],
            amplitude_coefficients=self.amplitude_coefficients and self.amplitude_coefficients[: order + 1],
        )

    def convert(self, definition: str) -> Expansion:
        """Return the same expansion in another amplitude definition, by exact series composition.

        Raises InputError for an unknown definition, or when the waveform that carries the conversion is missing.
        """
        if check_definition(definition) == self.amplitude:
            return self
        if self.velocity:
            check_velocity(self.system, definition)
        if self.variable != "A" or self.waveform is None:
            raise InputError(f"this {self.method} expansion cannot be converted; derive it as {definition!r} instead")
        new_of_old = measured(definition, self.waveform, self.coefficients)
        old_of_new = truncated.revert(new_of_old)
        return replace(
            self,
            amplitude=definition,
            coefficients=tuple(truncated.compose(list(self.coefficients), old_of_new[: self.order + 1])),
            waveform=counted_from_its_own(definition, substitute(self.waveform, old_of_new)),
        )

    def amplitude_as(self, definition: str) -> tuple[sympy.Expr, ...]:
        """Another amplitude of the same orbits as an exact series in this one: coefficients of A**0, A**1, ...

        Raises InputError for an unknown definition, or when the waveform that carries the conversion is missing.

        >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
        >>> lindstedt("duffing", 2, amplitude="fundamental").amplitude_as("peak")
        (0, 1, 0, 1/32)
        """
        check_definition(definition)
        if self.variable != "A" or self.waveform is None:
            raise InputError(f"this {self.method} expansion cannot be converted; derive it as {definition!r} instead")
        return self._in_own_units(tuple(measured(definition, self.waveform, self.coefficients)), rate=0)

    def difference(self, other: Expansion) -> tuple[sympy.Expr, ...]:
        """Exact differences of the coefficients through the lower of the two orders.

        Raises InputError when the variables or the amplitude definitions differ.
        """
        same_definition(self.amplitude, other.amplitude)
        if self.variable != other.variable:
            raise InputError(f"an expansion in {self.variable} meets one in {other.variable}; they cannot be compared")
        pairs = zip(self.frequency, other.frequency, strict=False)
        return tuple(sympy.expand(mine - yours) for mine, yours in pairs)

    def terms(self) -> tuple[sympy.Expr, ...]:
        """The nonzero terms of omega0 in rising order."""
        x = sympy.Symbol(self.variable, real=True)
        return tuple(c * x**n for n, c in enumerate(self.frequency) if c != 0)

    def expression(self) -> sympy.Expr:
        """omega0 as one SymPy expression."""
        return sympy.Add(*self.terms())

    def latex(self) -> str:
        r"""LaTeX of the whole relation, ``\omega_0(A) = ...`` in rising order."""
        name = r"\varepsilon" if self.variable == "eps" else self.variable
        with long_integers():
            return rf"\omega_0({name}) = " + series_latex(self.terms())

    def mathml(self) -> str:
        """Presentation MathML of the whole relation."""
        return mathml(self.latex())

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: exact coefficients as strings, zero terms left out."""
        result: dict[str, object] = {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            "variables": [self.variable],
            "frequency": self._rows(self.frequency),
        }
        if self.amplitude_series is not None:
            result["amplitude_series"] = self._rows(self.amplitude_series)
        return result

    def _rows(self, values: tuple[sympy.Expr, ...]) -> list[dict[str, object]]:
        with long_integers():
            return [{"powers": {self.variable: n}, **coefficient_row(c)} for n, c in enumerate(values) if c != 0]


def first_harmonic(p: Trig) -> Scalar:
    """Return the coefficient of cos tau: the amplitude by the definition ``fundamental``.

    >>> from ridgeback.symbolic.series.trigonometric import cosine
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> first_harmonic(cosine(space_for(())))
    1
    """
    return harmonic(p, 1)[0]


def substitute(waveform: tuple[Trig, ...], inner: list[Scalar]) -> tuple[Trig, ...]:
    """Insert a series without constant term for the variable of ``sum_n X^n u_n``.

    >>> from ridgeback.symbolic.series.trigonometric import constant, cosine
    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> space = space_for(())
    >>> u = (constant(space, fmpq(0)), cosine(space))
    >>> substitute(u, [fmpq(0), fmpq(1)])[1] == u[1]
    True
    """
    length = len(waveform)
    result = [waveform[0]] + [waveform[0].scale(fmpq(0))] * (length - 1)
    power: list[Scalar] = [fmpq(1)] + [fmpq(0)] * (length - 1)
    for n in range(1, length):
        power = truncated.multiply(power, inner[:length])
        for m in range(n, length):
            if power[m] != 0:
                result[m] = result[m] + waveform[n].scale(power[m])
    return tuple(result)


def check_order(order: object, *, lowest: int = 0) -> int:
    """Return an order as an int.

    Parameters
    ----------
    order : object
        What was given.
    lowest : int, optional
        The least that is allowed.

    Returns
    -------
    int
        The order.

    Raises
    ------
    InputError
        When it is not a whole number or too low.

    Examples
    --------
    >>> check_order(4)
    4
    """
    if isinstance(order, bool) or not isinstance(order, int):
        raise InputError(f"order {order!r} is not a whole number; use e.g. 8")
    if order < lowest:
        raise InputError(f"order {order} is below {lowest}; use {lowest} or more")
    return order


def _like(coefficient: sympy.Expr, value: Any) -> Any:
    """A coefficient as a number of mpmath of the kind and precision of another one."""
    if coefficient.is_Rational:
        return type(value)(coefficient.p) / type(value)(coefficient.q)
    if hasattr(value, "_mpi_"):
        raise InputError(
            f"the coefficient {coefficient} is irrational, which intervals of mpmath do not take; use balls"
        )
    with ctx.workprec(value.context.prec + ROUNDING):
        mantissa, exponent = number_ball(coefficient).mid().man_exp()
    return value.context.mpf((int(mantissa), int(exponent)))
