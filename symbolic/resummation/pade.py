r"""Rational resummation: Padé approximants, in the variable itself or in one that moves the singularity.

    omega0 = k v(w)^(-growth/rate) P(w)/Q(w),      w = w(x),      x = X^step

P/Q is the [m/n] Padé approximant of the series re-expanded exactly in w (n = 0: the mapped series itself).  ``growth``
is the power of x that omega0 is known to follow at infinity; it is taken out before the re-expansion by a polynomial
v(w) that falls like x^(-rate).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import sympy
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import ball, natural_frequency, polynomial_at, whole_power
from ridgeback.symbolic.arithmetic.rational_function import (
    Coefficients,
    approximant,
    as_expression,
    first_positive_zero,
)
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.resummation.mapping import CutPlane, Euler, Identity, Mapping, Pair, padded, power
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.limits import Limits, limits
from ridgeback.symbolic.singularities.stripped import stripped

_DENOMINATOR: Final = 1000
"""Places of singularities are rounded to fractions with denominators up to this before an exact re-expansion."""


@dataclass(frozen=True, repr=False)
class RationalForm(Resummation):
    """A quotient of polynomials in w, with exact rational coefficients.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> pade(lindstedt(find("pendulum"), 4)).expression()
    (1 - 11*A**2/192)/(A**2/192 + 1)
    """

    step: int
    """x = X^step."""
    mapping: Mapping
    growth: Fraction
    numerator: Coefficients
    denominator: Coefficients
    pole: arb | None
    """The first pole at a positive value of the printed variable, certified; None when there is none."""

    def normalised(self, x: arb) -> arb:
        w = self.mapping.image(whole_power(x, self.step))
        result = polynomial_at(self.numerator, w) / polynomial_at(self.denominator, w)
        if self.growth == 0:
            return result
        vanishing = polynomial_at(tuple(padded(self.mapping.vanishing, 3)), w)
        return result * vanishing ** ball(-self.growth / self.mapping.rate)

    def formula(self, x: sympy.Expr) -> sympy.Expr:
        w = self.mapping.expression(x**self.step)
        quotient = as_expression(self.numerator, w) / as_expression(self.denominator, w)
        if self.growth == 0:
            return quotient
        vanishing = as_expression(tuple(padded(self.mapping.vanishing, 3)), w)
        return quotient * vanishing ** sympy.Rational(-self.growth / self.mapping.rate)

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: exact coefficients of both polynomials in w, w itself, and the first positive pole."""
        return {
            **super().to_dict(),
            "numerator": [str(c) for c in self.numerator],
            "denominator": [str(c) for c in self.denominator],
            "w": str(self.mapping.expression(sympy.Symbol("X", real=True) ** self.step)),
            "growth": str(self.growth),
            "pole": None if self.pole is None else float(self.pole),
        }

    def refusal(self, value: arb) -> str | None:
        if self.pole is None or abs(value) < self.pole:
            return None
        return f"it has a pole at {self.variable} = {self.pole.str(10, radius=False)}"


def pade(
    expansion: Expansion, m: int | None = None, n: int | None = None, *, up_to: float | Fraction | None = None
) -> RationalForm:
    """Return the [m/n] Padé approximant of an expansion.

    Parameters
    ----------
    expansion : Expansion
        With rational coefficients; x is A^2 (A when odd powers occur, eps^2).
    m, n : int, optional
        Degrees of numerator and denominator in x; diagonal by default.
    up_to : float or Fraction, optional
        A pole at or below it (in the printed variable; without it, inside the radius of convergence as far as
        ``limits`` knows it) is refused with its place, and so is evaluation beyond the first pole.

    Returns
    -------
    RationalForm
        The approximant, with its first pole.

    Raises
    ------
    InputError
        For such a pole, for coefficients that are not rational, and for degrees that do not fit the order.

    References
    ----------
    Baker and Graves-Morris, Padé Approximants, 2nd ed. (Cambridge, 1996), section 2.4.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> pade(energy_integral(find("duffing"), 4)).expression()
    (19*A**2/32 + 1)/(7*A**2/32 + 1)
    """
    return mapped(expansion, Identity(), m=m, n=_half(expansion) if n is None else n, up_to=up_to)


