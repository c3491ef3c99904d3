"""Residues modulo many primes as they are gathered, and the file that keeps them: exact, proved whole by a digest.

A text file of one JSON value per line, like a checkpoint of balls: what is being computed, the residues kept back, the
residues of all coefficients modulo the product of the primes used so far.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import reading_signed, write_signed
from ridgeback.symbolic.high_order.checkpoint import check_identity

FORMAT: Final = "ridgeback residues of primes"
VERSION: Final = 1


@dataclass(frozen=True)
class Residues:
    """The coefficients of omega0, and of a limit cycle's amplitude, modulo one prime, in units with k = 1."""

    prime: int
    frequency: tuple[int, ...]
    amplitude: tuple[int, ...]

    @property
    def all(self) -> tuple[int, ...]:
        """Both, one after the other."""
        return self.frequency + self.amplitude


@dataclass(frozen=True)
class Gathered:
    """What has been found: residues kept back to test, and those of every coefficient modulo ``modulus``."""

    kept: tuple[Residues, ...]
    used: int = 0
    """How many primes are in the modulus."""
    modulus: int = 1
    values: tuple[int, ...] = ()

    def with_residues(self, found: Residues) -> Gathered:
        """One step of the Chinese remainder theorem for all coefficients.

        >>> one = Gathered(()).with_residues(Residues(5, (3,), ())).with_residues(Residues(7, (2,), ()))
        >>> one.modulus, one.values
        (35, (23,))
        """
        values = self.values or (0,) * len(found.all)
        inverse = pow(self.modulus, -1, found.prime)
        new = (v + self.modulus * ((r - v) * inverse % found.prime) for v, r in zip(values, found.all, strict=True))
        return Gathered(self.kept, self.used + 1, self.modulus * found.prime, tuple(new))


def write(path: Path, identity: Mapping[str, str], state: Gathered) -> None:
    """Write the state whole or not at all.  Raises OSError."""
    write_signed(path, _lines(identity, state))


def _lines(identity: Mapping[str, str], state: Gathered) -> Iterator[str]:
    head = {"format": FORMAT, "version": VERSION, "identity": dict(identity), "used": state.used}
    yield json.dumps({**head, "modulus": f"{state.modulus:x}", "values": len(state.values)}) + "\n"
    yield json.dumps([[k.prime, k.frequency, k.amplitude] for k in state.kept]) + "\n"
    yield from (json.dumps(f"{value:x}") + "\n" for value in state.values)


def read(path: Path, identity: Mapping[str, str]) -> Gathered:
    """Read the state of the computation ``identity``; raises InputError and OSError as ``checkpoint.read``."""
    with reading_signed(path, FORMAT, VERSION) as (head, lines):
        check_identity(path, head["identity"], identity)
        kept = tuple(Residues(p, tuple(f), tuple(a)) for p, f, a in next(lines))
        values = tuple(int(next(lines), 16) for _ in range(head["values"]))
        return Gathered(kept, int(head["used"]), int(head["modulus"], 16), values)


def check_numbers(path: Path, saved: Gathered, primes: Sequence[int], own: Residues) -> None:
    """Compare what a checkpoint claims with its own numbers, and with the residues modulo one prime, found again.

    ``primes`` are those kept back and those used, in their order.  Raises InputError.
    """
    width, checks = len(own.all), len(saved.kept)
    claims = {
        "order": len(saved.values) == width and all(len(kept.all) == width for kept in saved.kept),
        "number of primes": saved.modulus == math.prod(primes[checks:])
        and [kept.prime for kept in saved.kept] == list(primes[:checks]),
        "computation": own in saved.kept and all(0 <= value < saved.modulus for value in saved.values),
    }
    for what, true in claims.items():
        if not true:
            raise InputError(f"{path} claims another {what} than its own numbers have; remove it and start again")


def check_residues(path: Path, saved: Gathered, primes: Iterable[int], work: Callable[[int], Residues]) -> None:
    """Hold all residues of a checkpoint against those found again, modulo the ``primes`` used and those kept back.

    This costs what the checkpoint saved.  Raises InputError.
    """
    for prime in primes:
        if [value % prime for value in saved.values] != list(work(prime).all):
            raise InputError(f"{path} claims other residues modulo {prime} than are found; remove it and start again")
    for kept in saved.kept:
        if kept != work(kept.prime):
            raise InputError(f"{path} claims other residues modulo {kept.prime} than are found; start again")
