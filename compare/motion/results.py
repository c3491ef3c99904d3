"""What a comparison along one motion hands over: frozen values, complete at construction, ready to print or draw.

Angular frequency is in rad per time unit throughout; times are in the oscillator's own unit (s for a recording).
Arrays are one-dimensional float64 and read-only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array, Mask

Kind = Literal["reference", "model", "expansion", "estimate"]


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
