"""A recording: its fundamental frequency by several estimators, the backbone and growth rate with bands, a fitted form.

What is known of the result is what the estimators say of themselves; there is no reference to hold them against,
so their mutual distance is reported beside each one's own uncertainty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.numbers import relative
from ridgeback.compare.motion.error_norms import distance
from ridgeback.compare.motion.estimate_curves import curve_of
from ridgeback.compare.motion.planes import spectrogram_image
from ridgeback.compare.motion.results import Curve
from ridgeback.compare.recording.backbone_fit import fit_backbone, formula_of
from ridgeback.compare.recording.measurement import estimated, marked, measured
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.recording.theory import over_measured, theory_curve
from ridgeback.numeric.backbone.backbone import Backbone, backbone
from ridgeback.numeric.backbone.hum import hum_of
from ridgeback.numeric.components.modulation import swing_notes
from ridgeback.numeric.components.tones import beside_notes
from ridgeback.numeric.estimators.estimate import Estimation
from ridgeback.numeric.recording.reading import read_recording
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.systems.oscillator import Oscillator

METHODS = ("harmonic-least-squares", "pseudo-wigner", "spectrogram", "zero-crossing", "wigner")
"""Estimators compared on a recording, the first that succeeds gives the backbone."""
_LABELS = {
    "harmonic-least-squares": "harmonic least squares",
    "pseudo-wigner": "pseudo-Wigner peak",
    "spectrogram": "spectrogram peak",
    "zero-crossing": "zero crossings",
    "wigner": "Wigner peak",
}
TOP_MULTIPLE = 6
MOST_POINTS = 4096
"""Samples of a long recording that are kept for display."""


def compare_recording(
    source: str | Path | Recording,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    band: tuple[float, float] | None = None,
    methods: Iterable[str] = METHODS,
    oscillator: Oscillator | None = None,
    progress: Callable[[float, str], None] = lambda _, __: None,
) -> RecordingComparison:
    """Estimate the frequency of a recording by several methods and make its backbone from the first that succeeds.

    Parameters
    ----------
    source
        A file, or a recording already read.
    column, time_column
        Names or numbers of the columns of the samples and of their times; found by default.
    rate
        Samples per second, in place of a time column.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
    methods
        Estimators in order of preference.
    oscillator
        Drawn as theory at the measured amplitude, its parameters in the recording's units.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    RecordingComparison
        Tracks, backbone and growth rate with their deviations; angular frequency in rad/s.

    Raises
    ------
    InputError
        When no method succeeds.
    OSError
        For a file that cannot be read.
    """
    progress(0.0, "reading")
    if isinstance(source, Recording):
        recording = source
    else:
        recording = read_recording(source, column=column, time_column=time_column, rate=rate)
    found, failed = _estimations(recording, tuple(methods), band, progress)
    if not found:
        raise InputError(f"{recording.source}: no estimator succeeded; " + "; ".join(failed))
    progress(0.7, "backbone")
    first = measured(recording, found[0], 1, band)
    curve, doubt = first.backbone, ""
    if curve is None:
        curve = in_windows(found[0].track, recording)
        doubt = f"No uncertainty is claimed: {first.unmeasured}; what is drawn is of short windows"
    progress(0.9, "spectrogram")
    tracks = [one.track for one in found]
    return _assembled(recording, tracks, curve, [*first.notes, *failed], oscillator, doubt)


def in_windows(track: Track, recording: Recording) -> Backbone:
    """The backbone of windows, of all of a recording, where no model of one oscillation can be trusted."""
    start = float(recording.time[0])
    return backbone(track.of_oscillation(), recording.values, recording.rate, start=start, exclude=marked(recording))


def _estimations(
    recording: Recording,
    methods: tuple[str, ...],
    band: tuple[float, float] | None,
    progress: Callable[[float, str], None],
) -> tuple[list[Estimation], list[str]]:
    found, failed = [], []
    for i, method in enumerate(methods):
        progress(0.05 + 0.6 * i / len(methods), _LABELS.get(method, method))
        try:
            found.append(estimated(recording, method=method, band=band))
        except InputError as error:
            failed.append(str(error))
    return found, failed


def _assembled(
    recording: Recording,
    tracks: list[Track],
    curve: Backbone,
    said: list[str],
    oscillator: Oscillator | None,
    doubt: str,
) -> RecordingComparison:
    chosen, hum = tracks[0], hum_of(curve)
    curves = tuple(curve_of(track, track.method, _LABELS.get(track.method, track.method)) for track in tracks)
    fit = None if doubt else fit_backbone(curve.curve_amplitude, curve.curve_omega, curve.curve_omega_sd)
    known = np.nan if doubt else 1.0
    step = max(1, recording.time.size // MOST_POINTS)
    slowest, fastest = float(chosen.inside().omega.min()), float(chosen.inside().omega.max())
    return RecordingComparison(
        source=recording.source,
        sha256=recording.sha256,
        column=f"{recording.name} [{recording.units}]" if recording.units else recording.name,
        rate=recording.rate,
        time=recording.time[::step],
        signal=recording.values[::step],
        curves=curves,
        chosen=chosen.method,
        spectrogram=spectrogram_image(
            recording.values,
            recording.rate,
            period=2 * np.pi / slowest,
            top=TOP_MULTIPLE * fastest,
            name=f"Spectrogram of {recording.name}",
            overlays=curves[:1],
            start=float(recording.time[0]),
            unit="s",
        ),
        amplitude_time=curve.time,
        amplitude=curve.amplitude,
        backbone_amplitude=curve.curve_amplitude,
        backbone_omega=curve.curve_omega,
        backbone_omega_sd=known * curve.curve_omega_sd,
        growth_rate=curve.curve_growth_rate,
        growth_rate_sd=known * curve.curve_growth_rate_sd,
        fit=None if fit is None else formula_of(fit, recording.units),
        notes=tuple(_notes(curves, said)),
        theory=() if oscillator is None else (theory_curve(oscillator, curve),),
        over=None if oscillator is None else over_measured(oscillator, curve, known=not doubt),
        remarks=tuple(remarks(chosen, recording)),
        doubt=doubt,
        unit=recording.units,
        hum="" if hum is None else hum.said(),
    )


def remarks(track: Track, recording: Recording) -> Iterable[str]:
    """What of a record is no part of the oscillation that a track follows."""
    used, clipped = track.used, int(np.count_nonzero(recording.clipped))
    yield from beside_notes(used.tones, used.spikes)
    yield from swing_notes(used.swing)
    yield from used.span_notes()
    if clipped:
        what = "is clipped{} or lies" if clipped == 1 else "are clipped{} or lie"
        them = "it enters" if clipped == 1 else "they enter"
        how = what.format(" or stuck" if recording.facts.get("standing_still") else "")
        yield f"{clipped} sample{'s' * (clipped > 1)} {how} beside one that is; {them} no fit of the motion."


def _notes(curves: tuple[Curve, ...], said: list[str]) -> Iterable[str]:
    yield from said
    yield (
        f"The backbone is made from {curves[0].label}: the first that succeeded, in an order of preference that puts "
        "efficiency in noise and freedom from curvature bias first."
    )
    pairs = [(other.label, distance(curves[0], other)) for other in curves[1:]]
    apart = [f"{label} {relative(value)}" for label, value in pairs if value is not None]
    if apart:
        yield f"Rms distance of the other tracks from it, where both are valid: {', '.join(apart)}."
