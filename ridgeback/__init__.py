"""Ridgeback: the ridge of a time-frequency distribution against the backbone of perturbation theory.

Each public name is imported from its room on first use, so that ``import ridgeback`` costs nothing.  An oscillator may
be named in any way: a name of the catalogue, an equation as text, a SymPy equation, a TOML path.  A signal is a list,
an array, a masked array, a pandas or xarray object, a trajectory, a recording or a file.

>>> import ridgeback
>>> ridgeback.lindstedt("pendulum", 4).frequency
(1, 0, -1/16, 0, 1/3072)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ridgeback.public import BY_NAME as _BY_NAME
from ridgeback.public import contents as _contents
from ridgeback.public import home as _home

if TYPE_CHECKING:  # what the table of ``public`` says, for those who read types; a test holds the two together
    from ridgeback.common.errors import InputError as InputError
    from ridgeback.compare.benchmark.results import Benchmark as Benchmark
    from ridgeback.compare.binding.bind import bind as bind
    from ridgeback.compare.drift.results import DriftComparison as DriftComparison
    from ridgeback.compare.identification.confusion import confusion as confusion
    from ridgeback.compare.identification.results import Identification as Identification
    from ridgeback.compare.motion.harmonics.components import Components as Components
    from ridgeback.compare.recording.measurements import measure_recordings as measure_recordings
    from ridgeback.compare.recording.samples import Sample as Sample
    from ridgeback.compare.recording.samples import sample as sample
    from ridgeback.compare.report.results import Report as Report
    from ridgeback.compare.studies.result import StudyResult as StudyResult
    from ridgeback.compare.study.certified import certified_rows as certified_rows
    from ridgeback.compare.study.results import Study as Study
    from ridgeback.interface.benchmark import benchmark as benchmark
    from ridgeback.interface.components import components as components
    from ridgeback.interface.derive import derive as derive
    from ridgeback.interface.derive import generate as generate
    from ridgeback.interface.drift import drift as drift
    from ridgeback.interface.estimate import backbone as backbone
    from ridgeback.interface.estimate import estimate as estimate
    from ridgeback.interface.estimate import half_cycles as half_cycles
    from ridgeback.interface.estimate import model_fit as model_fit
    from ridgeback.interface.identify import identify as identify
    from ridgeback.interface.identify import predict as predict
    from ridgeback.interface.orbits import periodic_orbit as periodic_orbit
    from ridgeback.interface.orbits import precise_orbit as precise_orbit
    from ridgeback.interface.report import report as report
    from ridgeback.interface.report import study as study
    from ridgeback.interface.simulate import energy_terms as energy_terms
    from ridgeback.interface.simulate import simulate as simulate
    from ridgeback.interface.studies import run_study as run_study
    from ridgeback.numeric.backbone.curve import Backbone as Backbone
    from ridgeback.numeric.backbone.half_cycles import HalfCycles as HalfCycles
    from ridgeback.numeric.distributions.cross_wigner import cross_wigner as cross_wigner
    from ridgeback.numeric.distributions.distribution import Distribution as Distribution
    from ridgeback.numeric.distributions.plane_ridge import ridge as ridge
    from ridgeback.numeric.distributions.polynomial_wigner import polynomial_wigner as polynomial_wigner
    from ridgeback.numeric.distributions.reassigned_spectrogram import reassigned_spectrogram as reassigned_spectrogram
    from ridgeback.numeric.distributions.reassigned_spectrogram import (
        synchrosqueezed_spectrogram as synchrosqueezed_spectrogram,
    )
    from ridgeback.numeric.distributions.spectrogram import spectrogram as spectrogram
    from ridgeback.numeric.distributions.wigner import pseudo_wigner as pseudo_wigner
    from ridgeback.numeric.distributions.wigner import smoothed_pseudo_wigner as smoothed_pseudo_wigner
    from ridgeback.numeric.distributions.wigner import wigner as wigner
    from ridgeback.numeric.model_fit.fit import ModelFit as ModelFit
    from ridgeback.numeric.motion.dynamics import Dynamics as Dynamics
    from ridgeback.numeric.motion.trajectory import Trajectory as Trajectory
    from ridgeback.numeric.orbits.energy import EnergyTerms as EnergyTerms
    from ridgeback.numeric.recording.reading import read_recording as read_recording
    from ridgeback.numeric.recording.reading import read_recordings as read_recordings
    from ridgeback.numeric.recording.recording import Recording as Recording
    from ridgeback.numeric.recording.recording import recordings_from_arrays as recordings_from_arrays
    from ridgeback.numeric.tracking.track import Track as Track
    from ridgeback.symbolic.certificates.at_amplitudes import certified_frequencies as certified_frequencies
    from ridgeback.symbolic.certificates.certificate import certify as certify
    from ridgeback.symbolic.cycles.found import limit_cycles as limit_cycles
    from ridgeback.symbolic.cycles.orbit import exact_frequency as exact_frequency
    from ridgeback.symbolic.enclosure.enclosure import enclose as enclose
    from ridgeback.symbolic.expansion.cost import Budget as Budget
    from ridgeback.symbolic.expansion.energy_integral import energy_integral as energy_integral
    from ridgeback.symbolic.expansion.expansion import Expansion as Expansion
    from ridgeback.symbolic.expansion.lindstedt import lindstedt as lindstedt
    from ridgeback.symbolic.flow.fixed_points import cycle_series as cycle_series
    from ridgeback.symbolic.flow.fixed_points import fixed_points as fixed_points
    from ridgeback.symbolic.flow.fixed_points import frequency_series as frequency_series
    from ridgeback.symbolic.flow.multiple_scales import multiple_scales as multiple_scales
    from ridgeback.symbolic.flow.slow_flow import SlowFlow as SlowFlow
    from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls as lindstedt_in_balls
    from ridgeback.symbolic.resummation.by_name import resum as resum
    from ridgeback.symbolic.singularities.settled import settled_limits as limits  # noqa: F401
    from ridgeback.symbolic.systems.any_form import as_oscillator as oscillator  # noqa: F401
    from ridgeback.symbolic.systems.catalogue import catalogue as catalogue
    from ridgeback.symbolic.systems.oscillator import Oscillator as Oscillator

    __version__: str

__all__ = sorted([*_BY_NAME, "__version__"])  # noqa: PLE0605 - made of the table
__doc__ = f"{__doc__ or ''}\n{_contents()}\n"


def __getattr__(name: str) -> Any:
    """Import a public name from its room on first use.

    >>> import ridgeback
    >>> ridgeback.no_such_name
    Traceback (most recent call last):
        ...
    AttributeError: module 'ridgeback' has no attribute 'no_such_name'
    """
    if name == "__version__":
        from importlib.metadata import version

        value: Any = version("ridgeback")
    elif name in _BY_NAME:
        module, attribute = _home(_BY_NAME[name])
        value = getattr(import_module(module), attribute)
    else:
        raise AttributeError(f"module 'ridgeback' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__doc__", "__name__", "__file__", "__path__", "__all__"])
