"""Amplitudes that a force with terms in u' does not have, and parameters that are named like the amplitude."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

HEAVY = Oscillator.from_equation("(1 + u'**2)*u'' + u = 0", name="heavy")


@pytest.mark.parametrize("definition", ["action", "energy"])
def test_terms_in_the_velocity_have_no_action_and_no_energy(definition: str) -> None:
    """For (1 + u'^2) u'' + u = 0 u'^2/2 + u'^4/4 + u^2/2 is conserved; omega dJ of the plane is not its change."""
    with pytest.raises(InputError, match=f"heavy has terms in u', .*'{definition}'.*use peak, trough or fundamental"):
        lindstedt(HEAVY, 4, amplitude=definition)
    for other in ("peak", "trough", "fundamental"):
        with pytest.raises(InputError, match="terms in u'"):
            lindstedt(HEAVY, 4, amplitude=other).convert(definition)


def test_the_peak_series_with_terms_in_the_velocity_agrees_with_its_first_integral() -> None:
    """E = u'^2/2 + u'^4/4 + u^2/2 is A^2/2 at the turning point and the same where u = 0, through A^5."""
    a, tau = sympy.Symbol("A", positive=True), sympy.pi / 2
    series = lindstedt(HEAVY, 4)
    slope = sum(
        (sympy.Rational(-h.multiple) * sum(c * a**n for n, c in enumerate(h.cosine)) * sympy.sin(h.multiple * tau))
        for h in series.harmonics
    )
    assert all(h.multiple % 2 for h in series.harmonics)  # so that u = 0 a quarter of a period after the peak
    v = sympy.expand(series.expression().subs(sympy.Symbol("A", real=True), a) * slope)
    energy = sympy.expand(v**2 / 2 + v**4 / 4)
    assert [energy.coeff(a, n) for n in range(6)] == [0, 0, sympy.Rational(1, 2), 0, 0, 0]


def test_a_damping_that_is_set_to_zero_leaves_every_amplitude() -> None:
    undamped = find("damped-pendulum").with_parameters({"mu": 0})
    for definition in ("action", "energy"):
        converted = lindstedt(undamped, 4).convert(definition)
        assert converted.coefficients == energy_integral(find("pendulum"), 4, amplitude=definition).coefficients


@pytest.mark.parametrize(
    ("name", "derive"),
    [
        ("A", lambda own: lindstedt(own, 4)),
        ("A", lambda own: energy_integral(own, 4)),
        ("A", lambda own: lindstedt_in_balls(own.with_parameters({"A": 1}), 4)),
        ("a", lambda own: multiple_scales(own, 4)),
    ],
)
def test_a_parameter_named_like_the_amplitude_is_refused(name: str, derive: Callable[[Oscillator], object]) -> None:
    """Printed, both would be one symbol: 3 A/8 A^2 would read 3 A^3/8."""
    own = Oscillator.from_equation(f"u'' + u + {name}*u**3 = 0", name="mine")
    with pytest.raises(InputError, match=f"mine: the parameter {name} .*rename it, e.g. {name}1"):
        derive(own)


def test_other_names_stay_free() -> None:
    small = Oscillator.from_equation("u'' + u + a*u**3 = 0")
    assert str(lindstedt(small, 2).frequency[2]) == "3*a/8"
    large = Oscillator.from_equation("u'' + u + A*u**3 = 0")
    assert str(multiple_scales(large, 2).frequency_expression()) in ("3*A*a**2/8 + 1", "1 + 3*A*a**2/8")
