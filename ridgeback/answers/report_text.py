"""What ``ridgeback report`` says on the terminal of the page that it wrote."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from ridgeback.console.failure import PartialError
from ridgeback.console.output import json_text

if TYPE_CHECKING:
    from ridgeback.compare.motion.results import Statement
    from ridgeback.compare.report.results import Report


def refuse_incomplete(report: Report) -> None:
    """Raise PartialError for a failed certificate, and for methods that gave no result."""
    checks = report.derivation.certificate if report.derivation else ()
    wrong = [check.name for check in checks if check.passed is False]
    if wrong:
        raise PartialError(f"the page is written, but its certificate fails: {', '.join(wrong)}; it says how")
    rows = report.benchmark.contenders if report.benchmark else ()
    missing = list(dict.fromkeys(row.label for row in rows if row.refused and row.kind == "estimate"))
    if missing:
        raise PartialError(f"the page is written, but gave no result: {', '.join(missing)}; it says why")


def printed(report: Report, output: str, size: int, style: str) -> str:
    """The findings as text or JSON: what the page says first, and the scores and budget of every method."""
    if style == "text":
        return findings(report, output, size)
    decay = report.decay
    return json_text(
        {
            "output": output,
            "bytes": size,
            "title": report.title,
            "cards": [asdict(card) for card in report.cards],
            "summary": list(report.summary),
            "contenders": [row.to_dict() for row in report.benchmark.contenders] if report.benchmark else [],
            "scores": [asdict(score) for score in decay.scores] if decay else [],
            "budget": [asdict(row) for row in decay.budget] if decay else [],
            "statements": [statement_row(said) for said in decay.statements] if decay and report.paper else [],
        }
    )


def statement_row(said: Statement) -> dict[str, object]:
    """One of the paper's figures: what it says, what was measured, and the names of the curves drawn."""
    named = [curve.name for curve in said.curves]
    return {"figure": said.figure, "title": said.title, "paper": said.paper, "measured": said.measured, "curves": named}


def findings(report: Report, output: str, size: int) -> str:
    """Where the page is, its title, its three figures and its summary."""
    lines = [f"wrote {output} ({size / 1000:.0f} kB)", "", report.title, *([report.lead] if report.lead else []), ""]
    lines += [f"  {card.heading}: {card.value} ({card.text})" for card in report.cards]
    lines += ["", *(f"  {sentence}" for sentence in report.summary)]
    return "\n".join(lines) + "\n"
