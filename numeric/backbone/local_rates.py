"""Amplitude and growth rate along a record by local fits, and what noise does to a mean of neighbouring ones.

Each point is fitted twice in the same window: with a quartic beside the exponential (the value) and with a parabola
(for its bias).  To first order the error of either is a row of weights on the noise of the samples, that of the slope
of a polynomial fitted to the logarithm of the amplitude (Savitzky and Golay, Anal. Chem. 36 (1964) 1627), scaled to the
deviation that the Fisher information gives.  Rows of neighbours overlap; those of a mean add up sample by sample,

    K_n = sum over k of share_k row_k(n),      variance = sum over n of K_n^2,

which is exact where a sum over stated deviations could only guess how many of the points are independent.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.backbone.curve import MeanDeviation
from ridgeback.numeric.backbone.windows import half_widths, spacing
from ridgeback.numeric.harmonics.local_fit import HarmonicFit, harmonic_fit
from ridgeback.numeric.harmonics.window_steps import Shape, powers, slopes
from ridgeback.numeric.signal.samples import TWO_PI

FINE, COARSE = (5, 4), (3, 2)
"""Degrees of phase and amplitude."""
ROOM = 1.3
"""Samples wanted in a window for each parameter."""
MOST_UNSETTLED, WIDER = 0.25, 1.25
"""Share of windows whose finer fit may not come to rest before all are widened by this factor."""
LEFT = 0.5
"""Of the parabola's bias the quartic keeps this times (h a'/a)^2, h half the window, and LEAST_LEFT at least: for any
power law a' = -c a^(p + 1) the next term of the logarithm is that much smaller, at the ends of a window."""
LEAST_LEFT = 0.1


@dataclass(frozen=True)
class LocalRates:
    """Fits along time; ``centre`` and ``half`` in samples, ``size`` that of the record."""

    centre: NDArray[np.intp]
    half: NDArray[np.intp]
    fine: HarmonicFit
    coarse: HarmonicFit
    size: int
    rate: float

    def at(self, keep: Mask) -> LocalRates:
        """Some of the points."""
        return replace(
            self,
            centre=self.centre[keep],
            half=self.half[keep],
            fine=part_of(self.fine, np.flatnonzero(keep)),
            coarse=part_of(self.coarse, np.flatnonzero(keep)),
        )

    @property
    def begin(self) -> NDArray[np.intp]:
        """First sample of each window."""
        return np.asarray(np.clip(self.centre - self.half, 0, self.size - 2 * self.half - 1))

    def mean_deviations(self, index: list[NDArray[np.intp]], share: list[Array]) -> list[MeanDeviation]:
        """Standard deviations of means over some of the points, each with its shares."""
        return [MeanDeviation(*self.mean_deviation(i, s)) for i, s in zip(index, share, strict=True)]

    def independent(self, _: list[NDArray[np.intp]], share: list[Array]) -> float:
        """As many as windows fit side by side between the first and the last, at most one for each mean."""
        apart = float(np.ptp(self.centre)) / float(np.median(2.0 * self.half + 1.0)) + 1.0
        return min(apart, float(len(share)))

    def mean_deviation(self, index: NDArray[np.intp], share: Array) -> tuple[float, float]:
        """Standard deviations of the mean amplitude and of the mean growth rate, in noise and with the bias left."""
        level, slope, apart = (np.zeros(self.size) for _ in range(3))
        begin = self.begin
        for k, part in zip(index.tolist(), share.tolist(), strict=True):
            half, first = int(self.half[k]), int(begin[k])
            at = (int(self.centre[k]) - first - half) / half
            window = slice(first, first + 2 * half + 1)
            value, steep, steep_coarse = rows(half, at, self.fine.shape.amplitude_degree)
            to_growth = part * float(self.fine.growth_sd[k]) / float(np.linalg.norm(steep))
            level[window] += part * float(self.fine.amplitude_sd[k]) / float(np.linalg.norm(value)) * value
            slope[window] += to_growth * steep
            apart[window] += to_growth * (steep - steep_coarse)
        noise = float(np.linalg.norm(slope))
        return float(np.linalg.norm(level)), float(np.hypot(noise, self.bias_left(index, share, apart)))

    def bias_left(self, index: NDArray[np.intp], share: Array, apart: Array) -> float:
        """What should be left of the bias in a mean: by the difference of the two fits beyond the noise in it."""
        growth = self.fine.growth[index]
        difference = float((share * (growth - self.coarse.growth[index])).sum())
        beyond = max(0.0, difference**2 - float((apart**2).sum()))
        reach = np.minimum(1.0, LEFT * (self.half[index] / self.rate * growth) ** 2)
        return max(LEAST_LEFT, float((share * reach).sum())) * float(np.sqrt(beyond))


