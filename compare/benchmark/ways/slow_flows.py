"""The contenders by multiple scales: a(t) integrated from the slow flow, then phi'(a); no trajectory enters.

Order counts weighted degree in the amplitude.  A limit cycle has a finite amplitude, and every power of it belongs to
each power of eps: with a force whose terms in eps are of degree d in u and u', eps^n comes with a^((d - 1) n) at most,
so that with the weight w = (d - 1) n + 1 of eps the terms of weighted degree up to w n + (d - 1) n are those through
eps^n, each whole.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import number
from ridgeback.compare.benchmark.contenders import Row
from ridgeback.compare.benchmark.ways.contender import Contender, refused
from ridgeback.compare.benchmark.ways.timing import NOT_TIMED, repeated
from ridgeback.compare.motion.model_curves import slow_flow_curve
from ridgeback.compare.motion.motion import Motion
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.parameters import symbol_of

ORDERS = (2, 4, 6, 8)
IN_EPS = (2, 4, 6)
"""Orders in eps: the time grows with the cube of them."""


def slow_flows(motion: Motion, *, timed: bool = True) -> Iterator[Contender]:
    """Multiple scales by order."""
    small = powers_of(motion.setting.oscillator)
    for order in ORDERS if small is None else IN_EPS:
        label = f"multiple scales, order {order}" + ("" if small is None else f" in {small[0]}")
        try:
            flow = flow_of(motion.setting.oscillator, order)
            curve = slow_flow_curve(motion, flow)
            cost = repeated(partial(slow_flow_curve, motion, flow)) if timed else NOT_TIMED
        except (InputError, ValueError) as error:
            yield refused(f"multiple-scales-{order}", label, "slow-flow", str(error), order=order)
            continue
        ended = float(motion.time[curve.omega.size - 1]) if curve.omega.size else 0.0
        if ended < motion.zone.lower:
            why = (
                f"its amplitude equation cannot be integrated beyond t = {number(ended, 2)}: at this order it does not "
                "reach the amplitude of the start"
            )
            yield refused(f"multiple-scales-{order}", label, "slow-flow", why, order=order)
            continue
        omega = np.full(motion.time.size, np.nan)
        omega[: curve.omega.size] = curve.omega
        row = Row(
            f"multiple-scales-{order}",
            label,
            "slow-flow",
            order=order,
            coefficients=len(flow.frequency) + len(flow.growth_rate),
            time_s_per_track=cost.seconds,
            time_ns_per_value=1e9 * cost.per(motion.time.size).seconds,
            time_scatter=cost.scatter,
        )
        yield Contender(row, omega)


def flow_of(oscillator: Oscillator, order: int) -> SlowFlow:
    """The slow flow of an order: in weighted degree, or of a limit cycle in eps with every power of the amplitude.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow_of(find("van-der-pol"), 2).frequency_expression()
    -7*a**4*eps**2/256 + a**2*eps**2/8 - eps**2/8 + 1
    """
    small = powers_of(oscillator)
    if small is None:
        return multiple_scales(oscillator, order)
    name, degree = small
    rise = (degree - 1) * order
    weight = rise + 1
    return multiple_scales(oscillator, weight * order + rise, weights={name: weight})


def powers_of(oscillator: Oscillator) -> tuple[str, int] | None:
    """The eps of a limit cycle and the degree of its terms, where all else of the force is linear; else None."""
    name = oscillator.small
    if oscillator.kind != "limit-cycle" or name is None:
        return None
    values = {symbol_of(n): v for n, v in oscillator.parameters.items() if v is not None and n != name}
    force = sympy.expand(oscillator.force.subs(values))
    eps = symbol_of(name)
    if not force.is_polynomial(U, V, eps) or sympy.degree(force, eps) != 1:
        return None
    linear, others = force.coeff(eps, 0), force.coeff(eps, 1)
    if sympy.Poly(linear, U, V).total_degree() > 1:
        return None
    return name, sympy.Poly(others, U, V).total_degree()
