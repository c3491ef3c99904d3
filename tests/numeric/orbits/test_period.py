"""Exact frequency and action: elliptic closed forms at mpmath precision, a slow twin, limits and inverses."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.orbits.orbit_table import orbit_table
from ridgeback.numeric.orbits.period import action, exact_frequency, peak_limit, peak_of_action, stretch, trough
from ridgeback.numeric.orbits.potential import peak_of_potential, potential_at

MORSE = Dynamics(
    "morse",
    lambda u, v: math.exp(-u) * -math.expm1(-u) + 0 * v,
    1.0,
    restoring=lambda u: np.exp(-np.asarray(u)) * -np.expm1(-np.asarray(u)),
)
MIRRORED_MORSE = Dynamics(
    "mirrored-morse",
    lambda u, v: math.exp(u) * math.expm1(u) + 0 * v,
    1.0,
    restoring=lambda u: np.exp(np.asarray(u)) * np.expm1(np.asarray(u)),
)


def test_the_nodes_are_spread_by_the_distance_of_the_poles():
    """c = sqrt(delta), cosh(delta) = 1 + share: g vanishes beyond the turning points, at the end of the well."""
    for left in (1e-3, 1e-6):
        share, c = stretch(pendulum(), np.array([left - math.pi]), np.array([math.pi - left]))
        assert float(share[0]) == pytest.approx(left / (math.pi - left), rel=1e-9)
        assert float(c[0]) ** 2 == pytest.approx(math.acosh(1.0 + float(share[0])), rel=float(share[0]))


def test_the_energy_of_the_separatrix_is_outside_the_well():
    for oscillator in (pendulum(), pendulum(1.7)):
        most = float(potential_at(oscillator, peak_limit(oscillator))[0])
        assert peak_of_potential(oscillator, most * (1 - 1e-12))[0] < math.pi
        with pytest.raises(InputError, match="outside the well"):
            peak_of_potential(oscillator, most)


def test_a_force_that_bends_sharply_has_its_potential_all_the_same():
    """The integral of tanh(c u) is log(cosh(c u))/c."""
    c = 60.0
    sharp = Dynamics("sharp", lambda u, _: math.tanh(c * u), c**0.5, restoring=lambda u: np.tanh(c * np.asarray(u)))
    u = np.array([0.01, 0.3, 1.0])
    assert np.allclose(potential_at(sharp, u), np.log(np.cosh(c * u)) / c, rtol=1e-10)


def test_rest_has_no_turning_points_but_itself():
    assert trough(helmholtz_duffing(1.0, 0.2, 0.1), [0.0, 1.0])[0] == 0.0


def pendulum_exact(peak):
    with mp.workdps(40):
        return float(mp.pi / (2 * mp.ellipk(mp.sin(mp.mpf(peak) / 2) ** 2)))


def pendulum_action(peak):
    """J = (8 / pi) (E(m) - (1 - m) K(m)), m = sin^2(A/2)."""
    with mp.workdps(40):
        m = mp.sin(mp.mpf(peak) / 2) ** 2
        return float(8 / mp.pi * (mp.ellipe(m) - (1 - m) * mp.ellipk(m)))


def duffing_exact(eps, peak):
    with mp.workdps(40):
        stiff = mp.mpf(eps) * mp.mpf(peak) ** 2
        return float(mp.pi * mp.sqrt(1 + stiff) / (2 * mp.ellipk(stiff / (2 * (1 + stiff)))))


AMPLITUDES = np.array([1e-12, 1e-6, 0.01, 0.5, 1.5, 2.5, 0.95 * math.pi, 3.1, math.pi - 1e-3])


def test_pendulum_to_rounding():
    table = exact_frequency(pendulum(1.0), AMPLITUDES)
    exact = np.array([pendulum_exact(A) for A in AMPLITUDES])
    assert np.allclose(table.omega, exact, rtol=1e-15)
    assert np.allclose(pendulum(1.0).closed_form(AMPLITUDES), exact, rtol=1e-15)
    assert np.array_equal(table.trough, -AMPLITUDES)


@pytest.mark.parametrize("distance", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_error_estimate_covers_the_error_up_to_the_separatrix(distance):
    table = exact_frequency(pendulum(1.0), math.pi - distance)
    error = abs(table.omega[0] - pendulum_exact(math.pi - distance))
    assert error <= table.error[0]
    assert table.error[0] < 1e-15 + 1e-17 / distance


@pytest.mark.parametrize(("eps", "peaks"), [(1.0, (0.1, 1.0, 30.0)), (-1.0, (0.1, 0.9, 0.999))])
def test_duffing_to_rounding(eps, peaks):
    table = exact_frequency(duffing(eps=eps), peaks)
    exact = [duffing_exact(eps, A) for A in peaks]
    assert np.allclose(table.omega, exact, rtol=2e-15)
    assert np.allclose(duffing(eps=eps).closed_form(peaks), exact, rtol=1e-15)


def slow_period(coefficients, peak):
    """The obvious twin: T = 2 integral du / sqrt(2 (E - V)), by mpmath's tanh-sinh at 30 digits."""
    with mp.workdps(30):
        V = [mp.mpf(c) / (n + 2) for n, c in enumerate(coefficients)]

        def potential(u):
            return sum(v * u ** (n + 2) for n, v in enumerate(V))

        energy = potential(mp.mpf(peak))
        low = mp.findroot(lambda u: potential(u) - energy, -mp.mpf(peak))
        return float(2 * mp.quad(lambda u: 1 / mp.sqrt(2 * abs(energy - potential(u))), [low, 0, peak])), float(low)


