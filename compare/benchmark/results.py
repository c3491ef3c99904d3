"""What a benchmark hands over: every contender on one motion.

Errors are relative to the reference omega0(t) and are taken over the support that is named; times are those of
this machine's processor in this run.
"""

from __future__ import annotations

from dataclasses import dataclass

from ridgeback.compare.benchmark.account import Account
from ridgeback.compare.benchmark.contenders import Crossings, Reference, Row, Verdict
from ridgeback.compare.benchmark.shown import ShownBenchmark
from ridgeback.compare.motion.results import Case
from ridgeback.numeric.arrays import Array, freeze


@dataclass(frozen=True, repr=False)
class Benchmark(ShownBenchmark):
    """Every contender on one motion, judged on one support against one reference.

    Made by :func:`ridgeback.benchmark`.

    Parameters
    ----------
    case : Case
        The motion.
    reference : Reference
        What errors are measured against, and how well that is known.
    support : (float, float)
        The times between which errors are taken.
    contenders : tuple of Row
        One for each contender, best first, its errors relative to the reference.
    crossings : Crossings
        Where expansions pass estimates.
    verdict : Verdict
        Which is best, at what cost.
    time : array of float, shape (N,)
        Times along the motion.
    amplitude : array of float, shape (N,)
        Amplitude there, in the unit of u.
    errors : array of float, shape (R, N)
        Signed relative error of each row along the motion; NaN where it gives nothing.
    account : Account, optional
        The motion's energy, its components a_m(t), and which multiples its sampling folds.

    Examples
    --------
    >>> import ridgeback
    >>> found = ridgeback.benchmark("damped-pendulum", initial=(1.0, 0.0), duration=60.0, rate=5.0, orders=(2, 6))
    >>> found.errors.shape == (len(found.contenders), found.time.size)
    True
    """

    case: Case
    reference: Reference
    support: tuple[float, float]
    contenders: tuple[Row, ...]
    crossings: Crossings
    verdict: Verdict
    time: Array
    amplitude: Array
    errors: Array
    account: Account | None = None

    def __post_init__(self) -> None:
        freeze(self)

    def row(self, method: str) -> Row:
        """The row of this name; KeyError without it."""
        return {row.method: row for row in self.contenders}[method]
