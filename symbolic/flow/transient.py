r"""The transient of a slow flow: a(t) and phi(t), in closed form where the truncated equations have one.

    a' = a (c_0 + c_2 a^2)  (Bernoulli's equation; linear decay when c_2 = 0),   phi' = sum_j w_(2j) a^(2j)

With s = a^2, s_0 = a_0^2 and E = exp(2 c_0 t):  s = s_0 E / G with G = 1 + (c_2/c_0) s_0 (1 - E), or 1 - 2 c_2 s_0 t
when c_0 = 0, and the integrals I_j of s^j dt follow from s' = 2 s (c_0 + c_2 s):

    I_0 = t,   I_1 = -ln(G)/(2 c_2),   c_2 I_j = (s^(j-1) - s_0^(j-1))/(2 (j-1)) - c_0 I_(j-1).

Every other flow is integrated by its Taylor series in time, in plain floats: s' = 2 s delta(s) is a polynomial
equation, so that each coefficient follows from those before it.  Near a stable state r of s (a limit cycle, or rest)
the deviation y = s - r is soon so small that its square is lost; from there on, exactly so far as floats go,

    y = y_0 exp(-L t),   phi = phi_0 + omega(r) t + omega'(r) y_0 (1 - exp(-L t))/L,   L = -d(2 s delta)/ds at r > 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, NamedTuple, TypeAlias

import sympy

from ridgeback.common.elementary import powers
from ridgeback.common.errors import InputError
from ridgeback.common.horner import polynomial_value
from ridgeback.common.number_ring import FLOATS
from ridgeback.common.recurrences import Combination, Input
from ridgeback.symbolic.arithmetic.rendering import series_latex
from ridgeback.symbolic.flow.slow_flow import SlowFlow, amplitude_powers, rounded
from ridgeback.symbolic.flow.term import Term

TIME: Final = sympy.Symbol("t", real=True)
START: Final = sympy.Symbol("a_0", positive=True)
PHASE: Final = sympy.Symbol("phi_0", real=True)
"""The symbols of closed forms: time, and amplitude and phase at time 0."""

TERMS: Final = 20
"""Order of the Taylor steps: near the best for double precision."""
MOST_STEPS: Final = 10_000
"""From one time to the next; until a state settles the steps grow with its age, so that only few are ever needed."""
SETTLED: Final = 1e-10
"""Deviation from a limit cycle whose square no longer counts, relative to s; a hundred times that to L/curvature."""
NEGLIGIBLE: Final = 1e-15
"""What the higher powers of s may add near rest, relative to the rate of decay."""
LARGEST: Final = 1e15
"""Amplitudes beyond, and below its inverse, have powers that are no doubles."""
MOST_PHASE: Final = 2.0**52 * 1e-6
"""Phases beyond, in rad, are spaced by more than 1e-6: cos(phi) would have lost the digits that are printed."""


State: TypeAlias = tuple[float, float]
"""s = a^2 and phi."""


@dataclass(frozen=True)
class ClosedForm:
    """a(t) and phi(t) of the truncated slow flow in ``TIME``, ``START`` and ``PHASE``."""

    amplitude: sympy.Expr
    phase: sympy.Expr

    def latex(self) -> tuple[str, str]:
        """LaTeX of both relations."""
        return rf"a(t) = {sympy.latex(self.amplitude)}", r"\varphi(t) = " + series_latex(
            sympy.Add.make_args(self.phase)
        )


@dataclass(frozen=True)
class Transient:
    """a and phi at the times asked for."""

    time: tuple[float, ...]
    amplitude: tuple[float, ...]
    phase: tuple[float, ...]


def closed_form(flow: SlowFlow) -> ClosedForm | None:
    """Return a(t) and phi(t) exactly, when a'/a = c_0 + c_2 a^2 as far as it is kept.

    Parameters
    ----------
    flow : SlowFlow
        Its small parameters stay symbols; where they make c_0 or c_2 vanish, the limit is meant.

    Returns
    -------
    ClosedForm or None
        In ``TIME``, ``START`` and ``PHASE``; None when a'/a has other terms.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = closed_form(multiple_scales(find("damped-pendulum"), 2))
    >>> found.amplitude, found.phase
    (a_0*exp(-mu*t), a_0**2*(-1 + exp(-2*mu*t))/(32*mu) + phi_0 + t)
    """
    delta, omega = (_by_square(flow, terms) for terms in (flow.growth_rate, flow.frequency))
    if len(delta) > 2:
        return None
    c0, c2 = (*delta, sympy.S.Zero, sympy.S.Zero)[:2]
    count = len(omega)
    amplitude, integrals = _decay(c0, count) if c2 == 0 else _bernoulli(c0, c2, count)
    return ClosedForm(amplitude, PHASE + sum(w * i for w, i in zip(omega, integrals, strict=True)))


def _by_square(flow: SlowFlow, terms: tuple[Term, ...]) -> list[sympy.Expr]:
    """Coefficients of the powers of a^2."""
    found: dict[int, sympy.Expr] = {}
    for term, expression in zip(terms, flow.expressions(terms), strict=True):
        half = term.powers[0] // 2
        rest = expression / sympy.Symbol("a", real=True) ** term.powers[0]
        found[half] = found.get(half, sympy.S.Zero) + rest
    return [found.get(n, sympy.S.Zero) for n in range(max(found, default=-1) + 1)]


def _decay(c0: sympy.Expr, count: int) -> tuple[sympy.Expr, list[sympy.Expr]]:
    """a = a_0 exp(c_0 t) and the integrals of its even powers."""
    if c0 == 0:
        return START, [START ** (2 * j) * TIME for j in range(count)]
    integrals = [START ** (2 * j) * (sympy.exp(2 * j * c0 * TIME) - 1) / (2 * j * c0) for j in range(1, count)]
    return START * sympy.exp(c0 * TIME), [TIME, *integrals]


def _bernoulli(c0: sympy.Expr, c2: sympy.Expr, count: int) -> tuple[sympy.Expr, list[sympy.Expr]]:
    """The general case, see the head of this file."""
    first, growth = START**2, sympy.exp(2 * c0 * TIME)
    below = 1 - 2 * c2 * first * TIME if c0 == 0 else 1 + c2 / c0 * first * (1 - growth)
    square = first * growth / below
    integrals = [TIME, -sympy.log(below) / (2 * c2)]
    for j in range(2, count):
        rise = (square ** (j - 1) - first ** (j - 1)) / (2 * (j - 1))
        integrals.append((rise - c0 * integrals[-1]) / c2)
    return START * sympy.exp(c0 * TIME) / sympy.sqrt(below), integrals[:count]


def transient(
    flow: SlowFlow,
    time: Sequence[float],
    small: Sequence[float],
    *,
    amplitude: float,
    phase: float = 0.0,
    tolerance: float = 1e-13,
) -> Transient:
    """Follow a slow flow: a and phi at rising times, from their values at the first of them, by Taylor steps in floats.

    A state that has settled is continued in closed form, so that late times cost nothing.

    Parameters
    ----------
    flow : SlowFlow
        All its terms count; of a self-excited oscillator give ``flow.entire()``, since its a does not stay small.
    time : sequence of float
        Rising times.
    small : sequence of float
        One value for each small parameter.
    amplitude : float
        a at the first time, positive, in the unit of u.
    phase : float, optional
        phi at the first time, in rad.
    tolerance : float, optional
        Bound of the relative error of a^2, and of the error of phi in rad, that each step adds.

    Returns
    -------
    Transient
        ``amplitude`` and ``phase`` (rad) at the times.

    Raises
    ------
    InputError
        For times that do not rise or at which the phase has lost its digits, an amplitude that is not positive, and an
        amplitude that runs away, where the truncated flow has lost its meaning.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> flow = multiple_scales(find("damped-pendulum"), 2)
    >>> found = transient(flow, [0.0, 10.0], [0.01], amplitude=0.5).amplitude[1]
    >>> abs(found / (0.5 * math.exp(-0.1)) - 1) < 1e-13
    True
    """
    times = _checked(time, amplitude)
    values = flow.checked(tuple(small))
    rates = _Rates(*(amplitude_powers(rounded(terms), values)[::2] for terms in (flow.growth_rate, flow.frequency)))
    state, t, found = (amplitude * amplitude, phase), times[0], [(amplitude, phase)]
    for end in times[1:]:
        state = _advanced(state, t, end, rates, tolerance)
        if not abs(state[1]) <= MOST_PHASE:
            part = max(0.0, MOST_PHASE - abs(found[-1][1])) / abs(state[1] - found[-1][1])
            fits = t + 0.9 * part * (end - t)
            raise InputError(
                f"the phase at t = {end:.6g} is {state[1]:.3g} rad, too large for its cosine to six decimals in double "
                f"precision; end at t = {fits:.2g} or before"
            )
        found.append((math.sqrt(state[0]), state[1]))
        t = end
    return Transient(times, tuple(a for a, _ in found), tuple(p for _, p in found))


class _Rates(NamedTuple):
    """Coefficients of a'/a and of phi' in powers of s = a^2."""

    delta: list[float]
    omega: list[float]


def _checked(time: Sequence[float], amplitude: float) -> tuple[float, ...]:
    times = tuple(float(t) for t in time)
    if not times or not all(map(math.isfinite, times)) or any(b < a for a, b in pairwise(times)):
        raise InputError("the times of a transient must be finite and rise; give e.g. 0, 1, 2")
    if not (math.isfinite(amplitude) and amplitude > 0):
        raise InputError(f"the starting amplitude {amplitude!r} is not a positive number; use e.g. 0.5")
    if not 1.0 / LARGEST <= amplitude <= LARGEST:
        raise InputError(
            f"the starting amplitude {amplitude:g} is outside {1.0 / LARGEST:g} .. {LARGEST:g}, where its powers are "
            "doubles; use e.g. 0.5"
        )
    return times


def _advanced(state: State, start: float, end: float, rates: _Rates, tolerance: float) -> State:
    """Take Taylor steps from one time to the next, the last one in closed form when the state has settled."""
    t, span = 0.0, end - start
    for _ in range(MOST_STEPS):
        if t >= span:
            return state
        settled = _near_rest(state, span - t, rates) or _near_cycle(state, span - t, rates)
        if settled is not None:
            return settled
        square, phase = _taylor(state, *rates)
        step = min(_step(square, phase, tolerance), span - t)
        if step < span - t and not step > 1e-14 * t:
            raise InputError(
                f"the amplitude of the truncated slow flow runs away at t = {start + t:.6g}; start it smaller, or take "
                "a lower order"
            )
        state = polynomial_value(square, step), polynomial_value(phase, step)
        t = span if step == span - t else t + step
    raise InputError(f"the transient takes more than {MOST_STEPS} steps to t = {end:.6g}; end at {start + t:.2g}")


def _near_rest(state: State, time: float, rates: _Rates) -> State | None:
    """The state after ``time`` when s decays with c_0 < 0 alone, and phi' = w_0 + w_2 s; None when more counts."""
    delta, omega = ([abs(c * state[0] ** n) for n, c in enumerate(row)] for row in rates)
    decay = -2 * rates.delta[0] if delta else 0.0
    if not decay > 0 or sum(delta[1:]) > NEGLIGIBLE * decay or sum(omega[2:]) > NEGLIGIBLE * decay:
        return None
    return _relaxed(state, state[0], decay, time, rates)


