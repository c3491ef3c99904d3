"""The series that a study truncates, by method, all evaluated on the same motions.

A study's amplitudes are peak amplitudes.  Lindstedt-Poincaré and the energy integral expand in them directly;
multiple scales expands in the fundamental amplitude, so it is evaluated at the first harmonic of the very orbit that
has this peak: the methods are compared on one motion, not at equal numbers that mean different things.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.study.derived import Derived, Undamped
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.waveform import orbit_harmonics
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.singularities.limits import Limits, limits
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.oscillator import Oscillator


@dataclass(frozen=True)
class Truncations:
    """omega0 by order on a grid, ``omega[order, amplitude]``, and what is known of the whole series."""

    omega: Array
    variable: str
    amplitude: str
    scale: float
    radius: float | None
    uncertainty: float | None
    note: str


Method = Callable[[Undamped, Sequence[int], Array], Truncations]


def by_lindstedt(rest: Undamped, orders: Sequence[int], grid: Array) -> Truncations:
    """Lindstedt-Poincaré in the peak amplitude, or in eps for a limit cycle."""
    return of_expansion(lindstedt(rest.oscillator, max(orders)), orders, grid)


def by_energy_integral(rest: Undamped, orders: Sequence[int], grid: Array) -> Truncations:
    """The energy integral in the peak amplitude, on each side of rest where the force has a kink there."""
    own = rest.oscillator
    derive = energy_on_each_side if own.by_sides else energy_integral
    expansion = derive(own, max(orders))
    return of_expansion(expansion, orders, grid, settled_limits(own, expansion) if own.by_sides else None)


def usual_method(oscillator: Oscillator) -> str:
    """The method that suits an oscillator whose damping is left out.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> usual_method(find("pendulum")), usual_method(Oscillator.from_equation("u'' + u*abs(u) = 0"))
    ('lindstedt', 'energy-integral')
    """
    return "energy-integral" if oscillator.by_sides and oscillator.is_conservative else "lindstedt"


def already_derived(derived: Derived) -> Method:
    """The method lindstedt for a series that is there already, of at least the highest order studied."""
    return lambda _, orders, grid: of_expansion(derived.expansion, orders, grid, derived.limits)


def of_expansion(
    expansion: Expansion | PowerExpansion, orders: Sequence[int], grid: Array, found: Limits | None = None
) -> Truncations:
    """Truncations of one series; ``found`` saves looking for its limits again."""
    if found is None:
        found = limits(expansion.beside_leading() if isinstance(expansion, PowerExpansion) else expansion)
    scale = expansion.lead if isinstance(expansion, PowerExpansion) else expansion.scale
    return Truncations(
        omega=np.stack([np.asarray(expansion.truncated(order)(grid), dtype=float) for order in orders]),
        variable=expansion.variable,
        amplitude=expansion.amplitude,
        scale=float(scale),
        radius=found.radius,
        uncertainty=found.uncertainty,
        note=found.sentence(),
    )


def by_multiple_scales(rest: Undamped, orders: Sequence[int], grid: Array) -> Truncations:
    """Multiple scales without damping, at the fundamental amplitude of the orbit with each peak.

    Raises InputError for a limit cycle, whose slow flow holds for every amplitude and not for the cycle alone.
    """
    oscillator = rest.oscillator
    if oscillator.kind == "limit-cycle":
        raise InputError(f"{oscillator.name} is a limit cycle; study it with the method lindstedt, in eps")
    flow = multiple_scales(oscillator, max(orders))
    fundamental = orbit_harmonics(rest.dynamics, grid, count=1).cosine[1]
    powers = {term.powers[0]: float(term.coefficient) for term in flow.frequency if not any(term.powers[1:])}
    coefficients = np.array([powers.get(n, 0.0) for n in range(max(orders) + 1)])
    values = [np.polynomial.polynomial.polyval(fundamental, coefficients[: order + 1]) for order in orders]
    note = "Multiple scales in the fundamental amplitude, evaluated at that of the orbit with each peak amplitude."
    return Truncations(np.stack(values), "A", "peak", float(flow.scale), None, None, note)


METHODS: Mapping[str, Method] = {
    "lindstedt": by_lindstedt,
    "energy-integral": by_energy_integral,
    "multiple-scales": by_multiple_scales,
}
