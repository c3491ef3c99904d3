"""Equilibria that are roots of irreducible polynomials of degree three and more: exact series in the root."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.roots import Root, reduced, root_in
from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator

WELL = "u'' + u**3 - 3*u + 1 = 0"


def test_the_place_is_said_and_the_series_is_exact_in_it() -> None:
    """2 cos(2 pi/9) = 1.53209 is a root of u^3 - 3 u + 1; both ways to name it are one oscillator."""
    own, same = (as_oscillator(WELL, about=place) for place in ("1.532", "2*cos(2*pi/9)"))
    assert own == same
    assert "r = 1.5320888862379560704, a root of r**3 - 3*r + 1" in own.equation
    series = lindstedt(own, 6)
    assert all(check.passed for check in certify(own, series) if check.passed is not None)
    r = root_in(own.stiffness)
    assert r is not None
    assert sympy.N(r - 2 * sympy.cos(2 * sympy.pi / 9), 30) == pytest.approx(0, abs=1e-28)
    assert all(sympy.Poly(c / own.natural_frequency, r).degree() < 3 for c in series.frequency[2:])


@settings(max_examples=8, phases=[Phase.generate])
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(1, 3))
def test_cubic_forces_agree_with_their_decimals(b: int, c: int, a: int) -> None:
    """The same series with the root as a decimal of 40 digits, of which the machinery of roots knows nothing."""
    u = sympy.Symbol("u")
    polynomial = sympy.Poly(a * u**3 + b * u + c, u)
    assume(polynomial.is_irreducible)
    roots = [x for x in sympy.real_roots(polynomial) if sympy.N(polynomial.diff(u).as_expr().subs(u, x)) > 0.5]
    place = sympy.N(roots[-1], 40)
    own = as_oscillator(f"u'' + {a}*u**3 + ({b})*u + ({c}) = 0", about=str(sympy.N(place, 12)))
    text = f"u'' + (3*{a}*r**2 + ({b}))*u + 3*{a}*r*u**2 + {a}*u**3 = 0"
    known = lindstedt(Oscillator.from_equation(text, parameters={"r": str(place)}), 5).frequency
    for one, other in zip(lindstedt(own, 5).frequency, known, strict=True):
        assert sympy.N(one - other, 20) == pytest.approx(0, abs=1e-18)


def test_enclosures_know_the_root() -> None:
    own = as_oscillator(WELL, about="1.532")
    series = lindstedt(own, 20)
    found = enclose(own, Fraction(1, 20))
    assert abs(float(found.middle) - series(0.05)) < 1e-14
    assert float(found.radius) < 1e-15


def test_damping_stays_a_parameter_and_denominators_begin_with_one() -> None:
    own = as_oscillator("u'' + 2*mu*u' + (u**3 + u - 1)/(1 + u**2) = 0", about="0.6823", parameters={"mu": "0.01"})
    assert own.damping == "mu"
    r = root_in(own.stiffness)
    assert r is not None
    flow = multiple_scales(own, 2)
    by_hand = lindstedt(own.with_parameters({"mu": 0}), 2)
    assert sympy.N(by_hand.frequency[0] ** 2 - (3 * r**2 + 1) / (1 + r**2), 20) == pytest.approx(0, abs=1e-18)
    assert sympy.N(flow.frequency[0].coefficient - by_hand.frequency[0], 20) == pytest.approx(0, abs=1e-18)


def test_numbers_of_the_field_are_unique() -> None:
    x = sympy.Symbol("x")
    r = Root(2 * x**5 - 4 * x + 1, 1)
    value = (1 + r) / (r**2 - 3)
    assert sympy.N(reduced(value, r) - value, 30) == pytest.approx(0, abs=1e-27)
    assert reduced(value * (r**2 - 3) - 1 - r, r) == 0


@pytest.mark.parametrize(
    ("text", "about", "said"),
    [
        (WELL, "0.3473", "0.3472963.*saddle.*the equilibria are -1.8793.*1.5320"),
        (WELL, "1.60", "the nearest equilibrium is at 1.532"),
        ("u'' + u**3 + r*u - 1 = 0", "0.6823", "rename the r"),
        ("u'' + exp(u) - 2 - u**2 = 0", "1.3", r"near 1.319.*Taylor polynomial"),
    ],
)
def test_what_is_refused_says_what_works(text: str, about: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        as_oscillator(text, about=about, parameters={"r": 1} if "r*u" in text else None)
