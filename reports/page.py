"""The one HTML page: everything inside, nothing fetched, safe whatever the names in a report are."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Mapping
from importlib import resources

from jinja2 import Environment, PackageLoader, StrictUndefined

from ridgeback.compare.report.results import Described, Report
from ridgeback.reports.drawing.theme import variables_css
from ridgeback.reports.sheet import Sheet, report_sheet
from ridgeback.reports.text.mathml import FormulaError, mathml

WARN_BYTES = 2_000_000
LETTERS = {"expansions": "E", "series model": "S", "estimates": "T", "": ""}
"""Letter of each way, which names its colour in the style sheet."""


def html_page(report: Report) -> str:
    """The whole page of a report as HTML; the same report gives the same bytes.

    The page's only script is admitted by its hash, so that markup smuggled in through a name could not run
    even if it were not escaped (it is).

    Parameters
    ----------
    report
        What to show; sections exist for the parts that it has.

    Returns
    -------
    str
        One HTML file that fetches nothing.
    """
    return rendered(report_sheet(report))


def rendered(sheet: Sheet) -> str:
    """Set a page."""
    script, style = _script(sheet.code), _source("style.css")
    return (
        _environment()
        .get_template("page.html")
        .render(
            sheet=sheet,
            equation=_equation(sheet.described),
            letters=LETTERS,
            style=variables_css() + style,
            script=script,
            script_hash=_hash(script),
        )
    )


def _script(code: Mapping[int, str]) -> str:
    """The page's script with the generated code of every order in it."""
    functions = ",".join(f"{order}:{text}" for order, text in sorted(code.items()))
    return _source("script.js").replace("/*CODE*/", functions, 1)


def size_warning(page: str) -> str | None:
    """Return a warning when a page is heavier than a browser and a mail server like, else None.

    >>> size_warning("x" * 10) is None
    True
    """
    size = len(page.encode())
    if size <= WARN_BYTES:
        return None
    return (
        f"the page has {size / 1e6:.1f} MB, more than {WARN_BYTES / 1e6:.0f} MB; "
        "fewer amplitudes, orders or samples make it smaller"
    )


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("ridgeback.reports"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["tied"] = tied
    environment.policies["json.dumps_kwargs"] = {"separators": (",", ":"), "allow_nan": False}
    return environment


def tied(text: str) -> str:
    """A text in which no line ends between a number and its unit, before its power of ten, or within t = 1.

    >>> tied("within 0.1 % at 2 ns a value").count(chr(160))
    2
    >>> tied("at t = 20").count(chr(160))
    2
    """
    text = re.sub(r"(?<=\b[^\W\d]) = (?=[−\d])", "\u00a0=\u00a0", text)
    held = re.sub(r"(?<=[0-9π⁻⁰¹²³⁴⁵⁶⁷⁸⁹]) (?=(?:%|ns|µs|ms|s|Hz|rad|dB|terms)(?![a-z]))", "\u00a0", text)
    return held.replace(" × 10", "\u00a0×\u00a010").replace(" ± ", "\u00a0±\u00a0")


def _source(name: str) -> str:
    return (resources.files("ridgeback.reports") / "templates" / name).read_text(encoding="utf-8")


def _hash(script: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")


def _equation(described: Described | None) -> str:
    """The equation as MathML, empty when there is none or when it cannot be set."""
    if described is None:
        return ""
    try:
        return mathml(described.equation_latex)
    except FormulaError:
        return ""
