"""The page of a report, made where pages are made and written whole or not at all."""

from __future__ import annotations

import os
from importlib import import_module
from pathlib import Path
from typing import Any

from ridgeback.common.files import write_whole

PAGE = "ridgeback.reports.page"
"""The module that makes pages.  It is named here and imported only when a page is made."""


def page_of(report: Any) -> str:
    """The one self-contained HTML page of a report."""
    return str(import_module(PAGE).html_page(report))


def save_page(report: Any, path: str | os.PathLike[str]) -> Path:
    """Write the page, whole or not at all, and return where it is; raises OSError where it cannot be written."""
    target = Path(path)
    write_whole(target, [page_of(report).encode()])
    return target
