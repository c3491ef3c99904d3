"""The public names: where each lives, what it is for, and what it is.  The list stands here only.

The lazy imports, ``dir(ridgeback)``, ``ridgeback.__all__`` and ``help(ridgeback)`` are made of it.
"""

from __future__ import annotations

from itertools import groupby
from typing import Final, NamedTuple


class Public(NamedTuple):
    """One public name: its module under ``ridgeback``, the group it belongs to, and one line about it."""

    name: str
    home: str
    group: str
    about: str


_NAME = "Name an oscillator"
_DERIVE = "Derive exactly"
_PROVE = "Prove and resum"
_SIMULATE = "Simulate"
_READ = "Take in signals"
_PLANES = "Time-frequency planes"
_ESTIMATE = "Estimate from signals"
_IDENTIFY = "Identify"
_COMPARE = "Compare and report"
_VALUES = "Results and values"

PUBLIC: Final = (
    Public("oscillator", "symbolic.systems.any_form:as_oscillator", _NAME, "from a name, an equation, SymPy or TOML"),
    Public("catalogue", "symbolic.systems.catalogue", _NAME, "the oscillators that have names"),
    Public("Oscillator", "symbolic.systems.oscillator", _NAME, "an equation of motion with exact parameters"),
    Public("derive", "interface.derive", _DERIVE, "the exact series of the frequency, by the method that suits"),
    Public("lindstedt", "symbolic.expansion.lindstedt", _DERIVE, "omega0 in the amplitude or in eps, and u"),
    Public("multiple_scales", "symbolic.flow.multiple_scales", _DERIVE, "the slow flow phi' and a'/a, with damping"),
    Public("fixed_points", "symbolic.flow.fixed_points", _DERIVE, "the limit cycles of a slow flow at given values"),
    Public("cycle_series", "symbolic.flow.fixed_points", _DERIVE, "a^2 on a slow flow's limit cycles, as series"),
    Public("frequency_series", "symbolic.flow.fixed_points", _DERIVE, "omega0 on a limit cycle, from that series"),
    Public("energy_integral", "symbolic.expansion.energy_integral", _DERIVE, "omega0 from the potential alone"),
    Public("lindstedt_in_balls", "symbolic.high_order.in_balls", _DERIVE, "very high orders, enclosed"),
    Public("generate", "interface.derive", _DERIVE, "a formula as code in eleven languages"),
    Public("Budget", "symbolic.expansion.cost", _DERIVE, "the time and memory that a derivation may take"),
    Public("periodic_orbit", "interface.orbits", _PROVE, "a limit cycle found by shooting"),
    Public("precise_orbit", "interface.orbits", _PROVE, "a limit cycle to any number of digits"),
    Public("enclose", "symbolic.enclosure.enclosure", _PROVE, "the exact frequency at an amplitude, enclosed"),
    Public("exact_frequency", "symbolic.cycles.orbit", _PROVE, "the same by integration where no energy is known"),
    Public("limit_cycles", "symbolic.cycles.found", _PROVE, "the limit cycles of an oscillator, enclosed"),
    Public("certify", "symbolic.certificates.certificate", _PROVE, "every independent check of an expansion"),
    Public("certified_frequencies", "symbolic.certificates.at_amplitudes", _PROVE, "a formula's proved errors"),
    Public("certified_rows", "compare.study.certified", _PROVE, "proved errors of a series and its resummations"),
    Public("resum", "symbolic.resummation.by_name", _PROVE, "another formula from the coefficients of a series"),
    Public("limits", "symbolic.singularities.settled:settled_limits", _PROVE, "where a series converges, and why"),
    Public("simulate", "interface.simulate", _SIMULATE, "a trajectory, by any of the integrators"),
    Public("drift", "interface.drift", _SIMULATE, "a motion under a drift, and omega0 by its action"),
    Public("energy_terms", "interface.simulate", _SIMULATE, "kinetic, potential and lost energy along a trajectory"),
    Public("components", "interface.components", _SIMULATE, "the harmonics a_m(t) along a motion, eq. (7)"),
    Public("bind", "compare.binding.bind", _SIMULATE, "an oscillator with its numbers, as functions of floats"),
    Public("read_recording", "numeric.recording.reading", _READ, "one signal from a file"),
    Public("read_recordings", "numeric.recording.reading", _READ, "every stretch, channel and run of files"),
    Public("recordings_from_arrays", "numeric.recording.recording", _READ, "every stretch of samples in memory"),
    Public("sample", "compare.recording.samples", _READ, "a recording of our own making, with its truth"),
    Public("Recording", "numeric.recording.recording", _READ, "a signal; Recording.from_arrays makes one of samples"),
    Public("wigner", "numeric.distributions.wigner", _PLANES, "the Wigner distribution"),
    Public("pseudo_wigner", "numeric.distributions.wigner", _PLANES, "the Wigner distribution under a lag window"),
    Public("smoothed_pseudo_wigner", "numeric.distributions.wigner", _PLANES, "smoothed over time, too"),
    Public("polynomial_wigner", "numeric.distributions.polynomial_wigner", _PLANES, "of order 4 or 6"),
    Public("cross_wigner", "numeric.distributions.cross_wigner", _PLANES, "of two signals"),
    Public("spectrogram", "numeric.distributions.spectrogram", _PLANES, "the squared short-time spectrum"),
    Public("reassigned_spectrogram", "numeric.distributions.reassigned_spectrogram", _PLANES, "moved to where it is"),
    Public("synchrosqueezed_spectrogram", "numeric.distributions.reassigned_spectrogram", _PLANES, "in frequency only"),
    Public("ridge", "numeric.distributions.plane_ridge", _PLANES, "the ridge of a plane as a track"),
    Public("estimate", "interface.estimate", _ESTIMATE, "the frequency over time, with interval and bias"),
    Public("backbone", "interface.estimate", _ESTIMATE, "frequency and growth rate against amplitude"),
    Public("half_cycles", "interface.estimate", _ESTIMATE, "frequency, amplitude, growth rate of each half cycle"),
    Public("model_fit", "interface.estimate", _ESTIMATE, "an oscillator's own solutions fitted to samples"),
    Public("measure_recordings", "compare.recording.measurements", _ESTIMATE, "tracks and backbones of recordings"),
    Public("identify", "interface.identify", _IDENTIFY, "which oscillator made a decay"),
    Public("predict", "interface.identify", _IDENTIFY, "the rest of a decay from its first cycles"),
    Public("confusion", "compare.identification.confusion", _IDENTIFY, "how often which class is found for which"),
    Public("study", "interface.report", _COMPARE, "the error of each order at each amplitude"),
    Public("run_study", "interface.studies", _COMPARE, "a study from its file: resumable, parallel, answered by name"),
    Public("benchmark", "interface.benchmark", _COMPARE, "error and cost of every way to omega0(t) of a motion"),
    Public("report", "interface.report", _COMPARE, "the whole comparison; its save() writes one HTML page"),
    Public("Expansion", "symbolic.expansion.expansion", _VALUES, "an exact series in one variable"),
    Public("SlowFlow", "symbolic.flow.slow_flow", _VALUES, "the slow flow phi' and a'/a"),
    Public("DriftComparison", "compare.drift.results", _VALUES, "omega0 by the action beside the cycle frequency"),
    Public("Trajectory", "numeric.motion.trajectory", _VALUES, "an integrated solution with its events"),
    Public("EnergyTerms", "numeric.orbits.energy", _VALUES, "the terms of the energy balance along a trajectory"),
    Public("Components", "compare.motion.harmonics.components", _VALUES, "the harmonics along a motion by cycles"),
    Public("Dynamics", "numeric.motion.dynamics", _VALUES, "an oscillator bound to numbers"),
    Public("Distribution", "numeric.distributions.distribution", _VALUES, "a time-frequency plane with its axes"),
    Public("Track", "numeric.tracking.track", _VALUES, "a frequency over time with its uncertainty"),
    Public("Backbone", "numeric.backbone.curve", _VALUES, "a backbone curve with its uncertainty"),
    Public("HalfCycles", "numeric.backbone.half_cycles", _VALUES, "one value per half cycle"),
    Public("ModelFit", "numeric.model_fit.fit", _VALUES, "a fitted oscillator with its covariance"),
    Public("Identification", "compare.identification.results", _VALUES, "ranked candidates and the verdict"),
    Public("Study", "compare.study.results", _VALUES, "errors over order and amplitude"),
    Public("StudyResult", "compare.studies.result", _VALUES, "the answers and cells of a study from a file"),
    Public("Sample", "compare.recording.samples", _VALUES, "a sample recording and the truth about it"),
    Public("Benchmark", "compare.benchmark.results", _VALUES, "contenders, crossings and verdict of a benchmark"),
    Public("Report", "compare.report.results", _VALUES, "all that a page shows"),
    Public("InputError", "common.errors", _VALUES, "the one error of unusable input, a ValueError"),
)

BY_NAME: Final = {entry.name: entry for entry in PUBLIC}


def home(entry: Public) -> tuple[str, str]:
    """Module and attribute of a public name.

    >>> home(BY_NAME["oscillator"])
    ('ridgeback.symbolic.systems.any_form', 'as_oscillator')
    """
    module, _, attribute = entry.home.partition(":")
    return f"ridgeback.{module}", attribute or entry.name


def contents() -> str:
    """The names by group, one to a line.

    >>> print(contents()[:92])
    Name an oscillator
        oscillator                   from a name, an equation, SymPy or TOML
    """
    width = max(len(entry.name) for entry in PUBLIC) + 2
    blocks = [
        "\n".join([group, *(f"    {entry.name:{width}}{entry.about}" for entry in entries)])
        for group, entries in groupby(PUBLIC, key=lambda entry: entry.group)
    ]
    return "\n\n".join(blocks)
