"""Fit an oscillator's own equation to samples: initial state, free parameters, offset and noise level.

    x(t_n) = u(t_n; u0, v0, p) + d + noise,       u'' + f(u, u'; p) = 0,

by least squares, which is maximum likelihood in white Gaussian noise, with exact sensitivities
(``model_fit.sensitivity``), from a start near enough (``model_fit.problem``).  The covariance is the inverse
Fisher matrix, so that the deviations are the Cramer-Rao bound of this model at the fitted values.  A residual that is
not white says that the equation is not the one that made the samples.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, silent
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal, decompose
from ridgeback.numeric.harmonics.local_fit import choose_multiples
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.problem import EVALUATIONS, OFFSET, Polar, Problem, inverse_normal, polar_of
from ridgeback.numeric.model_fit.sensitivity import steps_needed
from ridgeback.numeric.model_fit.start import matched
from ridgeback.numeric.model_fit.whiteness import Whiteness, whiteness
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.numeric.signal.decimation import Samples, checked
from ridgeback.numeric.signal.samples import TWO_PI, checked_work
from ridgeback.numeric.signal.search_band import find_search_band
from ridgeback.numeric.signal.windows import half_width
from ridgeback.numeric.tracking.request import FEWEST_SAMPLES, LAG_CYCLES

SPAN = 4.0
"""Cycles that a fit begins with when the whole record at once ends in a false minimum."""
GROWTH = 1.5
LOCKED = 0.1
"""A fit that leaves over less than this share of the signal's power has found its minimum."""
LOST = 0.5
"""One that leaves over more than this share is no fit at all."""
COARSE, FINE = 1e-4, 1e-10
"""Tolerances of the solver before and in the last stage."""
ROUNDING = 1e-9
"""Integration error aimed at, in swings of the signal, where the noise is smaller still."""
OPERATIONS = 5e4
"""Work of one step with its sensitivities, in the units of numeric.signal.samples.WORK_BUDGET."""
MISFIT = 0.01
"""A residual that white noise would show less often than this is called a misfit."""


@dataclass(frozen=True, repr=False)
class ModelFit(Displayed):
    """An oscillator fitted to samples.

    Parameters
    ----------
    family : Family
        What was fitted.
    theta : array of float, shape (3 + P,)
        u0, v0, the offset and the parameters, in this order.
    covariance : array of float, shape (3 + P, 3 + P)
        That of ``theta``; row and column of the offset are 0 where it was not fitted.
    noise : float
        Standard deviation of the residual, parameters accounted for.
    residual, fitted : array of float, shape (N,)
        What the fit leaves of the samples, and the fit.
    white : Whiteness, optional
        The test of the residual; None where it is nothing but rounding.
    steps : int
        Integration steps per sample.
    rate, start : float
        Samples per time unit, and the time of the first.

    Examples
    --------
    >>> import ridgeback
    >>> t = np.arange(320) / 32.0
    >>> fit = ridgeback.model_fit(np.exp(-0.05 * t) * np.cos(6.0 * t), 32.0, oscillator="linear")
    >>> fit.theta.shape, round(float(fit.noise), 6)
    ((5,), 0.0)
    """

    family: Family
    theta: Array
    covariance: Array
    noise: float
    """Standard deviation of the residual, parameters accounted for."""
    residual: Array
    fitted: Array
    white: Whiteness | None
    """The test of the residual; None where it is nothing but rounding."""
    steps: int
    """Integration steps per sample."""
    rate: float
    start: float

    def __post_init__(self) -> None:
        freeze(self)

    INDEX: ClassVar[tuple[str, ...]] = ("parameter",)

    def headline(self) -> str:
        """The fitted parameters and the noise."""
        deviations = self.deviations[3:].tolist()
        fitted = ", ".join(
            f"{n} = {v:.6g} ± {s:.1g}" for (n, v), s in zip(self.parameters.items(), deviations, strict=True)
        )
        return f"{self.family.name}, {fitted}, noise {self.noise:.3g}{', a misfit' if self.misfit else ''}"

    def own_units(self) -> dict[str, str]:
        """Each parameter has a unit of its own."""
        return {"value": "of the parameter", "standard_deviation": "of the parameter"}

    def picture(self) -> Picture:
        """Samples and fit over time."""
        time = self.start + np.arange(self.fitted.size) / self.rate
        strokes = (Stroke(time, self.fitted + self.residual, "samples"), Stroke(time, self.fitted, "fit", dashed=True))
        return Picture(self.family.name, "time", "unit of the samples", strokes)

    @property
    def initial(self) -> tuple[float, float]:
        """The state (u, u') at the first sample."""
        return float(self.theta[0]), float(self.theta[1])

    @property
    def offset(self) -> float:
        """What the samples read when the oscillator is at rest."""
        return float(self.theta[2])

    @property
    def parameters(self) -> dict[str, float]:
        """The free parameters by name."""
        return dict(zip(self.family.names, self.theta[3:].tolist(), strict=True))

    @property
    def dynamics(self) -> Dynamics:
        """The oscillator with the fitted parameters."""
        return self.family.dynamics(self.theta[3:].tolist())

    @property
    def deviations(self) -> Array:
        """One standard deviation of each entry of ``theta``."""
        return np.asarray(np.sqrt(np.diagonal(self.covariance)))

    @property
    def misfit(self) -> bool:
        """Whether the residual is so far from white that the equation cannot be what made the samples."""
        return self.white is not None and self.white.probability < MISFIT

    def rows(self) -> list[dict[str, float | str]]:
        """One row per fitted value: parameter, value, standard_deviation."""
        labels = ("u0", "v0", "offset", *self.family.names)
        values = zip(labels, self.theta.tolist(), self.deviations.tolist(), strict=True)
        return [{"parameter": name, "value": value, "standard_deviation": sd} for name, value, sd in values]


