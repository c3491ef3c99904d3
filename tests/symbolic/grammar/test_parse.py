"""The grammar against Python's own, trees against their text, and bad input against its message."""

import ast
import sys
from fractions import Fraction

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.nodes import constant
from ridgeback.symbolic.grammar.parse import (
    FUNCTIONS,
    MAX_NESTING,
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
    parse_number,
    to_sympy,
    to_text,
)
from ridgeback.symbolic.grammar.size import MAX_EXPONENT, MAX_FUNCTIONS, measure
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


# --- trees and their text -------------------------------------------------------------------------------------------

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


# --- the value, against Python's grammar ----------------------------------------------------------------------------


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
@given(trees)
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


# --- what is refused ------------------------------------------------------------------------------------------------

REFUSED = [
    ("", "is empty"),
    (" \t\n", "is empty"),
    ("u'' + 2u", "missing operator before 'u' at column 8; write 2*u"),
    ("u'' + u 3", "write u*3"),
    ("u'' + (u)(u)", "column 10"),
    ("u'' + 2(u)", "write 2*(...)"),
    ("u'' + k(u)", "'k' at column 7 is not a known function; to multiply write k*(...)"),
    ("u'' + u(1)", "is the unknown, not a function"),
    ("u'' + sin()", "sin() at column 7 has no argument"),
    ("u'' + sin", "the function sin at column 7 has no argument"),
    ("u'' + sni(u)", "did you mean sin?"),
    ("u'' + ln(u+1)", "did you mean log?"),
    ("u'' + arctan(u)", "did you mean atan?"),
    ("u'' + fabs(u)*u", "did you mean abs?"),
    ("u'' + sgn(u)", "did you mean sign?"),
    ("u'' + max(u)", "max at column 7 takes two arguments; write max(u, 0)"),
    ("u'' + max(u, 0", "the bracket opened at column 10 is not closed"),
    ("u'' + sin(u, 0)", "the , at column 12 separates nothing"),
    ("u'' + u, 0", "unexpected ','"),
    ("(u'' + u", "the bracket opened at column 1 is not closed"),
    ("u'' + u)", "the bracket ) at column 8 closes nothing"),
    ("u'' + u = 0 = 0", "an extra = at column 13"),
    ("u'' + ", "the text ends at column 6"),
    ("u'' + *u", "unexpected '*' at column 7"),
    ("u'' + u; import os", "the character ';' (U+003B, SEMICOLON) at column 8"),
    ("u''' + u", "derivative of order 3"),
    ("u '' + u", "the prime at column 3 follows no name"),
    ("u'' + v'", "derivatives of both 'u' and 'v' (column 7)"),
    ("u + k", "has no second derivative"),
    ("sin'' + 1", "'sin' at column 1 is reserved"),
    ("u'' + 1/0", "division by zero at column 7"),
    ("u'' + 1/(2-2)", "division by zero at column 7"),
    ("u'' + 0**-1", "is not a real number"),
    ("u'' + (-8)**(1/3)", "is not a real number"),
    ("u'' + u**u", "the exponent at column 10 is not a rational number"),
    ("u'' + u**k", "the exponent at column 10 is not a rational number"),
    ("u'' + u**pi", "the exponent at column 10 is not a rational number"),
    ("u'' + (1+u)^1000000", "the exponent 1000000 at column 13 is too large"),
    ("u'' + 9^9^9", "the exponent 387420489 at column 9 is too large"),
    ("u'' + 9^9^9^9", "the exponent 387420489"),
    ("u'' + ((u**200)**200)", "would grow to degree 40000"),
    ("u'' + (1+u+k+mu)**200", "would grow to terms 1373701"),
    ("u'' + 1e101", "decimal exponent beyond 100"),
    ("u'' + 1e99999999999999999999999", "decimal exponent beyond 100"),
    ("u'' + " + "1" * 61, "has 61 digits"),
    ("u'' + " + "a" * 41, "has 41 characters"),
    ("u'' + " + "u+" * 1000 + "u", "has 2007 characters"),
    ("u'' + " + "u-" * 900 + "u", "more than 1000 numbers, names and operations"),
]


@pytest.mark.parametrize(("text", "said"), REFUSED, ids=lambda value: repr(value)[:30])
def test_bad_text_is_refused_with_what_and_where(text, said):
    with pytest.raises(InputError) as caught:
        parse_equation(text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("u'' − u", "MINUS SIGN) at column 5 is not read; type - from"),
        ("u’’ + u", "column 2 is not read; type ' from"),
        ("u″ + u", "column 2 is not read; type '' from"),
        ("u'' + u²", "column 8 is not read; type **2 from"),
        ("u'' + 2·u", "column 8 is not read; type * from"),
        ("u'' + ｕ", "column 7 is not read; type u from"),
        ("u'' + ѕin(u)", "U+0455, CYRILLIC SMALL LETTER DZE) at column 7"),
        ("u'' + с*u", "U+0441, CYRILLIC SMALL LETTER ES) at column 7 is not read; type c from"),
        ("u'' + ω*u", "GREEK SMALL LETTER OMEGA) at column 7 is not read; write omega"),
        ("u'' + λ*u", "write lambda"),
        ("u'' + u\x00", "the character '\\x00'"),
        ("u'' + \u202eu", "the character '\\u202e' (U+202E, RIGHT-TO-LEFT OVERRIDE)"),
        ("u'' + \ud800", "the character '\\ud800'"),
        ("u'' +\xa0u", "NO-BREAK SPACE) at column 6"),
        ("u'' + [u]", "type ( from"),
        ("u'' + ٣*u", "ARABIC-INDIC DIGIT THREE"),
    ],
)
def test_look_alike_and_control_characters_are_named(text, said):
    with pytest.raises(InputError) as caught:
        parse_equation(text)
    assert said in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("u'' + t*u", "'t' at column 7 would be time"),
        ("x'' + u*x", "the parameter 'u' at column 7 is taken by the unknown"),
        ("u'' + sqrt(-1)*u", "is not a finite real number"),
        ("u'' + log(0)*u", "is not a finite real number"),
        ("u'' + u/(u-u)", "is not a finite real number"),
        ("u'' + asin(sin(exp(exp(100))))*u", "is beyond 10000 in magnitude"),
        ("u'' + u*log(cos(1) - 2)", "is not a finite real number"),
    ],
)
def test_what_is_not_a_finite_real_expression_is_refused_on_conversion(text, said):
    with pytest.raises(InputError) as caught:
        to_sympy(parse_equation(text).left)
    assert said in str(caught.value)


