"""The signal against its models: one component, eq. (22)-(23), and several, eq. (7)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.results import Reconstruction
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.paper_model import (
    MulticomponentModel,
    multicomponent_model,
    phase_of_samples,
    simple_model,
)

COMPONENTS = 9
"""Multiples of the fundamental in the multicomponent model."""


def model_phase(motion: Motion, omega: Array) -> Array:
    """phi0(t) by eq. (23), zero at a peak: the initial state's own phase plus the integral of omega."""
    start = 0.0 if motion.averaged is None else motion.averaged.start.phase
    return start + phase_of_samples(motion.time, omega)


def reconstruct(motion: Motion) -> Reconstruction:
    """Build both models with the energy's A(t) and the exact omega0 there; a limit cycle has its envelope and phase."""
    u = motion.trajectory.u
    if not motion.has_backbone:
        return _of_limit_cycle(motion)
    omega = motion.exact_at_energy
    phase = model_phase(motion, omega)
    single = simple_model(motion.time, motion.energy_peak, omega, phase).signal
    several = multicomponent_model(motion.dynamics, motion.time, motion.energy_peak, omega, phase, count=COMPONENTS)
    return Reconstruction(
        time=motion.time,
        signal=u,
        single=single,
        multicomponent=several.signal,
        components=COMPONENTS,
        rms_single=relative_rms(single - u, u),
        rms_multicomponent=relative_rms(several.signal - u, u),
        note="Real parts; A(t) by the energy of each instant, phase by the integral of ω₀(t).",
    )


def _of_limit_cycle(motion: Motion) -> Reconstruction:
    """One component on the cycle phase, which is zero a quarter cycle before a falling crossing."""
    u = motion.trajectory.u
    phase = phase_of_samples(motion.time, motion.known_omega)
    first = float(np.interp(motion.rising[0], motion.time, phase))
    single = motion.energy_peak * np.sin(phase - first)
    return Reconstruction(
        time=motion.time,
        signal=u,
        single=single,
        multicomponent=None,
        components=1,
        rms_single=relative_rms(single - u, u),
        rms_multicomponent=None,
        note="Envelope of the turning points, phase from the cycle frequency.",
    )


def relative_rms(difference: Array, signal: Array) -> float:
    """Rms of the difference divided by rms of the signal.

    >>> relative_rms(np.array([0.1, -0.1]), np.array([1.0, 1.0]))
    0.1
    """
    return float(np.sqrt(np.mean(difference**2) / np.mean(signal**2)))


@dataclass(frozen=True)
class KnownMotion:
    """A signal with the harmonics of the real one, whose omega0(t) is known exactly by construction."""

    omega: Array
    signal: Array
    velocity: Array
    fundamental: Array
    """The first harmonic alone, at constant amplitude 1."""


def known_motion(motion: Motion) -> KnownMotion | None:
    """Synthesise the motion from the averaged action; None for oscillators without a potential."""
    if motion.averaged is None:
        return None
    omega = motion.averaged.omega
    phase = model_phase(motion, omega)
    model = multicomponent_model(motion.dynamics, motion.time, motion.averaged.peak, omega, phase, count=COMPONENTS)
    return KnownMotion(omega, model.signal, _slope(model, omega, phase), np.cos(phase))


def _slope(model: MulticomponentModel, omega: Array, phase: Array) -> Array:
    """Rate of change at constant amplitude: what makes the harmonics of u' stronger by their multiple."""
    parts = [-c.multiple * c.amplitude * np.sin(c.multiple * phase) for c in model.components]
    return np.asarray(omega * np.sum(parts, axis=0))
