"""The derivations reproduce what has been published, from a table that names its sources."""

import tomllib
from pathlib import Path

import pytest
import sympy

from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

TABLE = tomllib.loads((Path(__file__).parents[2] / "published.toml").read_text(encoding="utf-8"))


def oscillator(entry: dict[str, object]) -> Oscillator:
    return find(str(entry["system"])) if "system" in entry else Oscillator.from_equation(str(entry["equation"]))


@pytest.mark.parametrize("entry", TABLE["series"], ids=lambda e: f"{e.get('system', 'equation')}-{e['quantity']}")
def test_published_series(entry: dict[str, object]) -> None:
    published = [sympy.Rational(value) for value in entry["even"]]  # type: ignore[attr-defined]
    found = lindstedt(oscillator(entry), 2 * len(published) - 2)
    values = {
        "frequency": found.coefficients,
        "peak amplitude": found.amplitude_coefficients or (),
        "period over 2 pi": truncated.reciprocal(list(found.coefficients)),
    }[str(entry["quantity"])]
    assert [as_sympy(c) for c in values[::2]] == published
    assert all(c == 0 for c in values[1::2])


@pytest.mark.parametrize("entry", TABLE["isochronous"], ids=lambda e: e["equation"])
def test_isochronous_potentials_have_a_constant_frequency(entry: dict[str, object]) -> None:
    series = lindstedt(oscillator(entry), 12)
    assert series.coefficients == (1, *[0] * 12)
    assert series.residual() == []


def test_mathews_lakshmanan_oscillator_has_its_closed_form() -> None:
    entry = TABLE["mathews_lakshmanan"]
    series = lindstedt(Oscillator.from_equation(entry["equation"]), 10)
    c, amplitude = sympy.Symbol("c", real=True), sympy.Symbol("A", real=True)
    exact = sympy.series(1 / sympy.sqrt(1 + c * amplitude**2), amplitude, 0, 11).removeO()
    assert sympy.expand(series.expression() - exact) == 0
    # u is one pure harmonic: A cos tau and nothing else.
    assert [h.multiple for h in series.harmonics] == [1]
    assert [value for value in series.harmonics[0].cosine if value != 0] == [1]
