"""Orbits that close by (u, t) -> (-u, -t), and conversions between amplitude definitions over all symmetry classes."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.phase import of_first_harmonic, turning
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

CENTRE = Oscillator.from_equation("u'' + u*u' + u = 0", name="centre")
ORDER = 6

# Powers (i, j) of u^i u'^j by the symmetry that they keep: under t -> -t (j even), under (u, t) -> (-u, -t) (i odd).
Terms = dict[tuple[int, int], object]
CLASSES = {
    "symmetric potential": ((3, 0), (5, 0)),
    "asymmetric potential": ((2, 0), (3, 0), (4, 0)),
    "position-dependent mass": ((2, 0), (0, 2), (1, 2), (3, 0)),
    "reversible centre": ((1, 1), (3, 0), (1, 2), (1, 3), (3, 1)),
    "both symmetries": ((3, 0), (1, 2), (1, 4)),
}


@st.composite
def forces(draw: st.DrawFn) -> Terms:
    coefficient = st.fractions(-2, 2, max_denominator=3)
    return {powers: draw(coefficient) for powers in CLASSES[draw(st.sampled_from(sorted(CLASSES)))]}


def oscillator(terms: Terms, *, mirrored: bool = False) -> Oscillator:
    """u'' + u + terms; of -u when mirrored."""
    force = [f"{'-1*' * (mirrored and (i + j) % 2 == 0)}({c})*u**{i}*u'**{j}" for (i, j), c in terms.items()]
    return Oscillator.from_equation("u'' + u + " + " + ".join(force).replace("+ -", "- ") + " = 0", name="drawn")


def same(first: Expansion, second: Expansion) -> bool:
    return first.coefficients == second.coefficients and first.waveform == second.waveform


def test_the_centre_has_equal_turning_points() -> None:
    expected = (1, 0, -sympy.Rational(1, 24), 0, sympy.Rational(1, 768))
    assert lindstedt(CENTRE, 4).frequency == lindstedt(CENTRE, 4, amplitude="trough").frequency == expected


def test_the_centre_in_its_first_harmonic() -> None:
    expected = (1, 0, -sympy.Rational(1, 24), 0, -sympy.Rational(5, 6912))
    assert lindstedt(CENTRE, 4, amplitude="fundamental").frequency == expected
    assert lindstedt(CENTRE, 4).convert("fundamental").frequency == expected
    flow = multiple_scales(CENTRE, 4)
    assert [term.coefficient for term in flow.frequency] == [c for c in expected if c]
    assert not flow.growth_rate


def test_the_lower_turning_point_is_not_half_a_period_after_the_upper_one() -> None:
    waveform = lindstedt(CENTRE, 4).waveform
    assert waveform is not None
    assert turning(waveform, 0)[0] == [0] * 5
    assert turning(waveform, 1)[0][1] != 0


@pytest.mark.parametrize("amplitude", ["peak", "trough", "fundamental"])
def test_every_check_that_applies_holds_of_the_centre(amplitude: str) -> None:
    checks = {check.name: check.passed for check in certify(CENTRE, lindstedt(CENTRE, 6, amplitude=amplitude))}
    assert checks == {"residual": True, "normalisation": True, "energy integral": None, "multiple scales": True}


def test_the_normalisation_check_tests_the_turning_point_that_it_names() -> None:
    def passed(own: Oscillator, result: Expansion) -> bool | None:
        return next(check.passed for check in certify(own, result) if check.name == "normalisation")

    peak, asymmetric = lindstedt(CENTRE, 4), find("helmholtz-duffing")
    assert passed(CENTRE, replace(peak, amplitude="fundamental")) is False
    assert passed(CENTRE, replace(lindstedt(CENTRE, 4, amplitude="fundamental"), amplitude="peak")) is False
    assert passed(asymmetric, replace(lindstedt(asymmetric, 4), amplitude="trough")) is False


@pytest.mark.parametrize(
    ("equation", "kind"),
    [
        ("u'' + u*u' + u = 0", "reversible"),
        ("u'' + 3*u*u' + u**3 + u = 0", "reversible"),
        ("u'' + b*u*u' + u = 0", "reversible"),
        ("u'' + u**2*u' + u = 0", "damped"),
        ("u'' + u*u'**2 + u = 0", "conservative"),
        ("u'' + 2*mu*u' + b*u*u' + u = 0", "damped"),
    ],
)
def test_a_reversible_centre_has_its_own_kind(equation: str, kind: str) -> None:
    assert Oscillator.from_equation(equation).kind == kind


@pytest.mark.parametrize("equation", ["u'' + u*u' + u = 0", "u'' + 3*u*u' + u**3 + u = 0", "u'' + b*u*u' + u**3 + u"])
def test_no_potential_is_claimed_where_it_does_not_set_the_orbits(equation: str) -> None:
    own = Oscillator.from_equation(equation)
    assert own.potential is None
    assert "neither dissipates nor comes from a potential" in own.potential_note
    if "b" in own.parameters:
        assert own.with_parameters({"b": 0}).substituted_potential is not None


def test_damping_that_also_takes_and_gives_keeps_the_potential_of_its_undamped_motion() -> None:
    assert Oscillator.from_equation("u'' + c*(1 + u)*u' + u + u**3 = 0").potential is not None


def test_the_isochronous_lienard_oscillator_keeps_its_frequency() -> None:
    """u'' + 3 u u' + u^3 + u = 0 has the frequency 1 at every amplitude (Chandrasekar et al. 2005)."""
    own = Oscillator.from_equation("u'' + 3*u*u' + u**3 + u = 0")
    assert lindstedt(own, 10).frequency == (1, *[0] * 10)


@settings(max_examples=12)
@given(forces())
def test_conversions_agree_with_direct_derivations(terms: Terms) -> None:
    own = oscillator(terms)
    peak, fundamental = (lindstedt(own, ORDER, amplitude=name) for name in ("peak", "fundamental"))
    assert same(peak.convert("fundamental"), fundamental)
    assert same(fundamental.convert("peak"), peak)
    assert peak.residual() == fundamental.residual() == []


@settings(max_examples=12)
@given(forces())
def test_the_trough_is_the_peak_of_the_mirrored_oscillator(terms: Terms) -> None:
    own = oscillator(terms)
    trough = lindstedt(own, ORDER, amplitude="trough")
    assert trough.coefficients == lindstedt(oscillator(terms, mirrored=True), ORDER).coefficients
    assert trough.residual() == []
    if own.is_reversible:
        assert trough.coefficients == lindstedt(own, ORDER).coefficients
    assert same(trough.convert("fundamental"), lindstedt(own, ORDER, amplitude="fundamental"))


@settings(max_examples=8)
@given(forces())
def test_a_phase_is_found_and_taken_away(terms: Terms) -> None:
    own = oscillator(terms)
    waveform = lindstedt(own, ORDER, amplitude="fundamental").waveform
    assert waveform is not None
    assert not any(of_first_harmonic(waveform)[0])
    phase, place = turning(waveform, 0)
    again = lindstedt(own, ORDER, amplitude="fundamental").convert("peak").waveform
    assert again is not None
    assert turning(again, 0)[1] == [0, 1, *[0] * ORDER]
    assert len(phase) == len(place) - 1
