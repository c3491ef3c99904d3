"""Fits compared: the information criterion, the number of independent samples, and deviations of all fitted.

    BIC  = n ln(RSS / N) + p ln n,        AICc = n ln(RSS / N) + 2 p n / (n - p - 1),

with p parameters and n effective samples.  A residual that is not white does not hold N independent values: for its
variance, which the criterion compares, N values with autocorrelation rho_k count as N / sum over k of rho_k^2 (M. S.
Bartlett, J. R. Stat. Soc. Suppl. 8 (1946) 27-41).  A residual that fills a share f of the band is so counted as f N.
n is that of the best candidate's residual, and its p, which the fit has taken out of the residual.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy import fft

from ridgeback.compare.identification.candidates import BACKBONE
from ridgeback.compare.identification.fitting import Data, Fit, bounds
from ridgeback.compare.identification.results import Candidate, Parameter
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.tracking.track import NORMAL_95

CRITERIA = ("bic", "aicc")
CLEAR = 6.0
"""A distance from here on counts as strong evidence (Kass and Raftery, J. Am. Stat. Assoc. 90 (1995) 773-795)."""
ROUNDING = 1e-8
"""Residuals below this share of the signal are those of the slow flow's tables and of rounding: they tell nothing."""
POINTS = 41


def effective_number(residual: Array) -> float:
    """Number of independent values that give a residual's variance as well, at most its size.

    >>> rng = np.random.default_rng(1)
    >>> white = rng.normal(size=4000)
    >>> smooth = np.convolve(white, np.ones(10), "valid")  # sum of rho^2 = 1 + 2 * 2.85 = 6.7
    >>> bool(effective_number(white) > 3800), bool(abs(smooth.size / effective_number(smooth) - 6.7) < 0.5)
    (True, True)
    """
    x = residual - residual.mean()
    size = x.size
    power = np.abs(fft.rfft(x, fft.next_fast_len(2 * size))) ** 2
    correlation = fft.irfft(power, fft.next_fast_len(2 * size))[: size // 5]
    if not correlation[0] > 0:
        return 1.0
    square = (correlation[1:] / correlation[0]) ** 2
    # each estimated correlation has itself the variance total / N, which its square adds
    total = (1.0 + 2.0 * float(np.sum(square))) / (1.0 + 2.0 * square.size / size)
    return float(np.clip(size / total, 1.0, size))


def criterion(fit: Fit, effective: float, kind: str) -> float:
    """BIC or AICc of a fit, counting ``effective`` samples; infinite AICc without more of these than parameters."""
    p, N = fit.model.count, fit.residual.size
    mean_square = max(fit.sum_of_squares / N, ROUNDING**2)
    data = effective * math.log(mean_square)
    if kind == "bic":
        return data + p * math.log(effective)
    return data + 2 * p * effective / (effective - p - 1) if effective > p + 1 else math.inf


def covariance(fit: Fit) -> Array:
    """Covariance of theta: the residual variance, as many times larger as its correlation costs independent samples."""
    N, p = fit.residual.size, fit.model.count
    inflation = N / effective_number(fit.residual)
    return np.asarray(fit.spread * (fit.sum_of_squares / max(1, N - p) * inflation))


def slopes(function: Callable[[Array], Array], theta: Array, deviation: Array, low: Array, high: Array) -> Array:
    """Derivatives ``[value, parameter]`` by differences of a tenth of each deviation, inside the bounds."""
    columns = []
    for i, step in enumerate(0.1 * deviation + 1e-9 * np.abs(theta) + 1e-15):
        up, down = theta.copy(), theta.copy()
        up[i], down[i] = min(theta[i] + step, high[i]), max(theta[i] - step, low[i])
        columns.append((function(up) - function(down)) / (up[i] - down[i]))
    return np.asarray(np.array(columns).T, dtype=np.float64)


def undetermined(fit: Fit, data: Data, matrix: Array) -> Mask:
    """Which of theta the samples do not determine within the whole of its range."""
    low, high = bounds(fit.model, data)
    return np.asarray(np.sqrt(np.diag(matrix)) > high - low)


def spread_along(
    function: Callable[[Array], Array], fit: Fit, data: Data, matrix: Array, *, unknown: float = math.nan
) -> Array:
    """One standard deviation of each value of a function of theta, by the delta method.

    ``unknown`` where most of it is of what the samples do not determine, which then lies anywhere in its range.
    """
    low, high = bounds(fit.model, data)
    reach = np.where(np.isfinite(high - low), high - low, np.inf)
    lost = undetermined(fit, data, matrix)
    shrunk = np.where(lost, reach / np.sqrt(np.where(lost, np.diag(matrix), 1.0)), 1.0)
    matrix = matrix * np.outer(shrunk, shrunk)
    deviation = np.minimum(np.sqrt(np.diag(matrix)), np.where(np.isfinite(reach), reach, 1.0))
    derivative = slopes(function, fit.theta, deviation, low, high)
    variance = np.maximum(np.einsum("ip,pq,iq->i", derivative, matrix, derivative), 0.0)
    nowhere = np.sum((derivative * deviation * lost) ** 2, axis=1) > 0.5 * variance
    return np.where(nowhere & (variance > 0.0), unknown, np.sqrt(variance))


def parameters(fit: Fit, data: Data, matrix: Array, unit: str) -> tuple[Parameter, ...]:
    """The equation's parameters, the start and the offset, each with its deviation."""
    model, length = fit.model, data.length

    def values(theta: Array) -> Array:
        own = [x[1] for x in model.physical(theta[: 1 + model.size], length)]
        return np.array([*own, length * math.exp(theta[-3]), theta[-2], length * theta[-1] + data.measured.offset])

    described = [
        *((name, text, meaning) for name, _, text, meaning in model.physical(fit.theta[: 1 + model.size], length)),
        ("a0", "U", "fundamental amplitude at the start"),
        ("phase0", "rad", "phase at the start"),
        ("offset", "U", "zero of the sensor"),
    ]
    found, spread = values(fit.theta), spread_along(values, fit, data, matrix, unknown=math.inf)
    return tuple(
        Parameter(name, float(value), float(sd), in_units(text, unit), meaning)
        for (name, text, meaning), value, sd in zip(described, found, spread, strict=True)
    )


def in_units(text: str, unit: str) -> str:
    """A unit with T as the second and U as the signal's unit.

    >>> in_units("1/(T^2 U)", "mm"), in_units("rad/T", "mm"), in_units("U", "")
    ('1/(s^2 mm)', 'rad/s', '')
    >>> in_units("rad/(T U^2)", "V s^2")
    'rad/(s (V s^2)^2)'
    """
    named = text.replace("T", "s")
    if named == "U":
        return unit
    own = f"({unit})" if any(sign in unit for sign in " /*^") else unit
    return named.replace("U", own or "u")


def candidate(fit: Fit, data: Data, unit: str, score: float, best: float, total: float) -> Candidate:
    """Everything that is handed over about one fit."""
    matrix = covariance(fit)
    span = float(data.time[-1])
    a = np.linspace(float(data.measured.amplitude.min()), float(data.measured.amplitude.max()), POINTS)

    def both(theta: Array) -> Array:
        return np.concatenate(fit.model.curves(theta, a / data.length, span))

    omega, growth_rate = np.split(both(fit.theta), 2)
    omega_sd, growth_rate_sd = np.split(spread_along(both, fit, data, matrix), 2)
    return Candidate(
        name=fit.model.name,
        title=fit.model.title,
        equation=fit.model.equation,
        damping_law=fit.model.law,
        parameters=parameters(fit, data, matrix, unit),
        criterion=score,
        delta=score - best,
        weight=math.exp(-0.5 * (score - best)) / total,
        residual=data.length * math.sqrt(fit.sum_of_squares / fit.residual.size),
        amplitude=a,
        omega=omega,
        omega_low=omega - NORMAL_95 * omega_sd,
        omega_high=omega + NORMAL_95 * omega_sd,
        growth_rate=growth_rate,
        growth_rate_low=growth_rate - NORMAL_95 * growth_rate_sd,
        growth_rate_high=growth_rate + NORMAL_95 * growth_rate_sd,
        note=at_bounds(fit, data),
        has_equation=fit.model.name != BACKBONE,
    )


def at_bounds(fit: Fit, data: Data) -> str:
    """Say where a shape came to rest at the end of its range, so that its deviation means nothing."""
    low, high = bounds(fit.model, data)
    shapes = range(1, 1 + fit.model.size - fit.model.rates)
    at = [
        i
        for i in shapes
        if min(fit.theta[i] - low[i], high[i] - fit.theta[i]) <= 1e-3 * min(1.0, max(abs(low[i]), abs(high[i])))
    ]
    if not at:
        return ""
    return "A shape parameter rests at the end of its range: the data do not ask for it, and its deviation is nominal."
