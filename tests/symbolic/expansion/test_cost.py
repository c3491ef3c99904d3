"""Costs are predicted and refused before the work."""

from typing import Any

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.cost import Budget, balls_of, duration, effort_of, predict
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import U


@pytest.mark.parametrize("derive", [lindstedt, energy_integral, multiple_scales])
@pytest.mark.parametrize("name", ["pendulum", "duffing"])
def test_an_order_beyond_the_budget_is_refused_at_once_with_one_that_fits(derive, name: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=r"order 1000000 by .* order \d+ fits") as caught:
        derive(find(name), 10**6)
    fits = int(str(caught.value).split()[-2])
    assert 0 < fits < 10**6


def test_the_order_said_to_fit_does_fit_and_the_next_does_not() -> None:
    budget = Budget(seconds=0.01)
    with pytest.raises(InputError) as caught:
        lindstedt(find("van-der-pol"), 500, budget=budget)
    fits = int(str(caught.value).split()[-2])
    assert predict("limit-cycle", fits).within(budget)
    assert not predict("limit-cycle", fits + 1).within(budget)


def test_symbolic_parameters_cost_more() -> None:
    assert predict("lindstedt", 20, parameters=2).seconds > 10 * predict("lindstedt", 20).seconds


def test_a_force_of_many_functions_is_dearer() -> None:
    """Orders 100 and 160 of sin(u) exp(u) / (1 + u^2) take 1.8 s and 67 MB, and 9.2 s; order 100 of sin(u) 0.08 s."""
    u = sympy.Symbol("u", real=True)
    dear = effort_of(sympy.sin(u) * sympy.exp(u) / (1 + u**2), u)
    cost = predict("lindstedt", 100, effort=dear)
    assert 1.8 / 3 < cost.seconds < 3 * 1.8
    assert 9.2 / 3 < predict("lindstedt", 160, effort=dear).seconds < 3 * 9.2
    assert 0.067 / 3 < cost.gigabytes < 3 * 0.067
    with pytest.raises(InputError, match="order 1000 by lindstedt would take about"):
        lindstedt(as_oscillator("u'' + sin(u)*exp(u)/(1+u**2) = 0"), 1000)


def test_the_energy_integral_goes_to_high_orders() -> None:
    """Reversion and composition of power series: A^1600 takes half a minute and less than half a gigabyte."""
    assert predict("energy-integral", 1600).within(Budget(seconds=60, gigabytes=1))
    exact = energy_integral(find("pendulum"), 120).frequency
    assert exact[:41] == lindstedt(find("pendulum"), 40).frequency


@pytest.mark.parametrize(
    ("name", "order", "seconds", "gigabytes"),
    [
        ("pendulum", 120, 0.57, 0.0022),
        ("pendulum", 360, 16.3, 0.0156),
        ("duffing", 60, 0.06, 0.0010),
        ("duffing", 240, 1.04, 0.0221),
        ("cubic-quintic", 120, 0.51, 0.0057),
        ("helmholtz-duffing", 80, 1.05, 0.0066),
        ("morse", 50, 0.84, 0.0023),
        ("toda", 80, 1.22, 0.0032),
        ("van-der-pol", 100, 1.19, 0.0242),
    ],
)
def test_balls_are_foretold_within_a_factor_of_three(name: str, order: int, seconds: float, gigabytes: float) -> None:
    """What lindstedt_in_balls took with 30 digits."""
    cost = predict(balls_of(find(name)), order)
    assert 1 / 3 < cost.seconds / seconds < 3
    assert 1 / 3 < cost.gigabytes / gigabytes < 3


def test_times_are_told_in_the_unit_that_reads_best() -> None:
    """The greatest of which there are two, or one hour."""
    said = {
        119: "119 s",
        120: "2 min",
        3599: "60 min",
        3600: "1 h",
        172799: "48 h",
        172800: "2 days",
        7e7: "2.22 years",
    }
    assert {seconds: duration(seconds) for seconds in said} == said


@pytest.mark.parametrize(
    ("law", "equation", "order", "told", "seconds", "gigabytes", "within"),
    [
        ("theta series", None, 240, {}, 0.29, 0.024, 3),
        ("lindstedt", "u'' + u + u**2 + u**3 = 0", 80, {}, 0.19, 0.0061, 3),
        ("lindstedt", "u'' + u + b*u**2 + c*u**3 = 0", 26, {"parameters": 2}, 0.087, 0.0022, 7),
        ("limit-cycle", None, 80, {}, 0.55, 0.037, 3),
        ("energy-integral", None, 400, {}, 0.19, 0.0068, 3),
        ("energy-integral", None, 800, {}, 1.5, 0.037, 3),
        ("multiple-scales", None, 60, {"weights": (2,)}, 0.42, 0.0073, 3),
    ],
)
def test_exact_series_are_foretold(
    law: str, equation: str | None, order: int, told: dict[str, Any], seconds: float, gigabytes: float, within: float
) -> None:
    """What pendulum, Helmholtz-Duffing and van der Pol took; with parameters it depends on what is free of them."""
    effort = effort_of(as_oscillator(equation).normalised.bound, U) if equation else 1.0
    cost = predict(law, order, effort=effort, **told)
    assert 1 / within < cost.seconds / seconds < within
    assert 1 / within < cost.gigabytes / gigabytes < within
