"""The pages that are opened: each is made and looked at once, when it is first asked for."""

from __future__ import annotations

import pytest

from tests.pages.look import Look, Seen, everything, make
from tests.reports.chromium import Browser
from tests.reports.conftest import browser

__all__ = ["browser", "look"]


@pytest.fixture(scope="session")
def look(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Look:
    """What is seen of the page of a kind."""
    folder, seen = tmp_path_factory.mktemp("real"), dict[str, Seen]()

    def of(kind: str) -> Seen:
        if kind not in seen:
            seen[kind] = everything(browser, make(kind, folder))
        return seen[kind]

    return of
