"""What ``ridgeback estimate`` measures of recordings: omega0(t), a(t), backbone and growth rate of each signal.

The signals of a recording are its channels, runs and the stretches between its gaps.  Each is measured by itself; the
backbones of the runs and stretches of one channel are then combined, since they are of one oscillator.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.compare.recording.components import measured_components
from ridgeback.compare.recording.measurement import Measurement
from ridgeback.numeric.backbone.combined import CombinedBackbone, combine
from ridgeback.numeric.recording.recording import Recording

ESTIMATE = 0.8
"""Share of a measurement's time that the track takes, about."""
COMBINE = ("runs", "all", "none")


@dataclass(frozen=True)
class Common:
    """The combined backbone of the runs of a channel, or of all channels."""

    channel: str
    curve: CombinedBackbone


@dataclass(frozen=True, repr=False)
class Measurements:
    """All that was measured; ``failed`` says which whole signals gave nothing, ``notes`` which stretches did."""

    measured: tuple[Measurement, ...]
    combined: tuple[Common, ...]
    failed: tuple[str, ...]
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        channels = ", ".join(dict.fromkeys(one.recording.label for one in self.measured))
        return f"<Measurements: {channels}; {len(self.combined)} combined backbones, {len(self.failed)} failed>"


def measure_recordings(
    recordings: Sequence[Recording],
    *,
    combine_over: str = "runs",
    harmonic: int = 1,
    halves: bool = False,
    progress: Wanted = None,
    **settings: object,
) -> Measurements:
    """Measure every signal and combine their backbones.

    Parameters
    ----------
    recordings : sequence of Recording
        Signals: channels, runs, and the stretches between gaps.
    combine_over : {"runs", "all", "none"}
        Which backbones are combined: those of the runs and stretches of each channel, of everything, or none.
    harmonic : int
        Which multiple of the fundamental is tracked; above 1 there is an amplitude and no backbone.
    halves : bool
        Whether frequency and amplitude are taken half cycle by half cycle.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share of the work that is done, 0 to 1, and the step.
    **settings
        Those of :func:`ridgeback.numeric.estimators.estimate.estimate`.  With ``components`` of 2 or more the tones
        beside the oscillation are measured, too, each as a signal of its own.

    Returns
    -------
    Measurements
        ``measured``, one for each signal and component; ``combined`` backbones; ``failed``, the signals that gave
        nothing; ``notes``, the stretches that were left out where another of the same signal could be measured.

    Raises
    ------
    InputError
        When nothing can be measured at all, and when backbones in different units would be combined.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(640) / 32.0
    >>> runs = [Recording(t, a * np.cos(6.0 * t), 32.0, "u", "mm", f"run{a:g}.csv", "") for a in (1.0, 2.0)]
    >>> [one.recording.source for one in measure_recordings(runs, method="zero-crossing").measured]
    ['run1.csv', 'run2.csv']
    """
    if combine_over not in COMBINE:
        raise InputError(f"combine {combine_over!r} is unknown; use one of {', '.join(COMBINE)}")
    measured: list[Measurement] = []
    refused: list[tuple[Recording, InputError]] = []
    with showing(progress) as told:
        for i, recording in enumerate(recordings):
            inner = within(told, recording.label, i / len(recordings), 1.0 / len(recordings))
            inner(0.0, "search band and components")
            try:
                measured += measured_components(recording, harmonic=harmonic, halves=halves, progress=inner, **settings)
            except InputError as error:
                refused.append((recording, error))
    if not measured:
        raise refusal(refused)
    good = {signal_of(m.recording) for m in measured}
    return Measurements(
        measured=tuple(measured),
        combined=tuple(common(measured, combine_over)),
        failed=tuple(f"{r.label}: {error}" for r, error in refused if signal_of(r) not in good),
        notes=tuple(f"Left out, {r.label}: {error}." for r, error in refused if signal_of(r) in good),
    )


def refusal(refused: Sequence[tuple[Recording, InputError]]) -> InputError:
    """Why nothing could be measured; of stretches between gaps for the reason of the longest, and what keeps them."""
    if len(refused) < 2 or not all(recording.stretch for recording, _ in refused):
        return refused[0][1]
    longest, error = max(refused, key=lambda one: one[0].values.size)
    parts = [recording for recording, _ in refused if signal_of(recording) == signal_of(longest)]
    gap = statistics.median(float(b.time[0] - a.time[-1]) for a, b in pairwise(parts))
    return InputError(
        f"{error}; of {len(parts)} stretches between gaps the longest has {longest.values.size} samples: "
        f"--fill {1.01 * gap:.3g} keeps together what is missing for so long"
    )


def within(told: Progress, label: str, begin: float, share: float) -> Progress:
    """What a signal's estimate is to be told, which is the larger part of its measurement.

    >>> within(lambda fraction, step: print(f"{fraction:g} {step}"), "run.csv, u", 0.5, 0.5)(1.0, "done")
    0.9 run.csv, u: amplitude and backbone
    """
    return lambda fraction, step: told(
        begin + ESTIMATE * share * fraction, f"{label}: {step if fraction < 1.0 else 'amplitude and backbone'}"
    )


def signal_of(recording: Recording) -> tuple[str, str, str]:
    """What all stretches of a signal have in common."""
    return recording.source, recording.run, recording.channel


def common(measured: Sequence[Measurement], over: str) -> Iterator[Common]:
    """The combined backbones of groups of more than one."""
    groups: dict[tuple[str, int], list[Measurement]] = {}
    for one in measured:
        if one.backbone is not None and over != "none":
            channel = one.recording.channel if over == "runs" else "all channels"
            groups.setdefault((channel, one.component), []).append(one)
    for (channel, component), members in groups.items():
        units = sorted({m.recording.units or "no unit" for m in members})
        if len(units) > 1:
            raise InputError(
                f"backbones in {' and '.join(units)} cannot be combined; combine over runs, or name columns of one unit"
            )
        if len(members) > 1:
            curves = [m.backbone for m in members if m.backbone is not None]
            name = f"{channel}, component {component}" if component else channel
            yield Common(name, combine(curves, [m.recording.label for m in members]))
