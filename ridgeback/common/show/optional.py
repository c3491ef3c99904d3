"""Libraries that are used where they are installed, and named where they are not."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class MissingLibraryError(ImportError):
    """A library that is not installed; the message says what needs it and how to get it."""


def optional(library: str, what: str) -> Any:
    """Import a library that not everybody has.

    >>> optional("nowhere", "a table")
    Traceback (most recent call last):
        ...
    ridgeback.common.show.optional.MissingLibraryError: a table needs nowhere; install it: pip install nowhere
    """
    try:
        return import_module(library)
    except ImportError:
        raise MissingLibraryError(f"{what} needs {library}; install it: pip install {library}") from None
