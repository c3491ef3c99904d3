"""The columns of every table that a result gives: their units and what they hold.  The list stands here only.

The unit of a signal is whatever its samples were measured in, and an oscillator without a unit of time has rad per time
unit where this says rad/s.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

OF_SIGNAL: Final = "unit of the signal"
OF_OSCILLATOR: Final = "unit of the unknown"
PER_MASS: Final = f"({OF_OSCILLATOR})^2/s^2"


class Quantity(NamedTuple):
    """One column: its unit ("1" for a pure number, "" for a word) and what it is."""

    unit: str
    meaning: str


QUANTITIES: Final[Mapping[str, Quantity]] = MappingProxyType(
    {
        "time_s": Quantity("s", "time"),
        "omega_rad_s": Quantity("rad/s", "angular frequency"),
        "frequency_hz": Quantity("Hz", "frequency"),
        "standard_deviation_rad_s": Quantity("rad/s", "standard deviation of the angular frequency"),
        "omega_standard_deviation_rad_s": Quantity("rad/s", "standard deviation of the angular frequency"),
        "omega_between_runs_rad_s": Quantity("rad/s", "standard deviation of the angular frequency between runs"),
        "bias_rad_s": Quantity("rad/s", "estimated bias of the angular frequency"),
        "bias_deviation_rad_s": Quantity("rad/s", "standard deviation of the bias"),
        "low_95_rad_s": Quantity("rad/s", "lower end of the 95 % interval of the angular frequency"),
        "high_95_rad_s": Quantity("rad/s", "upper end of the 95 % interval of the angular frequency"),
        "standard_deviation": Quantity(OF_SIGNAL, "standard deviation"),
        "bias": Quantity(OF_SIGNAL, "estimated bias"),
        "bias_deviation": Quantity(OF_SIGNAL, "standard deviation of the bias"),
        "low_95": Quantity(OF_SIGNAL, "lower end of the 95 % interval"),
        "high_95": Quantity(OF_SIGNAL, "upper end of the 95 % interval"),
        "valid": Quantity("", "whether the estimator sees a whole window there"),
        "ambiguous": Quantity("", "whether the definition itself leaves more room than the interval"),
        "amplitude": Quantity(OF_SIGNAL, "amplitude"),
        "orbit_amplitude": Quantity(OF_SIGNAL, "the same of the undamped orbit at the amplitude of that time"),
        "floor": Quantity(OF_SIGNAL, "what the decay alone leaks into the multiple; smaller amplitudes say nothing"),
        "multiple": Quantity("1", "multiple of the fundamental"),
        "amplitude_standard_deviation": Quantity(OF_SIGNAL, "standard deviation of the amplitude"),
        "amplitude_low_95": Quantity(OF_SIGNAL, "lower end of the 95 % interval of the amplitude"),
        "amplitude_high_95": Quantity(OF_SIGNAL, "upper end of the 95 % interval of the amplitude"),
        "amplitude_measured": Quantity(OF_SIGNAL, "amplitude as measured"),
        "omega_measured_rad_s": Quantity("rad/s", "angular frequency as measured"),
        "phase_error_rad": Quantity("rad", "phase measured less predicted"),
        "growth_rate_per_s": Quantity("1/s", "growth rate a'/a, negative in a decay"),
        "growth_rate_standard_deviation_per_s": Quantity("1/s", "standard deviation of the growth rate"),
        "growth_rate_low_95_per_s": Quantity("1/s", "lower end of the 95 % interval of the growth rate"),
        "growth_rate_high_95_per_s": Quantity("1/s", "upper end of the 95 % interval of the growth rate"),
        "damping_ratio": Quantity("1", "damping ratio -a'/(a omega)"),
        "damping_ratio_standard_deviation": Quantity("1", "standard deviation of the damping ratio"),
        "growth_rate_between_runs_per_s": Quantity("1/s", "standard deviation of the growth rate between runs"),
        "side": Quantity("1", "1 above zero, -1 below"),
        "runs": Quantity("1", "number of runs that reach this amplitude"),
        "u": Quantity(OF_OSCILLATOR, "the unknown"),
        "velocity": Quantity(f"{OF_OSCILLATOR}/s", "time derivative of the unknown"),
        "kinetic_energy": Quantity(PER_MASS, "kinetic energy u'^2/2 per unit of mass"),
        "potential_energy": Quantity(PER_MASS, "potential energy per unit of mass, from the first sample"),
        "dissipated_energy": Quantity(PER_MASS, "energy per unit of mass that damping has taken"),
        "mechanical_energy": Quantity(PER_MASS, "kinetic and potential energy per unit of mass"),
        "energy_balance": Quantity(PER_MASS, "what the energy balance misses per unit of mass"),
        "value": Quantity(OF_SIGNAL, "value"),
        "clipped": Quantity("", "whether the sample lies in a flat top or stands still"),
        "filled": Quantity("", "whether the sample was interpolated"),
        "order": Quantity("1", "highest power kept"),
        "eps": Quantity("1", "parameter of the limit cycle"),
        "method": Quantity("", "how the frequency is computed"),
        "omega": Quantity("rad/s", "angular frequency"),
        "omega_reference": Quantity("rad/s", "exact angular frequency"),
        "relative_error": Quantity("1", "omega / omega_reference - 1"),
        "kind": Quantity("", "what sort of contender"),
        "relative_rms_error": Quantity("1", "root mean square of the relative error"),
        "largest": Quantity("1", "largest relative error"),
        "mean": Quantity("1", "mean relative error, negative means low"),
        "coverage": Quantity("1", "share of the motion that is covered"),
        "ranked": Quantity("", "whether it covers enough to be ranked"),
        "time_ns_per_value": Quantity("ns", "time for one value"),
        "time_s_per_track": Quantity("s", "time for the whole track"),
        "time_scatter": Quantity("1", "scatter of such times from run to run, as a share of them"),
        "power": Quantity("1", "power of the variable"),
        "relation": Quantity("", "which of the two equations of the slow flow"),
        "coefficient": Quantity("exact", "exact coefficient"),
        "decimal": Quantity("1", "the coefficient rounded to a float"),
        "parameter": Quantity("", "name of a fitted parameter"),
        "candidate": Quantity("", "class of oscillators"),
        "delta": Quantity("1", "distance of the criterion from the best candidate's"),
        "weight": Quantity("1", "Akaike weight of the candidate"),
        "unit": Quantity("", "unit of the value"),
        "heading": Quantity("", "what was found"),
        "finding": Quantity("", "the finding"),
        "text": Quantity("", "the finding in words"),
    }
)
