"""Tracks: a quantity of the oscillation against time with its uncertainty, its bias, and where it may be trusted.

A :class:`Track` is of a frequency (the fundamental's or a harmonic's), an :class:`AmplitudeTrack` of an amplitude; both
say the same things of their values.

- ``standard_deviation``: one sigma of what white noise in the samples does to the values, and of nothing else.
- ``bias``: the estimated systematic error *of the values as given* (true = value - bias).  Where ``bias_removed`` is
  true it has been taken off, and ``bias`` holds what was taken off.
- ``bias_deviation``: one sigma of what is not known of the bias, be it for noise or for the model that it rests on.
- ``interval``: the values with the bias off, plus and minus 1.96 times both deviations together.  It is None where a
  part is missing: a method that does not know its bias claims no interval.
- ``valid``: False in the border zones, where the estimator does not see a whole window of data.
- ``ambiguous``: True where the quantity changes so much per cycle that its own definition leaves more room than the
  interval, which then holds that room too.
- ``used``: the settings that code reads back; ``details``: what more there is to show; ``settings``: both, for display.
- ``no_interval``: the reason why there is none where one was asked for.
- ``presence``: how well noise alone explains the signal; where it does, nothing is valid and there is no interval.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import ClassVar, NamedTuple, Self

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, Mask, as_rows, frozen, frozen_mask
from ridgeback.numeric.signal.presence import Presence
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Choices, Definition
from ridgeback.numeric.tracking.shown import Ends, ShownEstimate

NORMAL_95 = 1.959963984540054
"""The standard normal distribution's 97.5 % point: plus and minus this many sigma hold 95 %."""


class Interval(NamedTuple):
    """Lower and upper end of a 95 % interval, one value per time."""

    low: Array
    high: Array

    def holds(self, truth: Array) -> Mask:
        """Tell where ``truth`` lies inside.

        >>> Interval(np.zeros(2), np.ones(2)).holds(np.array([0.5, 2.0])).tolist()
        [True, False]
        """
        return np.asarray((self.low <= truth) & (truth <= self.high), dtype=np.bool_)


@dataclass(frozen=True)
class Misfit:
    """An oscillator whose equation did not make the signal: the chance that white noise would look as its residual."""

    oscillator: str
    probability: float


class Estimated(ShownEstimate):
    """What every estimate against time has; the frozen dataclasses below give the fields their order."""

    time: Array
    valid: Mask
    method: str
    standard_deviation: Array | None
    bias: Array | None
    bias_deviation: Array | None
    ambiguous: Mask | None
    used: Choices
    details: Mapping[str, object]
    bias_removed: bool
    no_interval: str | None
    presence: Presence | None

    def __post_init__(self) -> None:
        for name in ("time", self.QUANTITY, "standard_deviation", "bias", "bias_deviation"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, frozen(value))
        for name in ("valid", "ambiguous"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, frozen_mask(value))
        for name in self._columns():
            self._check_length(name, np.size(getattr(self, name)))
        object.__setattr__(self, "details", MappingProxyType(dict(self.details)))

    def _columns(self) -> list[str]:
        """Names of the fields that hold one value per time."""
        return [name for name, value in vars(self).items() if isinstance(value, np.ndarray)]

    def _check_length(self, name: str, size: int) -> None:
        if size != np.size(self.time):
            raise InputError(f"track {self.method}: {name} has {size} values for {np.size(self.time)} times")

    @property
    def values(self) -> Array:
        """The estimated quantity itself."""
        return np.asarray(getattr(self, self.QUANTITY), dtype=np.float64)

    @property
    def start(self) -> float:
        """Time of the first sample of the signal: what the estimator noted, else the first time of the track."""
        return float(self.time[0]) if self.used.start is None else self.used.start

    @property
    def settings(self) -> Mapping[str, object]:
        """What was used and what more there is to say, by name, for display."""
        reason: dict[str, object] = {} if self.no_interval is None else {"no_interval": self.no_interval}
        if self.presence is not None:
            reason["noise_probability"] = self.presence.probability
        return MappingProxyType({**self.used.shown(), **self.details, "bias_removed": self.bias_removed, **reason})

    @property
    def interval(self) -> Interval | None:
        """The 95 % interval that includes the bias; None for a method that claims none."""
        if self.standard_deviation is None or self.bias is None or self.bias_deviation is None:
            return None
        centre = self.values if self.bias_removed else self.values - self.bias
        reach = NORMAL_95 * np.hypot(self.standard_deviation, self.bias_deviation)
        return Interval(frozen(centre - reach), frozen(centre + reach))

    def band(self) -> Ends | None:
        """The ends of the interval, for a picture."""
        return None if self.interval is None else Ends(*self.interval)

    def held_against(self, noise: Presence) -> Self:
        """The same values with how well noise alone explains the signal; none of them is valid where it does.

        >>> track = Track(np.arange(2.0), np.ones(2), np.ones(2, bool), "example")
        >>> judged = track.held_against(Presence(0.4, 1.0))
        >>> judged.valid.tolist(), judged.settings["noise_probability"]
        ([False, False], 0.4)
        """
        if noise.found:
            return type(self)(**vars(self) | {"presence": noise})
        nothing = dict.fromkeys(("standard_deviation", "bias", "bias_deviation"))
        why = {"presence": noise, "valid": np.zeros(self.time.size, dtype=np.bool_), "no_interval": noise.reason}
        return type(self)(**vars(self) | nothing | why)

    def of_oscillation(self) -> Self:
        """The same values, where noise alone does not explain the signal.

        Raises InputError where it does.
        """
        if self.presence is not None and not self.presence.found:
            raise InputError(f"{self.presence.reason}; give a longer recording, or the part that oscillates")
        return self

    def inside(self) -> Self:
        """Return the valid part of the track."""
        return self._select(self.valid)

    def between(self, low: float, high: float) -> Self:
        """Return the part with ``low <= time <= high``, valid or not."""
        return self._select((self.time >= low) & (self.time <= high))

    def _select(self, keep: Mask) -> Self:
        return type(self)(**vars(self) | {name: getattr(self, name)[keep] for name in self._columns()})


