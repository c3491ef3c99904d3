"""What the symbolic room cannot do is refused in one line that says what would work."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import natural_frequency, number_ball
from ridgeback.symbolic.arithmetic.closures import evaluator
from ridgeback.symbolic.arithmetic.expression_series import check_expandable
from ridgeback.symbolic.certificates.at_cycles import certified_cycles
from ridgeback.symbolic.certificates.certificate import _against_quadrature, _losses_against
from ridgeback.symbolic.certificates.lost_energy import enclosed_growth_rate
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.fit.fit import minimax
from ridgeback.symbolic.codegen.formulas.closed_forms import mean_form
from ridgeback.symbolic.codegen.proofs.gappa import gappa_script
from ridgeback.symbolic.enclosure.ball_functions import REAL
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.enclosure.half_wells import two_sided
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.flow.fixed_points import fixed_points
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.grammar.at_origin import value_at_origin
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.description import from_text
from ridgeback.symbolic.systems.from_sympy import equation_text, named
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.sides import kink_advice

C, M = sympy.Symbol("c", real=True), sympy.Symbol("m", real=True)
HALF = sympy.Rational(1, 2)


def of(equation: str, *free: str, **numbers: int) -> Oscillator:
    """An oscillator whose named parameters stay symbols."""
    return Oscillator.from_equation(equation, parameters={**dict.fromkeys(free), **numbers})


def pendulum(order: int = 4) -> Expansion:
    return energy_integral(find("pendulum"), order)


def quintic() -> SlowFlow:
    """A limit cycle whose frequency holds a symbol and whose amplitude does not."""
    return multiple_scales(of("u'' - m*(1 - u**2)*u' + u + c*u**5 = 0", "m", "c"), 4, weight=1)


DAMPED = of("u'' + u + c*abs(u')*u' = 0", "c")


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: natural_frequency(C), "natural frequency c has no number for its parameters"),
        (lambda: number_ball(sympy.zeta(3)), r"zeta\(3\) is no real number that balls know"),
        (lambda: evaluator(sympy.gamma(U), [U], REAL), r"gamma in gamma\(u\) cannot be evaluated with"),
        (lambda: check_expandable(C * U, [U]), "the parameter c has no value here; give it one, e.g. --set c=1"),
        (lambda: energy_integral(find("cube-root"), 2), r"goes in other powers of A, from A\^\(-1/3\) in steps of 1/3"),
        (lambda: pendulum().residual(), "has no waveform to substitute; compare it with lindstedt"),
        (lambda: lindstedt(find("van-der-pol"), 2).amplitude_as("peak"), "cannot be converted; derive it as 'peak'"),
        (lambda: lindstedt(find("van-der-pol"), 2).difference(pendulum()), "in eps meets one in A"),
        (lambda: energy_integral(of("u'' + u + c*u**3 = 0", "c"), 2).picture(), "holds parameters without a value"),
        (lambda: multiple_scales(of("u'' + u + c*u**3 = 0", "c"), 2).picture(), "holds parameters without a value"),
        (lambda: energy_on_each_side(of("u'' + c*u*abs(u) = 0", "c"), 2).picture(), "parameters without a value"),
        (lambda: energy_on_each_side(find("cube-root"), 2).truncated(3), "order 3 is not within 0..2"),
        (lambda: quintic().picture(), "holds parameters without a value"),
        (lambda: fixed_points(quintic(), {"m": "1/10"}), "the coefficient 5[*]c/16 has no number for c; set it"),
        (lambda: averaged_losses(DAMPED, 3).growth_rate_at(0.1, 1.0, 2.0), r"2 values were given for .*\(c\)"),
        (lambda: _losses_against(DAMPED, averaged_losses(DAMPED, 1)), "order 1 holds no growth rate; use 2 or more"),
        (
            lambda: enclosed_growth_rate(of("u'' + u + c*u'*sqrt(abs(u')) = 0", c=1), HALF, 64),
            r"the loss goes with \|u'\|\^\(3/2\), and whole powers only",
        ),
        (lambda: value_at_origin(sympy.gamma(U + 1), {}), "not a real function analytic at the origin"),
        (lambda: value_at_origin((U + 2) ** sympy.pi, {}), "has an exponent that is not rational"),
        (
            lambda: value_at_origin(sympy.sign(sympy.sin(1) ** 2 + sympy.cos(1) ** 2 - 1, evaluate=False), {}),
            "the sign in .* cannot be told",
        ),
        (lambda: certified_cycles(of("u'' + u = 0"), [1]), "has no small parameter to give values to"),
        (lambda: enclose(of("u'' + u + u*abs(u) = 0"), 1, method="closed form"), "has no closed form here; use the"),
        (lambda: two_sided(of("u'' + u + c*u*abs(u) = 0", "c")), "an enclosure needs numbers, and c has none"),
        (lambda: equation_text(sympy.true), "BooleanTrue True is no equation; give an Eq"),
        (lambda: named("a b"), "the name 'a b' cannot be written in an equation"),
        (lambda: from_text("u'' + sin(u) = 0", about="pi/7", potential=1 - sympy.cos(U)), "cannot be given together"),
        (lambda: minimax(find("pendulum"), up_to=Fraction(-1), degree=2), "the range up to -1 is empty"),
        (lambda: gappa_script(form_of(pendulum()), "motion"), "for polynomials with a domain"),
        (
            lambda: gappa_script(form_of(pendulum(4), up_to=2, mode="accurate")),
            "no rule for the compensated steps of mode accurate",
        ),
        (
            lambda: gappa_script(form_of(energy_integral(of("u'' + u + c*u**3 = 0", "c"), 4), up_to=1)),
            "functions of one variable, and omega0 has parameters",
        ),
        (
            lambda: gappa_script(form_of(energy_integral(of("u'' + 4*u + u**3 = 0"), 2), up_to=1)),
            "for k = 1, where the last product is exact",
        ),
        (lambda: form_of(mean_form(find("pendulum")), up_to=1, mode="accurate"), "written for polynomials in one"),
        (lambda: form_of(pendulum(), motion=True), "gives the frequency only; use lindstedt for the motion"),
        (lambda: form_of(energy_on_each_side(find("bilinear"), 2), motion=True), "no motion is written; leave it out"),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said) as refused:
        call()
    assert "\n" not in str(refused.value)


def test_a_certificate_that_would_take_too_many_bits_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    from ridgeback.symbolic.certificates import certificate

    monkeypatch.setattr(certificate, "MOST_BITS", 10)
    with pytest.raises(InputError, match="order 4 takes more than 10 bits"):
        _against_quadrature(find("pendulum"), pendulum())


def test_a_kink_in_the_velocity_that_takes_no_energy_has_no_method() -> None:
    assert "a kink in u' that takes no energy" in kink_advice(U + abs(V) * U, conservative=True)
    assert "are not analytic at rest" in kink_advice(U + abs(V) * V, conservative=False)
