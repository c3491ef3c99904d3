r"""Very high orders exactly: the expansion modulo many primes, put together by the Chinese remainder theorem.

Modulo one prime of 63 bits every coefficient is one machine word, however many digits the rational has.  The primes are
independent, so they run through any ``concurrent.futures.Executor``: a process pool, ``dask.distributed`` or
``mpi4py.futures`` alike.  The rationals come back by rational reconstruction (Wang 1981; von zur Gathen and Gerhard,
Modern Computer Algebra, 5.10), and are accepted when they predict every residue modulo further primes that took no
part: a wrong coefficient survives each of these with a probability below 2^-50.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial, reduce
from itertools import islice
from pathlib import Path

from flint import fmpq, fmpz, nmod

from ridgeback.common.progress import Progress, Wanted, showing
from ridgeback.symbolic.expansion.amplitude import check_amplitude
from ridgeback.symbolic.expansion.cost import Budget, check
from ridgeback.symbolic.expansion.expansion import Expansion, check_order, first_harmonic
from ridgeback.symbolic.expansion.limit_cycle import cycle_recursion
from ridgeback.symbolic.expansion.lindstedt import DIRECT, conservative_recursion
from ridgeback.symbolic.high_order.numbers_only import identity, require_numbers
from ridgeback.symbolic.high_order.residues import Gathered, Residues, check_numbers, check_residues, read, write
from ridgeback.symbolic.series.spaces import Modular, Scalar
from ridgeback.symbolic.series.trigonometric import at_zero
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

CHECKS = 2
"""Primes kept back to test the result."""
DOUBT = 2
"""How many times the expected bits of modulus may pass before a checkpoint's residues are found again."""
SAVE_EVERY = 60
"""Seconds between checkpoints, and a batch of primes at most."""


def primes() -> Iterator[int]:
    """Yield the primes below 2^63, largest first.

    >>> next(primes()) == 2**63 - 25
    True
    """
    candidate = 2**63 - 1
    while True:
        if fmpz(candidate).is_probable_prime():
            yield candidate
        candidate -= 2


def residues(oscillator: Oscillator, order: int, amplitude: str, prime: int) -> Residues:
    """Run the derivation modulo one prime.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> residues(find("duffing"), 2, "peak", 10007).frequency[2] * 8 % 10007
    3
    """
    space = Modular(prime)
    if oscillator.kind != "limit-cycle":
        recursion = conservative_recursion(oscillator, order, amplitude, space)
        return Residues(prime, tuple(_residue(c, prime) for c in recursion.omega), ())
    recursion = cycle_recursion(oscillator, order, amplitude, space)
    read = at_zero if amplitude == "peak" else first_harmonic
    return Residues(
        prime,
        tuple(_residue(c, prime) for c in recursion.omega[: order + 1]),
        tuple(_residue(read(p), prime) for p in recursion.u[: order + 1]),
    )


def _residue(value: Scalar, prime: int) -> int:
    return int(nmod(value, prime))


def lindstedt_by_primes(
    oscillator: OscillatorLike,
    order: int,
    *,
    amplitude: str = "peak",
    executor: Executor | None = None,
    workers: int = 1,
    progress: Wanted = None,
    checkpoint: Path | None = None,
    budget: Budget | None = None,
) -> Expansion:
    """Expand omega0 like ``lindstedt``, for orders whose coefficients have thousands of digits; no waveform is kept.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator, each parameter with a rational number.
    order : int
        Highest power of the amplitude, or of eps, that is kept.
    amplitude : str, optional
        ``peak`` (default) or ``fundamental``.
    executor : concurrent.futures.Executor, optional
        Runs the primes; without one they run here, one after the other.
    workers : int, optional
        Primes at a time.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share of the work that is done and the bits of the modulus so far.
    checkpoint : Path, optional
        The residues are saved there every minute, on KeyboardInterrupt and at the end, and the work goes on from there
        if the file exists; it is the caller's to remove once the result is stored.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.

    Returns
    -------
    Expansion
        Exact coefficients; a wrong one survives each of the residues kept back with a probability below 2^-50.

    Raises
    ------
    InputError
        As ``lindstedt`` does, for symbolic parameters, and for a checkpoint that is damaged, belongs to another
        computation or claims what its numbers deny.
    OSError
        For the file.

    References
    ----------
    von zur Gathen and Gerhard, Modern Computer Algebra, section 5.10.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> lindstedt_by_primes(find("van-der-pol"), 4).frequency
    (1, 0, -1/16, 0, 17/3072)
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_amplitude(oscillator, amplitude, DIRECT)
    natural = oscillator.normalised
    cycle = oscillator.kind == "limit-cycle"
    require_numbers(oscillator, "the primes need")
    check(law(oscillator), order, budget or Budget(), workers=workers)
    claim, work = identity(oscillator, order, amplitude), partial(residues, oscillator, order, amplitude)
    saved = _resumed(checkpoint, claim, work)
    with showing(progress) as told:
        gathering = _Collection(work, executor, claim, checkpoint, saved, expected_bits(oscillator, order), told)
        found = gathering.rationals(max(2, 2 * workers))
    return Expansion(
        system=oscillator.name,
        method="lindstedt",
        variable=str(oscillator.small) if cycle else "A",
        amplitude=amplitude,
        order=order,
        scale=natural.scale,
        scaled_variable=cycle,
        coefficients=tuple(found[: order + 1]),
        waveform=None,
        amplitude_coefficients=tuple(found[order + 1 :]) if cycle else None,
        residual_of=None,
    )


def expected_bits(oscillator: Oscillator, order: int) -> int:
    """About how many bits of modulus an order needs, for progress only: it grows like the square of the order.

    Measured: van der Pol 1.4 order^2 at 24 and 48; pendulum 0.25 to 0.15 at 50 and 100, Helmholtz-Duffing 0.24 at 40.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> expected_bits(find("van-der-pol"), 48)
    3226
    """
    per_mille = 1400 if oscillator.kind == "limit-cycle" else 200
    return 1 + per_mille * order**2 // 1000


def law(oscillator: Oscillator) -> str:
    """The law of ``ridgeback.symbolic.expansion.cost`` that this derivation follows, by the oscillator's kind."""
    return "primes of a limit-cycle" if oscillator.kind == "limit-cycle" else "primes"


