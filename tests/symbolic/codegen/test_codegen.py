"""Generated code, run: against exact rational arithmetic, and one language against the other bit for bit."""

from __future__ import annotations

import itertools
import math
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import generate, written
from ridgeback.symbolic.codegen.comments import comment_text
from ridgeback.symbolic.codegen.naming import identifier
from ridgeback.symbolic.codegen.number import FLOAT32, FLOAT64, Number, Real, magnitude, rounded
from ridgeback.symbolic.codegen.polynomial import polynomial_function, whole_domain
from ridgeback.symbolic.codegen.program import Argument, Form
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.generated import COMPILER, compiled, load, needs_compiler

CASES = [("pendulum", 0), ("pendulum", 8), ("pendulum", 40), ("duffing", 12), ("helmholtz-duffing", 7), ("linear", 4)]
GRID = [0.0, 1e-300, 1e-9, 0.1, 0.5, 1.0, math.pi / 3, 2.0, 2.75, 3.0, -1.5]


def exact(value: object) -> Fraction:
    return Fraction(int(value.p), int(value.q))  # type: ignore[attr-defined]


def unit_coefficients(expansion: Expansion) -> list[Fraction]:
    return [exact(c) for c in expansion.coefficients]


def horner_bound(coefficients: list[Fraction], x: Fraction, k: Fraction) -> Fraction:
    """Higham, Accuracy and Stability of Numerical Algorithms (2002), 5.1, with rounded coefficients and x^2."""
    size = sum(abs(c) * abs(x) ** n for n, c in enumerate(coefficients))
    return (4 * len(coefficients) + 4) * Fraction(1, 2**53) * size * abs(k) + Fraction(1, 2**1070)


