"""Limit cycles as fixed points of a slow flow: series, enclosures, and how far they are believed."""

import math
from itertools import pairwise

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.fixed_points import cycle_series, fixed_points, frequency_series, root_series
from ridgeback.symbolic.flow.limits import flow_limits
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.reach import reach_of
from ridgeback.symbolic.flow.reconstruction import Reconstruction
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.symbolic.flow.own import R, a, eps, make, runge_kutta, same


@pytest.mark.parametrize("name", ["van-der-pol", "rayleigh"])
@pytest.mark.parametrize("k", [1, 2, "3/2"])
def test_series_of_the_fixed_point_is_lindstedts_amplitude(name: str, k: object) -> None:
    oscillator = find(name).with_parameters({"k": k})  # type: ignore[dict-item]
    flow = multiple_scales(oscillator, 18, weight=1)
    cycle = fixed_points(flow, {"eps": "1/10"})[0]
    series = lindstedt(oscillator, 5, amplitude="fundamental").amplitude_series
    assert cycle.amplitude_series == series
    value = sum(coefficient * R(1, 10) ** n for n, coefficient in enumerate(series or ()))
    assert abs(float(cycle.amplitude) - float(value)) < 1e-6
    assert cycle.stable is True


def test_unstable_cycle_of_the_backward_van_der_pol_equation() -> None:
    own = make("u'' + e*(1 - u**2)*u' + u = 0")
    (cycle,) = fixed_points(multiple_scales(own, 3, weight=1), {"e": "0.1"})
    assert (cycle.amplitude == 2, cycle.stable) == (True, False)
    assert float(cycle.slope) == pytest.approx(0.1)


def test_two_cycles_of_a_fifth_order_damping() -> None:
    # a'/a = (eps/2)(-1 + 5 a^2/4 - a^4/4) = (eps/8)(a^2 - 1)(4 - a^2): an unstable cycle at 1, a stable one at 2,
    # since u^2 u' averages to a^2/4 and u^4 u' to a^4/8.
    own = make("u'' + eps*(1 - 5*u**2 + 2*u**4)*u' + u = 0")
    flow = multiple_scales(own, 5, weight=1)
    assert same(flow.growth_rate_expression().coeff(eps, 1), (a**2 - 1) * (4 - a**2) / 8)
    assert [s[0] for s in cycle_series(multiple_scales(own, 20, weight=1))] == [1, 4]
    found = fixed_points(flow, {"eps": "1/50"})
    assert [(round(float(p.amplitude), 3), p.stable) for p in found[:2]] == [(1, False), (2, True)]


def test_hopf_bifurcation_has_an_exact_series_of_the_square() -> None:
    own = make("u'' - 2*m*u' + u + u**2 + u'**3 = 0")
    low, high = cycle_series(multiple_scales(own, 8))[0], cycle_series(multiple_scales(own, 12))[0]
    assert (len(low), len(high)) == (5, 7)
    assert high[:5] == low
    assert low[:2] == (0, R(8, 3))
    flow = multiple_scales(own, 12)
    cycle = fixed_points(flow, {"m": "1/100"})[0]
    assert cycle.stable
    assert cycle.square_series == high
    assert cycle.amplitude_series is None
    value = sum(c * R(1, 100) ** n for n, c in enumerate(high))
    assert float(cycle.amplitude**2) == pytest.approx(float(value), abs=1e-9)
    # The motion itself settles on it: after a turn from a state on the cycle the state is back.
    wave = Reconstruction(flow)
    state = wave(float(cycle.amplitude), 0.0, 0.01), wave.velocity(float(cycle.amplitude), 0.0, 0.01)
    end = runge_kutta(lambda u, v: -0.02 * v + u + u**2 + v**3, state, 2 * math.pi / float(cycle.frequency), 2000)
    assert end == pytest.approx(state, abs=2e-7)


def test_series_stop_where_the_kept_terms_stop() -> None:
    # Through higher orders the same coefficients come back: none of them is an artefact of the truncation.
    for name in ("van-der-pol", "rayleigh"):
        series = [cycle_series(multiple_scales(find(name), order, weight=1))[0] for order in (6, 9, 12, 16)]
        assert [len(s) for s in series] == [2, 3, 4, 5]
        assert all(longer[: len(s)] == s for s, longer in pairwise(series))


def test_every_zero_is_enclosed_and_a_true_zero() -> None:
    flow = multiple_scales(find("van-der-pol"), 24, weight=1)
    for value in ("0.05", "0.5", "1", "1.5"):
        cycle = fixed_points(flow, {"eps": value})[0]
        assert cycle.square_series is not None  # followed from 4 all the way
        terms = tuple(t for t in flow.growth_rate if t.powers[1] <= flow.complete)  # type: ignore[operator]
        delta = sum(flow.expressions(terms)).subs(eps, R(value))
        radius = R(1, 10**10)
        middle = R(str(float(cycle.amplitude)))
        assert delta.subs(a, middle - radius) > 0 > delta.subs(a, middle + radius)


