"""The limits of a series that may be too short to show them: the same series carried further settles them."""

from __future__ import annotations

from typing import Final

from ridgeback.common.progress import Wanted
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
from ridgeback.symbolic.expansion.energy_integral import ALLOWED, energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import DIRECT, lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.singularities.limits import ONE_POWER, Limits, limits, nowhere
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, V

_SETTLING: Final = 48
"""The same for any amplitude definition and for limit cycles."""
_DIGITS: Final = 60
"""Of irrational coefficients; extrapolation loses some."""


def settled_limits(
    oscillator: OscillatorLike, expansion: Expansion | PowerExpansion | BallExpansion, *, progress: Wanted = None
) -> Limits:
    """Return the limits of an expansion; a short one is settled by the same expansion carried further.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of the oscillator whose expansion it is.
    expansion : Expansion, PowerExpansion or BallExpansion
        Balls that are too wide are settled by the exact series.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the order about to be found.

    Returns
    -------
    Limits
        ``radius`` with its ``uncertainty``, the ``singularities`` that set it, ``range_of_use``; ``sentence()`` says
        them.

    Raises
    ------
    InputError
        For what is no oscillator.

    Examples
    --------
    >>> settled_limits("pendulum", lindstedt("pendulum", 8)).sentence()
    'The series converges for |A| < 3.14159 ± ...'
    """
    if isinstance(expansion, PowerExpansion):
        return _of_powers(expansion)
    oscillator = as_oscillator(oscillator)
    unsettled = expansion.names if oscillator.by_sides else getattr(expansion, "symbolic_names", ())
    if unsettled or expansion.order >= _SETTLING:
        found = limits(expansion)
        if found.radius is not None or isinstance(expansion, Expansion):
            return found
    return limits(expansion, longer=_longer(oscillator, expansion.amplitude, progress))


def _longer(oscillator: Oscillator, amplitude: str, progress: Wanted) -> Expansion | BallExpansion:
    """The frequency alone is enough: by the energy integral where there is one, which takes the least.

    With irrational coefficients in balls, since exact ones are polynomials in all of them.
    """
    if oscillator.closes and oscillator.normalised.constants and amplitude in DIRECT:
        return lindstedt_in_balls(oscillator, _SETTLING, digits=_DIGITS, amplitude=amplitude, progress=progress)
    conserved = oscillator.is_conservative and not oscillator.by_sides and not oscillator.normalised.rational.has(V)
    derive = energy_integral if conserved and amplitude in ALLOWED else lindstedt
    return derive(oscillator, _SETTLING, amplitude=amplitude, progress=progress)


def _of_powers(expansion: PowerExpansion) -> Limits:
    """The limits of a series in rational powers: those of what stands beside the leading power, where it runs in A."""
    if expansion.is_power_law:
        return nowhere(expansion.order, ONE_POWER)
    if expansion.root != 1:
        return nowhere(
            expansion.order, f"the series runs in powers of A^(1/{expansion.root}), for which no rule is known"
        )
    return limits(expansion.beside_leading())