@settings(deadline=None, max_examples=300)
@given(st.fractions(), st.integers(-900, 900), st.sampled_from([FLOAT64, FLOAT32]))
def test_each_coefficient_is_the_nearest_number(ratio: Fraction, shift: int, real: Real) -> None:
    exact_value = ratio * Fraction(2) ** (shift if real is FLOAT64 else shift // 9)
    found = rounded(exact_value, real)
    if math.isinf(found):
        assert abs(exact_value) > Fraction(real.largest)
        return
    spacing = max(Fraction(2) ** (magnitude(exact_value) - real.digits), Fraction(2) ** real.low) if exact_value else 0
    assert abs(Fraction(found) - exact_value) <= spacing / 2
    assert real is FLOAT64 or np.float32(found) == found
    assert real is FLOAT32 or found == exact_value.numerator / exact_value.denominator


@pytest.mark.parametrize(("system", "order"), CASES)
def test_python_agrees_with_exact_arithmetic(system: str, order: int, tmp_path: Path) -> None:
    expansion = lindstedt(find(system), order)
    module = load(generate(expansion), tmp_path)
    coefficients = unit_coefficients(expansion)
    slopes = [n * c for n, c in enumerate(coefficients)][1:]
    for amplitude, k in itertools.product(GRID, (1.0, 4 * math.pi)):
        x, factor = Fraction(amplitude), Fraction(k)
        for name, series in (("omega0", coefficients), ("omega0_slope", slopes)):
            true = factor * sum((c * x**n for n, c in enumerate(series)), Fraction(0))
            found = Fraction(getattr(module, name)(amplitude, k))
            assert abs(found - true) <= horner_bound(series, x, factor)


@pytest.mark.parametrize(("system", "order"), CASES)
def test_constants_in_the_text_are_the_rounded_coefficients(system: str, order: int) -> None:
    expansion = lindstedt(find(system), order)
    source = generate(expansion)
    function = source.split("def omega0_unchecked")[1].split("\n\n\n")[0]
    flat = re.sub(r"\n *# (?=\d)", "", function)  # long rationals go on
    for c in unit_coefficients(expansion):
        if c != 0:
            assert repr(abs(c.numerator / c.denominator)) in flat
            assert c.denominator == 1 or str(c) in flat


@needs_compiler
@pytest.mark.parametrize(("system", "order"), CASES)
def test_c_and_python_agree_bit_for_bit(system: str, order: int, tmp_path: Path) -> None:
    expansion = lindstedt(find(system), order)
    module = load(generate(expansion), tmp_path)
    prefix = identifier(expansion.system)
    source = generate(expansion, "c", equation=find(system).equation)
    for name in ("omega0", "omega0_slope"):
        in_c = compiled(source, tmp_path, f"{prefix}_{name}", 2)
        for amplitude, k in itertools.product(GRID, (1.0, 4 * math.pi)):
            assert in_c(amplitude, k).hex() == float(getattr(module, name)(amplitude, k)).hex()


@needs_compiler
def test_limit_cycle_in_both_languages(tmp_path: Path) -> None:
    expansion = lindstedt(find("van-der-pol"), 8)
    assert generate(lindstedt(find("van-der-pol").with_parameters({"k": 2}), 8)).count("k=2.0") == 9
    module = load(generate(expansion), tmp_path)
    in_c = compiled(generate(expansion, "c"), tmp_path, "van_der_pol_omega0", 2)
    assert expansion.amplitude_series is not None
    for eps in (0.0, 0.1, 0.5, 1.0):
        x = Fraction(eps)
        bound = horner_bound(unit_coefficients(expansion), x, Fraction(1))
        assert abs(Fraction(module.omega0(eps)) - exact(expansion(x))) <= bound
        assert in_c(eps, 1.0).hex() == float(module.omega0(eps)).hex()
        amplitude = sum((exact(c) * x**n for n, c in enumerate(expansion.amplitude_series)), Fraction(0))
        assert float(module.amplitude(eps)) == pytest.approx(float(amplitude), rel=1e-15)
        # eps enters as eps/k: stretching time by 1/k gives the same cycle k times as fast.
        assert module.omega0(3 * eps, 3.0) == pytest.approx(3 * module.omega0(eps, 1.0), rel=1e-15)
        assert module.omega0_slope(3 * eps, 3.0) == pytest.approx(module.omega0_slope(eps, 1.0), rel=1e-15)


@needs_compiler
@pytest.mark.parametrize("k", [1, 3])
def test_slow_flow_in_both_languages(k: int, tmp_path: Path) -> None:
    flow = multiple_scales(find("damped-pendulum").with_parameters({"k": k}), 8)
    module = load(generate(flow), tmp_path)
    source = generate(flow, "c")
    for name in ("omega0", "growth_rate"):
        in_c = compiled(source, tmp_path, f"{identifier(flow.system)}_{name}", 3)
        direct = flow.frequency_at if name == "omega0" else flow.growth_rate_at
        for a, mu in itertools.product((0.0, 0.3, 1.0, 2.0), (0.0, 0.01, 0.2)):
            value = getattr(module, name)(a, mu)
            assert value == pytest.approx(float(direct(a, mu)), rel=1e-13, abs=1e-300)
            assert in_c(a, mu, k).hex() == float(value).hex()
            # Twice the natural frequency and twice the damping: the same motion, twice as fast.
            assert getattr(module, name)(a, 2 * mu, 2.0 * k) == 2 * value


@needs_compiler
@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_low_orders_compile_without_a_warning(order: int, tmp_path: Path) -> None:
    flow = multiple_scales(find("damped-pendulum"), order)
    compiled(generate(flow, "c"), tmp_path, "damped_pendulum_growth_rate", 3)
    compiled(generate(lindstedt(find("van-der-pol"), order), "c"), tmp_path, "van_der_pol_omega0_slope", 2)


def test_arrays_pass_element_by_element(tmp_path: Path) -> None:
    module = load(generate(lindstedt(find("pendulum"), 10)), tmp_path)
    amplitudes = np.linspace(0, 3, 31)
    assert module.omega0(amplitudes).tolist() == [module.omega0(a) for a in amplitudes.tolist()]
    assert module.omega0_slope(amplitudes, 2.0).tolist() == [module.omega0_slope(a, 2.0) for a in amplitudes.tolist()]


def test_the_slope_is_the_slope(tmp_path: Path) -> None:
    """Against a central difference: only a wrong coefficient can miss by more than its error."""
    module = load(generate(energy_integral(find("pendulum"), 12)), tmp_path)
    step = 1e-5
    for amplitude in (0.2, 1.0, 2.0):
        difference = (module.omega0(amplitude + step) - module.omega0(amplitude - step)) / (2 * step)
        assert module.omega0_slope(amplitude) == pytest.approx(difference, abs=1e-9)


def test_what_must_travel_with_the_numbers_is_in_the_text() -> None:
    oscillator = find("pendulum")
    for amplitude, language in itertools.product(("peak", "fundamental"), ("python", "c", "c-header")):
        text = generate(
            lindstedt(oscillator, 6, amplitude=amplitude), language, equation=oscillator.equation, limit=math.pi
        )
        for fact in (
            comment_text(oscillator.equation),
            f"{amplitude} amplitude",
            "up to 6",
            "below 3.14159",
            "lindstedt",
        ):
            assert fact in text


@needs_compiler
def test_the_header_may_be_included_twice(tmp_path: Path) -> None:
    expansion = lindstedt(find("pendulum"), 4)
    (tmp_path / "pendulum.h").write_text(generate(expansion, "c-header"), encoding="utf-8")
    source = '#include "pendulum.h"\n#include "pendulum.h"\n' + generate(expansion, "c")
    assert compiled(source, tmp_path, "pendulum_omega0", 2)(0.0, 1.5) == 1.5


@settings(deadline=None, max_examples=25)
@given(st.dictionaries(st.tuples(st.integers(0, 7), st.integers(0, 5)), st.fractions(-9, 9), min_size=1, max_size=9))
def test_any_polynomial_of_two_variables(
    tmp_path_factory: pytest.TempPathFactory, terms: dict[tuple[int, int], Fraction]
) -> None:
    """The nested Horner steps equal the plain sum of terms, whatever powers are there or missing."""
    exact_terms = {powers: Number(fmpq(c.numerator, c.denominator)) for powers, c in terms.items()}
    arguments = (Argument("a", "first"), Argument("mu", "second"), Argument("k", "factor", 1.0))
    made = polynomial_function(
        "value", "A polynomial.", arguments, ("a", "mu"), exact_terms, whole_domain("a"), factor="k", units={"mu": 1}
    )
    form, folder = Form("any", "A polynomial", (), (made,)), tmp_path_factory.mktemp("any")
    module = load(written(form, "python"), folder)
    a, mu = Fraction(3, 4), Fraction(-5, 8)
    plain = sum((c * a**p * mu**q for (p, q), c in terms.items()), Fraction(0))
    size = sum(abs(c) * abs(a) ** p * abs(mu) ** q for (p, q), c in terms.items())
    assert abs(Fraction(module.value(float(a), float(mu))) - plain) <= 64 * Fraction(1, 2**53) * size
    if COMPILER is not None:
        in_c = compiled(written(form, "c"), folder, "any_value", 3)
        assert in_c(0.75, -0.625, 1.0).hex() == float(module.value(0.75, -0.625)).hex()


def test_bad_requests_are_refused() -> None:
    expansion = lindstedt(find("pendulum"), 2)
    with pytest.raises(InputError, match=r"'cobol'.*python, array-api"):
        generate(expansion, "cobol")
    for huge in (fmpq(10**400), fmpq(1, 10**400), fmpq(10**400, 3)):
        with pytest.raises(InputError, match="lower order"):
            _ = Number(huge).nearest
    assert Number(fmpq(10**400, 3 * 10**399)).nearest == 10 / 3
    for options in ({"mode": "fast"}, {"real": "float16"}, {"name": "a b"}, {"name": "class"}, {"name": "x" * 41}):
        with pytest.raises(InputError, match=r"use|not known"):
            generate(expansion, "c", **options)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="written in float64"):
        generate(expansion, "python", real="float32")
    with pytest.raises(InputError, match="no fma mode"):
        generate(expansion, "numba", mode="fma")


HOSTILE = (
    '"""\nimport os\n"""',
    "*/ int x; /*",
    "back\\slash",
    "evil*\\ int x; /*",  # turned into the end of a comment by a later replacement of the backslash
    "??/\n int x;",
    "\u2028int x;\u202e",
    "",
)


@pytest.mark.parametrize("text", HOSTILE)
def test_no_name_can_leave_its_comment(text: str, tmp_path: Path) -> None:
    arguments = (Argument("A", text),)
    made = polynomial_function("value", text, arguments, ("A",), {(0,): Number(fmpq(1))}, whole_domain("A"))
    form = Form(identifier(text), text, (text,), (made,))
    assert load(written(form, "python"), tmp_path).value(0.0) == 1.0
    if COMPILER is not None:
        assert compiled(written(form, "c"), tmp_path, f"{identifier(text)}_value", 1)(0.0) == 1.0
