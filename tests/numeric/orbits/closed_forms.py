"""Closed forms of the pendulum that its tests hold the general code against."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import agm
from ridgeback.numeric.orbits.paper_model import modulus


def pendulum_amplitude(mechanical: ArrayLike, *, k: float, theta0: float) -> Array:
    """Return A = arccos(-E_m / k^2 + cos(theta0)) as eq. (21) is printed, E_m by (19), relative to theta0.

    Raises InputError where E_m would carry the pendulum over the top.

    >>> round(float(pendulum_amplitude([0.0], k=2.0, theta0=1.0)[0]), 15)
    1.0
    """
    cosine = -np.atleast_1d(np.asarray(mechanical, dtype=float)) / k**2 + np.cos(theta0)
    if not np.all((cosine > -1) & (cosine <= 1 + 1e-12)):
        raise InputError(f"energy {np.max(mechanical):.6g} is outside the pendulum's well; it would rotate")
    return frozen(np.arccos(np.minimum(cosine, 1.0)))


def pendulum_harmonics(peak: ArrayLike, *, count: int = 9) -> Array:
    """Return the exact Fourier amplitudes ``[m, amplitude]``, m = 0..count, of the undamped pendulum from its peak.

    theta = 8 sum_n (-1)^n q^(n + 1/2) / ((2n + 1) (1 + q^(2n + 1))) cos((2n + 1) omega0 t), with the nome
    q = exp(-pi K'/K): the integral of theta' = 2 k z cn, DLMF 22.11.2.  K'/K = agm(1, cos(A/2)) / agm(1, sin(A/2)).

    >>> pendulum_harmonics([0.1], count=3)[1].round(9).tolist()
    [0.100005211]
    """
    z = modulus(peak)
    cosine = np.cos(0.5 * np.atleast_1d(np.asarray(peak, dtype=float)))
    with np.errstate(divide="ignore"):
        nome = np.where(z > 0, np.exp(-np.pi * agm(1.0, cosine) / agm(1.0, np.where(z > 0, z, 1.0))), 0.0)
    table = np.zeros((count + 1, z.size))
    for n in range((count + 1) // 2):
        m = 2 * n + 1
        table[m] = 8 * (-1) ** n * nome ** (0.5 * m) / (m * (1 + nome**m))
    return frozen(table)
