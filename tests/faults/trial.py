"""One case run and judged: exit code, words, one line, processor time, and that nothing was lost or left over."""

from __future__ import annotations

import hashlib
import io
import os
import resource
import shlex
import signal
import subprocess
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CPU_SECONDS = 2.0
"""What a refusal may cost, children included; the imports of the first case are paid before."""
HANG_SECONDS = 60
FAULT = 70


@dataclass(frozen=True)
class Case:
    """What is typed, and what must come of it."""

    command: str
    """Arguments of ``ridgeback``, or with ``by_bash`` a line for bash in which ``$R`` is the command."""
    code: int
    words: tuple[str, ...] = ()
    """What standard error must hold; with code 0, either stream."""
    makes: tuple[str, ...] = ()
    """Files that it may write."""
    by_bash: bool = False
    environment: Mapping[str, str | None] = field(default_factory=dict)
    """Variables of the shell; None takes one away."""


@dataclass(frozen=True)
class Outcome:
    """What came of a case."""

    code: int
    out: str
    err: str
    cpu: float
    changed: tuple[str, ...]
    """Paths of the folder that are new, gone or different."""


def refused(command: str, *words: str) -> Case:
    """Bad input: exit code 2."""
    return Case(command, 2, words)


def unusable(command: str, *words: str) -> Case:
    """A file, a disk, a missing library: exit code 4."""
    return Case(command, 4, words)


def done(command: str, *words: str, makes: tuple[str, ...] = ()) -> Case:
    """Strange, but served."""
    return Case(command, 0, words, makes)


def tried(case: Case, folder: Path) -> Outcome:
    """Run a case in a folder."""
    before, cpu = snapshot(folder), spent()
    code, out, err = in_a_shell(case, folder) if case.by_bash else in_process(case, folder)
    return Outcome(code, out, err, spent() - cpu, changes(before, snapshot(folder)))


def faults(case: Case, outcome: Outcome) -> tuple[str, ...]:
    """What is wrong with an outcome; nothing for a case that was handled well."""
    said = outcome.err if case.code else outcome.err + outcome.out
    found = {
        f"exit code {outcome.code}, not {case.code}": outcome.code != case.code,
        "exit code 70: called a fault of the program": outcome.code == FAULT,
        "a traceback": "Traceback" in outcome.err,
        "more than one line on standard error": case.code != 0 and outcome.err.count("\n") != 1,
        "something on standard output": case.code in (2, 4) and outcome.out != "" and not case.by_bash,
        "a control character on the screen": bool(controls(outcome.out + outcome.err)),
        f"{outcome.cpu:.1f} s of processor time": outcome.cpu > CPU_SECONDS and not case.by_bash,
        f"changed {', '.join(outcome.changed)}": not set(outcome.changed) <= set(case.makes),
        f"no {', '.join(w for w in case.words if w not in said)} in: {said[:300]!r}": not all(
            word in said for word in case.words
        ),
    }
    return tuple(text for text, wrong in found.items() if wrong)


def controls(text: str) -> set[str]:
    """Characters that would change a terminal's state or the order of what it shows."""
    bidi = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u200e\u200f"
    return {c for c in text if (ord(c) < 32 and c not in "\n\t\r") or 127 <= ord(c) < 160 or c in bidi}


def in_process(case: Case, folder: Path) -> tuple[int, str, str]:
    """Call the command line here: a hang is ended by an alarm, the environment is put back."""
    from ridgeback.cli import main

    out, err = Stream(), Stream()
    variables = dict(os.environ)
    with chdir(folder), warnings.catch_warnings(), limited(), redirect_stdout(out), redirect_stderr(err):
        warnings.simplefilter("error")
        try:
            code = main(shlex.split(case.command))
        finally:
            for name in set(os.environ) - set(variables):
                del os.environ[name]
            os.environ.update(variables)
    return code, out.text(), err.text()


class Stream(io.TextIOWrapper):
    """Standard output or error, kept."""

    def __init__(self) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8", write_through=True)

    def text(self) -> str:
        """What was written."""
        self.flush()
        return self.buffer.getvalue().decode("utf-8", "replace")  # type: ignore[attr-defined,no-any-return]


@contextmanager
def limited() -> Iterator[None]:
    """Raise TimeoutError in whatever has not come to an end after a minute."""

    def hang(*_: object) -> None:
        raise TimeoutError(f"no end after {HANG_SECONDS} s")

    before = signal.signal(signal.SIGALRM, hang)
    signal.alarm(HANG_SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def in_a_shell(case: Case, folder: Path) -> tuple[int, str, str]:
    """Run a line of bash in a process group of its own, in the case's environment."""
    environment = {**os.environ, "R": f"{sys.executable} -m ridgeback", "PYTHON": sys.executable, "TREE": str(ROOT)}
    environment |= {"PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "ignore"}
    environment.pop("RIDGEBACK_DEBUG", None)
    for name, value in case.environment.items():
        environment.pop(name, None)
        if value is not None:
            environment[name] = value
    done = subprocess.run(
        ["bash", "-o", "pipefail", "-c", case.command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=2 * HANG_SECONDS,
        check=False,
    )
    return done.returncode, done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")


def spent() -> float:
    """Processor seconds of this process and of its ended children."""
    mine, children = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return mine.ru_utime + mine.ru_stime + children.ru_utime + children.ru_stime


def snapshot(folder: Path) -> dict[str, str]:
    """Every path below a folder with what it is: mode, target of a link, digest of a file."""
    return {str(path.relative_to(folder)): description(path) for path in sorted(folder.rglob("*"))}


def description(path: Path) -> str:
    """What would be lost if the path changed."""
    if path.is_symlink():
        return f"link to {path.readlink()}"
    mode = oct(path.stat().st_mode)
    return f"{mode} {hashlib.sha256(path.read_bytes()).hexdigest()}" if path.is_file() else mode


def changes(before: Mapping[str, str], after: Mapping[str, str]) -> tuple[str, ...]:
    """Paths that are not as they were."""
    return tuple(sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name)))