def model_fit(
    x: ArrayLike,
    rate: float,
    family: Family,
    *,
    start: float = 0.0,
    free_offset: bool = True,
    band: tuple[float, float] | None = None,
    progress: Progress = silent,
) -> ModelFit:
    """Fit a family of oscillators to samples: initial state, free parameters, offset and noise level.

    Parameters
    ----------
    x : array of float, shape (N,)
        Real samples in the oscillator's own unit, evenly spaced.
    rate : float
        Samples per time unit.
    family : Family
        The oscillator and its free parameters, with values to start from.
    start : float
        Time of the first sample.
    free_offset : bool
        Whether the offset is fitted; False holds it at 0.
    band : (float, float), optional
        Where the oscillation is looked for, rad per time unit.
    progress : callable
        Told the share that is done and the step.

    Returns
    -------
    ModelFit
        Fitted values with their covariance, the residual, and the test of whether it is white.

    Raises
    ------
    InputError
        Where no oscillation is found, where the samples do not determine the parameters, and where no fit locks on to
        the signal.

    Examples
    --------
    >>> from ridgeback.numeric.motion.dynamics import linear
    >>> family = Family("linear", ("k",), np.array([5.0]), lambda u, v, p: p[0] ** 2 * u,
    ...     lambda u, v, p: p[0] ** 2 * u, lambda u, v, p: (p[0] ** 2, 0.0, 2 * p[0] * u), lambda p: linear(p[0]))
    >>> t = np.arange(400) / 20.0
    >>> fit = model_fit(np.cos(7.0 * t) + 0.5, 20.0, family)
    >>> round(fit.parameters["k"], 6), round(fit.offset, 6)
    (7.0, 0.5)
    """
    samples = checked(x, rate, start=start, what="the fit of an oscillator", at_least=FEWEST_SAMPLES)
    return fitted(samples, family, free_offset=free_offset, band=band, progress=progress)


def fitted(
    given: Samples,
    family: Family,
    *,
    free_offset: bool = True,
    band: tuple[float, float] | None = None,
    progress: Progress = silent,
) -> ModelFit:
    """:func:`model_fit` of checked samples."""
    samples, rate = given.x, given.rate
    progress(0.0, "harmonics of the signal")
    signal = smooth_model(samples, rate, band=band)
    floor = free_noise(samples, signal)
    progress(0.2, "a start for the parameters")
    begin, limits = matched(family, signal, free_offset=free_offset)
    problem = Problem(samples, rate, family, free_offset, 4.0 * float(np.ptp(samples)), 1, limits)
    problem = stepped(problem, begin, signal, floor)
    power = max(float(np.var(samples)) - floor**2, np.finfo(float).tiny)
    progress(0.4, f"{family.name}, fitted to the samples")
    theta, left = best_fit(problem, begin, polar_of(signal, float(begin[OFFSET])), floor**2, power)
    if not left <= LOST * power:
        raise InputError(
            f"{family.name}: no fit of {', '.join(family.names)} locks on to the signal ({left / power:.0%} of its "
            "power is left over); start nearer to the parameters, free others, or try another oscillator"
        )
    progress(0.9, "deviations and the residual")
    return finished(problem, theta, given.start)


