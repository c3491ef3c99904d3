"""How a report shows itself, and how it becomes a page."""

from __future__ import annotations

import os
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from ridgeback.common.errors import InputError
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.page import page_of, save_page
from ridgeback.common.show.picture import Picture, Stroke

if TYPE_CHECKING:
    from ridgeback.compare.recording.results import RecordingComparison
    from ridgeback.compare.study.results import Study


FRAME = 900
"""Height of a page in a notebook, in pixels."""


class ShownReport(Displayed):
    """What a report shows of itself."""

    INDEX: ClassVar[tuple[str, ...]] = ("heading",)

    title: str
    lead: str
    summary: tuple[str, ...]
    study: Study | None
    recording: RecordingComparison | None

    def findings(self) -> tuple[tuple[str, str, str], ...]:
        """Heading, value and text of each of the figures that a reader takes away."""
        raise NotImplementedError

    def rows(self) -> list[dict[str, str]]:
        """One row per finding: heading, finding, text."""
        names = ("heading", "finding", "text")
        return [dict(zip(names, finding, strict=True)) for finding in self.findings()]

    def headline(self) -> str:
        """The title, which states the finding."""
        return self.title

    def _repr_html_(self) -> str:
        """The page itself, in a frame of its own."""
        page = escape(self.to_html(), quote=True)
        title = escape(self.title, quote=True)
        look = f'sandbox="allow-scripts allow-downloads" style="width:100%;height:{FRAME}px;border:0"'
        return f'<iframe title="{title}" {look} srcdoc="{page}"></iframe>'

    def picture(self) -> Picture:
        """The errors of the study, or the measured backbone."""
        if self.study is not None:
            return self.study.picture()
        if self.recording is None:
            raise InputError("the report holds neither a study nor a recording; there is nothing to draw")
        found = self.recording
        low, high = found.backbone_omega - found.backbone_omega_sd, found.backbone_omega + found.backbone_omega_sd
        stroke = Stroke(found.backbone_amplitude, found.backbone_omega, "measured, one sigma", low, high)
        return Picture(self.title, f"amplitude of {found.column}", "omega, rad/s", (stroke,))

    def to_html(self) -> str:
        """The page.

        Returns
        -------
        str
            One self-contained HTML file: nothing is fetched, and the same report gives the same bytes.
        """
        return page_of(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the page.

        Parameters
        ----------
        path : str or path
            Where to; the file appears whole or not at all, in place of one that is there.

        Returns
        -------
        Path
            Where it is.

        Raises
        ------
        OSError
            Where it cannot be written; what was there is as it was.
        """
        return save_page(self, path)
