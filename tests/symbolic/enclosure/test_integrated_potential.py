"""Enclosures where no rule integrates the force: the integral in balls against closed forms and integrated cycles."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy
from flint import acb, arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.numeric.motion.closed_orbit import closed_orbit
from ridgeback.symbolic.enclosure import separatrix as separatrices
from ridgeback.symbolic.enclosure.ball_functions import ball_function
from ridgeback.symbolic.enclosure.ball_integral import BallIntegral
from ridgeback.symbolic.enclosure.enclosure import enclose, enclose_in, separatrix
from ridgeback.symbolic.enclosure.separatrix import _followed, ends_of
from ridgeback.symbolic.enclosure.walk import UndecidedError, Walk
from ridgeback.symbolic.enclosure.well import curves, well_of
from ridgeback.symbolic.systems.oscillator import Oscillator, U

INTEGRALS = (
    (sympy.cos(U), sympy.sin(U)),
    (sympy.exp(U), sympy.exp(U) - 1),
    (1 / (1 + U), sympy.log(1 + U)),
    (U / sympy.sqrt(1 + U**2), sympy.sqrt(1 + U**2) - 1),
    (sympy.S.One, U),
)
REFUSED_BEFORE = ("u/(1 + u)", "log(1 + u)", "u*cosh(u)", "u + u*sin(u)**2", "u + u**3/(1 + u**2)", "sin(sin(u))")
DRAGS = ("sin(u) + u*u'**2", "u + u'**2*exp(u)/(1 + u)")


def own(force: str) -> Oscillator:
    return Oscillator.from_equation(f"u'' + {force} = 0", name="own")


@pytest.mark.parametrize(("integrand", "integral"), INTEGRALS)
@settings(max_examples=8, deadline=None)
@given(x=st.fractions(-3, 3, max_denominator=16), y=st.fractions(-2, 2, max_denominator=16))
def test_the_integral_in_balls_holds_the_closed_form(integrand: sympy.Expr, integral: sympy.Expr, x, y) -> None:
    with ctx.workprec(100):
        found = BallIntegral(ball_function(integrand, 100, complex_=True))
        exact = ball_function(integral, 100, complex_=True)
        place = acb(arb(fmpq(x.numerator, x.denominator)), arb(fmpq(y.numerator, y.denominator)))
        if y == 0 and x <= -1 and integrand == 1 / (1 + U):
            assert not found(place).is_finite()
            return
        value = found(place)
        assert value.overlaps(exact(place))
        assert value.rad() < arb(2) ** -60
        box = acb(place.real + arb(0, "0.01"), place.imag + arb(0, "0.01"))
        if found(box).is_finite():
            corner = acb(place.real + arb("0.005"), place.imag - arb("0.004"))
            assert found(box).overlaps(exact(corner))


def test_a_wrong_integral_is_outside() -> None:
    with ctx.workprec(100):
        found = BallIntegral(ball_function(sympy.cos(U), 100, complex_=True))
        assert not found(arb(1)).overlaps(arb(1).sin() + arb(2) ** -70)


@pytest.mark.parametrize("force", ["u + u**2 + u**3", "sin(u)", "u + u**2*exp(u**3)", "exp(u) - 1"])
@pytest.mark.parametrize("amplitude", ["0.001", "0.5"])
def test_both_ways_to_the_potential_give_one_frequency(force: str, amplitude: str) -> None:
    well = well_of(own(force))
    assert well.potential is not None
    hidden = replace(well, potential=None, polynomial=None)
    found = (enclose_in(each, amplitude, method="quadrature").omega for each in (well, hidden))
    first, second = found
    assert first.overlaps(second)
    assert second.rad() < arb(2) ** -120


@pytest.mark.parametrize("force", [*REFUSED_BEFORE, *DRAGS])
def test_what_no_rule_integrates_is_enclosed(force: str) -> None:
    oscillator = own(force)
    found = enclose(oscillator, "0.3", bits=80)
    assert (found.method, found.omega.rad() < arb(2) ** -76) == ("quadrature", True)
    assert float(found.omega) == pytest.approx(closed_orbit(bind(oscillator), 0.3).omega, rel=1e-15)


@settings(max_examples=4, deadline=None)
@given(
    st.sampled_from(("u/(2 + u)", "u*cosh(u)", "log(1 + u)", "u*sin(u)**2", "u**3/(1 + u**2)", "atan(u)*exp(u)")),
    st.fractions(-1, 1, max_denominator=3),
    st.fractions(-1, 1, max_denominator=3),
)
def test_random_forces_are_enclosed_where_they_are_integrated(term: str, a, b) -> None:
    oscillator = own(f"u + ({a})*u**2/2 + ({b})*{term}/2")
    found = enclose(oscillator, "0.2", bits=64)
    assert float(found.omega) == pytest.approx(closed_orbit(bind(oscillator), 0.2).omega, rel=1e-15)


def test_the_separatrix_of_an_integrated_potential() -> None:
    """sin(sin(u)) vanishes at pi."""
    found = separatrix(own("sin(sin(u))"))
    assert found.peak is not None
    assert found.peak.overlaps(arb.pi())


def test_a_force_that_dies_out_too_fast_is_refused_for_that() -> None:
    """V = tanh(u)^2/2 levels off at 1/2; no amplitude was given that could be made smaller."""
    with pytest.raises(InputError, match="decays so fast where V levels off") as refused:
        ends_of(own("tanh(u) - tanh(u)**3"))
    assert "use a smaller amplitude" not in str(refused.value)


def test_far_out_a_ball_that_holds_zero_is_not_called_a_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    with ctx.workprec(64):
        side = curves(well_of(own("sinh(u)")), 64)
    monkeypatch.setattr(separatrices, "walk", lambda *_, **__: Walk("exhausted", arb(100)))
    for force, end in ((lambda u: 200 - u, "zero"), (lambda u: 1 / (300 - u).sqrt(), "singular")):
        assert _followed(replace(side, force=force, slope=lambda _: arb(-1))).end == end
    with pytest.raises(UndecidedError):
        _followed(replace(side, force=lambda u: 200 - u + arb(0, 9), slope=lambda _: arb(-1)))


def test_the_mirrored_well_is_integrated_too() -> None:
    peak = enclose(own("log(1 + u)"), "0.3", bits=64)
    mirrored = enclose(own("-log(1 - u)"), "0.3", definition="trough", bits=64)
    assert peak.omega.overlaps(mirrored.omega)


def test_closed_forms_are_taken_where_there_are_any() -> None:
    for text in ("sin(u)", "u + u**3", "u + u*u'**2"):
        well = well_of(own(text))
        assert well.potential is not None
        assert well.inertia is not None
    assert well_of(own("log(1 + u)")).potential is None
    assert well_of(own(DRAGS[1])).inertia is None