@pytest.mark.parametrize("opening", ["(", "-", "+", "sin(", "2**", "u**-", "1/(", "-(", "u-(", "exp(1+"])
@pytest.mark.parametrize("times", [MAX_NESTING // 2, MAX_NESTING, MAX_NESTING + 1, 300, MAX_LENGTH])
def test_nesting_of_any_kind_ends_in_a_tree_or_a_message_well_inside_the_stack(opening, times):
    limit = sys.getrecursionlimit()
    text = "u'' + " + opening * times + "u" + ")" * (opening.count("(") * times)
    sys.setrecursionlimit(len(_frames()) + 450)
    try:
        to_sympy(parse_equation(text).left)
    except InputError as error:
        assert "\n" not in str(error)  # noqa: PT017
    finally:
        sys.setrecursionlimit(limit)


def _frames():
    frame, found = sys._getframe(), []
    while frame is not None:
        found.append(frame)
        frame = frame.f_back
    return found


def test_functions_nest_as_deep_as_allowed_and_no_deeper():
    def nested(times):
        return "u'' + " + "sin(" * times + "u" + ")" * times

    force = to_sympy(parse_equation(nested(MAX_FUNCTIONS)).left)
    assert force.diff(U).subs(U, 0) == 1
    with pytest.raises(InputError, match="functions are nested 5 deep at column 7; at most 4"):
        parse_equation(nested(MAX_FUNCTIONS + 1))


WORDS = "u u' u'' k sin exp sqrt log pi ( ) + - * / ** ^ = 2 0 1.5 1e9 200 ' . , é"
fragments = st.lists(st.sampled_from([" ", *WORDS.split()]), max_size=25).map("".join)


@settings(deadline=None, max_examples=300)
@given(st.text(max_size=60) | fragments)
def test_any_text_parses_or_raises_input_error_in_one_line(text):
    for read in (parse_equation, parse_expression):
        try:
            result = read(text)
        except InputError as error:
            assert str(error).isprintable()  # noqa: PT017
        else:
            assert len(to_text(result if read is parse_expression else result.left)) > 0


@settings(deadline=None, max_examples=100)
@given(fragments)
def test_any_text_converts_or_raises_input_error(text):
    try:
        expression = to_sympy(parse_equation("u'' + " + text).left)
    except InputError:
        return
    assert isinstance(expression, sympy.Expr)
    assert not expression.has(sympy.zoo, sympy.nan, sympy.I)


def test_not_text_is_refused():
    with pytest.raises(InputError, match="is int, not text"):
        parse_equation(3)


def test_the_largest_exponent_is_still_read():
    assert to_sympy(parse_expression(f"u**{MAX_EXPONENT}", unknown="u")) == U**MAX_EXPONENT


# --- numbers --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("12.566370614359172", Fraction(12566370614359172, 10**15)),
        ("-0.01", Fraction(-1, 100)),
        ("+3", Fraction(3)),
        (" 7/12 ", Fraction(7, 12)),
        ("1 / -4", Fraction(-1, 4)),
        ("1e-3", Fraction(1, 1000)),
        ("2.5E+2", Fraction(250)),
        (".5", Fraction(1, 2)),
        ("5.", Fraction(5)),
    ],
)
def test_numbers_mean_exactly_what_they_say(text, value):
    assert parse_number(text) == value


NOT_NUMBERS = "nan inf -inf 1/0 1/2/3 1e101 1e 0x10 1_000 1,5 ١ --1 1e-999999999999 pi 1e5.5"


@pytest.mark.parametrize("text", [*NOT_NUMBERS.split(), "", "1 2", "\x00", "9" * 61, "9" * 3000])
def test_other_numbers_are_refused_in_one_line(text):
    with pytest.raises(InputError) as caught:
        parse_number(text)
    assert str(caught.value).isprintable()


@QUICK
@given(st.fractions(max_denominator=10**12))
def test_fractions_read_back(value):
    assert parse_number(str(value)) == value


@QUICK
@given(st.floats(min_value=1e-90, max_value=1e90))
def test_decimals_are_the_shortest_that_round_to_the_float(value):
    assert float(parse_number(repr(value))) == value
