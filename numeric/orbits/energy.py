"""Energy terms (15)-(19) along a trajectory, and the amplitude (20)-(21) that the energy allows.

The amplitude of (20)-(21) takes the *instantaneous* energy.  Energy is lost where |u'| is large, twice per cycle,
so that A(t) descends in steps about the smooth decay: a ripple of relative size mu/k that is a property of (21), not
an error of the computation.  ``averaging`` gives the smooth decay.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array, as_rows, frozen
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.motion.trajectory import Trajectory
from ridgeback.numeric.orbits.action_loss import damping_force
from ridgeback.numeric.orbits.potential import peak_of_potential, potential_at, restoring_of, trough

_GAUSS_POINTS = 8  # exact to degree 15: beyond the dense output, a polynomial of degree 7, squared


@dataclass(frozen=True, repr=False)
class EnergyTerms(Displayed):
    """The terms of the energy balance at the samples of a trajectory, per unit of mass.

    Parameters
    ----------
    name : str
        The oscillator's.
    time : array of float, shape (N,)
        Sample times.
    kinetic : array of float, shape (N,)
        E_k = u'^2 / 2, eq. (16).
    potential : array of float, shape (N,)
        E_p = V(u) - V(u(0)), eq. (17).
    dissipated : array of float, shape (N,)
        E_d = the integral of u' d(u, u') from 0, d what damps: 2 mu times that of u'^2, eq. (18), for linear damping.
    mechanical : array of float, shape (N,)
        E_m = E_k + E_p, eq. (19).
    balance : array of float, shape (N,)
        E_k + E_p + E_d - E_k(0): zero by eq. (15), here the error of solver and quadrature together.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> from ridgeback.numeric.motion.trajectory import integrate
    >>> terms = energy_terms(linear(), integrate(linear(), (1.0, 0.0), duration=10.0, rate=8.0))
    >>> round(float(terms.kinetic.max()), 2), float(terms.dissipated.max())
    (0.5, 0.0)
    """

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    name: str
    time: Array
    kinetic: Array
    potential: Array
    dissipated: Array
    mechanical: Array
    balance: Array

    def rows(self) -> list[dict[str, float]]:
        """One row per sample."""
        columns = {
            "time_s": self.time,
            "kinetic_energy": self.kinetic,
            "potential_energy": self.potential,
            "dissipated_energy": self.dissipated,
            "mechanical_energy": self.mechanical,
            "energy_balance": self.balance,
        }
        return as_rows(columns)

    def headline(self) -> str:
        """What was lost, and how well the balance closes."""
        return (
            f"{self.name}, energy per unit of mass at {self.time.size} samples, {self.dissipated[-1]:.6g} dissipated, "
            f"balance within {np.abs(self.balance).max():.1e}"
        )

    def picture(self) -> Picture:
        """The terms over time."""
        parts = {"kinetic": self.kinetic, "potential": self.potential, "dissipated": self.dissipated}
        strokes = tuple(Stroke(self.time, part, label) for label, part in parts.items())
        return Picture(f"{self.name}, energy per unit of mass", "time, s", "energy per unit of mass", strokes)


@dataclass(frozen=True)
class Amplitude:
    """Both turning points of the undamped motion at some energy; ``peak`` is the paper's A(t)."""

    peak: Array
    trough: Array


def is_linearly_damped(dynamics: Dynamics, size: float) -> bool:
    """Whether f(u, u') = V'(u) + 2 mu u', checked at a few states within ``size`` of rest.

    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> is_linearly_damped(pendulum(mu=0.1), 1.0)
    True
    """
    restoring, k = restoring_of(dynamics), dynamics.natural_frequency
    return all(
        abs(dynamics.force(u, v) - float(restoring(u)) - 2 * dynamics.damping * v) <= 1e-9 * k * (k * abs(u) + abs(v))
        for u, v in ((a * size, b * size * k) for a, b in ((0.1, 0.1), (0.1, -0.2), (-0.5, 0.1), (0.2, 0.6)))
    )


def energy_terms(dynamics: Dynamics, trajectory: Trajectory) -> EnergyTerms:
    """Return the terms (15)-(19) of the energy balance at the samples of a trajectory.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator that the trajectory is of.
    trajectory : Trajectory
        The motion.

    Returns
    -------
    EnergyTerms
        Kinetic, potential, dissipated and mechanical energy, and what the balance misses, each of shape (N,).

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> from ridgeback.numeric.motion.trajectory import integrate
    >>> oscillator = linear(k=1.0, mu=0.1)
    >>> terms = energy_terms(oscillator, integrate(oscillator, (1.0, 0.0), duration=10.0, rate=8.0))
    >>> bool(np.abs(terms.balance).max() < 1e-11)
    True
    """
    level = potential_at(dynamics, trajectory.u)
    kinetic = 0.5 * trajectory.velocity**2
    potential = level - level[0]
    dissipated = _dissipated(dynamics, trajectory)
    mechanical = kinetic + potential
    return EnergyTerms(
        name=dynamics.name,
        time=trajectory.time,
        kinetic=frozen(kinetic),
        potential=frozen(potential),
        dissipated=frozen(dissipated),
        mechanical=frozen(mechanical),
        balance=frozen(mechanical + dissipated - kinetic[0]),
    )


def _dissipated(dynamics: Dynamics, trajectory: Trajectory) -> Array:
    """Integral of the power lost from 0 to each sample: Gauss-Legendre between all steps and samples."""
    edges = np.union1d(trajectory.steps, trajectory.time)
    edges = edges[edges <= trajectory.duration]
    x, w = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    width = np.diff(edges)
    points = edges[:-1, None] + 0.5 * (1 + x) * width[:, None]
    u, velocity = trajectory.at(points.ravel())
    if is_linearly_damped(dynamics, float(np.abs(u).max())):
        lost = 2 * dynamics.damping * velocity**2
    else:
        lost = velocity * damping_force(dynamics, u, velocity)
    pieces = 0.5 * width * (lost.reshape(points.shape) @ w)
    total = np.concatenate(([0.0], np.cumsum(pieces)))
    return np.asarray(total[np.searchsorted(edges, trajectory.time)])


def energy_of(dynamics: Dynamics, u: ArrayLike, velocity: ArrayLike) -> Array:
    """Return the mechanical energy E = u'^2 / 2 + V(u), counted from the bottom of the well.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    u, velocity : array of float, shape (N,)
        States.

    Returns
    -------
    array of float, shape (N,)
        Per unit of mass.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> energy_of(linear(k=2.0), [1.0], [2.0])
    array([4.])
    """
    v = np.atleast_1d(np.asarray(velocity, dtype=float))
    return np.asarray(0.5 * v**2 + potential_at(dynamics, u))


def amplitude_from_energy(dynamics: Dynamics, energy: ArrayLike) -> Amplitude:
    """Return both turning points of the undamped motion with an energy, eq. (20): V(A) = E, in any potential.

    Parameters
    ----------
    dynamics : Dynamics
        The oscillator with numbers, which has a potential.
    energy : array of float, shape (M,)
        Counted from the bottom of the well.

    Returns
    -------
    Amplitude
        ``peak`` above and ``trough`` below zero, each of shape (M,).

    Raises
    ------
    InputError
        At or above the separatrix.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import pendulum
    >>> round(float(amplitude_from_energy(pendulum(), [1.0 - np.cos(2.0)]).peak[0]), 14)
    2.0
    """
    peak = peak_of_potential(dynamics, energy)
    return Amplitude(peak=frozen(peak), trough=trough(dynamics, peak))
