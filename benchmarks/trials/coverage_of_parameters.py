"""How often the 95 % intervals of ``identify`` hold: ``python -m benchmarks.trials.coverage_of_parameters``.

Seeded trials of equations of motion, integrated as they stand from a random phase, in white noise of a random level;
the class and its law of damping are given, as ``--candidates`` and ``--damping`` do.  A row of the table that it prints
is a kind of motion: of each parameter the share of the intervals that hold the truth with where the true share lies at
95 % (Clopper and Pearson), then in brackets the mean and the root mean square of the errors in deviations, 0 and 1 if
all is right; the trials in which nothing is claimed, and the reason that is given then.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.trials.shares import written
from ridgeback.common.errors import InputError
from ridgeback.compare.identification.identify import identify
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.tracking.track import NORMAL_95

CYCLE = 2.0 * math.pi


@dataclass(frozen=True)
class Equation:
    """u'' + 2 mu u' + beta |u'| u' + gamma u'^3 + F sign(u') + r(u) = 0; r from k = 1 and what bends it."""

    mu: float = 0.0
    beta: float = 0.0
    gamma: float = 0.0
    F: float = 0.0
    eps: float = 0.0
    pendulum: bool = False

    def restoring(self, u: float) -> float:
        """r(u)."""
        return math.sin(u) if self.pendulum else u + self.eps * u**3

    def motion(self, start: float, time: Array) -> Array:
        """u at rising times after it was let go at ``start``; under friction each half swing by itself."""
        u, at, now, way = np.zeros(time.size), start, 0.0, -math.copysign(1.0, start)

        def slope(_: float, state: Array) -> list[float]:
            v = float(state[1])
            loss = 2.0 * self.mu * v + self.beta * abs(v) * v + self.gamma * v**3 + self.F * way
            return [v, -loss - self.restoring(float(state[0]))]

        def turned(t: float, state: Array) -> float:
            return float(state[1]) if t > now + 1e-3 else way

        turned.terminal = True  # type: ignore[attr-defined]
        while now < time[-1]:
            if abs(self.restoring(at)) <= self.F:
                u[time > now] = at
                return u
            half = solve_ivp(
                slope,
                (now, time[-1]),
                (at, 0.0),
                "DOP853",
                dense_output=True,
                events=turned if self.F else None,
                rtol=1e-10,
                atol=1e-12,
            )
            inside = (time >= now) & (time <= half.t[-1])
            if inside.any():
                u[inside] = half.sol(time[inside])[0]
            at, now, way = float(half.y[0, -1]), float(half.t[-1]), -way
        return u


@dataclass(frozen=True)
class Record:
    """One trial."""

    x: Array
    rate: float
    truth: Mapping[str, float]


@dataclass(frozen=True)
class Kind:
    """Motions of one class with one law; each number is drawn between two."""

    candidate: str
    law: str
    samples: int
    cycles: float
    ranges: Mapping[str, tuple[float, float]]
    noise: tuple[float, float] = (0.002, 0.012)
    start: tuple[float, float] = (1.0, 1.0)

    def __call__(self, rng: np.random.Generator) -> Record:
        drawn = {name: float(rng.uniform(*ends)) for name, ends in self.ranges.items()}
        equation = Equation(**drawn, pendulum=self.candidate == "pendulum")  # type: ignore[arg-type]
        start, step = float(rng.uniform(*self.start)), self.cycles * CYCLE / self.samples
        u = equation.motion(start, rng.uniform(0.0, CYCLE) + step * np.arange(self.samples))
        x = u + start * rng.uniform(*self.noise) * rng.normal(size=u.size)
        b = {"b": 1.0} if equation.pendulum else {}
        return Record(x, 1.0 / step, {"k": 1.0, **drawn, **b})


def drawn(least: float, most: float) -> tuple[float, float]:
    """Between these."""
    return least, most


LIGHT, DRAG, RUB = drawn(0.002, 0.01), drawn(0.01, 0.05), drawn(0.004, 0.012)
HARD, SOFT = drawn(0.1, 0.8), drawn(-0.3, -0.1)
KINDS: dict[str, Kind] = {
    "linear, damping ratio 5 %, 10 cycles": Kind("linear", "linear", 200, 10.0, {"mu": (0.05, 0.05)}),
    "linear + quadratic drag": Kind(
        "linear", "linear + quadratic", 1200, 40.0, {"mu": (0.003, 0.02), "beta": (0.05, 0.2)}
    ),
    "linear + cubic drag": Kind("linear", "linear + cubic", 1200, 40.0, {"mu": (0.003, 0.02), "gamma": (0.05, 0.2)}),
    "linear + dry friction, 10 cycles": Kind("linear", "linear + coulomb", 200, 10.0, {"mu": LIGHT, "F": RUB}),
    "linear + dry friction, to a standstill": Kind(
        "linear", "linear + coulomb", 400, 20.0, {"mu": LIGHT, "F": (0.015, 0.03)}
    ),
    "Duffing, damping ratio 3 %": Kind("duffing-hardening", "linear", 600, 20.0, {"mu": (0.03, 0.03), "eps": HARD}),
    "Duffing, softening": Kind("duffing-softening", "linear", 600, 40.0, {"mu": LIGHT, "eps": SOFT}),
    "Duffing + quadratic drag": Kind(
        "duffing-hardening", "linear + quadratic", 1200, 40.0, {"mu": LIGHT, "beta": DRAG, "eps": HARD}
    ),
    "Duffing + dry friction": Kind(
        "duffing-hardening", "linear + coulomb", 600, 20.0, {"mu": LIGHT, "F": RUB, "eps": HARD}
    ),
    **{
        f"pendulum{' + quadratic drag' if law else ''} from {low:g} to {high:g} rad": Kind(
            "pendulum",
            f"linear{law}",
            1200,
            40.0,
            {"mu": LIGHT, "beta": DRAG} if law else {"mu": LIGHT},
            start=(low, high),
        )
        for law in ("", " + quadratic")
        for low, high in ((0.4, 0.8), (0.8, 1.5), (1.5, 2.0), (2.0, 2.5))
    },
}


@dataclass(frozen=True)
class Outcome:
    """Errors in deviations by parameter; why there are none."""

    errors: Mapping[str, float]
    reason: str = ""


def trial(kind: Kind, seed: int) -> Outcome:
    """One record, identified as the command does."""
    record = kind(np.random.default_rng(seed))
    try:
        found = identify(Recording.from_arrays(record.x, record.rate), candidates=(kind.candidate,), laws=(kind.law,))
    except InputError as error:
        return Outcome({}, str(error))
    if found.unclaimed:
        return Outcome({}, found.unclaimed)
    named = {name: found.best.parameter(name) for name in record.truth}
    return Outcome({n: (p.value - record.truth[n]) / p.standard_deviation for n, p in named.items()})


def cell(name: str, errors: Array) -> str:
    """The share that holds, its interval, and the errors."""
    share = float(np.mean(np.abs(errors) <= NORMAL_95))
    return f"{name} {written(share, errors.size)} [{errors.mean():+.1f}, {math.sqrt(np.mean(errors**2)):.2f}]"


def row(name: str, kind: Kind, trials: int, seed: int) -> str:
    """A row of the table."""
    found = [trial(kind, seed + k) for k in range(trials)]
    claimed = [one.errors for one in found if not one.reason]
    cells = [cell(p, np.array([one[p] for one in claimed])) for p in claimed[0]] if claimed else ["none"]
    reasons = Counter(one.reason[:90] for one in found if one.reason)
    why = "; ".join(f"{text} ({count})" for text, count in reasons.most_common(2))
    return f"| {name} | {trials} | {', '.join(cells)} | {trials - len(claimed)} | {why} |"


def main() -> None:
    """Read the options, run, print a row as soon as it is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="kinds with this in their name")
    given = parser.parse_args()
    sys.stdout.write("| motion | trials | held, % | without | reason |\n|---|---|---|---|---|\n")
    for name, kind in KINDS.items():
        if given.only in name:
            sys.stdout.write(row(name, kind, given.trials, given.seed) + "\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
