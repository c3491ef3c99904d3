"""Polynomial forces without a linear part, such as u'' + u^3 = 0: their well.

omega0 vanishes with the amplitude, so there is no natural frequency.  The orbits close all the same when the lowest
term of the force is odd and restores, and their frequency has an enclosure like any other.
"""

from __future__ import annotations

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.enclosure.well import Well, exact_polynomial
from ridgeback.symbolic.systems.oscillator import Oscillator, V
from ridgeback.symbolic.systems.structure import free_names

GUARD = 40


def strong_well(oscillator: Oscillator) -> Well | None:
    """The well of a polynomial force without a linear term, in the oscillator's own units; None for other forces.

    Raises InputError for terms in u', and parameters without a value.
    """
    name, force = oscillator.name, sympy.expand(oscillator.substituted_force)
    if force.has(V):
        raise InputError(
            f"{name}: with terms in u' and no linear restoring force there is no enclosure; leave them out"
        )
    if unset := free_names(force):
        raise InputError(f"{name}: an enclosure needs numbers, and {', '.join(unset)} has none; set it, e.g. to 1")
    potential = oscillator.substituted_potential
    exact = None if potential is None else exact_polynomial(sympy.expand(potential))
    if potential is None or exact is None:
        return None
    even = all(exact[j] == 0 for j in range(1, exact.degree() + 1, 2))
    inertia, drag, scale = sympy.S.One, sympy.S.Zero, sympy.S.One
    return Well(name, force, potential, inertia, drag, scale, even=even, polynomial=exact)
