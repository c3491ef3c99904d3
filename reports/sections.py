"""A report as sections in reading order; a section exists only if the report has what it shows."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ridgeback.common.numbers import listing, number
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.motion.results import MotionComparison
from ridgeback.compare.report.naming import short_name
from ridgeback.compare.report.results import Report
from ridgeback.compare.study.results import Derivation
from ridgeback.reports.drift_sections import drift_sections
from ridgeback.reports.figures.accuracy_cost import accuracy_cost
from ridgeback.reports.figures.budget import budget_figure, budget_heading
from ridgeback.reports.figures.in_time import Drawn, along, in_time
from ridgeback.reports.figures.motion import motion
from ridgeback.reports.figures.noise import noise_figure, noise_heading, noise_sentence, noise_table
from ridgeback.reports.figures.order_map import letter, order_map, reach_sentence
from ridgeback.reports.figures.planes import planes
from ridgeback.reports.index_sections import index_sections
from ridgeback.reports.outside_sections import outside_sections
from ridgeback.reports.parts import (
    Part,
    Section,
    check_line,
    downloads,
    fold,
    provenance_part,
    set_formula,
    set_harmonics,
)
from ridgeback.reports.recording_sections import recording_sections
from ridgeback.reports.runs_sections import runs_sections
from ridgeback.reports.study_sections import study_sections
from ridgeback.reports.text.bibtex import bibtex
from ridgeback.reports.text.tables import budget_table, certified_table, contender_table, range_table

FORMULAS = 2
"""Formulas that stand open; the others are folded."""


def sections(report: Report) -> tuple[Section, ...]:
    """The sections of a page below its head, empty ones left out."""
    found = (
        *index_sections(report),
        *study_sections(report),
        *drift_sections(report),
        *runs_sections(report),
        *recording_sections(report),
        _time(report),
        _order(report),
        _expansion(report),
        _motion(report),
        _paper(report),
        _noise(report),
        _budget(report),
        _code(report.derivation),
        *outside_sections(report),
        _data(report),
        Section("provenance", "Provenance", "Provenance", (provenance_part(report.provenance, report.title),)),
    )
    return tuple(section for section in found if section is not None and section.parts)


def head_parts(report: Report) -> tuple[Part, ...]:
    """The first figure, below the cards."""
    if report.benchmark is None:
        return ()
    target = report.finding.target if report.finding else 1e-3
    return (Part("figure", accuracy_cost(report.benchmark, target)),)


def head_tables(report: Report) -> tuple[Part, ...]:
    """The table behind the first figure, below the findings."""
    if report.benchmark is None:
        return ()
    count = len({short_name(row) for row in report.benchmark.contenders})
    return (fold(f"All {count} contenders as a table", Part("table", contender_table(report.benchmark))),)


def _time(report: Report) -> Section | None:
    found, decay = report.benchmark, report.decay
    if found is None or decay is None:
        return None
    return Section("time", "Frequency in time", _time_title(found, decay), (Part("figure", in_time(found, decay)),))


def _time_title(found: Benchmark, decay: MotionComparison) -> str:
    """Where along the motion the drawn contenders err most, told for those that agree."""
    drawn = [d for d in along(found, decay) if (d.row.relative_rms_error or 0.0) > found.reference.floor]
    places: dict[str, list[str]] = {}
    for letter_, name in (("E", "expansions"), ("S", "models")):
        where = {_where(found, d) for d in drawn if d.letter == letter_} - {""}
        if len(where) == 1:
            places.setdefault(where.pop(), []).append(name)
    wigner = next((d for d in drawn if d.row.method == "wigner"), None)
    if wigner is not None and (place := _where(found, wigner)):
        places.setdefault(place, []).append(f"the {short_name(wigner.row)}")
    said = [f"{listing(names)} {place}" for place, names in places.items()]
    if not said:
        return "Frequency in time"
    first = next(iter(places.values()))
    one = len(first) == 1 and first[0].startswith("the ")
    verb = " errs most " if one else " err most "
    return f"In time, {listing(first)}{verb}{listing([next(iter(places)), *said[1:]])}"


def _where(found: Benchmark, drawn: Drawn) -> str:
    inside = (found.time >= found.support[0]) & (found.time <= found.support[1]) & np.isfinite(drawn.error)
    if not inside.any():
        return ""
    at = float(found.time[inside][int(np.argmax(drawn.error[inside]))])
    share = (at - found.support[0]) / (found.support[1] - found.support[0])
    return "at the start" if share < 0.2 else "at the end" if share > 0.8 else "in the middle"


def _order(report: Report) -> Section | None:
    study, grid, finding = report.study, report.grid, report.finding
    if study is None or grid is None or finding is None:
        return None
    parts = [Part("figure", order_map(study, grid, finding, report.decay))]
    tables = [Part("table", range_table(report.ranges, letter(study), study.amplitude_unit))]
    if report.certified:
        tables.append(Part("table", certified_table(report.certified, study.amplitude_unit)))
    parts.append(fold("Ranges of use, and other formulas from the same coefficients", *tables))
    title = reach_sentence(study, finding.target, finding.order, finding.up_to)
    return Section("order", f"Order, {'amplitude' if study.variable == 'A' else 'ε'}", title, tuple(parts))


def _expansion(report: Report) -> Section | None:
    found = report.derivation
    if found is None:
        return None
    cited = bibtex(report.provenance, report.title)
    formulas = [Part("formula", set_formula(formula, cited)) for formula in found.formulas]
    parts: list[Part] = [*formulas[:1]]
    failed = [check_line(check) for check in found.certificate if check.passed is False]
    checked = [check_line(check) for check in found.certificate]
    if failed:
        parts.append(Part("lines", failed))
    if found.harmonics is not None:
        parts.append(Part("harmonics", set_harmonics(found.harmonics)))
    rest = [*formulas[1:], *((Part("lines", checked),) if checked else ())]
    if rest:
        parts.append(fold(_rest_title(found), *rest))
    return Section("expansion", "The expansion", "The expansion, exact", tuple(parts))


def _rest_title(found: Derivation) -> str:
    names = [formula.title[:1].lower() + formula.title[1:] for formula in found.formulas[1:]]
    passed = sum(check.passed is True for check in found.certificate)
    checks = f"{passed} exact check{'s' if passed > 1 else ''} passed" if passed else ""
    text = "; ".join([*names, *((checks,) if checks else ())])
    return text[:1].upper() + text[1:]


def _motion(report: Report) -> Section | None:
    decay = report.decay
    if decay is None:
        return None
    cycle = report.study is not None and report.study.variable != "A"
    parts = (Part("figure", motion(decay, cycle=cycle)), Part("figure", planes(decay)))
    return Section("motion", "Motion, planes", "The motion, and where its frequency shows", parts)


def _paper(report: Report) -> Section | None:
    if not report.paper or report.decay is None:
        return None
    rows = [(f"Fig. {said.figure}: {said.title}", said.paper, said.measured) for said in report.decay.statements]
    return Section("paper", "The paper’s claims", "The paper, claim by claim", (Part("claims", rows),))


def _noise(report: Report) -> Section | None:
    if report.noise is None:
        return None
    sentence = noise_sentence(report.noise)
    parts: Iterator[Part] = iter(
        (
            *((Part("text", sentence),) if sentence else ()),
            Part("figure", noise_figure(report.noise)),
            fold("The numbers, with their ratio to the bound", Part("table", noise_table(report.noise))),
            *((Part("lines", report.noise.notes),) if report.noise.notes else ()),
        )
    )
    return Section("noise", "Estimates in noise", noise_heading(report.noise), tuple(parts))


def _budget(report: Report) -> Section | None:
    decay = report.decay
    if decay is None or not decay.budget:
        return None
    reference = report.benchmark.reference if report.benchmark else None
    parts = (
        Part("figure", budget_figure(decay.budget, reference)),
        fold(
            f"All {number(len(decay.budget))} methods as a table, with closure",
            Part("table", budget_table(decay.budget, reference)),
        ),
    )
    floor = reference.floor if reference else 0.0
    return Section("errors", "Error budget", budget_heading(decay.budget, floor), parts)


def _code(found: Derivation | None) -> Section | None:
    if found is None or not found.code:
        return None
    return Section("code", "Generated code", f"Generated code, order {found.order}", (Part("code", dict(found.code)),))


def _data(report: Report) -> Section | None:
    return Section("data", "Data", "Data", (downloads(report.csv),)) if report.csv else None
