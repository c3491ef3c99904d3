"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path


def write_whole(target: Path, parts: Iterable[bytes]) -> None:
    """Write beside the target, flush to the disk, then put the finished file in its place in one step.

    ``target`` is replaced with its mode kept; through a symbolic link the file behind it is replaced and the link
    stays.  Raises OSError, after which the target is as it was and nothing is left beside it.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_whole(Path(folder) / "a.txt", [b"one ", b"two"])
    ...     (Path(folder) / "a.txt").read_text(), len(list(Path(folder).iterdir()))
    ('one two', 1)
    """
    target = target.resolve()
    mode = target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~current_umask()
    descriptor, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:40]}.", suffix=".part")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.writelines(parts)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).chmod(mode)
        Path(temporary).replace(target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def current_umask() -> int:
    """The process's umask, which can only be read by setting it."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
