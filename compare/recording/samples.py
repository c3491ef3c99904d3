"""Sample recordings of our own making, with their truth: what tutorials and first tries measure.

Each is made when it is asked for, the same one each time: a motion whose frequency, amplitude and growth rate are known
without measuring it, seeded white noise, and the step of an instrument.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Final

import numpy as np

from ridgeback.common.csv_text import csv_text
from ridgeback.common.names import chosen
from ridgeback.common.show.displayed import Displayed, signal_units
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.noise.truth import dynamics_truth
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.motion.dynamics import pendulum
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.samples import TWO_PI


@dataclass(frozen=True, repr=False)
class Sample(Displayed):
    """A recording of our own making, and the truth about it.

    Parameters
    ----------
    name, about : str
        What it is called, and what it is.
    recording : Recording
        The samples with their noise, as they are read from the file that ``save`` writes.
    omega : array of float, shape (N,)
        The true angular frequency of the fundamental at each sample, rad per time unit; NaN before the motion starts.
    amplitude : array of float, shape (N,)
        The true amplitude of the fundamental, in the unit of the recording.
    growth_rate : array of float, shape (N,)
        The true a'/a, per time unit.
    parameters : mapping of str to float
        The numbers of which it was made.
    header : str
        The column's header in a file.
    values : array of float, shape (N,)
        The samples in the unit of that header.

    Examples
    --------
    >>> sample("hammer").parameters["damping_ratio"]
    0.006
    """

    INDEX: ClassVar[tuple[str, ...]] = ("time_s",)

    name: str
    about: str
    recording: Recording
    omega: Array
    amplitude: Array
    growth_rate: Array
    parameters: Mapping[str, float]
    header: str
    values: Array

    def __post_init__(self) -> None:
        freeze(self)

    def csv(self) -> str:
        """The samples as a table of text, as an instrument would write it."""
        rows = zip(self.recording.time.tolist(), self.values.tolist(), strict=True)
        return csv_text(("time [s]", self.header), rows)

    def save(self, path: str | Path) -> Path:
        """Write the samples as CSV.

        Parameters
        ----------
        path : str or Path
            Where to.

        Returns
        -------
        Path
            The file.
        """
        found = Path(path)
        found.write_text(self.csv(), encoding="utf-8")
        return found

    def rows(self) -> list[dict[str, Any]]:
        """One row per sample: time_s, value, and the true omega_rad_s, amplitude and growth_rate_per_s."""
        names = ("time_s", "value", "omega_rad_s", "amplitude", "growth_rate_per_s")
        columns = (self.recording.time, self.recording.values, self.omega, self.amplitude, self.growth_rate)
        return [dict(zip(names, row, strict=True)) for row in zip(*(c.tolist() for c in columns), strict=True)]

    def headline(self) -> str:
        """Name, what it is, samples and rate."""
        return f"{self.name}: {self.about}; {self.values.size} samples, {self.recording.rate:g} per second"

    def own_units(self) -> Mapping[str, str]:
        """Values and amplitudes in the unit of the recording."""
        return signal_units(self.recording.units)

    def picture(self) -> Picture:
        """The samples over time."""
        stroke = Stroke(self.recording.time, self.recording.values)
        return Picture(self.name, "time, s", self.recording.channel, (stroke,))


def sample(name: str) -> Sample:
    """Return a sample recording with its truth.

    Parameters
    ----------
    name : {"decay", "hammer", "pendulum"}
        ``"decay"`` softens: omega0 = w + c a^2 and a'/a = -mu - nu a^2, in millimetres; ``"hammer"`` is the ringdown of
        two modes after a blow; ``"pendulum"`` a pendulum with linear damping, in degrees.

    Returns
    -------
    Sample
        ``recording``, the true ``omega``, ``amplitude`` and ``growth_rate`` at each sample, ``parameters``; ``save``
        writes the samples as CSV.

    Raises
    ------
    InputError
        For another name.

    Examples
    --------
    >>> found = sample("pendulum")
    >>> found.recording.channel, found.header, found.values.size
    ('angle [rad]', 'angle [deg]', 1201)
    """
    return _MADE[chosen(name, tuple(_MADE), "sample")]()


def _decay() -> Sample:
    """a' = -a (mu + nu a^2) and phi' = w + c a^2, in closed form; harmonics that grow as their powers of a.

    1/a^2 = (1/a_0^2 + nu/mu) exp(2 mu t) - nu/mu,      phi = w t + c/(2 nu) log((mu + nu a_0^2)/(mu + nu a^2))
    """
    start, mu, nu, natural, curvature, noise = 5.0, 0.055, 0.0012, TWO_PI * 1.25, -TWO_PI * 0.0028, 0.02
    time = np.arange(2401) / 40.0
    a = ((1 / start**2 + nu / mu) * np.exp(2 * mu * time) - nu / mu) ** -0.5
    phase = natural * time + curvature / (2 * nu) * np.log((mu + nu * start**2) / (mu + nu * a**2))
    x = a * np.cos(phase) + 0.01 * a**2 * np.cos(2 * phase) + 0.001 * a**3 * np.cos(3 * phase)
    return _recorded(
        "decay",
        "a decay that softens, with linear and cubic damping",
        _noisy(x, noise, step=0.001, seed=1),
        40.0,
        "displacement [mm]",
        truth=(natural + curvature * a**2, a, -mu - nu * a**2),
        parameters={"w": natural, "c": curvature, "mu": mu, "nu": nu, "noise": noise},
    )


def _hammer() -> Sample:
    """Two linear modes after a blow: exp(-zeta w t) sin(w sqrt(1 - zeta^2) t) each, from the moment of the blow."""
    blow, rate, noise = 0.125, 2048.0, 0.05
    time = np.arange(4097) / rate
    after = time - blow
    x = np.zeros_like(time)
    for size, frequency, zeta in ((12.0, 62.0, 0.006), (3.0, 171.0, 0.011)):
        w = TWO_PI * frequency
        ring = size * np.exp(-zeta * w * after.clip(0)) * np.sin(w * math.sqrt(1 - zeta**2) * after)
        x += np.where(after >= 0, ring, 0.0)
    w, zeta = TWO_PI * 62.0, 0.006
    rings = np.where(after >= 0, 1.0, np.nan)
    truth = (w * math.sqrt(1 - zeta**2) * rings, 12.0 * np.exp(-zeta * w * after.clip(0)) * rings, -zeta * w * rings)
    return _recorded(
        "hammer",
        "the ringdown of two modes after a blow at 0.125 s",
        _noisy(x, noise, step=0.01, seed=2),
        rate,
        "acceleration [m/s2]",
        truth=truth,
        parameters={"frequency_hz": 62.0, "damping_ratio": zeta, "second_hz": 171.0, "blow_s": blow, "noise": noise},
    )


def _pendulum() -> Sample:
    """u'' + 2 mu u' + k^2 sin u = 0 integrated; its cycle frequency, and the fundamental of the noise-free solution."""
    k, mu, noise = math.sqrt(9.81 / 0.8), 0.012, 0.3
    found = dynamics_truth(pendulum(k=k, mu=mu), (math.radians(110.0), 0.0), duration=60.0, rate=20.0)
    a = np.hypot(found.signal.cosine[0], found.signal.sine[0])
    return _recorded(
        "pendulum",
        "a pendulum of 0.8 m with linear damping, in degrees",
        _noisy(np.degrees(found.x), noise, step=0.05, seed=3),
        20.0,
        "angle [deg]",
        truth=(found.omega, a, np.gradient(np.log(a), 1 / 20.0)),
        parameters={"k": k, "mu": mu, "start_deg": 110.0, "noise_deg": noise},
    )


_MADE: Final[Mapping[str, Callable[[], Sample]]] = {"decay": _decay, "hammer": _hammer, "pendulum": _pendulum}
NAMES: Final = tuple(_MADE)


def _noisy(x: Array, noise: float, *, step: float, seed: int) -> Array:
    """White noise on the samples, and the step of the instrument."""
    noisy = x + noise * np.random.default_rng(seed).normal(size=x.size)
    digits = -math.floor(math.log10(step))
    return np.asarray(np.round(np.round(noisy / step) * step, digits))


def _recorded(
    name: str,
    about: str,
    values: Array,
    rate: float,
    header: str,
    *,
    truth: tuple[Array, Array, Array],
    parameters: Mapping[str, float],
) -> Sample:
    """The samples as a recording, in radians where they are degrees."""
    channel, _, units = header.partition(" [")
    recording = Recording.from_arrays(values, rate, name=channel, units=units.rstrip("]"))
    return Sample(name, about, recording, *truth, parameters, header, values)
