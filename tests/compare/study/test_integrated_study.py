"""Studies of oscillators whose orbits have no energy of a known form: the reference is integrated, and said so."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.motion.model_curves import CLOSED_FORM, model_curves
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.compare.study.derived import derive
from ridgeback.compare.study.study import study
from ridgeback.numeric.motion.closed_orbit import closed_orbit
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

INTEGRATED = "one cycle integrated by Taylor series to 20 digits"


def test_an_isochronous_oscillator_is_held_against_its_frequency() -> None:
    result = study(Oscillator.from_equation("u'' + 3*u*u' + u**3 + u = 0"), (4,), [0.3, 0.5])
    assert result.reference_name == INTEGRATED
    assert result.reference == pytest.approx([1.0, 1.0], abs=1e-15)
    assert result.relative_error == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("equation", ["u'' + u*u' + u = 0", "u'' + b*u*u' + u = 0", "u'' + 2*mu*u' + b*u*u' + u = 0"])
def test_a_reversible_centre_is_integrated_and_keeps_its_terms(equation: str) -> None:
    own = Oscillator.from_equation(equation)
    values = {name: {"b": 1, "mu": "1/100"}[name] for name in own.parameters}
    result = study(own, (8,), [0.4], values=values)
    assert result.reference_name == INTEGRATED
    assert result.reference == pytest.approx([0.99336675], abs=1e-8)
    assert abs(result.relative_error[0, 0]) < 1e-11


def test_a_first_integral_of_another_form_is_integrated() -> None:
    result = study(Oscillator.from_equation("(1 + u'**2)*u'' + u = 0"), (8, 12), [0.2])
    assert result.reference_name == INTEGRATED
    assert abs(result.relative_error[1, 0]) < abs(result.relative_error[0, 0]) < 1e-7


def test_the_closed_form_is_met_by_integration() -> None:
    dynamics = bind(find("duffing"))
    assert dynamics.closed_form is not None
    for peak in (0.1, 1.0, 3.0):
        assert closed_orbit(dynamics, peak).omega == pytest.approx(float(dynamics.closed_form(peak)), rel=1e-14)


def test_an_orbit_that_does_not_close_has_no_frequency() -> None:
    with pytest.raises(InputError, match="does not close"):
        closed_orbit(bind(Oscillator.from_equation("u'' + c*u' + u", parameters={"c": "0.1"})), 1.0)


@settings(max_examples=6, deadline=None)
@given(st.tuples(*[st.fractions(-1, 1, max_denominator=4)] * 4))
def test_random_reversible_centres_close_at_the_frequency_of_their_series(c: tuple[object, ...]) -> None:
    a, b, d, e = c
    own = Oscillator.from_equation(f"u'' + u + ({a})*u*u' + ({b})*u**3 + ({d})*u*u'**2 + ({e})*u*u'**3 = 0")
    omega = closed_orbit(bind(own), 0.1).omega
    assert omega == pytest.approx(float(lindstedt(own, 8)(0.1)), rel=3e-8)


def test_the_motion_of_a_reversible_centre_has_curves_without_a_potential() -> None:
    own = Oscillator.from_equation("u'' + u*u' + u = 0")
    motion = integrate_motion(setting(own, initial=(0.4, 0.0), duration=60.0))
    derived = derive(own, 8)
    curves = {curve.name for curve in model_curves(motion, derived, orders=(8,))}
    assert CLOSED_FORM not in curves
    assert any("8" in name for name in curves)
