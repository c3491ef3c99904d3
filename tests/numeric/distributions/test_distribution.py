from __future__ import annotations

from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.distribution import Distribution


def plane(values: np.ndarray) -> Distribution:
    return Distribution(values, np.arange(2.0), np.arange(3.0), "test", {"a": 1})


def test_axes_are_copies_and_everything_is_read_only() -> None:
    omega = np.arange(2.0)
    kept = Distribution(np.zeros((2, 3)), omega, np.arange(3.0), "test")
    omega[0] = 9.0
    assert kept.omega[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        kept.values[0, 0] = 1.0
    with pytest.raises(FrozenInstanceError):
        kept.name = "other"  # type: ignore[misc]
    with pytest.raises(TypeError):
        plane(np.zeros((2, 3))).settings["a"] = 2  # type: ignore[index]


def test_values_must_be_frequency_by_time() -> None:
    with pytest.raises(InputError, match=r"shape \(3, 2\), the axes need \(2, 3\)"):
        plane(np.zeros((3, 2)))


def test_energy_counts_cells_in_hertz_seconds() -> None:
    kept = Distribution(np.full((4, 5), 2.0), np.pi * np.arange(4.0), 0.5 * np.arange(5.0), "test")
    assert kept.energy() == pytest.approx(20 * 2.0 * 0.5 * 0.5)
    with pytest.raises(InputError, match="two points"):
        Distribution(np.ones((1, 3)), np.zeros(1), np.arange(3.0), "test").energy()


def test_a_complex_plane_is_as_large_as_its_moduli_a_real_one_keeps_its_signs() -> None:
    turned = plane(np.array([[3.0 + 4.0j, -2.0, 1.0j], [0.0, -1.0, 5.0]]))
    signed = plane(np.array([[3.0, -2.0, 1.0], [0.0, -1.0, 5.0]]))
    for found, expected in ((turned, [[5.0, 2.0, 1.0], [0.0, 1.0, 5.0]]), (signed, signed.values)):
        drawn = found.picture().plane
        assert drawn is not None
        assert np.allclose(found.size(), expected)
        assert np.allclose(drawn.values, expected)
        assert not np.iscomplexobj(drawn.values)
