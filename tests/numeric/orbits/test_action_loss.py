"""The averaged loss of action: closed forms, what linear damping gives, growth onto a limit cycle, second order."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.cycle_frequency import cycle_frequency
from ridgeback.numeric.motion.dynamics import Dynamics, helmholtz_duffing, linear, pendulum
from ridgeback.numeric.motion.events import Switches
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.orbits import action_loss
from ridgeback.numeric.orbits.action_loss import _followed, averaged_action, cycles_of, require_odd_damping
from ridgeback.numeric.orbits.averaging import averaged_decay


def damped(oscillator: Dynamics, loss) -> Dynamics:
    """The same oscillator with the damping force d(u, u')."""
    return replace(oscillator, force=lambda u, v: oscillator.force(u, v) + loss(u, v), jet=None)


def test_cubic_damping_of_a_linear_spring_has_a_closed_form() -> None:
    """R = c <u'^4> / (omega0 J) = 3 c J / 2 at k = 1, so that J = J0 / (1 + 3 c J0 t / 2)."""
    time = np.array([0.0, 3.0, 50.0, 400.0])
    found = averaged_action(damped(linear(), lambda _, v: 0.1 * v**3), 0.8, time)
    assert found == pytest.approx(0.8 / (1 + 0.15 * 0.8 * time), rel=1e-8)


def test_dry_friction_takes_a_like_share_of_every_swing_until_it_rests() -> None:
    """u'' + u + c sign u' = 0: A = A0 - 2 c t / pi, followed to where J has fallen by 10^-6."""
    c, peak = 0.01, 2.0
    switches = Switches((), True, lambda _, side: lambda u, _: u + c * side)
    dry = Dynamics("dry", lambda u, v: u + c * np.sign(v), 1.0, restoring=np.asarray, switches=switches)
    time = np.array([0.999]) * np.pi * peak / (2 * c)
    found = averaged_action(dry, 0.5 * peak**2, time)
    assert found == pytest.approx(0.5 * (peak - 2 * c * time / np.pi) ** 2, rel=1e-4)


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_a_table_of_the_loss_is_as_right_in_any_unit(unit: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A rate that bends sharply, unit / (1 + 4 x^2) of x = ln J."""

    def rate(x: np.ndarray) -> np.ndarray:
        return unit / (1 + 4 * x**2)

    monkeypatch.setattr(action_loss, "cycles_of", lambda _, J: [SimpleNamespace(rate=rate(np.log(x))) for x in J])
    monkeypatch.setattr(action_loss, "peak_of_action", lambda _, J: J)
    table, x = action_loss._polynomial(linear(), -1.0, 1.0, lambda x: x), np.linspace(-1.0, 1.0, 101)
    assert np.abs(table(x) - rate(x)).max() < 1e-8 * unit


@pytest.mark.parametrize("time", [[0.0], [1.0, 0.0, -2.0, 0.5], [3.0], [-3.0]])
def test_a_table_is_followed_both_ways_from_time_0(time: list[float]) -> None:
    """(ln J)' = -2 ln J, the logarithm being 5 at time 0."""
    found = _followed(lambda x: 2.0 * x, 5.0, -1.0, np.array(time))
    assert found == pytest.approx(5.0 * np.exp(-2.0 * np.array(time)), rel=1e-9)
    assert _followed(lambda x: 2.0 * x, 5.0, 4.0, np.array([1.0])) is None


def test_linear_damping_takes_the_same_share_in_any_potential() -> None:
    time = np.linspace(0.0, 40.0, 9)
    for oscillator in (pendulum(1.3), helmholtz_duffing(1.0, 0.2, 0.1)):
        found = averaged_action(damped(oscillator, lambda _, v: 0.05 * v), 0.4, time)
        assert found == pytest.approx(0.4 * np.exp(-0.05 * time), rel=1e-8)


def test_growth_ends_on_the_limit_cycle_of_van_der_pol() -> None:
    """P vanishes at A = 2, J = 2, whatever eps; below it the action grows, above it falls (van der Pol 1926)."""
    oscillator = damped(linear(), lambda u, v: -0.1 * (1 - u * u) * v)
    time = np.array([0.0, 5.0, 300.0])
    low, high = (averaged_action(oscillator, start, time) for start in (0.1, 4.0))
    assert low[1] > 0.1
    assert high[1] < 4.0
    assert (low[2], high[2]) == pytest.approx((2.0, 2.0), rel=1e-6)
    # J' = eps J (1 - J / 2): the logistic law
    assert low[1] == pytest.approx(2 / (1 + (2 / 0.1 - 1) * np.exp(-0.5)), rel=1e-7)


def test_the_ripple_has_no_mean_and_the_start_is_corrected_by_it() -> None:
    oscillator = damped(pendulum(), lambda _, v: 0.03 * v**3)
    (cycle,) = cycles_of(oscillator, np.array([1.5]))
    phases = np.linspace(-np.pi, np.pi, 64, endpoint=False)
    ripple = np.array([cycle.ripple(x) for x in phases])
    assert abs(ripple.mean()) < 1e-12 * np.abs(ripple).max()
    assert np.abs(ripple).max() > 1e-3
    assert abs(cycle.ripple(0.0)) < 1e-12


@pytest.mark.parametrize("start", [(1.4, 0.0), (0.8, 0.9)])
def test_omega_is_right_to_second_order_in_the_damping(start: tuple[float, float]) -> None:
    """Halving the damping over twice the time divides the error by four, wherever the motion begins."""
    errors = []
    for share in (1.0, 0.5):
        c = 0.03 * share
        oscillator = damped(pendulum(), lambda _, v, c=c: c * v**3)
        run = integrate(oscillator, start, duration=120.0 / share, rate=4.0)
        reference = cycle_frequency(run, dynamics=oscillator).at(run.time)
        model = averaged_decay(oscillator, start, run.time).omega
        inside = slice(run.time.size // 10, -run.time.size // 10)
        errors.append(float(np.sqrt(np.mean((model / reference - 1)[inside] ** 2))))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert errors[0] < 2e-5


def test_refusals() -> None:
    with pytest.raises(InputError, match="do not change sign with u'"):
        require_odd_damping(damped(linear(), lambda u, v: u * v * v), 1.0)
    growing = damped(pendulum(), lambda _, v: -0.1 * v)
    with pytest.raises(InputError, match="grows out of its well"):
        averaged_action(growing, 1.0, np.array([0.0, 100.0]))