@lru_cache(maxsize=64)
def inverse(half: int, degree: int) -> Array:
    """Samples of a window to the coefficients of a polynomial in s = -1 .. 1."""
    return np.asarray(np.linalg.pinv(powers(np.arange(-half, half + 1) / half, degree)), dtype=np.float64)


@lru_cache(maxsize=256)
def rows(half: int, at: float, degree: int) -> tuple[Array, Array, Array]:
    """Weights of a window's samples in the value and the slope at ``s = at``, and in the slope two degrees lower.

    >>> value, slope, _ = rows(5, 0.0, 4)
    >>> s = np.arange(-5, 6) / 5
    >>> round(float(value @ (1 + 3 * s**4)), 9), round(float(slope @ (s - s**3)), 9)
    (1.0, 1.0)
    """
    here = np.array([at])
    fine, coarse = inverse(half, degree), inverse(half, max(0, degree - 2))
    return (
        powers(here, degree)[0] @ fine,
        slopes(here, degree)[0] @ fine,
        slopes(here, max(0, degree - 2))[0] @ coarse,
    )


def part_of(fit: HarmonicFit, order: NDArray[np.intp]) -> HarmonicFit:
    """Some windows of a fit, in another order."""
    parts: dict[str, Any] = {name: getattr(fit, name)[order] for name in along(fit)}
    return replace(fit, **parts)


def along(fit: HarmonicFit) -> list[str]:
    """The names of what a fit has for each window."""
    return [item.name for item in fields(fit) if isinstance(getattr(fit, item.name), np.ndarray)]


def joined(fits: Sequence[HarmonicFit]) -> HarmonicFit:
    """Several fits as one, in the order of time."""
    parts: dict[str, Any] = {name: np.concatenate([getattr(f, name) for f in fits]) for name in along(fits[0])}
    whole = replace(fits[0], **parts)
    return part_of(whole, np.argsort(whole.time, kind="stable"))


def local_rates(
    real: Array,
    rate: float,
    omega: Array,
    multiples: tuple[int, ...],
    *,
    half: int,
    start: float,
    fixed: bool,
    clean: Mask,
) -> LocalRates:
    """Fit along a frequency, in windows of 2 ``half`` + 1 samples if ``fixed``, else in those that a first fit allows.

    Parameters
    ----------
    real : array of float, shape (N,)
        The samples, without their mean.
    rate : float
        Samples per time unit.
    omega : array of float, shape (N,)
        Frequency of the fundamental, rad per time unit.
    multiples : tuple of int
        Harmonics to fit beside it.
    half : int
        Half the window of the first fit, in samples.
    start : float
        Time of the first sample.
    fixed : bool
        Whether that is the window of all fits.
    clean : array of bool, shape (N,)
        False at samples that no wide window should hold.

    Returns
    -------
    LocalRates
        In the order of time.
    """
    cycle = TWO_PI / float(np.median(omega))
    needed = int(ROOM * Shape(multiples, *FINE).size) + 1
    halves = np.full(real.size, half)
    if not fixed:
        sparse = np.arange(0, real.size, max(1, half // 2))
        pilot = harmonic_fit(real, rate, omega, half=half, shape=Shape(multiples, *COARSE), centres=sparse)
        halves = half_widths(pilot, omega, rate, fewest=needed, clean=clean)
    centres = np.arange(0, real.size, spacing(halves, cycle, rate))
    halves, longest = halves[centres], (real.size - 1) // 2
    while True:
        found = fitted(real, rate, omega, multiples, centres=centres, halves=halves, start=start)
        if fixed or unsettled(found) <= MOST_UNSETTLED or int(halves.min()) >= longest:
            return found
        halves = np.minimum(np.ceil(WIDER * halves).astype(halves.dtype), longest)


def fitted(
    real: Array,
    rate: float,
    omega: Array,
    multiples: tuple[int, ...],
    *,
    centres: NDArray[np.intp],
    halves: NDArray[np.intp],
    start: float,
) -> LocalRates:
    """Both fits at each centre in its own window."""
    degrees = FINE if 2 * int(halves.min()) + 1 >= int(ROOM * Shape(multiples, *FINE).size) + 1 else COARSE

    def fits(phase_degree: int, amplitude_degree: int) -> HarmonicFit:
        shape = Shape(multiples, phase_degree, amplitude_degree)
        return joined(
            [
                harmonic_fit(
                    real, rate, omega, half=int(h), shape=shape, start_time=start, centres=centres[halves == h]
                )
                for h in np.unique(halves)
            ]
        )

    return LocalRates(centres, halves, fits(*degrees), fits(*COARSE), real.size, rate)


def unsettled(found: LocalRates) -> float:
    """Of the windows in which the parabola came to rest, the share in which the quartic did not.

    Harmonics with a quintic each are nearly the same over three cycles; over four or five they are told apart.
    """
    coarse = found.coarse.settled
    return float((coarse & ~found.fine.settled).sum()) / max(1, int(coarse.sum()))