@pytest.mark.parametrize("peak", [0.3, 1.0, 2.0])
def test_asymmetric_potential_against_a_slow_twin(peak):
    table = exact_frequency(helmholtz_duffing(1.0, 0.3, 0.1), peak)
    period, low = slow_period((1.0, 0.3, 0.1), peak)
    assert table.omega[0] == pytest.approx(2 * math.pi / period, rel=1e-12)
    assert table.trough[0] == pytest.approx(low, rel=1e-14)


def test_morse_oscillator_is_known_in_closed_form():
    """V = (1 - e^-u)^2 / 2: omega0 = sqrt(1 - 2E), J = 1 - sqrt(1 - 2E) (Landau and Lifshitz, Mechanics, 12)."""
    peaks = np.array([0.1, 1.0, 3.0])
    energy = 0.5 * np.expm1(-peaks) ** 2
    table = exact_frequency(MORSE, peaks)
    assert np.allclose(table.omega, np.sqrt(1 - 2 * energy), rtol=1e-13)
    assert np.allclose(table.action, 1 - np.sqrt(1 - 2 * energy), rtol=1e-12)
    assert np.allclose(table.trough, -np.log1p(np.sqrt(2 * energy)), rtol=1e-14)


@settings(deadline=None, max_examples=25)
@given(peak=st.floats(0.01, 3.1), k=st.floats(0.1, 50))
def test_action_of_the_pendulum_and_its_inverse(peak, k):
    J = action(pendulum(k), peak)
    assert J[0] == pytest.approx(k * pendulum_action(peak), rel=1e-13)
    assert peak_of_action(pendulum(k), J)[0] == pytest.approx(peak, rel=1e-12)


@settings(deadline=None, max_examples=25)
@given(peak=st.floats(0.05, 2.5), alpha=st.floats(-0.4, 0.4))
def test_slope_of_the_action_is_one_over_the_frequency(peak, alpha):
    """dJ/dE = 1 / omega0, in any potential."""
    oscillator = helmholtz_duffing(1.0, alpha, 0.2)
    step = 1e-3 * peak
    peaks = peak + step * np.array([-2, -1, 1, 2])
    J, E = action(oscillator, peaks), oscillator.potential(peaks)
    weights = np.array([1, -8, 8, -1])
    table = exact_frequency(oscillator, peak)
    assert weights @ J / (weights @ E) == pytest.approx(1 / table.omega[0], rel=1e-8)


def test_action_amplitude_tends_to_the_peak():
    """sqrt(2 J / k) / A - 1 falls like A^2 (pendulum: -5 A^2 / 192)."""
    peaks = np.array([0.2, 0.1])
    ratio = np.sqrt(2 * action(pendulum(3.0), peaks) / 3.0) / peaks - 1
    assert ratio[0] / ratio[1] == pytest.approx(4.0, rel=0.01)
    assert ratio[1] == pytest.approx(-0.05 / 192, rel=0.01)


