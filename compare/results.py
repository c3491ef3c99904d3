"""What a comparison hands over: frozen values, complete at construction, ready to print, store or draw.

Angular frequency is in rad per time unit throughout; ``hz`` appears only in names of values in hertz.
Times are in the oscillator's own unit (s for a recording).  Arrays are one-dimensional float64 and read-only,
except the grids of a study, which are ``[order, amplitude]``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask

if TYPE_CHECKING:
    pass

Kind = Literal["reference", "model", "expansion", "estimate"]


@dataclass(frozen=True)
class Formula:
    """One printed relation: ``left = sum of terms``, each term its own LaTeX so that it can wrap."""

    title: str
    left: str
    terms: tuple[str, ...]
    note: str = ""
    python: str = ""


@dataclass(frozen=True)
class Study:
    """Error of truncated expansions over order and amplitude; grids are ``[order, amplitude]``."""

    system: str
    title: str
    method: str
    variable: str
    """``A`` (amplitude) or ``eps`` (limit cycles): what ``amplitudes`` holds."""
    amplitude_definition: str
    amplitude_unit: str
    orders: tuple[int, ...]
    amplitudes: Array
    omega: Array
    reference: Array
    reference_error: Array
    """Relative uncertainty of the reference at each amplitude."""
    reference_name: str
    relative_error: Array
    """``omega / reference - 1``, signed."""
    limit: float | None
    """Where the oscillation itself ends (separatrix), or None."""
    convergence_radius: float | None
    scale: float
    """The natural frequency k that omega is printed with."""
    convergence_uncertainty: float | None = None
    """Uncertainty of ``convergence_radius``, in the same variable."""
    convergence_note: str = ""
    """Where the radius comes from, or why none is known."""

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
    """Largest studied amplitude below which the target holds everywhere; None when it holds nowhere."""


@dataclass(frozen=True)
class CertifiedRow:
    """One formula: its relative errors, proved to within ``radius``; None where it does not hold."""

    method: str
    errors: tuple[float | None, ...]
    radius: float


@dataclass(frozen=True)
class Certified:
    """The series and its resummations of one order, each error enclosed against the exact frequency."""

    order: int
    amplitudes: Array
    """Peak amplitudes."""
    rows: tuple[CertifiedRow, ...]


@dataclass(frozen=True)
class Curve:
    """One omega0(t): a reference, a model, an expansion bound to an amplitude, or an estimate."""

    name: str
    label: str
    kind: Kind
    time: Array
    omega: Array
    valid: Mask
    standard_deviation: Array | None = None
    bias: Array | None = None
    note: str = ""
    settings: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Score:
    """Relative error of one curve against the cycle frequency, by zone.  None where nothing is valid."""

    method: str
    label: str
    kind: Kind
    rms_interior: float | None
    max_interior: float | None
    mean_interior: float | None
    """Signed: negative means low."""
    rms_start: float | None
    rms_end: float | None
    note: str = ""
    failed: str = ""
    """Why the method gave nothing, when it did not."""


@dataclass(frozen=True)
class Standing:
    """One estimator with its own defaults on the samples of a motion, with and without its bias."""

    method: str
    rms_raw: float | None
    """Relative, like the next four, against the cycle frequency; over the interior, bias left in."""
    rms_interior: float | None
    """Over the interior, bias removed; so are the next two."""
    rms_start: float | None
    rms_end: float | None
    half_width: float | None
    """Median half width of its 95 % interval over the interior; None where it claims none."""
    coverage: float | None
    """Share of the interior's samples whose interval holds the reference."""
    seconds: float
    """CPU time of the whole track on the machine that made the page."""
    note: str = ""
    failed: str = ""
    """Why the method gave nothing, when it did not."""


@dataclass(frozen=True)
class BudgetRow:
    """Where a curve's distance from the reference comes from (relative, rms over the interior)."""

    method: str
    label: str
    truncation: float | None
    averaging: float | None
    estimator: float | None
    reference: float
    """Numerical error of the reference itself."""
    total: float
    closure: float
    """rms of what the named parts leave unexplained."""
    note: str = ""
    definition: float = 0.0
    """How well omega0(t) of a decay is defined at all: crossings against turning points."""


