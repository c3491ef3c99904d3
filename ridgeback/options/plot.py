"""``--plot FILE``: a picture beside the numbers, its form told by the file's ending."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

from ridgeback.console.output import OutputPath, output_path
from ridgeback.options.arguments import shown

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

KINDS = ("svg", "png", "pdf")


def picture_path(text: str) -> OutputPath:
    """A place to draw to, with one of the endings that can be drawn.

    >>> picture_path("decay.svg")
    'decay.svg'
    """
    if text.rpartition(".")[2].lower() not in KINDS or "." not in text:
        raise click.BadParameter(f"{shown(text)} does not end in .svg, .png or .pdf; name a picture file")
    return output_path(text)


def plot_option(what: str) -> Callable[[Decorated], Decorated]:
    """``--plot FILE``; ``what`` says what is drawn."""

    def decorate(command: Decorated) -> Decorated:
        """Add the option."""
        return click.option(
            "--plot", type=picture_path, default=None, metavar="FILE.svg|png|pdf", help=f"Draw {what}."
        )(command)

    return decorate


def plane_path(text: str) -> OutputPath:
    """A place for a plane, with one of the endings that one can have.

    >>> plane_path("decay.npz")
    'decay.npz'
    """
    if not text.lower().endswith((".npz", ".png")):
        raise click.BadParameter(f"{shown(text)} does not end in .npz or .png; name a file for the plane")
    return output_path(text)
