"""Frequencies by validated integration: against enclosures by the energy, first integrals in mpmath, exact centres."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.cycles.orbit import by_integration, exact_frequency
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.expansion.ball_expansion import holds
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

RELATIVISTIC = "u'' + u*(1 - u'**2)**(3/2) = 0"


@pytest.mark.parametrize("amplitude", ["1/2", "1"])
def test_the_relativistic_oscillator_by_its_first_integral(amplitude: str) -> None:
    """gamma + u^2/2 is conserved: the period is 4 times the integral of gamma/sqrt(gamma^2 - 1) from 0 to A."""
    with mpmath.workdps(30):
        a = mpmath.mpf(Fraction(amplitude).numerator) / Fraction(amplitude).denominator

        def slowness(angle: mpmath.mpf) -> mpmath.mpf:  # u = A sin(angle), and gamma - 1 = (A cos(angle))^2/2
            rise = (a * mpmath.cos(angle)) ** 2 / 2
            return (1 + rise) / mpmath.sqrt(1 + rise / 2)

        omega = mpmath.pi / 2 / mpmath.quad(slowness, [0, mpmath.pi / 4, mpmath.pi / 2])
        found = exact_frequency(RELATIVISTIC, amplitude, bits=80)
        with ctx.workprec(120):
            assert abs(found.omega - arb(mpmath.nstr(omega, 25))) < arb("1e-22")
    assert found.method == "integration"


@settings(max_examples=6, deadline=None)
@given(
    size=st.fractions(Fraction(1, 20), Fraction(1, 2), max_denominator=20),
    square=st.fractions(-1, 1, max_denominator=5),
    cube=st.fractions(-1, 1, max_denominator=5),
    drag=st.fractions(-1, 1, max_denominator=5),
    definition=st.sampled_from(["peak", "trough"]),
)
def test_integration_and_the_energy_agree(
    size: Fraction, square: Fraction, cube: Fraction, drag: Fraction, definition: str
) -> None:
    own = Oscillator.from_equation(f"u'' + u + ({square})*u**2 + ({cube})*u**3 + ({drag})*u*u'**2 = 0")
    try:
        expected = enclose(own, size, definition=definition, bits=80)
    except InputError:
        return  # beyond a separatrix
    found = by_integration(own, size, definition=definition, bits=80)
    assert found.omega.overlaps(expected.omega)
    assert found.peak.overlaps(expected.peak)
    assert found.trough.overlaps(expected.trough)


def test_an_isochronous_centre_has_its_frequency_in_the_ball() -> None:
    found = exact_frequency("u'' + 3*u*u' + u**3 + u = 0", "1/2", bits=80)
    assert holds(found.omega, fmpq(1))
    assert found.trough.overlaps(-found.peak)


@pytest.mark.parametrize("definition", ["peak", "trough"])
def test_a_reversible_centre_agrees_with_its_series(definition: str) -> None:
    own = Oscillator.from_equation("u'' + u*u' + u = 0")
    found = exact_frequency(own, "1/10", definition=definition, bits=80)
    with ctx.workprec(120):
        assert abs(lindstedt(own, 8, amplitude=definition).in_balls(arb(fmpq(1, 10))) / found.omega - 1) < arb("1e-13")


@pytest.mark.parametrize(
    ("equation", "amplitude", "says"),
    [
        ("u'' + u - u**3 + u*u'**4 = 0", "3/2", "does not come back"),
        ("u'' + 2*mu*u' + u + u*u'**4 = 0", 1, "loses energy"),
        ("u'' + c*u*u'**4 + u = 0", 1, "c has none|set c|has no value"),
    ],
)
def test_what_has_no_frequency_is_refused(equation: str, amplitude: str | int, says: str) -> None:
    with pytest.raises(InputError, match=says):
        exact_frequency(Oscillator.from_equation(equation), amplitude)


def test_a_limit_cycle_has_no_frequency_by_amplitude() -> None:
    with pytest.raises(InputError, match="no orbit for each amplitude"):
        by_integration(find("van-der-pol"), 1)
