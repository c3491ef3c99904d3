"""Generated code with several parameters and for quotients: the proved bounds hold, in exact arithmetic."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Rational, Symbol

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import form_of, generate, written
from ridgeback.symbolic.codegen.naming import identifier
from ridgeback.symbolic.codegen.number import FLOAT64, Number
from ridgeback.symbolic.codegen.polynomial import polynomial_function, whole_domain
from ridgeback.symbolic.codegen.program import Argument, Form, Function, Operation, Step
from ridgeback.symbolic.codegen.proofs.notes import gamma, roundings
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.resummation.mapping import Euler
from ridgeback.symbolic.resummation.pade import mapped
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.symbolic.generated import COMPILER, compiled, load, needs_compiler

EQUATIONS = {
    "u'' + 2*mu*u' + c3*u'**3 + u + g*u**3 = 0": {"mu": 0.013, "c3": 0.11, "g": -0.3},
    "u'' + 2*mu*u' + 4*u + alpha2*u**2 + alpha3*u**3 = 0": {"mu": 0.05, "alpha2": 0.7, "alpha3": -1.3},
    "u'' + 2*mu*u' + w**2*u + alpha3*u**3 = 0": {"mu": 0.05, "alpha3": -1.3, "w": 3.0},
    "u'' + c*u' + w**2*u + u**3 = 0": {"c": 0.05, "w": 3.0},
    "u'' + lambda*u' + u + double*u**3 + y*u**5 = 0": {"lambda": 0.05, "double": 0.25, "y": 0.5},
}


def roundings_of(made: Function) -> int:
    return roundings(made.body, made.result)


def exact_sum(flow: SlowFlow, terms: tuple[Term, ...], values: Mapping[str, Fraction]) -> tuple[Fraction, Fraction]:
    """The exact value of a side of the flow, and the sum of the sizes of its terms."""
    total, size = Fraction(0), Fraction(0)
    for expression in flow.expressions(terms):
        for part in sympy.Add.make_args(sympy.expand(expression)):
            inserted = part.subs(
                {Symbol(n, real=True): Rational(v.numerator, v.denominator) for n, v in values.items()}
            )
            value = Fraction(int(inserted.p), int(inserted.q))
            total, size = total + value, size + abs(value)
    return total, size


@pytest.mark.parametrize("equation", EQUATIONS)
def test_a_slow_flow_with_any_symbols_is_within_its_proved_bound(equation: str, tmp_path: Path) -> None:
    flow = multiple_scales(Oscillator.from_equation(equation), 5)
    module, form = load(generate(flow), tmp_path), form_of(flow)
    for a, factor in itertools.product((0.3, 1.1), (1.0, 0.37)):
        values = {"a": a, **{name: factor * v for name, v in EQUATIONS[equation].items()}}
        exact = {name: Fraction(v) for name, v in values.items()}
        names = [n for n in flow.dimensions if not n.endswith("*")]
        natural = values["w"] if "w" in values else float(flow.scale)
        arguments = [a, *(values[name] for name in names), natural]
        for made, terms in zip(form.functions[:2], (flow.frequency, flow.growth_rate), strict=True):
            true, size = exact_sum(flow, terms, exact)
            error = abs(Fraction(getattr(module, made.name)(*arguments)) - true)
            assert error <= gamma(roundings_of(made)) * size


@needs_compiler
@pytest.mark.parametrize("equation", EQUATIONS)
def test_c_and_python_agree_bit_for_bit(equation: str, tmp_path: Path) -> None:
    flow = multiple_scales(Oscillator.from_equation(equation), 5)
    module, source, form = load(generate(flow), tmp_path), generate(flow, "c"), form_of(flow)
    for made in form.functions[:3]:
        count = len(made.arguments)
        in_c = compiled(source, tmp_path, f"equation_{made.name}", count)
        for values in ([0.1 * (n + 3) for n in range(count)], [1.7 / (n + 1) for n in range(count)]):
            assert in_c(*values).hex() == float(getattr(module, made.name)(*values)).hex()


def test_another_natural_frequency_rescales_time_and_every_parameter(tmp_path: Path) -> None:
    """k = 2 by its argument is the slow flow derived with k = 2: mu, c3 and g have the dimensions 1, -1 and 2."""
    one, two = (
        multiple_scales(Oscillator.from_equation(f"u'' + 2*mu*u' + c3*u'**3 + {k}*u + g*u**3 = 0"), 5) for k in (1, 4)
    )
    at = (0.7, 0.03, 0.05, 0.4)
    first, second = load(generate(one), tmp_path, "first"), load(generate(two), tmp_path, "second")
    for name in ("omega0", "growth_rate"):
        assert getattr(first, name)(*at, 2.0) == getattr(second, name)(*at)
        direct = two.frequency_at if name == "omega0" else two.growth_rate_at
        with pytest.raises(InputError, match="g"):
            direct(*at[:3])


@pytest.mark.parametrize(
    "equation", ["u'' + u + alpha2*u**2 + alpha3*u**3 = 0", "u'' + 2*u + alpha2*u**2 + alpha3*u**3"]
)
def test_a_series_keeps_its_parameters_as_arguments(equation: str, tmp_path: Path) -> None:
    series = lindstedt(Oscillator.from_equation(equation), 6)
    module, form = load(generate(series), tmp_path), form_of(series)
    values = {"A": 0.3, "alpha2": 0.7, "alpha3": -1.25}
    exact = {Symbol(n, real=True): Rational(*v.as_integer_ratio()) for n, v in values.items()}
    for made in form.functions:
        expression = series.expression() if made.name == "omega0" else series.expression().diff(Symbol("A", real=True))
        parts = [part.subs(exact).evalf(60) for part in sympy.Add.make_args(sympy.expand(expression))]
        found = getattr(module, made.name)(*values.values())
        bound = gamma(roundings_of(made))
        limit = Rational(bound.numerator, bound.denominator) * sum(map(abs, parts))
        assert abs(Rational(*found.as_integer_ratio()) - sum(parts)) <= limit
    assert [a.name for a in form.functions[0].arguments] == ["A", "alpha2", "alpha3"]
    assert f"natural frequency {series.scale} only" in generate(series)


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


# --- resummations ---

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


def test_what_has_no_code_is_refused_by_name() -> None:
    duffing = find("duffing")
    series = lindstedt(duffing, 12)
    with pytest.raises(InputError, match="take one step or more"):
        generate(nome(duffing, 12, steps=0))
    with pytest.raises(InputError, match="multiples of 1/2"):
        generate(mapped(series, Euler(Fraction(1)), growth=Fraction(1, 3)))
    with pytest.raises(InputError, match="of rate 1"):
        generate(mapped(series, Euler(Fraction(1), Fraction(1, 2))))
    pade = resummation("pendulum", 16, "pade", 0, Fraction(3))
    with pytest.raises(InputError, match="may divide by zero"):
        generate(pade, up_to=Fraction(4))
