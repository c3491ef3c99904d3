"""Proved bounds on the rounding errors of generated code: of polynomials, and of resummations."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import generate, written
from ridgeback.symbolic.codegen.naming import identifier
from ridgeback.symbolic.codegen.number import FLOAT32, FLOAT64, Number, Real
from ridgeback.symbolic.codegen.polynomial import polynomial_function, whole_domain
from ridgeback.symbolic.codegen.program import Argument, Form, Function, Operation, Step
from ridgeback.symbolic.codegen.proofs.analysis import Analysis, Computed
from ridgeback.symbolic.codegen.proofs.notes import gamma, roundings
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.generated import COMPILER, compiled, load


def roundings_of(made: Function) -> int:
    return roundings(made.body, made.result)


POLYNOMIALS = st.dictionaries(
    st.tuples(st.integers(0, 5), st.integers(0, 3), st.integers(0, 3)), st.fractions(-9, 9), min_size=1, max_size=9
)


@settings(deadline=None, max_examples=60)
@given(POLYNOMIALS, st.tuples(*[st.integers(-2, 3)] * 2), st.tuples(*[st.floats(0.015625, 3)] * 4))
def test_the_bound_of_any_polynomial_holds(
    tmp_path_factory: pytest.TempPathFactory,
    terms: dict[tuple[int, int, int], Fraction],
    dimensions: tuple[int, int],
    at: tuple[float, float, float, float],
) -> None:
    exact = {powers: Number(fmpq(c.numerator, c.denominator)) for powers, c in terms.items()}
    arguments = tuple(Argument(name, name) for name in ("a", "mu", "g", "k"))
    units = {"a": 0, "mu": dimensions[0], "g": dimensions[1]}
    made = polynomial_function(
        "value", "A polynomial.", arguments, ("a", "mu", "g"), exact, whole_domain("a"), factor="k", units=units
    )
    module = load(written(Form("any", "A polynomial", (), (made,)), "python"), tmp_path_factory.mktemp("any"))
    a, mu, g, k = map(Fraction, at)
    values = [
        k * c * a**p * (mu / k ** dimensions[0]) ** q * (g / k ** dimensions[1]) ** r for (p, q, r), c in terms.items()
    ]
    error = abs(Fraction(module.value(*at)) - sum(values))
    assert error <= gamma(roundings_of(made)) * sum(map(abs, values))


def test_roundings_are_counted_along_the_deepest_path() -> None:
    def count(*steps: Step) -> int:
        return roundings(steps, "r")

    assert roundings((), "x") == 0
    pairs = (Operation.ADD, Operation.MULTIPLY, Operation.DIVIDE)
    assert [count(Step("r", operation, ("x", "y"))) for operation in pairs] == [1, 1, 1]
    squared = Step("s", Operation.MULTIPLY, ("x", "x"))
    assert count(squared, Step("r", Operation.DIVIDE, ("y", "s"))) == 3  # two factors 1 + theta (Higham, Lemma 3.3)
    third, half, one = (Number(fmpq(1, n)) for n in (3, 2, 1))
    assert count(Step("r", Operation.MULTIPLY_ADD, (one, "x", third))) == 2  # 1/3 meets the sum only
    assert count(Step("r", Operation.MULTIPLY_ADD, (third, "x", half))) == 3
    assert roundings((), third) == 1


@pytest.mark.parametrize("real", [FLOAT64, FLOAT32])
def test_a_splitting_that_overflows_is_in_the_bound(real: Real) -> None:
    """Veltkamp's 2^s x is beyond the largest number from 2^(high - s) on, though the product is not; fused is none."""
    half = (real.digits + 1) // 2
    product = (Step("p", Operation.TWO_PRODUCT, ("x", "y"), "lost"),)
    for exponent, splits in ((real.high - half - 2, True), (real.high - half, False)):
        known = {"x": Computed(arb(2) ** exponent, arb(0)), "y": Computed(arb(2) ** (-exponent), arb(0))}
        for names in (("x", "y"), ("y", "x")):
            given = {"x": known[names[0]], "y": known[names[1]]}
            strict = Analysis(given, Form("f", "", (), (), mode="accurate", real=real), {})
            assert strict.run(product, "p").error.is_finite() == splits
        assert Analysis(known, Form("f", "", (), (), mode="fma", real=real), {}).run(product, "p").error.is_finite()


