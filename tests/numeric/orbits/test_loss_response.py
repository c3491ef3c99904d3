"""The second order of losses in phi' and the sines of u, against exact series and integrated equations."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

import ridgeback
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, pendulum
from ridgeback.numeric.orbits.loss_response import EXPONENTS, POINTS, Acting, OfPotential, linear_parts, primitive
from ridgeback.numeric.orbits.orbit_table import orbit_table
from ridgeback.numeric.orbits.slow_flow import decay_flow, motion, refine
from ridgeback.symbolic.flow.second_order import Shape, coefficient

COARSE = np.sin(np.arange(1, 33) * (np.pi / 64))
CLOSE = 1e-3
"""Of the larger pairs: dry friction jumps, and 64 phases take it by the trapezoidal rule."""


def test_the_integral_over_the_phase_is_that_of_every_harmonic_it_can_see() -> None:
    phase = (np.arange(POINTS) + 0.5) * (2 * np.pi / POINTS)
    for m in range(1, POINTS // 2):
        assert np.allclose(primitive(3.0 + np.cos(m * phase)), np.sin(m * phase) / m, rtol=0.0, atol=1e-14)
        assert np.allclose(primitive(np.sin(m * phase)[None, None]), -np.cos(m * phase) / m, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize(("i", "j"), list(combinations_with_replacement(range(4), 2)))
def test_pairs_of_losses_on_a_cosine_are_the_exact_ones(i: int, j: int) -> None:
    """In the rationals and 1/pi, by the other route: harmonics on quarters of a cycle."""

    def exact(one: int, other: int) -> float:
        sides = [(s, q) for s in (1, -1) for q in (1, -1)]
        shapes = [(Shape(0, EXPONENTS[one], s), Shape(0, EXPONENTS[other], q)) for s, q in sides]
        return float(sum(coefficient(a, b) for a, b in shapes))

    expected = exact(i, j) if i == j else exact(i, j) + exact(j, i)
    acting = Acting(tuple(sorted({i, j})))
    assert linear_parts(acting)[acting.pairs.index((i, j))] == pytest.approx(expected, rel=CLOSE, abs=CLOSE)


def test_linear_damping_of_a_linear_force_has_no_third_order() -> None:
    """Its a'/a is -mu exactly."""
    acting = Acting((0,))
    assert linear_parts(acting)[len(acting.pairs)] == pytest.approx(0.0, abs=1e-12)


# u = +-F + (A_n - F) cos, A_(n+1) = A_n - 2F, in each half cycle, which takes pi
def test_the_third_order_of_dry_friction_is_that_of_its_exact_motion() -> None:
    """The fundamental under a window of two cycles falls by a little less than 2F from one half cycle to the next."""
    friction, n = 0.03, np.arange(20)
    swing = 1.0 - friction * (2 * n + 1)

    def fundamental(cycles: int) -> float:
        s = (np.arange(4096) + 0.5) / 4096 - 0.5
        t = (cycles + 4 * s) * np.pi
        half = (t / np.pi).astype(int)
        x = friction * (-1.0) ** half + swing[half] * np.cos(t)
        return float(2 * np.abs(np.mean(x * (1 + np.cos(2 * np.pi * s)) * np.exp(-1j * t))))

    for at in (4, 8):
        begin, end = fundamental(at), fundamental(at + 1)
        less = 1.0 - (begin - end) / (2 * friction)
        third = -0.25 * np.pi * float(linear_parts(Acting((3,)))[1]) * (2 * friction / (begin + end)) ** 2
        assert less == pytest.approx(third, rel=0.06)


@pytest.mark.parametrize(
    ("dynamics", "force"),
    [(pendulum(), "sin(u)"), (helmholtz_duffing(alpha=0.3, eps=0.2), "u + 3/10*u**2 + 1/5*u**3")],
)
def test_linear_damping_shifts_phi_as_multiple_scales_do(dynamics: Dynamics, force: str) -> None:
    """The terms of phi' with mu^2, through a^6, at amplitudes of the first harmonic."""
    peak = np.array([0.1, 0.3, 0.5])
    a = orbit_table(dynamics, peak).cosine[1]
    terms = ridgeback.multiple_scales(f"u'' + 2*mu*u' + {force} = 0", 10).frequency
    expected = sum(float(t.coefficient) * a ** t.powers[0] for t in terms if t.powers[1] == 2)
    shift = OfPotential(orbit_table(dynamics, 1.2 * COARSE), peak).under([2.0]).shift
    assert np.allclose(shift, expected, rtol=0.0, atol=2e-4)


# u'' + r0 u' + r1 |u'| u' + r2 u'^3 + u + e u^3 = 0
@pytest.mark.parametrize("rates", [(0.06, 0.0, 0.0), (0.01, 0.12, 0.0), (0.01, 0.0, 0.12)])
def test_the_integrated_motion_is_followed_to_second_order(rates: tuple[float, float, float]) -> None:
    """Waveform and phase over the whole decay, start fitted: what is left is of second order in the losses."""

    def left(scale: float) -> float:
        r = [scale * rate for rate in rates]
        time = np.arange(0.0, 40.0 / scale, 0.4)

        def slope(_: float, state: Array) -> list[float]:
            u, v = state
            return [v, -r[0] * v - r[1] * abs(v) * v - r[2] * v**3 - u - 0.4 * u**3]

        u = solve_ivp(slope, (0.0, time[-1]), (1.0, 0.0), "DOP853", time, rtol=1e-9, atol=1e-11).y[0]
        orbits = refine(orbit_table(duffing(eps=0.4), 1.3 * COARSE), np.geomspace(2e-3, 1.3, 240))
        flow = decay_flow(orbits, k=1.0, length=1.0, rates=tuple(r))

        def off(begin: Array) -> Array:
            return np.asarray(motion(flow, float(begin[0]), float(begin[1]), time).u - u)

        return float(np.abs(least_squares(off, (-np.log(0.6), 0.0), xtol=1e-10).fun).max())

    coarse, fine = left(1.0), left(0.5)
    assert coarse < 1.5e-3
    assert fine < 0.4 * coarse or fine < 2e-4  # four harmonics of the waveform