@dataclass(frozen=True)
class Timing:
    """Median time of one evaluation over an array, in nanoseconds per value, with its spread."""

    name: str
    nanoseconds: float
    low: float
    high: float
    values: int
    note: str = ""


@dataclass(frozen=True)
class Statement:
    """What the paper says of one of its figures, and what was measured here."""

    figure: int
    title: str
    paper: str
    """Paraphrase of the paper's own words."""
    measured: str
    """Our finding, with numbers."""
    curves: tuple[str, ...] = ()
    """Names of the curves that this figure draws beside the reference (of ``curves`` and ``harmonics``)."""


@dataclass(frozen=True)
class Case:
    """What was run: the oscillator, its numbers, the initial state and the sampling."""

    system: str
    title: str
    equation: str
    """The equation as text, e.g. ``u'' + 2*mu*u' + k**2*sin(u) = 0``."""
    equation_latex: str
    symbol: str
    """LaTeX of the unknown: ``\\theta`` for the pendulum, else ``u``."""
    unit: str
    """Unit of the unknown (``rad`` or empty)."""
    time_unit: str
    reference: str
    parameters: Mapping[str, float]
    initial: tuple[float, float]
    duration: float
    rate: float


@dataclass(frozen=True)
class Image:
    """A time-frequency plane for display: level in dB re its maximum, ``level[frequency, time]``."""

    name: str
    time: Array
    omega: Array
    level_db: NDArray[np.float64]
    floor_db: float
    overlays: tuple[Curve, ...] = ()
    note: str = ""


@dataclass(frozen=True)
class Amplitudes:
    """Amplitude along the decay, definition ``peak``: by energy (21), averaged action, turning points."""

    time: Array
    energy: Array
    averaged: Array | None
    turning_time: Array
    turning_value: Array
    """Positive and negative turning points, signed as observed."""
    note: str = ""


@dataclass(frozen=True)
class Reconstruction:
    """The signal against its models: (22)-(23) with one component, (7) with several."""

    time: Array
    signal: Array
    single: Array
    multicomponent: Array | None
    components: int
    rms_single: float
    """rms of the difference divided by rms of the signal."""
    rms_multicomponent: float | None
    note: str = ""


@dataclass(frozen=True)
class DecayComparison:
    """Everything along one integrated trajectory."""

    case: Case
    time: Array
    u: Array
    velocity: Array
    integrators: tuple[str, ...]
    """Description of each integrator, first the one used."""
    disagreement: float | None
    """Largest difference between the integrators over the samples, in the unit of u."""
    amplitudes: Amplitudes
    reference: Curve
    interior: tuple[float, float]
    curves: tuple[Curve, ...]
    scores: tuple[Score, ...]
    budget: tuple[BudgetRow, ...]
    reconstruction: Reconstruction
    spectrogram_u: Image
    spectrogram_velocity: Image
    wigner_u: Image
    harmonics: tuple[Curve, ...]
    """Harmonic tracks (omega of the harmonic itself, not divided), their predictions, and the raw peak."""
    statements: tuple[Statement, ...]


@dataclass(frozen=True)
class Derivation:
    """The exact side of the page: formulas, certificate lines, generated code."""

    system: str
    formulas: tuple[Formula, ...]
    certificate: tuple[str, ...]
    code: Mapping[str, str]
    """Language name to source text."""


@dataclass(frozen=True)
class RecordingComparison:
    """A user's recording: its tracks, backbone and damping, with bands."""

    source: str
    sha256: str
    column: str
    rate: float
    time: Array
    signal: Array
    curves: tuple[Curve, ...]
    chosen: str
    """Name of the curve the backbone is made from, and why in ``notes``."""
    spectrogram: Image
    amplitude_time: Array
    amplitude: Array
    backbone_amplitude: Array
    backbone_omega: Array
    backbone_omega_sd: Array
    damping_amplitude: Array
    damping: Array
    damping_sd: Array
    fit: Formula | None
    notes: tuple[str, ...]
    theory: tuple[Curve, ...] = ()


@dataclass(frozen=True)
class Provenance:
    """How to get the same page again."""

    command: str
    versions: Mapping[str, str]
    parameters: Mapping[str, str]
    settings_hash: str
    input_hash: str = ""
    seconds: Mapping[str, float] = field(default_factory=dict)
