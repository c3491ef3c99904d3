"""What an identification hands over: frozen values, complete at construction, ready to print, store or draw.

Angular frequency in rad per time unit; amplitudes are ``fundamental`` (that of the first harmonic), in the signal's
own unit; bands are 95 % intervals.  Arrays are one-dimensional float64 and read-only.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from ridgeback.common.show.brief import Brief
from ridgeback.compare.identification.sample_fit import UNKNOWN, Misfit, SampleFit
from ridgeback.compare.identification.shown import ShownIdentification, ShownPrediction, Standing
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.tracking.track import NORMAL_95

if TYPE_CHECKING:
    from ridgeback.compare.identification.candidates import DampingLaw

POOR = 0.6
"""Share of the signal's rms that the best candidate may leave before the verdict says that none describes it."""


class _Values:
    """Arrays are copied and made read-only, mappings read-only; ``record`` gives what JSON knows."""

    def __post_init__(self) -> None:
        freeze(self)

    def record(self) -> dict[str, object]:
        """All fields by name, as lists, numbers, text and mappings of them."""
        return {item.name: _plain(getattr(self, item.name)) for item in fields(self)}  # type: ignore[arg-type]


def _plain(value: object) -> object:
    match value:
        case _Values():
            return value.record()
        case np.ndarray():
            return value.tolist()
        case tuple():
            return [_plain(item) for item in value]
        case Mapping():
            return {str(key): _plain(item) for key, item in value.items()}
    return value


@dataclass(frozen=True)
class Parameter(_Values):
    """One fitted number of an equation.

    >>> tuple(round(x, 3) for x in Parameter("k", 2.0, 0.1, "rad/s", "natural frequency").interval())
    (1.804, 2.196)
    """

    name: str
    """As it stands in the candidate's equation, or ``a0`` and ``phase0`` of the start, ``offset`` of the sensor."""
    value: float
    standard_deviation: float
    unit: str = ""
    meaning: str = ""

    def interval(self) -> tuple[float, float]:
        """The 95 % interval."""
        half = NORMAL_95 * self.standard_deviation
        return self.value - half, self.value + half


@dataclass(frozen=True, repr=False)
class Candidate(_Values, Brief):
    """One oscillator class with its best parameters; ``omega`` and ``growth_rate`` against ``amplitude``, with bands.

    ``criterion`` is the information criterion, less is better; ``delta`` its distance from the best candidate's, and
    ``weight`` proportional to exp(-delta / 2), with sum 1 over all candidates.  ``residual`` is the root mean square of
    the samples less the model.  ``growth_rate`` is a'/a per time unit, negative in a decay.
    """

    name: str
    """Such as ``duffing-softening``; the class."""
    title: str
    equation: str
    """As text, with the fitted parameters by name."""
    damping_law: DampingLaw
    parameters: tuple[Parameter, ...]
    criterion: float
    delta: float
    weight: float
    residual: float
    amplitude: Array
    omega: Array
    omega_low: Array
    omega_high: Array
    growth_rate: Array
    growth_rate_low: Array
    growth_rate_high: Array
    note: str = ""
    has_equation: bool = True
    """False for a polynomial backbone: a slow flow without an equation of motion."""

    @property
    def named(self) -> str:
        """The class and its damping law."""
        return f"{self.title}, {self.damping_law} damping"

    def without_intervals(self) -> Candidate:
        """The same without a claim on any deviation."""
        unknown = np.full_like(self.amplitude, np.nan)
        return replace(
            self,
            parameters=tuple(replace(one, standard_deviation=math.nan) for one in self.parameters),
            omega_low=unknown,
            omega_high=unknown,
            growth_rate_low=unknown,
            growth_rate_high=unknown,
        )

    def parameter(self, name: str) -> Parameter:
        """The parameter of this name; KeyError without one."""
        for item in self.parameters:
            if item.name == name:
                return item
        raise KeyError(name)


@dataclass(frozen=True, repr=False)
class MeasuredBackbone(_Values, Brief):
    """Measured without any class in mind: frequency and growth rate by amplitude, one standard deviation each."""

    amplitude: Array
    omega: Array
    omega_sd: Array
    growth_rate: Array
    growth_rate_sd: Array


@dataclass(frozen=True, repr=False)
class Prediction(ShownPrediction, _Values):
    """The rest of a decay as predicted from its first cycles, against what was then measured.

    ``*_low`` and ``*_high`` are 95 % bands; ``measured_*`` are local harmonic least squares on the part that the fit
    did not see, with their standard deviations.  ``phase_error`` is measured less predicted, in rad, unwrapped;
    ``phase_band`` is half the band of the prediction.
    """

    candidate: str
    cycles: float
    """Cycles that the fit saw."""
    until: float
    """Time of the last sample that the fit saw."""
    time: Array
    amplitude: Array
    amplitude_low: Array
    amplitude_high: Array
    measured_amplitude: Array
    measured_amplitude_sd: Array
    omega: Array
    omega_low: Array
    omega_high: Array
    measured_omega: Array
    measured_omega_sd: Array
    phase_error: Array
    phase_band: Array
    measured_phase_sd: Array
    coverage: Mapping[str, float]
    """Share of the measured ``amplitude``, ``omega`` and ``phase`` that the bands of both, taken together, reach; only
    of those that something is known of."""
    errors: Mapping[str, float]
    """Root mean square of measured less predicted: ``amplitude`` and ``omega`` relative, ``phase`` in rad."""
    note: str = ""

    def record(self) -> dict[str, object]:
        """All fields by name, and what became of it."""
        return {**super().record(), "outcome": self.outcome.value}


