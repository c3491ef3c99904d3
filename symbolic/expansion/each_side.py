r"""omega0(A) of a force that is analytic on each side of rest, and may begin with any power of u there.

At the distance u on one side let f = a w^P (1 + ...), u = w^d.  With m = P + d the potential is
V = a (d/m) y^m,  y = w (1 + ...)^(1/m),  and u = sum of u_n y^n from n = d on, u_d = 1.  From rest at the distance A,
where y = Y, to u = 0 takes

    t = sqrt(m / (2 a d)) * sum_n n u_n I_n Y^(n - m/2),
    I_n = integral of x^(n-1) (1 - x^m)^(-1/2) over 0 < x < 1 = B(n/m, 1/2) / m

(Landau and Lifshitz, Mechanics, section 11; DLMF 5.12.1), with I_(n+m) = I_n 2n / (2n + m), so that the coefficients
are rational in I_n / I_d of 0 < n - d < m; where the force begins linearly, d = 1 and m = 2, that is I_2/I_1 = 2/pi
alone.  On the other side Y' = rho Y with a' rho^m = a, for the energy is the same, and

    omega0 = pi / (t + t') = A^(P/(2d) - 1/2) * (a power series in A^(1/d)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from ridgeback.symbolic.expansion.amplitude import check_amplitude
from ridgeback.symbolic.expansion.cost import Budget, check
from ridgeback.symbolic.expansion.expansion import Expansion, check_order
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.expansion.quarter_cycles import TwoSides
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

METHOD = "energy-integral"
ALLOWED = ("peak", "trough")


def energy_on_each_side(
    oscillator: OscillatorLike, order: int, *, amplitude: str = "peak", budget: Budget | None = None
) -> Expansion | PowerExpansion:
    """Expand omega0 of a force f(u) that need be analytic on each side of u = 0 only, and may begin with any power.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator whose force does not depend on u'.
    order : int
        Highest power of the amplitude that is kept, relative to the leading one.
    amplitude : str, optional
        ``peak`` (default) or ``trough``.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.

    Returns
    -------
    Expansion or PowerExpansion
        A power series in A where the force begins linearly and holds no broken powers, else one in rational powers.

    Raises
    ------
    InputError
        For a bad order or definition, for terms in u', for a force that does not restore on both sides or begins with
        another power on each, and when the predicted cost exceeds the budget.

    References
    ----------
    Landau and Lifshitz, Mechanics, sections 11 and 12.

    Examples
    --------
    >>> energy_on_each_side("u'' + u + u*abs(u) = 0", 1).frequency
    (1, 4/(3*pi))
    >>> energy_on_each_side("u'' + 4*max(u, 0) + min(u, 0) = 0", 2).frequency
    (4/3, 0, 0)
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_amplitude(oscillator, amplitude, ALLOWED)
    found = sided(oscillator, order, trough=amplitude == "trough", budget=budget or Budget())
    if found.growth != 0 or found.root != 1:
        return PowerExpansion(
            system=oscillator.name,
            method=METHOD,
            amplitude=amplitude,
            order=order,
            lead=found.lead,
            growth=found.growth,
            root=found.root,
            coefficients=found.coefficients,
            names=found.names,
            constants=found.constants,
        )
    return Expansion(
        system=oscillator.name,
        method=METHOD,
        variable="A",
        amplitude=amplitude,
        order=order,
        scale=oscillator.natural_frequency,
        scaled_variable=False,
        coefficients=found.coefficients,
        waveform=None,
        amplitude_coefficients=None,
        residual_of=None,
        names=found.names,
        constants=found.constants,
        sided=oscillator.is_kinked,
    )


@dataclass(frozen=True)
class Sided:
    """omega0 = lead * x^growth * (1 + c_1 x + ...), x = A^(1/root): c_n as polynomials in ``names``."""

    lead: sympy.Expr
    growth: sympy.Rational
    root: int
    coefficients: tuple[Scalar, ...]
    names: tuple[str, ...]
    constants: Mapping[str, sympy.Expr]


def sided(oscillator: Oscillator, order: int, *, trough: bool = False, budget: Budget | None = None) -> Sided:
    """Expand omega0 in a turning point of a force that need be analytic on each side only.

    Parameters
    ----------
    oscillator : Oscillator
        Its force depends on u alone.
    order : int
        Highest power of A relative to the leading one.
    trough : bool, optional
        Whether A is the size of the turning point at u < 0.
    budget : Budget, optional
        What the derivation may cost.

    Returns
    -------
    Sided
        The series.

    Raises
    ------
    InputError
        For terms in u', for a force that does not restore on both sides, and for one that begins with another power on
        each.

    Examples
    --------
    >>> own = Oscillator.from_equation("u'' + u + u*abs(u) = 0")
    >>> found = sided(own, 2)
    >>> found.coefficients[1], found.constants
    (2/3*beta2*, {'beta2*': 2/pi})
    """
    both = TwoSides(oscillator, trough=trough)
    d, m = both.d, both.m
    check(METHOD, order * d, budget or Budget(), parameters=len(both.names) - len(both.betas) + 1)
    return Sided(
        lead=both.lead(),
        growth=sympy.Rational(m - 2 * d, 2 * d),
        root=d,
        coefficients=tuple(both.frequency(*both.travels(order * d))),
        names=both.names,
        constants=both.known,
    )
