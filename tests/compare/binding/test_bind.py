"""A bound oscillator against the hand-written ones of the numeric side, and its closed forms against quadrature."""

import mpmath
import numpy as np
import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind, closed_form
from ridgeback.numeric.motion import dynamics as twins
from ridgeback.numeric.orbits.period import exact_frequency, peak_limit
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.systems.catalogue import catalogue, find
from ridgeback.symbolic.systems.oscillator import Oscillator, U

CLASSICAL = 12  # of the catalogue: the classical oscillators and their damped twins

PAPER = {"k": "12.566370614359172", "mu": "0.01"}

PAIRS = [
    (bind(find("damped-pendulum"), values=PAPER), twins.pendulum(12.566370614359172, 0.01)),
    (bind(find("duffing"), values={"eps": "0.3"}), twins.duffing(1.0, 0.3)),
    (bind(find("van-der-pol"), values={"eps": "0.7"}), twins.van_der_pol(0.7)),
    (bind(find("rayleigh"), values={"eps": "0.7"}), twins.rayleigh(0.7)),
]


@pytest.mark.parametrize(("bound", "twin"), PAIRS, ids=lambda d: d.name)
def test_forces_and_jets_agree_with_the_hand_written_twin(bound, twin):
    for u, v in [(0.3, -0.2), (1.7, 2.5), (-2.0, 0.0)]:
        assert bound.force(u, v) == pytest.approx(twin.force(u, v), rel=1e-14, abs=1e-15)
        ours, theirs = bound.jet(u, v, 25), twin.jet(u, v, 25)
        assert len(ours) == len(theirs) == 26
        for a, b in zip(ours, theirs, strict=True):
            assert float(a) == pytest.approx(float(b), rel=1e-11, abs=1e-12)
    assert bound.natural_frequency == pytest.approx(twin.natural_frequency, rel=1e-15)
    assert bound.damping == twin.damping


def test_a_decimal_parameter_means_exactly_that_decimal():
    bound = bind(find("damped-pendulum"), values=PAPER)
    with mpmath.workdps(40):
        expected = mpmath.mpf("12.566370614359172") ** 2 * mpmath.sin(1) + mpmath.mpf("0.02")
        assert abs(bound.precise_force(mpmath.mpf(1), mpmath.mpf(1)) - expected) < mpmath.mpf(10) ** -37


@pytest.mark.parametrize("oscillator", catalogue()[:CLASSICAL], ids=lambda o: o.name)
def test_every_catalogue_oscillator_binds_and_its_potential_is_the_integral_of_its_force(oscillator):
    bound = bind(oscillator)
    assert bound.force(0.0, 0.0) == 0.0
    u = np.linspace(-0.4, 0.4, 9)
    if bound.potential is None:
        assert bound.restoring is None
        return
    assert bound.potential(0.0) == 0.0
    np.testing.assert_allclose(bound.restoring(u), [bound.force(x, 0.0) for x in u], rtol=1e-13, atol=1e-15)
    step = 1e-5
    slope = (bound.potential(u + step) - bound.potential(u - step)) / (2 * step)
    np.testing.assert_allclose(slope, bound.restoring(u), rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize(
    "restoring",
    [9 * sympy.sin(U), 2 * sympy.sin(3 * U), 4 * U, U + U**3 / 5, 2 * U - U**3 / 3],
    ids=str,
)
def test_closed_forms_agree_with_quadrature(restoring):
    oscillator = Oscillator.from_equation(f"u'' + {restoring}", name="test")
    bound = bind(oscillator)
    peaks = np.array([0.05, 0.4, 0.9])
    table = exact_frequency(bound, peaks)
    np.testing.assert_allclose(bound.closed_form(peaks), table.omega, rtol=1e-12)


def test_closed_forms_are_recognised_by_structure_and_not_claimed_elsewhere():
    assert closed_form(U + U**2) is None
    assert closed_form(U + U**5) is None
    assert closed_form(sympy.sin(U) + U) is None
    assert closed_form(sympy.sin(U**2)) is None
    assert np.isnan(closed_form(U - U**3)(1.0))
    assert np.isnan(closed_form(sympy.sin(U))(np.pi + 0.1))


def test_an_unbound_parameter_is_named():
    with pytest.raises(InputError, match="has no number"):
        bind(Oscillator.from_equation("u'' + u + g*u**3"))
    with pytest.raises(InputError):
        bind(find("pendulum"), values={"q": 1})


@pytest.mark.parametrize(
    ("force", "left", "right", "peak"),
    [
        ("tanh(u)", -np.inf, np.inf, np.inf),  # sinh/cosh is not a number from 710 on
        ("sinh(u)/cosh(u)**3", -np.inf, np.inf, np.inf),  # and vanishes as a double from 238 on
        ("u + 1 - 1/(1 + u)**3", -1, np.inf, np.inf),  # a pole that V climbs
        ("1 - 1/(1 + u)**2", -1, np.inf, np.inf),  # of even order, with an equilibrium beyond, at -2
        ("u/(1 - u**2)**2", -1, 1, 1),
        ("1 - 1/sqrt(1 + u)", -1, np.inf, 3),  # V is finite at the edge
        ("exp(2*u) - exp(u)", -np.inf, np.inf, np.log(2)),  # V levels off
        ("sin(u/1000)", -1000 * np.pi, 1000 * np.pi, 1000 * np.pi),
        ("u*(1 - u/3)*(1 + u/4)", -4, 3, 3),
    ],
)
def test_the_oscillation_ends_at_saddles_edges_and_levels(force, left, right, peak):
    dynamics = bind(f"u'' + {force} = 0")
    assert twins.well(dynamics) == pytest.approx((left, right), rel=1e-14)
    assert peak_limit(dynamics) == pytest.approx(peak, rel=1e-10)


@pytest.mark.parametrize("system", ["isotonic", "kepler", "modified-poschl-teller", "u'' + u/(1 - u**2)**2 = 0"])
def test_orbits_next_to_a_wall_have_their_frequency(system):
    peak = 0.9375
    found = exact_frequency(bind(system), [peak])
    exact = enclose(system, sympy.Rational(15, 16), bits=64)
    assert abs(found.omega[0] - float(exact.middle)) <= 4 * found.error[0]
    if system == "isotonic":  # of one frequency: u + 1 goes from 1/(1 + A) to 1 + A
        far = exact_frequency(bind(system), [1.0, 30.0])
        assert far.trough == pytest.approx([-1 / 2, -30 / 31], rel=1e-14)
        assert far.omega == pytest.approx(1, rel=1e-12)
