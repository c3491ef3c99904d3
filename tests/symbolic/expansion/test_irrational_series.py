"""Series with irrational coefficients: enclosed, estimated and printed like others."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.at_amplitudes import certified_frequencies
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.limits import flow_limits
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.singularities.limits import limits
from ridgeback.symbolic.systems.description import from_text
from ridgeback.symbolic.systems.oscillator import Oscillator

SHIFTED = from_text("u'' - 2 + u**3 = 0", about="2**(1/3)")


def test_the_series_is_held_against_its_enclosure() -> None:
    (row,) = certified_frequencies(SHIFTED, lindstedt(SHIFTED, 12), [Fraction(1, 10)])
    assert row.error is not None
    assert abs(row.error) < 1e-11


def test_the_ball_of_the_series_is_that_of_its_decimals() -> None:
    series = lindstedt(SHIFTED, 6)
    with ctx.workprec(120):
        value = series.in_balls(arb("0.25"))
        plain = sum((arb(str(c.evalf(60))) * arb("0.25") ** n for n, c in enumerate(series.frequency)), arb(0))
        assert abs(value - plain) < arb(2) ** -100


def test_the_limits_do_not_depend_on_the_form_of_the_numbers() -> None:
    """u'' + sqrt(2) u + sqrt(2) u^3: the series in A of u'' + u + u^3."""
    irrational = limits(lindstedt(Oscillator.from_equation("u'' + sqrt(2)*u + sqrt(3)*u**3 = 0"), 48))
    rational = limits(lindstedt(Oscillator.from_equation("u'' + u + u**3 = 0"), 48))
    assert irrational.radius is not None
    assert rational.radius is not None
    assert irrational.radius == pytest.approx(rational.radius * (2 / 3) ** 0.25, rel=1e-6)


def test_irrational_coefficients_have_decimals() -> None:
    rows = lindstedt(Oscillator.from_equation("x'' + 0.5*x + 0.1*x**3 = 0"), 2).to_dict()["frequency"]
    assert [row["decimal"] for row in rows] == pytest.approx([0.5**0.5, 3 * 2**0.5 / 80])  # type: ignore[index]
    flow = multiple_scales(Oscillator.from_equation("u'' + 2*mu*u' + 2*u + u**3 = 0"), 2)
    assert flow.to_dict()["frequency"][0] == {  # type: ignore[index]
        "powers": {"a": 0, "mu": 0},
        "coefficient": "sqrt(2)",
        "decimal": 2**0.5,
    }


@pytest.mark.parametrize(
    ("equation", "words"),
    [
        ("u'' - eps*(3 - u**2)*u' + u = 0", r"irrational zero a = 3.4641; rescale u"),
        ("u'' - eps*(1 + u**2)*u' + u = 0", "has no positive zero, so that no limit cycle begins"),
        ("u'' - eps*(1 - 8*u**2 + 8*u**4)*u' + u = 0", "double: limit cycles meet there"),
    ],
)
def test_what_keeps_a_limit_cycle_from_being_expanded_is_said(equation: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        lindstedt(Oscillator.from_equation(equation), 4)


@pytest.mark.parametrize("force", ["u + u**3", "u"])
def test_multiple_scales_does_not_send_to_multiple_scales(force: str) -> None:
    own = Oscillator.from_equation(f"u'' - eps*(1 - 2*u**2)*u' + {force} = 0", parameters={"eps": "1/10"})
    assert "multiple-scales" not in flow_limits(own, multiple_scales(own, 4, weight=1)).sentence()
