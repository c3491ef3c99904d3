"""Limit cycles in balls: exact circles and pendulum orbits, Taylor integration, series, symmetries, refusals."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.dynamics import van_der_pol
from ridgeback.numeric.motion.limit_cycle import periodic_orbit, precise_orbit
from ridgeback.symbolic.certificates.at_amplitudes import Refused
from ridgeback.symbolic.certificates.at_cycles import CertifiedCycle, certified_cycles
from ridgeback.symbolic.cycles.enclose import Cycle, enclose_cycle
from ridgeback.symbolic.cycles.field import field_of
from ridgeback.symbolic.cycles.found import Unproved, limit_cycles
from ridgeback.symbolic.cycles.passage import passage
from ridgeback.symbolic.cycles.search import return_map, runs_out, scan
from ridgeback.symbolic.cycles.taylor_step import changed, step_from
from ridgeback.symbolic.enclosure.walk import UndecidedError
from ridgeback.symbolic.expansion.ball_expansion import holds
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

CIRCLE = U**2 + V**2


def cycles(equation: str, **values: str) -> list[Cycle]:
    found = limit_cycles(Oscillator.from_equation(equation, parameters=values), bits=90)
    assert not [each for each in found if isinstance(each, Unproved)]
    return [each for each in found if isinstance(each, Cycle)]


@settings(max_examples=6, deadline=None)
@given(
    radius=st.fractions(Fraction(1, 3), 2, max_denominator=7),  # beyond, strength * radius**2 asks for too many bits
    strength=st.fractions(Fraction(1, 5), Fraction(3, 2), max_denominator=5),
    slant=st.fractions(Fraction(-1, 4), Fraction(1, 4), max_denominator=9),
)
def test_an_exact_circle_is_in_the_balls(radius: Fraction, strength: Fraction, slant: Fraction) -> None:
    """u'' + s (1 + c u)(u^2 + u'^2 - r^2) u' + u = 0: u = r cos t, and f_u' = 2 s (1 + c u) u'^2 on it."""
    s, c, r = (sympy.Rational(x.numerator, x.denominator) for x in (strength, slant, radius))
    cycle = enclose_cycle(U + s * (1 + c * U) * (CIRCLE - r**2) * V, float(radius) * (1 + 1e-9), unit=1.0, bits=90)
    with ctx.workprec(200):
        assert holds(cycle.omega, fmpq(1))
        assert holds(cycle.peak, fmpq(radius.numerator, radius.denominator))
        assert holds(cycle.trough, -fmpq(radius.numerator, radius.denominator))
        assert cycle.multiplier.overlaps((-2 * arb.pi() * fmpq(*(strength * radius**2).as_integer_ratio())).exp())
    assert cycle.omega.rel_accuracy_bits() >= 90
    assert cycle.stable


def test_a_relaxation_oscillation_is_enclosed_and_a_stiffer_one_is_refused_at_once() -> None:
    """With LSODA at 1e-12 omega0(20) agrees to 3e-11."""
    (cycle,) = limit_cycles("u'' - 20*(1 - u**2)*u' + u = 0", bits=64)
    assert isinstance(cycle, Cycle)
    assert cycle.omega.str(15, radius=False) == "0.181163910235176"
    assert cycle.peak.str(15, radius=False) == "2.00778997086543"
    with pytest.raises(InputError, match="the motion from the peak 2 is not followed to its turning point"):
        limit_cycles("u'' - 1000*(1 - u**2)*u' + u = 0")


def test_the_scan_sees_the_cycle_at_60_and_goes_back_from_peaks_that_it_cannot_follow() -> None:
    """Balls: 2.00240191906388."""
    force = U - 60 * (1 - U**2) * V
    assert not runs_out(force, 2.0, turns=1)
    found = scan(force, turns=1, near=[2.0])
    assert found.peaks == pytest.approx((2.00240191906388,), rel=1e-6)
    assert found.lost > 0


def test_where_all_but_nothing_is_lost_in_a_cycle_rounding_is_no_limit_cycle() -> None:
    """Beyond a peak of 25 in sinh(u) a cycle takes 1e-4 of the peak and less; a scan saw a zero there at 30.65."""
    equation = "u'' - (1/5)*(1 - (2/5)*u**2 + (1/6)*u)*u' + sinh(u) = 0"
    (cycle,) = limit_cycles(equation, bits=64)
    assert isinstance(cycle, Cycle)
    assert float(cycle.peak.mid()) == pytest.approx(3.06310186143686)
    force = as_oscillator(equation).substituted_force
    for way in (force, force.subs(V, -V)):
        found = scan(way, turns=2, near=[3.2, 49.4]).peaks
        assert len(found) == (way == force)
    there, back = (return_map(way, turns=2) for way in (force, force.subs(V, -V)))
    far = there(29.0)
    assert far is not None
    assert 0.0 < 29.0 - far < 0.01
    assert back(far) == pytest.approx(29.0, rel=1e-6)


def test_a_motion_that_escapes_over_a_saddle_is_not_called_stiff() -> None:
    """The loss is a tenth of the natural frequency; only beyond the saddle at 2.47 the steps run out."""
    with pytest.raises(InputError, match=r"found no limit cycle.* not followed to the turning point") as refused:
        limit_cycles("u'' - (1 - 5*u**2/7)*u'/10 + u - 23*u**3/140 = 0")
    assert "relaxation" not in str(refused.value)


def test_nested_circles_are_told_apart() -> None:
    """s (u^2 + u'^2 - 1)(u^2 + u'^2 - 4) u': multipliers exp(6 pi s) at 1, exp(-24 pi s) at 2."""
    inner, outer = cycles("u'' + (u**2 + u'**2 - 1)*(u**2 + u'**2 - 4)*u'/20 + u = 0")
    assert (inner.stable, outer.stable) == (False, True)
    assert holds(inner.peak, fmpq(1))
    assert holds(outer.peak, fmpq(2))
    assert inner.multiplier.overlaps((arb.pi() * 6 / 20).exp())
    assert outer.multiplier.overlaps((-arb.pi() * 24 / 20).exp())


def test_a_pendulum_kept_at_one_energy_has_the_pendulum_frequency() -> None:
    """u'' + (u'^2/2 + 1 - cos u - 1/2) u' + sin u = 0 holds the amplitude pi/3: omega0 = agm(1, cos(pi/6))."""
    (cycle,) = cycles("u'' + (u'**2/2 + 1/2 - cos(u))*u' + sin(u) = 0")
    with ctx.workprec(160):
        assert cycle.omega.overlaps(arb(1).agm((arb.pi() / 6).cos()))
        assert cycle.peak.overlaps(arb.pi() / 3)


@pytest.mark.parametrize("eps", ["1/10", "3"])
def test_rayleigh_and_van_der_pol_overlap(eps: str) -> None:
    both = [limit_cycles(find(name).with_parameters({"eps": eps}), bits=100)[0] for name in ("van-der-pol", "rayleigh")]
    first, second = both
    assert isinstance(first, Cycle)
    assert isinstance(second, Cycle)
    assert first.omega.overlaps(second.omega)
    assert first.multiplier.overlaps(second.multiplier)
    assert first.omega.rad() < arb("1e-29")
    assert first.peak.rad() < arb("1e-29")


def test_taylor_integration_and_a_known_period() -> None:
    (cycle,) = cycles("u'' - eps*(1 - u**2)*u' + u = 0", eps="1")
    oscillator = van_der_pol(1.0)
    second = precise_orbit(oscillator, periodic_orbit(oscillator), digits=24)
    with mpmath.workdps(24), ctx.workprec(120):
        assert abs(arb(mpmath.nstr(second.period, 22)) - 2 * arb.pi() / cycle.omega) < arb("1e-20")
        assert abs(arb(mpmath.nstr(second.peak, 22)) - cycle.peak) < arb("1e-20")
    with ctx.workprec(120):
        period = 2 * arb.pi() / cycle.omega
        assert period.str(20, radius=False) == "6.6632868593231301897"


def test_the_series_ends_within_its_terms_left_out() -> None:
    """At eps = 1/10 the series to eps^24 errs by about (eps/1.85)^26."""
    series = lindstedt(find("van-der-pol"), 24)
    (row,) = certified_cycles(find("van-der-pol"), [Fraction(1, 10)], formula=series, bits=120)
    assert isinstance(row, CertifiedCycle)
    assert row.error is not None
    assert arb("1e-36") < abs(row.error) < arb("1e-33")
    with ctx.workprec(160):
        powers = [
            (arb(1) / 10) ** n * arb(fmpq(int(c.p), int(c.q))) for n, c in enumerate(series.amplitude_series or ())
        ]
        assert abs(sum(powers, arb(0)) - row.cycle.peak) < arb("1e-31")


def test_backwards_in_time_a_cycle_repels_with_the_inverse_multiplier() -> None:
    (forward,), (backward,) = (cycles(f"u'' {sign} eps*(1 - u**2)*u' + u = 0", eps="1") for sign in "-+")
    assert forward.omega.overlaps(backward.omega)
    assert (forward.stable, backward.stable) == (True, False)
    assert (forward.multiplier * backward.multiplier).overlaps(arb(1))


def test_a_repelling_cycle_is_enclosed_forwards_too() -> None:
    cycle = enclose_cycle(U + (1 - U**2) * V / 10, 2.0001, unit=1.0, bits=64)
    (other,) = cycles("u'' + eps*(1 - u**2)*u' + u = 0", eps="1/10")
    assert cycle.multiplier.overlaps(other.multiplier)
    assert cycle.omega.overlaps(other.omega)


@pytest.mark.parametrize(("k", "size"), [("5", "1/1000"), ("1/3", "1000")])
def test_units_of_time_and_length_do_not_matter(k: str, size: str) -> None:
    (cycle,) = cycles(f"u'' - eps*({k})*(1 - (u/({size}))**2)*u' + ({k})**2*u = 0", eps="1/2")
    (plain,) = cycles("u'' - eps*(1 - u**2)*u' + u = 0", eps="1/2")
    with ctx.workprec(120):
        assert cycle.omega.overlaps(plain.omega * fmpq(*Fraction(k).as_integer_ratio()))
        assert cycle.peak.overlaps(plain.peak * fmpq(*Fraction(size).as_integer_ratio()))


def test_a_cycle_without_symmetry_goes_by_the_full_return_map() -> None:
    (cycle,) = cycles("u'' - eps*(1 - u**2)*u' + u + u**2/10 = 0", eps="1/2")
    own = Oscillator.from_equation("u'' - eps*(1 - u**2)*u' + u + u**2/10 = 0", parameters={"eps": "1/2"})
    from ridgeback.compare.binding.bind import bind

    other = periodic_orbit(bind(own), start=2.0)
    assert float(cycle.omega) == pytest.approx(other.omega, rel=1e-10)
    assert (float(cycle.peak), float(cycle.trough)) == pytest.approx((other.peak, other.trough), rel=1e-9)


@settings(max_examples=8, deadline=None)
@given(start=st.floats(0.2, 2.5), speed=st.floats(-2, 2), offset=st.floats(-1, 1))
def test_a_step_holds_the_motions_of_its_tube(start: float, speed: float, offset: float) -> None:
    """The neighbour, integrated from its own start to much higher precision, is where the tube says."""
    force, error = U - (1 - U**2) * V, arb("1e-3")
    with ctx.workprec(100):
        step = step_from(field_of(force, arb(1)), arb(start), arb(speed), unit=arb(1), degree=50, error=error)
        near = (arb(start) + error * arb(offset)).mid(), (arb(speed) - error * arb(offset)).mid()
    with ctx.workprec(200):
        fine = field_of(force, arb(1))
        u, v, time = near[0], near[1], arb(0)
        while time < step.length:
            small = step_from(fine, u, v, unit=arb(1), degree=90, error=arb(0))
            t = small.length if small.length < step.length - time else step.length - time
            u, v, time = small.u(t).mid(), small.v(t).mid(), time + t
        end = step.end()
        reach = step.factor * error * changed(arb(1), step.unit) + step.added
        assert abs(end[0] - u) < reach
        assert abs(end[1] - v) < reach * step.unit


def test_a_passage_serves_all_smaller_widths() -> None:
    with ctx.workprec(100):
        found = passage(field_of(U - (1 - U**2) * V / 2, arb(1)), arb(2), width=arb("1e-8"), degree=50, turns=2)
        trough, peak = found.turns
        balls = [peak.at(arb(width))[0] for width in ("1e-8", "1e-12", "0")]
        assert balls[0].contains(balls[1])
        assert balls[1].contains(balls[2])
        assert trough.at(arb(0))[1] < 0 < peak.at(arb(0))[1]


def test_balls_that_cannot_decide_say_so() -> None:
    with ctx.workprec(64), pytest.raises(UndecidedError):
        passage(field_of(U - (1 - U**2) * V, arb(1)), arb(2), width=arb("0.5"), degree=30, turns=1)


@pytest.mark.parametrize(
    ("equation", "says"),
    [
        ("u'' + u + u**3 = 0", "every orbit near the origin closes"),
        ("u'' + u*u' + u = 0", "every orbit near the origin closes"),
        ("u'' + u'/10 + u = 0", "found no limit cycle"),
        ("u'' - eps*(1 - u**2)*u' + u = 0", "set eps"),
        ("u'' + (u**2 + u'**2 - 1)**2*u' + u = 0", "found no limit cycle"),
    ],
)
def test_where_there_is_no_cycle_a_refusal_says_why(equation: str, says: str) -> None:
    with pytest.raises(InputError, match=says):
        limit_cycles(Oscillator.from_equation(equation))


def test_a_double_cycle_is_refused() -> None:
    with pytest.raises(InputError, match="not told from 1"):
        enclose_cycle(U + (CIRCLE - 1) ** 2 * V, 1.0, unit=1.0, bits=64)


def test_of_nested_cycles_the_series_describes_the_first() -> None:
    own = Oscillator.from_equation("u'' - eps*(u**2 + u'**2 - 1)*(u**2 + u'**2 - 4)*u' + u = 0")
    rows = certified_cycles(own, [Fraction(1, 20)], formula=lindstedt(own, 4), bits=64)
    assert [isinstance(row, CertifiedCycle) and row.error is not None for row in rows] == [True, False]
    (refused,) = certified_cycles(find("van-der-pol").with_parameters({"k": None}), [Fraction(1)], bits=64)
    assert isinstance(refused, Refused)
    assert refused.to_dict(20) == {"eps": 1.0, "eps_exact": "1", "omega0": None, "radius": None, "refused": refused.why}
