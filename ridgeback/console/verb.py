"""A verb of the command line: whatever its options, it never writes over a file that it reads."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from ridgeback.console.output import OutputPath, keep_apart


class Verb(click.Command):
    """A command whose outputs are held against every other file named on its command line before it starts."""

    def invoke(self, ctx: click.Context) -> Any:
        """Refuse an output over an input, through whatever link or spelling, then run."""
        values = {self.spelled(name): value for name, value in ctx.params.items()}
        written = {option: value for option, value in values.items() if isinstance(value, OutputPath)}
        keep_apart(written, [text for value in values.values() for text in named_files(value)])
        return super().invoke(ctx)

    def spelled(self, name: str) -> str:
        """The option by which a value was given, as the user writes it."""
        found = next((p for p in self.params if p.name == name), None)
        return found.opts[0] if found is not None else name


def named_files(value: Any) -> Iterator[str]:
    """The existing files that a value names; what is written is not among them.

    >>> list(named_files(("no such file", 3)))
    []
    """
    if isinstance(value, tuple | list):
        for item in value:
            yield from named_files(item)
    elif isinstance(value, str) and not isinstance(value, OutputPath) and is_file(value):
        yield value


def is_file(text: str) -> bool:
    """Whether the text names a regular file; False for what cannot name one."""
    try:
        return Path(text).is_file()
    except (OSError, ValueError):
        return False
