"""A report as a list of sections: what stands where on the page.  A section exists only if the report has it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal
from urllib.parse import quote

from ridgeback.common.numbers import number, relative
from ridgeback.compare.recording.results import RecordingComparison
from ridgeback.compare.report.results import Provenance, Report
from ridgeback.compare.study.results import Checked, Derivation, Formula, Range
from ridgeback.reports.figures.decay import budget_figure, residuals_figure, tracks_figure
from ridgeback.reports.figures.identification import identification_blocks, parameter_table, ranking_table
from ridgeback.reports.figures.noise import noise_blocks, noise_table
from ridgeback.reports.figures.paper import paper_figures
from ridgeback.reports.figures.recording import recording_blocks
from ridgeback.reports.figures.study import backbone_block, error_block, map_block, order_needed
from ridgeback.reports.text.mathml import FormulaError, formula_latex, formula_mathml
from ridgeback.reports.text.tables import (
    budget_table,
    certified_table,
    estimator_table,
    range_table,
    score_table,
    timing_table,
)

DEFINED = (
    "These samples hold no noise, and the intervals are far narrower than ω₀(t) of a decay is defined: its crossings "
    "and its turning points read it {} apart, rms. A coverage below 95 % here tells of definitions; in noise it is "
    "measured by ridgeback estimate --monte-carlo."
)
PartKind = Literal["figure", "table", "formula", "text", "lines", "statement", "code", "downloads", "provenance"]


@dataclass(frozen=True)
class Part:
    """One piece of a section; the template knows how each kind is set."""

    kind: PartKind
    value: object


@dataclass(frozen=True)
class Section:
    """One titled section of the page."""

    key: str
    title: str
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class SetFormula:
    """A formula with its MathML; without it (LaTeX that cannot be set) the page shows the LaTeX itself."""

    title: str
    markup: str
    latex: str
    python: str
    note: str


def sections(report: Report) -> tuple[Section, ...]:
    """Return the sections of a page in reading order, empty ones left out."""
    found = (
        Section("section-backbone", "Frequency against amplitude", tuple(_backbone(report))),
        Section("section-recording", "The recording", tuple(_recording(report.recording))),
        Section("section-identification", "What made it", tuple(_identification(report))),
        Section("section-formula", "The expansion", tuple(_derivation(report.derivation))),
        Section("section-error", "Error against amplitude", tuple(_study_errors(report))),
        Section("section-map", "Which order is needed", tuple(_orders(report))),
        Section("section-tracks", "Frequency against time", tuple(_tracks(report))),
        Section("section-paper", "The paper's figures, measured", tuple(_paper(report))),
        Section("section-budget", "Where the errors come from", tuple(_errors(report))),
        Section("section-estimators", "The estimators", tuple(_estimators(report))),
        Section("section-timing", "What an evaluation costs", tuple(_timings(report))),
        Section("section-code", "Generated code", tuple(_code(report.derivation))),
        Section("section-data", "Data", tuple(_downloads(report.csv))),
        Section("section-provenance", "Provenance", (Part("provenance", _provenance(report.provenance)),)),
    )
    return tuple(section for section in found if section.parts)


def _finding(report: Report) -> Range | None:
    return report.finding or (report.ranges[0] if report.ranges else None)


def _backbone(report: Report) -> Iterator[Part]:
    if report.study:
        yield Part("figure", backbone_block(report.study, _finding(report)))


def _recording(recording: RecordingComparison | None) -> Iterator[Part]:
    if recording is None:
        return
    yield Part("text", f"{recording.source}, column {recording.column}, at {number(recording.rate)} Hz.")
    yield from (Part("figure", drawn) for drawn in recording_blocks(recording))
    if recording.fit:
        yield Part("formula", set_formula(recording.fit))
    if recording.notes:
        yield Part("lines", recording.notes)


def _derivation(derivation: Derivation | None) -> Iterator[Part]:
    if derivation is None:
        return
    yield from (Part("formula", set_formula(formula)) for formula in derivation.formulas)
    if derivation.certificate:
        yield Part("text", "Checked exactly:")
        yield Part("lines", tuple(map(check_line, derivation.certificate)))


def check_line(check: Checked) -> str:
    """One check of a certificate as a sentence; a failed one says so first.

    >>> check_line(Checked("residual", "it vanishes", False))
    'FAILED: Residual: it vanishes.'
    """
    failed = "FAILED: " if check.passed is False else ""
    return f"{failed}{check.name[0].upper()}{check.name[1:]}: {check.statement}."


def set_formula(formula: Formula) -> SetFormula:
    r"""Set a formula; LaTeX that cannot be set is kept as text, never dropped.

    >>> set_formula(Formula(title="", left="u", terms=(r"\nonsense",))).markup
    ''
    """
    try:
        markup = "".join(formula_mathml(formula))
    except FormulaError:
        markup = ""
    return SetFormula(formula.title, markup, formula_latex(formula), formula.python, formula.note)


def _study_errors(report: Report) -> Iterator[Part]:
    if report.study:
        yield Part("figure", error_block(report.study, _finding(report)))


def _orders(report: Report) -> Iterator[Part]:
    study = report.study
    if study is None:
        return
    yield Part("figure", map_block(study))
    needed = order_needed(study, report.ranges)
    if needed:
        yield Part("figure", needed)
    if report.ranges:
        letter = "A" if study.variable == "A" else "ε"
        yield Part("table", range_table(report.ranges, letter, study.amplitude_unit))
    if report.certified:
        yield Part("table", certified_table(report.certified, study.amplitude_unit))


def _tracks(report: Report) -> Iterator[Part]:
    if report.decay:
        yield Part("figure", tracks_figure(report.decay))
        if report.decay.curves:
            yield Part("figure", residuals_figure(report.decay))


def _paper(report: Report) -> Iterator[Part]:
    if report.decay:
        for item in paper_figures(report.decay):
            yield Part("statement", item.statement)
            yield from (Part("figure", drawn) for drawn in item.blocks)


def _errors(report: Report) -> Iterator[Part]:
    if report.decay is None:
        return
    drawn = budget_figure(report.decay)
    if drawn:
        yield Part("figure", drawn)
    if report.decay.budget:
        yield Part("table", budget_table(report.decay.budget))
    if report.decay.scores:
        yield Part("table", score_table(report.decay.scores, report.decay.reference.label))


def _estimators(report: Report) -> Iterator[Part]:
    if report.estimator_scores and report.decay:
        yield Part("table", estimator_table(report.estimator_scores, report.decay.reference.label))
        known = max((row.definition for row in report.decay.budget), default=0.0)
        if known:
            yield Part("text", DEFINED.format(relative(known)))
    if report.noise:
        yield from (Part("figure", drawn) for drawn in noise_blocks(report.noise))
        yield Part("table", noise_table(report.noise))
        if report.noise.notes:
            yield Part("lines", report.noise.notes)


def _identification(report: Report) -> Iterator[Part]:
    found = report.identification
    if found is None:
        return
    yield Part("text", found.verdict)
    yield Part("table", ranking_table(found))
    yield Part("table", parameter_table(found.best))
    yield from (Part("figure", drawn) for drawn in identification_blocks(found))
    if found.notes:
        yield Part("lines", found.notes)


def _timings(report: Report) -> Iterator[Part]:
    if report.timings:
        yield Part("table", timing_table(report.timings))


def _code(derivation: Derivation | None) -> Iterator[Part]:
    for name, text in (derivation.code if derivation else {}).items():
        yield Part("code", {"name": name, "text": text, "lines": text.count("\n") + (not text.endswith("\n"))})


def _downloads(csv: Mapping[str, str]) -> Iterator[Part]:
    if csv:
        yield Part("downloads", [_download(name, text) for name, text in csv.items()])


def _download(name: str, text: str) -> dict[str, str]:
    uri = "data:text/csv;charset=utf-8," + quote(text, safe=" ,.:;=+-_()/*")
    return {"name": name, "uri": uri.replace(" ", "%20"), "size": f"{len(text.encode()) / 1000:.0f} kB"}


def _provenance(provenance: Provenance) -> dict[str, object]:
    facts = [
        *((name, value) for name, value in provenance.parameters.items()),
        *((f"{name} version", value) for name, value in provenance.versions.items()),
        ("settings hash", provenance.settings_hash),
        ("input hash", provenance.input_hash),
        *((f"time, {name}", f"{number(seconds, 2)} s") for name, seconds in provenance.seconds.items()),
    ]
    return {"command": provenance.command, "facts": [(name, value) for name, value in facts if value]}
