"""Forces with kinks as numbers: located switches, rest by friction, exact orbits and the averaged loss of action."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

import ridgeback
from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.bilinear import Bilinear
from ridgeback.numeric.motion.bilinear_motion import bilinear_motion
from ridgeback.numeric.orbits.averaging import averaged_decay
from ridgeback.numeric.orbits.period import action, exact_frequency

PEAKS = (0.3, 1.0, 1.7)


def test_dry_friction_takes_two_f_from_each_half_cycle_and_then_holds() -> None:
    run = ridgeback.simulate("u'' + 0.15*sign(u') + u = 0", (1.0, 0.0), duration=20.0, rate=8.0)
    assert run.turnings.value == pytest.approx([1.0, -0.7, 0.4, -0.1], abs=1e-11)
    assert run.turnings.time == pytest.approx(np.pi * np.arange(4), abs=1e-10)
    assert run.rest_from == pytest.approx(3 * np.pi, abs=1e-10)
    assert run.u[-1] == pytest.approx(-0.1, abs=1e-11)
    assert run.velocity[-1] == 0
    assert run.crossings.time.size == 3


@pytest.mark.parametrize("c", [0.05, 0.4])
def test_quadratic_damping_has_the_turning_points_of_its_first_integral(c: float) -> None:
    """Between turning points (1 + 2 c A) exp(-2 c A) = (1 - 2 c B) exp(2 c B), from d(u'^2)/du = -2 u + 2 c u'^2."""
    run = ridgeback.simulate(f"u'' + {c}*abs(u')*u' + u = 0", (1.0, 0.0), duration=20.0, rate=8.0)
    size = 1.0
    for value in np.abs(run.turnings.value[1:]):
        level = (1 + 2 * c * size) * math.exp(-2 * c * size)
        size = brentq(lambda b, level=level: (1 - 2 * c * b) * math.exp(2 * c * b) - level, 0.0, size, xtol=1e-15)
        assert value == pytest.approx(size, rel=1e-9)
    assert run.rest_from is None


@settings(deadline=None, max_examples=4)
@given(st.integers(3, 30), st.integers(3, 30), st.integers(0, 5))
def test_bilinear_springs_move_as_their_closed_form(tenths1: int, tenths2: int, hundredths: int) -> None:
    """k1 for u < 0 and k2 for u > 0: two half-planes."""
    k1, k2, mu = tenths1 / 10, tenths2 / 10, hundredths / 100
    text = "u'' + 2*mu*u' + a*max(u, 0) + b*min(u, 0) = 0"
    own = ridgeback.oscillator(
        text, parameters={"mu": mu, "a": Fraction(tenths2, 10) ** 2, "b": Fraction(tenths1, 10) ** 2}
    )
    run = ridgeback.simulate(own, (1.0, 0.0), duration=15.0, rate=4.0)
    closed = bilinear_motion(Bilinear(k1, k2, 0.0, mu=mu), (1.0, 0.0), duration=15.0, rate=4.0)
    assert run.u == pytest.approx(closed.u, abs=1e-9)
    assert run.crossings.time == pytest.approx(closed.crossings.time, abs=1e-9)


@pytest.mark.parametrize("equation", ["u'' + u**(1/3) = 0", "u'' + u*abs(u) = 0", "u'' + u - sin(u) = 0"])
def test_forces_without_a_linear_part_take_their_exact_period(equation: str) -> None:
    run = ridgeback.simulate(equation, (1.0, 0.0), duration=40.0, rate=4.0)
    quarter = math.pi / 2 / float(ridgeback.enclose(equation, 1).middle)
    assert run.crossings.time[:3] == pytest.approx([quarter, 3 * quarter, 5 * quarter], rel=1e-9)


@pytest.mark.parametrize(
    "equation",
    ["u'' + u + u*abs(u) = 0", "u'' + 4*max(u, 0) + min(u, 0) + u**2/9 = 0", "u'' + u + abs(u)**(3/2)*sign(u)/5 = 0"],
)
def test_quadrature_on_each_side_is_exact_to_rounding(equation: str) -> None:
    dynamics = ridgeback.bind(equation)
    table = exact_frequency(dynamics, PEAKS)
    exact = [float(ridgeback.enclose(equation, peak).middle) for peak in PEAKS]
    assert table.omega == pytest.approx(exact, rel=2e-14)
    above, below = (action(dynamics, np.array(PEAKS) + h) for h in (1e-4, -1e-4))
    slope = np.asarray(dynamics.restoring(PEAKS)) / table.omega  # type: ignore[misc]
    assert (above - below) / 2e-4 == pytest.approx(slope, rel=1e-6)  # dJ/dE = 1/omega0


def test_the_averaged_action_falls_as_dry_friction_takes_it() -> None:
    """A' = -2 F/pi for a linear spring with k = 1, exactly on the average."""
    time = np.array([0.0, 7.0, 20.0])
    decay = averaged_decay(ridgeback.bind("u'' + 0.02*sign(u') + u = 0"), (1.5, 0.0), time)
    assert decay.peak == pytest.approx(1.5 - 2 * 0.02 / np.pi * time, abs=1e-9)
    with pytest.raises(InputError, match="comes to rest"):
        averaged_decay(ridgeback.bind("u'' + 0.02*sign(u') + u = 0"), (1.5, 0.0), [200.0])


def test_averaging_follows_a_mixed_decay_to_second_order_in_the_losses() -> None:
    equation = "u'' + 0.004*abs(u')*u' + 0.003*sign(u') + 0.002*u' + u + u*abs(u)/2 = 0"
    run = ridgeback.simulate(equation, (1.5, 0.0), duration=60.0, rate=4.0)
    peaks = run.turnings.value[::2]
    decay = averaged_decay(ridgeback.bind(equation), (1.5, 0.0), run.turnings.time[::2])
    assert decay.peak == pytest.approx(peaks, rel=3e-5)


@pytest.mark.parametrize(
    ("call", "why"),
    [
        (lambda: ridgeback.simulate("u'' + sign(u')/2 + u = 0", (0.3, 0.0)), "friction holds"),
        (lambda: ridgeback.simulate("u'' + sign(u')/2 + u = 0", (2.0, 0.0), method="taylor"), "kinks"),
    ],
)
def test_what_cannot_move_is_refused(call: object, why: str) -> None:
    with pytest.raises(InputError, match=why):
        call()  # type: ignore[operator]
