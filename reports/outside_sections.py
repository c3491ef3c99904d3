"""Sections that other distributions add to a report by entry points of the group ``ridgeback.sections``.

An entry point names a function of a ``Report`` that returns a ``Section``, or None where the report has nothing for it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib.metadata import EntryPoint

from ridgeback.common.errors import InputError
from ridgeback.common.plugins import guarded, plugins, told
from ridgeback.compare.report.results import Report
from ridgeback.reports.parts import Part, Section

GROUP = "ridgeback.sections"


def outside_sections(report: Report) -> Iterator[Section]:
    """The sections of other distributions, by name; a fault is said where the section would stand."""
    for point in plugins(GROUP).values():
        try:
            found = _made(point, report)
        except InputError as fault:
            found = Section("", point.name, point.name, (Part("text", f"Not made: {fault}."),))
        if found is not None:
            yield Section(key_of(point.name), found.name, found.title, found.parts)


def _made(point: EntryPoint, report: Report) -> Section | None:
    function = guarded(point, point.load)
    if not callable(function):
        raise InputError(f"{told(point)} is a {type(function).__name__}, not a function of a Report")
    found = guarded(point, function, report)
    if found is not None and not isinstance(found, Section):
        raise InputError(f"{told(point)} returned a {type(found).__name__}, not a Section")
    return found


def key_of(name: str) -> str:
    """The place of a section on the page, which no other has.

    >>> key_of("My section")
    'plugin-my-section'
    """
    return f"plugin-{re.sub('[^a-z0-9]+', '-', name.lower()).strip('-')}"
