"""The certified error of a truncated series."""

from fractions import Fraction

import pytest
from flint import arb, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.accuracy import certified_error
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.enclosure.own import own


@pytest.mark.parametrize("order", [2, 4, 8, 20])
def test_the_error_of_a_series_is_its_first_omitted_term(order: int) -> None:
    """At small amplitude; the sign is proved, since the ball excludes zero."""
    pendulum, small = find("pendulum"), Fraction(1, 50)
    error = certified_error(pendulum, lindstedt(pendulum, order), small, bits=256)
    omitted = -lindstedt(pendulum, order + 2).coefficients[order + 2] * fmpq(1, 50) ** (order + 2)
    assert not error.contains(0)
    assert abs(error / arb(omitted) - 1) < arb("0.01")


def test_the_error_grows_beyond_the_radius_of_convergence() -> None:
    """Duffing's series converges for eps A^2 < 1."""
    duffing = find("duffing")
    errors = [[abs(certified_error(duffing, lindstedt(duffing, n), A)) for n in (10, 30)] for A in ("0.8", "1.2")]
    assert errors[0][1] < errors[0][0]
    assert errors[1][1] > errors[1][0]


def test_errors_know_the_definition_and_the_scale() -> None:
    system = own("u'' + 2*u + u**2 + u**3")
    for definition in ("peak", "trough"):
        series = energy_integral(system, 12, amplitude=definition)
        error = certified_error(system, series, "0.05")
        assert not error.contains(0)
        assert abs(error) < arb("1e-13")


@pytest.mark.parametrize(
    ("system", "series", "match"),
    [
        ("duffing", lambda: lindstedt(find("pendulum"), 4), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing").with_parameters({"eps": "2"}), 4), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing").with_parameters({"k": "2"}), 0), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing"), 4, amplitude="fundamental"), "fundamental"),
        ("duffing", lambda: energy_integral(find("duffing"), 4, amplitude="action"), "action"),
        ("van-der-pol", lambda: lindstedt(find("van-der-pol"), 4), "in eps"),
    ],
)
def test_errors_of_foreign_series_are_refused(system: str, series, match: str) -> None:
    with pytest.raises(InputError, match=match):
        certified_error(find(system), series(), 1)
