"""Several runs and channels on one page: each measured, their backbones combined, what made each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ridgeback.common.csv_text import csv_text
from ridgeback.common.errors import InputError
from ridgeback.common.numbers import per_cent, uncertain
from ridgeback.common.progress import Progress, silent
from ridgeback.common.quantities import frequency, size
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.preparation import prepared
from ridgeback.compare.recording.measurement import Measurement
from ridgeback.compare.recording.measurements import Measurements, measure_recordings
from ridgeback.compare.recording.theory import MeasuredCurve, TheoryBackbone, curve_of, over_curve
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.recording_summary import at_amplitudes, lowered
from ridgeback.compare.report.results import Card, Report
from ridgeback.compare.report.several.runs import Named, Runs
from ridgeback.compare.report.stages import Stopwatch
from ridgeback.compare.study.results import Trend, trend_of
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

IDENTIFIED = 3
"""Signals that are told what made them; the others would cost as much again."""
TOLD = 2.0
"""Scatter between runs beyond their own errors is spoken of from this many times those on."""


def runs_report(
    recordings: Sequence[Recording],
    *,
    band: tuple[float, float] | None = None,
    oscillator: OscillatorLike | None = None,
    timed: bool = True,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Measure several signals, combine the backbones of each channel's runs, and say what made them.

    Parameters
    ----------
    recordings
        Runs, channels, stretches; two or more.
    band
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
    oscillator
        Its exact backbone is drawn over the measured ones.
    timed
        Whether measured times are kept; without them the same inputs give the same report.
    command
        The command line that makes the same report, for its provenance.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Report
        Complete; a signal that gives nothing is named with its reason.

    Raises
    ------
    InputError
        When no signal can be measured.
    """
    watch = Stopwatch(progress)
    theory = None if oscillator is None else as_oscillator(oscillator)
    with watch.stage("measuring", 0.0, 0.5) as inner:
        found = measure_recordings(recordings, band=band, progress=inner)
    with watch.stage("what made them", 0.5, 1.0) as inner:
        named = tuple(_named(found, band, inner))
    progress(1.0, "done")
    labels = labels_of([one.recording for one in found.measured])
    over = None if theory is None else _theory(found, theory)
    runs = Runs(found, labels, over, named)
    settings = {"signals": len(recordings), "theory": "" if theory is None else theory.equation, "band": band}
    hashes = ", ".join(dict.fromkeys(r.sha256[:16] for r in recordings if r.sha256))
    return Report(
        title=runs_title(runs),
        lead=runs_lead(runs),
        summary=tuple(_sentences(runs)),
        cards=tuple(_cards(runs)),
        derivation=None,
        study=None,
        ranges=(),
        decay=None,
        recording=None,
        provenance=provenance(settings, command=command, input_hash=hashes, seconds=watch.seconds() if timed else None),
        timed=timed,
        csv=dict(_files(runs)),
        runs=runs,
    )


def _named(found: Measurements, band: tuple[float, float] | None, progress: Progress) -> Iterator[Named]:
    labels = labels_of([one.recording for one in found.measured])
    pairs = [(label, one) for label, one in zip(labels, found.measured, strict=True) if one.backbone is not None]
    for i, (label, one) in enumerate(pairs[:IDENTIFIED]):
        progress(i / min(len(pairs), IDENTIFIED), label)
        try:
            yield Named(label, identify(prepared(one.recording, band=band)))
        except InputError as refusal:
            yield Named(label, None, str(refusal))


def labels_of(recordings: Sequence[Recording]) -> tuple[str, ...]:
    """What tells each signal from the others: file, run, channel, stretch, as far as they differ.

    >>> t = np.arange(20.0)
    >>> labels_of([Recording(t, t, 1.0, name, "", "a.csv", "") for name in ("x", "y")])
    ('x', 'y')
    """

    def parts(one: Recording) -> tuple[str, ...]:
        stretch = f"stretch {one.stretch}" if one.stretch else ""
        place = Path(one.source)
        return place.stem, "" if one.run in (place.stem, place.name) else one.run, one.name, stretch

    every = [parts(one) for one in recordings]
    differ = [len({row[i] for row in every}) > 1 for i in range(4)]
    names = [", ".join(word for word, own in zip(row, differ, strict=True) if own and word) for row in every]
    return tuple(name or f"signal {i + 1}" for i, name in enumerate(names))


