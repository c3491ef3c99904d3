"""Checkpoints of a recursion in balls: exact, versioned, proved whole by a digest, written whole or not at all.

A text file of one JSON value per line: what is being computed, then the tapes of the products, then the SHA-256 of all
lines before.  Balls stand as hexadecimal mantissas and decimal exponents, ``mid,exponent,radius,exponent``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from flint import arb, arb_poly

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import reading_signed, write_signed
from ridgeback.symbolic.series.relaxed_product import waiting_orders
from ridgeback.symbolic.series.spaces import Parts

FORMAT: Final = "ridgeback recursion in balls"
VERSION: Final = 1
_RADIUS_BITS: Final = 30
SPARE: Final = 40
"""Bits that a recursion may drop before its first inexact product (``in_balls.GUARD``)."""


@dataclass(frozen=True)
class Tape:
    """What one product has yielded so far, and what its blocks have contributed to orders to come."""

    values: tuple[Parts, ...]
    waiting: Mapping[int, Parts]


@dataclass(frozen=True)
class Checkpoint:
    """A recursion between two orders: its identity, the bits it began with, and the tapes of its products."""

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
    if up < 0:
        raise ValueError(f"the radius {radius},{scale} is not one of FLINT's")
    x = arb((int(mid, 16), int(exponent)), ((size << (up + 1)) - 1, power - up - 1))
    if [int(v) for v in x.rad().man_exp()] != [size, power]:
        raise ValueError(f"the radius {radius},{scale} is not one of FLINT's")
    return x


def write(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint whole or not at all.  Raises OSError."""
    write_signed(path, _lines(checkpoint))


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
    with reading_signed(path, FORMAT, VERSION) as (head, lines):
        check_identity(path, head["identity"], identity)
        tapes = tuple(_tape(lines) for _ in range(head["products"]))
        return Checkpoint(head["identity"], int(head["bits"]), int(head["order"]), tapes)


def check_identity(path: Path, found: Mapping[str, str], mine: Mapping[str, str]) -> None:
    """Raise InputError where a checkpoint is of another computation."""
    for key, value in mine.items():
        if found.get(key) != value:
            raise InputError(f"{path} belongs to the {key} {found.get(key)}, not {value}; give another file")


def check_numbers(path: Path, saved: Checkpoint, last: int, least_bits: int) -> None:
    """Compare what a checkpoint claims with its own numbers; a file may be whole and yet not what it says.

    A recursion to the order ``last - 1`` has between one product and the next a tape of nearly as many values as
    orders, waiting blocks that are cut at ``last`` and nowhere else, at least the ``least_bits`` that its digits need,
    and inexact balls with about the bits that it began with.  Raises InputError.
    """
    claims = {
        "order": 1 <= saved.order <= last and all(_of_order(tape, saved.order, last) for tape in saved.tapes),
        "precision": saved.bits >= least_bits and _has_bits(saved),
    }
    for what, true in claims.items():
        if not true:
            raise InputError(f"{path} claims another {what} than its own numbers have; remove it and start again")


def _of_order(tape: Tape, order: int, last: int) -> bool:
    length = len(tape.values)
    return max(order - 2, 0) <= length <= order and set(tape.waiting) == set(waiting_orders(length - 1, last))


def _has_bits(saved: Checkpoint) -> bool:
    """Whether the longest mantissa fits in the bits and, where balls are inexact, nearly fills them."""
    balls = [x for tape in saved.tapes for parts in tape.values for p in parts if p is not None for x in p.coeffs()]
    longest = max((_length(x) for x in balls), default=0)
    inexact = max((_length(x) for x in balls if not x.is_exact()), default=saved.bits)
    return longest <= saved.bits < inexact + SPARE


def _length(x: arb) -> int:
    return int(x.mid().man_exp()[0]).bit_length()


def _tape(lines: Iterator[Any]) -> Tape:
    values, waiting = next(lines)
    rows = tuple(_parts(next(lines)) for _ in range(values))
    pairs = [next(lines) for _ in range(waiting)]
    return Tape(rows, {int(n): _parts(row) for n, row in pairs})


def _parts(row: Iterable[str | None]) -> Parts:
    a, b, c, d = (None if text is None else arb_poly([ball_from(x) for x in text.split()]) for text in row)
    return a, b, c, d
