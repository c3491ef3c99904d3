"""Norms against their definitions on tracks whose error is known."""

import numpy as np
import pytest

from ridgeback.compare.motion.error_norms import failure, mean, relative_error, rms, score, worst, zones
from ridgeback.compare.motion.results import Curve

TIME = np.linspace(0.0, 20.0, 2001)


def reference(time):
    return np.where((time >= 0.5) & (time <= 19.5), 2.0 + 0.1 * time, np.nan)


def curve(omega, valid=None):
    valid = np.ones(TIME.size, dtype=bool) if valid is None else valid
    return Curve("test", "test", "estimate", TIME, omega, valid)


def test_zones_cover_the_span_without_overlap():
    zone = zones(3.0, 5.0)
    time = np.linspace(3.0, 5.0, 401)
    total = zone.start(time).astype(int) + zone.interior(time) + zone.end(time)
    assert (total == 1).all()


def test_a_constant_relative_error_has_every_norm_equal():
    found = score(curve(1.01 * (2.0 + 0.1 * TIME)), reference, zones(0.0, 20.0))
    for value in (
        found.rms_interior,
        found.max_interior,
        found.mean_interior,
        found.rms_start,
        found.rms_end,
    ):
        assert value == pytest.approx(0.01, rel=1e-9)


def test_a_sine_error_has_rms_of_one_over_root_two_and_no_mean():
    zone = zones(0.0, 20.0)
    ripple = 1e-3 * np.sin(2 * np.pi * TIME)  # sixteen whole periods in the interior
    found = score(curve((1 + ripple) * (2.0 + 0.1 * TIME)), reference, zone)
    assert found.rms_interior == pytest.approx(1e-3 / np.sqrt(2), rel=1e-3)
    assert found.mean_interior == pytest.approx(0.0, abs=1e-6)
    assert found.max_interior == pytest.approx(1e-3, rel=1e-3)


def test_invalid_samples_and_an_absent_reference_do_not_count():
    valid = TIME < 10
    omega = np.where(valid, 2.0 + 0.1 * TIME, 1e9)
    error = relative_error(curve(omega, valid), reference)
    assert np.isnan(error[TIME < 0.5]).all()
    assert np.isnan(error[TIME >= 10]).all()
    found = score(curve(omega, valid), reference, zones(0.0, 20.0))
    assert found.max_interior == pytest.approx(0.0, abs=1e-15)
    assert found.rms_end is None


def test_empty_norms_are_none_and_failures_keep_their_reason():
    nothing = np.full(3, np.nan)
    assert rms(nothing) is worst(nothing) is mean(nothing) is None
    assert failure("wigner", "Wigner", "too short").failed == "too short"
