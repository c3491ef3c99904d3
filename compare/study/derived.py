"""What is derived of one oscillator, and its undamped form bound to numbers: made once, shared by all that need it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.orbits.potential import peak_limit
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.averaged_losses import undamped as without_losses
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import small_parameters, undamped
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.singularities.limits import Limits, limits
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.sides import NoSeriesError
from ridgeback.symbolic.systems.structure import dissipative_names


@dataclass(frozen=True)
class Undamped:
    """An oscillator without damping, whose backbone is studied; a limit cycle as it is.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> Undamped(find("pendulum")).limit, Undamped(find("van-der-pol")).limit
    (3.141592653589793, None)
    """

    oscillator: Oscillator

    @cached_property
    def dynamics(self) -> Dynamics:
        """The oscillator bound to its numbers."""
        return bind(self.oscillator)

    @cached_property
    def limit(self) -> float | None:
        """The peak amplitude at which the oscillation itself ends (separatrix), where there is one."""
        if self.oscillator.kind != "conservative" or self.oscillator.potential is None:
            return None
        limit = peak_limit(self.dynamics)
        return limit if math.isfinite(limit) else None


def without_damping(oscillator: Oscillator) -> Undamped:
    """The oscillator as its backbone is studied.

    Parameters
    ----------
    oscillator
        Any oscillator whose parameters have values; its damping is left out.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> without_damping(find("damped-pendulum")).oscillator.kind
    'conservative'
    """
    if oscillator.has_rough_losses:
        return Undamped(without_losses(oscillator, damping_names(oscillator)))
    return Undamped(undamped(oscillator))


def damping_names(oscillator: Oscillator) -> tuple[str, ...]:
    """The parameters that are zero in the undamped motion, in the order of the equation.

    Parameters
    ----------
    oscillator
        A damped oscillator.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> damping_names(find("damped-pendulum"))
    ('mu',)
    """
    if oscillator.has_rough_losses:
        lossy = dissipative_names(oscillator.force)
        return tuple(name for name in oscillator.parameters if name in lossy)
    return small_parameters(oscillator)


@dataclass(frozen=True)
class Derived:
    """The derived series of one oscillator: the periodic family, and the slow flow where there is one."""

    oscillator: Oscillator
    undamped: Undamped
    expansion: Expansion
    """Lindstedt-Poincaré, in the peak amplitude or in eps; the energy integral where the force has a kink at rest."""
    flow: SlowFlow | None

    @cached_property
    def limits(self) -> Limits:
        """Where the series converges and how far it may be used."""
        return limits(self.expansion)


def derive(oscillator: Oscillator, order: int, *, flow_order: int | None = None) -> Derived:
    """Derive the expansion of the undamped oscillator (or limit cycle), and the slow flow of the damped one.

    Parameters
    ----------
    oscillator
        Any oscillator with a family of periodic orbits, or a limit cycle.
    order
        Highest power of the amplitude (or of eps) that is kept.
    flow_order
        Highest weighted degree of the slow flow; by default ``order``, at most 8.

    Raises
    ------
    InputError
        For an order below 0, and for an oscillator without a family of periodic orbits.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = derive(find("damped-pendulum"), 6, flow_order=4)
    >>> found.expansion.order, found.flow.order
    (6, 4)
    """
    rest = without_damping(oscillator)
    flow = None
    if oscillator.has_rough_losses or rest.oscillator.by_sides:
        return Derived(oscillator, rest, backbone_series(rest.oscillator, order), None)
    if small_parameters(oscillator) or oscillator.kind != "damped":
        flow = multiple_scales(oscillator, min(order, 8) if flow_order is None else flow_order)
    return Derived(oscillator, rest, backbone_series(rest.oscillator, order), flow)


def derived_or_none(oscillator: Oscillator, order: int, *, flow_order: int | None = None) -> Derived | None:
    """The same, or None where no series about rest exists, as beyond a stop.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> derived_or_none(find("bilinear-stops"), 2) is None
    True
    """
    try:
        return derive(oscillator, order, flow_order=flow_order)
    except NoSeriesError:
        return None


def backbone_series(rest: Oscillator, order: int) -> Expansion:
    """The series of an oscillator whose damping is left out, by the method that suits it.

    Raises InputError where it runs in other powers of A than whole ones.

    >>> backbone_series(Oscillator.from_equation("u'' + u + u*abs(u) = 0"), 2).method
    'energy-integral'
    """
    if not rest.by_sides:
        return lindstedt(rest, order)
    found = energy_on_each_side(rest, order)
    if isinstance(found, Expansion):
        return found
    raise InputError(
        f"{rest.name}: omega0 begins with A^({found.growth}) and rises in steps of A^(1/{found.root}), and this is "
        "made of power series in A; derive and study take it"
    )
