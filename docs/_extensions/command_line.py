"""The reference of the command line, made of click's commands: ``{command-line}`` is a section for each verb."""

from __future__ import annotations

import re
from collections.abc import Iterator
from inspect import cleandoc
from typing import Any, cast

import click
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from ridgeback.cli import VERBS, cli


def section(verb: str) -> nodes.section:
    """A verb with its usage, what it says of itself, and its options."""
    context = click.Context(cli, info_name="ridgeback")
    command = cast(click.Command, cli.get_command(context, verb))
    own = click.Context(command, info_name=verb, parent=context)
    found = nodes.section("", nodes.title(text=verb), ids=[f"verb-{verb}"], names=[f"verb-{verb}"])
    found += nodes.literal_block(
        text=" ".join(["ridgeback", verb, *command.collect_usage_pieces(own)]), language="text"
    )
    found += [*paragraphs(cleandoc(command.help or ""))]
    found += options(command, own)
    return found


def paragraphs(text: str) -> Iterator[nodes.Node]:
    """A help text: what click keeps in its lines stays in its lines."""
    for block in re.split(r"\n\s*\n", text):
        if block.startswith("\b"):
            yield nodes.literal_block(text=block.removeprefix("\b").strip("\n"), language="text")
        elif block.strip():
            yield nodes.paragraph("", *spans(" ".join(block.split())))


def spans(text: str) -> Iterator[nodes.Node]:
    """A sentence with the options in it set as code."""
    for part in re.split(r"(--[a-z][a-z-]*)", text):
        if part:
            yield nodes.literal(text=part) if part.startswith("--") else nodes.Text(part)


def options(command: click.Command, context: click.Context) -> nodes.definition_list:
    """Each option with its values and its meaning, in the order of ``--help``."""
    records = [record for parameter in command.get_params(context) if (record := parameter.get_help_record(context))]
    found = nodes.definition_list(classes=["options"])
    for name, meaning in (record for record in records if record[1]):
        item = nodes.definition_list_item("", nodes.term("", "", nodes.literal(text=name)))
        item += nodes.definition("", nodes.paragraph("", *spans(meaning)))
        found += item
    return found


class CommandLine(SphinxDirective):
    """``{command-line}``."""

    def run(self) -> list[nodes.Node]:
        """One section for each verb, in the order of ``ridgeback --help``."""
        found = [section(verb) for verb in VERBS]
        for one in found:
            self.state.document.note_explicit_target(one)
        return [*found]


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
