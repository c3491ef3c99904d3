"""What an accuracy-order study hands over: errors over order and amplitude, ranges of use, formulas, times.

Angular frequency is in rad per time unit throughout; times are in the oscillator's own unit (s for a recording).
Arrays are one-dimensional float64 and read-only, except the grids of a study, which
are ``[order, amplitude]``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np

from ridgeback.common.show.brief import Brief
from ridgeback.compare.study.shown import ShownStudy
from ridgeback.numeric.arrays import Array


class Trend(Enum):
    """How omega0 changes with its variable, beyond what it is uncertain by; of a backbone the word that is used."""

    RISING = "hardening"
    FALLING = "softening"
    CONSTANT = "constant"
    BOTH = "partly hardening, partly softening"


def trend_of(omega: Array, uncertainty: Array) -> Trend:
    """The trend of a curve: its largest rise and its largest fall, each against twice the uncertainty.

    Parameters
    ----------
    omega
        Frequency by rising amplitude, shape (n,), rad per time unit.
    uncertainty
        One standard deviation, or a bound, of each value, shape (n,).

    Examples
    --------
    >>> small = np.full(3, 1e-9)
    >>> trend_of(np.array([1.0, 1.1, 1.3]), small), trend_of(np.ones(3), small)
    (<Trend.RISING: 'hardening'>, <Trend.CONSTANT: 'constant'>)
    >>> trend_of(np.array([1.0, 0.9, 1.2]), small)
    <Trend.BOTH: 'partly hardening, partly softening'>
    """
    uncertainty = uncertainty + 4.0 * np.finfo(float).eps * np.abs(omega)
    low, high = np.argmin(omega), np.argmax(omega)
    least = 2.0 * np.hypot(uncertainty, np.maximum(uncertainty[low], uncertainty[high]))
    rise = bool((omega - np.minimum.accumulate(omega) > least).any())
    fall = bool((np.maximum.accumulate(omega) - omega > least).any())
    return {(True, False): Trend.RISING, (False, True): Trend.FALLING, (True, True): Trend.BOTH}.get(
        (rise, fall), Trend.CONSTANT
    )


@dataclass(frozen=True)
class Formula:
    """One printed relation: ``left = sum of terms``, each term its own LaTeX so that it can wrap."""

    title: str
    left: str
    terms: tuple[str, ...]
    note: str = ""
    python: str = ""


@dataclass(frozen=True)
class HarmonicRow:
    """The coefficient of one harmonic of u by powers of the variable, each as LaTeX, empty where it is zero."""

    multiple: int
    """0 for the mean of u."""
    part: str
    """``cos``, ``sin``, or empty for the mean."""
    cells: tuple[str, ...]


@dataclass(frozen=True)
class HarmonicTable:
    """The motion's exact coefficients: a row for each harmonic, a column for each power of the variable."""

    variable: str
    """As LaTeX."""
    powers: tuple[int, ...]
    rows: tuple[HarmonicRow, ...]


@dataclass(frozen=True, repr=False)
class Study(ShownStudy):
    """Error of truncated expansions over order and amplitude; grids are ``[order, amplitude]``.

    Made by :func:`ridgeback.study`.

    Parameters
    ----------
    system, title : str
        Name of the oscillator, and what it is called on a page.
    method : str
        The derivation.
    variable : str
        ``A`` (amplitude) or ``eps`` (limit cycles): what ``amplitudes`` holds.
    amplitude_definition, amplitude_unit : str
        Which amplitude, and its unit.
    orders : tuple of int
        Of the truncations, shape (N,).
    amplitudes : array of float, shape (M,)
        Amplitudes or values of eps.
    omega : array of float, shape (N, M)
        The truncated series, rad per time unit.
    reference, reference_error : array of float, shape (M,)
        The exact frequency, rad per time unit, and its relative uncertainty.
    reference_name : str
        How the exact frequency was found.
    relative_error : array of float, shape (N, M)
        ``omega / reference - 1``, signed.
    limit : float, optional
        Where the oscillation itself ends (separatrix).
    convergence_radius : float, optional
        Radius of convergence of the series, in the variable.
    scale : float
        The natural frequency k, rad per time unit, that omega is printed with.
    convergence_uncertainty : float, optional
        Uncertainty of ``convergence_radius``, in the same variable.
    convergence_note : str
        Where the radius comes from, or why none is known.

    Examples
    --------
    >>> import ridgeback
    >>> found = ridgeback.study("pendulum", (2, 4), [0.5, 1.0])
    >>> found.relative_error.shape, f"{found.relative_error[1, 0]:.0e}"
    ((2, 2), '5e-07')
    """

    system: str
    title: str
    method: str
    variable: str
    amplitude_definition: str
    amplitude_unit: str
    orders: tuple[int, ...]
    amplitudes: Array
    omega: Array
    reference: Array
    reference_error: Array
    reference_name: str
    relative_error: Array
    limit: float | None
    convergence_radius: float | None
    scale: float
    convergence_uncertainty: float | None = None
    convergence_note: str = ""

    @property
    def trend(self) -> Trend:
        """How the exact frequency changes with the variable over the range studied."""
        return trend_of(self.reference, self.reference * self.reference_error)

    def rows(self) -> list[dict[str, float | int | str]]:
        """One row per cell: order, amplitude (or eps), method, omega, omega_reference, relative_error."""
        key = "amplitude" if self.variable == "A" else self.variable
        return [
            {
                "order": order,
                key: float(self.amplitudes[j]),
                "method": self.method,
                "omega": float(self.omega[i, j]),
                "omega_reference": float(self.reference[j]),
                "relative_error": float(self.relative_error[i, j]),
            }
            for i, order in enumerate(self.orders)
            for j in range(self.amplitudes.size)
        ]


@dataclass(frozen=True)
class Range:
    """How far an order may be used: up to the first violation of the target, not the last crossing."""

    order: int
    target: float
    up_to: float | None
    """The amplitude at which the error first passes the target, interpolated between studied ones; the last of them
    when it never does, None when the first is beyond it."""


@dataclass(frozen=True)
class CertifiedRow:
    """One formula: its relative errors, proved to within ``radius``; None where it does not hold."""

    method: str
    errors: tuple[float | None, ...]
    radius: float


@dataclass(frozen=True, repr=False)
class Certified(Brief):
    """The series and its resummations of one order, each error enclosed against the exact frequency."""

    order: int
    amplitudes: Array
    """Peak amplitudes; of a limit cycle values of its small parameter."""
    rows: tuple[CertifiedRow, ...]
    variable: str = "A"
    """What ``amplitudes`` are values of: the amplitude, or the small parameter by name."""


@dataclass(frozen=True)
class Checked:
    """One check of a certificate, made in exact arithmetic."""

    name: str
    statement: str
    passed: bool | None
    """None: it does not apply to this oscillator, and the statement says why."""


@dataclass(frozen=True, repr=False)
class Derivation(Brief):
    """The exact side of the page: formulas, certificate, generated code."""

    system: str
    formulas: tuple[Formula, ...]
    certificate: tuple[Checked, ...]
    code: Mapping[str, str]
    """Language name to source text."""
    harmonics: HarmonicTable | None = None
    order: int = 0
    """The order that certificate and code are about; formulas are printed to ``SHOWN`` at most."""
