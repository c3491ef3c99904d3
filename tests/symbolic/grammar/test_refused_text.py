"""What is no equation: bad text is refused with what and where, however deep and long it is."""

import sys

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.parse import (
    MAX_NESTING,
    U,
    parse_equation,
    parse_expression,
    to_sympy,
    to_text,
)
from ridgeback.symbolic.grammar.size import MAX_EXPONENT, MAX_FUNCTIONS
from ridgeback.symbolic.grammar.tokens import MAX_LENGTH

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
