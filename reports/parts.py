"""The pieces that a page is made of; the template knows how each kind is set."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal
from urllib.parse import quote

from ridgeback.common.numbers import number
from ridgeback.compare.report.results import Provenance
from ridgeback.compare.study.results import Checked, Formula, HarmonicTable
from ridgeback.reports.text.bibtex import bibtex
from ridgeback.reports.text.mathml import FormulaError, formula_latex, formula_mathml, mathml

PartKind = Literal[
    "figure",
    "table",
    "formula",
    "text",
    "lines",
    "claims",
    "harmonics",
    "code",
    "downloads",
    "provenance",
    "fold",
    "equations",
    "links",
]


@dataclass(frozen=True)
class Part:
    """One piece of a section."""

    kind: PartKind
    value: object


@dataclass(frozen=True)
class Section:
    """One titled section of the page."""

    key: str
    name: str
    """In the table of contents."""
    title: str
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Fold:
    """Parts behind a line that opens them; in print they are open."""

    summary: str
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class SetFormula:
    """A formula with its MathML; without it (LaTeX that cannot be set) the page shows the LaTeX itself."""

    title: str
    markup: str
    latex: str
    python: str
    note: str
    bibtex: str = ""


@dataclass(frozen=True)
class SetHarmonics:
    """The table of harmonics as MathML cells."""

    head: tuple[tuple[str, str], ...]
    """Markup, and how it is said, of each column."""
    rows: tuple[tuple[str, str, tuple[str, ...]], ...]
    """Markup, how it is said, and the cells of each row."""
    caption: str


def fold(summary: str, *parts: Part) -> Part:
    """Parts that are folded on a screen."""
    return Part("fold", Fold(summary, tuple(parts)))


def check_line(check: Checked) -> str:
    """One check of a certificate as a sentence; a failed one says so first.

    >>> check_line(Checked("residual", "it vanishes", False))
    'FAILED: Residual: it vanishes.'
    """
    failed = "FAILED: " if check.passed is False else ""
    return f"{failed}{check.name[0].upper()}{check.name[1:]}: {check.statement}."


def set_formula(formula: Formula, bibtex: str = "") -> SetFormula:
    r"""Set a formula; LaTeX that cannot be set is kept as text, never dropped.

    >>> set_formula(Formula(title="", left="u", terms=(r"\nonsense",))).markup
    ''
    """
    try:
        markup = "".join(formula_mathml(formula))
    except FormulaError:
        markup = ""
    return SetFormula(formula.title, markup, formula_latex(formula), formula.python, formula.note, bibtex)


def set_harmonics(table: HarmonicTable) -> SetHarmonics:
    """The table of harmonics, set; a cell that cannot be set is left as text by the caller's template."""
    letter = table.variable.replace("\\varepsilon", "epsilon")
    head = tuple((_set(_power(table.variable, n)), f"{letter} to the power {n}") for n in table.powers)
    rows = []
    for row in table.rows:
        multiple = "" if row.multiple == 1 else str(row.multiple)
        name = _set(rf"\{row.part} {multiple}\omega_0 t") if row.multiple else "mean"
        said = f"{_SAID[row.part]} of {row.multiple} times omega 0 t" if row.multiple else "mean"
        rows.append((name, said, tuple(_set(cell) if cell else "" for cell in row.cells)))
    return SetHarmonics(
        head, tuple(rows), "Exact coefficients of the motion u(t): a row for each harmonic, a column for each power."
    )


_SAID = {"cos": "cosine", "sin": "sine", "": ""}


def _power(variable: str, n: int) -> str:
    return "1" if n == 0 else variable if n == 1 else f"{variable}^{{{n}}}"


def _set(latex: str) -> str:
    try:
        return mathml(latex)
    except FormulaError:
        return ""


def download(name: str, text: str) -> dict[str, str]:
    """A file as a link that holds it.

    >>> download("a.csv", "x,y")["size"]
    '0 kB'
    """
    uri = "data:text/csv;charset=utf-8," + re.sub(
        r"[^\w,.:;=+\-()/*]+", lambda found: quote(found[0]), text, flags=re.ASCII
    )
    return {"name": name, "uri": uri, "size": f"{len(text.encode()) / 1000:.0f} kB"}


def downloads(files: Mapping[str, str]) -> Part:
    """All files of a page."""
    return Part("downloads", [download(name, text) for name, text in files.items()])


def provenance_part(made: Provenance, title: str) -> Part:
    """The command, and what it ran with; measured times come last and are absent where none were kept."""
    facts = [
        *made.parameters.items(),
        *((f"{name} version", value) for name, value in made.versions.items()),
        ("settings hash", made.settings_hash),
        ("input hash", made.input_hash),
        *((f"time, {name}", f"{number(seconds, 2)} s") for name, seconds in made.seconds.items()),
    ]
    given = [(n, v) for n, v in facts if v]
    return Part("provenance", {"command": made.command, "facts": given, "bibtex": bibtex(made, title)})