def _near_cycle(state: State, time: float, rates: _Rates) -> State | None:
    """The state after ``time`` when it is next to a stable limit cycle, found by a Newton step; None elsewhere."""
    growth = [0.0, *(2 * c for c in rates.delta)]  # s' in powers of s
    slope = _derivative(growth)
    decay, curvature = -polynomial_value(slope, state[0]), abs(polynomial_value(_derivative(slope), state[0]))
    if not decay > 0:
        return None
    y = -polynomial_value(growth, state[0]) / decay
    if abs(y) > SETTLED * state[0] or abs(y) * curvature > 100 * SETTLED * decay:
        return None
    return _relaxed(state, y, decay, time, rates)


def _relaxed(state: State, y: float, decay: float, time: float, rates: _Rates) -> State:
    """Carry the deviation y = s - r from the stable state r through a time, see the head of this file."""
    rest, gone = state[0] - y, -math.expm1(-decay * time)
    drift = polynomial_value(_derivative(rates.omega), rest) * y * gone / decay
    return rest + y * math.exp(-decay * time), state[1] + polynomial_value(rates.omega, rest) * time + drift


def _derivative(coefficients: list[float]) -> list[float]:
    return [n * c for n, c in enumerate(coefficients)][1:]


def _taylor(state: State, delta: list[float], omega: list[float]) -> tuple[list[float], list[float]]:
    """Taylor coefficients of s = a^2 and phi: (n + 1) s_(n+1) = 2 [s delta(s)]_n, (n + 1) phi_(n+1) = [omega(s)]_n."""
    square, phase = Input(FLOATS, [state[0]]), [state[1]]
    of_square = powers(FLOATS, square, max(len(delta), len(omega) - 1, 1))
    growth = Combination(FLOATS, [2 * c for c in delta], of_square[1 : len(delta) + 1])
    turning = Combination(FLOATS, omega, of_square[: len(omega)])
    for n in range(TERMS):
        phase.append(turning.get(n) / (n + 1))
        square.known.append(growth.get(n) / (n + 1))
    return square.known, phase


def _step(square: list[float], phase: list[float], tolerance: float) -> float:
    """The step that makes each of the last two terms a tenth of the tolerance."""
    sizes = [(abs(square[n]) / square[0], n) for n in (TERMS - 1, TERMS)]
    sizes += [(abs(phase[n]), n) for n in (TERMS - 1, TERMS)]
    return min(((0.1 * tolerance / size) ** (1 / n) for size, n in sizes if size > 0), default=math.inf)
