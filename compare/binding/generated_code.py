"""Run generated code: build the package of any language with the tools of this machine, and compare it with its table.

What is built and loaded here was written by ``symbolic.codegen`` from exact numbers a moment before; no text of a user
reaches it but through a whitelist of characters, and the files have names of our own.
"""

from __future__ import annotations

import errno
import importlib.util
import shutil
import sys
import tempfile
from dataclasses import dataclass, replace
from importlib.abc import InspectLoader
from pathlib import Path
from types import ModuleType
from typing import Literal

from ridgeback.compare.binding.programs import Finished, finished
from ridgeback.symbolic.codegen import Formula, form_of
from ridgeback.symbolic.codegen.languages.python import language as python
from ridgeback.symbolic.codegen.languages.registry import find_language
from ridgeback.symbolic.codegen.program import Form

SECONDS = 120
"""A build or a check that takes longer is given up."""
OWN = "generated"
"""Everything that is built here has this name, whatever the user's is."""


@dataclass(frozen=True)
class Checked:
    """What came of a self-test: ``skipped`` where the machine lacks the tool, and why."""

    language: str
    state: Literal["passed", "failed", "skipped"]
    detail: str

    def __str__(self) -> str:
        return f"{self.language}: {self.state} ({self.detail})"


def check(form: Form, language: str) -> Checked:
    """Build the package of a form in a temporary folder and run its self-test.

    Parameters
    ----------
    form
        What was generated; see ``ridgeback.symbolic.codegen.form_of``.
    language
        The target language.

    Returns
    -------
    Checked
        ``passed`` when every entry of the table came out bit for bit.

    Raises
    ------
    OSError
        Where the machine, and not the code, stands in the way: nothing can be run from the temporary folder, or a
        program hangs.

    Examples
    --------
    >>> from ridgeback.symbolic.codegen import form_of
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> str(check(form_of(lindstedt(find("pendulum"), 4)), "python"))
    'python: passed (every entry of the table bit for bit)'
    """
    target, own = find_language(language), replace(form, name=OWN)
    target.accept(form)
    tool = tool_of(language)
    if tool is None:
        missing = " or ".join(target.tool) or "nothing"
        return Checked(
            language, "skipped", f"{missing} runs it, and is not on this machine" if target.tool else "no code"
        )
    with tempfile.TemporaryDirectory(prefix="ridgeback-") as folder:
        write_files(Path(folder), target.package(own))
        for command in target.commands(own, tool):
            done = _run(command, Path(folder))
            if done.code != 0:
                return Checked(language, "failed", f"{Path(command[0]).name}: {done.last_line}")
    return Checked(language, "passed", "every entry of the table bit for bit")


def tool_of(language: str) -> str | None:
    """The program of this machine that runs a language's check, or None; Python's is the one that runs now."""
    target = find_language(language)
    if "python3" in target.tool:
        return sys.executable if language != "numba" or importlib.util.find_spec("numba") else None
    return next((path for name in target.tool if (path := shutil.which(name))), None)


def write_files(folder: Path, files: dict[str, str]) -> None:
    """Write the files of a package under a folder."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def _run(command: tuple[str, ...], folder: Path) -> Finished:
    program = str(folder / command[0]) if command[0].startswith("./") else command[0]
    try:
        done = finished([program, *command[1:]], SECONDS, folder=folder)
    except PermissionError:
        reason = "Nothing can be run from this temporary folder (mounted noexec?); name another in TMPDIR"
        raise PermissionError(errno.EACCES, reason, str(folder)) from None
    if done is None:
        raise TimeoutError(errno.ETIMEDOUT, f"It came to no end within {SECONDS} s", program)
    return done


class _Generated(InspectLoader):
    """The generated Python as a module's source, without a file."""

    def __init__(self, text: str) -> None:
        self.text = text

    def get_source(self, fullname: str) -> str:  # noqa: ARG002
        """The text, whatever the module is called."""
        return self.text


def omega0_of(formula: Formula) -> Form:
    """The code of omega0 alone, without its slope and its motion."""
    return form_of(formula, alone="omega0")


def python_module(formula: Formula) -> ModuleType:
    """The generated Python of omega0 as a module.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> python_module(lindstedt(find("duffing"), 2)).omega0(0.0)
    1.0
    """
    return as_module(omega0_of(formula))


def as_module(form: Form) -> ModuleType:
    """A form's Python as a module, without its self-test."""
    module = ModuleType("ridgeback_generated")
    _Generated(python.untested(form)).exec_module(module)
    return module
