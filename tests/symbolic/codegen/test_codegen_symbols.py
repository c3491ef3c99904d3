"""Generated code with several parameters and for quotients: the proved bounds hold, in exact arithmetic."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

import pytest
import sympy
from sympy import Rational, Symbol

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import form_of, generate
from ridgeback.symbolic.codegen.program import Function
from ridgeback.symbolic.codegen.proofs.notes import gamma, roundings
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.resummation.elliptic_nome import nome
from ridgeback.symbolic.resummation.mapping import Euler
from ridgeback.symbolic.resummation.pade import mapped
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.symbolic.generated import compiled, load, needs_compiler

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


def test_what_has_no_code_is_refused_by_name() -> None:
    duffing = find("duffing")
    series = lindstedt(duffing, 12)
    with pytest.raises(InputError, match="take one step or more"):
        generate(nome(duffing, 12, steps=0))
    with pytest.raises(InputError, match="multiples of 1/2"):
        generate(mapped(series, Euler(Fraction(1)), growth=Fraction(1, 3)))
    with pytest.raises(InputError, match="of rate 1"):
        generate(mapped(series, Euler(Fraction(1), Fraction(1, 2))))
    pade = resum(find("pendulum"), lindstedt(find("pendulum"), 16), "pade", up_to=Fraction(3))
    with pytest.raises(InputError, match="may divide by zero"):
        generate(pade, up_to=Fraction(4))
