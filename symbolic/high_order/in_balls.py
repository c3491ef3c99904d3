r"""Lindstedt-Poincaré expansions to very high order in ball arithmetic: every coefficient a rigorous enclosure.

The orders are those of ``lindstedt`` and ``limit_cycle``, over balls by harmonics (``harmonic_basis``), with the
products on line in blocks (``relaxed``).  The recurrences lose a fixed number of bits per order (van der Pol: 3.6),
since radii grow as if all signs conspired.  A short recursion measures it and sets the precision; if the balls come out
too wide, the recursion is repeated with what was missing.  Bits below the radii are dropped on the way.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import Final

from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Progress, Wanted, showing, silent
from ridgeback.symbolic.arithmetic.balls import number_ball
from ridgeback.symbolic.expansion.amplitude import check_amplitude
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion, log2, missing_bits
from ridgeback.symbolic.expansion.cost import Budget, balls_of, check
from ridgeback.symbolic.expansion.expansion import check_order, first_harmonic
from ridgeback.symbolic.expansion.limit_cycle import cycle_recursion
from ridgeback.symbolic.expansion.lindstedt import DIRECT, conservative_recursion
from ridgeback.symbolic.expansion.recursion import Recursion
from ridgeback.symbolic.high_order import checkpoint as file
from ridgeback.symbolic.high_order.checkpoint import Checkpoint, Tape
from ridgeback.symbolic.high_order.numbers_only import identity, require_numbers
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.relaxed_product import RelaxedProduct, Waiting
from ridgeback.symbolic.series.spaces import Parts
from ridgeback.symbolic.series.trigonometric import at_zero
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

GUARD: Final = 40
"""Bits kept below the largest radius of the last order (10 000 instead changed no radius in van der Pol's to 200)."""
STEEPNESS: Final = 3.5
"""Power of the order that the time of a recursion follows (``expansion.cost``): the share that is done goes by it."""
TRIAL_ORDER: Final = 32
"""Order of the recursion that measures the loss."""
_LOSS: Final = 8
"""Bits per order with which the trial begins."""
ATTEMPTS: Final = 4
SAVE_EVERY: Final = 60.0
"""Most seconds between checkpoints, or one order, which cannot be cut."""
MAX_DIGITS: Final = 10_000


def lindstedt_in_balls(
    oscillator: OscillatorLike,
    order: int,
    *,
    digits: int = 30,
    amplitude: str = "peak",
    checkpoint: Path | None = None,
    progress: Wanted = None,
    budget: Budget | None = None,
) -> BallExpansion:
    """Expand omega0 like ``lindstedt``, with every coefficient in a ball of at least ``digits`` certain digits.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator, each parameter with a rational number.
    order : int
        Highest power of the amplitude, or of eps, that is kept.
    digits : int, optional
        Certain decimal digits of each coefficient, 1 to 10 000.
    amplitude : str, optional
        ``peak`` (default) or ``fundamental``.
    checkpoint : Path, optional
        The state is saved there every minute, on KeyboardInterrupt and at the end, and the recursion goes on from there
        if the file exists, with the same balls bit by bit; it is the caller's to remove once the result is stored.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share of the work that is done and the order about to be found.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.

    Returns
    -------
    BallExpansion
        The coefficients as rigorous enclosures.

    Raises
    ------
    InputError
        As ``lindstedt`` does, for symbolic parameters, for a checkpoint that is damaged, belongs to another computation
        or claims what its numbers deny, and for balls that stay too wide.
    OSError
        For the file.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> lindstedt_in_balls(find("van-der-pol"), 4).coefficients[4].str(20, radius=False)
    '0.0055338541666666666667'
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_amplitude(oscillator, amplitude, DIRECT)
    _check_digits(digits)
    require_numbers(oscillator, "balls need")
    check(balls_of(oscillator), order, budget or Budget())
    with showing(progress) as told:
        return enclosed(Task(oscillator, order, amplitude, digits, told), checkpoint)


def enclosed(task: Task, checkpoint: Path | None) -> BallExpansion:
    """Run the recursion, again with more bits where digits are missing, from the checkpoint where there is one."""
    bits = predicted_bits(task)
    saved = resumed(task, checkpoint, bits)
    bits = bits if saved is None else saved.bits
    for _ in range(ATTEMPTS):
        found = _Run(task, bits, checkpoint, saved).result()
        missing = missing_bits((*found.coefficients, *(found.amplitude_coefficients or ())), task.digits)
        if not missing:
            return found
        bits, saved = bits + missing + GUARD, None
    raise InputError(
        f"{task.oscillator.name}: balls of {bits} bits do not give {task.digits} digits at order {task.order}; a "
        "coefficient may vanish without a symmetry that shows it, so use the exact series"
    )


def resumed(task: Task, path: Path | None, least_bits: int) -> Checkpoint | None:
    """The checkpoint of this task, checked against its own numbers; None where there is none."""
    if path is None or not path.exists():
        return None
    saved = file.read(path, task.identity())
    file.check_numbers(path, saved, task.order + 1, least_bits)
    return saved


@dataclass(frozen=True)
class Task:
    """What is to be found."""

    oscillator: Oscillator
    order: int
    amplitude: str
    digits: int
    progress: Progress = silent

    @property
    def cycle(self) -> bool:
        return self.oscillator.kind == "limit-cycle"

    def identity(self) -> dict[str, str]:
        """What a checkpoint must agree on."""
        return {
            **identity(self.oscillator, self.order, self.amplitude),
            "precision": f"{self.digits} digits",
        }


@dataclass
class _Run:
    """One recursion at one precision: the only thing here that changes while it lasts."""

    task: Task
    bits: int
    path: Path | None
    saved: Checkpoint | None
    last_save: float = field(default_factory=time.monotonic)
    last_order: float = field(default_factory=time.monotonic)
    state: Callable[[], Checkpoint] | None = None
    begun: bool = False

    def result(self) -> BallExpansion:
        """Run all orders; save what there is on an interrupt."""
        with ctx.workprec(self.bits):
            try:
                recursion = self.recursion()
            except KeyboardInterrupt:
                self.save()
                raise
            except AssertionError as error:
                if self.saved is None or self.path is None:
                    raise
                raise InputError(
                    f"{self.path.name} holds numbers that contradict the equation ({error}); remove the file or name "
                    "another"
                ) from None
        with suppress(OSError):  # the result is there and must not be lost with its checkpoint
            self.save()
        with ctx.workprec(self.bits):
            return _expansion(self.task, self.bits, recursion)

    def recursion(self) -> Recursion:
        """All orders, with what is irrational in balls of the present precision."""
        task, space = self.task, Balls(self.task.order + 1)
        if task.cycle:
            return cycle_recursion(task.oscillator, task.order, task.amplitude, space, watch=self.watch)
        constants = {name: number_ball(value) for name, value in task.oscillator.normalised.constants.items()}
        return conservative_recursion(
            task.oscillator, task.order, task.amplitude, space, watch=self.watch, constants=constants
        )

    def watch(self, recursion: Recursion, n: int) -> None:
        """Between two orders: replay, remember, save, and drop the bits that are lost."""
        products = [
            node for node in recursion.program.nodes.values() if isinstance(node, RelaxedProduct) and not node.plain
        ]
        if not self.begun and self.saved is not None:
            _replay(products, self.saved)
        self.begun = True
        if self.saved is None or n >= self.saved.order:
            marks = [(node, len(node.tape), node.waiting.after) for node in products]
            self.state = lambda: self._checkpoint(n, marks)
            now = time.monotonic()
            if 2.0 * now - self.last_order - self.last_save >= SAVE_EVERY:  # the next order takes as long as this one
                self.save()
            self.last_order = time.monotonic()
        self.task.progress((n / (self.task.order + 1)) ** STEEPNESS, f"order {n} of {self.task.order}")
        ctx.prec = min(ctx.prec, _useful_bits(recursion))

    def _checkpoint(self, n: int, marks: list[tuple[RelaxedProduct, int, dict[int, Parts]]]) -> Checkpoint:
        tapes = tuple(Tape(tuple(node.tape[:length]), waiting) for node, length, waiting in marks)
        return Checkpoint(self.task.identity(), self.bits, n, tapes)

    def save(self) -> None:
        """Write the state before the present order."""
        if self.path is not None and self.state is not None:
            file.write(self.path, self.state())
            self.last_save = time.monotonic()


def predicted_bits(task: Task) -> int:
    """The precision to begin with: the bits lost per order by a short recursion, times the orders, and the digits.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> 3000 < predicted_bits(Task(find("van-der-pol"), 859, "peak", 30)) < 3500
    True
    """
    wanted = int(10**task.digits).bit_length() + GUARD
    if task.order <= TRIAL_ORDER:
        return _LOSS * task.order + wanted
    bits = _LOSS * TRIAL_ORDER + GUARD
    trial = _Run(replace(task, order=TRIAL_ORDER, progress=silent), bits, None, None).result()
    rates = [
        Fraction(bits - int(c.rel_accuracy_bits()), n)
        for n, c in enumerate(trial.coefficients)
        if 2 * n > TRIAL_ORDER and not c.is_exact() and not c.contains(0)
    ]
    rate = max(rates, default=Fraction(_LOSS))
    return math.ceil(rate * (task.order + 1)) + wanted


def _replay(products: list[RelaxedProduct], saved: Checkpoint) -> None:
    """Hand the tapes to the products of a recursion that is about to begin."""
    if len(products) != len(saved.tapes):
        raise InputError(f"the checkpoint has {len(saved.tapes)} products, this recursion {len(products)}; start again")
    for node, tape in zip(products, saved.tapes, strict=True):
        node.replayed = list(tape.values)
        node.waiting = Waiting(-1, dict(tape.waiting), dict(tape.waiting))


def _useful_bits(recursion: Recursion) -> int:
    """Bits from the largest coefficient of the last order down to ``GUARD`` below its largest radius."""
    values = [x for p in recursion.u[-1].parts if p is not None for x in p.coeffs()]
    sizes = [log2(abs(x).abs_upper()) for x in values if not x.is_zero()]
    radii = [log2(x.rad()) for x in values if not x.is_exact()]
    return max(sizes) - max(radii) + GUARD if radii else int(ctx.prec)


def _expansion(task: Task, bits: int, recursion: Recursion) -> BallExpansion:
    last, read = task.order + 1, at_zero if task.amplitude == "peak" else first_harmonic
    return BallExpansion(
        system=task.oscillator.name,
        variable=str(task.oscillator.small) if task.cycle else "A",
        amplitude=task.amplitude,
        order=task.order,
        scale=task.oscillator.normalised.scale,
        scaled_variable=task.cycle,
        digits=task.digits,
        bits=bits,
        coefficients=tuple(arb(c) for c in recursion.omega[:last]),
        amplitude_coefficients=tuple(arb(read(p)) for p in recursion.u[:last]) if task.cycle else None,
    )


def _check_digits(digits: object) -> None:
    if isinstance(digits, bool) or not isinstance(digits, int) or not 1 <= digits <= MAX_DIGITS:
        raise InputError(f"digits {digits!r} is not a whole number within 1..{MAX_DIGITS}; use e.g. 30")
