"""Kinks away from rest: laws of max, min, abs and sign of u - s, against the closed forms of bilinear oscillators."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ridgeback
from ridgeback.common.errors import InputError
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.numeric.motion.bilinear import Bilinear, bilinear_frequency, bilinear_waveform, potential
from ridgeback.numeric.motion.bilinear_motion import bilinear_motion
from ridgeback.numeric.orbits.period import exact_frequency, peak_of_action
from ridgeback.numeric.orbits.potential import potential_at
from ridgeback.numeric.orbits.waveform import orbit_harmonics, orbit_position
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.sides import NoSeriesError

TWO = find("bilinear-stops").equation
ONE = "u'' + 2*mu*u' + k1**2*u + (k2**2 - k1**2)*max(u - s, 0) + p*(1 + sign(u - s))/2 = 0"
PEAKS = (0.5, 0.999, 1.0000001, 1.001, 1.1, 2.0, 50.0)


def pair(*, symmetric: bool, k2: str = "5", p: str = "3", mu: str = "0.03") -> tuple[Oscillator, Bilinear]:
    """The same oscillator as a law of the grammar and as its closed form."""
    values = {"k1": "2", "k2": k2, "s": "1", "p": p, "mu": mu}
    own = Oscillator.from_equation(TWO if symmetric else ONE, parameters=values)
    return own, Bilinear(2.0, float(k2), 1.0, float(mu), symmetric, float(p))


@pytest.mark.parametrize(("symmetric", "k2", "p"), [(True, "5", "3"), (False, "5", "3"), (True, "1", "0")])
def test_orbits_are_those_of_the_closed_form_up_to_the_stop_and_beyond(symmetric: bool, k2: str, p: str) -> None:
    own, closed = pair(symmetric=symmetric, k2=k2, p=p)
    dynamics, peaks = ridgeback.bind(own), np.array(PEAKS)
    u = np.linspace(-3.1, 3.3, 57)
    assert dynamics.potential is not None
    assert dynamics.potential(u) == pytest.approx(potential(closed, u), rel=1e-13)
    assert potential_at(dynamics, u) == pytest.approx(potential(closed, u), rel=1e-13)
    table = exact_frequency(dynamics, peaks)
    assert table.omega == pytest.approx(bilinear_frequency(closed, peaks), rel=1e-13)
    assert table.error.max() < 1e-12
    assert peak_of_action(dynamics, table.action) == pytest.approx(peaks, rel=1e-12)
    phase = np.arange(4096) * 2 * np.pi / 4096
    wave = np.fft.rfft(bilinear_waveform(closed, peaks, phase), axis=1).real / 2048
    assert orbit_harmonics(dynamics, peaks, count=9).cosine[1:] == pytest.approx(wave[:, 1:10].T, abs=1e-8)
    for state in ((2.5, 0.0), (0.3, 2.0), (-0.7, -3.0), (1.7, 1.0), (-2.0, 1.0)):
        place = orbit_position(dynamics, *state)
        assert bilinear_waveform(closed, [place.peak], [place.phase])[0, 0] == pytest.approx(state[0], abs=1e-13)


@settings(deadline=None, max_examples=5)
@given(st.booleans(), st.integers(1, 9), st.integers(0, 8), st.integers(0, 9))
def test_the_damped_motion_is_that_of_the_closed_form(symmetric: bool, k2: int, p: int, hundredths: int) -> None:
    own, closed = pair(symmetric=symmetric, k2=str(k2), p=str(p), mu=f"0.0{hundredths}")
    run = ridgeback.simulate(own, (2.5, 0.0), duration=12.0, rate=8.0)
    exact = bilinear_motion(closed, (2.5, 0.0), duration=12.0, rate=8.0)
    assert run.u == pytest.approx(exact.u, abs=1e-8)
    assert run.crossings.time == pytest.approx(exact.crossings.time, abs=1e-8)


@pytest.mark.parametrize(
    "equation",
    [
        "u'' + 0.04*abs(u')*u' + u + 3*(max(u - 1, 0) + min(u + 1, 0)) = 0",
        "u'' + 0.02*u' + sin(u) + u*abs(u)/2 + 2*max(u - 1, 0) + abs(u + 1/2)*(u + 1/2)/4 - 1/16 = 0",
    ],
)
def test_the_averaged_action_follows_the_integrated_motion_across_stops(equation: str) -> None:
    """Nonlinear losses, a force that is no straight line, a kink at rest beside one beyond: all by their stretches."""
    motion = integrate_motion(setting(equation, initial=(2.5, 0.0), duration=60.0, rate=4.0))
    omega = motion.reference(motion.time)
    inside = np.isfinite(omega) & (motion.time > 6.0) & (motion.time < 54.0)
    assert motion.averaged is not None
    apart = motion.averaged.omega[inside] / omega[inside] - 1
    assert np.sqrt(np.mean(apart**2)) < 5e-4
    assert np.median(np.abs(apart)) < 1e-4
    assert motion.disagreement < 1e-7


def test_laws_away_from_rest_are_read_in_any_form() -> None:
    same = [
        "u'' + u + 3*max(u - 1, 0) = 0",
        "u'' + u + 3*(u - 1 + abs(u - 1))/2 = 0",
        "u'' + u + 3/2*(u - 1)*(1 + sign(2*u - 2)) = 0",
        "u'' + max(u, 4*u - 3) = 0",
        "u'' - min(-u, 3 - 4*u) = 0",
    ]
    at = np.linspace(-2.0, 3.0, 26)
    for text in same:
        own = Oscillator.from_equation(text)
        law = ridgeback.bind(own)
        assert [law.force(u, 0.0) for u in at] == pytest.approx([u + 3 * max(u - 1, 0) for u in at], abs=1e-14)
        assert own.stops == (1,)
        assert own.natural_frequency == 1
    symbolic = Oscillator.from_equation(TWO)
    assert [str(place) for place in symbolic.stops] == ["-s", "s"]
    assert str(symbolic.natural_frequency) == "k1"
    with pytest.raises(InputError, match=r"abs\(1 - u\*\*2\) may change sign where nobody can tell"):
        Oscillator.from_equation("u'' + u + abs(1 - u**2) - 1 = 0")


def test_no_series_about_rest_claims_to_hold_beyond_a_stop() -> None:
    free = find("bilinear-stops").with_parameters({"mu": 0})
    routes = (
        lambda: ridgeback.derive(free, 4),
        lambda: ridgeback.derive(free, 4, method="energy-integral"),
        lambda: ridgeback.multiple_scales(find("bilinear-stops"), 2),
        lambda: ridgeback.enclose(free, 2),
        lambda: energy_on_each_side("u'' + u + u*abs(u) + max(u - 1, 0) = 0", 4),
        lambda: averaged_losses("u'' + 0.1*abs(u')*u' + u + max(u - 1, 0) = 0", 2),
    )
    for route in routes:
        with pytest.raises(NoSeriesError, match="no series about rest holds; up to there it is f = "):
            route()
