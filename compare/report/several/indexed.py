"""One report as an index lists it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Page:
    """A page in a folder: where it is, what it found, what it is about."""

    link: str
    """Relative path with forward slashes."""
    title: str
    kind: str
    lead: str
    subject: str
    size: int
    """Bytes."""
