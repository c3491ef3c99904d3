"""Studies, benchmarks and code of forces with kinks, and of losses that are not analytic at rest."""

from __future__ import annotations

import numpy as np
import pytest

import ridgeback
from ridgeback.common.errors import InputError
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.compare.study.certified import certified_rows
from ridgeback.compare.study.derived import backbone_series, derive

KINKED = "u'' + u + u*abs(u)/5 = 0"


@pytest.mark.parametrize(
    ("equation", "reference"),
    [
        (KINKED, "quadrature of the period"),
        ("u'' + 0.1*abs(u')*u' + 0.1*sign(u') + u + u*abs(u)/5 = 0", "quadrature of the period"),
        ("u'' + u - sin(u) = 0", "certified enclosure"),
        ("u'' + u*abs(u) + u**3/5 = 0", "certified enclosure"),
    ],
)
def test_a_study_holds_the_series_on_each_side_against_an_exact_frequency(equation: str, reference: str) -> None:
    result = ridgeback.study(equation, (1, 3, 5), [0.1, 0.2])
    assert result.method == "energy-integral"
    assert result.reference_name == reference
    errors = np.abs(result.relative_error)
    assert np.all(errors[-1] < 1e-5)
    assert np.all(errors[1:] <= errors[:-1])


def test_errors_of_the_series_and_its_quotient_are_proved() -> None:
    rows = certified_rows(KINKED, (4,), (0.5,))
    errors = {row["method"]: abs(float(row["relative_error"] or 0)) for row in rows}
    assert errors["truncated series"] == pytest.approx(1.66233e-07, rel=1e-4)
    assert errors["Pade [2/2]"] < errors["truncated series"]
    (only,) = certified_rows("u'' + u*abs(u) = 0", (2,), (0.5,))
    assert abs(float(only["relative_error"] or 0)) < 1e-30


def test_the_code_of_a_kinked_series_holds_for_positive_amplitudes() -> None:
    source = ridgeback.generate(KINKED, order=3)
    space: dict[str, object] = {}
    exec(compile(source, "generated", "exec"), space)  # noqa: S102 - our own generated source
    omega0 = space["omega0"]
    assert omega0(0.5) == pytest.approx(ridgeback.derive(KINKED, 3)(0.5), rel=1e-15)  # type: ignore[operator]
    assert np.isnan(omega0(-0.5))  # type: ignore[operator]


def test_a_series_in_other_powers_is_not_taken_for_one_in_a() -> None:
    with pytest.raises(InputError, match="power series in A"):
        backbone_series(ridgeback.oscillator("u'' + u*abs(u) = 0"), 2)


def test_a_motion_with_switches_is_integrated_twice_and_averaged() -> None:
    chosen = setting("u'' + 0.002*sign(u') + 0.002*abs(u')*u' + u + u*abs(u)/5 = 0", initial=(1.0, 0.0), duration=60.0)
    motion = integrate_motion(chosen)
    assert motion.precise.method == "RK45"
    assert motion.disagreement < 1e-9
    assert motion.averaged is not None
    inside = slice(100, -100)
    gap = motion.averaged.omega[inside] / motion.reference(motion.time)[inside] - 1
    assert float(np.nanmax(np.abs(gap))) < 2e-5


def test_what_is_derived_of_rough_losses_is_the_backbone_without_them() -> None:
    found = derive(ridgeback.oscillator("u'' + 0.1*sign(u') + sin(u) = 0"), 4)
    assert found.flow is None
    assert found.expansion.frequency == ridgeback.derive("pendulum", 4).frequency
