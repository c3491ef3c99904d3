"""Ridgeback: the ridge of a time-frequency distribution against the backbone of perturbation theory.

The public names, each imported from its room on first use, so that ``import ridgeback`` costs nothing:

>>> import ridgeback
>>> ridgeback.lindstedt(ridgeback.find("pendulum"), 4).frequency
(1, 0, -1/16, 0, 1/3072)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ridgeback.compare.binding.bind import bind as bind
    from ridgeback.compare.binding.family import family as family
    from ridgeback.compare.identification.identify import identify as identify
    from ridgeback.compare.identification.prediction import predict as predict
    from ridgeback.compare.recording.survey import survey as survey
    from ridgeback.compare.report.recording_report import assemble_recording as assemble_recording
    from ridgeback.compare.report.system_report import assemble_system as assemble_system
    from ridgeback.compare.study.study import study as study
    from ridgeback.numeric.backbone.backbone import backbone as backbone
    from ridgeback.numeric.backbone.half_cycles import half_cycles as half_cycles
    from ridgeback.numeric.estimators.estimate import estimate as estimate
    from ridgeback.numeric.model_fit.fit import model_fit as model_fit
    from ridgeback.numeric.motion.dynamics import Dynamics as Dynamics
    from ridgeback.numeric.motion.trajectory import Trajectory as Trajectory
    from ridgeback.numeric.motion.trajectory import integrate as integrate
    from ridgeback.numeric.recording.recording import read_recording as read_recording
    from ridgeback.numeric.recording.recording import read_recordings as read_recordings
    from ridgeback.numeric.tracking.track import Track as Track
    from ridgeback.reports.page import render as render
    from ridgeback.symbolic.certificates.at_amplitudes import readings as readings
    from ridgeback.symbolic.codegen import generate as generate
    from ridgeback.symbolic.enclosure.enclosure import enclose as enclose
    from ridgeback.symbolic.expansion.energy_integral import energy_integral as energy_integral
    from ridgeback.symbolic.expansion.expansion import Expansion as Expansion
    from ridgeback.symbolic.expansion.lindstedt import lindstedt as lindstedt
    from ridgeback.symbolic.flow.multiple_scales import multiple_scales as multiple_scales
    from ridgeback.symbolic.flow.slow_flow import SlowFlow as SlowFlow
    from ridgeback.symbolic.high_order.by_primes import lindstedt_by_primes as lindstedt_by_primes
    from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls as lindstedt_in_balls
    from ridgeback.symbolic.resummation.by_name import resummed as resummed
    from ridgeback.symbolic.systems.catalogue import catalogue as catalogue
    from ridgeback.symbolic.systems.catalogue import find as find
    from ridgeback.symbolic.systems.oscillator import Oscillator as Oscillator

    __version__: str

HOMES = {
    "Dynamics": "ridgeback.numeric.motion.dynamics",
    "Expansion": "ridgeback.symbolic.expansion.expansion",
    "Oscillator": "ridgeback.symbolic.systems.oscillator",
    "SlowFlow": "ridgeback.symbolic.flow.slow_flow",
    "Track": "ridgeback.numeric.tracking.track",
    "Trajectory": "ridgeback.numeric.motion.trajectory",
    "assemble_recording": "ridgeback.compare.report.recording_report",
    "assemble_system": "ridgeback.compare.report.system_report",
    "backbone": "ridgeback.numeric.backbone.backbone",
    "bind": "ridgeback.compare.binding.bind",
    "catalogue": "ridgeback.symbolic.systems.catalogue",
    "enclose": "ridgeback.symbolic.enclosure.enclosure",
    "energy_integral": "ridgeback.symbolic.expansion.energy_integral",
    "estimate": "ridgeback.numeric.estimators.estimate",
    "family": "ridgeback.compare.binding.family",
    "find": "ridgeback.symbolic.systems.catalogue",
    "generate": "ridgeback.symbolic.codegen",
    "identify": "ridgeback.compare.identification.identify",
    "integrate": "ridgeback.numeric.motion.trajectory",
    "lindstedt": "ridgeback.symbolic.expansion.lindstedt",
    "lindstedt_by_primes": "ridgeback.symbolic.high_order.by_primes",
    "lindstedt_in_balls": "ridgeback.symbolic.high_order.in_balls",
    "model_fit": "ridgeback.numeric.model_fit.fit",
    "multiple_scales": "ridgeback.symbolic.flow.multiple_scales",
    "half_cycles": "ridgeback.numeric.backbone.half_cycles",
    "predict": "ridgeback.compare.identification.prediction",
    "read_recording": "ridgeback.numeric.recording.recording",
    "read_recordings": "ridgeback.numeric.recording.recording",
    "survey": "ridgeback.compare.recording.survey",
    "readings": "ridgeback.symbolic.certificates.at_amplitudes",
    "render": "ridgeback.reports.page",
    "resummed": "ridgeback.symbolic.resummation.by_name",
    "study": "ridgeback.compare.study.study",
}


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
    elif name in HOMES:
        value = getattr(import_module(HOMES[name]), name)
    else:
        raise AttributeError(f"module 'ridgeback' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *HOMES, "__version__"})
