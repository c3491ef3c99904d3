"""The ways to omega0(t) of a motion that come from theory, by name and order."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.contenders import Source
from ridgeback.compare.benchmark.ways.contender import amplitudes
from ridgeback.compare.motion.error_budget import damped
from ridgeback.compare.motion.model_curves import slow_flow_amplitude
from ridgeback.compare.studies.measures.along import Case, Curve
from ridgeback.compare.studies.systems import System
from ridgeback.compare.study.derived import without_damping
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.paper_model import series_frequency
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.resummation.by_name import KINDS, resum

SOURCES: tuple[Source, ...] = ("energy", "action")
"""Where A(t) comes from: the instantaneous energy (21), or the averaged action."""
SERIES = ("lindstedt", "energy-integral", "series", *KINDS)
PLAIN = ("multiple-scales", "closed-form/energy", "averaged-action", "linear")
PREDICTIONS = (*(f"{name}/{source}" for name in SERIES for source in SOURCES), *PLAIN)
"""``lindstedt`` and its resummations by order, ``series`` is the paper's (14) by its number of terms."""


def takes_orders(method: str) -> bool:
    """Whether a method has an order.

    >>> takes_orders("series/action"), takes_orders("linear"), takes_orders("pseudo-wigner")
    (True, False, False)
    """
    return method.partition("/")[0] in (*SERIES, "multiple-scales")


def predicted(case: Case, method: str, order: int | None, highest: int) -> Curve:
    """omega0 on the samples of a motion.

    Parameters
    ----------
    case : Case
        The motion, of which a prediction sees the amplitude at most.
    method : str
        One of ``PREDICTIONS``.
    order : int, optional
        Highest power kept, or number of terms, for a method that has one.
    highest : int
        The largest order that is asked for: a series is derived once.

    Raises
    ------
    InputError
        For what the method or the oscillator does not allow.
    """
    name, _, source = method.partition("/")
    if name == "multiple-scales" and order is not None:
        return _slow_flow(case, order)
    omega = _PLAIN[method](case) if order is None else _SERIES[name](case, source, order, highest)
    return Curve(omega, exact=exact_for(case, method))


def exact_for(case: Case, method: str) -> Array | None:
    """The exact frequency at the amplitude that a method uses; None where the motion has none."""
    motion = case.motion
    if not motion.has_backbone:
        return None
    at_action = method.endswith("/action") or method in ("multiple-scales", "averaged-action")
    if at_action and motion.averaged is None:
        return None
    exact = motion.averaged.omega if at_action and motion.averaged is not None else motion.exact_at_energy
    return damped(motion, exact) if method in ("multiple-scales", "linear") else exact


def _amplitude(case: Case, source: str) -> Array:
    found = amplitudes(case.motion)
    if source in SOURCES and source in found:
        return found[source]
    raise InputError(f"{case.motion.dynamics.name} has no A(t) from the {source}: {', '.join(found)} only")


def _by_energy(case: Case, source: str, order: int, highest: int) -> Array:
    series = energy_integral(without_damping(case.system.oscillator()).oscillator, highest)
    return np.asarray(series.truncated(order)(_amplitude(case, source)), dtype=float)


def _truncated(case: Case, source: str, order: int, highest: int) -> Array:
    series = _series(case.system, highest)
    if series.variable == "eps":
        name = case.motion.setting.oscillator.small or "eps"
        eps = case.motion.setting.case().parameters[name]
        return np.full(case.time.size, float(series.truncated(order)(eps)))
    return np.asarray(series.truncated(order)(_amplitude(case, source)), dtype=float)


def _resummed(kind: str) -> Callable[[Case, str, int, int], Array]:
    def along(case: Case, source: str, order: int, highest: int) -> Array:
        x = _amplitude(case, source)
        series = _series(case.system, highest).truncated(order)
        formula = resum(
            without_damping(case.system.oscillator()).oscillator, series, kind, up_to=Fraction(float(np.nanmax(x)))
        )
        return np.asarray(formula(x), dtype=float)

    return along


def _terms(case: Case, source: str, order: int, _: int) -> Array:
    if not case.motion.setting.is_pendulum:
        raise InputError(f"{case.motion.dynamics.name} is no pendulum; the series (14) is of k^2 sin(u)")
    if order < 1:
        raise InputError("the series (14) has one term or more")
    return series_frequency(_amplitude(case, source), k=case.motion.dynamics.natural_frequency, terms=order)


def _slow_flow(case: Case, order: int) -> Curve:
    flow = _flow(case.system, order)
    small = [float(value) for value in flow.values(case.motion.setting.oscillator.parameters)]
    amplitude = slow_flow_amplitude(case.motion, flow)
    omega = np.full(case.time.size, np.nan)
    omega[: amplitude.size] = flow.frequency_at(amplitude, *small)
    return Curve(omega, amplitude, exact_for(case, "multiple-scales"))


def _exact(case: Case) -> Array:
    if not case.motion.has_backbone:
        raise InputError(f"{case.motion.dynamics.name} has no potential, so no frequency for each energy")
    return case.motion.exact_at_energy


def _averaged(case: Case) -> Array:
    if case.motion.averaged is None:
        raise InputError(f"{case.motion.dynamics.name} has no averaged action")
    return case.motion.averaged.omega


# omega_c = sqrt(k^2 - mu^2), eq. (3)
def _linear(case: Case) -> Array:
    k, mu = case.motion.dynamics.natural_frequency, case.motion.dynamics.damping
    return np.full(case.time.size, np.sqrt(max(k * k - mu * mu, 0.0)))


_SERIES: Mapping[str, Callable[[Case, str, int, int], Array]] = {
    "lindstedt": _truncated,
    "energy-integral": _by_energy,
    "series": _terms,
    **{kind: _resummed(kind) for kind in KINDS},
}
_PLAIN: Mapping[str, Callable[[Case], Array]] = {
    "closed-form/energy": _exact,
    "averaged-action": _averaged,
    "linear": _linear,
}


@lru_cache(maxsize=16)
def _series(system: System, order: int) -> Expansion:
    return lindstedt(without_damping(system.oscillator()).oscillator, order)


@lru_cache(maxsize=64)
def _flow(system: System, order: int) -> SlowFlow:
    return multiple_scales(system.oscillator(), order)
