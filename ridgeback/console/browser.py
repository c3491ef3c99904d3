"""A page printed to a PDF by a browser of the Chromium family, where this machine has one."""

from __future__ import annotations

import errno
import shutil
import subprocess
import tempfile
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
SECONDS = 120


def chromium() -> str | None:
    """Path of the first browser that is there."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


def print_to_pdf(page: str, pdf: str) -> None:
    """Print an HTML file.

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
        made = Path(folder) / "page.pdf"
        flags = (
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-pdf-header-footer",
            f"--user-data-dir={folder}/profile",
        )
        command = [browser, *flags, f"--print-to-pdf={made}", Path(page).resolve().as_uri()]
        try:
            subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS, check=False)  # noqa: S603
        except subprocess.TimeoutExpired:
            raise OSError(errno.ETIMEDOUT, f"{Path(browser).name} did not print within {SECONDS} s") from None
        if not made.is_file():
            raise OSError(errno.EIO, f"{Path(browser).name} printed nothing")
        shutil.move(made, pdf)