def _theory(found: Measurements, oscillator: Oscillator) -> TheoryBackbone | None:
    for common in found.combined:
        c = common.curve
        return over_curve(oscillator, MeasuredCurve(c.amplitude, c.omega, c.omega_sd, c.growth_rate))
    own = next((one.backbone for one in found.measured if one.backbone is not None), None)
    return None if own is None else over_curve(oscillator, curve_of(own))


def _leading(found: Measurements) -> tuple[Array, Array, Array] | None:
    """Amplitude, frequency and its deviation of the first combined backbone, else of the first signal that has one."""
    for common in found.combined:
        return common.curve.amplitude, common.curve.omega, common.curve.omega_sd
    for one in found.measured:
        if one.backbone is not None:
            return one.backbone.curve_amplitude, one.backbone.curve_omega, one.backbone.curve_omega_sd
    return None


def _growth(found: Measurements) -> tuple[Array, Array, Array, Array] | None:
    """Amplitude, growth rate, its deviation and frequency of the same curve."""
    for common in found.combined:
        c = common.curve
        return c.amplitude, c.growth_rate, c.growth_rate_sd, c.omega
    for one in found.measured:
        if one.backbone is not None:
            b = one.backbone
            return b.curve_amplitude, b.curve_growth_rate, b.curve_growth_rate_sd, b.curve_omega
    return None


def between(found: Measurements) -> tuple[float, float] | None:
    """Median scatter of omega0 between the runs beyond their own errors, and the median of those; relative.

    The deviation of the combined backbone is no measure of it: the scatter is a part of that.  None where no amplitude
    is reached by two of them.
    """
    own = [one.backbone.curve_omega_sd / one.backbone.curve_omega for one in found.measured if one.backbone is not None]
    for common in found.combined:
        known = np.isfinite(common.curve.omega_between)
        if known.any():
            c = common.curve
            scatter = float(np.median(c.omega_between[known] / c.omega[known]))
            return scatter, float(np.nanmedian(np.concatenate(own)))
    return None


def runs_title(runs: Runs) -> str:
    """Whether the signals agree, and the frequency at the ends of their common backbone."""
    found, count = runs.found, len(runs.found.measured)
    what = f"{count} signals"
    curve = _leading(found)
    if curve is None:
        return f"{what}: none has an amplitude clear of the noise"
    amplitude, omega, _ = curve
    low, high = int(np.argmin(amplitude)), int(np.argmax(amplitude))
    pair = [high, low]
    ends = at_amplitudes(tuple(amplitude[pair].tolist()), tuple(omega[pair].tolist()), runs.unit)
    scatter = between(found)
    if scatter is None:
        return f"{what}: {ends}"
    agree = scatter[0] <= TOLD * scatter[1]
    way = trend_of(omega[[low, high]], curve[2][[low, high]])
    end = "" if way is Trend.CONSTANT else f": {way.value}"
    return f"{what} {'agree' if agree else f'differ by {per_cent(scatter[0])}'}: {ends}{end}"


def runs_lead(runs: Runs) -> str:
    """How many signals of which files, and what gave nothing."""
    files = list(dict.fromkeys(one.recording.source for one in runs.found.measured))
    named = ", ".join(Path(file).name for file in files[:4]) + (" and others" if len(files) > 4 else "")
    samples = sum(one.recording.values.size for one in runs.found.measured)
    lost = f" {len(runs.found.failed)} gave nothing." if runs.found.failed else ""
    return f"{named}: {samples} samples in all.{lost}"


