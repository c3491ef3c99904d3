"""An even polynomial fitted to a measured backbone: omega0(a) = w0 + w2 a^2 + w4 a^4 + ..., by weighted least squares.

Even, because the frequency of an oscillator does not depend on the sign of its amplitude; the degree is the one that
minimises the Bayesian information criterion, so that the form claims no more than the points support.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ridgeback.common.numbers import uncertain
from ridgeback.common.quantities import unit_text
from ridgeback.compare.study.results import Formula
from ridgeback.numeric.arrays import Array

MOST_TERMS = 4


@dataclass(frozen=True)
class BackboneFit:
    """Coefficients of a^0, a^2, ... with their standard deviations, and the weighted residual."""

    coefficients: Array
    deviations: Array
    residual: float
    """Root mean square of the residuals in units of their own standard deviations: about 1 when the form is right."""

    def __call__(self, amplitude: Array) -> Array:
        """Evaluate omega0 at amplitudes, rad per time unit."""
        return np.asarray(np.polynomial.polynomial.polyval(np.asarray(amplitude) ** 2, self.coefficients))


def fit_backbone(amplitude: Array, omega: Array, deviation: Array) -> BackboneFit | None:
    """Fit omega0(a) = w0 + w2 a^2 + w4 a^4 + ... by weighted least squares, its degree by the least BIC.

    Parameters
    ----------
    amplitude
        Fundamental amplitudes, shape (n,).
    omega
        Angular frequency at each, shape (n,), rad per time unit.
    deviation
        Standard deviation of each frequency, shape (n,), the same unit.

    Returns
    -------
    BackboneFit or None
        None with fewer than three usable points.

    Examples
    --------
    >>> a = np.linspace(0.1, 1.0, 12)
    >>> fit_backbone(a, 2.0 - 0.25 * a**2, np.full(12, 1e-3)).coefficients.round(9).tolist()
    [2.0, -0.25]
    """
    floor = 1e-9 * float(np.abs(omega).max(initial=1.0))
    usable = np.isfinite(amplitude) & np.isfinite(omega) & np.isfinite(deviation)
    if np.count_nonzero(usable) < 3:
        return None
    square, y, sigma = amplitude[usable] ** 2, omega[usable], np.maximum(deviation[usable], floor)
    fits = [_fit(square, y, sigma, terms) for terms in range(1, min(MOST_TERMS, y.size - 1) + 1)]
    return min(fits, key=lambda fit: y.size * fit.residual**2 + fit.coefficients.size * np.log(y.size))


def _fit(square: Array, y: Array, sigma: Array, terms: int) -> BackboneFit:
    scale = float(square.max())
    columns = (square[:, None] / scale) ** np.arange(terms) / sigma[:, None]
    target = y / sigma
    solution, *_ = np.linalg.lstsq(columns, target, rcond=None)
    covariance = np.linalg.pinv(columns.T @ columns)
    residual = float(np.sqrt(np.mean((columns @ solution - target) ** 2)))
    units = scale ** -np.arange(terms, dtype=float)
    inflation = max(1.0, residual)
    return BackboneFit(solution * units, np.sqrt(np.diag(covariance)) * units * inflation, residual)


def formula_of(fit: BackboneFit, unit: str = "") -> Formula:
    r"""Print a fit, its coefficients with their uncertainty in the note; ``unit`` is that of the amplitude.

    >>> formula_of(BackboneFit(np.array([2.0, -0.25]), np.array([0.01, 0.002]), 1.0)).terms
    ('2.000', '-0.2500\\,a^{2}')
    """
    terms = tuple(_term(value, deviation, 2 * n) for n, (value, deviation) in enumerate(_pairs(fit)))
    spread = ", ".join(uncertain(value, deviation) for value, deviation in _pairs(fit))
    return Formula(
        title="Measured backbone, even polynomial in the fundamental amplitude",
        left=r"\omega_0(a)",
        terms=terms,
        note=(
            f"ω₀ in rad/s, a in {unit_text(unit) or 'the unit of the signal'}. Coefficients with one standard "
            f"deviation: {spread}. Residuals are {fit.residual:.2g} times their own standard deviation, root mean "
            "square."
        ),
        python="omega0 = " + " + ".join(f"({value!r})*a**{2 * n}" for n, (value, _) in enumerate(_pairs(fit))),
    )


def _pairs(fit: BackboneFit) -> list[tuple[float, float]]:
    return list(zip(fit.coefficients.tolist(), fit.deviations.tolist(), strict=True))


def _term(value: float, deviation: float, power: int) -> str:
    """Digits down to a tenth of the uncertainty."""
    known = np.log10(abs(value) / deviation) if value and deviation > 0 else 5.0
    digits = int(np.clip(np.ceil(known) + 1, 2, 12))
    mantissa, _, exponent = f"{value:#.{digits}g}".rstrip(".").partition("e")
    number = rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa
    return number if power == 0 else rf"{number}\,a^{{{power}}}"
