"""Recursions in balls: every exact coefficient inside its ball, the same balls after an interrupt, no wrong file."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise

import pytest
from flint import arb, arb_poly, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball
from ridgeback.symbolic.expansion.ball_expansion import holds, missing_bits
from ridgeback.symbolic.expansion.cost import Budget, predict
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.high_order import in_balls as in_balls_module
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.series import harmonic_basis as basis_module
from ridgeback.symbolic.series import laurent as laurent_module
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

VDP = "van-der-pol"


@pytest.mark.parametrize("name", ["pendulum", "duffing", "helmholtz-duffing", VDP, "rayleigh"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_every_exact_coefficient_lies_in_its_ball(name: str, amplitude: str) -> None:
    found = lindstedt_in_balls(find(name), 20, amplitude=amplitude, digits=25)
    assert found.misses(lindstedt(find(name), 20, amplitude=amplitude)) == []
    assert missing_bits((*found.coefficients, *(found.amplitude_coefficients or ())), 25) == 0


@pytest.mark.parametrize(
    ("equation", "place"),
    [
        ("u'' - 2 + u**3 = 0", "2**(1/3)"),
        ("u'' - 1 + u**5 + u = 0", "0.7549"),  # a root that radicals do not give
        ("u'' + sin(u) - 1/2 = 0", "pi/6"),
        ("u'' + 2*u + u**2 = 0", None),
    ],
)
def test_irrational_coefficients_lie_in_their_balls(equation: str, place: str | None) -> None:
    own = Oscillator.from_equation(equation) if place is None else as_oscillator(equation, about=place)
    exact, found = lindstedt(own, 8), lindstedt_in_balls(own, 8, digits=30)
    assert missing_bits(found.coefficients, 30) == 0
    with ctx.workprec(200):
        for n, c in enumerate(exact.frequency):
            assert found.frequency[n].overlaps(number_ball(c)), n
    assert settled_limits(own, exact).radius == pytest.approx(settled_limits(own, found).radius)


def test_van_der_pol_to_order_40_keeps_its_digits_and_needs_a_predicted_precision() -> None:
    found = lindstedt_in_balls(find(VDP), 40)
    assert found.misses(lindstedt(find(VDP), 40)) == []
    assert all(c.is_zero() or c.rel_accuracy_bits() > 100 for c in found.coefficients)
    assert all(found.coefficients[n].is_zero() for n in range(1, 40, 2))  # omega0 is even in eps


def test_the_published_coefficients_are_met() -> None:
    # Andersen and Geer, SIAM J. Appl. Math. 42 (1982) 678.
    found = lindstedt_in_balls(find(VDP), 6)
    assert [holds(found.coefficients[n], c) for n, c in ((2, fmpq(-1, 16)), (4, fmpq(17, 3072)))] == [True, True]
    assert found.amplitude_coefficients is not None
    assert holds(found.amplitude_coefficients[4], fmpq(-1033, 552960))


def test_the_coefficients_oscillate_as_the_singularities_at_modulus_3_42_demand() -> None:
    # A pair rho exp(+-i t) gives c_(n+1) c_(n-1) - c_n^2 ~ -rho^(-2n) (per eps^2), so ratios of it tend to rho^-2.
    c = lindstedt_in_balls(find(VDP), 40).coefficients[::2]
    defects = [c[n + 1] * c[n - 1] - c[n] * c[n] for n in range(16, 20)]
    moduli = [(a / b).sqrt() for a, b in pairwise(defects)]
    assert all(abs(m - arb(3.42)) < 0.35 for m in moduli)


def test_units_travel_with_the_balls() -> None:
    fast = find(VDP).with_parameters({"k": 3})
    exact, found = lindstedt(fast, 6), lindstedt_in_balls(fast, 6)
    for ball, value in zip(found.frequency, exact.frequency, strict=True):
        assert holds(ball, fmpq(int(value.p), int(value.q)))
    with ctx.workprec(200):
        assert found.in_balls(arb(0.5)).overlaps(exact.in_balls(arb(0.5)))


def test_the_public_form_prints_digits_that_are_certain() -> None:
    rows = lindstedt_in_balls(find(VDP), 4, digits=12).to_dict()["frequency"]
    assert isinstance(rows, list)
    assert [row["powers"] for row in rows] == [{"eps": 0}, {"eps": 2}, {"eps": 4}]
    assert rows[2]["coefficient"] == "0.00553385416667"  # 17/3072
    json.dumps(rows)


def test_a_ball_beside_the_truth_is_detected() -> None:
    found = lindstedt_in_balls(find(VDP), 6)
    nudged = list(found.coefficients)
    with ctx.workprec(found.bits):
        nudged[4] = nudged[4] + arb(1e-25)
    assert replace(found, coefficients=tuple(nudged)).misses(lindstedt(find(VDP), 6)) == [4]


def test_an_error_in_the_products_breaks_solvability(monkeypatch: pytest.MonkeyPatch) -> None:
    real = laurent_module._folded

    def wrong(window: list[arb], *, sine: bool, sign: int) -> arb_poly:
        return real(window, sine=sine, sign=sign) * (1 + arb(2) ** -100)

    monkeypatch.setattr(laurent_module, "_folded", wrong)
    with pytest.raises(AssertionError, match="secular sine left"):
        lindstedt_in_balls(find(VDP), 8)


def test_an_error_in_the_solution_is_detected(monkeypatch: pytest.MonkeyPatch) -> None:
    real = basis_module._divided

    def wrong(p: arb_poly, lowest: int) -> arb_poly | None:
        found = real(p, lowest)
        return None if found is None else found * (1 + arb(2) ** -100)

    monkeypatch.setattr(basis_module, "_divided", wrong)
    assert lindstedt_in_balls(find(VDP), 8).misses(lindstedt(find(VDP), 8)) != []


def test_another_expansion_is_no_reference() -> None:
    with pytest.raises(InputError, match="one oscillator in one amplitude"):
        lindstedt_in_balls(find(VDP), 4).misses(lindstedt(find("rayleigh"), 4))


def test_too_few_bits_are_made_up_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(in_balls_module, "predicted_bits", lambda _: 90)
    found = lindstedt_in_balls(find(VDP), 16)
    assert found.bits > 90
    assert missing_bits(found.coefficients, 30) == 0
    assert found.misses(lindstedt(find(VDP), 16)) == []


def test_dropping_bits_on_the_way_costs_no_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    lean = lindstedt_in_balls(find(VDP), 36)
    monkeypatch.setattr(in_balls_module, "GUARD", 10_000)
    full = in_balls_module._Run(in_balls_module.Task(find(VDP), 36, "peak", 30), lean.bits, None, None).result()
    assert all(x.rad() <= y.rad() * 1.01 for x, y in zip(lean.coefficients, full.coefficients, strict=True))


def test_the_precision_of_the_caller_is_left_alone() -> None:
    before = ctx.prec
    lindstedt_in_balls(find(VDP), 6)
    assert ctx.prec == before


def test_what_balls_cannot_do_is_refused_in_one_line() -> None:
    with pytest.raises(InputError, match="c is no number; balls need one"):
        lindstedt_in_balls(Oscillator.from_equation("u'' + u + c*u**3"), 4)
    with pytest.raises(InputError, match="digits 0"):
        lindstedt_in_balls(find(VDP), 4, digits=0)
    with pytest.raises(InputError, match="no family"):
        lindstedt_in_balls(Oscillator.from_equation("u'' + 2*mu*u' + u + u**3", parameters={"mu": "0.01"}), 4)


def test_a_family_that_only_exact_arithmetic_can_prove_is_refused_as_such() -> None:
    centre = Oscillator.from_equation("u'' + u + u*u'")
    assert len(lindstedt(centre, 4).terms()) == 3
    with pytest.raises(InputError, match="balls cannot prove"):
        lindstedt_in_balls(centre, 4)


@pytest.mark.parametrize(("order", "gigabytes"), [(100, 0.023), (200, 0.127), (300, 0.252), (859, 3.6)])
def test_the_memory_of_a_limit_cycle_is_predicted_as_it_was_measured(order: int, gigabytes: float) -> None:
    assert predict("balls", order).gigabytes == pytest.approx(gigabytes, rel=0.5)


def test_order_859_is_within_an_hour_by_prediction_but_not_within_ten_minutes() -> None:
    assert predict("balls", 859).within(Budget(seconds=3600.0))
    with pytest.raises(InputError, match=r"order 859 by balls would take about .* fits"):
        lindstedt_in_balls(find(VDP), 859)
