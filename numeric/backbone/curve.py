"""The curve of a backbone: frequency and growth rate in bins of amplitude, each mean with its standard deviation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import NamedTuple, Protocol

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask, as_rows, freeze
from ridgeback.numeric.backbone.damping import damping_sentence, growth_columns
from ridgeback.numeric.backbone.shown import Curve, ShownBackbone
from ridgeback.numeric.signal.samples import TWO_PI
from ridgeback.numeric.tracking.choices import Definition

MOST_BINS = 24


@dataclass(frozen=True, repr=False)
class Backbone(ShownBackbone):
    """Frequency and growth rate against amplitude.

    Parameters
    ----------
    time : array of float, shape (M,)
        Where it was measured.
    amplitude, amplitude_sd : array of float, shape (M,)
        In the signal's unit.
    omega, omega_sd : array of float, shape (M,)
        Frequency in rad per time unit; the deviation holds the track's bias too.
    growth_rate, growth_rate_sd : array of float, shape (M,)
        a'/a per time unit, negative in a decay.
    curve_amplitude, curve_amplitude_sd : array of float, shape (B,)
        The curve: mean amplitude in each bin, rising, and the standard deviation of that mean.
    curve_omega, curve_omega_sd, curve_growth_rate, curve_growth_rate_sd : array of float, shape (B,)
        Means over the bins, all weighted by the precision of omega; the deviation that the estimates state, that of the
        scatter in the bin where it is larger, and the amplitude's own.
    offset : float
        The mean that was taken off the samples.
    definition : Definition
        Which amplitude.
    settings : mapping
        How it was measured, for display.
    notes : tuple of str
        What was left out, and why.
    window_seconds : float, optional
        Width of the fits whose amplitude this is; None where half cycles were counted.
    units : str
        Unit of the signal; may be empty.
    independent : float
        How many independent values the errors of ``curve_omega`` are as good as; NaN where that is not known.

    Examples
    --------
    >>> import ridgeback
    >>> t = np.arange(640) / 32.0
    >>> curve = ridgeback.backbone(np.exp(-0.05 * t) * np.cos(6.0 * t), 32.0, method="hilbert")
    >>> round(float(np.median(curve.omega)), 2), round(float(np.median(curve.growth_rate)), 3)
    (6.0, -0.05)
    """

    time: Array
    amplitude: Array
    amplitude_sd: Array
    omega: Array
    omega_sd: Array
    growth_rate: Array
    growth_rate_sd: Array
    curve_amplitude: Array
    curve_amplitude_sd: Array
    curve_omega: Array
    curve_omega_sd: Array
    curve_growth_rate: Array
    curve_growth_rate_sd: Array
    offset: float
    definition: Definition = Definition.FUNDAMENTAL
    settings: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    window_seconds: float | None = None
    """Of the fit whose amplitude this is; None where half cycles were counted."""
    units: str = ""
    independent: float = math.nan

    def __post_init__(self) -> None:
        freeze(self)

    def along(self) -> Curve:
        """The curve that is drawn."""
        return Curve(self.curve_amplitude, self.curve_omega, self.curve_omega_sd)

    def rows(self) -> list[dict[str, float]]:
        """One row per point of the curve: amplitude, omega, frequency, growth rate, damping ratio, with deviations."""
        columns = {
            "amplitude": self.curve_amplitude,
            "amplitude_standard_deviation": self.curve_amplitude_sd,
            "omega_rad_s": self.curve_omega,
            "frequency_hz": self.curve_omega / TWO_PI,
            "omega_standard_deviation_rad_s": self.curve_omega_sd,
            **growth_columns(self.curve_growth_rate, self.curve_growth_rate_sd, self.curve_omega, self.curve_omega_sd),
        }
        return as_rows(columns)


@dataclass(frozen=True)
class Points:
    """Amplitude, frequency and growth rate along time with their standard deviations, before they are binned."""

    time: Array
    amplitude: Array
    amplitude_sd: Array
    omega: Array
    omega_sd: Array
    growth_rate: Array
    growth_rate_sd: Array

    def at(self, keep: Mask) -> Points:
        """Some of the points."""
        return Points(**{item.name: getattr(self, item.name)[keep] for item in fields(self)})


@dataclass(frozen=True)
class Crowding:
    """How many neighbouring points share one window, of the amplitude (and growth rate) and of the frequency.

    ``omega_ends`` and ``growth_ends`` above 0 say that errors of neighbours cancel in a mean of n, to this number of
    n independent ones.
    """

    amplitude: float
    omega: float
    omega_ends: float = 0.0
    growth_ends: float = 0.0


class MeanDeviation(NamedTuple):
    """Standard deviations of the means of amplitude, growth rate and frequency over one bin; None for one not known."""

    level: float | None = None
    growth: float | None = None
    omega: float | None = None


class Rates(Protocol):
    """Fits of which the errors of means are known."""

    def mean_deviations(self, index: list[NDArray[np.intp]], share: list[Array]) -> list[MeanDeviation]:
        """Standard deviations of means over some of the points, each with its shares."""

    def independent(self, index: list[NDArray[np.intp]], share: list[Array], /) -> float:
        """How many independent values the errors of means of the frequency are as good as; NaN if not known."""


def assemble(
    points: Points,
    *,
    crowding: Crowding,
    offset: float,
    settings: Mapping[str, object],
    notes: Sequence[str],
    definition: Definition = Definition.FUNDAMENTAL,
    fewest: int = 1,
    window_seconds: float | None = None,
    local: Rates | None = None,
) -> Backbone:
    """Put points into a Backbone and bin them over amplitude, at least ``fewest`` in a bin.

    The bands hold the amplitude's own error too, times the slope of the curve.  With ``local``, the fits that the
    points are of, errors of amplitude and growth rate are those of the means themselves.
    """
    a, w, s = points.amplitude, points.omega, points.omega_sd
    weights = 1.0 / np.maximum(s, 1e-9 * w.max()) ** 2
    of = bins(a, fewest)

    shares = [weights[i] / weights[i].sum() for i in of]
    known = [MeanDeviation()] * len(of) if local is None else local.mean_deviations(of, shares)
    of_level, of_growth, of_omega = zip(*known, strict=True)

    def means(
        values: Array,
        deviations: Array,
        crowd: float,
        ends: float = 0.0,
        stated: Sequence[float | None] = (None,) * len(of),
    ) -> Array:
        found = [
            pooled(a[i], values[i], deviations[i], weights[i], crowd, ends=ends, stated=s)
            for i, s in zip(of, stated, strict=True)
        ]
        return np.array(found).T

    centre, unsure = means(a, points.amplitude_sd, crowding.amplitude, stated=of_level)
    omega, omega_sd = means(w, s, crowding.omega, crowding.omega_ends, of_omega)
    growth_rate, growth_rate_sd = means(
        points.growth_rate, points.growth_rate_sd, crowding.amplitude, crowding.growth_ends, of_growth
    )
    omega_sd = np.hypot(omega_sd, unsure * slope_at(centre, a, w, s))
    growth_rate_sd = np.hypot(growth_rate_sd, unsure * slope_at(centre, a, points.growth_rate, points.growth_rate_sd))
    return Backbone(
        **{item.name: getattr(points, item.name) for item in fields(points)},
        curve_amplitude=centre,
        curve_amplitude_sd=unsure,
        curve_omega=omega,
        curve_omega_sd=omega_sd,
        curve_growth_rate=growth_rate,
        curve_growth_rate_sd=growth_rate_sd,
        offset=offset,
        definition=definition,
        settings=settings,
        notes=(*notes, damping_sentence(centre, growth_rate, growth_rate_sd, omega, omega_sd)),
        window_seconds=window_seconds,
        independent=math.nan if local is None else local.independent(of, shares),
    )


def slope_at(centre: Array, a: Array, values: Array, deviations: Array) -> Array:
    """The slope against amplitude of a cubic through all points, weighted by their precision.

    >>> a = np.linspace(1.0, 2.0, 9)
    >>> slope_at(np.array([1.0, 2.0]), a, 8.0 - 0.3 * a**2, np.ones(9)).round(9).tolist()
    [-0.6, -1.2]
    """
    weights = 1.0 / np.maximum(deviations, 1e-9 * float(np.abs(values).max(initial=1e-300)))
    curve = Polynomial.fit(a, values, min(3, a.size - 1), w=weights)
    return np.asarray(curve.deriv()(centre), dtype=np.float64)


def bins(a: Array, fewest: int) -> list[NDArray[np.intp]]:
    """Indices of the points in up to MOST_BINS equal bins of amplitude, rising."""
    edges = np.linspace(a.min(), a.max(), min(MOST_BINS, max(2, a.size // 4)) + 1)
    bin_of = np.clip(np.digitize(a, edges) - 1, 0, edges.size - 2)
    return merged([np.flatnonzero(bin_of == b) for b in np.unique(bin_of)], fewest)


def merged(bins: list[NDArray[np.intp]], fewest: int) -> list[NDArray[np.intp]]:
    """Join each bin with too few points to the next, the last to the one before.

    >>> [part.tolist() for part in merged([np.array([0, 1]), np.array([2]), np.array([3, 4]), np.array([5])], 2)]
    [[0, 1], [2, 3, 4, 5]]
    """
    found: list[NDArray[np.intp]] = []
    open_bin = np.zeros(0, dtype=np.intp)
    for part in bins:
        open_bin = np.concatenate([open_bin, part])
        if open_bin.size >= fewest:
            found.append(open_bin)
            open_bin = open_bin[:0]
    if open_bin.size and found:
        return [*found[:-1], np.concatenate([found[-1], open_bin])]
    return found or [open_bin]


# A straight line within the bin, so that the backbone's own slope is not taken for scatter; as in Birge's ratio
# (Phys. Rev. 40 (1932) 207), the scatter counts where it is more than the estimates' own deviations allow.
def pooled(
    a: Array,
    values: Array,
    deviations: Array,
    weights: Array,
    crowding: float,
    *,
    ends: float = 0.0,
    stated: float | None = None,
) -> tuple[float, float]:
    """Weighted mean and its standard deviation, when ``crowding`` neighbouring values share one window.

    What the deviations state, and what the scatter about a line in the amplitude ``a`` shows beyond that.  With
    ``ends`` the errors that are stated cancel among neighbours, to that number of n independent ones.  ``stated`` is
    the deviation of the mean where it is known as such.

    >>> pooled(np.arange(4.0), 2.0 + 0.5 * np.arange(4.0), np.full(4, 0.1), np.ones(4), 2.0)
    (2.75, 0.07071067811865477)
    """
    share, n = weights / weights.sum(), values.size
    mean, centre = float((share * values).sum()), float((share * a).sum())
    width = float((share * (a - centre) ** 2).sum())
    lined = n > 2 and width > 0.0
    slope = float((share * (a - centre) * (values - mean)).sum()) / width if lined else 0.0
    freedom = max(1, n - (2 if lined else 1))
    # Two values, which lie on a line, show none.
    scatter = float((share * (values - mean - slope * (a - centre)) ** 2).sum()) * n / freedom if n > 2 else 0.0
    excess = max(0.0, scatter - float((share * deviations**2).sum()))
    if stated is None:
        shared = min(1.0, ends / n) if ends else min(crowding, n)
        stated = float(np.sqrt(float((share**2 * deviations**2).sum()) * shared))
    return mean, float(np.sqrt(stated**2 + float((share**2).sum()) * excess * min(crowding, n)))