def _resumed(path: Path | None, identity: dict[str, str], work: Callable[[int], Residues]) -> Gathered:
    """What a checkpoint holds, with the first of the residues kept back found again; nothing where there is none."""
    if path is None or not path.exists():
        return Gathered(())
    saved = read(path, identity)
    check_numbers(path, saved, list(islice(primes(), CHECKS + saved.used)), work(next(primes())))
    return saved


@dataclass
class _Collection:
    """Residues being gathered: the only thing here that changes."""

    work: Callable[[int], Residues]
    executor: Executor | None
    identity: dict[str, str]
    path: Path | None
    state: Gathered
    expected: int
    """Bits of modulus that will be needed, for progress."""
    progress: Progress
    last_save: float = field(default_factory=time.monotonic)
    resumed: Gathered = field(init=False)
    """What came from a checkpoint and was not found again."""

    def __post_init__(self) -> None:
        self.resumed = self.state

    def rationals(self, batch: int) -> list[fmpq]:
        """Gather primes until the rationals predict the residues kept back; save what there is on an interrupt."""
        source = primes()
        first = list(islice(source, CHECKS))
        try:
            if not self.state.kept:
                self.state = Gathered(tuple(self._run(first)))
            unused = islice(source, self.state.used, None)
            while (found := self._enough()) is None:
                self._doubt()
                self.state = reduce(Gathered.with_residues, self._run(islice(unused, batch)), self.state)
                self._save(every=SAVE_EVERY)
        except KeyboardInterrupt:
            self._save(every=0)
            raise
        with suppress(OSError):  # the result is there and must not be lost with its checkpoint
            self._save(every=0)
        return found

    def _doubt(self) -> None:
        """Find a checkpoint's residues again when far more primes than expected do not agree: one may be forged."""
        if self.path is None or not self.resumed.used or self.state.modulus.bit_length() < DOUBT * self.expected + 256:
            return
        used = islice(primes(), CHECKS, CHECKS + self.resumed.used)
        check_residues(self.path, self.resumed, used, self.work)
        self.resumed = Gathered(())

    def _enough(self) -> list[fmpq] | None:
        if not self.state.used:
            return None
        found = _reconstructed(self.state)
        bits = self.state.modulus.bit_length()
        self.progress(min(bits / self.expected, 99 / 100) if found is None else 1, f"{bits} bits of modulus")
        return found

    def _run(self, batch: Iterable[int]) -> list[Residues]:
        """The work on a few primes.  Not by ``Executor.map``, whose cancelling upsets a pool that is being ended."""
        if self.executor is None:
            return [self.work(prime) for prime in batch]
        return [future.result() for future in [self.executor.submit(self.work, prime) for prime in batch]]

    def _save(self, *, every: int) -> None:
        if self.path is not None and self.state.used and time.monotonic() - self.last_save >= every:
            write(self.path, self.identity, self.state)
            self.last_save = time.monotonic()


def _reconstructed(state: Gathered) -> list[fmpq] | None:
    """Return the rationals behind the residues, or None while the modulus is too small; the largest is tried first."""
    result: list[fmpq] = []
    for index in range(len(state.values) - 1, -1, -1):
        candidate = rational(state.values[index], state.modulus)
        if candidate is None or any(int(nmod(candidate, k.prime)) != k.all[index] for k in state.kept):
            return None
        result.append(candidate)
    return result[::-1]


def rational(value: int, modulus: int) -> fmpq | None:
    """Return the fraction p/q = value modulo ``modulus`` with |p|, q below sqrt(modulus / 2), if there is one.

    >>> rational(pow(3, -1, 10007) * 2 % 10007, 10007)
    2/3
    """
    bound = math.isqrt(modulus // 2)
    r0, r1, t0, t1 = modulus, value % modulus, 0, 1
    while r1 > bound:
        quotient = r0 // r1
        r0, r1, t0, t1 = r1, r0 - quotient * r1, t1, t0 - quotient * t1
    if t1 == 0 or abs(t1) > bound or math.gcd(r1, t1) != 1:
        return None
    return fmpq(r1, t1)
