"""The second order in losses that are not analytic at rest: sums, multiple scales, exact half cycles, integration."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.flow.loss_flow import SecondOrder
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import U, V

a, c, F, k, mu = (sympy.Symbol(name, real=True) for name in ("a", "c", "F", "k", "mu"))
SMALL = st.fractions(Fraction(-1), Fraction(1), max_denominator=4)
TINY = 1e-3


def test_quadratic_damping_and_dry_friction_change_the_phase() -> None:
    flow = averaged_losses("u'' + c*abs(u')*u' + F*sign(u') + k**2*u = 0", 4)
    second = (
        k * c**2 * a**2 * (40 / (27 * sympy.pi**2) - sympy.Rational(1, 6))
        - 16 * c * F / (9 * sympy.pi**2 * k)
        - 6 * F**2 / (sympy.pi**2 * a**2 * k**3)
    )
    assert sympy.expand(flow.frequency_expression() - k - second) == 0
    assert flow.second is SecondOrder.WHOLE
    assert flow.to_dict()["loss_order"] == 2


def test_the_coefficient_of_quadratic_damping_is_the_sum_over_the_odd_harmonics() -> None:
    """|sin| sin = sum of -8/(pi n (n^2 - 4)) sin n phi, |sin| = sum of -4/(pi (m^2 - 1)) cos m phi (half of m = 0)."""

    def lost(n: int) -> mpmath.mpf:
        return 8 / (mpmath.pi * n * (n * n - 4))

    def steep(n: int) -> mpmath.mpf:
        return -2 / mpmath.pi * (1 / ((n - 1) ** 2 - mpmath.mpf(1)) + 1 / ((n + 1) ** 2 - mpmath.mpf(1)))

    def term(j: mpmath.mpf) -> mpmath.mpf:
        n = 2 * int(j) + 1
        return n * lost(n) / (n * n - 1) * steep(n)

    rate = lost(1) / 2
    pull = 2 * (mpmath.nsum(term, [1, mpmath.inf]) + rate * steep(1))
    exact = 40 / (27 * mpmath.pi**2) - mpmath.mpf(1) / 6
    assert abs((2 * rate**2 + pull) / 2 - exact) < 1e-14


@pytest.mark.parametrize("loss", ["2*mu*u' + d*u'**3", "mu*u' + d*u**2*u'", "d*u**2*u'**3 + mu*u'**5"])
def test_analytic_losses_have_the_second_order_of_multiple_scales(loss: str) -> None:
    equation = f"u'' + {loss} + u = 0"
    mine = sympy.expand(averaged_losses(equation, 8).frequency_expression())
    whole = sympy.expand(multiple_scales(equation, 14).frequency_expression())
    t = sympy.Symbol("t")
    small = {s: t * s for s in mine.free_symbols - {a}}
    assert sympy.expand(mine.subs(small) - 1 - t**2 * sympy.expand(whole.subs(small)).coeff(t, 2)) == 0


def test_the_reason_is_said_where_there_is_none() -> None:
    expected = {
        "u'' + sign(u') + u + u**3 = 0": SecondOrder.LINEAR,
        "u'' + sign(u') + u + u*abs(u) = 0": SecondOrder.LINEAR,
        "u'' + sign(u') + 4*max(u, 0) + min(u, 0) = 0": SecondOrder.UNKNOWN,
        "u'' + abs(u')**(1/2)*sign(u') + u = 0": SecondOrder.UNKNOWN,
    }
    for equation, second in expected.items():
        flow = averaged_losses(equation, 6)
        assert flow.second is second, equation
        assert any(term.powers[0] == -2 for term in flow.frequency) == (second is SecondOrder.LINEAR)
    assert averaged_losses("u'' + sign(u') + u = 0", 3).second is SecondOrder.BELOW


@settings(deadline=None, max_examples=5)
@given(c=SMALL, b=SMALL, d=SMALL, f=SMALL)
def test_cycles_between_crossings_take_what_the_second_order_says(
    c: Fraction, b: Fraction, d: Fraction, f: Fraction
) -> None:
    """T - 2 pi = 2 pi (D' A1 - B2), with D = -u1/a the phase of the crossing against the cosine's."""
    losses = f"({c})*abs(u')*u' + ({f})*sign(u') + u'/3 + ({b})*abs(u)*u' + ({d})*u*abs(u')*u'"
    flow = averaged_losses(f"u'' + {losses} + u = 0", 8)
    rates = [1 / 6] if "mu" in flow.losses else []
    phi = (np.arange(4096) + 0.5) * 2 * math.pi / 4096
    own = as_oscillator(f"u'' + {losses} + u = 0").substituted_force
    loss = sympy.lambdify((U, V), own - U, ["numpy"])
    harmonics = np.arange(2, 60)

    def crossing(size: float) -> float:
        values = loss(size * np.cos(phi), -size * np.sin(phi))
        sines = 2 * np.mean(values * np.sin(np.outer(harmonics, phi)), axis=1)
        return -float(np.sum(sines / (harmonics**2 - 1) * np.sin(1.5 * math.pi * harmonics))) / size

    time, start, end = cycle(own)
    size = (start + end) / 2
    drift = (crossing(size * 1.001) - crossing(size * 0.999)) / (0.002 * size)
    second = float(flow.frequency_at(size, *rates)) - 1
    rate = size * float(flow.growth_rate_at(size, *rates))
    expected = 2 * math.pi * (drift * rate - second)
    assert (time - 2 * math.pi) / TINY**2 == pytest.approx(expected, rel=0.02, abs=0.02)


def cycle(force: sympy.Expr) -> tuple[float, float, float]:
    """From one upward crossing of u = 0 to the next, losses times ``TINY``: the time, and both speeds."""
    law = sympy.lambdify((U, V), U + TINY * (force - U), ["math", {"sign": np.sign}])
    time, state = 0.0, (0.0, 1.0)
    for part, sign in ((1, 1.0), (0, 1.0), (1, -1.0), (0, -1.0)):

        def stop(t: float, y: np.ndarray, part: int = part, sign: float = sign) -> float:
            return float(y[part]) if t > 1e-3 else sign

        stop.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(
            lambda _, y: (y[1], -law(y[0], y[1])), (0, 9), state, "DOP853", events=stop, rtol=1e-13, atol=1e-15
        )
        time += float(run.t_events[0][0])
        state = tuple(float(x) if i != part else 0.0 for i, x in enumerate(run.y_events[0][0]))  # type: ignore[assignment]
    return time, 1.0, state[1]
