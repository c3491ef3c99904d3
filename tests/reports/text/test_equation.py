"""Equations of classes, set: every name, number and sign of the text is in the markup, and words are left alone."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import pytest

from ridgeback.reports.text.equation import equation_latex, equation_mathml


@pytest.mark.parametrize("text", ["u'' + 2 mu u' + k^2 u + c3 u^3 = 0", "u'' - eps k (1 - (u/b)^2) u' + k^2 u = 0"])
def test_numbers_and_signs_are_kept_in_order(text: str) -> None:
    shown = "".join(ET.fromstring(equation_mathml(text)).itertext())  # noqa: S314 - what was just written
    assert re.findall(r"\d", shown) == re.findall(r"\d", text)
    assert [c for c in shown.replace("−", "-") if c in "+-=()/"] == [c for c in text if c in "+-=()/"]
    assert "\\" not in shown


def test_what_is_no_equation_is_left_to_be_shown_as_it_is() -> None:
    assert equation_mathml("no equation at all") == ""
    assert equation_mathml("<script>alert(1)</script>").count("<script") == 0


def test_primes_and_powers_become_dots_and_superscripts() -> None:
    assert equation_latex("x'' + k**2*x") == r"\ddot{x} + k^{2} x"
