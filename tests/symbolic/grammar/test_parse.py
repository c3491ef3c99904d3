"""The grammar against Python's own, trees against their text, and bad input against its message."""

import ast
from fractions import Fraction

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.nodes import constant
from ridgeback.symbolic.grammar.parse import (
    FUNCTIONS,
    Call,
    Name,
    Negate,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    U,
    Unknown,
    V,
    W,
    names,
    parse_equation,
    parse_expression,
    to_sympy,
    to_text,
)
from ridgeback.symbolic.grammar.size import measure
from ridgeback.symbolic.grammar.tokens import MAX_LENGTH

QUICK = settings(deadline=None, max_examples=150)


one, two, three = (Number(Fraction(n)) for n in (1, 2, 3))
k, mu = Name("k"), Name("mu")
u = Unknown(0)


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("-u**2", Negate(Power(u, two))),
        ("u^2^3", Power(u, Power(two, three))),
        ("2**-3", Power(two, Negate(three))),
        ("k*u/2/3", Quotient(Product((k, u)), Product((two, three)))),
        ("k/2*u", Quotient(Product((k, u)), two)),
        ("1 - u - 2", Sum((one, Negate(u), Negate(two)))),
        ("1 - (u - 2)", Sum((one, Negate(Sum((u, Negate(two))))))),
        ("-k*u", Negate(Product((k, u)))),
        ("k*-u", Product((k, Negate(u)))),
        ("+u", u),
        ("sin(2*u)", Call("sin", Product((two, u)))),
        ("mu*u'", Product((mu, Unknown(1)))),
        (".5e1", Number(Fraction(5))),
        ("0.1", Number(Fraction(1, 10))),
    ],
)
def test_text_becomes_the_tree_of_the_usual_precedence(text, tree):
    assert parse_expression(text, unknown="u") == tree


def test_an_equation_is_moved_to_the_left_and_its_unknown_has_any_name():
    moved = parse_equation("x'' = -4*x + mu*x'")
    assert moved.unknown == "x"
    assert to_sympy(moved.left) == W + 4 * U - sympy.Symbol("mu", real=True) * V
    for same in ("x'' + 4*x - mu*x' = 0", "x'' + 4*x - mu*x'", "0 = -x''-4*x+mu*x'"):
        assert to_sympy(parse_equation(same).left) in (to_sympy(moved.left), -to_sympy(moved.left))


def test_columns_are_kept_but_do_not_distinguish_trees():
    near, far = parse_expression("k + u", unknown="u"), parse_expression("   k   + u", unknown="u")
    assert near == far
    assert isinstance(near, Sum)
    assert [term.column for term in near.terms] == [1, 5]


literals = st.builds(lambda n, places: Number(Fraction(n, 10**places)), st.integers(0, 10**6), st.integers(0, 4))
exponents = st.sampled_from([two, three, Negate(one), Quotient(one, two), Power(two, two), Number(Fraction(5, 2))])
leaves = literals | st.sampled_from([k, mu, Name("pi"), u, Unknown(1), Unknown(2)])


def _branches(below):
    several = st.lists(below, min_size=2, max_size=3).map(tuple)
    return (
        several.map(Sum)
        | several.map(Product)
        | below.map(Negate)
        | st.builds(Quotient, below, below)
        | st.builds(Power, below, exponents)
        | st.builds(Call, st.sampled_from(sorted(FUNCTIONS)), below)
    )


trees = st.recursive(leaves, _branches, max_leaves=12)


def _accepted(tree):
    try:
        measure(tree)
    except InputError:
        return False
    return True


@QUICK
@given(trees)
def test_printing_a_tree_and_reading_it_back_gives_the_tree(tree):
    assume(_accepted(tree))
    assert parse_expression(to_text(tree), unknown="u") == tree
    assert parse_expression(to_text(tree, unknown="theta"), unknown="theta") == tree


