"""The atlas: places of singularities that are known otherwise, errors by closed forms, and the page in docs."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import mpmath
import pytest

from ridgeback.answers.atlas_table import cells, markdown
from ridgeback.common.errors import InputError
from ridgeback.compare.study.atlas import atlas, over_power
from ridgeback.symbolic.certificates.accuracy import accuracy
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.singularities.limits import limits
from ridgeback.symbolic.systems.any_form import as_oscillator

DOCS = Path(__file__).resolve().parents[3] / "docs" / "results" / "atlas.md"


def toda() -> float:
    """|A| where V(A) = exp(A) - 1 - A is V(2 pi i) = -2 pi i, a saddle in the complex plane."""
    return float(abs(mpmath.findroot(lambda a: mpmath.exp(a) - 1 - a + 2j * mpmath.pi, 2 - 1j)))


def relativistic() -> float:
    """sqrt(-x) at the zero of the period in x = A^2: the integral of (1 + r)/sqrt(1 + r/2), r = x cos(t)^2/2."""

    def period(x: mpmath.mpf) -> mpmath.mpf:
        def speed(t: mpmath.mpf) -> mpmath.mpf:
            r = x * mpmath.cos(t) ** 2 / 2
            return (1 + r) / mpmath.sqrt(1 + r / 2)

        return mpmath.quad(speed, [0, mpmath.pi / 2])

    return float(mpmath.sqrt(-mpmath.findroot(period, (-3.5, -3.1), solver="anderson")))


RADII: dict[str, Callable[[], float]] = {
    "pendulum": lambda: math.pi,
    "duffing-hardening": lambda: 1.0,
    "toda": toda,
    "morse": lambda: math.log(2.0),
    "kepler": lambda: 0.5,
    "sinh": lambda: math.pi,
    "tanh": lambda: math.pi / 2,
    "poschl-teller": lambda: math.pi / 2,
    "string-mass": lambda: math.sqrt(0.75),
    "electrostatic": lambda: math.sqrt(0.5),
    "rotating-hoop": lambda: math.acosh(2.0),
    "mathews-lakshmanan": lambda: 1.0,
    "relativistic": relativistic,
    "reversible": lambda: math.sqrt(4.0 * math.pi),
}


@pytest.mark.parametrize("name", RADII)
def test_the_radius_is_that_of_a_singularity_known_otherwise(name: str) -> None:
    (chart,) = atlas([name], orders=(2,))
    assert chart.limits is not None
    assert chart.limits.radius is not None
    assert chart.limits.uncertainty is not None
    assert abs(chart.limits.radius - RADII[name]()) <= chart.limits.uncertainty + 1e-9
    assert chart.limits.uncertainty < 0.01 * chart.limits.radius


def test_errors_are_those_against_the_closed_form() -> None:
    (chart,) = atlas(["poschl-teller"], orders=(4, 8))
    half, most = chart.inside
    for item in (half, most):
        a = float(item.place)
        series = [1.0, 1 / 2, 5 / 24, 61 / 720, 277 / 8064]  # of the secant, in A^2
        for order, error in zip(chart.orders, item.errors, strict=True):
            truncated = sum(c * a ** (2 * n) for n, c in enumerate(series[: order // 2 + 1]))
            assert error == pytest.approx(truncated * math.cos(a) - 1, rel=1e-9)
    assert [row["order"] for row in cells(chart)] == [4, 8, 4, 8]


def test_a_frequency_that_is_constant_and_one_that_is_not_known() -> None:
    isotonic, bubble = atlas(["isotonic", "bubble"], orders=(2,))
    assert "none: omega0 is constant" in markdown([isotonic])
    assert "not known" in markdown([bubble])
    assert (isotonic.inside, bubble.inside) == ((), ())
    with pytest.raises(InputError, match="no system"):
        atlas(["isotonik!"])


def test_the_page_in_docs_is_what_the_command_makes() -> None:
    page = DOCS.read_text(encoding="utf-8").splitlines()
    for line in markdown(atlas(["pendulum", "morse", "relativistic"])).splitlines():
        assert line in page


def test_forces_with_kinks_have_a_radius_or_one_term() -> None:
    """u + u|u|: the force of u > 0 continued through rest has another zero at u = -1, the separatrix of its series."""
    charts = atlas(["bilinear", "kinked-spring", "cubic", "cube-root", "quadratic"])
    _, kinked, cubic, *powers = charts
    assert kinked.limits is not None
    assert kinked.limits.radius == pytest.approx(1.0, abs=1e-6)
    assert all(abs(later) < abs(first) for item in kinked.inside for first, later in pairwise(item.errors))
    assert [chart.why.split(" exactly")[0] for chart in (cubic, *powers)] == [
        "none: omega0 = 0.8472130848 A",
        "none: omega0 = 1.070450514 A^(-1/3)",
        "none: omega0 = 0.9146813565 A^(1/2)",
    ]
    page = DOCS.read_text(encoding="utf-8").splitlines()
    assert all(line in page for line in markdown(charts[:3]).splitlines())


def test_a_series_about_a_power_law_is_charted() -> None:
    """u^3 + u^5 has the zeros +-i beside rest: the period is singular at A^2 = -1."""
    series = energy_on_each_side("u'' + u**3 + u**5 = 0", 96)
    assert isinstance(series, PowerExpansion)
    found = limits(over_power(series))
    assert found.radius == pytest.approx(1.0, abs=1e-3)
    (row,) = accuracy(as_oscillator("u'' + u**3 + u**5 = 0"), 8, [Fraction(1, 2)], resummed=False)
    assert row.errors[0] is not None
    assert 1e-6 < abs(float(row.errors[0].mid())) < 1e-4