def test_a_cycle_of_irrational_frequency_is_that_of_the_scaled_equation() -> None:
    """u'' - m (1 - u^2) u' + k^2 u in the time k t has m/k for m: here k = sqrt(2); phi' is even in m."""
    wide = multiple_scales(make("u'' - m*(1 - u**2)*u' + 2*u = 0"), 6, weight=1)
    (square,) = cycle_series(wide)
    expected = [R(4), *([0] * (len(square) - 1))]
    assert list(square) == expected
    unit = frequency_series(multiple_scales(find("van-der-pol"), 6, weight=1), (R(4), R(0)))
    scaled = [sympy.sqrt(2) * c / sympy.sqrt(2) ** n for n, c in enumerate(unit)]
    assert [sympy.simplify(a - b) for a, b in zip(frequency_series(wide, square), scaled, strict=True)] == [0] * len(
        unit
    )
    cycle = fixed_points(wide, {"m": "0.1"})[0]
    assert float(cycle.frequency) == pytest.approx(
        float(sum(c * R(1, 10) ** n for n, c in enumerate(scaled))), abs=1e-7
    )


def test_no_cycle_and_no_numbers() -> None:
    assert fixed_points(multiple_scales(find("damped-pendulum"), 4), {"mu": "0.1"}) == ()
    assert cycle_series(multiple_scales(make("u'' + c*u' + d*u'**3 + u"), 4)) == ()
    assert root_series((sympy.S.Zero, sympy.S.One)) is None
    flow = multiple_scales(make("u'' - 2*m*u' + u + b*u'**3 = 0"), 4, weights={"b": 0})
    with pytest.raises(InputError, match="no rational number"):
        fixed_points(flow, {"m": "0.1"})
    assert cycle_series(flow) == ()  # nor is there a series without the number of b
    bent = multiple_scales(make("u'' - m*(1 - u**2)*u' + u + b*u**5 = 0"), 4, weights={"b": 0, "m": 1})
    with pytest.raises(InputError, match=r"coefficient .*b.* has no number for b"):
        fixed_points(bent, {"m": "0.1"})
    with pytest.raises(InputError, match="hold symbols; give every parameter a number"):
        frequency_series(bent, (R(4), R(0)))
    with pytest.raises(InputError, match="m has no value"):
        fixed_points(flow, {})
    with pytest.raises(InputError, match="no parameter 'q'"):
        fixed_points(flow, {"m": 1, "q": 2})


def hardened(share: int) -> Oscillator:
    """Van der Pol's excitation on a hardening spring; its cycle grows with 1/share."""
    return Oscillator.from_equation(f"u'' - eps*(1 - {share}*u**2)*u' + u + u**3 = 0", parameters={"eps": "1/10"})


@pytest.mark.parametrize("order", [4, 8, 12])
def test_a_zero_beyond_the_reach_of_its_order_is_no_limit_cycle(order: int) -> None:
    """The true cycle of share 2 has the first harmonic 1.3432 and omega0 1.5453; the zero is at a = 1.05, 1.35."""
    (found,) = fixed_points(multiple_scales(hardened(2), order, weight=1), {"eps": "1/10"})
    assert found.reach.beyond
    assert found.stable is None
    public = found.to_dict()
    assert (public["beyond_reach"], public["stable"], public["slope"]) == (True, None, None)


@pytest.mark.parametrize(("share", "omega"), [(12, 1.1139), (20, 1.0707)])
def test_a_zero_within_reach_is_near_the_true_limit_cycle(share: int, omega: float) -> None:
    (found,) = fixed_points(multiple_scales(hardened(share), 8, weight=1), {"eps": "1/10"})
    assert not found.reach.beyond
    assert found.stable is True
    assert float(found.frequency) == pytest.approx(omega, rel=1e-3)


def test_the_limits_of_the_frequency_are_the_limits_of_its_fixed_points() -> None:
    own = find("van-der-pol").with_parameters({"eps": 3})
    flow = multiple_scales(own, 4, weight=1)
    assert not fixed_points(flow, {"eps": 3})[0].reach.beyond  # one power alone has nothing to judge by
    (found,) = fixed_points(flow, {"eps": 3}, limits=flow_limits(own, flow).limits)
    assert "outside the circle of convergence" in found.reach.why
    assert found.stable is None


def test_states_of_a_decay_are_judged_by_the_terms_that_change_them() -> None:
    flow = multiple_scales(find("damped-pendulum"), 6)
    assert not reach_of(flow, 1.0, (0.01,)).beyond
    assert reach_of(flow, 3.0, (0.01,)).beyond
    assert reach_of(multiple_scales(find("linear"), 4), 100.0, (0.0,)).change in (None, 0.0)


def test_the_limits_of_a_self_excited_flow_are_those_of_its_conservative_part() -> None:
    own = Oscillator.from_equation("u'' - eps*(1 - u**2)*u' + sin(u) = 0", parameters={"eps": "1/10"})
    found = flow_limits(own, multiple_scales(own, 4, weight=1))
    assert found.limits is not None
    assert found.limits.radius == pytest.approx(4.0, rel=0.05)