def best_fit(problem: Problem, begin: Array, goal: Polar, floor: float, power: float) -> tuple[Array, float]:
    """Fit angle and radius, then the samples; where that ends in a false minimum, samples over growing spans.

    Returns theta and the mean square that it leaves over beyond ``floor``, that of the noise.
    """
    n = problem.x.size
    near = problem.contained(begin, goal)
    polar = problem.solve(lambda theta: problem.polar_gap(theta, goal), near, tolerance=COARSE, loss="soft_l1")
    starts: tuple[Callable[[], Array], ...] = (
        lambda: polar,
        lambda: grown(problem, polar, SPAN * TWO_PI / goal.w),
        lambda: grown(problem, near, SPAN * TWO_PI / goal.w),
    )
    best, least = begin, np.inf
    for start in starts:
        theta = problem.solve(lambda theta: problem.gap(theta, n), start(), tolerance=FINE)
        left = float(np.mean(problem.gap(theta, n)[0] ** 2)) - floor
        if left < least:
            best, least = theta, left
        if least <= LOCKED * power:
            break
    return best, least


def grown(problem: Problem, theta: Array, seconds: float) -> Array:
    """Fit the samples of spans that grow from ``seconds`` towards the whole record."""
    n = max(2 * theta.size, round(seconds * problem.rate))
    while n < problem.x.size:
        theta = problem.solve(partial(problem.gap, n=n), theta, tolerance=COARSE)
        n = int(np.ceil(GROWTH * n))
    return theta


def stepped(problem: Problem, theta: Array, signal: HarmonicSignal, noise: float) -> Problem:
    """Step finely enough for an integration error small against the noise, once the cost is seen to fit."""
    size, swing = problem.x.size, float(np.ptp(problem.x))
    cycle = TWO_PI / float(np.median(signal.omega))
    u0, v0, _, *p = theta.tolist()
    steps = steps_needed(
        problem.family,
        p,
        (u0, v0),
        samples=min(size, round(2.0 * cycle * problem.rate) + 2),
        rate=problem.rate,
        bound=problem.bound,
        tolerance=max(ROUNDING * swing, 1e-3 * noise),
    )
    what = f"the fit of {problem.family.name} to {size} samples"
    checked_work(size * steps * OPERATIONS * 3 * EVALUATIONS, what, "fit a shorter part of the record")
    return replace(problem, steps=steps)


def smooth_model(x: Array, rate: float, *, band: tuple[float, float] | None = None) -> HarmonicSignal:
    """The record as slow harmonics of the strongest component, found along a spectrogram's ridge and refined once."""
    if not np.ptp(x) > 0.0:
        raise InputError(f"signal is constant at {x[0]:g}; there is no oscillation to fit")
    real = x - x.mean()
    search = find_search_band(real, rate, band=band)
    lag = min(LAG_CYCLES * TWO_PI / float(np.median(search.guide)), 0.999 * (x.size - 1) / rate)
    omega = np.clip(decompose(x, search.guide, rate).omega, search.low, search.high)
    multiples = choose_multiples(real, rate, omega, half=half_width(lag, rate, longest=x.size))
    return decompose(x, omega, rate, multiples=(1, *multiples))


def free_noise(x: Array, signal: HarmonicSignal) -> float:
    """Noise level that a free harmonic model leaves, its parameters accounted for."""
    freedom = x.size - signal.parameters
    return float(np.sqrt(np.sum((x - signal.values()) ** 2) / max(freedom, 0.1 * x.size)))


def finished(problem: Problem, theta: Array, start: float) -> ModelFit:
    """Covariance, noise and the test of the residual."""
    n, kept = problem.x.size, problem.kept
    gap, jacobian = problem.gap(theta, n)
    variance = float(gap @ gap) / max(1, n - kept.size)
    covariance = np.zeros((theta.size, theta.size))
    covariance[np.ix_(kept, kept)] = variance * inverse_normal(jacobian[:, kept], problem.labels)
    rounding = 100.0 * ROUNDING * float(np.ptp(problem.x))
    return ModelFit(
        family=problem.family,
        theta=theta,
        covariance=covariance,
        noise=float(np.sqrt(variance)),
        residual=-gap,
        fitted=problem.x + gap,
        white=whiteness(gap) if np.std(gap) > rounding else None,
        steps=problem.steps,
        rate=problem.rate,
        start=start,
    )
