"""A page printed to a PDF by a browser of the Chromium family, where this machine has one."""

from __future__ import annotations

import errno
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
SECONDS = 120
SMALLER = (0.95, 0.9)
"""Sizes of the print that are tried, where one of them saves a sheet of which little would have been filled."""


def chromium() -> str | None:
    """Path of the first browser that is there."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


def print_to_pdf(page: str, pdf: str) -> None:
    """Print an HTML file, up to a tenth smaller where that saves a sheet.

    Parameters
    ----------
    page
        The file; nothing is fetched by it.
    pdf
        Where the PDF goes; what was there is replaced when it is whole.

    Raises
    ------
    OSError
        Without a browser, or when it fails.
    """
    browser = chromium()
    if browser is None:
        raise OSError(errno.ENOENT, f"no browser to print with: none of {', '.join(NAMES[:3])} is on the path")
    with tempfile.TemporaryDirectory(prefix="ridgeback-", ignore_cleanup_errors=True) as folder:
        chosen = _printed(browser, Path(page), Path(folder), 1.0)
        for size in SMALLER if sheets(chosen) > 1 else ():
            smaller = _printed(browser, Path(page), Path(folder), size)
            if sheets(smaller) < sheets(chosen):
                chosen = smaller
                break
        made = Path(folder) / "page.pdf"
        made.write_bytes(chosen)
        shutil.move(made, pdf)


def sheets(pdf: bytes) -> int:
    """How many pages a PDF has.

    >>> sheets(b"<< /Type /Pages >> << /Type /Page >> << /Type /Page >>")
    2
    """
    return len(re.findall(rb"/Type\s*/Page\b(?!s)", pdf))


def _printed(browser: str, page: Path, folder: Path, size: float) -> bytes:
    """The PDF of a page at a size, as its bytes."""
    sized, made = folder / "page.html", folder / "made.pdf"
    style = f"<style>@media print{{main{{zoom:{size}}}}}</style></head>"
    sized.write_text(page.read_text(encoding="utf-8").replace("</head>", style, 1), encoding="utf-8")
    made.unlink(missing_ok=True)
    flags = (
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-pdf-header-footer",
        f"--user-data-dir={folder}/profile",
    )
    command = [browser, *flags, f"--print-to-pdf={made}", sized.resolve().as_uri()]
    try:
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS, check=False)  # noqa: S603
    except subprocess.TimeoutExpired:
        raise OSError(errno.ETIMEDOUT, f"{Path(browser).name} did not print within {SECONDS} s") from None
    if not made.is_file():
        raise OSError(errno.EIO, f"{Path(browser).name} printed nothing")
    return made.read_bytes()
