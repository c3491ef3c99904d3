"""What a comparison along one motion hands over: frozen values, complete at construction, ready to print or draw.

Angular frequency is in rad per time unit throughout; times are in the oscillator's own unit (s for a recording).
Arrays are one-dimensional float64 and read-only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Literal

from ridgeback.common.show.brief import Brief
from ridgeback.compare.motion.harmonics.folding import Folding
from ridgeback.numeric.arrays import Array, Mask

Kind = Literal["reference", "model", "expansion", "estimate"]


class AmplitudeSource(Enum):
    """Whose amplitude A(t) a model or an expansion is evaluated at."""

    NONE = "none"
    """It is evaluated at none: a reference, an estimate, the linear frequency, a limit cycle."""
    ENERGY = "energy"
    """That of the energy of each instant, the paper's eq. (21)."""
    AVERAGED = "averaged"
    """The smooth one of averaging: the averaged action, or the slow flow."""


class BiasCause(Enum):
    """Why the full Wigner peak is off on average."""

    UNNAMED = "unnamed"
    """The bias is too small, or not known well enough, for a cause to be named."""
    CURVATURE = "curvature"
    """A signal of the fundamental alone shows the same bias."""
    OTHER = "other"
    """It does not: the rest is the part of the harmonics and of the decaying amplitude."""


@dataclass(frozen=True, repr=False)
class Curve(Brief):
    """One omega0(t): a reference, a model, an expansion bound to an amplitude, or an estimate."""

    name: str
    """Identifier, also in files; ``label`` is what a reader sees."""
    label: str
    kind: Kind
    time: Array
    omega: Array
    valid: Mask
    standard_deviation: Array | None = None
    bias: Array | None = None
    note: str = ""
    amplitude: AmplitudeSource = AmplitudeSource.NONE


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
    curves: tuple[Curve, ...] = ()
    """Those that this figure draws beside the reference."""


@dataclass(frozen=True)
class WignerBias:
    """Mean relative error of the full Wigner peak over the interior, by three routes; negative means low."""

    measured: float | None
    fundamental_only: float | None
    """The same peak of a signal of the fundamental alone; None where that gives none."""
    predicted: float
    """The leading curvature formula."""
    cause: BiasCause


@dataclass(frozen=True)
class Integrator:
    """One numerical solution of the motion."""

    method: str
    """The integrator and its own setting, such as ``DOP853`` or ``Taylor, 25 digits``."""
    tolerance: float | None = None
    """Relative tolerance, where it has one."""
    evaluations: int | None = None
    """Evaluations of the force."""
    difference: float | None = None
    """Largest difference of u from the solution before it, over the samples they share; None for the first."""


@dataclass(frozen=True, repr=False)
class Case(Brief):
    """What was run: the oscillator, its numbers, the initial state and the sampling."""

    system: str
    title: str
    equation: str
    """The equation as text, e.g. ``u'' + 2*mu*u' + k**2*sin(u) = 0``."""
    equation_latex: str
    symbol: str
    """The unknown as text: ``θ`` for the pendulum, else ``u``."""
    unit: str
    """Unit of the unknown (``rad`` or empty)."""
    time_unit: str
    reference: str
    parameters: Mapping[str, float]
    initial: tuple[float, float]
    duration: float
    rate: float


@dataclass(frozen=True, repr=False)
class Image(Brief):
    """A time-frequency plane for display: level in dB re its maximum, ``level[frequency, time]``."""

    name: str
    time: Array
    omega: Array
    level_db: Array
    floor_db: float
    overlays: tuple[Curve, ...] = ()
    note: str = ""


@dataclass(frozen=True, repr=False)
class SignedPlane(Brief):
    """A distribution with its sign: arcsinh(share of the maximum / knee), scaled to -1 .. 1, [frequency, time]."""

    name: str
    time: Array
    omega: Array
    values: Array
    knee: float
    overlays: tuple[Curve, ...] = ()
    note: str = ""


@dataclass(frozen=True, repr=False)
class Amplitudes(Brief):
    """Amplitude along the decay, definition ``peak``: by energy of each instant, averaged action, turning points."""

    time: Array
    energy: Array
    averaged: Array | None
    turning_time: Array
    turning_value: Array
    """Positive and negative turning points, signed as observed."""
    note: str = ""


@dataclass(frozen=True, repr=False)
class Reconstruction(Brief):
    """The signal against its models: with one component, the paper's eq. (22)-(23), and with several, its eq. (7)."""

    time: Array
    signal: Array
    single: Array
    multicomponent: Array | None
    components: int
    rms_single: float
    """rms of the difference divided by rms of the signal."""
    rms_multicomponent: float | None
    note: str = ""


@dataclass(frozen=True, repr=False)
class MotionComparison(Brief):
    """Everything along one integrated trajectory."""

    case: Case
    time: Array
    u: Array
    velocity: Array
    integrators: tuple[Integrator, ...]
    """First the one used."""
    amplitudes: Amplitudes
    reference: Curve
    frequency_ends: tuple[float, float]
    """omega0 at the first and the last sample: of the averaged action, else of the reference with its ends held."""
    interior: tuple[float, float]
    curves: tuple[Curve, ...]
    scores: tuple[Score, ...]
    budget: tuple[BudgetRow, ...]
    reconstruction: Reconstruction
    spectrogram_u: Image
    spectrogram_velocity: Image
    wigner_u: SignedPlane
    harmonics: tuple[Curve, ...]
    """Harmonic tracks (omega of the harmonic itself, not divided), their predictions, and the raw peak."""
    statements: tuple[Statement, ...]
    folding: Folding
    """Which multiples the sampling rate folds back."""
    wigner_bias: WignerBias | None = None
    """Why the full Wigner peak is off; None for an oscillator without a potential."""

    @property
    def disagreement(self) -> float | None:
        """Largest difference of u between the first two integrators; None when there was only one."""
        return self.integrators[1].difference if len(self.integrators) > 1 else None
