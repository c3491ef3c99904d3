"""Curves omega0(t) from theory: the paper's model, expansions at the energy's amplitude, averaged action, slow flow.

Each model maps an amplitude along the motion to a frequency; none looks at the reference.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.integrate import solve_ivp

from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.results import AmplitudeSource, Curve
from ridgeback.compare.study.derived import Derived
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.energy import is_linearly_damped
from ridgeback.numeric.orbits.paper_model import series_frequency
from ridgeback.numeric.orbits.waveform import orbit_harmonics
from ridgeback.symbolic.flow.reconstruction import Reconstruction
from ridgeback.symbolic.flow.slow_flow import SlowFlow

CLOSED_FORM, AVERAGED_ACTION, LINEAR = "closed-form", "averaged-action", "linear"
"""Names of the models that every oscillator with a potential has."""
SERIES_TERMS = (3, 20)
"""Terms of the paper's eq. (14) kept: the three that it prints, and enough for moderate angles."""
LOW_ORDERS = (2, 4)
"""The low-order perturbation expansions of Fig. 5."""


def expansion_name(order: int) -> str:
    """Name of the curve of the Lindstedt-Poincaré expansion of an order.

    >>> expansion_name(4)
    'lindstedt-4'
    """
    return f"lindstedt-{order}"


def model_curves(motion: Motion, derived: Derived | None, *, orders: Sequence[int]) -> tuple[Curve, ...]:
    """All models and expansions of this oscillator along this motion.

    ``orders`` are the orders of the expansion that are drawn (at most that of ``derived``); without one there is none.
    """
    if derived is not None and derived.expansion.variable == "eps":
        return tuple(_limit_cycle_curves(motion, derived, orders))
    return tuple(_conservative_curves(motion, derived, orders))


def _conservative_curves(motion: Motion, derived: Derived | None, orders: Sequence[int]) -> Iterator[Curve]:
    peak = motion.energy_peak
    if motion.has_backbone:
        yield _model(motion, CLOSED_FORM, _exact_label(motion), motion.exact_at_energy, by=AmplitudeSource.ENERGY)
    if motion.setting.is_pendulum:
        k = motion.dynamics.natural_frequency
        for terms in SERIES_TERMS:
            label = f"paper’s series, {terms} terms"
            omega = series_frequency(peak, k=k, terms=terms)
            yield _model(motion, f"series-{terms}", label, omega, by=AmplitudeSource.ENERGY)
    if motion.averaged is not None:
        linear = is_linearly_damped(motion.dynamics, float(motion.averaged.peak[0]))
        how = "J(t) = J₀ exp(−2μt)" if linear else "J(t) by the averaged loss of action"
        note = f"{how}; no integration of the equation."
        omega = motion.averaged.omega
        yield _model(motion, AVERAGED_ACTION, "averaged action", omega, note, by=AmplitudeSource.AVERAGED)
    yield _linear(motion)
    if derived is None:
        return
    for order in orders:
        yield _expansion(motion, derived, order, peak)
    if derived.flow is not None and motion.averaged is not None:
        yield slow_flow_curve(motion, derived.flow)


def _exact_label(motion: Motion) -> str:
    if motion.setting.is_pendulum:
        return "paper’s series, all terms"
    return "exact backbone at V(A) = E(t)"


def _model(
    motion: Motion,
    name: str,
    label: str,
    omega: Array,
    note: str = "",
    *,
    by: AmplitudeSource = AmplitudeSource.NONE,
) -> Curve:
    return Curve(name, label, "model", motion.time, omega, np.isfinite(omega), note=note, amplitude=by)


# omega_c = sqrt(k^2 - mu^2), eq. (3)
def _linear(motion: Motion) -> Curve:
    k, mu = motion.dynamics.natural_frequency, motion.dynamics.damping
    omega = np.full(motion.time.size, np.sqrt(max(k * k - mu * mu, 0.0)))
    return _model(motion, LINEAR, "linear oscillator", omega)


def _expansion(motion: Motion, derived: Derived, order: int, x: Array) -> Curve:
    omega = np.asarray(derived.expansion.truncated(order)(x), dtype=float)
    return Curve(
        expansion_name(order),
        f"expansion, order {order}",
        "expansion",
        motion.time,
        omega,
        np.isfinite(omega),
        note="Lindstedt-Poincaré in the peak amplitude, at A(t) from the energy.",
        amplitude=AmplitudeSource.ENERGY,
    )


def _limit_cycle_curves(motion: Motion, derived: Derived, orders: Sequence[int]) -> Iterator[Curve]:
    name = motion.setting.oscillator.small or "eps"
    eps = motion.setting.case().parameters[name]
    for order in orders:
        omega = np.full(motion.time.size, float(derived.expansion.truncated(order)(eps)))
        yield Curve(
            expansion_name(order),
            f"limit cycle, order {order}",
            "expansion",
            motion.time,
            omega,
            np.isfinite(omega),
            note="Frequency of the limit cycle itself; it says nothing about the transient.",
        )
    yield _linear(motion)


def slow_flow_amplitude(motion: Motion, flow: SlowFlow) -> Array:
    """Multiple scales: a(t) integrated from the slow flow, on the motion's samples as far as the flow reaches.

    The start is the averaged motion's own: the first harmonic of the undamped orbit with its action.  Without a
    potential it is the amplitude at which the slow flow itself passes the initial state.
    Raises InputError when the flow of this order does not reach that state.
    """
    small = [float(value) for value in flow.values(motion.setting.oscillator.parameters)]
    if motion.averaged is None:
        start, _ = Reconstruction(flow).start(*motion.setting.initial, *small)
    else:
        start = float(orbit_harmonics(motion.dynamics, motion.averaged.peak[:1], count=1).cosine[1, 0])
    solution = solve_ivp(
        lambda _, a: a * flow.growth_rate_at(a, *small),
        (float(motion.time[0]), float(motion.time[-1])),
        [start],
        t_eval=motion.time,
        rtol=1e-10,
        atol=1e-12 * start,
    )
    return np.asarray(solution.y[0])


def slow_flow_curve(motion: Motion, flow: SlowFlow) -> Curve:
    """Multiple scales: phi'(a, mu) along a(t); raises InputError as ``slow_flow_amplitude`` does."""
    small = [float(value) for value in flow.values(motion.setting.oscillator.parameters)]
    omega = np.asarray(flow.frequency_at(slow_flow_amplitude(motion, flow), *small), dtype=float)
    return Curve(
        f"multiple-scales-{flow.order}",
        f"multiple scales, order {flow.order}",
        "expansion",
        motion.time[: omega.size],
        omega,
        np.isfinite(omega),
        note="Slow flow in the fundamental amplitude, integrated; no energy and no trajectory enter.",
        amplitude=AmplitudeSource.AVERAGED,
    )
