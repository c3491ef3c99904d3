"""The error of a formula over a whole range: no exact frequency lies beyond it, and some come near."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.codegen.fit.fit import minimax
from ridgeback.symbolic.codegen.fit.over_range import balls, largest_error
from ridgeback.symbolic.codegen.fit.surrogate import surrogate
from ridgeback.symbolic.codegen.fit.truncation import errors_up_to
from ridgeback.symbolic.codegen.proofs.facts import certified_facts
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.systems.catalogue import find


def seen(system: str, formula: object, end: Fraction) -> float:
    """The largest relative error at points of the range."""
    worst = 0.0
    with ctx.workprec(160):
        for i in range(1, 17):
            x = end * i / 16
            exact = enclose(find(system), x).omega
            worst = max(worst, float(abs(formula.in_balls(ball(x)) / exact - 1).upper()))  # type: ignore[attr-defined]
    return worst


CASES = (
    ("pendulum", 12, "2.36", None),
    ("duffing", 8, "0.5", None),
    ("toda", 6, "0.5", None),
    ("morse", 6, "0.25", None),
    ("helmholtz-duffing", 6, "0.4", None),
    ("pendulum", 16, "2.5", "pade"),
)


@pytest.mark.parametrize(("system", "order", "end", "kind"), CASES)
def test_the_bound_holds_over_the_range_and_is_met_in_it(system: str, order: int, end: str, kind: str | None) -> None:
    oscillator, last = find(system), Fraction(end)
    series = lindstedt(oscillator, order)
    formula = series if kind is None else resum(oscillator, series, kind, up_to=last)
    (half, whole), symmetric = errors_up_to(oscillator, formula, [last / 2, last])
    assert symmetric == (system in ("pendulum", "duffing"))
    for bound, place in ((half, last / 2), (whole, last)):
        largest = seen(system, formula, place)
        assert largest <= bound <= 1.05 * largest + 1e-28
    assert half < whole


@pytest.mark.parametrize(("system", "end"), [("toda", "1"), ("helmholtz-duffing", "0.5"), ("josephson", "1")])
def test_a_potential_that_is_not_even_is_fitted_in_the_amplitude(system: str, end: str) -> None:
    """As near as the best fit with real coefficients, and the bound is met."""
    fit = minimax(find(system), Fraction(end), degree=5)
    assert (fit.step, fit.variable, fit.coefficients[0]) == (1, "A", 1)
    assert float(fit.error) <= 1.02 * fit.optimum
    worst = 0.0
    with ctx.workprec(100):
        for i in range(1, 41):
            x = Fraction(end) * i / 40
            value = sum((ball(c * x**n) for n, c in enumerate(fit.coefficients)), arb(0))
            exact = enclose(find(system), x).omega / enclose(find(system), 0).omega
            worst = max(worst, float(abs(value / exact - 1).upper()))
    assert 0.9 * float(fit.error) <= worst <= float(fit.error)


def test_a_pole_in_the_range_has_no_bound() -> None:
    exact = surrogate(well_of(find("duffing")), Fraction(1, 2), goal=40)
    with pytest.raises(InputError, match="could not be bounded"):
        largest_error(exact, balls([Fraction(1)]), balls([Fraction(1), Fraction(-8)]))
    (error,) = largest_error(exact, balls([Fraction(1), Fraction(1, 4)]), balls([Fraction(1), Fraction(-1, 8)]))
    assert 0 < error < Fraction(1, 10)


def test_what_is_not_enclosed_over_a_range_is_certified_at_amplitudes() -> None:
    """A force that u' changes, and a barrier of which no neighbourhood is free of singularities."""
    for system in ("parabola", "kepler"):
        series = lindstedt(find(system), 4)
        with pytest.raises(InputError, match=r"whole range|range up to"):
            errors_up_to(find(system), series, [Fraction(1, 4), Fraction(1, 2)])
        assert "at A = " in certified_facts(find(system), series, Fraction(1, 2))[0]
    assert certified_facts(find("van-der-pol"), lindstedt(find("van-der-pol"), 2), Fraction(1, 2)) == ()
