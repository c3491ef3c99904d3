"""Checkpoints of a march in balls: exact, versioned, proved whole by a digest, written whole or not at all.

A text file of one JSON value per line: what is being computed, then the tapes of the products, then the SHA-256 of all
lines before.  Balls stand as hexadecimal mantissas and decimal exponents, ``mid,exponent,radius,exponent``.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from flint import arb, arb_poly

from ridgeback.common.errors import InputError
from ridgeback.common.files import write_whole
from ridgeback.symbolic.series.spaces import Parts

FORMAT: Final = "ridgeback march in balls"
VERSION: Final = 1
_RADIUS_BITS: Final = 30


@dataclass(frozen=True)
class Tape:
    """What one product has yielded so far, and what its blocks have contributed to orders to come."""

    values: tuple[Parts, ...]
    waiting: Mapping[int, Parts]


@dataclass(frozen=True)
class Checkpoint:
    """A march between two orders: its identity, the bits it began with, and the tapes of its products."""

    identity: Mapping[str, str]
    bits: int
    order: int
    """The next order to be found."""
    tapes: tuple[Tape, ...]


def ball_text(x: arb) -> str:
    """Write a ball exactly.

    >>> ball_text(arb(1.5)), ball_text(ball_from("3,-1,20000001,-31"))
    ('3,-1,0,0', '3,-1,20000001,-31')
    """
    (mid, exponent), (radius, scale) = x.mid().man_exp(), x.rad().man_exp()
    return f"{int(mid):x},{int(exponent)},{int(radius):x},{int(scale)}"


def ball_from(text: str) -> arb:
    """Read a ball exactly.

    FLINT rounds a radius given to it up to the next of 30 bits, even when it has one; so the number given lies half a
    step lower.  Raises ValueError for anything that ``ball_text`` does not write.
    """
    mid, exponent, radius, scale = text.split(",")
    size, power = int(radius, 16), int(scale)
    if size == 0:
        return arb((int(mid, 16), int(exponent)))
    up = _RADIUS_BITS - size.bit_length()
    x = arb((int(mid, 16), int(exponent)), ((size << (up + 1)) - 1, power - up - 1))
    if up < 0 or [int(v) for v in x.rad().man_exp()] != [size, power]:
        raise ValueError(f"the radius {radius},{scale} is not one of FLINT's")
    return x


def write(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint whole or not at all.  Raises OSError."""
    write_lines(path, _lines(checkpoint))


def write_lines(path: Path, lines: Iterable[str]) -> None:
    """Write lines and their digest whole or not at all.  Raises OSError."""
    write_whole(path, _signed(lines))


def _signed(lines: Iterable[str]) -> Iterator[bytes]:
    digest = hashlib.sha256()
    for line in lines:
        data = line.encode("ascii")
        digest.update(data)
        yield data
    yield (json.dumps({"sha256": digest.hexdigest()}) + "\n").encode("ascii")


def _lines(checkpoint: Checkpoint) -> Iterator[str]:
    head = {"format": FORMAT, "version": VERSION, "identity": dict(checkpoint.identity)}
    head |= {"bits": checkpoint.bits, "order": checkpoint.order, "products": len(checkpoint.tapes)}
    yield json.dumps(head) + "\n"
    for tape in checkpoint.tapes:
        yield json.dumps([len(tape.values), len(tape.waiting)]) + "\n"
        yield from (json.dumps(_row(parts)) + "\n" for parts in tape.values)
        yield from (json.dumps([n, _row(parts)]) + "\n" for n, parts in sorted(tape.waiting.items()))


def _row(parts: Parts) -> list[str | None]:
    return [None if p is None else " ".join(ball_text(x) for x in p.coeffs()) for p in parts]


def read(path: Path, identity: Mapping[str, str]) -> Checkpoint:
    """Read a checkpoint of the computation ``identity``.

    Raises InputError when the file is damaged, of another version, or of another computation, and OSError.
    """
    with path.open(encoding="ascii") as file:
        head = checked_head(path, file, FORMAT, VERSION, identity)
        tapes = tuple(_tape(map(json.loads, file)) for _ in range(head["products"]))
    return Checkpoint(head["identity"], head["bits"], head["order"], tapes)


def checked_head(path: Path, file: Iterator[str], form: str, version: int, identity: Mapping[str, str]) -> Any:
    """The first line of a file that is whole, of this format and version, and of this computation.

    Raises InputError for any other.
    """
    _check_digest(path)
    head = json.loads(next(file))
    if not isinstance(head, dict) or head.get("format") != form or head.get("version") != version:
        raise InputError(f"{path} is not a checkpoint of this version ({form}, version {version}); begin anew")
    for key, mine in identity.items():
        if (found := head["identity"].get(key)) != mine:
            raise InputError(f"{path} belongs to the {key} {found}, not {mine}; give another file")
    return head


def _check_digest(path: Path) -> None:
    """Raise InputError unless the last line is the digest of all lines before."""
    digest, last = hashlib.sha256(), b""
    with path.open("rb") as file:
        for line in file:
            digest.update(last)
            last = line
    if last != (json.dumps({"sha256": digest.hexdigest()}) + "\n").encode("ascii"):
        raise InputError(f"{path} is no checkpoint, or damaged: its digest does not match; remove it and begin anew")


def _tape(lines: Iterator[Any]) -> Tape:
    values, waiting = next(lines)
    rows = tuple(_parts(next(lines)) for _ in range(values))
    pairs = [next(lines) for _ in range(waiting)]
    return Tape(rows, {int(n): _parts(row) for n, row in pairs})


def _parts(row: Iterable[str | None]) -> Parts:
    a, b, c, d = (None if text is None else arb_poly([ball_from(x) for x in text.split()]) for text in row)
    return a, b, c, d
