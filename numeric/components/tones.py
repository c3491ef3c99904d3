"""A tone beside an oscillation: steady, or damped at a rate of its own.

    y = Re[Z e^((g + i w) t + c_2 t^2 + ..)],      g = 0 where the samples do not show one,

with complex c only where its frequency or growth rate changes along its decay, as those of a mode do that is not
linear; fitted by Gauss-Newton from a line of a spectrum. Its tangent, the derivatives by Z, w, g and c, is what a
model of the oscillation beside it must leave free: that is how the error of either gets into that of the other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.signal.samples import TWO_PI

ITERATIONS, SETTLED = 12, 1e-10
"""Steps of a fit: most of them, and radians over the record below which one is the last."""
STEADY = 3.0
"""Of its deviation, that g must exceed to be one."""
STEEPEST = 0.5
"""Of its frequency, that the growth rate of a tone may reach: a damping ratio of 45 %."""
SHALLOWEST, FALLS, ASIDE = 4.0, 2.0, (0.0, -0.5, 0.5, -1.0, 1.0)
"""Growth rates from which a damped tone is looked for: the first times the length of the record, one over the one
before, and how far beside the line in each, since that of a mode which is gone after a few cycles is as wide."""
BEYOND = 20.0
"""Logarithms of its fall after which a tone is nothing."""
MOST_STEP, STEP_OF_GROWTH = 0.5, 0.3
HARDLY = 1e10
"""Of an element of an inverse, from which on rounding shows in it."""
FAINT = 1e-3
"""Share of the largest amplitude as which a smaller one counts where a polynomial is laid through phases."""
MAINS = (50.0, 60.0)
MAINS_WITHIN, MAINS_HIGHEST = 2e-3, 40
"""Relative distance from a multiple of the mains within which a steady tone is hum, and the highest such multiple."""


@dataclass(frozen=True)
class Tone:
    """Its frequency (rad per time unit), growth rate, and complex amplitude, all at the first sample."""

    omega: float
    growth: float
    size: complex
    bends: tuple[complex, ...] = ()
    """c_2, c_3, .. for time in units of ``span``."""
    span: float = 1.0

    @property
    def amplitude(self) -> float:
        """At the first sample."""
        return abs(self.size)

    def wave(self, time: Array) -> NDArray[np.complex128]:
        """What multiplies Z."""
        u = time / self.span
        bent = np.polynomial.polynomial.polyval(u, (0.0, 0.0, *self.bends)) if self.bends else 0.0
        return np.asarray(np.exp((self.growth + 1j * self.omega) * time + bent), dtype=np.complex128)

    def samples(self, time: Array) -> Array:
        """The tone at times from the first sample on."""
        return np.asarray((self.size * self.wave(time)).real)

    def tangent(self, time: Array) -> Array:
        """Derivatives by the real and the imaginary part of Z, by w, by g where it has one, and by those of each c."""
        wave = self.wave(time)
        whole = self.size * wave
        columns = [wave.real, -wave.imag, -time * whole.imag]
        columns += [] if self.growth == 0.0 else [time * whole.real]
        powers = [(time / self.span) ** k * whole for k in range(2, len(self.bends) + 2)]
        return np.stack([*columns, *(column for power in powers for column in (power.real, -power.imag))], axis=1)

    def changed(self, step: Array) -> Tone:
        """The tone after steps along its tangent."""
        bends = tuple(
            c + complex(re, im) for c, re, im in zip(self.bends, step[4::2].tolist(), step[5::2].tolist(), strict=True)
        )
        size = self.size + complex(float(step[0]), float(step[1]))
        growth = self.growth if self.growth == 0.0 else self.growth + float(step[3])
        return replace(self, omega=self.omega + float(step[2]), growth=growth, size=size, bends=bends)

    def turned_by(self, step: Array, time: Array) -> float:
        """How far its exponent goes at most, in radians or logarithms, in a step along its tangent."""
        growth = 0.0 if self.growth == 0.0 else float(step[3])
        powers = (0.0, complex(growth, float(step[2])) * self.span, *(step[4::2] + 1j * step[5::2]))
        return float(np.abs(np.polynomial.polynomial.polyval(time / self.span, powers)).max())

    @property
    def parameters(self) -> int:
        """How many real numbers it has."""
        return 3 + (self.growth != 0.0) + 2 * len(self.bends)

    @property
    def mains(self) -> bool:
        """Whether it is steady and at a multiple of 50 or 60 cycles per unit."""
        f = self.omega / TWO_PI
        near = [abs(f / base - round(f / base)) * base for base in MAINS if 1 <= round(f / base) <= MAINS_HIGHEST]
        return self.growth == 0.0 and bool(near) and min(near) < MAINS_WITHIN * f

    def row(self) -> dict[str, float]:
        """The tone in numbers, named as the columns of a backbone."""
        return {
            "frequency_hz": self.omega / TWO_PI,
            "growth_rate_per_s": self.growth,
            "amplitude_at_start": self.amplitude,
        }

    def said(self) -> str:
        """The tone in words.

        >>> Tone(2 * np.pi * 50.0, 0.0, 0.02).said()
        'a steady tone at 50 Hz (mains hum), amplitude 0.02'
        """
        kind = "a steady tone" if self.growth == 0.0 else f"a mode of growth rate {self.growth:.4g} 1/s"
        kind += " at first, changing along its decay," if self.bends else ""
        hum = " (mains hum)" if self.mains else ""
        return f"{kind} at {self.omega / TWO_PI:.6g} Hz{hum}, amplitude {self.amplitude:.3g}"


def fitted_tone(left: Array, time: Array, omega: float, sound: Array, start: Tone | None = None) -> Tone:
    """The tone near a frequency that fits samples best, by least squares over the sound ones.

    >>> t = np.arange(400) / 20.0
    >>> found = fitted_tone(0.3 * np.exp(-0.1 * t) * np.cos(9.0 * t + 1.0), t, 9.1, np.ones(400))
    >>> round(found.omega, 9), round(found.growth, 9), round(found.amplitude, 9)
    (9.0, -0.1, 0.3)
    """
    if start is not None and start.bends:
        return bent_tone(left, time, start, sound)
    tone = Tone(omega, 0.0, 0j) if start is None else start
    steady = None if start is not None and start.growth else iterated(left, time, tone, sound, free=False)[0]
    begins = (start,) if start is not None else (steady or tone, steep_start(left, time, omega, sound))
    tried = [iterated(left, time, begin, sound, free=True) for begin in begins]
    damped, deviation = min(tried, key=lambda one: float(np.sum(((left - one[0].samples(time)) * sound) ** 2)))
    if abs(damped.growth) > STEADY * deviation:
        return damped
    return steady or iterated(left, time, tone, sound, free=False)[0]


def steep_start(left: Array, time: Array, omega: float, sound: Array) -> Tone:
    """The tone near a frequency that explains most of samples, of some growth rates and frequencies: where to begin.

    >>> t = np.arange(2000) / 20.0
    >>> x = 0.3 * np.exp(-1.5 * t) * np.cos(8.0 * t + 1.0)
    >>> found = steep_start(x, t, 8.3, np.ones(2000))
    >>> round(found.omega, 1), round(found.growth, 1), round(fitted_tone(x, t, 8.3, np.ones(2000)).growth, 6)
    (8.3, -1.3, -1.5)
    """
    most, found, fall = 0.0, Tone(omega, 0.0, 0j), SHALLOWEST / float(time[-1])
    while fall < STEEPEST * omega:
        count = max(8, int(np.searchsorted(time, BEYOND / fall)))
        for aside in ASIDE:
            tone = Tone(omega + aside * fall, -fall, 1.0 + 0j)
            turning = tone.wave(time[:count]) * sound[:count]
            wave = np.stack([turning.real, -turning.imag])
            size, right = least_squares(wave, left[:count])[0], wave @ left[:count]
            if float(size @ right) > most:
                most, found = float(size @ right), replace(tone, size=complex(*size.tolist()))
        fall *= FALLS
    return found


def iterated(left: Array, time: Array, tone: Tone, sound: Array, *, free: bool) -> tuple[Tone, float]:
    """Gauss-Newton for a tone, with a growth rate of its own if ``free``; and the deviation of that."""
    span, growth, omega = float(time[-1]), tone.growth if free else 0.0, tone.omega
    heard, size, deviation = left * sound, 0j, np.inf
    for _ in range(ITERATIONS):
        wave = np.exp((growth + 1j * omega) * time) * sound
        size = complex(*least_squares(np.stack([wave.real, -wave.imag]), heard)[0].tolist())
        whole = size * wave
        later = whole * time
        residual, tangent = heard - whole.real, np.stack([wave.real, -wave.imag, -later.imag, later.real][: 3 + free])
        step, variance = least_squares(tangent, residual)
        reach = STEP_OF_GROWTH * abs(growth)
        omega += float(np.clip(step[2], -max(0.5 / span, reach), max(0.5 / span, reach)))
        if free:
            growth += float(np.clip(step[3], -max(1.0 / span, reach), max(1.0 / span, reach)))
            growth = float(np.clip(growth, -STEEPEST * omega, 2.0 / span))
            deviation = float(np.sqrt(max(float(variance[3]), 0.0) * np.mean(residual**2)))
        if float(np.abs(step[2:]).max()) * span < SETTLED:
            break
    return Tone(omega, growth, size), deviation


# The normal equations in units of the columns: a step that they give less exactly than others would is one of several.
def least_squares(rows: Array, values: Array) -> tuple[Array, Array]:
    """What times rows ``(Q, N)`` comes nearest to values, and the diagonal of the inverse of their products.

    >>> least_squares(np.array([[1.0, 1.0, 1.0], [0.0, 1.0, 2.0]]), np.array([1.0, 3.0, 5.0]))[0].round(12).tolist()
    [1.0, 2.0]
    """
    products = rows @ rows.T
    unit = np.sqrt(np.maximum(np.diag(products), np.finfo(float).tiny))
    inverse = inverted(products / unit / unit[:, None])
    return inverse @ (rows @ values / unit) / unit, np.diag(inverse) / unit / unit


def inverted(products: Array) -> Array:
    """The inverse of a symmetric matrix with a unit diagonal, or where it hardly has one its pseudoinverse."""
    try:
        inverse = np.asarray(np.linalg.inv(products), dtype=np.float64)
    except np.linalg.LinAlgError:
        inverse = np.full_like(products, np.inf)
    if float(np.abs(inverse).max()) < HARDLY:
        return inverse
    return np.asarray(np.linalg.pinv(products, hermitian=True), dtype=np.float64)


def bent_tone(left: Array, time: Array, tone: Tone, sound: Array) -> Tone:
    """Gauss-Newton for a tone with bends, each step half a radian, or half of the logarithm, at most.

    >>> t = np.arange(400) / 20.0
    >>> x = 0.3 * np.exp(-0.1 * t) * np.cos(9.0 * t + 0.01 * t**2 + 1.0)
    >>> start = Tone(9.1, -0.1, 0.3 * np.exp(1j), (0j,), 20.0)
    >>> found = bent_tone(x, t, start, np.ones(400))
    >>> round(found.omega, 6), round(found.bends[0].imag, 6)
    (9.0, 4.0)
    """
    for _ in range(ITERATIONS):
        jacobian = tone.tangent(time) * sound[:, None]
        off = left * sound - jacobian[:, 0] * tone.size.real - jacobian[:, 1] * tone.size.imag
        step = np.asarray(np.linalg.lstsq(jacobian, off, rcond=None)[0], dtype=float)
        turned = tone.turned_by(step, time)
        tone = tone.changed(step * min(1.0, MOST_STEP / max(turned, 1e-300)))
        if turned < SETTLED:
            break
    return tone


def bent_start(time: Array, phase: Array, size: Array, degree: int) -> Tone:
    """The tone whose exponent is the polynomial nearest to a phase and the logarithm of an amplitude.

    >>> t = np.linspace(0.0, 2.0, 50)
    >>> found = bent_start(t, 1.0 + 9.0 * t + 0.5 * t**2, 2.0 * np.exp(-0.3 * t), 2)
    >>> round(found.omega, 9), round(found.growth, 9), round(found.amplitude, 9), round(found.bends[0].imag, 9)
    (9.0, -0.3, 2.0, 2.0)
    """
    span, log = float(time[-1]), np.log(np.maximum(size, 1e-6 * float(size.max())))
    weight = np.maximum(size, FAINT * float(size.max()))  # where there is none of it, too: the exponent must not rise
    turn, fall = (np.polynomial.polynomial.polyfit(time / span, values, degree, w=weight) for values in (phase, log))
    bends = tuple(complex(re, im) for re, im in zip(fall[2:], turn[2:], strict=True))
    return Tone(float(turn[1]) / span, float(fall[1]) / span, complex(np.exp(fall[0] + 1j * turn[0])), bends, span)


def refitted(left: Array, tone: Tone, *, time: Array, sound: Array) -> Tone:
    """A tone fitted anew from where it is."""
    return fitted_tone(left, time, tone.omega, sound, tone)


def each_refitted(
    left: Array, time: Array, tones: tuple[Tone, ...], refit: Callable[[Array, Tone], Tone]
) -> tuple[tuple[Tone, ...], Array]:
    """Tones, each fitted anew to what the others leave of samples, one after the other; and what all of them leave.

    Parameters
    ----------
    left : array of float, shape (N,)
        What the tones leave now.
    time : array of float, shape (N,)
        From the first sample on.
    tones : tuple of Tone
        As they are.
    refit : callable
        Gives a tone for what the others leave and the tone as it was.
    """
    for i, tone in enumerate(tones):
        rest = left + tone.samples(time)
        new = refit(rest, tone)
        left, tones = rest - new.samples(time), (*tones[:i], new, *tones[i + 1 :])
    return tones, left


def total(tones: tuple[Tone, ...], time: Array) -> Array:
    """The sum of tones."""
    return np.sum([tone.samples(time) for tone in tones], axis=0) if tones else np.zeros(time.size)


def beside_notes(tones: tuple[Tone, ...], spikes: int) -> tuple[str, ...]:
    """What was found beside an oscillation, in words.

    >>> beside_notes((), 1)
    ('1 sample lies far outside the noise (spikes); they enter no fit.',)
    """
    notes = []
    if tones:
        listed = "; ".join(tone.said() for tone in tones)
        notes.append(f"Beside the oscillation, fitted with it and taken off: {listed}.")
    if spikes:
        what = "sample lies" if spikes == 1 else "samples lie"
        notes.append(f"{spikes} {what} far outside the noise (spikes); they enter no fit.")
    return tuple(notes)
