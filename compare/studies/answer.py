"""What a question hands over: a table, a picture, sentences made from it, and whether what was tested passed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.picture import Picture
from ridgeback.compare.studies.tasks import Column


@dataclass(frozen=True, repr=False)
class Answer(Displayed):
    """One answered question; made by :func:`ridgeback.run_study`.

    Parameters
    ----------
    question : str
        Its name.
    title : str
        What the table holds.
    columns : tuple of Column
        The columns of the table, with units.
    table : tuple of mappings
        Its rows.
    sentences : tuple of str
        What follows from the table.
    drawing : Picture
        The figure.
    failed : int
        Cells that gave a reason and no value; they are in no row and no rank.
    passed : bool, optional
        Whether everything that was tested holds; None where nothing is tested.
    panels : tuple of Picture
        The figure as small ones side by side, where one alone is crowded.

    Examples
    --------
    >>> Answer("error", "errors", (), (), ("no cell",), Picture("", "", ""), 0)
    <Answer: error: no cell>
    """

    question: str
    title: str
    columns: tuple[Column, ...]
    table: tuple[Mapping[str, Any], ...]
    sentences: tuple[str, ...]
    drawing: Picture
    failed: int
    passed: bool | None = None
    panels: tuple[Picture, ...] = ()

    def rows(self) -> list[Mapping[str, Any]]:
        """The rows of the table."""
        return list(self.table)

    def headline(self) -> str:
        """The question and the first sentence."""
        return f"{self.question}: {self.sentences[0] if self.sentences else self.title}"

    def own_units(self) -> Mapping[str, str]:
        """Units of the columns."""
        return {column.name: column.unit for column in self.columns}

    def picture(self) -> Picture:
        """The figure."""
        return self.drawing

    def to_dict(self) -> dict[str, Any]:
        """The answer as JSON knows it, without its figure."""
        return {
            "question": self.question,
            "title": self.title,
            "passed": self.passed,
            "failed_cells": self.failed,
            "sentences": list(self.sentences),
            "columns": {column.name: {"unit": column.unit, "meaning": column.meaning} for column in self.columns},
            "rows": [dict(row) for row in self.table],
        }
