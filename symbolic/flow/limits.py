"""What is known about where a slow flow holds: two frequencies contained in it are series in one variable.

Without its small parameters phi' is the frequency of the undamped oscillator, a series in a.  On a limit cycle phi' is
a series in the small parameter.  Their limits are estimated as for any series; of the flow between them, in two and
more variables, no region of convergence is known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.limit_cycle import FirstAmplitudeError, in_one_parameter
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.singularities.limits import Limits, limits
from ridgeback.symbolic.systems.oscillator import Oscillator

SETTLING: Final = {"peak": 48, "fundamental": 96}
"""Order of the series that settles the limits; the fundamental amplitude is itself singular at a saddle."""


@dataclass(frozen=True)
class FlowLimits:
    """The limits of one frequency that a slow flow contains."""

    of: str
    """Which frequency."""
    limits: Limits | None
    why: str
    """Why there are none; empty when there are."""

    def to_dict(self) -> dict[str, object]:
        """The public JSON form: that of the limits of a series, and the frequency that they are of."""
        known = {"radius": None} if self.limits is None else self.limits.to_dict()
        return {"of": self.of, **known, "sentence": self.sentence()}

    def sentence(self) -> str:
        """Say the limits in one line."""
        own = f"The range of convergence is not known: {self.why}." if self.limits is None else self.limits.sentence()
        return f"Of {self.of}: {own[0].lower() + own[1:] if own.startswith('The') else own}"


def flow_limits(oscillator: Oscillator, flow: SlowFlow) -> FlowLimits:
    """Return how far the frequency of a slow flow is of use.

    It is that of phi' on the limit cycle, where all but u'' + k^2 u carries the small parameter, and its powers end;
    else that of phi' undamped.

    Parameters
    ----------
    oscillator : Oscillator
        Whose flow it is.
    flow : SlowFlow
        Made by ``multiple_scales``.

    Returns
    -------
    FlowLimits
        The limits, and which frequency they are of.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow_limits(find("damped-pendulum"), multiple_scales(find("damped-pendulum"), 4)).sentence()
    'Of the frequency with mu = 0: the series converges for |a| < ... up to a = ... or further.'
    """
    on_cycle = oscillator.kind == "limit-cycle" and flow.complete is not None and in_one_parameter(oscillator)
    of = "the frequency of the limit cycle" if on_cycle else f"the frequency{_none_small(flow)}"
    try:
        if on_cycle:
            return FlowLimits(of, _settled(oscillator, flow.complete or 0, "peak"), "")
        undamped = replace(oscillator.with_parameters(dict.fromkeys(flow.small_parameters, 0)), small=None)
        if not undamped.closes:
            return FlowLimits(of, None, f"{flow.system} still loses or gains energy there")
        return FlowLimits(of, replace(_settled(undamped, flow.order, flow.amplitude), variable="a"), "")
    except FirstAmplitudeError as refusal:
        return FlowLimits(of, None, refusal.why)
    except InputError as refusal:
        return FlowLimits(of, None, str(refusal))


def _none_small(flow: SlowFlow) -> str:
    names = ", ".join(f"{name} = 0" for name in flow.small_parameters)
    return f" with {names}" if names else ""


@lru_cache(maxsize=8)
def _settled(oscillator: Oscillator, order: int, amplitude: str) -> Limits:
    """The limits of the series of this order, by its coefficients far beyond; of symbolic ones nothing is known."""
    series = lindstedt(oscillator, max(order, 1), amplitude=amplitude)
    if series.names:
        return limits(series)
    far = SETTLING[amplitude]
    found = limits(series, longer=series if order >= far else lindstedt(oscillator, far, amplitude=amplitude))
    if found.radius is None and "settle" in found.why:
        why = f"{max(order, far)} powers of {found.variable} do not settle the nearest singularity"
        return replace(found, why=why.replace(" A ", f" the {amplitude} amplitude "))
    return found
