"""Random systems of each class that closes or attracts: enclosures, and series, against the integrated motion."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ridgeback.symbolic.cycles.enclose import Cycle
from ridgeback.symbolic.cycles.found import limit_cycles
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import U, V

SMALL = st.fractions(Fraction(-1, 2), Fraction(1, 2), max_denominator=6)
SOME = st.fractions(Fraction(1, 5), Fraction(1), max_denominator=5)
PEAK = st.sampled_from(["1/20", "1/10", "3/20"])
TERMS = ["u**2", "u**3", "sin(u)**2", "u**2*exp(u)", "log(1 + u**2)", "u**2/(2 + u)", "atan(u)**3", "cosh(u) - 1"]
MASSES = {
    "1 + u**2": "u",
    "2 + u": "1/2",
    "exp(u)": "exp(u)/2",
    "cosh(u)": "sinh(u)/2",
    "1 - u**2/2 + u**3": "3*u**2/2 - u/2",
}


def integrated(equation: str, peak: float) -> tuple[float, float]:
    """Frequency and trough of the motion from rest at a peak to the next one, integrated to 1e-13."""
    force = sympy.lambdify((U, V), as_oscillator(equation).substituted_force, "math")

    def turned(_: float, y: np.ndarray) -> float:
        return float(y[1])

    run = solve_ivp(
        lambda _, y: (y[1], -force(y[0], y[1])), (0, 25), (peak, 0.0), "DOP853", events=turned, rtol=1e-13, atol=1e-15
    )
    times, places = run.t_events[0], run.y_events[0][:, 0]
    period = float(times[(times > 0.5) & (places > 0)][0])
    return 2 * math.pi / period, float(places[places < 0][0])


def check_orbit(equation: str, peak: str) -> None:
    exact, size = exact_frequency(equation, peak, bits=64), float(Fraction(peak))
    omega, trough = integrated(equation, size)
    assert float(exact.middle) == pytest.approx(omega, rel=1e-10)
    assert float(exact.trough.mid()) == pytest.approx(trough, rel=1e-9)
    assert float(lindstedt(equation, 8)(size)) == pytest.approx(omega, rel=1e-4)


@settings(max_examples=5, deadline=None)
@given(one=st.sampled_from(TERMS), other=st.sampled_from(TERMS), a=SMALL, b=SMALL, peak=PEAK)
def test_asymmetric_forces(one: str, other: str, a: Fraction, b: Fraction, peak: str) -> None:
    check_orbit(f"u'' + u + ({a})*({one}) + ({b})*({other}) = 0", peak)


@settings(max_examples=5, deadline=None)
@given(mass=st.sampled_from(sorted(MASSES)), a=SMALL, b=SMALL, peak=PEAK)
def test_masses_that_depend_on_the_place(mass: str, a: Fraction, b: Fraction, peak: str) -> None:
    """M u'' + M' u'^2/2 + V' = 0, from the energy M u'^2/2 + V."""
    check_orbit(f"({mass})*u'' + ({MASSES[mass]})*u'**2 + u + ({a})*u**2 + ({b})*u**3 = 0", peak)


@settings(max_examples=3, deadline=None)
@given(eps=SOME, b=SOME, c=SMALL, d=SMALL, hard=st.sampled_from(["u**3/4", "sinh(u) - u", "u - sin(u)"]))
def test_self_excited_oscillators(eps: Fraction, b: Fraction, c: Fraction, d: Fraction, hard: str) -> None:
    equation = f"u'' - ({eps})*(1 - ({b})*u**2 + ({c})*u)*u' + u + ({d})*u**2/3 + {hard} = 0"
    found = limit_cycles(equation, bits=64)
    assert isinstance(found[0], Cycle)  # the innermost, that of the balance of losses
    for cycle in (one for one in found if isinstance(one, Cycle)):
        omega, trough = integrated(equation, float(cycle.peak.mid()))
        assert float(cycle.omega) == pytest.approx(omega, rel=1e-8)
        assert float(cycle.trough.mid()) == pytest.approx(trough, rel=1e-7)


def test_a_force_beyond_floats_at_large_amplitudes_is_no_obstacle() -> None:
    """The scan for the amplitude meets infinities of both signs there."""
    equation = "u'' - (u' - 2*u'**3/5)/7 + u + 3*u**3/5 + 2*(sinh(u) - u)/5 = 0"
    (cycle,) = limit_cycles(equation, bits=64)
    assert isinstance(cycle, Cycle)
    assert float(cycle.omega) == pytest.approx(integrated(equation, float(cycle.peak.mid()))[0], rel=1e-8)
