"""The exact side of a report: printed terms against published coefficients, certificates that can fail."""

from dataclasses import replace

import pytest
import sympy
from flint import fmpq

from ridgeback.compare.study.derivation import certificate, derivation
from ridgeback.compare.study.derived import derive
from ridgeback.symbolic.flow.ordering import undamped
from ridgeback.symbolic.systems.catalogue import catalogue, find

CLASSICAL = 12  # of the catalogue: the classical oscillators and their damped twins


def test_the_published_pendulum_series_is_printed_term_by_term():
    exact = derive(find("damped-pendulum").with_parameters({"k": "12.566370614359172", "mu": "0.01"}), 8)
    formula = derivation(exact).formulas[0]
    assert formula.left == r"\frac{\omega_0(A)}{k}"
    assert formula.terms == (
        "1",
        r"- \frac{A^{2}}{16}",
        r"\frac{A^{4}}{3072}",
        r"- \frac{23 A^{6}}{737280}",
        r"- \frac{2519 A^{8}}{1321205760}",
    )


def test_the_limit_cycle_prints_its_amplitude_series():
    formulas = {f.left: f.terms for f in derivation(derive(find("van-der-pol"), 4)).formulas}
    assert formulas[r"A(\varepsilon)"] == (
        "2",
        r"\frac{\varepsilon^{2}}{96}",
        r"- \frac{1033 \varepsilon^{4}}{552960}",
    )


@pytest.mark.parametrize("oscillator", catalogue()[:CLASSICAL], ids=lambda o: o.name)
def test_every_catalogue_oscillator_is_certified(oscillator):
    checks = certificate(derive(oscillator, 4))
    assert any(check.passed for check in checks)
    assert not any(check.passed is False for check in checks)


def test_a_wrong_coefficient_fails_every_check():
    exact = derive(find("pendulum"), 4)
    wrong = (*exact.expansion.coefficients[:4], exact.expansion.coefficients[4] + fmpq(1, 10**6))
    checks = certificate(replace(exact, expansion=replace(exact.expansion, coefficients=wrong)))
    assert sum(check.passed is False for check in checks) == 3
    assert len(checks) > 4


def test_undamping_sets_only_the_damping():
    bound = undamped(find("damped-pendulum").with_parameters({"k": 3, "mu": "0.2"}))
    assert bound.parameters["k"] == 3
    assert bound.parameters["mu"] == 0
    assert bound.natural_frequency == sympy.Integer(3)
