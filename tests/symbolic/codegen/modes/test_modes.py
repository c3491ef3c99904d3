"""Modes: the proved bound comes to what each promises, by exact first terms, and by the cheapest evaluation."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from flint import arb, ctx, fmpq
from hypothesis import Phase, assume, example, given, settings
from hypothesis import strategies as st

from ridgeback.interface.source import known_form
from ridgeback.symbolic.codegen import form_of
from ridgeback.symbolic.codegen.evaluation import value_at, values_at
from ridgeback.symbolic.codegen.fit.fit import minimax
from ridgeback.symbolic.codegen.modes.leading import leading
from ridgeback.symbolic.codegen.modes.mode import GOALS, in_mode
from ridgeback.symbolic.codegen.number import FLOAT32, FLOAT64, Number, Real
from ridgeback.symbolic.codegen.polynomial import polynomial_function
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Mode, Operation
from ridgeback.symbolic.codegen.proofs.bounds import bound
from ridgeback.symbolic.codegen.proofs.runs import exact_value
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.systems.catalogue import find

GENERATED = (Phase.explicit, Phase.reuse, Phase.generate)
"""Without a search for a smaller failure: each example is a proof of its own."""
COEFFICIENTS = st.lists(st.fractions(-2, 2, max_denominator=999), min_size=1, max_size=6)


def made(
    mode: Mode, coefficients: list[Fraction], end: float, *, even: bool, real: Real = FLOAT64
) -> tuple[Form, Function]:
    terms = {((1 + even) * i,): Number(fmpq(c.numerator, c.denominator), real) for i, c in enumerate(coefficients)}
    domain = Domain("A", -end if even else 0.0, end)
    function = polynomial_function("f", "", (Argument("A", ""),), ("A",), terms, domain, real=real)
    return Form("any", "Any", (), (function,), mode=mode, real=real), function


@pytest.mark.parametrize("order", [12, 40])
@pytest.mark.parametrize("mode", ["strict", "fma", "accurate"])
def test_the_pendulum_comes_to_what_each_mode_promises(mode: Mode, order: int) -> None:
    form = form_of(energy_integral(find("pendulum"), order), up_to=Fraction("2.36"), mode=mode)
    found = bound(form, form.functions[0])
    assert found is not None
    assert found.ulps is not None
    assert found.ulps <= GOALS[mode]
    carried = [s for s in form.functions[0].body if getattr(s, "operation", None) is Operation.TWO_PRODUCT]
    assert bool(carried) == (mode == "accurate")  # which costs most


@pytest.mark.parametrize("mode", ["strict", "fma"])
def test_a_fit_with_full_coefficients_comes_to_it_too(mode: Mode) -> None:
    """Even, in A^2, and uneven, in A."""
    for fit in (minimax(find("pendulum"), Fraction(2), degree=6), minimax(find("toda"), Fraction(1, 2), degree=4)):
        form = form_of(fit, up_to=fit.end, mode=mode)
        found = bound(form, form.functions[0])
        assert found is not None
        assert found.ulps is not None
        assert found.ulps <= GOALS[mode]


@settings(deadline=None, max_examples=30, phases=GENERATED)
@example([Fraction(0), Fraction(-46, 747), Fraction(299, 935)], 1.0, False, "fma", 1)  # a product under a factor's name
@given(COEFFICIENTS, st.floats(0.125, 3), st.booleans(), st.sampled_from(["strict", "fma"]), st.integers(0, 64))
def test_any_polynomial_is_within_the_bound_of_its_mode(
    rest: list[Fraction], end: float, even: bool, mode: Mode, share: int
) -> None:
    form, function = made(mode, [Fraction(1), *rest], end, even=even)
    chosen = in_mode(form, function)
    found = bound(form, chosen)
    assert found is not None
    x = end * share / 64
    with ctx.workprec(300):
        exact = exact_value({p[0]: c for p, c in function.polynomial.terms.items()}, arb(x))  # type: ignore[union-attr]
        error = abs(arb(value_at(form, chosen, (x,))) - exact)
        assert error.upper() <= float(found.absolute)


@settings(deadline=None, max_examples=60, phases=GENERATED)
@given(
    st.tuples(*[st.fractions(-5, 5, max_denominator=10**6)] * 3),
    st.floats(2.0**-9, 2.0**9),
    st.booleans(),
    st.sampled_from(["strict", "fma"]),
    st.sampled_from([FLOAT64, FLOAT32]),
    st.integers(-64, 64),
)
def test_the_first_terms_are_exact(
    coefficients: tuple[Fraction, ...], end: float, even: bool, mode: Mode, real: Real, share: int
) -> None:
    """What is computed is the sum of the first terms itself, in rationals; so is the sum of both parts of x."""
    assume(coefficients[1] != 0)  # without a first power the polynomial is written in x^2
    end = math.ldexp(round(math.ldexp(end, 12)), -12)
    form, function = made(mode, list(coefficients), end, even=even, real=real)
    x = math.ldexp(round(math.ldexp(end * (share if even else abs(share)) / 64, 12)), -12)
    for candidate in leading(form, function):
        values = values_at(form, candidate, (x,))
        at = next(name.removesuffix("_high") for name in values if name.endswith("_high"))
        main = next(s for s in candidate.body if getattr(s, "name", "").endswith("_main"))
        high, slope, constant = main.operands  # type: ignore[union-attr]
        assert isinstance(slope, Number)
        assert isinstance(constant, Number)
        assert slope.representable
        assert constant.representable
        exact = Fraction(values[high]) * Fraction(slope.nearest) + Fraction(constant.nearest)  # type: ignore[index]
        assert Fraction(values[main.name]) == exact
        wanted = Fraction(x) ** (2 if even else 1)
        left = abs(Fraction(values[f"{at}_high"]) + Fraction(values[f"{at}_low"]) - wanted)
        assert left <= wanted * real.unit * 2


HARDEST = ("kepler", "lennard-jones", "morse", "rotating-hoop")
"""Of the catalogue: by what the terms cancel, and by where the polynomial is 0."""


@pytest.mark.parametrize("mode", ["strict", "fma", "accurate"])
@pytest.mark.parametrize("name", HARDEST)
def test_the_goal_is_met_on_the_range_of_the_series(name: str, mode: Mode) -> None:
    """omega0 and, down to the smallest amplitudes, its slope, where that has no other zero; against exact values."""
    oscillator = find(name)
    series = energy_integral(oscillator, 12)
    form = known_form(oscillator, series, series, mode=mode)
    for function in form.functions[: 1 + (name != "rotating-hoop")]:
        found = bound(form, function)
        assert found is not None
        assert found.ulps is not None
        assert found.ulps <= GOALS[mode]
        assert (found.least == 0) == (function.name == "omega0")
        terms = {p[0]: c for p, c in function.polynomial.terms.items()}  # type: ignore[union-attr]
        high = function.domain.high
        for x in (*(high * i / 31 for i in (-31, -30, -17, 1, 2, 11, 29, 30, 31)), 1e-9, 7e-100, float(found.least)):
            if not (x or found.least == 0):
                continue
            with ctx.workprec(400):
                exact = exact_value(terms, arb(x))
                error = abs(arb(value_at(form, function, (x, 1.0))) - exact)
                assert error <= arb(float(GOALS[mode])) * math.ulp(float(exact))


def test_a_bound_is_none_in_the_last_place_where_the_polynomial_is_zero() -> None:
    """And the note says where: the amplitude at which Kepler's polynomial of order 8 is 0."""
    form = form_of(energy_integral(find("kepler"), 8), up_to=Fraction(1, 2))
    assert "none in units in the last place, as the value may be 0 near A = -0.4725." in form.functions[0].notes[0]


def test_nothing_is_taken_that_is_not_needed() -> None:
    """A polynomial near 1 keeps Horner's rule; one without a domain has no bound to be judged by."""
    form, function = made("strict", [Fraction(1), Fraction(1, 1000)], 1.0, even=True)
    assert in_mode(form, function).body == function.body
    free = replace(function, domain=replace(function.domain, known=False))
    assert in_mode(form, free).body == function.body


def test_a_range_that_begins_at_a_pole_has_code_without_a_bound_over_it() -> None:
    form = form_of(energy_on_each_side(find("cube-root"), 2), up_to=Fraction(3))
    value = value_at(form, form.functions[0], (1.0,))
    assert "times the sum of the absolute values" in form.functions[0].notes[-1]
    assert value == pytest.approx(1.0704505140376157, rel=1e-12)  # R. E. Mickens: 1.070451