def test_zero_amplitude_is_the_natural_frequency():
    table = exact_frequency(pendulum(3.0), [0.0, 1e-9])
    assert table.omega == pytest.approx([3.0, 3.0], rel=1e-15)
    assert table.action[0] == 0


def test_convergence_is_geometric():
    """A loose tolerance stops early, and its error is still below what it reports."""
    loose = exact_frequency(pendulum(), 3.0, tolerance=1e-3)
    error = abs(loose.omega[0] - pendulum_exact(3.0))
    assert error <= loose.error[0]
    assert error < 1e-6


def test_limits():
    assert peak_limit(pendulum()) == pytest.approx(math.pi, rel=1e-15)
    assert peak_limit(duffing(eps=2.0)) == math.inf
    assert peak_limit(linear()) == math.inf
    # saddle at -1 of V = u^2/2 + u^3/3: V = 1/6 there, and again at u = 1/2
    assert peak_limit(helmholtz_duffing(1.0, 1.0, 0.0)) == pytest.approx(0.5, rel=1e-13)
    assert trough(helmholtz_duffing(1.0, 1.0, 0.0), [0.4999999])[0] == pytest.approx(-1.0, abs=1e-3)
    # V saturates at 1/2 far on the left: 1 - e^u = -1 at u = ln 2
    assert peak_limit(MIRRORED_MORSE) == pytest.approx(math.log(2), rel=1e-6)
    assert peak_limit(MORSE) == math.inf


@settings(deadline=None, max_examples=25)
@given(u=st.floats(-3, 3).filter(lambda u: abs(u) > 1e-12))
def test_potential_and_its_inverse(u):
    level = potential_at(pendulum(2.0), u)
    assert level[0] == pytest.approx(8 * math.sin(u / 2) ** 2, rel=1e-14)
    assert peak_of_potential(pendulum(2.0), level)[0] == pytest.approx(abs(u), rel=1e-12)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: exact_frequency(pendulum(), math.pi), "not below the separatrix at 3.14159"),
        (lambda: exact_frequency(pendulum(), [1.0, 4.0]), "peak amplitude 4 is not below"),
        (lambda: exact_frequency(duffing(eps=-1.0), 1.0), "not below the separatrix at 1"),
        (lambda: exact_frequency(pendulum(), -1.0), "not negative"),
        (lambda: exact_frequency(pendulum(), math.nan), "finite"),
        (lambda: exact_frequency(pendulum(), 1.0, tolerance=0.0), "tolerance"),
        (lambda: exact_frequency(van_der_pol(1.0), 1.0), "has no potential"),
        (lambda: peak_of_action(pendulum(), 3.0), "outside 0 to 2.546"),
        (lambda: peak_of_potential(pendulum(), 2.0), "outside the well"),
        (lambda: peak_of_potential(pendulum(), -0.1), "outside the well"),
    ],
)
def test_refusals_name_value_and_limit(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_a_well_that_levels_off_has_no_orbit_of_more_action() -> None:
    """Morse, V = (1 - exp(-u))^2/2: J = 1 - sqrt(1 - 2 E) < 1, with E = V(A) (P. M. Morse, Phys. Rev. 34 (1929) 57)."""
    wanted = np.array([0.1, 0.5, 0.9])
    expected = -np.log(1 - np.sqrt(1 - (1 - wanted) ** 2))
    np.testing.assert_allclose(peak_of_action(MORSE, wanted), expected, rtol=1e-11)
    assert peak_of_action(MORSE, [0.0]).tolist() == [0.0]
    with pytest.raises(InputError, match="no amplitude has the action 2; the well levels off below it"):
        peak_of_action(MORSE, [0.5, 2.0])


@pytest.mark.parametrize(
    ("oscillator", "peak", "said"),
    [
        (duffing(eps=-1.0), 1.0, "peak amplitude 1 does not turn back"),
        (duffing(eps=-1.0), 1.5, r"peak amplitude 1\.5 does not turn back"),
        (helmholtz_duffing(alpha=1.0, eps=0.0), 0.6, r"peak amplitude 0\.6 has no trough in its well"),
    ],
)
def test_a_separatrix_is_no_orbit(oscillator: Dynamics, peak: float, said: str) -> None:
    with pytest.raises(InputError, match=said):
        orbit_table(oscillator, [0.25, peak])
