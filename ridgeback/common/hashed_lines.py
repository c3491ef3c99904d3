"""Text files that prove themselves whole: one JSON value per line, the last the SHA-256 of all lines before."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.files import check_regular, write_whole


def write_signed(path: Path, lines: Iterable[str]) -> None:
    """Write lines of ASCII and their digest, whole or not at all.  Raises OSError."""
    write_whole(path, _signed(lines))


def _signed(lines: Iterable[str]) -> Iterator[bytes]:
    digest = hashlib.sha256()
    for line in lines:
        data = line.encode("ascii")
        digest.update(data)
        yield data
    yield (json.dumps({"sha256": digest.hexdigest()}) + "\n").encode("ascii")


@contextmanager
def reading_signed(path: Path, form: str, version: int) -> Iterator[tuple[Mapping[str, Any], Iterator[Any]]]:
    """The head of a file of this format and version, and the values of its other lines.

    Raises InputError for a file that is damaged, of another format, or read wrongly in the block; OSError.
    """
    check_whole(path)
    try:
        with path.open(encoding="ascii") as file:
            head = json.loads(next(file))
            if not isinstance(head, dict) or head.get("format") != form or head.get("version") != version:
                raise InputError(f"{path} is not a checkpoint of this version ({form}, version {version}); start again")
            yield head, map(json.loads, file)
    except InputError:
        raise
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RuntimeError) as error:
        # a generator's StopIteration arrives as RuntimeError
        raise InputError(f"{path} is not a checkpoint that was written here ({error}); start again") from None


def check_whole(path: Path) -> None:
    """Raise InputError unless the last line is the digest of all lines before."""
    check_regular(path)
    digest, last = hashlib.sha256(), b""
    with path.open("rb") as file:
        for line in file:
            digest.update(last)
            last = line
    if last != (json.dumps({"sha256": digest.hexdigest()}) + "\n").encode("ascii"):
        raise InputError(
            f"{path} is not a checkpoint, or damaged: its digest does not match; remove it and start again"
        )