FORMULAS = [
    ("pendulum", 16, "pade", 0, "3"),
    ("pendulum", 24, "nome", 0, "3"),
    ("pendulum", 12, "map", 0, "3"),
    ("duffing", 8, "map", 0, "4"),
    ("duffing", 12, "map", "1/2", "4"),
    ("duffing", 24, "nome", 0, "1000"),
    ("helmholtz-duffing", 5, "pade", 0, "1/2"),
    ("van-der-pol", 12, "pade", 0, "3"),
    ("van-der-pol", 16, "map", "-1/2", "5"),
]


def resummation(system: str, order: int, kind: str, growth: object, up_to: Fraction) -> Resummation:
    series = lindstedt(find(system), order)
    return resum(find(system), series, kind, growth=Fraction(str(growth)), up_to=up_to)


@pytest.mark.parametrize(("system", "order", "kind", "growth", "up_to"), FORMULAS)
def test_a_resummation_is_within_its_proved_relative_bound(
    system: str, order: int, kind: str, growth: object, up_to: str, tmp_path: Path
) -> None:
    end = Fraction(up_to)
    formula = resummation(system, order, kind, growth, end)
    source = generate(formula, up_to=end)
    flat = " ".join(source.split())
    bound = Fraction(re.search(r"relative error is at most (\S+)", flat).group(1))  # type: ignore[union-attr]
    assert FLOAT64.unit < bound < Fraction(1, 10**11)
    module = load(source, tmp_path)
    for i in range(1, 101):
        x = float(end * i / 100)
        with ctx.workprec(200):
            error = abs(arb(module.omega0(x)) / formula.in_balls(arb(x)) - 1)
            assert error.upper() <= float(bound)
    assert module.omega0(0.0) == pytest.approx(1.0, rel=1e-15)
    if COMPILER is not None:
        in_c = compiled(generate(formula, "c", up_to=end), tmp_path, f"{identifier(formula.system)}_omega0", 2)
        assert all(in_c(x, 2.0).hex() == module.omega0(x, 2.0).hex() for x in (0.0, 0.1, float(end) / 3))


def test_a_wrong_constant_breaks_the_bound(tmp_path: Path) -> None:
    """The bounds are near enough to the truth that an error of some units in the last place shows."""
    formula = resummation("duffing", 24, "nome", 0, Fraction(1))
    source = generate(formula, up_to=Fraction(1))
    assert "low_share = 0.5*" in source
    module = load(source.replace("low_share = 0.5*", f"low_share = {0.5 * (1 + 400 * 2.0**-52)!r}*"), tmp_path)
    with ctx.workprec(200):
        error = abs(arb(module.omega0(1.0)) / formula.in_balls(arb(1)) - 1)
    found = re.search(r"relative error is at most (\S+)", " ".join(source.split()))
    assert found is not None
    assert error > float(found[1])


def test_ranges_without_a_relative_bound_say_so() -> None:
    """A slope smaller than any that a relative error is claimed for has none; a range of overflow is refused."""
    text = generate(lindstedt(find("duffing"), 12), "c", up_to=Fraction(1, 10**320))
    assert "at most inf" not in " ".join(text.split())
    assert "as the value may be 0 near A = 0" in " ".join(text.replace("//", "").split())
    with pytest.raises(InputError, match=r"may divide by zero, overflow .* give a shorter range"):
        generate(lindstedt(find("duffing"), 12), "c", up_to=Fraction(10**30))
