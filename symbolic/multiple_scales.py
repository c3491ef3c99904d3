r"""Multiple scales to any order, as the slow flow of amplitude and phase.

    u = a cos phi + sum of a^p m^r * (harmonics of phi),     phi' = omega(a, m),     a' = a delta(a, m)

with m the small parameter (damping mu, or eps of a limit cycle), in units with k = 1.  Grade n collects the terms with
p + w r = n, w being the weight of m against the amplitude.  Along the flow d/dt is one derivation,

    D = omega d/dphi + delta a d/da,

so that the derivatives by the several slow times of the textbook method (Nayfeh and Mook 1979, 2.3) appear together
and the question of their order does not arise.  At grade n of  D D u + f(u, D u) = 0:

    d^2 u_n/dphi^2 + u_n = -[rest]_n + 2 omega_(n-1) a cos phi + 2 delta_(n-1) a sin phi,

and the right-hand side may hold no first harmonic: cos gives omega_(n-1), sin gives delta_(n-1).  u_n has no first
harmonic either, so that a is the ``fundamental`` amplitude.  This is the normal form of the paper's companion theory
(u = z + zbar + ..., z = (a/2) exp(i phi)), written in real quantities.
"""

from __future__ import annotations

import sympy
from flint import fmpq

from symbolic.cost import Budget, check
from symbolic.errors import InputError
from symbolic.expansion import check_order
from symbolic.fourier import Trig, constant, cosine, harmonic, sine, solve_oscillator
from symbolic.oscillator import Oscillator, U, V
from symbolic.rings import TrigRing, free_names
from symbolic.series import Program
from symbolic.slow_flow import SlowFlow
from symbolic.spaces import Scalar, space_for


def multiple_scales(oscillator: Oscillator, order: int, *, weight: int = 2, budget: Budget | None = None) -> SlowFlow:
    """Expand phi' and a'/a in the fundamental amplitude a and the small parameter, through weighted degree ``order``.

    Terms a^p m^r with p + weight r <= order are kept.  Raises InputError for a bad order or weight, and when
    the predicted cost exceeds the budget.

    >>> from symbolic.systems import find
    >>> flow = multiple_scales(find("pendulum"), 2)
    >>> flow.frequency_expression(), flow.damping_expression()
    (1 - a**2/16, -mu)
    """
    order = check_order(order)
    if isinstance(weight, bool) or not isinstance(weight, int) or weight < 1:
        raise InputError(
            f"weight {weight!r} is not a whole number above 0; use 2 to count mu like the amplitude squared"
        )
    march = _March(oscillator, weight)
    check("multiple-scales", order, budget or Budget(), parameters=len(march.names) - 1, weight=weight)
    for n in range(2, order + 2):
        march.step(n)
    return SlowFlow(
        system=oscillator.name,
        small=march.small,
        order=order,
        weight=weight,
        scale=march.scale,
        omega=tuple(march.omega[: order + 1]),
        delta=tuple(march.delta[: order + 1]),
        waveform=tuple(march.u),
        names=march.names,
        residual_of=march.residual,
    )


class _March:
    """The grades found so far."""

    def __init__(self, oscillator: Oscillator, weight: int) -> None:
        self.small = oscillator.small or oscillator.damping or "mu"
        natural = oscillator.normalised()
        self.force, self.scale, self.weight = natural.force, natural.scale, weight
        self.names = (self.small, *(name for name in free_names(natural.force) if name != self.small))
        self.space = space_for(self.names)
        zero, first = constant(self.space, fmpq(0)), cosine(self.space)
        self.zero = zero
        self.u, self.v, self.acceleration = [zero, first], [zero, first.derivative()], [zero, -first]
        self.omega: list[Scalar] = [self.space.constant(1)]
        self.delta: list[Scalar] = [self.space.constant(0)]
        self.program = self._compile()
        self.program.supply(U, self.u[1])
        self.program.supply(V, self.v[1])
        if self.program.root.slope_v:
            raise InputError(
                f"{oscillator.name} has damping that does not vanish with {self.small}; write it as 2*{self.small}*u'"
            )

    def _compile(self) -> Program:
        ring = TrigRing(self.space)
        parameters = {sympy.Symbol(name, real=True): [ring.parameter(name)] for name in self.names[1:]}
        graded = [self.zero] * self.weight + [ring.parameter(self.small)]
        fixed = {**parameters, sympy.Symbol(self.small, real=True): graded}
        return Program(self.force, ring, {U: [self.zero], V: [self.zero]}, U, V, fixed=fixed)

    def step(self, n: int) -> None:
        """Find u_n, omega_(n-1), delta_(n-1)."""
        velocity = self.along(self.u, n)
        self.program.supply(U, self.zero)
        self.program.supply(V, velocity)
        self.v.append(velocity)
        right = -self.program.root.get(n) - self.along(self.v, n)
        particular, p, q = solve_oscillator(right)
        omega, delta = -p * fmpq(1, 2), -q * fmpq(1, 2)
        self.omega.append(self.space.constant(omega))
        self.delta.append(self.space.constant(delta))
        self.u.append(_without_first(particular))
        first = cosine(self.space)
        change = self.u[n].derivative() + first.derivative().scale(omega) + first.scale(delta)
        self.v[n] = velocity + change
        self.program.correct(n, self.u[n], change)

    def along(self, series: list[Trig], n: int) -> Trig:
        """Grade n of D series, from the grades of series, omega and delta that exist."""
        total = self.zero
        for j in range(min(n, len(self.omega) - 1) + 1):
            if n - j >= len(series):
                continue
            if self.omega[j] != 0:
                total = total + series[n - j].derivative().scale(self.omega[j])
            if self.delta[j] != 0:
                total = total + self._by_amplitude(series[n - j], n - j).scale(self.delta[j])
        return total

    def _by_amplitude(self, p: Trig, n: int) -> Trig:
        """a d/da of a grade: its terms a^(n - w r) m^r have a-degree n - w r."""
        m = self.space.gen(self.small)
        return p.map(lambda part: part * n - part.derivative(1) * m * self.weight)

    def residual(self, flow: SlowFlow) -> list[int]:
        """Substitute u and the slow flow anew, with complete coefficients; return the grades that do not cancel."""
        fresh = object.__new__(_March)
        fresh.__dict__.update(self.__dict__)
        fresh.omega, fresh.delta, fresh.u = list(flow.omega), list(flow.delta), list(flow.waveform)
        grades = range(flow.order + 2)
        fresh.v = [fresh.along(fresh.u, n) for n in grades]
        fresh.acceleration = [fresh.along(fresh.v, n) for n in grades]
        program = fresh._compile()
        for p, v in zip(fresh.u[1:], fresh.v[1:], strict=True):
            program.supply(U, p)
            program.supply(V, v)
        return [n for n in grades if fresh.acceleration[n] + program.root.get(n)]


def _without_first(p: Trig) -> Trig:
    """Remove the first harmonic."""
    cos_part, sin_part = harmonic(p, 1)
    return p - cosine(p.space).scale(cos_part) - sine(p.space).scale(sin_part)