@QUICK
@given(trees)
def test_blanks_and_the_other_power_sign_change_nothing(tree):
    assume(_accepted(tree))
    text = to_text(tree)
    assume(len(text) < MAX_LENGTH // 4)
    spread = text.replace("**", "^").replace("(", " ( ").replace("+", "\t+\n")
    assert parse_expression(spread, unknown="u") == tree


def _python_value(node, values):
    """The exact value by Python's own parser, an independent reading of the same text."""
    match node:
        case ast.Expression(body=body):
            return _python_value(body, values)
        case ast.Constant(value=value):
            return Fraction(value)
        case ast.Name(id=name):
            return values[name]
        case ast.UnaryOp(op=op, operand=operand):
            return (-1 if isinstance(op, ast.USub) else 1) * _python_value(operand, values)
        case ast.BinOp(left=left, op=op, right=right):
            a, b = _python_value(left, values), _python_value(right, values)
            return {ast.Add: a.__add__, ast.Sub: a.__sub__, ast.Mult: a.__mul__, ast.Div: a.__truediv__}.get(
                type(op), a.__pow__
            )(b)
    raise AssertionError(ast.dump(node))


pieces = st.recursive(
    st.sampled_from(["w", "k", "mu", "1", "2", "7", "w**2**3", "-k**2", "2**-2", "k**-2**2"]),
    lambda below: (
        st.tuples(below, st.sampled_from(["+", "-", "*", "/", " - ", "*-", "/-", "-+"]), below).map("".join)
        | below.map(lambda t: f"({t})")
        | below.map(lambda t: f"-{t}")
        | st.tuples(st.just("("), below, st.sampled_from([")**2", ")**-1", ")**(1-2)"])).map("".join)
    ),
    max_leaves=8,
)


@QUICK
@given(pieces)
def test_values_agree_with_pythons_own_reading_of_the_text(text):
    values = {"w": Fraction(5, 3), "k": Fraction(-7, 11), "mu": Fraction(13, 2)}
    try:
        expected = _python_value(ast.parse(text, mode="eval"), values)
    except ZeroDivisionError:
        assume(False)
    try:
        expression = to_sympy(parse_expression(text))
    except InputError as error:
        assert "would grow" in str(error)  # noqa: PT017
        return
    exact = {sympy.Symbol(n, real=True): sympy.Rational(v.numerator, v.denominator) for n, v in values.items()}
    assert expression.subs(exact) == sympy.Rational(expected.numerator, expected.denominator)


@QUICK
@given(st.recursive(literals, _branches, max_leaves=12))
def test_the_constant_of_a_tree_is_its_sympy_value(tree):
    assume(_accepted(tree))
    value = constant(tree)
    assume(value is not None)
    assert to_sympy(tree) == sympy.Rational(value.numerator, value.denominator)


@pytest.mark.parametrize("function", sorted(set(FUNCTIONS) - {"abs", "sign"}))
def test_every_function_is_the_one_of_that_name(function):
    assert to_sympy(parse_expression(f"{function}(u/2 + 1/3)", unknown="u")) == getattr(sympy, function)(
        U / 2 + sympy.Rational(1, 3)
    )


polynomials = st.recursive(
    st.sampled_from([one, two, k, mu, u, Unknown(1)]),
    lambda below: (
        st.lists(below, min_size=2, max_size=3).map(lambda terms: Sum(tuple(terms)))
        | st.lists(below, min_size=2, max_size=3).map(lambda factors: Product(tuple(factors)))
        | st.builds(Power, below, st.sampled_from([two, three, Number(Fraction(7))]))
    ),
    max_leaves=8,
)


@QUICK
@given(polynomials)
def test_the_predicted_number_of_terms_bounds_the_expanded_expression(tree):
    assume(_accepted(tree))
    size = measure(tree)
    assume(size.terms <= 60 and size.degree <= 20)
    expanded = sympy.Poly(to_sympy(tree), U, V, *(sympy.Symbol(n, real=True) for n in ("k", "mu")))
    assert len(expanded.terms()) <= size.terms
    assert expanded.total_degree() <= size.degree
    assert all(int(c).bit_length() <= size.bits for c in expanded.coeffs())


def test_names_are_listed_once_in_order():
    assert names(parse_equation("u'' + mu*u' + k**2*sin(pi*u) + mu*u").left) == ("mu", "k")
