"""The resummation of a series by name: which formula, with which change of variable, refused over which range."""

from __future__ import annotations

from fractions import Fraction
from typing import Literal, TypeAlias

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.resummation.pade import mapped, mapping_for, pade
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

Kind: TypeAlias = Literal["pade", "map", "nome"]
KINDS: tuple[Kind, ...] = ("pade", "map", "nome")


def resum(
    oscillator: OscillatorLike,
    series: Expansion | PowerExpansion,
    kind: str,
    *,
    degrees: tuple[int, int] | None = None,
    growth: Fraction = Fraction(0),
    up_to: Fraction | None = None,
    progress: Wanted = None,
) -> Resummation:
    """Resum a series of omega0.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Whose series it is.
    series : Expansion
        To be resummed.
    kind : str
        ``pade`` for the approximant [m/n], ``map`` for the change of variable that the series' limits ask for, ``nome``
        for the elliptic nome of a pendulum or Duffing oscillator.
    degrees : tuple of int, optional
        m and n of the approximant; diagonal by default, a plain polynomial for a map.
    growth : Fraction, optional
        The power of x that omega0 follows at infinity (maps only, see ``pade.mapped``).
    up_to : Fraction, optional
        A pole at or below this value of the variable is refused, as one inside the radius of convergence always is.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done of the longer series that settles the radius.

    Returns
    -------
    Resummation
        An exact formula that can be called, printed and generated.

    Raises
    ------
    InputError
        For a pole within reach, and for what the oscillator or the order does not allow.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> resum(find("pendulum"), lindstedt(find("pendulum"), 8), "pade").method
    'Pade [2/2]'
    """
    oscillator = as_oscillator(oscillator)
    if isinstance(series, PowerExpansion):
        raise InputError(series.refusal())
    if kind not in KINDS:
        raise InputError(f"no resummation {kind!r}; there are {', '.join(KINDS)}")
    if growth and kind != "map":
        raise InputError(f"growth {growth} can be taken out of a map only, not of {kind}; leave it out")
    if kind == "nome":
        return _nome(oscillator, series, degrees)
    if not series.names and all(c == 0 for c in series.coefficients[1:]):
        raise InputError(f"{series.system}: omega0 is constant through order {series.order}; nothing is to be resummed")
    limits = settled_limits(oscillator, series, progress=progress)
    reach = max(Fraction(limits.radius or 0), up_to or Fraction(0))
    m, n = degrees or (None, None)
    if kind == "map":
        return mapped(series, mapping_for(limits), growth=growth, m=m, n=n or 0, up_to=reach)
    return pade(series, m, n, up_to=reach)


def _nome(oscillator: Oscillator, series: Expansion, degrees: tuple[int, int] | None) -> Resummation:
    if degrees is not None:
        raise InputError("the elliptic nome is no quotient of polynomials; leave the degrees out")
    if series.amplitude != "peak" or series.variable != "A":
        raise InputError(
            f"the elliptic nome holds for the peak amplitude, not for {series.amplitude} in {series.variable}; use pade"
        )
    return nome(oscillator, series.order)
