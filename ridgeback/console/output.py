"""Output whole or not at all: a file appears when its text is complete, or stays as it was."""

from __future__ import annotations

import errno
import json
import math
import os
import re
import stat
import sys
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import click

from ridgeback.common.files import naming, write_whole
from ridgeback.common.visible import visible

STDOUT = "-"
DESCRIPTORS = {"/dev/stdin": "/dev/fd/0", "/dev/stdout": "/dev/fd/1", "/dev/stderr": "/dev/fd/2"}


class OutputPath(str):
    """A place that was named to be written to."""

    __slots__ = ()


def output_path(text: str) -> OutputPath:
    """A place to write to, refused before the work starts as the operating system would at its end.

    >>> output_path("-")
    '-'
    """
    if "\0" in text or not text:
        raise click.BadParameter("a file name cannot be empty or hold a null character; use - for the screen")
    check_writable(text)
    return OutputPath(text)


def check_writable(path: str) -> None:
    """Raise the OSError that writing ``path`` would end in: a missing folder, a directory, no permission.

    >>> check_writable("no/such/folder/out.csv")
    Traceback (most recent call last):
        ...
    FileNotFoundError: [Errno 2] No such folder: 'no/such/folder'
    """
    if path == STDOUT:
        return
    if (descriptor := open_descriptor(path)) is not None:
        os.fstat(descriptor)
        return
    if is_special(path):
        if not os.access(path, os.W_OK):
            raise PermissionError(errno.EACCES, "No permission to write", path)
        return
    target = resolved(path)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "It is a folder, not a file", path)
    folder = target.parent
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, "No such folder", str(Path(path).parent))
    if not os.access(folder, os.W_OK):
        raise PermissionError(errno.EACCES, "No permission to write", path)
    if target.is_file() and not target.stat().st_mode & 0o222:
        raise PermissionError(errno.EACCES, "The file is read-only; allow writing or name another", path)


def resolved(path: str) -> Path:
    """The file behind a name; links that lead to each other are the OSError that opening them would be.

    >>> resolved("folder/../a.csv").name
    'a.csv'
    """
    with suppress(FileNotFoundError):
        os.stat(path)  # noqa: PTH116 - by Path.resolve a loop is another error in each version of Python
    with naming(path):  # the folder that a relative path starts from may be gone
        return Path(path).resolve()


def open_descriptor(path: str) -> int | None:
    """The open file that a name of the system stands for: what a shell's ``>(...)`` and /dev/stdout are.

    >>> open_descriptor("/dev/stdout"), open_descriptor("/dev/fd/63"), open_descriptor("out.csv")
    (1, 63, None)
    """
    found = re.fullmatch(r"/(?:dev|proc/self)/fd/(\d{1,9})", DESCRIPTORS.get(path, path), re.ASCII)
    return int(found[1]) if found else None


def is_special(path: str) -> bool:
    """Whether a name is of a device, a pipe or a socket, to be written to and never replaced."""
    try:
        mode = os.stat(path).st_mode  # noqa: PTH116 - the name itself: what lies behind a pipe's link has none
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def keep_apart(written: Mapping[str, str | None], read: Iterable[str | None] = ()) -> None:
    """Refuse two outputs in one file, and an output over a file that is read; ``written`` is by option.

    Raises click.UsageError before the work starts.  Devices and pipes lose nothing and are let through.

    >>> keep_apart({"-o": "out.svg", "--plot": "./out.svg"})
    Traceback (most recent call last):
        ...
    click.exceptions.UsageError: --plot './out.svg' is the file of -o too; give each a name of its own
    """
    taken = [(path, "a file that is read") for path in read if path is not None]
    for option, path in written.items():
        if path is None or path == STDOUT:
            continue
        if open_descriptor(path) is not None or is_special(path):
            continue
        for other, what in taken:
            if same_file(path, other):
                raise click.UsageError(f"{option} '{path}' is {what} too; give each a name of its own")
        taken.append((path, f"the file of {option}"))


def same_file(one: str, other: str) -> bool:
    """Whether two names are of one file, through symbolic links, hard links and other spellings.

    >>> same_file("a.csv", "./a.csv"), same_file("a.csv", "b.csv")
    (True, False)
    """
    try:
        return resolved(one) == resolved(other) or Path(one).samefile(other)
    except OSError:
        return False


def write_text(path: str, text: str) -> None:
    """Write the whole text, or leave what was there; ``-`` prints it, devices and pipes are written to.

    Characters of names that would act on a terminal or a page are written as their escapes.
    """
    if path == STDOUT:
        print_text(text)
    else:
        write_bytes(path, visible(text).encode("utf-8", "backslashreplace"))


def write_parts(path: str, parts: Iterable[str]) -> None:
    """Write a text that comes piece by piece and is never held whole: the whole of it, or leave what was there."""
    if path == STDOUT or open_descriptor(path) is not None or is_special(path):
        for part in parts:
            write_text(path, part)
    else:
        check_writable(path)
        write_whole(Path(path), (visible(part).encode("utf-8", "backslashreplace") for part in parts))


def write_bytes(path: str, data: bytes) -> None:
    """Write the whole content, or leave what was there; devices and pipes are written to."""
    check_writable(path)
    descriptor = open_descriptor(path)
    if descriptor is None and not is_special(path):
        write_whole(Path(path), [data])
        return
    if descriptor is not None:
        sys.stdout.flush()  # what was printed before comes before
    place = path if descriptor is None else os.dup(descriptor)
    with naming(path), open(place, "wb") as stream:  # noqa: PTH123 - or a descriptor
        stream.write(data)


def print_text(text: str) -> None:
    """Print the whole text: an unbuffered standard output may take a part of it and say so only by a number."""
    text = visible(text)
    if sys.stdout is None:
        raise OSError(errno.EBADF, "standard output is closed; open it, or name a file with -o")
    binary = getattr(sys.stdout, "buffer", None)
    if binary is None:
        sys.stdout.write(text)
        return
    sys.stdout.flush()
    rest = memoryview(text.encode(sys.stdout.encoding or "utf-8", "backslashreplace"))
    while rest:
        rest = rest[binary.write(rest) :]
    binary.flush()


def plain(value: Any) -> Any:
    """The value as JSON knows it: arrays and tuples to lists, non-finite numbers to null, exact ones to text.

    >>> plain({"omega": (1.5, float("nan")), "order": 3})
    {'omega': [1.5, None], 'order': 3}
    """
    match value:
        case None | bool() | str():
            return value
        case Mapping():
            return {str(key): plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    match value:
        case int():
            return int(value)
        case float():
            return float(value) if math.isfinite(value) else None
        case Sequence() | set() | frozenset():
            return [plain(item) for item in value]
    return str(value)


def json_text(value: Any) -> str:
    """JSON with a line end; what is not a finite number is null, never NaN.

    >>> print(json_text({"rows": [{"omega": float("inf")}]}), end="")
    {
      "rows": [
        {
          "omega": null
        }
      ]
    }
    """
    return json.dumps(plain(value), indent=2, allow_nan=False) + "\n"
