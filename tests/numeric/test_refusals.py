"""What the numeric room cannot use is refused in one line, and what is empty stays empty."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.model_fit.family import Family
from ridgeback.numeric.model_fit.whiteness import whiteness
from ridgeback.numeric.motion.dynamics import duffing
from ridgeback.numeric.orbits.period import exact_frequency
from ridgeback.numeric.recording.clipping import clipped
from ridgeback.numeric.recording.drift import detrended
from ridgeback.numeric.recording.reading import read_recordings
from ridgeback.numeric.recording.treatment import Treatment
from ridgeback.numeric.signal.band_limit import band_limited
from ridgeback.numeric.signal.presence import presence
from ridgeback.numeric.signal.windows import window

FLAT = np.ones(64)


def family(names: tuple[str, ...], start: list[float]) -> Family:
    """A family whose forces are never asked for."""
    unused: Callable[..., object] = print
    return Family("own", names, np.array(start), unused, unused, unused, unused)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: whiteness(FLAT[:9]), "residual has 9 samples; 10 are needed"),
        (lambda: whiteness(FLAT), "residual is constant; there is nothing to judge"),
        (lambda: detrended(FLAT, 1.0, "cubic"), "detrend 'cubic' is unknown; use one of"),
        (lambda: window("hann", -1), "half width -1 of a window is negative"),
        (lambda: band_limited(FLAT + 0j, 1.0, 2.0, 1.0), r"band \(2, 1\) rad per time unit is not usable"),
        (lambda: band_limited(FLAT + 0j, 1.0, 2.0, 2.0), r"band \(2, 2\) rad per time unit is not usable"),
        (lambda: band_limited(FLAT + 0j, 1.0, 0.0, math.inf), r"band \(0, inf\) rad per time unit is not usable"),
        (lambda: Treatment(fill=-1.0), "fill -1.0 is not a positive time"),
        (lambda: Treatment(fill=math.nan), "fill nan is not a positive time"),
        (lambda: read_recordings([]), "no file is given; name at least one"),
        (lambda: family(("k", "mu"), [1.0]), "own: 1 starting values for the parameters"),
        (lambda: family(("k", "k"), [1.0, 1.0]), "own: 2 starting values for the parameters"),
        (lambda: family(("k",), [math.inf]), "own: parameter k has no finite value to start from"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said) as refused:
        call()
    assert "\n" not in str(refused.value)


def test_of_nothing_there_is_nothing() -> None:
    """No amplitudes have no frequencies, a constant is not clipped, and in silence no oscillation stands out."""
    table = exact_frequency(duffing(eps=1.0), np.array([]))
    assert table.omega.shape == (0,)
    assert not clipped(FLAT).any()
    assert not clipped(FLAT[:1]).any()
    silence = presence(FLAT, 1.0)
    assert (silence.probability, silence.found) == (1.0, False)