def mapped(
    expansion: Expansion,
    mapping: Mapping,
    *,
    growth: Fraction = Fraction(0),
    m: int | None = None,
    n: int = 0,
    up_to: float | Fraction | None = None,
) -> RationalForm:
    """Expand again exactly in the variable of a mapping, then take the [m/n] Padé approximant of that (n = 0: none).

    Parameters
    ----------
    expansion : Expansion
        With rational coefficients.
    mapping : Mapping
        The change of variable x -> w.
    growth : Fraction, optional
        The power of x = X^step that omega0 follows at infinity, to be taken out first: 1/2 in x = A^2 for a cubic
        stiffness, -1/2 in x = eps^2 for the van der Pol oscillator.
    m, n : int, optional
        Degrees of numerator and denominator in w.
    up_to : float or Fraction, optional
        As for ``pade``.

    Returns
    -------
    RationalForm
        The approximant in w.

    Raises
    ------
    InputError
        As ``pade`` does.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> duffing = energy_integral(find("duffing"), 16)
    >>> abs(mapped(duffing, Euler(Fraction(1)), growth=Fraction(1, 2))(100.0) / 84.7274824 - 1) < 1e-4
    True
    """
    step, series = stripped(expansion)
    if growth != 0 and mapping.rate == 0:
        raise InputError(f"growth {growth} needs a mapping to be taken out with, such as Euler")
    inner = truncated.compose(series, mapping.series(len(series)))
    if growth != 0:
        prefactor = power(padded(mapping.vanishing, len(inner)), growth / mapping.rate)
        inner = truncated.multiply(inner, prefactor)
    top = len(inner) - 1 - n if m is None else m
    numerator, denominator = approximant(inner, top, n)
    form = RationalForm(
        system=expansion.system,
        method=_title(mapping, top, n),
        variable=expansion.variable,
        amplitude=expansion.amplitude,
        order=step * (top + n),
        scale=expansion.scale,
        scaled_variable=expansion.scaled_variable,
        step=step,
        mapping=mapping,
        growth=growth,
        numerator=numerator,
        denominator=denominator,
        pole=_first_pole(expansion, mapping, denominator, step),
    )
    _refuse_pole_within(form, expansion, up_to)
    return form


def mapping_for(found: Limits, *, cut: bool = False) -> Mapping:
    """Choose the change of variable that moves the nearest singularity: Euler, cut plane or Andersen-Geer.

    Parameters
    ----------
    found : Limits
        Of the series; places are rounded to the simplest fractions within their uncertainty.
    cut : bool, optional
        Prefer the cut-plane map for a negative singularity, where Euler's transformation would do; a positive one has
        only the cut plane.

    Returns
    -------
    Mapping
        The change of variable.

    Raises
    ------
    InputError
        When the limits are not known.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> mapping_for(limits(energy_integral(find("duffing"), 24)))
    Euler(x0=Fraction(1, 1), rate=Fraction(1, 1))
    """
    if not found.singularities:
        raise InputError(f"no change of variable can be chosen: {found.why}; give one, such as Euler(Fraction(1))")
    first = found.singularities[0]
    modulus = simplest(first.modulus, first.modulus_uncertainty)
    if first.argument == 0:
        return CutPlane(modulus)
    if first.argument == math.pi:
        return CutPlane(-modulus) if cut else Euler(modulus)
    blur = first.modulus_uncertainty + first.modulus * first.argument_uncertainty
    return Pair(modulus, simplest(first.modulus * math.cos(first.argument), blur))


def simplest(value: float, uncertainty: float) -> Fraction:
    """Return the fraction of smallest denominator within the uncertainty, or the nearest of a moderate denominator.

    >>> simplest(3.4203, 0.018)
    Fraction(24, 7)
    """
    for denominator in range(1, _DENOMINATOR):
        found = Fraction(round(value * denominator), denominator)
        if found != 0 and abs(found - Fraction(value)) <= Fraction(uncertainty):
            return found
    return Fraction(value).limit_denominator(_DENOMINATOR)


def _half(expansion: Expansion) -> int:
    return (len(stripped(expansion)[1]) - 1) // 2


def _title(mapping: Mapping, m: int, n: int) -> str:
    parts = [f"Pade [{m}/{n}]"] if n or not mapping.name else []
    return " of ".join([*parts, mapping.name] if mapping.name else parts)


def _first_pole(expansion: Expansion, mapping: Mapping, denominator: Coefficients, step: int) -> arb | None:
    """The place, in the printed variable, of the first zero of the denominator on the image of X > 0."""
    w = first_positive_zero(denominator)
    if w is None or not (mapping.rate == 0 or w < 1):
        return None
    place = mapping.preimage(w).root(step)
    return natural_frequency(expansion.scale) * place if expansion.scaled_variable else place


def _refuse_pole_within(form: RationalForm, expansion: Expansion, up_to: float | Fraction | None) -> None:
    if form.pole is None:
        return
    reach = limits(expansion).radius if up_to is None else float(up_to)
    if reach is not None and form.pole <= reach:
        place = f"{form.variable} = {form.pole.str(10, radius=False)}"
        raise InputError(
            f"{form.method} of {form.system} has a pole at {place}, inside the range of use, {reach:.4g}; "
            "change the degrees or the order"
        )
