"""Equations of classes, set: every name, number and sign of the text is in the markup, and words are left alone."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import pytest

from ridgeback.compare.identification.candidates import (
    ALL_LAWS,
    BACKBONE,
    NAMES,
    VAN_DER_POL,
    DampingLaw,
    backbone_model,
    models_of,
)
from ridgeback.reports.text.equation import class_mathml, equation_latex, equation_mathml


@pytest.mark.parametrize("text", ["u'' + 2 mu u' + k^2 u + c3 u^3 = 0", "u'' - eps k (1 - (u/b)^2) u' + k^2 u = 0"])
def test_numbers_and_signs_are_kept_in_order(text: str) -> None:
    shown = "".join(ET.fromstring(equation_mathml(text)).itertext())  # noqa: S314 - what was just written
    assert re.findall(r"\d", shown) == re.findall(r"\d", text)
    assert [c for c in shown.replace("−", "-") if c in "+-=()/"] == [c for c in text if c in "+-=()/"]
    assert "\\" not in shown


@pytest.mark.parametrize("law", ALL_LAWS)
def test_every_class_is_set(law: DampingLaw) -> None:
    models = [models_of(name, law) for name in NAMES if name not in (BACKBONE, VAN_DER_POL)]
    for model in (*models, models_of(VAN_DER_POL, law), backbone_model(4, law)):
        shown = class_mathml(model.equation)
        assert shown.count("<math") >= (2 if model.name == BACKBONE else 1), model.equation
        words = re.sub(r"<[^>]*>", " ", re.sub(r"<math.*?</math>", " ", shown, flags=re.DOTALL))
        assert not re.search(r"[\^_=]|mu|eps", words), words


def test_what_is_no_equation_is_left_to_be_shown_as_it_is() -> None:
    assert equation_mathml("no equation at all") == ""
    assert equation_mathml("<script>alert(1)</script>").count("<script") == 0


def test_primes_and_powers_become_dots_and_superscripts() -> None:
    assert equation_latex("x'' + k**2*x") == r"\ddot{x} + k^{2} x"
