"""No text of a user gets out of its comment, in any language: seen by a tokenizer of the language, not by a search."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, String

from ridgeback.compare.binding.generated_code import check, tool_of
from ridgeback.symbolic.codegen import LANGUAGES, packaged, written
from ridgeback.symbolic.codegen.naming import argument_names, identifier
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.polynomial import polynomial_function, whole_domain
from ridgeback.symbolic.codegen.program import Argument, Form

LEXERS = {
    **dict.fromkeys(("python", "array-api", "numba"), "python"),
    **dict.fromkeys(("c", "c-header"), "c"),
    **{name: name for name in ("cpp", "rust", "julia", "fortran", "javascript")},
    "matlab": "octave",
    "latex": "tex",
}
ENDS = (
    *("*/", "/*", "*\\/", "\\", "\\\n", "//", "??/", "\n", "\r", "\r\n", "\u2028", "\u2029", "\x85", "\x0b", "\x0c"),
    *('"""', "'''", '"', "'", "`", "${", "}", "{", "%", "%{", "%}", "#", "#=", "=#", "!", "&", "\x00", "\x1b[0m"),
    *("\u202e", "\u2066", "\ufeff", "\\end{align*}", "\\input{x}", "\\write18{x}", "]]>", "</script>", "<!--", "-->"),
)
TEXTS = st.lists(
    st.sampled_from(ENDS) | st.text(max_size=6) | st.sampled_from(("int x;", "import os")), min_size=5, max_size=12
).map("".join)
WORDS = (
    *(
        "_Bool",
        "_Complex",
        "linux",
        "unix",
        "asm",
        "typeof",
        "bool",
        "true",
        "nullptr",
        "constexpr",
        "I",
        "NULL",
        "y",
        "C4",
    ),
    *(
        "lambda",
        "None",
        "match",
        "type",
        "impl",
        "mut",
        "self",
        "crate",
        "end",
        "begin",
        "function",
        "let",
        "var",
        "await",
    ),
    *("class", "new", "arguments", "eval", "NaN", "pi", "eps", "i", "j", "real", "REAL", "module", "program", "result"),
    *(
        "Mu",
        "mu",
        "MU",
        "double",
        "f64",
        "global",
        "classdef",
        "parfor",
        "nan",
        "inf",
        "math",
        "numpy",
        "fma",
        "sqrt",
        "k",
    ),
    *("char8_t", "co_await", "decltype", "namespace", "__x", "a__b", "_", "x_", "é", "数", "a b", "1a", "", "x" * 300),
)


def form_with(text: str) -> Form:
    """A form whose every text is a user's."""
    arguments = (Argument("A", text), Argument("k", text, 1.0))
    terms = {(0,): Number(fmpq(1)), (2,): Number(fmpq(-1, 16))}
    made = polynomial_function("omega0", text, arguments, ("A",), terms, whole_domain("A"), factor="k")
    return Form(
        "clock", text, (text, f"Reference: {text}"), (replace(made, notes=(text,)),), version="1", digest="0" * 16
    )


def code_of(language: str, source: str) -> list[tuple[object, str]]:
    """The tokens that are neither comment, documentation nor space; preprocessor lines count as code."""
    found = []
    for kind, value in get_lexer_by_name(LEXERS[language]).get_tokens(source):
        comment = kind in Comment and kind not in Comment.Preproc and kind not in Comment.PreprocFile
        if comment or kind in String.Doc or not value.strip():
            continue
        found.append((kind, value))
    return found


@cache
def harmless(language: str) -> list[tuple[object, str]]:
    return code_of(language, written(form_with("harmless"), language))


@settings(deadline=None, max_examples=25)  # each way out alone is tried below
@given(TEXTS)
def test_hostile_text_stays_in_comments(text: str) -> None:
    for language in LANGUAGES:
        assert code_of(language, written(form_with(text), language)) == harmless(language), language


@pytest.mark.parametrize("text", ENDS)
def test_each_way_out_is_closed(text: str) -> None:
    hostile = f"a {text} int x; import os; {text}"
    for language in LANGUAGES:
        assert code_of(language, written(form_with(hostile), language)) == harmless(language), language


def test_the_tokenizer_would_see_it() -> None:
    """Text that is put in unescaped is found, in every language that has comments of lines."""
    for language in LANGUAGES:
        source = written(form_with("harmless"), language)
        assert code_of(language, source.replace("harmless", "x\nint x;", 1)) != harmless(language) or language in (
            *("python", "array-api", "numba"),
        )
    python = written(form_with("harmless"), "python").replace("harmless", '"""\nimport os\n"""', 1)
    assert code_of("python", python) != harmless("python")


@settings(deadline=None, max_examples=100)
@given(st.lists(st.one_of(st.text(max_size=8), st.sampled_from(WORDS)), max_size=6, unique=True))
def test_parameters_become_distinct_plain_names(names: list[str]) -> None:
    found = list(argument_names(names).values())
    assert len({name.lower() for name in found}) == len(names)
    assert all(name.isascii() and name.isidentifier() and len(name) <= 60 for name in found)
    assert identifier("".join(names)).isidentifier()


@pytest.mark.parametrize("language", [name for name in LANGUAGES if name not in ("c-header", "latex")])
def test_words_of_any_language_compile_as_parameters(language: str) -> None:
    """All of them in one function, which every compiler takes without a warning."""
    if tool_of(language) is None:
        pytest.skip(f"nothing runs {language} here")
    names = tuple(argument_names(WORDS).values())
    variables = ("A", *names)
    terms = {
        tuple(1 if j in (0, i) else 0 for j in range(len(variables))): Number(fmpq(i + 1, 3))
        for i in range(len(variables))
    }
    arguments = tuple(Argument(name, "a parameter") for name in variables)
    made = polynomial_function("omega0", "Sum.", arguments, variables, terms, whole_domain("A"))
    form = Form("clock", "Words", (), (made,))
    assert packaged(form, language)
    found = check(form, language)
    assert found.state == "passed", found
