"""heyoka against the two integrators of the house; skipped where it is not installed (``pip install heyoka``)."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.heyoka import heyoka, integrate_heyoka
from ridgeback.numeric.motion.taylor import integrate_taylor
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


def test_without_the_library_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(OSError, match="pip install heyoka"):
        heyoka()


@pytest.mark.parametrize("name", ["damped-pendulum", "damped-duffing-hardening", "van-der-pol"])
def test_it_agrees_with_the_taylor_solution_of_twenty_five_digits(name: str) -> None:
    pytest.importorskip("heyoka", reason="heyoka is not installed")
    oscillator = find(name)
    other = integrate_heyoka(oscillator, (1.2, 0.0), duration=30.0, rate=4.0)
    precise = integrate_taylor(bind(oscillator), (1.2, 0.0), duration=30.0, rate=4.0, digits=25)
    assert np.abs(other.u - precise.u).max() < 1e-12
    assert np.abs(other.velocity - precise.velocity).max() < 1e-12
    np.testing.assert_allclose(other.crossings.time, precise.crossings.time, rtol=0, atol=1e-12)
    np.testing.assert_allclose(other.turnings.time, precise.turnings.time, rtol=0, atol=1e-12)
    assert (other.crossings.rising == precise.crossings.rising).all()


def test_constants_enter_to_the_last_digit() -> None:
    pytest.importorskip("heyoka", reason="heyoka is not installed")
    own = Oscillator.from_equation("u'' + pi**2*u + u**5/3 = 0")
    run = integrate_heyoka(own, (1e-4, 0.0), duration=20.0, rate=8.0)
    np.testing.assert_allclose(run.u, 1e-4 * np.cos(math.pi * run.time), rtol=0, atol=1e-17)


def test_leaving_the_well_is_refused() -> None:
    pytest.importorskip("heyoka", reason="heyoka is not installed")
    with pytest.raises(InputError, match=r"t = 1\.625 is outside the potential well"):
        integrate_heyoka(find("pendulum"), (0.0, 2.5), duration=10.0, rate=8.0)
