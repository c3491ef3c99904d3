"""``ridgeback.benchmark``: every way to omega0(t) of one motion, with its error and its cost."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.benchmark import benchmark as benchmarks
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.ways.expansions import ORDERS
from ridgeback.compare.benchmark.ways.outsiders import outsiders
from ridgeback.compare.motion.motion import setting
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value


def benchmark(
    oscillator: OscillatorLike,
    *,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    rate: float | None = None,
    orders: Sequence[int] = ORDERS,
    estimators: Mapping[str, Callable[[Any, float], Track]] | None = None,
    progress: Wanted = None,
) -> Benchmark:
    """Hold expansions, the paper's series model and estimates of one motion on one scale of error and cost.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Whose motion it is, in any of the forms that :func:`ridgeback.oscillator` takes.
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    initial : (float, float), optional
        State (u, u') at time 0.
    duration : float, optional
        Time to integrate over; 40 natural periods by default.
    rate : float, optional
        Samples per time unit; 32 in each natural period by default.
    orders : sequence of int
        Orders of the expansion.
    estimators : mapping, optional
        Estimators of your own that take part: name to a function ``(x, rate)`` that returns a Track.  Those of
        installed packages, by the entry point ``ridgeback.estimators``, take part in any case.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Benchmark
        Rows, each judged on one support against the cycle frequency; crossings; the verdict.

    Raises
    ------
    InputError
        For a motion that cannot be integrated, leaves its well or has too few cycles, and for orders below 0.

    Examples
    --------
    >>> found = benchmark("damped-pendulum", initial=(1.0, 0.0), duration=60.0, rate=5.0, orders=(2, 6))
    >>> found.row("lindstedt-6-action").relative_rms_error < found.row("lindstedt-2-action").relative_rms_error
    True
    """
    chosen = setting(
        as_oscillator(oscillator, parameters=parameters, about=about), initial=initial, duration=duration, rate=rate
    )
    given = {**outsiders(), **(estimators or {})}
    own = {name: partial(_at, rate=chosen.rate, method=method) for name, method in given.items()}
    with showing(progress) as told:
        return benchmarks.benchmark(chosen, orders=orders, estimators=own, progress=told)


def _at(x: Any, rate: float, method: Callable[[Any, float], Track]) -> Track:
    return method(x, rate)
