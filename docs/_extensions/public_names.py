"""The reference of the Python interface, made of the table of public names (``ridgeback.public``).

``{public-names}`` lists all groups with one line for each name; with a group's name it documents that group in full.
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from itertools import groupby
from typing import Any

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from ridgeback.public import PUBLIC, Public, home


def grouped() -> dict[str, tuple[Public, ...]]:
    """The public names by group, in the order of the table."""
    return {group: tuple(entries) for group, entries in groupby(PUBLIC, key=lambda entry: entry.group)}


def page_of(group: str) -> str:
    """The page of a group, beside the one that lists them.

    >>> page_of("Derive exactly")
    'derive-exactly'
    """
    return group.lower().replace(" ", "-")


def summary() -> Iterable[str]:
    """Every group as a list with links."""
    for group, entries in grouped().items():
        yield f"**[{group}](python/{page_of(group)}.md)**"
        yield ""
        yield from (f"* {{py:obj}}`{entry.name} <ridgeback.{entry.name}>`: {entry.about}" for entry in entries)
        yield ""


def documented(group: str) -> Iterable[str]:
    """The documentation of each name of a group."""
    for entry in grouped()[group]:
        yield "```{eval-rst}"
        yield f".. auto{kind(entry)}:: ridgeback.{entry.name}"
        if kind(entry) == "class":
            yield "   :members:"
        yield "```"
        yield ""


def kind(entry: Public) -> str:
    """What a public name is, as autodoc calls it."""
    module, attribute = home(entry)
    value = getattr(import_module(module), attribute)
    if isinstance(value, type):
        return "exception" if issubclass(value, Exception) else "class"
    return "function"


class PublicNames(SphinxDirective):
    """``{public-names} GROUP``."""

    optional_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Parse the text made of the table as if it stood on the page."""
        lines = documented(self.arguments[0]) if self.arguments else summary()
        holder = nodes.container()
        self.state.nested_parse(StringList(list(lines), source="public names"), self.content_offset, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("public-names", PublicNames)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
