r"""Whether a state of a slow flow lies within the reach of its order.

The flow is a truncated series, and far out its terms no longer fall; a zero of a'/a found there is one of the
polynomial and not of the oscillator.  Two things are asked of a state (a, m):

* how much the terms of the last two orders change what is said of it.  Terms d of a'/a move a fixed point by
  da/a = -d / (a d(a'/a)/da), terms w of phi' the frequency by w / phi'.  A relative change c by the n-th correction
  lets c^((n + 1)/n) be expected of the next one (the root test); two are looked at, since one may be small by accident;
* whether it lies inside the circle of convergence of the frequency that the flow contains (``flow.limits``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from ridgeback.symbolic.arithmetic.rendering import nearest
from ridgeback.symbolic.flow.slow_flow import SlowFlow, amplitude_powers
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.singularities.limits import Limits

LARGEST: Final = 0.02
"""Relative change expected of the next order beyond which a state is out of reach."""
NEAR: Final = 0.1
"""A state counts as a fixed point where a'/a is less than this part of its slope in ln a."""


@dataclass(frozen=True)
class Reach:
    """How much the last two orders change a state, relatively, and why it is out of reach; empty where it is not."""

    change: float | None
    """None where the order holds no correction to judge by."""
    why: str

    @property
    def beyond(self) -> bool:
        """Whether the state is out of reach, so that nothing is known of it."""
        return bool(self.why)


def reach_of(flow: SlowFlow, a: float, small: Sequence[float], *, limits: Limits | None = None) -> Reach:
    """Judge a state of the flow by its last terms and by the limits of the frequency in it.

    Parameters
    ----------
    flow : SlowFlow
        The truncated slow flow; of a self-excited oscillator ``flow.entire()``.
    a : float
        The fundamental amplitude, in the unit of u.
    small : sequence of float
        Values of the small parameters, in the order of ``flow.small_parameters``.
    limits : Limits or None
        What ``flow.limits.flow_limits`` found, where it is known.

    Returns
    -------
    Reach
        The largest relative change by the terms of the last two orders, and why that is too much.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow = multiple_scales(find("damped-pendulum"), 6)
    >>> reach_of(flow, 0.5, (0.01,)).beyond, reach_of(flow, 6.0, (0.01,)).why
    (False, 'the terms of its last orders still change what it says by ... %')
    """
    outside = _outside(a, small, limits)
    changes = _changes(flow, a, small)
    if not changes:
        return Reach(None, outside)
    change = max(changes[-2:])
    rank = max(1, len(changes) - 1)
    if not change ** ((rank + 1) / rank) <= LARGEST:
        return Reach(
            change, outside or f"the terms of its last orders still change what it says by {100 * change:.2g} %"
        )
    return Reach(change, outside)


def _outside(a: float, small: Sequence[float], limits: Limits | None) -> str:
    if limits is None or limits.radius is None:
        return ""
    name, value = ("a", a) if limits.variable == "a" else (limits.variable, abs(small[0]))  # else a limit cycle's eps
    if value < limits.radius:
        return ""
    return f"{name} = {value:.4g} is outside the circle of convergence, {limits.radius:.4g}"


def _changes(flow: SlowFlow, a: float, small: Sequence[float]) -> list[float]:
    """The relative change of the state by the terms of each weighted degree that corrects it.

    The lowest terms of a'/a that balance at a fixed point, and k, are what is corrected.
    """
    omega, bend = _value(flow.frequency, a, small)
    rate, slope = _value(flow.growth_rate, a, small)
    fixed = abs(rate) < NEAR * abs(a * slope)
    drift, turn = _by_degree(flow, flow.growth_rate), _by_degree(flow, flow.frequency)
    balanced = sorted(drift)[: 2 if fixed and flow.highest is None else 1]
    moved = max(1.0, abs(a * bend / omega)) / abs(a * slope) if fixed else 1 / abs(omega)
    found: dict[int, float] = {}
    for degree in sorted(set(drift) - set(balanced)):
        rank = degree - (min(drift) if fixed else 0)
        found[rank] = abs(_value(drift[degree], a, small)[0]) * moved
    for degree in sorted(set(turn) - {0}):
        found[degree] = found.get(degree, 0.0) + abs(_value(turn[degree], a, small)[0] / omega)
    return [found[rank] for rank in sorted(found)]


def _by_degree(flow: SlowFlow, terms: tuple[Term, ...]) -> dict[int, tuple[Term, ...]]:
    """Terms by the power of the small parameter where powers are complete, else by weighted degree."""
    found: dict[int, tuple[Term, ...]] = {}
    for term in terms:
        weighted = term.powers[0] + sum(w * r for w, r in zip(flow.weights.values(), term.powers[1:], strict=True))
        degree = term.powers[1] if flow.highest is not None else weighted
        found[degree] = (*found.get(degree, ()), term)
    return found


def _value(terms: tuple[Term, ...], a: float, small: Sequence[float]) -> tuple[float, float]:
    """The sum of terms and its slope in a."""
    powers = amplitude_powers(tuple((nearest(t.coefficient), t.powers) for t in terms), tuple(small))
    return sum(c * a**n for n, c in enumerate(powers)), sum(n * c * a ** (n - 1) for n, c in enumerate(powers) if n)
