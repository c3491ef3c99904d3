r"""The limits of an expansion: its radius of convergence, the singularities that set it, and the range of use left.

omega0 and the period 2 pi/omega0 have the same radius unless one of them vanishes, but not equally plain singularities:
at a saddle of the potential the period of a conservative oscillator is analytic times a logarithm, and omega0, its
reciprocal, defeats every extrapolation in 1/n.  So the period is examined first for amplitudes (omega0 where the period
has a mere pole, or where omega0 itself has one), both for limit cycles, and the less uncertain is taken.

Everything here is estimated from finitely many coefficients, never certified: the uncertainties are the changes seen
between neighbouring estimates, weighted (``darboux``), and D-log Padé poles are the second route (``dlog``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from decimal import Decimal
from html import escape
from typing import Any, Final, TypeAlias

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.balls import natural_frequency
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.singularities.darboux import Estimate, Point, nearest_singularities
from ridgeback.symbolic.singularities.dlog_pade import dlog_singularities
from ridgeback.symbolic.singularities.stripped import CONSTANT, Series, stripped
from ridgeback.symbolic.singularities.zeros import zero_inside

TRUSTED: Final = 0.1
"""Largest relative uncertainty of a place that is still handed out."""

TOLERANCE: Final = 1e-3
"""Relative error of the truncated series that ends its range of use."""

_LOGARITHMS: Final = 10
"""How much more uncertain estimates are when the amplitude itself is singular at the saddle (empirical)."""


_ROUNDING: Final = 2.0**-50

_SMALLEST: Final = 1e-290
"""Places are floats, and their uncertainties need room below them."""

_LAST: Final = 4
"""How many coefficients, of the upper half, stand for the size of those left out."""


ONE_POWER = "omega0 is one power of A through this order: no limit shows."
_POWERS = {2: "²", 3: "³"}


@dataclass(frozen=True)
class Singularity:
    """(1 - x/x_c)^exponent near x_c = modulus exp(i argument), x = X^step; exponents 0, 1, ... mean a logarithm.

    Uncertainties are estimates, meant to cover the truth; that of the argument is in rad.
    """

    modulus: float
    argument: float
    exponent: float
    modulus_uncertainty: float
    argument_uncertainty: float
    exponent_uncertainty: float
    of: str
    """``period`` or ``frequency``: the function whose exponent it is."""
    method: str

    @property
    def kind(self) -> str:
        """What the exponent says in words: logarithm, pole, square root, branch point."""
        nearest = round(2 * self.exponent)
        if self.exponent_uncertainty > 0.25 or abs(self.exponent - nearest / 2) > self.exponent_uncertainty + 1e-9:
            return "branch point"
        if nearest % 2:
            return "square-root branch point"
        return "logarithm" if nearest >= 0 else f"pole of order {-nearest // 2}"


@dataclass(frozen=True, repr=False)
class Limits:
    """Where an expansion converges and how far it is of use; None, and the reason, where that is not settled."""

    variable: str
    step: int
    """The series runs in x = variable^step."""
    order: int
    radius: float | None
    """Radius of convergence in the printed variable."""
    uncertainty: float | None
    singularities: tuple[Singularity, ...]
    """Places in x, in units where the natural frequency is 1 (as the coefficients are)."""
    second_route: tuple[Singularity, ...]
    """The poles of a D-log Padé approximant that are nearest to them."""
    range_of_use: float | None
    """Largest value of the variable at which the estimated truncation error is below ``TOLERANCE``, relative."""
    why: str
    """How the radius was found, or why it is None."""

    def __repr__(self) -> str:
        return f"<Limits: {self.sentence()}>"

    def _repr_html_(self) -> str:
        """The sentence, for a notebook."""
        return f"<p>{escape(self.sentence())}</p>"

    def to_dict(self) -> dict[str, object]:
        """The public JSON form; places of singularities in units where the natural frequency is 1."""
        return {
            "radius": self.radius,
            "uncertainty": self.uncertainty,
            "range_of_use": self.range_of_use,
            "step": self.step,
            "singularities": [asdict(s) for s in self.singularities],
            "sentence": self.sentence(),
        }

    def sentence(self) -> str:
        """Say the limits in one line."""
        if self.why == ONE_POWER:
            return self.why
        if self.why == CONSTANT:
            return "omega0 is constant through this order: no limit shows."
        if self.radius is None or self.uncertainty is None:
            return f"The range of convergence is not known: {self.why}."
        return (
            f"The series converges for |{self.variable}| < {self.circle} (estimated: {self.nearest}); truncated at "
            f"order {self.order} it errs by less than about {100 * TOLERANCE:g} % up to {self.variable} = "
            f"{self.range_of_use:.3g} or further."
        )

    @property
    def circle(self) -> str:
        """The radius with its uncertainty, as text; empty where it is not known."""
        unknown = self.radius is None or self.uncertainty is None
        return "" if unknown else _with_error(self.radius or 0.0, self.uncertainty or 0.0)

    @property
    def nearest(self) -> str:
        """The singularity that sets the radius: what it is, of which function, and where; empty where none is known."""
        first = next(iter(self.singularities), None)
        return "" if first is None else f"{first.kind} of the {first.of} at {self._place(first)}"

    def _place(self, s: Singularity) -> str:
        x = self.variable if self.step == 1 else f"{self.variable}{_POWERS.get(self.step, f'^{self.step}')}"
        scale = (self.radius or 0) ** self.step / s.modulus
        size = _with_error(s.modulus * scale, s.modulus_uncertainty * scale)
        if s.argument == 0:
            return f"{x} = {size}"
        if s.argument == math.pi:
            return f"{x} = −{size}"
        return f"|{x}| = {size}, arg = ±{_with_error(abs(s.argument), s.argument_uncertainty)}"


def limits(expansion: Series, *, longer: Series | None = None) -> Limits:
    """Estimate the radius of convergence of omega0 and the nature of the nearest singularities.

    Parameters
    ----------
    expansion : Expansion or BallExpansion
        Balls count only if they are narrow enough for a fit.
    longer : Expansion or BallExpansion, optional
        The same expansion to a higher order: it settles the limits of one that is too short to do so itself.

    Returns
    -------
    Limits
        The radius with its error and the singularities; None, and the reason, where that is not settled.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.energy_integral import energy_integral
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> limits(energy_integral(find("pendulum"), 40)).sentence()
    'The series converges for |A| < 3.142 ± 0.002 (estimated: logarithm of the period at A² = 9.87 ± 0.02); ...'
    >>> limits(energy_integral(find("linear"), 40)).sentence()
    'omega0 is constant through this order: no limit shows.'
    """
    try:
        step, series = stripped(longer or expansion)
        unit = natural_frequency(expansion.scale) if expansion.scaled_variable else arb(1)
    except InputError as error:
        return _unknown(expansion, str(error))
    with ctx.workprec(_precision(longer or expansion)):
        found = _chosen(expansion, series)
    if found is None:
        return _unknown(expansion, f"{len(series)} coefficients do not settle the nearest singularity; raise the order")
    of, estimate, method = found
    if not all(_SMALLEST < abs(point.place) < 1 / arb(_SMALLEST) for point in estimate.points):
        return _unknown(expansion, "the nearest singularity is beyond the range of floats; scale the unknown")
    exact = isinstance(longer or expansion, Expansion)
    second = dlog_singularities(_function(series, of), estimate) if exact else None
    singularities = _singularities(estimate, of, method)
    radius = singularities[0].modulus ** (1 / step) * float(unit)
    return Limits(
        variable=expansion.variable,
        step=step,
        order=expansion.order,
        radius=radius,
        uncertainty=radius * singularities[0].modulus_uncertainty / singularities[0].modulus / step,
        singularities=singularities,
        second_route=() if second is None else _singularities(second, of, "D-log Pade"),
        range_of_use=radius * _usable(series[: expansion.order // step + 1], singularities[0].modulus) ** (1 / step),
        why=f"{len(series)} coefficients of the {of}, {method}",
    )


def _precision(expansion: Series) -> int:
    return expansion.bits if isinstance(expansion, BallExpansion) else int(ctx.prec)


def _unknown(expansion: Series, why: str) -> Limits:
    return nowhere(expansion.order, why, expansion.variable)


def nowhere(order: int, why: str, variable: str = "A") -> Limits:
    """No limits, and why.

    >>> nowhere(4, "it is short").sentence()
    'The range of convergence is not known: it is short.'
    """
    return Limits(variable, 1, order, None, None, (), (), None, why)


def _function(series: list[Any], of: str) -> list[Any]:
    return series if of == "frequency" else truncated.reciprocal(series)


Found: TypeAlias = tuple[str, Estimate, str]
"""The function that is singular, the estimate, and its method."""


def _chosen(expansion: Series, series: list[Any]) -> Found | None:
    """The function whose singularities are plain, by the rule above, with its estimate."""
    factor = _LOGARITHMS if expansion.variable == "A" and expansion.amplitude not in ("peak", "trough") else 1
    period, frequency = (_settled(_function(series, of), factor) for of in ("period", "frequency"))
    found: list[Found] = []
    if period is not None and not _has_pole(period):
        found.append(("period", period, _method(period)))
        vanishes = _vanishing(series, period, factor) if expansion.variable == "A" else None
        found += [("frequency", vanishes, "zero of the truncated period")] if vanishes is not None else []
    if frequency is not None and not (_has_pole(frequency) and expansion.variable != "A"):
        plain = expansion.variable != "A" or _has_pole(frequency) or (period is not None and _has_pole(period))
        found += [("frequency", frequency, _method(frequency))] if plain else []
    return min(found, key=_preference(expansion), default=None)


def _method(estimate: Estimate) -> str:
    return f"recurrence of {len(estimate.points) + 1} terms, {estimate.degree} powers of 1/n"


def _vanishing(series: list[Any], period: Estimate, factor: int) -> Estimate | None:
    """A zero of the period before it is singular."""
    zero = zero_inside(_function(series, "period"), abs(period.points[0].place))
    return None if zero is None else replace(zero, place_error=factor * zero.place_error)


def _preference(expansion: Series) -> Callable[[Found], float]:
    """Nearest first for amplitudes, where the two functions differ; least uncertain first for limit cycles."""
    if expansion.variable == "A":
        return lambda found: float(abs(found[1].points[0].place))
    return lambda found: found[1].place_error


def _settled(series: list[Any], factor: int) -> Estimate | None:
    """The least uncertain estimate for one singularity or two, None when none can be trusted."""
    estimates = [e for count in (1, 2) if (e := nearest_singularities(series, count)) is not None]
    best = min(estimates, key=lambda e: e.place_error, default=None)
    if best is None or best.place_error * factor > TRUSTED:
        return None
    return replace(best, place_error=factor * best.place_error, exponent_error=factor * best.exponent_error)


def _has_pole(estimate: Estimate) -> bool:
    p = float(estimate.points[0].exponent.real)
    return p < -0.5 and abs(p - round(p)) <= estimate.exponent_error < 0.25


def _singularities(estimate: Estimate, of: str, method: str) -> tuple[Singularity, ...]:
    return tuple(_singularity(point, estimate, of, method) for point in estimate.points)


def _singularity(point: Point, estimate: Estimate, of: str, method: str) -> Singularity:
    modulus, real = float(abs(point.place)), point.place.imag == 0
    error = max(estimate.place_error, _ROUNDING)
    return Singularity(
        modulus=modulus,
        argument=float(point.place.arg()),
        exponent=float(point.exponent.real),
        modulus_uncertainty=modulus * error,
        argument_uncertainty=0.0 if real else error,
        exponent_uncertainty=max(estimate.exponent_error, _ROUNDING),
        of=of,
        method=method,
    )


def _usable(series: list[Any], modulus: float) -> float:
    """The largest x/modulus = r with size r^n / (1 - r) < TOLERANCE |sum|, n the first power left out, by bisection."""
    scaled = [float(arb(c) * arb(modulus) ** n) for n, c in enumerate(series)]
    size = max(abs(c) for c in scaled[-min(_LAST, len(scaled) // 2) :])
    low, high = 0.0, 1.0
    for _ in range(50):
        r = (low + high) / 2
        tail = size * r ** len(series) / (1 - r)
        good = tail < TOLERANCE * abs(sum(c * r**n for n, c in enumerate(scaled)))
        low, high = (r, high) if good else (low, r)
    return low


def _with_error(value: float, error: float) -> str:
    """A value with its uncertainty, to the digit where that begins; with a power of ten where the value is far from 1.

    >>> _with_error(3.14159265, 0.00012), _with_error(3.14159265e-15, 1.2e-19), _with_error(2.5e8, 1e6)
    ('3.1416 ± 0.0002', '(3.1416 ± 0.0002)e-15', '(2.50 ± 0.01)e+08')
    """
    if error < 1e-9 * abs(value):
        return f"{value:.10g}"
    mantissa, power = _scaled(value)
    size = float(Decimal(error).scaleb(-power))
    digits = max(0, -math.floor(math.log10(size)))
    step = 10.0**-digits
    text = f"{mantissa:.{digits}f} ± {math.ceil(size / step) * step:.{digits}f}"
    return f"({text})e{power:+03d}" if power else text


def _scaled(value: float) -> tuple[float, int]:
    """A value as its mantissa and a power of ten, which is 0 from 1e-4 to 1e6."""
    if value == 0 or 1e-4 <= abs(value) < 1e6:
        return value, 0
    power = math.floor(math.log10(abs(value)))
    return float(Decimal(value).scaleb(-power)), power
