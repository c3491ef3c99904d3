"""Amplitude equations beside those of the catalogue: symbols, irrational stiffness, boxes that cannot shrink."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import cast

import pytest
import sympy
from flint import arb, fmpq

from ridgeback.symbolic.flow.fixed_points import _tightened, cycle_series, fixed_points
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import HIGHEST_POWER, _dimension
from ridgeback.symbolic.flow.reach import _changes, reach_of
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.systems.oscillator import Oscillator, V


def test_an_irrational_stiffness_only_scales_time() -> None:
    """With tau = sqrt(2) t, u'' - m (1 - u^2) u' + 2u = 0 is the equation of stiffness 1 with m/sqrt(2)."""
    own, plain = (
        multiple_scales(Oscillator.from_equation(f"u'' - m*(1 - u**2)*u' + {k}*u = 0", parameters={"m": None}), 6)
        for k in (2, 1)
    )
    here, there = fixed_points(own, {"m": "1/10"})[0], fixed_points(plain, {"m": math.sqrt(2) / 20})[0]
    assert float(here.amplitude) == pytest.approx(float(there.amplitude), abs=1e-13)
    assert float(here.frequency) == pytest.approx(math.sqrt(2) * float(there.frequency), abs=1e-13)
    assert here.stable is there.stable is True


def test_the_reach_of_an_order_is_the_same_in_every_unit_of_time() -> None:
    """With tau = 3 t."""
    rows = ("u'' - m*(1 - u**2)*u' + u + u**3/2", "u'' - 3*m*(1 - u**2)*u' + 9*u + 9*u**3/2")
    changes = []
    for row in rows:
        flow = multiple_scales(Oscillator.from_equation(row, parameters={"m": None}), 4)
        changes.append(reach_of(flow, float(fixed_points(flow, {"m": "1/10"})[0].amplitude), (0.1,)).change)
    assert changes[0] == pytest.approx(changes[1], rel=1e-12)


@pytest.mark.parametrize("bend", [0, 2])
def test_what_a_term_changes_is_how_far_it_moves_the_fixed_point(bend: int) -> None:
    """a'/a = m (1 - a^2/4)/2 + m a^4/10^6, phi' = 3 + bend a^2: a or phi', whichever moves farther, relatively."""
    m, growth = sympy.Rational(1, 10), [sympy.Rational(1, 2), sympy.Rational(-1, 8), sympy.Rational(1, 10**6)]
    flow = SimpleNamespace(
        frequency=(Term((0, 0), sympy.Integer(3)), Term((2, 0), sympy.Integer(bend))),
        growth_rate=tuple(Term((2 * n, 1), c) for n, c in enumerate(growth)),
        weights={"m": 2},
        highest=None,
    )
    square = sympy.Symbol("s")
    far = min(r for r in sympy.Poly(sum(c * square**n for n, c in enumerate(growth)), square).nroots(30) if r > 0)
    moved = abs(sympy.sqrt(far) / 2 - 1), abs((3 + bend * far) / (3 + bend * 4) - 1)
    changes = _changes(cast("SlowFlow", flow), float(sympy.sqrt(far)), (float(m),))
    assert changes[-1] == pytest.approx(float(max(moved)), rel=1e-3)
    elsewhere = _changes(cast("SlowFlow", flow), 1.0, (float(m),))  # no fixed point: what it adds to a'/a, per radian
    assert elsewhere[-1] == pytest.approx(float(m * growth[2]) / (3 + bend), rel=1e-12)


def test_a_symbol_in_the_amplitude_equation_leaves_it_without_an_exact_series() -> None:
    flow = multiple_scales(
        Oscillator.from_equation("u'' - m*(1 - u**2)*u' + u + c*u**3 = 0", parameters={"m": None, "c": None}), 4
    )
    assert cycle_series(flow) == ()


def test_a_box_round_a_double_zero_stays_as_it_is() -> None:
    box = arb(0, 1)
    assert _tightened({(2, 0): fmpq(1)}, box, fmpq(0)) is box


def test_a_loss_beyond_every_power_counts_as_a_force() -> None:
    c = sympy.Symbol("c", real=True)
    assert [_dimension(c * V**n, c) for n in (0, 1, 3, HIGHEST_POWER + 1)] == [2, 1, -1, 2]
