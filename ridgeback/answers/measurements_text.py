"""What ``ridgeback estimate`` prints: tracks, half cycles and backbones of one signal or several, in three forms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ridgeback.common.quantities import sampling_text
from ridgeback.console.output import json_text
from ridgeback.console.tables import aligned, csv_text, readable

if TYPE_CHECKING:
    from ridgeback.compare.recording.measurement import Measurement
    from ridgeback.compare.recording.measurements import Common, Measurements
    from ridgeback.numeric.recording.recording import Recording

COMBINED = "combined"
LEAST = 1e-300
"""The least probability that is told."""


def measurements_text(found: Measurements, style: str, *, backbone: bool, every: bool = True) -> str:
    """All signals that were measured in the form asked for, tracks or backbones; text with ``every`` number or some."""
    if style == "json":
        return json_text(as_json(found, backbone=backbone))
    if style == "csv":
        return as_csv(found, backbone=backbone)
    parts = [one_text(one, backbone=backbone, every=every) for one in found.measured]
    parts += [common_text(common) for common in found.combined] if backbone else []
    notes = [*found.notes, *(f"Failed, {reason}." for reason in found.failed)]
    return "\n".join(parts) + "".join(f"\n{note}" for note in notes) + ("\n" if notes else "")


def rows_of(one: Measurement, *, backbone: bool) -> list[dict[str, Any]]:
    """The rows of a signal; none where its backbone is asked for and there is none."""
    if not backbone:
        return [dict(row) for row in one.rows()]
    return [dict(row) for row in one.backbone.rows()] if one.backbone is not None else []


def as_json(found: Measurements, *, backbone: bool) -> dict[str, Any]:
    """One signal as it is, several in a list, with their combined backbones."""
    signals = [one_json(one, backbone=backbone) for one in found.measured]
    if len(signals) == 1 and not found.failed and not found.notes:
        return signals[0]
    combined = [
        {
            "channel": common.channel,
            "amplitude": common.curve.definition,
            "runs": common.curve.labels,
            "backbone": common.curve.rows(),
        }
        for common in found.combined
    ]
    return {"signals": signals, "combined": combined, "notes": [*found.notes], "failed": [*found.failed]}


def one_json(one: Measurement, *, backbone: bool) -> dict[str, Any]:
    """Method, settings, notes, and the rows: the track and the backbone, or the backbone alone."""
    whole: dict[str, Any] = {
        "method": one.method,
        "settings": about(one.recording, one.found.settings),
        "recording": {"run": one.recording.run, "stretch": one.recording.stretch, **one.recording.facts},
        "notes": [*one.notes, *misfit(one)],
    }
    if one.component:
        whole["component"] = one.component
    if not backbone:
        whole["track"] = one.rows()
    curve = one.backbone
    if curve is not None:
        whole["amplitude_definition"] = curve.definition
        whole["offset"] = curve.offset
        whole["backbone"] = curve.rows()
    return whole


def misfit(one: Measurement) -> tuple[str, ...]:
    """The sentence that a fitted oscillator is not what made the signal, where its residual says so."""
    found = None if one.track is None else one.track.misfit
    if found is None:
        return ()
    return (
        f"Misfit: what the {found.oscillator} leaves of the signal is no white noise "
        f"(probability {found.probability:.1g}), so it is not the oscillator that made it; free more parameters or "
        "name another.",
    )


def chance(one: Measurement) -> tuple[str, ...]:
    """The sentence of the probability that all is noise."""
    seen = one.found.presence
    if seen is None:
        return ()
    what = "An oscillation stands out" if seen.found else "No oscillation stands out"
    how_likely = f"{seen.probability:.1g}" if seen.probability > LEAST else f"below {LEAST:g}"
    return (f"{what} of the noise, which alone shows as clear a peak with probability {how_likely}.",)


def asides(one: Measurement) -> list[str]:
    """What a table of numbers has no room for: the notes, and why there is no interval."""
    reason = one.found.no_interval
    return [*one.notes, *([] if reason is None else [f"No interval: {reason}."])]


def as_csv(found: Measurements, *, backbone: bool) -> str:
    """One table; with several signals each row says which, and a combined backbone is one more run."""
    tables = [(named(one), rows_of(one, backbone=backbone)) for one in found.measured]
    if backbone:
        tables += [
            ({"run": COMBINED, "channel": c.channel, "stretch": ""}, [dict(r) for r in c.curve.rows()])
            for c in found.combined
        ]
    rows = tables[0][1] if len(tables) == 1 else [{**name, **row} for name, lines in tables for row in lines]
    return csv_text(list(columns_of(rows)), rows)


def columns_of(rows: Iterable[Mapping[str, Any]]) -> dict[str, None]:
    """Every column that any row has, in order of appearance."""
    found: dict[str, None] = {}
    for row in rows:
        found.update(dict.fromkeys(row))
    return found


def named(one: Measurement) -> dict[str, Any]:
    """Which signal a row belongs to."""
    recording = one.recording
    return {
        "run": recording.run or recording.source,
        "channel": recording.channel,
        "stretch": recording.stretch or "",
        **({"component": one.component} if one.component else {}),
    }


def one_text(one: Measurement, *, backbone: bool, every: bool = True) -> str:
    """Heading, notes, summary and table of one signal."""
    from ridgeback.answers.measurement_summary import briefly, pace_of_rows, summary, thinned

    rows = rows_of(one, backbone=backbone)
    pace = pace_of_rows(rows)
    shown = rows if every else [briefly(rows[i], pace) for i in thinned(len(rows))]
    table = aligned(list(columns_of(shown)), shown) if rows else "no rows"
    less = ", frequencies less their bias" if any(row.get("low_95_rad_s") is not None for row in rows) else ""
    rest = f"\n{len(shown)} of {len(rows)} rows, with one sigma{less}; --all or -o FILE gives all that there is"
    notes = "".join(f"\n{note}" for note in (*one.notes, *misfit(one)))
    lines = "".join(f"\n{line}" for line in summary(one))
    return f"{heading(one)}{notes}\n{lines}\n\n{table}{'' if every else rest}\n\n{how(one)}\n"


def common_text(common: Common) -> str:
    """Heading and table of a combined backbone."""
    rows = common.curve.rows()
    title = f"combined backbone of {common.channel}: {'; '.join(common.curve.labels)}"
    how = "weighted by precision and by the scatter between them, which the columns between_runs give"
    return f"{title}\n{how}\n\n{aligned(list(rows[0]), rows)}\n"


def about(recording: Recording, settings: Mapping[str, object]) -> dict[str, object]:
    """The estimator's settings, and which samples of which file they were used on."""
    return {"source": recording.source, "sha256": recording.sha256, "column": recording.name, **settings}


def heading(one: Measurement) -> str:
    """What was measured."""
    recording = one.recording
    component = f", component {one.component}" if one.component else ""
    return f"{recording.label}{component}: {len(recording.values)} samples at {sampling_text(recording.rate)}"


def how(one: Measurement) -> str:
    """The estimator with its settings, and whether there is an oscillation."""
    known = {name: value for name, value in one.found.settings.items() if isinstance(value, (int, float, str))}
    settings = ", ".join(f"{name} = {readable(value)}" for name, value in known.items())
    return "\n".join([f"{one.method}: {settings}", *chance(one)])
