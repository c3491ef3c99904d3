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
    from compare.bind import bind as bind
    from compare.family import family as family
    from compare.identification.identify import identify as identify
    from compare.identification.prediction import predict as predict
    from compare.measurement import survey as survey
    from compare.recording_report import assemble_recording as assemble_recording
    from compare.report import assemble_system as assemble_system
    from compare.study import study as study
    from numeric.backbone import backbone as backbone
    from numeric.dynamics import Dynamics as Dynamics
    from numeric.estimate import estimate as estimate
    from numeric.half_cycles import half_cycles as half_cycles
    from numeric.model_fit import model_fit as model_fit
    from numeric.recording import read_recording as read_recording
    from numeric.recording import read_recordings as read_recordings
    from numeric.track import Track as Track
    from numeric.trajectory import Trajectory as Trajectory
    from numeric.trajectory import integrate as integrate
    from reports.page import render as render
    from symbolic.ball_march import lindstedt_in_balls as lindstedt_in_balls
    from symbolic.codegen import generate as generate
    from symbolic.enclosure import enclose as enclose
    from symbolic.energy_integral import energy_integral as energy_integral
    from symbolic.expansion import Expansion as Expansion
    from symbolic.lindstedt import lindstedt as lindstedt
    from symbolic.modular import lindstedt_by_primes as lindstedt_by_primes
    from symbolic.multiple_scales import multiple_scales as multiple_scales
    from symbolic.oscillator import Oscillator as Oscillator
    from symbolic.readings import readings as readings
    from symbolic.resummed import resummed as resummed
    from symbolic.slow_flow import SlowFlow as SlowFlow
    from symbolic.systems import catalogue as catalogue
    from symbolic.systems import find as find

    __version__: str

HOMES = {
    "Dynamics": "numeric.dynamics",
    "Expansion": "symbolic.expansion",
    "Oscillator": "symbolic.oscillator",
    "SlowFlow": "symbolic.slow_flow",
    "Track": "numeric.track",
    "Trajectory": "numeric.trajectory",
    "assemble_recording": "compare.recording_report",
    "assemble_system": "compare.report",
    "backbone": "numeric.backbone",
    "bind": "compare.bind",
    "catalogue": "symbolic.systems",
    "enclose": "symbolic.enclosure",
    "energy_integral": "symbolic.energy_integral",
    "estimate": "numeric.estimate",
    "family": "compare.family",
    "find": "symbolic.systems",
    "generate": "symbolic.codegen",
    "identify": "compare.identification.identify",
    "integrate": "numeric.trajectory",
    "lindstedt": "symbolic.lindstedt",
    "lindstedt_by_primes": "symbolic.modular",
    "lindstedt_in_balls": "symbolic.ball_march",
    "model_fit": "numeric.model_fit",
    "multiple_scales": "symbolic.multiple_scales",
    "half_cycles": "numeric.half_cycles",
    "predict": "compare.identification.prediction",
    "read_recording": "numeric.recording",
    "read_recordings": "numeric.recording",
    "survey": "compare.measurement",
    "readings": "symbolic.readings",
    "render": "reports.page",
    "resummed": "symbolic.resummed",
    "study": "compare.study",
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