@dataclass(frozen=True, repr=False)
class Identification(ShownIdentification, _Values):
    """Candidates, best first, of one recording; ``verdict`` says what follows from them.

    Made by :func:`ridgeback.identify`.

    Parameters
    ----------
    source, column : str
        The file, and the signal in it.
    unit : str
        Unit of the signal and of its amplitudes; may be empty.
    rate : float
        Samples per time unit.
    samples : int
        How many samples were used.
    effective_samples : float
        Independent samples in the best candidate's residual; the criterion counts these.
    criterion_name : str
        ``"bic"`` or ``"aicc"``.
    candidates : tuple of Candidate
        Each with its parameters, their standard deviations, and its backbone curve.
    data : MeasuredBackbone
        Frequency and growth rate against amplitude, as measured.
    unexplained : float
        What the best candidate leaves, as a share of the signal's rms.
    indistinguishable : tuple of str
        Names of the candidates that the data cannot tell apart from the best, which comes first.
    settings : mapping
        How it was done, for display.
    notes : tuple of str
        What was found on the way.
    failed : tuple of str
        Candidates that could not be fitted, each with the reason.
    prediction : Prediction, optional
        The rest of the decay from its first cycles, where that was asked for.
    noise : float
        Standard deviation of what a model without any oscillator in mind leaves, in the signal's unit; NaN where no
        such model holds.
    doubt : str
        Why the samples are not those of one oscillation, if so.
    hum : str
        The steady tone of the mains that the oscillation is, if so.
    fitted : SampleFit, optional
        The best candidate over the samples, with the spectrum of what it leaves.
    misfit : Misfit
        How much more than noise the best candidate leaves.

    Examples
    --------
    >>> import ridgeback
    >>> t = np.arange(640) / 32.0
    >>> found = ridgeback.identify(np.exp(-0.05 * t) * np.cos(6.0 * t), 32.0, candidates=["linear"], damping="linear")
    >>> found.best.name, round(found.rows()[0]["value"], 2)
    ('linear', 6.0)
    """

    source: str
    column: str
    unit: str
    rate: float
    samples: int
    effective_samples: float
    criterion_name: str
    candidates: tuple[Candidate, ...]
    data: MeasuredBackbone
    unexplained: float
    indistinguishable: tuple[str, ...]
    settings: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()
    prediction: Prediction | None = None
    noise: float = math.nan
    doubt: str = ""
    hum: str = ""
    fitted: SampleFit | None = None
    misfit: Misfit = UNKNOWN

    @property
    def best(self) -> Candidate:
        """The candidate with the least criterion."""
        return self.candidates[0]

    @property
    def criterion_title(self) -> str:
        """The information criterion as it is printed."""
        return {"bic": "BIC", "aicc": "AICc"}.get(self.criterion_name, self.criterion_name)

    @property
    def described(self) -> bool:
        """Whether the best candidate leaves less of the signal than ``POOR``."""
        return self.unexplained <= POOR

    @property
    def standing(self) -> Standing:
        """What is claimed of the best candidate.

        One that leaves noise alone speaks for one oscillation where no model without an oscillator in mind does.
        """
        if self.hum:
            return Standing.HUM
        if not self.described:
            return Standing.NONE
        if self.doubt and not self.misfit.agrees:
            return Standing.DOUBTED
        if self.misfit.out:
            return Standing.NEAREST
        return Standing.UNTOLD if len(self.indistinguishable) > 1 else Standing.CLAIMED

    @property
    def unclaimed(self) -> str:
        """Why no interval of a parameter is claimed; empty where they are."""
        match self.standing:
            case Standing.NONE:
                return f"the best candidate leaves {self.unexplained:.0%} of the signal's rms"
            case Standing.HUM:
                return f"what is measured is no decay: {self.hum}"
            case Standing.DOUBTED:
                return self.doubt
            case Standing.NEAREST:
                return f"the best candidate {self.misfit.sentence()}"
        return ""

    def claiming(self) -> Identification:
        """The same without a claim on any deviation that is in doubt: of the candidates, of what was measured."""
        data = self.data
        if self.doubt:
            unknown = np.full_like(data.amplitude, np.nan)
            data = replace(data, omega_sd=unknown, growth_rate_sd=unknown)
        candidates = tuple(c.without_intervals() for c in self.candidates) if self.unclaimed else self.candidates
        return replace(self, candidates=candidates, data=data)

    def record(self) -> dict[str, object]:
        """All fields by name but the samples, the verdict that follows, and why no interval is claimed, if so."""
        named = {name: value for name, value in super().record().items() if name not in ("fitted", "misfit")}
        misfit = {"ratio": self.misfit.ratio, "chance": self.misfit.chance, "against": self.misfit.against.value}
        said = {"standing": self.standing.value, "verdict": self.verdict, "unclaimed": self.unclaimed}
        return {**named, "misfit": misfit, **said}
