r"""Multiple scales to any order, as the slow flow of amplitude and phase.

    u = a cos phi + sum of a^p m^r * (harmonics of phi),     phi' = omega(a, m),     a' = a delta(a, m)

with m the small parameters (damping mu, cubic damping, eps of a limit cycle, ...), in units with k = 1, and m^r short
for m_1^r_1 m_2^r_2 ...  Weighted degree n collects the terms with p + w.r = n, w being the weights of m against the
amplitude.  Along the flow d/dt is one derivation,

    D = omega d/dphi + delta a d/da,

so that the derivatives by the several slow times of the textbook method (Nayfeh and Mook 1979, 2.3) appear together
and the question of their order does not arise.  At weighted degree n of  D D u + f(u, D u) = 0:

    d^2 u_n/dphi^2 + u_n = -[rest]_n + 2 omega_(n-1) a cos phi + 2 delta_(n-1) a sin phi,

and the right-hand side may hold no first harmonic: cos gives omega_(n-1), sin gives delta_(n-1).  u_n has no first
harmonic either, so that a is the ``fundamental`` amplitude.  This is the normal form of the paper's companion theory
(u = z + zbar + ..., z = (a/2) exp(i phi)), written in real quantities.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.expansion.amplitude import check_name
from ridgeback.symbolic.expansion.cost import Budget, check
from ridgeback.symbolic.expansion.expansion import check_order
from ridgeback.symbolic.flow.ordering import Ordered, ordered
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Parametric, Scalar
from ridgeback.symbolic.series.trigonometric import Trig, constant, cosine, harmonic, sine, solve_oscillator
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import U, V
from ridgeback.symbolic.systems.sides import is_kinked, kink_advice, require_one_law

COEFFICIENT: Final = 2
"""What a symbolic coefficient counts when the cost is predicted: that of u^3 comes with a^2 each time."""

STEEPNESS = 4
"""Power of the order that the time of a derivation follows (``expansion.cost``)."""


def multiple_scales(
    oscillator: OscillatorLike,
    order: int,
    *,
    weight: int = 2,
    weights: Mapping[str, int] | None = None,
    budget: Budget | None = None,
    progress: Wanted = None,
) -> SlowFlow:
    """Expand phi' and a'/a in the fundamental amplitude a and the small parameters m by multiple scales.

    Terms a^p m^r with p + w.r <= order are kept, w being the weights.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator; damping and self-excitation are allowed.
    order : int
        Highest weighted degree kept, 0 or more.
    weight : int, optional
        Weight of every parameter that is small by default (see ``flow.ordering``) against the amplitude; 2 by default.
    weights : mapping of str to int, optional
        Weights of single parameters by name; 0 for one that is not small.
    budget : Budget, optional
        What the derivation may cost; 10 minutes and 4 GB by default.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the weighted degree about to be found.

    Returns
    -------
    SlowFlow
        phi' (rad per time unit) and a'/a (per time unit) as exact polynomials, with the waveform and the residual.

    Raises
    ------
    InputError
        For a bad order or weight, and when the predicted cost exceeds the budget.

    References
    ----------
    Nayfeh and Mook, Nonlinear Oscillations (1979), section 2.3.2; Nayfeh, Perturbation Methods (1973), chapter 6.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow = multiple_scales(find("pendulum"), 2)
    >>> flow.frequency_expression(), flow.growth_rate_expression()
    (1 - a**2/16, -mu)
    >>> from ridgeback.symbolic.systems.oscillator import Oscillator
    >>> own = Oscillator.from_equation("u'' + c*u' + d*u'**3 + u = 0")
    >>> multiple_scales(own, 2, weights={"d": 1, "c": 1}).growth_rate_expression()
    -c/2
    """
    oscillator = as_oscillator(oscillator)
    order = check_order(order)
    check_name(oscillator, "a")
    require_one_law(oscillator.name, oscillator.substituted_force)
    if is_kinked(oscillator.substituted_force):
        raise InputError(
            f"{oscillator.name}: {kink_advice(oscillator.substituted_force, conservative=oscillator.closes)}"
        )
    natural = ordered(oscillator, weight=weight, weights=weights)
    counted = tuple(natural.weights.get(name, COEFFICIENT) for name in natural.names)
    check("multiple-scales", order, budget or Budget(), weights=counted)
    frame = _Frame(natural, Parametric(natural.names))
    recursion = _Recursion(frame)
    with showing(progress) as told:
        for n in range(2, order + 2):
            told((n / (order + 1)) ** STEEPNESS, f"weighted degree {min(n, order)} of {order}")
            recursion.step(n)
    return SlowFlow(
        system=oscillator.name,
        order=order,
        weights=natural.weights,
        scale=natural.scale,
        dimensions=natural.dimensions,
        constants=natural.constants,
        omega=tuple(recursion.omega[: order + 1]),
        delta=tuple(recursion.delta[: order + 1]),
        waveform=tuple(recursion.u),
        complete=_complete(natural, order),
        residual_of=frame.residual,
    )


@dataclass(frozen=True)
class _Frame:
    """The equation and the ring it is solved in."""

    natural: Ordered
    space: Parametric

    @property
    def zero(self) -> Trig:
        return constant(self.space, fmpq(0))

    def program(self) -> Program:
        """The force by weighted degree: a small parameter m of weight w stands at degree w."""
        ring, weights = TrigRing(self.space), self.natural.weights
        fixed = {
            sympy.Symbol(name, real=True): [self.zero] * weights.get(name, 0) + [ring.parameter(name)]
            for name in self.natural.names
        }
        return Program(self.natural.force, ring, {U: [self.zero], V: [self.zero]}, U, V, fixed=fixed)

    def along(self, series: Sequence[Trig], n: int, omega: Sequence[Scalar], delta: Sequence[Scalar]) -> Trig:
        """Weighted degree n of D series, from the degrees of series, omega and delta that exist."""
        turned, grown = self.zero, self.zero
        for j in range(max(0, n + 1 - len(series)), min(n, len(omega) - 1) + 1):
            if omega[j] != 0:
                turned = turned + series[n - j].scale(omega[j])
            if delta[j] != 0:
                grown = grown + self._by_amplitude(series[n - j], n - j).scale(delta[j])
        return turned.derivative() + grown

    def _by_amplitude(self, p: Trig, n: int) -> Trig:
        """a d/da of weighted degree n: its terms a^(n - w.r) m^r have a-degree n - w.r."""
        small = [(1 + i, self.space.gen(name), w) for i, (name, w) in enumerate(self.natural.weights.items())]
        return p.map(lambda part: sum((part.derivative(i) * m * -w for i, m, w in small), part * n))

    def residual(self, flow: SlowFlow) -> list[int]:
        """Substitute u and the slow flow again, with complete coefficients; return the degrees that do not cancel."""
        degrees = range(flow.order + 2)
        velocity = [self.along(flow.waveform, n, flow.omega, flow.delta) for n in degrees]
        acceleration = [self.along(velocity, n, flow.omega, flow.delta) for n in degrees]
        program = self.program()
        for p, v in zip(flow.waveform[1:], velocity[1:], strict=True):
            program.supply(U, p)
            program.supply(V, v)
        return [n for n in degrees if acceleration[n] + program.root.get(n)]


class _Recursion:
    """The weighted degrees found so far."""

    def __init__(self, frame: _Frame) -> None:
        self.frame, self.space, self.program = frame, frame.space, frame.program()
        first = cosine(self.space)
        self.u, self.v = [frame.zero, first], [frame.zero, first.derivative()]
        self.omega: list[Scalar] = [self.space.constant(1)]
        self.delta: list[Scalar] = [self.space.constant(0)]
        self.program.supply(U, self.u[1])
        self.program.supply(V, self.v[1])

    def step(self, n: int) -> None:
        """Find u_n, omega_(n-1), delta_(n-1)."""
        velocity = self.frame.along(self.u, n, self.omega, self.delta)
        self.program.supply(U, self.frame.zero)
        self.program.supply(V, velocity)
        self.v.append(velocity)
        right = -self.program.root.get(n) - self.frame.along(self.v, n, self.omega, self.delta)
        particular, p, q = solve_oscillator(right)
        omega, delta = -p * fmpq(1, 2), -q * fmpq(1, 2)
        self.omega.append(self.space.constant(omega))
        self.delta.append(self.space.constant(delta))
        self.u.append(_without_first(particular))
        first = cosine(self.space)
        change = self.u[n].derivative() + first.derivative().scale(omega) + first.scale(delta)
        self.v[n] = velocity + change
        self.program.correct(n, self.u[n], change)


def _without_first(p: Trig) -> Trig:
    """Remove the first harmonic."""
    cos_part, sin_part = harmonic(p, 1)
    return p - cosine(p.space).scale(cos_part) - sine(p.space).scale(sin_part)


def _complete(natural: Ordered, order: int) -> int | None:
    """The highest power of the one small parameter m of which every term is kept; None when its terms never end.

    In u'' + u + sum of m^r u^i u'^j with r >= 1 each m brings at most D = max (i + j - 1)/r further powers of a: those
    of m^r end at a^(D r), of degree (w + D) r.
    """
    if len(natural.weights) != 1:
        return None
    ((name, weight),) = natural.weights.items()
    rest = sympy.expand(natural.force - U)
    if not rest.is_polynomial(U, V, m := sympy.Symbol(name, real=True)):
        return None
    powers = sympy.Poly(rest, U, V, m).monoms() if rest != 0 else []
    if any(r == 0 for *_, r in powers):
        return None
    growth = max((sympy.Rational(i + j - 1, r) for i, j, r in powers), default=sympy.S.Zero)
    return int(order // (weight + growth))
