"""What a page shows of a finished study."""

from __future__ import annotations

from dataclasses import dataclass

from ridgeback.common.show.brief import Brief
from ridgeback.common.show.picture import Picture
from ridgeback.compare.studies.answer import Answer


@dataclass(frozen=True)
class Subject:
    """One oscillator of a study: its name, its equation in LaTeX, its parameters."""

    name: str
    equation_latex: str
    given: str


@dataclass(frozen=True, repr=False)
class Answered(Brief):
    """What a page shows of a finished study."""

    subjects: tuple[Subject, ...]
    panels: tuple[Picture, ...]
    """Error over amplitude for each oscillator and method, where the study has that; the first so many."""
    answers: tuple[Answer, ...]
    failures: tuple[tuple[str, int], ...]
    """Why cells have no value, and how many."""
    grids: int = 0
    """How many panels there would be."""
