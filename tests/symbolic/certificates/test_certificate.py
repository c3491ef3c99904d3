"""A certificate passes what is right, notices what is wrong, and says what does not apply."""

from dataclasses import replace

import pytest
from flint import fmpq

from ridgeback.symbolic.certificates.certificate import certify
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.series.trigonometric import cosine
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("name", ["pendulum", "duffing-softening", "helmholtz-duffing", "linear"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental", "action"])
def test_every_check_passes_for_conservative_oscillators(name: str, amplitude: str) -> None:
    checks = certify(find(name), lindstedt(find(name), 7, amplitude=amplitude))
    assert [c.passed for c in checks] == [True] * 4


@pytest.mark.parametrize("name", ["van-der-pol", "rayleigh"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_limit_cycles(name: str, amplitude: str) -> None:
    assert [c.passed for c in certify(find(name), lindstedt(find(name), 6, amplitude=amplitude))] == [True, True]


def test_slow_flows_and_the_energy_integral() -> None:
    damped = find("damped-helmholtz-duffing")
    assert [c.passed for c in certify(damped, multiple_scales(damped, 6))] == [True, True]
    assert [c.passed for c in certify(find("pendulum"), energy_integral(find("pendulum"), 6))] == [True]


def test_what_does_not_apply_is_said() -> None:
    own = Oscillator.from_equation("u'' + u + u*u'**2")
    found = {c.name: c for c in certify(own, lindstedt(own, 4))}
    assert found["residual"].passed
    assert found["energy integral"].passed is None
    assert "u'" in found["energy integral"].statement


def test_the_number_of_coefficients_that_agree_is_said() -> None:
    said = {c.name: c.statement for c in certify(find("pendulum"), lindstedt(find("pendulum"), 6))}
    assert "the same 7 coefficients (peak amplitude)" in said["energy integral"]


def test_a_wrong_frequency_fails_every_check_that_can_see_it() -> None:
    good = lindstedt(find("pendulum"), 6)
    wrong = replace(good, coefficients=(*good.coefficients[:-1], good.coefficients[-1] + fmpq(1, 10**6)))
    failed = {c.name for c in certify(find("pendulum"), wrong) if c.passed is False}
    assert failed == {"residual", "energy integral", "multiple scales"}


def test_a_wrong_homogeneous_term_passes_the_residual_but_not_the_normalisation() -> None:
    good = lindstedt(find("pendulum"), 6)
    assert good.waveform is not None
    shifted = (*good.waveform[:-1], good.waveform[-1] + cosine(good.waveform[-1].space))
    checks = {c.name: c.passed for c in certify(find("pendulum"), replace(good, waveform=shifted))}
    assert checks["residual"] is True
    assert checks["normalisation"] is False
