"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ridgeback.common.errors import InputError

try:
    import fcntl
except ImportError:  # where there are no such locks, what a dead process left behind cannot be told from work going on
    fcntl = None  # type: ignore[assignment]

SUFFIX = ".part"


def write_whole(target: Path, parts: Iterable[bytes]) -> None:
    """Write beside the target, flush to the disk, then put the finished file in its place in one step.

    ``target`` is replaced with its mode kept; through a symbolic link the file behind it is replaced and the link
    stays.  What writers that were killed left beside it is removed.  Raises OSError, after which the target is as it
    was and nothing is left beside it.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_whole(Path(folder) / "a.txt", [b"one ", b"two"])
    ...     (Path(folder) / "a.txt").read_text(), len(list(Path(folder).iterdir()))
    ('one two', 1)
    """
    with naming(target):
        target = target.resolve()
        clear_abandoned(target)
        mode = target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~current_umask()
        with locked_beside(target) as (descriptor, temporary):
            with os.fdopen(os.dup(descriptor), "wb") as file:
                file.writelines(parts)
                file.flush()
                os.fsync(file.fileno())
            temporary.chmod(mode)
            temporary.replace(target)
            settle(target.parent)


@contextmanager
def naming(path: str | Path) -> Iterator[None]:
    """Give an OSError of the block this file's name where it has none, or that of an unfinished file.

    >>> with naming("run.csv"):
    ...     raise OSError(28, "No space left on device")
    Traceback (most recent call last):
        ...
    OSError: [Errno 28] No space left on device: 'run.csv'
    """
    try:
        yield
    except OSError as error:
        if error.errno is not None and (error.filename is None or str(error.filename).endswith(SUFFIX)):
            error.filename = str(path)
        raise


@contextmanager
def locked_beside(target: Path) -> Iterator[tuple[int, Path]]:
    """A new file beside the target, held by a lock as long as its writer lives; removed when the block fails."""
    while True:
        descriptor, name = tempfile.mkstemp(dir=target.parent, prefix=prefix_of(target), suffix=SUFFIX)
        held(descriptor, wait=True)
        if os.fstat(descriptor).st_nlink:  # else another writer took it for abandoned before it was locked
            break
        os.close(descriptor)
    temporary = Path(name)
    try:
        yield descriptor, temporary
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    finally:
        os.close(descriptor)


def clear_abandoned(target: Path) -> None:
    """Remove the unfinished files of this target whose writers are dead: those that nobody holds locked."""
    with suppress(OSError):
        for entry in os.scandir(target.parent):
            if entry.name.startswith(prefix_of(target)) and entry.name.endswith(SUFFIX):
                remove_unheld(Path(entry.path))


def remove_unheld(path: Path) -> None:
    """Remove a file unless its writer holds it."""
    with suppress(OSError):
        descriptor = os.open(path, os.O_RDWR | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
        try:
            if held(descriptor, wait=False):
                path.unlink(missing_ok=True)
        finally:
            os.close(descriptor)


def held(descriptor: int, *, wait: bool) -> bool:
    """Take the lock of an open file; False where another holds it or there are no locks."""
    if fcntl is None:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        return False
    return True


def prefix_of(target: Path) -> str:
    """How the names of unfinished files of a target begin.

    >>> prefix_of(Path("run/out.csv"))
    '.out.csv.'
    """
    return f".{target.name[:40]}."


def settle(folder: Path) -> None:
    """Flush a folder to the disk, so that a new name in it outlasts a power cut; some systems cannot."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def read_regular(path: Path, at_most: int, remedy: str) -> bytes:
    """The bytes of a file on a disk; never those of a pipe or a device, which may have no end.

    Parameters
    ----------
    path : Path
        The file, or a link to it.
    at_most : int
        Bytes that it may have.
    remedy : str
        What to do about a larger one.

    Raises
    ------
    InputError
        For what is no file on a disk, at once, and for a larger one.
    OSError
        For a file that is not there or cannot be read.

    Examples
    --------
    >>> read_regular(Path(os.devnull), 100, "shorten it")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: /dev/null is a device, not a file; store what it gives in a file first
    """
    check_regular(path)
    size = path.stat().st_size
    with path.open("rb") as file:
        data = file.read(at_most + 1)
    if len(data) > at_most:
        raise InputError(f"{path.name} has {max(size, len(data)) / 1e6:.3g} MB, over {at_most / 1e6:.3g} MB; {remedy}")
    return data


def check_regular(path: Path) -> None:
    """Raise InputError for a pipe, a device or a socket; a folder is left to the operating system to refuse."""
    mode = path.stat().st_mode
    if stat.S_ISREG(mode) or stat.S_ISDIR(mode):
        return
    kind = "a pipe" if stat.S_ISFIFO(mode) else "a socket" if stat.S_ISSOCK(mode) else "a device"
    raise InputError(f"{path} is {kind}, not a file; store what it gives in a file first")


def remove_through(path: Path) -> None:
    """Remove a file; of a symbolic link the file behind it, so that the link serves the next one."""
    path.resolve().unlink(missing_ok=True)


def current_umask() -> int:
    """The process's umask, which can only be read by setting it."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
