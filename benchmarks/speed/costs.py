"""What derivations take against what is predicted: ``python -m benchmarks.speed.costs``.

Seconds of one core for every method, and the gigabytes that a process of its own gains; each ratio of the prediction to
what happened is to lie between a third and three, on a machine like that of ``expansion.cost``.
"""

from __future__ import annotations

import multiprocessing
import resource
import time
from collections.abc import Callable
from dataclasses import dataclass

from ridgeback.symbolic.expansion.cost import Budget, Cost, balls_of, effort_of, predict
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import in_closed_form, lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U

FREE = Budget(1e9, 1e9)
SYMBOLIC = "u'' + u + b*u**2 + c*u**3 = 0"
TWO_LOSSES = "u'' + 2*mu*u' + c*u'**3 + sin(u) = 0"


@dataclass(frozen=True)
class Case:
    """One derivation, and what its cost is predicted from."""

    method: str
    system: str
    order: int
    parameters: int = 0
    weights: tuple[int, ...] = ()

    @property
    def oscillator(self) -> Oscillator:
        """The oscillator of the equation or name."""
        return Oscillator.from_equation(self.system) if "=" in self.system else find(self.system)

    def run(self) -> None:
        """Derive."""
        RUNS[self.method](self.oscillator, self.order)

    def predicted(self) -> Cost:
        """What is foretold."""
        law = balls_of(self.oscillator) if self.method == "balls" else self.method
        if law == "lindstedt" and in_closed_form(self.oscillator, self.order, "peak"):
            law = "theta series"
        effort = effort_of(self.oscillator.normalised.bound, U) if law == "lindstedt" else 1.0
        return predict(law, self.order, parameters=self.parameters, weights=self.weights, effort=effort)


RUNS: dict[str, Callable[[Oscillator, int], object]] = {
    "lindstedt": lambda own, order: lindstedt(own, order, budget=FREE),
    "limit-cycle": lambda own, order: lindstedt(own, order, budget=FREE),
    "energy-integral": lambda own, order: energy_integral(own, order, budget=FREE),
    "multiple-scales": lambda own, order: multiple_scales(own, order, budget=FREE),
    "balls": lambda own, order: lindstedt_in_balls(own, order, digits=30),
}
CASES = (
    Case("lindstedt", "pendulum", 100),
    Case("lindstedt", "pendulum", 240),
    Case("lindstedt", "pendulum", 400),
    Case("lindstedt", "duffing-hardening", 240),
    Case("lindstedt", "u'' + tan(u) = 0", 120),
    Case("lindstedt", "helmholtz-duffing", 80),
    Case("lindstedt", "u'' + u*exp(u) = 0", 100),
    Case("lindstedt", "u'' + sin(u)*exp(u)/(1 + u**2) = 0", 160),
    Case("lindstedt", SYMBOLIC, 20, parameters=2),
    Case("limit-cycle", "van-der-pol", 48),
    Case("limit-cycle", "van-der-pol", 96),
    Case("limit-cycle", "rayleigh", 48),
    Case("energy-integral", "pendulum", 400),
    Case("energy-integral", "pendulum", 800),
    Case("energy-integral", "helmholtz-duffing", 800),
    Case("energy-integral", SYMBOLIC, 24, parameters=2),
    Case("multiple-scales", "damped-pendulum", 60, weights=(2,)),
    Case("multiple-scales", "van-der-pol", 60, weights=(2,)),
    Case("multiple-scales", TWO_LOSSES, 36, weights=(2, 2)),
    Case("balls", "van-der-pol", 100),
    Case("balls", "pendulum", 120),
    Case("balls", "pendulum", 240),
    Case("balls", "helmholtz-duffing", 60),
)


def measured(case: Case) -> tuple[float, float]:
    """Seconds and gigabytes, in a process of its own."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(_measured, (case,))


def _measured(case: Case) -> tuple[float, float]:
    Case(case.method, case.system, 4, case.parameters, case.weights).run()  # imports and tables are no part of the cost
    before, start = _peak(), time.process_time()
    case.run()
    return time.process_time() - start, _peak() - before


def _peak() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


def main() -> None:
    """Print the table."""
    print(f"{'method':24} {'system':38} {'order':>5} {'s':>8} {'predicted/true':>14} {'GB':>7} {'predicted':>9}")
    for case in CASES:
        seconds, gigabytes = measured(case)
        cost = case.predicted()
        print(
            f"{case.method:24} {case.system:38} {case.order:5d} {seconds:8.3f} {cost.seconds / seconds:14.2f} "
            f"{gigabytes:7.3f} {cost.gigabytes:9.3f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
