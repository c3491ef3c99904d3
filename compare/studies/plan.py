"""What a study is: a frozen value that says what is asked of which oscillators, where, by which methods."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ridgeback.compare.studies.systems import System


@dataclass(frozen=True)
class Signal:
    """How the motion is sampled, and the noise that is added.

    Parameters
    ----------
    lengths : tuple of float
        Lengths of the record, in natural periods or in time units.
    rate : float
        Samples in a natural period, or in a time unit.
    periods : bool
        Whether lengths and rate are counted in natural periods 2 pi / k.
    snr_db : tuple of float
        Ratios of the signal's variance to the noise's, in decibels; infinite without noise.
    trials : int
        Noisy records at each ratio.
    seed : int
        Of the noise.
    """

    lengths: tuple[float, ...] = (40.0,)
    rate: float = 32.0
    periods: bool = True
    snr_db: tuple[float, ...] = (math.inf,)
    trials: int = 6
    seed: int = 1

    def durations(self, system: System) -> tuple[float, ...]:
        """Lengths of the record in time units."""
        unit = 2.0 * math.pi / system.natural_frequency if self.periods else 1.0
        return tuple(length * unit for length in self.lengths)

    def sampling(self, system: System) -> float:
        """Samples per time unit."""
        return self.rate * system.natural_frequency / (2.0 * math.pi) if self.periods else self.rate


@dataclass(frozen=True)
class Subject:
    """One oscillator of a study with its amplitudes.

    Parameters
    ----------
    system : System
        The oscillator with all its parameters.
    amplitudes : tuple of float
        Peak amplitudes in the unit of u, values of eps of a limit cycle, or initial displacements of a decay.
    signal : Signal
        How its motion is sampled, and the noise.
    """

    system: System
    amplitudes: tuple[float, ...]
    signal: Signal = Signal()


@dataclass(frozen=True)
class Plan:
    """A whole study.

    Parameters
    ----------
    ask : tuple of str
        Questions by name, all answered from the same cells.
    subjects : tuple of Subject
        Oscillators, one for each combination of parameter values.
    orders : tuple of int
        Orders of expansions, or numbers of terms of the paper's series.
    methods : tuple of str
        How omega0 is found.
    tolerances : tuple of float
        Relative errors that are asked for.
    signal : Signal
        Sampling and noise of oscillators that have none of their own.
    title : str
        What the study is called.

    Examples
    --------
    >>> from ridgeback.compare.studies.systems import System
    >>> plan = Plan(("error",), (Subject(System("pendulum", "pendulum"), (1.0,)),), (2, 4), ("lindstedt",))
    >>> plan_from(plan.to_dict()) == plan
    True
    """

    ask: tuple[str, ...]
    subjects: tuple[Subject, ...]
    orders: tuple[int, ...]
    methods: tuple[str, ...]
    tolerances: tuple[float, ...] = (1e-3, 1e-6)
    signal: Signal = Signal()
    title: str = ""

    def to_dict(self) -> dict[str, Any]:
        """The plan as JSON knows it; :func:`plan_from` gives it back."""
        return dataclasses.asdict(self)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of all parameters of all oscillators, in the order in which they are met."""
        return tuple(dict.fromkeys(name for s in self.subjects for name in s.system.numbers()))


def plan_from(record: Mapping[str, Any]) -> Plan:
    """The plan that ``to_dict`` gave, also after a passage through JSON."""
    values = _tuples(record)
    values["subjects"] = tuple(_subject(entry) for entry in record["subjects"])
    return Plan(**{**values, "signal": Signal(**_tuples(record["signal"]))})


def _tuples(record: Mapping[str, Any]) -> dict[str, Any]:
    return {name: tuple(value) if isinstance(value, list) else value for name, value in record.items()}


def _subject(record: Mapping[str, Any]) -> Subject:
    system = dict(record["system"])
    system["parameters"] = tuple((name, text) for name, text in system["parameters"])
    return Subject(System(**system), tuple(record["amplitudes"]), Signal(**_tuples(record["signal"])))


def flattened(record: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every setting of a plan by its path, for a comparison of two.

    >>> dict(flattened({"orders": (2, 4), "signal": {"seed": 1}}))
    {'orders': [2, 4], 'signal.seed': 1}
    """
    if isinstance(record, Mapping):
        for name, value in record.items():
            yield from flattened(value, f"{path}.{name}" if path else str(name))
    elif isinstance(record, list | tuple) and any(isinstance(item, Mapping) for item in record):
        for i, value in enumerate(record, start=1):
            yield from flattened(value, f"{path}.{i}")
    else:
        yield path, list(record) if isinstance(record, tuple) else record


def differences(one: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """What differs between two plans, a setting a line; their titles do not count.

    >>> differences({"orders": [2, 4]}, {"orders": [2, 8]})
    ['orders was [2, 4], is [2, 8]']
    """
    before, after = (dict(flattened(plan)) for plan in (one, other))
    names = [name for name in dict.fromkeys((*before, *after)) if name != "title"]
    absent = "nothing"
    return [
        f"{name} was {brief(before.get(name, absent))}, is {brief(after.get(name, absent))}"
        for name in names
        if comparable(before.get(name, absent)) != comparable(after.get(name, absent))
    ]


def comparable(value: Any) -> Any:
    """Nested tuples as lists, so that a plan equals itself after a passage through JSON."""
    return [comparable(item) for item in value] if isinstance(value, list | tuple) else value


def brief(value: Any) -> str:
    """A value in a line, its middle left out where it is long.

    >>> brief([1, 2]), brief(list(range(50)))
    ('[1, 2]', '[0, 1, 2, ... 50 values ..., 49]')
    """
    if isinstance(value, list | tuple) and len(value) > 8:
        return f"[{value[0]}, {value[1]}, {value[2]}, ... {len(value)} values ..., {value[-1]}]"
    return str(comparable(value))
