"""Every form in which an oscillator may be named leads to the same oscillator; text is never evaluated."""

from __future__ import annotations

from pathlib import Path

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.grammar.to_sympy import U, V
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.catalogue import find

t, k, mu, c = sympy.symbols("t k mu c")
u = sympy.Function("u")
theta = sympy.Function(r"\theta")
real_k = sympy.Symbol("k", real=True)
real_c = sympy.Symbol("c", real=True)


def test_a_name_in_any_spelling() -> None:
    assert as_oscillator("pendulum") == find("pendulum")
    assert as_oscillator("Van_der_Pol").name == as_oscillator("van-der-pol").name == "van-der-pol"
    assert as_oscillator(find("duffing")) == find("duffing")


def test_all_forms_of_one_equation_agree(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("[oscillator]\nequation = \"u'' + u + u**3/2 = 0\"\n", encoding="utf-8")
    text = "u'' + u + u**3/2 = 0"
    x = sympy.Symbol("x", positive=True)
    forms = (
        text,
        file,
        str(file),
        as_oscillator(text),
        sympy.Eq(u(t).diff(t, 2) + u(t) + u(t) ** 3 / 2, 0),
        sympy.Eq(u(t).diff(t, 2), -u(t) - u(t) ** 3 / 2),
        u(t).diff(t, 2) + u(t) + u(t) ** 3 / 2,
        2 * u(t).diff(t, 2) + 2 * u(t) + u(t) ** 3,
        u(t) + u(t) ** 3 / 2,
        x + x**3 / 2,
    )
    frequencies = {lindstedt(form, 6).frequency for form in forms}
    assert len(frequencies) == 1
    assert {as_oscillator(form).force for form in forms} == {U + U**3 / 2}


@pytest.mark.parametrize(
    ("given", "force"),
    [
        (u(t).diff(t, 2) + 2 * mu * u(t).diff(t) + k**2 * sympy.sin(u(t)), "2*mu*v + k**2*sin"),
        (theta(t).diff(t, 2) + k**2 * sympy.sin(theta(t)), "k**2*sin"),
    ],
)
def test_parameters_stay_symbolic_and_derivatives_are_found(given: sympy.Expr, force: str) -> None:
    found = as_oscillator(given)
    assert found.parameters["k"] is None
    assert found.force.coeff(sympy.sin(U)) == real_k**2
    assert found.force.has(V) == ("v" in force)


@pytest.mark.parametrize(
    "expression",
    [
        U / (1 + U**2),
        sympy.exp(U) - 1,
        U + sympy.E * U**3,
        sympy.sqrt(1 + U**2) * U,
        U - sympy.Rational(1, 3) * U**3,
        -(-U - 2 * U**2 / 7),
        sympy.pi * U + sympy.tanh(U / 2),
        U * sympy.sqrt(2),
        U / sympy.sqrt(1 - U),
        real_c * U / (2 + real_c) + U**3,
    ],
)
def test_an_expression_comes_through_unchanged(expression: sympy.Expr) -> None:
    """The force read back from the text that was made of it is the expression itself."""
    found = as_oscillator(expression, parameters={"c": 1} if expression.has(real_c) else None)
    assert sympy.simplify(found.force - expression) == 0


@settings(max_examples=40, deadline=None)
@given(st.lists(st.fractions(max_denominator=50).filter(lambda q: abs(q) < 100), min_size=1, max_size=5))
def test_polynomials_come_through_exactly(coefficients: list[object]) -> None:
    force = U + sum((sympy.Rational(q.numerator, q.denominator) * U ** (n + 2) for n, q in enumerate(coefficients)), 0)  # type: ignore[attr-defined]
    assert sympy.expand(as_oscillator(force).force - force) == 0


def test_floats_are_the_decimals_that_they_print_as() -> None:
    assert as_oscillator(u(t) * 0.1 + u(t) ** 3).force == U / 10 + U**3


def test_parameters_and_place_can_be_given() -> None:
    assert as_oscillator("pendulum", parameters={"k": "5/2"}).natural_frequency == sympy.Rational(5, 2)
    assert as_oscillator("u'' - u + u**3 = 0", about="1").natural_frequency == sympy.sqrt(2)
    assert as_oscillator(sympy.Symbol("x") * c + c, unknown="x", parameters={"c": 4}, about="-1").natural_frequency == 2


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("raleigh", "did you mean rayleigh"),
        ("u + 3", "no second derivative"),
        (3.0, "float is no oscillator"),
        (None, "NoneType is no oscillator"),
        (u(t) + theta(t), "one unknown function"),
        (u(t, k) + 1, "no function of time alone"),
        (u(t).diff(t, 3) + u(t), "derivative of order 3"),
        (sympy.Eq(u(t), u(t) ** 3), "no second derivative"),
        (sympy.gamma(U), "not in the grammar"),
        (sympy.Symbol("x") * sympy.Symbol("y"), "which is the unknown"),
        (sympy.Integer(3), "no symbol"),
        (u(t).diff(t, 2) + t * u(t), "time"),
        (sympy.And(u(t) > 1, u(t) < 2), "is no oscillator|is no equation"),
        (sympy.Matrix([u(t)]), "is no oscillator|is no equation"),
        (u(t).diff(t, 2) + u(t) + sympy.Symbol("a b") * u(t) ** 3, "'a b' cannot be written"),
    ],
)
def test_what_is_no_oscillator_is_refused_in_one_line(given: object, message: str) -> None:
    with pytest.raises(InputError, match=message) as refused:
        as_oscillator(given)  # type: ignore[arg-type]
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("text", ["__import__('os').system('echo')", "u'' + (lambda: 0)()", "exec('1')", "S('x')"])
def test_text_is_read_by_the_grammar_alone(text: str) -> None:
    with pytest.raises(InputError):
        as_oscillator(text)
