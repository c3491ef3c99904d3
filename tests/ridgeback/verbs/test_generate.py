"""``ridgeback generate``: parameters as arguments, resummations, and what is said beside the code."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from typing import Any

import pytest

Ridgeback = Callable[..., Any]  # the fixture of conftest.py


def source_of(ridgeback: Ridgeback, *words: str) -> str:
    done = ridgeback("generate", *words)
    assert (done.code, done.err) == (0, "")
    return str(done.out)


def test_every_symbol_is_an_argument(ridgeback: Ridgeback) -> None:
    text = source_of(ridgeback, "--equation", "u'' + u + c*u**3 = 0", "--order", "4")
    assert "def omega0(A, c):" in text
    flow = ["--method", "multiple-scales", "--weights", "c3=1", "--order", "4", "--language", "c"]
    text = source_of(ridgeback, "--equation", "u'' + 2*mu*u' + c3*u'**3 + k**2*u + g*u**3 = 0", *flow)
    assert "double equation_growth_rate(double a, double mu, double c3, double g, double k)" in text
    assert "p + 2 q + 1 q_2 up to 4" in text


def test_the_error_certified_beside_the_code_is_the_one_that_derive_proves(ridgeback: Ridgeback) -> None:
    text = source_of(ridgeback, "pendulum", "--order", "8")
    found = re.search(r"is at most (\S+) for .A. <= (\S+),", " ".join(text.split()))
    assert found is not None
    row = json.loads(ridgeback(*f"derive pendulum --at {found[2]} --format json".split()).out)["at"][0]
    assert row["error_bound"] <= float(found[1]) <= 1.1 * row["error_bound"]


def test_a_resummation_as_code_with_its_pole(ridgeback: Ridgeback) -> None:
    words = ["pendulum", "--order", "16", "--resummed", "pade"]
    text = source_of(ridgeback, *words)
    assert "Not to be used from A = 3.33953 on: a pole." in text
    assert f"|A| <= {math.floor(math.pi * 1e5) / 1e5}" in text
    public = json.loads(source_of(ridgeback, *words, "--format", "json"))
    assert (public["method"], public["language"]) == ("Pade [4/4]", "python")
    assert public["source"] == text
    assert "[3/5]" in source_of(ridgeback, *words, "--degrees", "3/5", "--language", "c", "--up-to", "2")
    assert "no enclosure" not in source_of(ridgeback, "van-der-pol", "--order", "8", "--resummed", "pade")
    assert "double w = A_squared/moved;" in source_of(ridgeback, "duffing", "--resummed", "map", "--language", "c")


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("pendulum --up-to 4", "beyond A = 3.14"),
        ("pendulum --terms 4", "--resummed sine"),
        ("pendulum --motion --resummed nome", "--motion"),
        ("duffing --resummed sine --terms 3", "no pendulum"),
        ("duffing --resummed agm", "give --up-to"),
        ("pendulum --language cobol", "languages are python"),
        ("pendulum --language julia --real float32", "written in float64"),
        ("pendulum --name 2fast", "letter first"),
        ("pendulum --degrees 2/2", "needs --resummed"),
        ("pendulum --resummed pade --up-to 0", "above 0"),
        ("pendulum --resummed pade --order 16 --up-to 4", "pole at A = 3.339"),
        ("pendulum --growth 1/2", "needs --resummed"),
        ("duffing --resummed map --growth 1/3", "multiples of 1/2"),
        ("van-der-pol --resummed nome", "peak amplitude"),
        ("pendulum --resummed nome --up-to 4", "beyond A = 3.14"),
        ("damped-pendulum --resummed pade", "slow flow"),
    ],
)
def test_one_line_says_what_does_not_go(ridgeback: Ridgeback, words: str, why: str) -> None:
    done = ridgeback("generate", *words.split())
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert why in done.err
