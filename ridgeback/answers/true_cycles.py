"""The true limit cycles beside fixed points of a slow flow that lie beyond its reach: enclosed, where they can be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ridgeback.symbolic.certificates.at_amplitudes import Refused
    from ridgeback.symbolic.certificates.at_cycles import CertifiedCycle
    from ridgeback.symbolic.flow.fixed_points import FixedPoint
    from ridgeback.symbolic.flow.slow_flow import SlowFlow
    from ridgeback.symbolic.systems.oscillator import Oscillator

DIGITS = 20
BITS = 80


def true_cycles(
    oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]
) -> tuple[CertifiedCycle | Refused, ...]:
    """Enclose the limit cycles at the oscillator's own parameters, where the fixed points do not tell of them.

    That is so when one that belongs to a series lies beyond the reach of the order; of others only if there is none.
    """
    telling = [point for point in points if point.square_series is not None] or points
    if not any(point.reach.beyond for point in telling):
        return ()
    from fractions import Fraction

    from ridgeback.symbolic.certificates.at_cycles import certified_cycles

    name = next(iter(flow.weights))
    value = oscillator.parameters[name]
    if value is None:
        return ()
    return certified_cycles(oscillator, [Fraction(int(value.p), int(value.q))], small=name, bits=BITS)


def cycle_rows(oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]) -> dict[str, object]:
    """The rows in JSON, when there are any."""
    found = true_cycles(oscillator, flow, points)
    return {"limit_cycles": [row.to_dict(DIGITS) for row in found]} if found else {}


def cycle_lines(oscillator: Oscillator, flow: SlowFlow, points: Sequence[FixedPoint]) -> str:
    """The same in words, a line each."""
    return "".join(_line(row.to_dict(DIGITS)) for row in true_cycles(oscillator, flow, points))


def _line(row: dict[str, object]) -> str:
    if row["omega0"] is None:
        return f"\nno true limit cycle is enclosed: {row['refused']}\n"
    return (
        f"\ntrue limit cycle, enclosed: peak = {row['amplitude']}, omega0 = {row['omega0']} within {row['radius']}, "
        f"{'stable' if row['stable'] else 'unstable'}\n"
    )
