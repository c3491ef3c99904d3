"""What contenders are held against: the paper's series by terms, the exact backbone and the linear oscillator."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np

from ridgeback.compare.benchmark.contenders import Row, Source
from ridgeback.compare.benchmark.ways.contender import Contender
from ridgeback.compare.benchmark.ways.timing import NOT_TIMED, per_value, repeated
from ridgeback.compare.motion.motion import Motion, exact_omega
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.numeric.orbits.energy import is_linearly_damped
from ridgeback.numeric.orbits.paper_model import series_frequency

TERMS = (3, 5, 11, 21, 41)
"""Terms of the paper's eq. (14): the three that it prints, and as many coefficients as some orders have."""


def yardsticks(motion: Motion, sources: Mapping[Source, Array], *, timed: bool = True) -> Iterator[Contender]:
    """The series model and the exact omega0 at each amplitude, and the linear frequency."""
    for source, x in sources.items():
        if motion.setting.is_pendulum:
            yield from series_model(motion, source, x, timed=timed)
    if motion.has_backbone:
        yield exact_at_energy(motion, timed=timed)
    yield from averaged(motion, timed=timed)
    k, mu = motion.dynamics.natural_frequency, motion.dynamics.damping
    flat = np.full(motion.time.size, np.sqrt(max(k * k - mu * mu, 0.0)))
    yield Contender(Row("linear", "linear oscillator", "linear"), flat)


def series_model(motion: Motion, source: Source, x: Array, *, timed: bool = True) -> Iterator[Contender]:
    """The paper's series, eq. (14), by its number of terms."""
    for terms in TERMS:
        function = partial(series_frequency, k=motion.dynamics.natural_frequency, terms=terms)
        cost = per_value(function, x) if timed else NOT_TIMED
        row = Row(
            f"series-{terms}-{source}",
            f"paper's series, {terms} terms, A(t) from the {source}",
            "series-model",
            order=terms,
            coefficients=terms,
            amplitude_from=source,
            language="numpy",
            time_ns_per_value=1e9 * cost.seconds,
            time_scatter=cost.scatter,
        )
        yield Contender(row, np.asarray(function(x)))


def exact_at_energy(motion: Motion, *, timed: bool = True) -> Contender:
    """The exact omega0 at the energy's A(t): by closed form, or by quadrature, which is timed on the samples alone."""
    closed = motion.dynamics.closed_form
    x = motion.energy_peak
    if not timed:
        cost = NOT_TIMED
    elif closed is None:
        cost = per_value(partial(exact_omega, motion.dynamics), x, values=x.size)
    else:
        cost = per_value(closed, x)
    row = Row(
        "closed-form",
        "exact omega0 at A(t) from the energy",
        "closed-form",
        amplitude_from="energy",
        time_ns_per_value=1e9 * cost.seconds,
        time_scatter=cost.scatter,
    )
    return Contender(row, motion.exact_at_energy)


# omega0(J(t)), J' = the averaged loss of action; omega_c = sqrt(omega0^2 - mu^2), eq. (3) at a finite amplitude
def averaged(motion: Motion, *, timed: bool = True) -> Iterator[Contender]:
    """The exact omega0 of the averaged action, which needs no trajectory, and the same under linear damping."""
    if motion.averaged is None:
        return
    again = partial(averaged_decay, motion.dynamics, motion.setting.initial, motion.time)
    cost = repeated(again, laps=(motion.averaged_seconds,)) if timed else NOT_TIMED
    ways = {"averaged-action": ("exact omega0 of the averaged action", motion.averaged.omega)}
    mu = motion.dynamics.damping
    if mu and is_linearly_damped(motion.dynamics, float(motion.averaged.peak[0])):
        omega = np.sqrt(np.maximum(motion.averaged.omega**2 - mu * mu, 0.0))
        ways["averaged-damped"] = ("sqrt(omega0^2 - mu^2) of the averaged action", omega)
    for method, (label, omega) in ways.items():
        row = Row(
            method,
            label,
            "averaged",
            amplitude_from="action",
            time_s_per_track=cost.seconds,
            time_ns_per_value=1e9 * cost.per(motion.time.size).seconds,
            time_scatter=cost.scatter,
        )
        yield Contender(row, omega)
