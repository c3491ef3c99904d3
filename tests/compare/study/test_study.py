"""Accuracy-order study: against published coefficients and closed forms, and its rules on made-up errors."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ridgeback.common.errors import InputError
from ridgeback.compare.study.results import Trend
from ridgeback.compare.study.study import order_needed, ranges, study
from ridgeback.symbolic.systems.catalogue import find

PENDULUM = study(find("pendulum"), (2, 4, 8, 16), np.linspace(0.1, 3.0, 30))


def test_errors_follow_from_the_published_pendulum_series():
    """1 - A^2/16 + A^4/3072 against agm(1, cos(A/2)), written out."""
    a = PENDULUM.amplitudes
    series = 1 - a**2 / 16 + a**4 / 3072
    np.testing.assert_allclose(PENDULUM.omega[1], series, rtol=1e-15)
    np.testing.assert_allclose(PENDULUM.relative_error[1], series / PENDULUM.reference - 1, atol=1e-15)
    assert PENDULUM.reference_error.max() < 1e-12


def test_the_observed_order_of_convergence_is_the_first_neglected_power():
    small = study(find("pendulum"), (2, 4, 8), [0.2, 0.4])
    observed = np.log2(np.abs(small.relative_error[:, 1] / small.relative_error[:, 0]))
    # order 8 at A = 0.2 is at rounding level, so only the first two are seen clearly
    np.testing.assert_allclose(observed[:2], [4, 6], atol=0.05)


@pytest.mark.parametrize("name", ["duffing-hardening", "duffing-softening", "helmholtz-duffing", "damped-pendulum"])
def test_two_derivations_give_one_study(name):
    amplitudes = np.linspace(0.05, 0.6, 6)
    first = study(find(name), (2, 5), amplitudes)
    second = study(find(name), (2, 5), amplitudes, method="energy-integral")
    np.testing.assert_array_equal(first.omega, second.omega)
    assert np.abs(first.relative_error[1, 0]) < 1e-6


@pytest.mark.parametrize("name", ["pendulum", "helmholtz-duffing"])
def test_multiple_scales_is_studied_on_the_same_orbits(name):
    """At order n both routes err by the first neglected power, and the exact frequency is the same one."""
    result = study(find(name), (2, 4), [0.1, 0.2], method="multiple-scales")
    np.testing.assert_array_equal(result.reference, study(find(name), (2,), [0.1, 0.2]).reference)
    observed = np.log2(np.abs(result.relative_error[:, 1] / result.relative_error[:, 0]))
    np.testing.assert_allclose(observed, [4, 6], atol=0.6)


def test_a_limit_cycle_is_studied_in_eps_against_its_orbit():
    result = study(find("van-der-pol"), (2, 4, 12), [0.2, 0.6])
    assert result.variable == "eps"
    np.testing.assert_allclose(result.omega[0], 1 - result.amplitudes**2 / 16, rtol=1e-15)
    assert (np.abs(result.relative_error[2]) < 1e-7).all()
    assert np.log(result.relative_error[0, 1] / result.relative_error[0, 0]) / np.log(3) == pytest.approx(4, abs=0.2)


def test_parameters_are_bound_before_the_study():
    result = study(find("duffing"), (2,), [0.5], values={"eps": "0.2"})
    assert result.omega[0, 0] == pytest.approx(1 + 3 / 8 * 0.2 * 0.25, rel=1e-15)
    assert result.reference[0] == pytest.approx(np.sqrt(1 + 0.75 * 0.2 * 0.25), rel=1e-4)


def _made_up(errors):
    errors = np.asarray(errors, dtype=float)
    shape = errors.shape
    return replace(
        PENDULUM, orders=tuple(range(shape[0])), amplitudes=np.arange(1.0, shape[1] + 1), relative_error=errors
    )


def test_a_range_ends_at_the_first_violation_whatever_comes_later():
    result = _made_up([[1e-5, 1e-2, 1e-5, 1e-5], [1e-5, -1e-5, 1e-5, 1e-2], [1.0, 0.0, 0.0, 0.0]])
    passed, changing, nowhere = (item.up_to for item in ranges(result, 1e-3))
    assert 1.0 < passed < 2.0
    assert (changing, nowhere) == (3.0, None)
    assert [item.order for item in order_needed(result, 1e-3)] == [0, 1, 1, None]


@pytest.mark.parametrize(
    ("order", "target", "end"),
    # |omega0_n(A) / (pi / (2 K(sin(A / 2)))) - 1| = target, solved by bisection on the closed form
    [(2, 1e-6, 0.235537), (8, 1e-6, 1.185557), (4, 1e-3, 1.670942), (8, 1e-3, 2.213523), (16, 1e-2, 2.860541)],
)
def test_a_range_of_use_does_not_depend_on_the_grid(order, target, end):
    for count in (30, 41):
        (item,) = ranges(study(find("pendulum"), (order,), np.linspace(0.1, 3.0, count)), target)
        assert item.up_to == pytest.approx(end, rel=1e-4)


@settings(deadline=None, max_examples=50)
@given(arrays(float, (3, 6), elements=st.floats(-1, 1)), st.floats(1e-3, 0.9))
def test_ranges_against_the_obvious_twin(errors, target):
    result = _made_up(errors)
    for row, item in zip(errors, ranges(result, target), strict=True):
        reach = None
        for amplitude, error in zip(result.amplitudes, row, strict=True):
            if abs(error) > target:
                break
            reach = amplitude
        following = np.append(result.amplitudes, np.inf)[0 if reach is None else int(reach)]
        assert item.up_to is None if reach is None else reach <= item.up_to < following
    for need in order_needed(result, target):
        serving = [i for i, row in enumerate(errors) if (np.abs(row[: int(need.amplitude)]) <= target).all()]
        assert need.order == (serving[0] if serving else None)


@pytest.mark.parametrize(
    ("orders", "amplitudes", "words"),
    [
        ((-1,), [1.0], "order -1"),
        ((2.5,), [1.0], "order 2.5"),
        ((), [1.0], "no orders"),
        ((2,), [0.0], "not a positive"),
        ((2,), [np.nan], "not a positive"),
        ((2,), [1.0, 3.2], "separatrix of pendulum at 3.14159"),
        ((2,), np.linspace(0.1, 3, 300_000), "use fewer"),
    ],
)
def test_bad_grids_are_refused_by_name(orders, amplitudes, words):
    with pytest.raises(InputError, match=words):
        study(find("pendulum"), orders, amplitudes)


def test_other_bad_input():
    with pytest.raises(InputError, match=r"amplitudes of shape \(1, 2\) are not a list of numbers"):
        study(find("pendulum"), (2,), [[0.5, 1.0]])
    with pytest.raises(InputError, match="101 values of eps exceed 100 orbits"):
        study(find("van-der-pol"), (2,), np.linspace(0.1, 1.0, 101))
    with pytest.raises(InputError, match=r"separatrix of duffing-softening at 1;"):
        study(find("duffing-softening"), (2,), [1.0])
    with pytest.raises(InputError, match="method 'guess'"):
        study(find("pendulum"), (2,), [1.0], method="guess")
    with pytest.raises(InputError, match="method lindstedt"):
        study(find("van-der-pol"), (2,), [0.1], method="multiple-scales")
    with pytest.raises(InputError, match="target"):
        ranges(PENDULUM, 0.0)


def test_rows_hold_every_cell():
    rows = PENDULUM.rows()
    assert len(rows) == 4 * 30
    assert set(rows[0]) == {"order", "amplitude", "method", "omega", "omega_reference", "relative_error"}


@pytest.mark.parametrize(("name", "radius"), [("pendulum", np.pi), ("duffing-hardening", 1.0)])
def test_the_radius_of_convergence_is_that_of_the_nearest_singularity(name, radius):
    result = study(find(name), (40,), [0.5])
    assert abs(result.convergence_radius - radius) <= result.convergence_uncertainty
    assert result.convergence_uncertainty < 0.1 * radius


def test_no_radius_is_claimed_where_the_coefficients_do_not_settle_it():
    result = study(find("pendulum"), (2,), [0.5])
    assert result.convergence_radius is None
    assert "not known" in result.convergence_note


@pytest.mark.parametrize(
    ("name", "top", "trend"),
    [
        ("linear", 2.0, Trend.CONSTANT),
        ("pendulum", 2.0, Trend.FALLING),
        ("duffing", 2.0, Trend.RISING),
    ],
)
def test_the_trend_of_a_backbone_is_that_of_its_exact_frequency(name, top, trend):
    assert study(find(name), (2,), np.linspace(0.1, top, 8)).trend is trend
