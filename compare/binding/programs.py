"""Run a compiler, an interpreter or what was built with them, for a limited time, and end all that it started."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from subprocess import DEVNULL, STDOUT, Popen, TimeoutExpired
from tempfile import TemporaryFile


@dataclass(frozen=True)
class Finished:
    """A program that came to its end: its exit code, and all that it said."""

    code: int
    said: str

    @property
    def last_line(self) -> str:
        """The last line that is not empty, where the reason stands as a rule."""
        lines = [line for line in self.said.splitlines() if line.strip()]
        return (lines[-1] if lines else f"exit code {self.code}").strip()[:200]


# What a program says goes to a file: a pipe stays open for as long as anything that it started lives.
def finished(command: Sequence[str], seconds: float, *, folder: Path | None = None) -> Finished | None:
    r"""Run a program; None when it hangs, after which it and what it started are ended.

    Parameters
    ----------
    command
        The program's path and its arguments.
    seconds
        How long it may take.
    folder
        Where it runs; here by default.

    Returns
    -------
    Finished or None

    Raises
    ------
    OSError
        Where it cannot be run at all.

    Examples
    --------
    >>> import sys
    >>> finished([sys.executable, "-c", "print(7)"], 60.0)
    Finished(code=0, said='7\n')
    """
    with (
        TemporaryFile() as said,
        Popen(command, cwd=folder, stdin=DEVNULL, stdout=said, stderr=STDOUT, start_new_session=True) as process,  # noqa: S603 - our own arguments
    ):
        try:
            code = process.wait(seconds)
        except TimeoutExpired:
            return None
        finally:
            if process.returncode is None:
                end_group(process)
        said.seek(0)
        return Finished(code, said.read().decode("utf-8", "replace"))


def end_group(process: Popen[bytes]) -> None:
    """End a process and all that it started."""
    with suppress(ProcessLookupError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
