"""Losses that are not analytic at rest: averaging against integration, multiple scales and enclosures."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import ridgeback
from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.flow.averaged_losses import averaged_losses, losses_of
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import U, V

SMALL = st.fractions(Fraction(-1, 2), Fraction(1, 2), max_denominator=5)
a, c, F, mu = (sympy.Symbol(name, real=True) for name in ("a", "c", "F", "mu"))


def change_in_a_cycle(equation: str, peak: float, tiny: float) -> float:
    """(A1 - A0) / (A0 T) from one peak to the next of the integrated motion, its losses multiplied by ``tiny``."""
    own = as_oscillator(equation)
    whole = own.substituted_force
    rest = whole.xreplace({V: sympy.S.Zero})
    force = sympy.lambdify((U, V), rest + tiny * (whole - rest), ["math", {"sign": np.sign}])
    time, state = 0.0, (peak, 0.0)
    for part, sign in ((0, 1.0), (1, -1.0), (0, -1.0), (1, 1.0)):  # to u = 0, to the trough, to u = 0, to the next peak

        def stop(t: float, y: np.ndarray, part: int = part, sign: float = sign) -> float:
            return float(y[part]) if t > 0 else sign

        stop.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(
            lambda _, y: (y[1], -force(y[0], y[1])), (0, 100), state, "DOP853", events=stop, rtol=1e-12, atol=1e-15
        )
        time += float(run.t_events[0][0])
        state = tuple(float(x) if i != part else 0.0 for i, x in enumerate(run.y_events[0][0]))  # type: ignore[assignment]
    return (state[0] - peak) / (peak * time * tiny)


def test_the_leading_terms_are_the_textbook_s() -> None:
    flow = averaged_losses("u'' + 2*mu*u' + c*abs(u')*u' + F*sign(u') + u = 0", 2)
    expected = -mu - 4 * c * a / (3 * sympy.pi) - 2 * F / (sympy.pi * a)
    assert sympy.expand(flow.growth_rate_expression() - expected) == 0
    assert flow.growth_rate_at(0.5, 0.01, 0.02, 0.03) == pytest.approx(
        -0.03 - 4 * 0.02 * 0.5 / (3 * np.pi) - 2 * 0.01 / (np.pi * 0.5)
    )
    assert flow.frequency_at(0.5, 0.01, 0.02, 0.03) == 1
    public = flow.to_dict()
    assert "damping" not in public
    assert (public["loss_order"], public["second_order"]) == (1, "below")
    assert public["growth_rate"][0] == {  # type: ignore[index]
        "powers": {"a": -1, "F": 1, "c": 0, "mu": 0},
        "coefficient": "-2/pi",
        "decimal": -2 / np.pi,
    }


@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
@pytest.mark.parametrize(
    "equation",
    [
        "u'' + sign(u')/100 + abs(u')*u'/10 + sin(u) = 0",
        "u'' + c*(sign(u') + abs(u')*u' + abs(u')**(1/2)*sign(u')) + u + u**3 = 0",
        "u'' + d*abs(u)*u' + u - u**3/4 = 0",
        "u'' + u**2*sign(u')/3 + d*u'**3 + sin(u) = 0",
    ],
)
def test_a_higher_order_leaves_the_coefficients_of_a_loss_as_they_are(equation: str, amplitude: str) -> None:
    """c(u) |u'|^r gives a'/a through a^(r + order - 3): through that of the lowest r a sum of losses is whole."""
    low, high = (averaged_losses(equation, order, amplitude=amplitude) for order in (4, 6))
    assert len({term.powers for term in low.growth_rate}) == len(low.growth_rate)
    assert len({term.powers for term in low.frequency}) == len(low.frequency)
    exponents = [loss.exponent for loss in losses_of("own", as_oscillator(equation).force)]
    mine, other = ({term.powers: term.coefficient for term in flow.growth_rate} for flow in (low, high))
    whole = min(exponents) + 1
    assert {p: c for p, c in mine.items() if p[0] <= whole} == {p: c for p, c in other.items() if p[0] <= whole}
    assert len(exponents) > 1 or mine.items() <= other.items()


def test_the_picture_is_of_the_undamped_backbone() -> None:
    given, named = (
        averaged_losses(f"u'' + {F}*sign(u') + {c}*abs(u')*u' + sin(u) = 0", 4, amplitude="peak").picture()
        for F, c in (("(1/10)", "(1/5)"), ("F", "c"))
    )
    assert given.strokes == named.strokes
    assert "F = 0, c = 0" in named.title
    assert given.x_label == "a (peak)"


def test_losses_over_a_sum_of_other_parameters() -> None:
    F, b = (sympy.Symbol(name, real=True) for name in "Fb")
    flow = averaged_losses("u'' + F*sign(u')/(1+b) + u + u**3 = 0", 4)
    plain = averaged_losses("u'' + F*sign(u') + u + u**3 = 0", 4)
    assert flow.losses == ("F",)
    for mine, other in (
        (flow.frequency_expression(), plain.frequency_expression()),
        (flow.growth_rate_expression(), plain.growth_rate_expression()),
    ):
        assert sympy.cancel(mine - other.subs(F, F / (1 + b))) == 0
    given = averaged_losses(as_oscillator("u'' + F*sign(u')/(1+b) + u + u**3 = 0").with_parameters({"b": 1}), 4)
    assert given.frequency_at(0.5, 0.02) == pytest.approx(plain.frequency_at(0.5, 0.01), rel=1e-14)
    assert given.growth_rate_at(0.5, 0.02) == pytest.approx(plain.growth_rate_at(0.5, 0.01), rel=1e-14)


@pytest.mark.parametrize("force", ["u + u**3", "sin(u) + u**2/3", "u + u**2/4 - u**3/5"])
def test_analytic_losses_agree_with_multiple_scales_to_first_order(force: str) -> None:
    equation = f"u'' + 2*mu*u' + d*u'**3 + {force} = 0"
    flow = averaged_losses(equation, 6)
    whole = sympy.expand(multiple_scales(equation, 6).growth_rate_expression())
    d = sympy.Symbol("d", real=True)
    for name in (mu, d):
        alone = {mu: 0, d: 0, name: name}
        linear = whole.subs(alone).coeff(name, 1)
        mine = sympy.expand(flow.growth_rate_expression()).subs(alone).coeff(name, 1)
        top = sympy.degree(linear, a)
        assert sympy.expand(sympy.series(mine - linear, a, 0, top + 1).removeO()) == 0


@settings(deadline=None, max_examples=3)
@example(Fraction(0), Fraction(1, 2), Fraction(1))
@given(SMALL, SMALL, st.fractions(Fraction(1, 2), 3, max_denominator=3))
def test_random_kinked_systems_lose_what_averaging_says(b: Fraction, s: Fraction, k2: Fraction) -> None:
    equation = (
        f"u'' + (1/3)*sign(u') + (1/2 + ({s})*u)*abs(u')*u' + u'/5"
        f" + max(u, 0) + ({k2})*min(u, 0) + ({b})*u*abs(u) + u**3/6 = 0"
    )
    flow = averaged_losses(equation, 4)
    smooth = k2 == 1 and b == 0  # no kink of the force at u = 0, about which a fundamental is of use
    assert flow.amplitude == ("fundamental" if smooth else "peak")
    values = [1 / 10] if "mu" in flow.losses else []
    found = change_in_a_cycle(equation, 0.02, 1e-6)
    assert found == pytest.approx(float(flow.growth_rate_at(0.02, *values)), rel=1e-4)


def test_dry_friction_takes_the_same_from_each_half_cycle() -> None:
    """Of a linear spring 2F/k^2 exactly, so that averaging is exact: A1 = A0 - 4F, T = 2 pi."""
    assert change_in_a_cycle("u'' + sign(u') + u = 0", 1.0, 1e-3) == pytest.approx(-2 / np.pi, rel=1e-9)


@pytest.mark.parametrize(
    "equation",
    [
        "u'' + 2*mu*u' + c*abs(u')*u' + F*sign(u') + k**2*sin(u) = 0",
        "u'' + F*sign(u') + 4*max(u, 0) + min(u, 0) + u*abs(u) = 0",
        "u'' + 0.1*u'*abs(u')*(1 + u) + u + u**2/3 = 0",
        "u'' + d*abs(u)*u' + u - u**3/4 = 0",
        "u'' + c*d*abs(u')*u' + F*sign(u')/(1 + b) + u = 0",
    ],
)
def test_the_certificate_holds(equation: str) -> None:
    (check,) = certify(equation, ridgeback.derive(equation, 4))
    assert check.passed, check.statement


@pytest.mark.parametrize(
    ("equation", "why"),
    [
        ("u'' + sign(u') + abs(u')*u + u = 0", "do not"),
        ("u'' + sinh(u') + sign(u') + u = 0", "no power of u'"),
        ("u'' + sign(u') + u**3 = 0", "linear restoring force"),
        ("u'' + sign(u') + u + u**2*abs(u)**(1/2) = 0", "whole powers of u on each side"),
    ],
)
def test_what_has_no_average_is_refused(equation: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        averaged_losses(equation, 4)


def test_other_derivations_name_the_one_that_works() -> None:
    with pytest.raises(InputError, match="averaged_losses"):
        multiple_scales("u'' + sign(u') + u = 0", 2)
    with pytest.raises(InputError, match="no weights"):
        ridgeback.derive("u'' + sign(u') + u = 0", 2, weight=1)
    with pytest.raises(InputError, match="not analytic at rest"):
        ridgeback.generate("u'' + F*sign(u') + u = 0", resummed="pade")
