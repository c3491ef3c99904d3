"""Forces a(u) + b(u) u'^2: the conserved energy by its integrating factor, and what is held against it."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
import sympy
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.accuracy import accuracy
from ridgeback.symbolic.certificates.at_amplitudes import certified_frequencies
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.oscillator import Oscillator, U
from ridgeback.symbolic.systems.potential import potential_of

HEAVY = Oscillator.from_equation("u'' + u + u*u'**2 = 0", name="heavy", potential="u**2/2")


def by_singular_quadrature(force: str, amplitude: str) -> mpmath.mpf:
    """omega0 of u'' + f(u) + u u'^2, odd f: (u'^2 e^(u^2))' = -2 f e^(u^2) u', integrated twice as it stands."""
    with mpmath.workdps(30):
        top = mpmath.mpf(amplitude)
        cubic = 1 if "**" in force else 0

        def square(u: mpmath.mpf) -> mpmath.mpf:
            return 2 * mpmath.quad(lambda s: (s + cubic * s**3) * mpmath.exp(s * s), [u, top]) * mpmath.exp(-u * u)

        def slow(phi: mpmath.mpf) -> mpmath.mpf:
            return top * mpmath.cos(phi) / mpmath.sqrt(square(top * mpmath.sin(phi)))

        return mpmath.pi / 2 / mpmath.quad(slow, [0, mpmath.pi / 2 * (1 - mpmath.mpf(10) ** -6)])


@pytest.mark.parametrize("force", ["u", "u + u**3"])
def test_the_enclosure_holds_the_plain_quadrature(force: str) -> None:
    found = enclose(Oscillator.from_equation(f"u'' + {force} + u*u'**2"), "0.8", bits=80)
    assert found.method == "quadrature"
    # The twin leaves out the last millionth of the integral, whose integrand is near 1/omega0 there.
    assert float(found.omega) == pytest.approx(float(by_singular_quadrature(force, "0.8")), rel=2e-6)


def test_the_series_tends_to_the_enclosure_at_its_order() -> None:
    """Lindstedt-Poincaré knows nothing of the integrating factor; its error at order 6 is that of A^8."""
    series = lindstedt(HEAVY, 6)
    first, second = (certified_frequencies(HEAVY, series, [Fraction(1, n)])[0].error for n in (16, 32))
    assert first is not None
    assert second is not None
    assert float(first / second) == pytest.approx(2**8, rel=0.02)
    assert float(first * 16**8) == pytest.approx(79 / 786432, rel=0.02)  # the next coefficient is -79/786432


def test_the_closed_form_of_mathews_and_lakshmanan_has_its_error() -> None:
    """omega0 = 1/sqrt(1 + A^2/4) exactly (Quarterly of Applied Mathematics 32 (1974) 215)."""
    own = Oscillator.from_equation("(1 + u**2/4)*u'' - u*u'**2/4 + u")
    row = certified_frequencies(own, lindstedt(own, 4), [Fraction(1)])[0]
    assert row.exact.omega.overlaps(2 / arb(5).sqrt())
    assert row.error is not None
    assert float(row.error) == pytest.approx((1 - 1 / 8 + 3 / 128) / (2 / 5**0.5) - 1, rel=1e-10)
    hard = Oscillator.from_equation("(1 - u**2/4)*u'' + u*u'**2/4 + u")
    assert enclose(hard, 1).omega.overlaps(2 / arb(3).sqrt())
    with pytest.raises(InputError, match="no closed orbit"):
        enclose(hard, "2.5")


def test_the_series_and_its_resummations_have_proved_errors() -> None:
    series, *others = accuracy(HEAVY, 8, [Fraction(1)])
    assert series.formula.method == "lindstedt"
    assert others
    assert all(row.errors[0] is not None and abs(row.errors[0]) < 1e-5 for row in (series, *others))


def test_velocity_terms_that_are_set_to_zero_leave_the_potential() -> None:
    own = Oscillator.from_equation("u'' + u + u**3 + c*u*u'**2", parameters={"c": 0})
    assert enclose(own, 1).omega.overlaps(enclose(Oscillator.from_equation("u'' + u + u**3"), 1).omega)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("u'' + u + u*u'**4", "velocity terms other than .* encloses its frequency by integration"),
        ("u'' - c*(1 - u**2)*u' + u", "no family of orbits .* enclosed at values of the small parameter"),
    ],
)
def test_what_cannot_be_enclosed_is_said_with_what_can_be_done(text: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        enclose(Oscillator.from_equation(text, parameters={"c": 1} if "c*" in text else {}), 1)


def test_a_potential_beside_velocity_terms_is_checked() -> None:
    with pytest.raises(InputError, match="does not differentiate to the restoring force"):
        Oscillator.from_equation("u'' + u + u*u'**2 = 0", potential="u**2")
    assert HEAVY.potential is None


@pytest.mark.parametrize(
    "force",
    [
        U * sympy.exp(U**2),
        (U + U**3) * sympy.exp(U**2),
        (3 + U**2) * sympy.exp(-2 * U),
        sympy.cos(U) * sympy.cosh(sympy.sin(U)),
        U**2 * sympy.tan(U**3),
    ],
    ids=str,
)
def test_the_rules_of_exponentials_and_chains_differentiate_back(force: sympy.Expr) -> None:
    integral = potential_of(force)
    assert integral is not None
    assert integral.subs(U, 0) == 0
    assert all(abs((integral.diff(U) - force).evalf(30, subs={U: x})) < 1e-25 for x in (0.1, 0.7, -1.1))


def test_an_exponential_without_an_elementary_integral_has_no_rule() -> None:
    assert potential_of(sympy.exp(U**2)) is None
    assert potential_of(U**2 * sympy.exp(U**2)) is None