@dataclass(frozen=True, repr=False)
class Track(Estimated):
    """A frequency against time, with its uncertainty, its bias, and where it may be trusted.

    Parameters
    ----------
    time : array of float, shape (N,)
        In the signal's time unit.
    omega : array of float, shape (N,)
        Rad per time unit.
    valid : array of bool, shape (N,)
        False where the estimator does not see a whole window, or hardly knows the value.
    method : str
        The estimator's name.
    standard_deviation : array of float, shape (N,), optional
        One sigma of what white noise in the samples does to the values, rad per time unit.
    bias : array of float, shape (N,), optional
        Systematic error of the values as given; where ``bias_removed``, what was taken off.
    used : Choices
        The settings that code reads back.
    details : mapping
        What more there is to show.
    bias_deviation : array of float, shape (N,), optional
        One sigma of what is not known of the bias.
    ambiguous : array of bool, shape (N,), optional
        Where omega(t)'s own definition leaves more room than the interval would.
    bias_removed : bool
        Whether the bias is off the values.
    no_interval : str, optional
        Why there is no interval, where one was asked for.
    presence : Presence, optional
        How well noise alone explains the signal.
    misfit : Misfit, optional
        Of a fitted oscillator that is not what made the signal.

    Examples
    --------
    >>> track = Track(np.arange(3.0), np.full(3, 6.0), np.array([False, True, True]), "example")
    >>> track.inside().time.tolist(), track.interval is None
    ([1.0, 2.0], True)
    """

    QUANTITY: ClassVar[str] = "omega"
    AXIS: ClassVar[str] = "omega, rad/s"

    time: Array
    omega: Array
    valid: Mask
    method: str
    standard_deviation: Array | None = None
    bias: Array | None = None
    used: Choices = field(default_factory=Choices)
    details: Mapping[str, object] = field(default_factory=dict)
    bias_deviation: Array | None = None
    ambiguous: Mask | None = None
    bias_removed: bool = False
    no_interval: str | None = None
    presence: Presence | None = None
    misfit: Misfit | None = None

    @property
    def frequency_hz(self) -> Array:
        """Cycles per time unit."""
        return self.omega / TWO_PI

    def rows(self) -> list[dict[str, float | bool]]:
        """One row per time: time_s, omega_rad_s, frequency_hz, the uncertainty columns it has, valid, ambiguous."""
        columns = {"time_s": self.time, "omega_rad_s": self.omega, "frequency_hz": self.frequency_hz}
        return rows_of(columns, self, "_rad_s")


@dataclass(frozen=True, repr=False)
class AmplitudeTrack(Estimated):
    """An amplitude against time, in the signal's own unit, with its uncertainty and its bias.

    Parameters
    ----------
    time, amplitude : array of float, shape (N,)
        Times, and the amplitude there.

    The other fields are those of :class:`Track`.

    Examples
    --------
    >>> track = AmplitudeTrack(np.arange(2.0), np.ones(2), np.ones(2, bool), "example", np.zeros(2), np.zeros(2))
    >>> track.rows()[0]["amplitude"], track.interval is None
    (1.0, True)
    """

    QUANTITY: ClassVar[str] = "amplitude"
    AXIS: ClassVar[str] = "amplitude, unit of the signal"

    time: Array
    amplitude: Array
    valid: Mask
    method: str
    standard_deviation: Array | None = None
    bias: Array | None = None
    used: Choices = field(default_factory=Choices)
    details: Mapping[str, object] = field(default_factory=dict)
    bias_deviation: Array | None = None
    ambiguous: Mask | None = None
    bias_removed: bool = False
    no_interval: str | None = None
    presence: Presence | None = None

    @property
    def definition(self) -> str:
        """Which amplitude: ``"fundamental"``, or ``"harmonic h"``."""
        return str(Definition.FUNDAMENTAL) if self.used.multiple == 1 else f"harmonic {self.used.multiple}"

    def rows(self) -> list[dict[str, float | bool]]:
        """One row per time: time_s, amplitude, the uncertainty columns it has, valid, ambiguous."""
        return rows_of({"time_s": self.time, "amplitude": self.amplitude}, self, "")


def rows_of(columns: dict[str, Array], track: Estimated, unit: str) -> list[dict[str, float | bool]]:
    """Rows of ``columns``, then those of its uncertainty; ``unit`` ends the names of the latter.

    Where an interval was asked for and none is claimed there is no deviation either: that of white noise alone would be
    taken for the error.
    """
    known = dict(columns)
    for name in ("standard_deviation", "bias", "bias_deviation"):
        value = getattr(track, name)
        if value is not None and track.no_interval is None:
            known[name + unit] = value
    if track.interval is not None:
        known |= {"low_95" + unit: track.interval.low, "high_95" + unit: track.interval.high}
    flags = {"valid": track.valid} if track.ambiguous is None else {"valid": track.valid, "ambiguous": track.ambiguous}
    told = [dict(zip(flags, row, strict=True)) for row in zip(*(flag.tolist() for flag in flags.values()), strict=True)]
    return [{**row, **flag} for row, flag in zip(as_rows(known), told, strict=True)]
