"""Formulas held against enclosures: the error is the true one, whatever formula it is of."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.at_amplitudes import Formula, certified_frequencies
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.systems.catalogue import find

PENDULUM = find("pendulum")


def exact_pendulum(amplitude: Fraction) -> mpmath.mpf:
    with mpmath.workdps(40):
        return mpmath.pi / (
            2 * mpmath.ellipk(mpmath.sin(mpmath.mpf(amplitude.numerator) / amplitude.denominator / 2) ** 2)
        )


@pytest.mark.parametrize("amplitude", [Fraction(1, 10), Fraction(2), Fraction(31, 10)])
def test_the_error_is_the_true_one(amplitude: Fraction) -> None:
    series = energy_integral(PENDULUM, 12)
    row = certified_frequencies(PENDULUM, series, [amplitude])[0].to_dict(30)
    with mpmath.workdps(40):
        true = exact_pendulum(amplitude)
        assert abs(mpmath.mpf(str(row["omega0"])) - true) <= mpmath.mpf(str(row["radius"]))
        error = mpmath.mpf(str(series(amplitude).p)) / series(amplitude).q / true - 1
        assert mpmath.almosteq(mpmath.mpf(str(row["relative_error"])), error, 1e-5)
        assert abs(error) <= row["error_bound"] <= abs(error) * (1 + mpmath.mpf("1e-12"))


def test_balls_exact_coefficients_and_resummations_have_one_interface() -> None:
    series = lindstedt(PENDULUM, 16)
    formulas: list[Formula] = [
        series,
        lindstedt_in_balls(PENDULUM, 16),
        *(resum(PENDULUM, series, k) for k in ("pade", "nome")),
    ]
    errors = [certified_frequencies(PENDULUM, f, [Fraction(2)])[0].error for f in formulas]
    assert all(e is not None for e in errors)
    exact, balls, pade, nome = (abs(e) for e in errors if e is not None)
    assert exact.overlaps(balls)
    assert nome < pade
    assert pade < exact


def test_a_series_of_another_oscillator_is_refused() -> None:
    with pytest.raises(InputError, match="not one of pendulum"):
        certified_frequencies(PENDULUM, lindstedt(find("duffing"), 4), [Fraction(1)])
    with pytest.raises(InputError, match="no series of pendulum"):
        certified_frequencies(PENDULUM, lindstedt_in_balls(find("duffing"), 4), [Fraction(1)])
    with pytest.raises(InputError, match="separatrix at 3"):
        certified_frequencies(PENDULUM, lindstedt(PENDULUM, 4), [Fraction(4)])


def test_a_pole_in_the_range_is_refused() -> None:
    series = lindstedt(PENDULUM, 16)
    assert resum(PENDULUM, series, "pade", up_to=Fraction(33, 10)).to_dict()["pole"] == pytest.approx(3.3395, abs=1e-4)
    with pytest.raises(InputError, match=r"has a pole at A = 3\.339"):
        resum(PENDULUM, series, "pade", up_to=Fraction(34, 10))


def test_the_pole_printed_is_a_zero_of_the_denominator_printed() -> None:
    public = resum(PENDULUM, lindstedt(PENDULUM, 16), "pade").to_dict()
    denominator = [Fraction(str(c)) for c in public["denominator"]]  # type: ignore[attr-defined]
    pole = float(public["pole"])  # type: ignore[arg-type]
    sizes = [float(c) * pole ** (2 * n) for n, c in enumerate(denominator)]
    assert abs(sum(sizes)) < 1e-12 * sum(map(abs, sizes))


def test_maps_take_out_the_growth_at_infinity() -> None:
    duffing = find("duffing")
    plain, grown = (
        resum(duffing, lindstedt(duffing, 16), "map", growth=growth) for growth in (Fraction(0), Fraction(1, 2))
    )
    bounds = [certified_frequencies(duffing, f, [Fraction(10)])[0].to_dict(20)["error_bound"] for f in (plain, grown)]
    assert float(str(bounds[1])) < 1e-3
    assert float(str(bounds[0])) > 0.1


@pytest.mark.parametrize(
    ("kind", "options", "said"),
    [
        ("spline", {}, "pade, map, nome"),
        ("pade", {"growth": Fraction(1)}, "map only"),
        ("nome", {"degrees": (1, 1)}, "degrees"),
        ("pade", {"degrees": (9, 9)}, "lower a degree"),
    ],
)
def test_bad_requests(kind: str, options: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        resum(PENDULUM, lindstedt(PENDULUM, 8), kind, **options)  # type: ignore[arg-type]


def test_a_constant_frequency_has_nothing_to_resum() -> None:
    linear = find("linear")
    with pytest.raises(InputError, match="constant through order 8"):
        resum(linear, lindstedt(linear, 8), "pade")


def test_the_nome_is_of_the_peak_amplitude() -> None:
    with pytest.raises(InputError, match="peak"):
        resum(PENDULUM, lindstedt(PENDULUM, 8, amplitude="fundamental"), "nome")
    with pytest.raises(InputError, match="neither"):
        resum(find("helmholtz-duffing"), lindstedt(find("helmholtz-duffing"), 8), "nome")
