"""The components a_m(t) of eq. (7): measured on the motion at constant phase, and those of the undamped orbit at A(t).

Sampled at equal steps of phase, u = sum over m of a_m cos(m phi + delta_m).  Over two cycles on either side, under a
Hann window, which is blind to every other multiple,

    c_m = 2 <w u exp(-i m phi)>,    a_m = Re(c_m exp(-i m arg c_1)),

so that a_1 > 0 and a_m has the sign that it has when phi is counted from the peak of the fundamental.  The window sees
a fundamental whose amplitude changes at other multiples, too: what it leaves there of a_1(t) cos(phi) alone is the
floor of each, below which a component is not seen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import relative
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.motion.harmonics.order_analysis import POINTS_PER_CYCLE, phase_clock
from ridgeback.compare.motion.motion import Motion
from ridgeback.numeric.arrays import Array, Mask, as_rows, freeze
from ridgeback.numeric.orbits.waveform import orbit_harmonics

Complex = NDArray[np.complex128]
COUNT = 9
MOST = POINTS_PER_CYCLE // 2 - 2
REACH = 2
"""Cycles on either side that a value is taken over."""
SHOWN = 6
LEAST = 1e-3
"""Share of the fundamental below which the model is not held against what was measured."""
SEEN = 10.0
"""Times its floor from which on a component is seen."""
ROUNDING = 1e-12
"""Share of the fundamental that the floor is at least."""


@dataclass(frozen=True, repr=False)
class Components(Displayed):
    """The components of a motion by multiples of its fundamental, one value for each cycle.

    Parameters
    ----------
    name : str
        The oscillator's.
    time : array of float, shape (N,)
        Times of the rising zero crossings that have two cycles on either side.
    offset : array of float, shape (N,)
        The mean of u, in the unit of u.
    amplitude : array of float, shape (M, N)
        a_m(t) of the multiples m = 1 .. M, in the unit of u, as measured.
    model : array of float, shape (M, N), or None
        The same of the undamped orbit at the averaged action; None without a potential.
    floor : array of float, shape (M, N)
        What the analysis leaves at each multiple of the fundamental alone.

    Examples
    --------
    >>> import ridgeback
    >>> found = ridgeback.components("pendulum", initial=(2.0, 0.0), duration=60.0)
    >>> bool(abs(found.amplitude[:3:2] / found.model[:3:2] - 1).max() < 1e-6)
    True
    """

    INDEX: ClassVar[tuple[str, ...]] = ("multiple", "time_s")

    name: str
    time: Array
    offset: Array
    amplitude: Array
    model: Array | None
    floor: Array

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def seen(self) -> Mask:
        """Which of the values stand clear of their floor."""
        return np.asarray(np.abs(self.amplitude) > SEEN * self.floor)

    @property
    def model_error(self) -> float | None:
        """Largest relative difference of model and measurement, where seen and more than a share; None without one."""
        if self.model is None:
            return None
        held = self.seen & (np.abs(self.amplitude) > LEAST * self.amplitude[0])
        return float(np.abs(self.model[held] / self.amplitude[held] - 1.0).max())

    def rows(self) -> list[dict[str, float]]:
        """One row per multiple and cycle; multiple 0 is the mean."""
        measured = np.vstack((self.offset[None, :], self.amplitude))
        model = np.full(measured.shape, np.nan)
        if self.model is not None:
            model[1:] = self.model
        multiple = np.repeat(np.arange(len(measured)), self.time.size)
        time = np.tile(self.time, len(measured))
        columns = {
            "time_s": time,
            "multiple": multiple,
            "amplitude": measured.ravel(),
            "orbit_amplitude": model.ravel(),
            "floor": np.vstack((np.full((1, self.time.size), np.nan), self.floor)).ravel(),
        }
        return as_rows(columns)

    def headline(self) -> str:
        """The strongest components at both ends, and how the undamped orbit has them."""
        size = np.where(self.seen, np.abs(self.amplitude), 0.0).max(axis=1)
        strong = sorted(m for m in np.argsort(-size)[:3] if size[m] > 0.0)
        parts = [f"a_{m + 1} from {self._value(m, 0)} to {self._value(m, -1)}" for m in strong]
        off = self.model_error
        model = "" if off is None else f"; the undamped orbit has them within {relative(off)} of their size"
        return f"{self.name}, components a_m(t): {', '.join(parts)}{model}"

    def _value(self, m: int, at: int) -> str:
        """A component at one time, or what it is below."""
        if self.seen[m, at]:
            return f"{self.amplitude[m, at]:.4g}"
        return f"below {max(abs(self.amplitude[m, at]), SEEN * self.floor[m, at]):.2g}"

    def picture(self) -> Picture:
        """Magnitudes over time, logarithmic; dashed those of the undamped orbit."""
        shown = range(min(SHOWN, len(self.amplitude)))
        size = np.where(self.amplitude == 0.0, np.nan, np.abs(self.amplitude))
        strokes = [Stroke(self.time, size[m], f"a_{m + 1}") for m in shown]
        if self.model is not None:
            strokes += [Stroke(self.time, np.abs(self.model[m]), f"a_{m + 1}, model", dashed=True) for m in shown[::2]]
        title = f"{self.name}, components a_m(t)"
        return Picture(title, "time", "amplitude", tuple(strokes), logarithmic=True)


def components(motion: Motion, *, count: int = COUNT) -> Components:
    """The components of an integrated motion.

    Parameters
    ----------
    motion : Motion
        Integrated, with five cycles or more.
    count : int
        Multiples 1 .. ``count``.

    Raises
    ------
    InputError
        For a count outside 1 to 30.
    """
    if not 1 <= count <= MOST:
        raise InputError(f"{count} components is outside 1 to {MOST}; use e.g. {COUNT}")
    clock, cycles = phase_clock(motion.rising), motion.rising.size - 1
    centre = np.arange(REACH, cycles - REACH + 1, dtype=float)
    step = np.arange(-REACH * POINTS_PER_CYCLE, REACH * POINTS_PER_CYCLE) / POINTS_PER_CYCLE
    phase = centre[:, None] + step
    u = motion.trajectory.at(clock(phase.ravel()))[0].reshape(phase.shape)
    window = np.cos(0.5 * np.pi * step / REACH) ** 2
    window /= window.sum()
    waves = np.exp(-2j * np.pi * np.outer(np.arange(count + 1), step))
    found = (u * window) @ waves.T
    turned = 2.0 * found * np.exp(-1j * np.outer(np.angle(found[:, 1]), np.arange(count + 1)))
    time = motion.rising[centre.astype(int)]
    left = 2.0 * np.abs((_fundamental(found[:, 1], centre, phase) * window) @ waves.T)
    left[:, 1] = 0.0
    floor = left[:, 1:] + ROUNDING * np.abs(turned[:, 1:2])
    return Components(
        motion.dynamics.name, time, found[:, 0].real, turned[:, 1:].real.T, _undamped(motion, time, count), floor.T
    )


def _fundamental(c: Complex, centre: Array, phase: Array) -> Array:
    """2 Re(c exp(2 pi i phase)) with ln c between and beyond the cycles by a spline."""
    size, turn = np.log(np.abs(c)), np.unwrap(np.angle(c))
    if centre.size < 2:
        return np.asarray(2.0 * np.abs(c) * np.cos(2.0 * np.pi * phase + turn))
    slow = [make_interp_spline(centre, values, k=min(3, centre.size - 1))(phase) for values in (size, turn)]
    return np.asarray(2.0 * np.exp(slow[0]) * np.cos(2.0 * np.pi * phase + slow[1]))


def _undamped(motion: Motion, time: Array, count: int) -> Array | None:
    if motion.averaged is None:
        return None
    peak = np.interp(time, motion.time, motion.averaged.peak)
    return orbit_harmonics(motion.dynamics, peak, count=count).cosine[1:]