def _sentences(runs: Runs) -> Iterator[str]:
    if runs.theory is not None:
        yield runs.theory.sentence()
    scatter = between(runs.found)
    if scatter is not None:
        if scatter[0] > TOLD * scatter[1]:
            yield (
                f"Between the runs ω₀ scatters by {per_cent(scatter[0])} beyond their own errors, in the median over "
                "the amplitudes that two of them reach; the combined interval holds that."
            )
        else:
            yield "Where two runs reach an amplitude they agree within their own errors."
    kinds = [(named.label, lowered(named.made)) for named in runs.named if named.made is not None]
    if kinds:
        same = len({title for _, title in kinds}) == 1
        yield (
            f"What made {'all that were tried' if same else 'each'}: "
            f"{kinds[0][1] if same else '; '.join(f'{label}: {title}' for label, title in kinds)}."
        )
    yield from (f"{failed}." for failed in runs.found.failed[:2])


def _cards(runs: Runs) -> Iterator[Card]:
    curve, growth = _leading(runs.found), _growth(runs.found)
    if curve is None or growth is None:
        return
    amplitude, omega, sd = curve
    ends = [int(np.argmax(amplitude)), int(np.argmin(amplitude))]
    way = trend_of(omega[ends[::-1]], sd[ends[::-1]])
    told = "no dependence beyond the uncertainty" if way is Trend.CONSTANT else way.value
    rows = tuple(
        (f"at {size(amplitude[i], runs.unit)}", f"{uncertain(omega[i] / (2 * np.pi), sd[i] / (2 * np.pi))} Hz")
        for i in ends
    )
    yield Card("Fundamental frequency", frequency(float(np.median(omega)), "s"), f"median; {told}", rows)
    ratio, deviation = -growth[1] / growth[3], growth[2] / growth[3]
    middle = float(np.median(ratio))
    damped = tuple((f"at {size(growth[0][i], runs.unit)}", uncertain(ratio[i], deviation[i])) for i in ends)
    yield Card("Damping ratio", per_cent(middle, signed=middle < 0), "median of −a′/(aω₀)", damped)
    scatter = between(runs.found)
    if scatter is not None:
        beyond = scatter[0] > 0
        value, text = (
            (per_cent(scatter[0]), "scatter of ω₀ between runs") if beyond else ("within errors", "no scatter")
        )
        yield Card("Agreement", value, text, (("own error", f"{per_cent(scatter[1])} of ω₀, median"),))


def _files(runs: Runs) -> Iterator[tuple[str, str]]:
    for common in runs.found.combined:
        name = "combined.csv" if len(runs.found.combined) == 1 else f"combined-{common.channel}.csv"
        rows = common.curve.rows()
        yield name, csv_text(list(rows[0]), [list(row.values()) for row in rows])
    head = ["signal", "amplitude", "omega", "omega_standard_deviation", "growth_rate", "growth_rate_standard_deviation"]
    yield "backbones.csv", csv_text(head, [row for pair in _pairs(runs) for row in _backbone_rows(*pair)])
    yield "tracks.csv", csv_text(["signal", "time", "omega", "low_95", "high_95"], _track_rows(runs))


def _pairs(runs: Runs) -> Iterator[tuple[str, Measurement]]:
    yield from zip(runs.labels, runs.found.measured, strict=True)


def _backbone_rows(label: str, one: Measurement) -> Iterator[list[object]]:
    if one.backbone is None:
        return
    b = one.backbone
    columns = (b.curve_amplitude, b.curve_omega, b.curve_omega_sd, b.curve_growth_rate, b.curve_growth_rate_sd)
    for values in zip(*(column.tolist() for column in columns), strict=True):
        yield [label, *values]


def _track_rows(runs: Runs) -> Iterator[list[object]]:
    for label, one in _pairs(runs):
        along = one.frequency()
        for values in zip(*(part.tolist() for part in along), strict=True):
            yield [label, *(f"{v:.8g}" for v in values)]
