"""A certificate passes what is right, notices what is wrong, and says what does not apply."""

import itertools
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball, natural_frequency, number_ball
from ridgeback.symbolic.certificates.at_cycles import certified_cycles
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.certificates.lost_energy import enclosed_growth_rate
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.series.spaces import space_for
from ridgeback.symbolic.series.trigonometric import cosine
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("name", ["pendulum", "duffing-softening", "helmholtz-duffing", "linear"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental", "action"])
def test_every_check_passes_for_conservative_oscillators(name: str, amplitude: str) -> None:
    checks = certify(find(name), lindstedt(find(name), 7, amplitude=amplitude))
    assert [c.passed for c in checks] == [True] * 4


@pytest.mark.parametrize("name", ["van-der-pol", "rayleigh"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_limit_cycles(name: str, amplitude: str) -> None:
    assert [c.passed for c in certify(find(name), lindstedt(find(name), 6, amplitude=amplitude))] == [True, True]


def test_slow_flows_and_the_energy_integral() -> None:
    damped = find("damped-helmholtz-duffing")
    assert [c.passed for c in certify(damped, multiple_scales(damped, 6))] == [True, True]
    assert [c.passed for c in certify(find("pendulum"), energy_integral(find("pendulum"), 6))] == [True]


@pytest.mark.parametrize(
    ("equation", "order"),
    [
        ("u'' + u + b*u*abs(u) + c*u**3 = 0", 2),
        ("u'' + k**2*u + b*u*abs(u) = 0", 2),
        ("u'' + c*u**3 + u**5 = 0", 2),
        ("u'' + 2*u + abs(u)*u = 0", 2),
    ],
)
def test_one_wrong_coefficient_of_a_series_on_each_side_fails(equation: str, order: int) -> None:
    """Also where parameters have no value, and where it is wrong in one of them only."""
    own = Oscillator.from_equation(equation)
    series = energy_on_each_side(own, order)
    assert [check.passed for check in certify(own, series)] == [True]
    zero, factors = fmpq(0), [2, *(space_for(series.names).gen(name) + 1 for name in series.names)]
    for n, factor in itertools.product(range(len(series.coefficients)), factors):
        wrong = replace(
            series, coefficients=tuple(factor * c if n == i else c for i, c in enumerate(series.coefficients))
        )
        assert [check.passed for check in certify(own, wrong)] == [series.coefficients[n] == zero]


@pytest.mark.parametrize("equation", ["u'' + F*sign(u') + c*abs(u')*u' + u = 0", "u'' + c*abs(u')*u' + sin(u) = 0"])
def test_one_wrong_term_of_averaged_losses_fails(equation: str) -> None:
    own = Oscillator.from_equation(equation)
    flow = averaged_losses(own, 2)
    assert [check.passed for check in certify(own, flow)] == [True]
    for terms in ("phase_terms", "growth_terms"):
        first, *others = getattr(flow, terms)
        wrong = replace(flow, **{terms: (replace(first, coefficient=first.coefficient * 2), *others)})
        assert [check.passed for check in certify(own, wrong)] == [False]


def test_what_does_not_apply_is_said() -> None:
    own = Oscillator.from_equation("u'' + u + u*u'**2")
    found = {c.name: c for c in certify(own, lindstedt(own, 4))}
    assert found["residual"].passed
    assert found["energy integral"].passed is None
    assert "u'" in found["energy integral"].statement


def test_balls_beside_the_exact_coefficients_fail() -> None:
    balls = lindstedt_in_balls(find("duffing"), 6, digits=20)
    wrong = replace(balls, coefficients=(*balls.coefficients[:4], balls.coefficients[4] + 1, *balls.coefficients[5:]))
    assert all(check.passed for check in certify(find("duffing"), balls))
    failed = [check for check in certify(find("duffing"), wrong) if check.passed is False]
    assert len(failed) == 2
    assert all("orders [4] lie outside their balls" in check.statement for check in failed)


def test_a_flow_that_does_not_solve_the_equation_fails() -> None:
    flow = multiple_scales(find("damped-pendulum"), 4)
    wrong = replace(flow, delta=(*flow.delta[:2], 2 * flow.delta[2], *flow.delta[3:]))
    checks = {check.name: check for check in certify(find("damped-pendulum"), wrong)}
    assert checks["residual"].passed is False
    assert "do not cancel" in checks["residual"].statement


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: certified_cycles(find("pendulum"), [Fraction(1)]), "pendulum has no small parameter"),
        (
            lambda: enclosed_growth_rate(Oscillator.from_equation("u'' + u + abs(u')**(1/2)*u' = 0"), sympy.S.One, 64),
            r"goes with \|u'\|\^\(3/2\), and whole powers only",
        ),
        (lambda: ball("one"), "'one' is a str, not a real number"),
        (lambda: natural_frequency(sympy.sqrt(sympy.Symbol("k")) ** 3), "no number for its parameters"),
        (lambda: number_ball(sympy.zeta(3)), "no real number that balls know"),
    ],
)
def test_what_balls_cannot_hold_is_refused(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()
    assert ball(fmpq(1, 3)).contains(fmpq(1, 3))


def test_the_number_of_coefficients_that_agree_is_said() -> None:
    said = {c.name: c.statement for c in certify(find("pendulum"), lindstedt(find("pendulum"), 6))}
    assert "the same 7 coefficients (peak amplitude)" in said["energy integral"]


def test_a_wrong_frequency_fails_every_check_that_can_see_it() -> None:
    good = lindstedt(find("pendulum"), 6)
    wrong = replace(good, coefficients=(*good.coefficients[:-1], good.coefficients[-1] + fmpq(1, 10**6)))
    failed = {c.name for c in certify(find("pendulum"), wrong) if c.passed is False}
    assert failed == {"residual", "energy integral", "multiple scales"}


def test_a_wrong_homogeneous_term_passes_the_residual_but_not_the_normalisation() -> None:
    good = lindstedt(find("pendulum"), 6)
    assert good.waveform is not None
    shifted = (*good.waveform[:-1], good.waveform[-1] + cosine(good.waveform[-1].space))
    checks = {c.name: c.passed for c in certify(find("pendulum"), replace(good, waveform=shifted))}
    assert checks["residual"] is True
    assert checks["normalisation"] is False
