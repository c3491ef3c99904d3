"""Slowly drifting parameters: the action against exact solutions, WKB, and integrated motions of every kind."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from scipy.special import jv, yv

from ridgeback.common.errors import InputError
from ridgeback.compare.drift.comparison import compare_drift, sentences
from ridgeback.interface.simulate import simulate
from ridgeback.symbolic.systems.oscillator import Oscillator

SWING = Oscillator.from_equation("x'' + g/L*sin(x) = 0", parameters={"g": 1})
SPRING = Oscillator.from_equation("x'' + g/L*x = 0", parameters={"g": 1})


def test_the_integrated_motion_is_the_exact_one() -> None:
    """u'' + u/s = 0, s = 1 + r t, has u = sqrt(s) Z_1(2 sqrt(s)/r) with Bessel functions Z_1 (DLMF 10.13.4)."""
    r = 0.02
    run = simulate(SPRING, (1.0, 0.0), duration=120.0, rate=4.0, drift={"L": f"1 + {r}*t"})
    s = 1 + r * run.time
    z, one = 2 * np.sqrt(s) / r, 2 / r
    basis = np.array([np.sqrt(s) * jv(1, z), np.sqrt(s) * yv(1, z)])
    # d/ds of sqrt(s) Z_1(2 sqrt(s)/r) is Z_0(2 sqrt(s)/r)/r, and d/dt is r times that
    start = np.array([[jv(1, one), yv(1, one)], [jv(0, one), yv(0, one)]])
    a, b = np.linalg.solve(start, [1.0, 0.0])
    assert np.abs(run.u - (a * basis[0] + b * basis[1])).max() < 1e-9


@pytest.mark.parametrize("initial", [(1.0, 0.0), (0.3, 0.7)])
def test_of_a_linear_oscillator_the_error_is_the_one_that_is_expected(initial: tuple[float, float]) -> None:
    """A goes like omega^(-1/2), and omega/W - 1 = omega''/(4 omega^3) - 3 omega'^2/(8 omega^4) at any time."""
    found = compare_drift(SPRING, {"L": "1+0.02*t"}, initial=initial, duration=150.0, rate=8.0)
    inside = found.interior.interior(found.trajectory.time)
    assert np.allclose(found.error[inside], found.adiabatic.expected_error[inside], rtol=2e-3)
    assert found.max_error > 1e-5  # it is there, and no rounding
    scaled = found.adiabatic.peak * np.sqrt(found.adiabatic.omega)
    assert np.allclose(scaled, scaled[0], rtol=1e-9)
    turns = found.trajectory.turnings
    size = np.abs(turns.value) * (1 + 0.02 * turns.time) ** -0.25
    assert np.allclose(size, scaled[0], rtol=1e-4)


@pytest.mark.parametrize("initial", [(1.2, 0.0), (0.6, 0.7)])
def test_the_error_of_a_pendulum_is_of_second_order_in_the_rate(initial: tuple[float, float]) -> None:
    errors = []
    for rate in (0.02, 0.01):
        found = compare_drift(SWING, {"L": f"1+{rate}*t"}, initial=initial, duration=1.5 / rate, rate=8.0)
        errors.append(found.max_error)
        assert found.max_error == pytest.approx(found.expected_error, rel=0.2)  # a linear oscillator's, nearly
        assert found.frozen_error > 0.2
        assert found.disagreement < 1e-7
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_a_real_pendulum_keeps_the_action_of_its_own_momentum() -> None:
    """With L' = c the equation is x'' + 2 (c/L) x' + g/L sin x = 0, whose invariant is the integral of L^2 x' dx."""
    own = Oscillator.from_equation("x'' + 2*c/L*x' + g/L*sin(x) = 0", parameters={"g": 1, "c": "0.01"})
    found = compare_drift(own, {"L": "1+0.01*t"}, initial=(1.0, 0.4), duration=100.0, rate=8.0)
    kept = found.adiabatic.action * (1 + 0.01 * found.adiabatic.time) ** 2
    assert np.allclose(kept, kept[0], rtol=1e-6)
    assert found.max_error < 1e-4
    turns = found.trajectory.turnings
    assert np.allclose(
        np.abs(turns.value), np.interp(turns.time, found.adiabatic.time, found.adiabatic.peak), rtol=0.02
    )


@settings(max_examples=3, phases=[Phase.generate])
@given(
    st.fractions(-1, 1, max_denominator=10),
    st.fractions(0, 1, max_denominator=10),
    st.sampled_from(["1+t/200", "1-t/400", "1+sin(t/40)/5", "exp(t/300)"]),
    st.sampled_from(["0", "1/100"]),
    st.floats(0.1, 0.6),
    st.floats(-0.5, 0.5),
)
def test_asymmetric_lossy_oscillators_follow_their_action(b, c, law, loss, u, v) -> None:  # type: ignore[no-untyped-def]
    """Quadratic and cubic force, a cubic loss, k drifting, from any phase: within a few squares of the rates."""
    text = "x'' + d*x'**3 + k**2*x + b*x**2/2 + c*x**3 = 0"
    own = Oscillator.from_equation(text, parameters={"b": str(b), "c": str(c), "d": loss})
    found = compare_drift(own, {"k": law}, initial=(u, v), duration=60.0, rate=8.0)
    assert found.max_error is not None
    assert found.max_error < 8 * (found.rate + float(Fraction(loss))) ** 2


@pytest.mark.parametrize(
    ("system", "laws", "said"),
    [
        (SWING, {"L": "1-0.1*t"}, "the force stops restoring by t = 9.9.* use a duration below"),
        (SWING, {"L": "1+0.1*t", "h": "t"}, "no parameter 'h'"),
        (SWING, {"L": "1+c*t"}, "drift of L: c is not known there"),
        (SWING, {"L": "2"}, "does not change with t"),
        (SWING, {"L": "sqrt(2+t)"}, "is irrational"),
        (SWING, {"L": "1/t"}, "has no power series at t = 0"),
        (SWING, {"L": "t"}, "at t = 0, where L = 0"),
        (SWING, {"L": "1+*t"}, "unexpected"),
        (SWING, {"L": "1+__import__('os')*t"}, "drift of L"),
        (SWING, {}, "no parameter drifts"),
        ("pendulum", {"k": "1-t/50"}, "passes through zero"),
        ("duffing", {"k": "1+0.2*sin(20*t)"}, "too often"),
        ("van-der-pol", {"eps": "1+t/100"}, "no action is conserved"),
        ("bilinear", {"k1": "1+t/100"}, "kinks"),
        ("u'' + c*u**3 = 0", {"c": "1+t/100"}, "without a linear force"),
    ],
)
def test_what_has_no_slow_drift_is_refused(system: object, laws: dict[str, str], said: str) -> None:
    with pytest.raises(InputError, match=said) as refused:
        compare_drift(system, laws)  # type: ignore[arg-type]
    assert "\n" not in str(refused.value)


def test_a_fast_drift_is_called_one() -> None:
    found = compare_drift(SPRING, {"L": "1+t"}, duration=40.0, rate=16.0)
    assert not found.adiabatic.is_slow
    assert "this is no slow drift" in sentences(found)[0]
    assert "this is no slow drift" not in sentences(compare_drift(SPRING, {"L": "1+t/50"}, duration=40.0))[0]
