"""Small functions of the symbolic room where their arguments come to an end: values known beforehand, or a refusal."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import mpmath
import pytest
import sympy
from flint import acb, arb, arb_poly, ctx, fmpq, fmpq_poly

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball
from ridgeback.symbolic.arithmetic.rendering import as_sympy
from ridgeback.symbolic.arithmetic.roots import Root, root_ball
from ridgeback.symbolic.certificates.at_amplitudes import Refused
from ridgeback.symbolic.certificates.at_cycles import _held
from ridgeback.symbolic.codegen import form_of, generate
from ridgeback.symbolic.codegen import number as codegen_number
from ridgeback.symbolic.codegen.evaluation import fused, single, value_at
from ridgeback.symbolic.codegen.expressions import valued
from ridgeback.symbolic.codegen.fit.remez import _peak
from ridgeback.symbolic.codegen.fit.truncation import _in_step, bits_of
from ridgeback.symbolic.codegen.formulas.closed_forms import MOST_TERMS, mean_steps, sine_series
from ridgeback.symbolic.codegen.number import FLOAT64, Number, rounded
from ridgeback.symbolic.codegen.program import Steps
from ridgeback.symbolic.codegen.proofs.analysis import half_spacing
from ridgeback.symbolic.cycles import passage, search, taylor_step
from ridgeback.symbolic.cycles.averaged import averaged_loss
from ridgeback.symbolic.enclosure import analytic_strip, quadrature, separatrix, turning_points, walk
from ridgeback.symbolic.enclosure.walk import UndecidedError
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.high_order.checkpoint import ball_from
from ridgeback.symbolic.high_order.in_balls import _replay
from ridgeback.symbolic.resummation.elliptic_nome import PendulumMeans
from ridgeback.symbolic.resummation.pade import simplest
from ridgeback.symbolic.series.harmonic_basis import Balls
from ridgeback.symbolic.series.spaces import space_for
from ridgeback.symbolic.singularities.darboux import Estimate, Point
from ridgeback.symbolic.singularities.dlog_pade import dlog_singularities
from ridgeback.symbolic.singularities.settled import settled_limits
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.from_sympy import equation_text
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V

TWO_PI = 2 * math.pi
T = sympy.Symbol("t")
X = sympy.Function("x")(T)
ONE = sympy.sin(1) ** 2 + sympy.cos(1) ** 2
"""1, which no precision decides."""


def of(equation: str, *free: str) -> Oscillator:
    return Oscillator.from_equation(equation, parameters=dict.fromkeys(free))


def in_sympy(term: sympy.Expr) -> str:
    return equation_text(sympy.Eq(X.diff(T, 2) + X + term, 0))


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (lambda: as_sympy(3), 3),
        (lambda: simplest(math.pi, 1e-15), Fraction(355, 113)),
        (lambda: fused(math.inf, 2.0, 1.0), math.inf),
        (lambda: single(-1e39), -math.inf),
        (lambda: rounded(-(Fraction(10) ** 400)), -math.inf),
        (lambda: half_spacing(arb(2) ** 2000, FLOAT64), arb("inf")),
        (lambda: Number(sympy.sqrt(2) * 10**5).decimal_exponent, 5),
        (lambda: Number(1 + sympy.Rational(1, 2**53) + sympy.pi / 2**200).nearest, 1 + 2.0**-52),
        (lambda: bits_of(None), bits_of(arb(0, 1))),
        (lambda: _peak([arb(0), arb(1), arb(2)], [arb(0), arb(1), arb(2)], 1), arb(1)),
        (lambda: averaged_loss(sympy.log(U + V), 1.0, 1.0), None),
        (lambda: of("u'' + 2*u + u*abs(u) = 0").stiffness, 2),
        (lambda: turning_points.equilibria(well_of(find("pendulum")), 64), (None, None)),
        (lambda: in_sympy(sympy.E * X**2), "exp(1)*x**2 + x + x'' = 0"),
        (lambda: in_sympy(sympy.Pow(sympy.E, X, evaluate=False)), "x + exp(x) + x'' = 0"),
        (lambda: in_sympy((1 + X) ** sympy.Rational(-1, 2)), "x + x'' + 1/(x + 1)**(1/2) = 0"),
        (lambda: search._refined(lambda _: None, 1.0, 2.0, 1.0, -1.0), 1.5),
        (lambda: space_for(()).assemble([fmpq(1), fmpq(2)]), fmpq_poly([1, 2])),
        (lambda: Balls(4).at_one(Balls(4).assemble([arb(1), arb(2)])), arb(3)),
        (lambda: Balls(4).length(Balls(4).assemble([arb(1), arb(2)])), 2),
        (lambda: dlog_singularities([fmpq(1), fmpq(1), *[fmpq(0)] * 6], ONE_PLACE), None),
        (lambda: energy_integral(find("pendulum"), 4)(mpmath.mpf(1)), mpmath.mpf(2881) / 3072),
    ],
)
def test_values_known_beforehand(value: Callable[[], Any], expected: object) -> None:
    assert value() == expected


ONE_PLACE = Estimate((Point(acb(2), acb(0.5)),), 0.0, 0.0, 2)


@pytest.mark.parametrize(
    ("call", "error", "said"),
    [
        (lambda: ball_from("1,0,3fffffffff,-40"), ValueError, "is not one of FLINT's"),
        (lambda: _replay([], SimpleNamespace(tapes=(1,))), InputError, "has 1 products, this recursion 0"),
        (lambda: sine_series(find("pendulum"), 0), InputError, f"0 terms are not within 1..{MOST_TERMS}"),
        (lambda: mean_steps(PendulumMeans(Fraction(1)), 3.5, 53), InputError, "may end before 3.5"),
        (lambda: _in_step([arb(1), arb(1)], 1, 2), InputError, "odd powers of the amplitude meets an even potential"),
        (
            lambda: valued(Steps(FLOAT64), sympy.log(sympy.Symbol("c")), {"c": "c"}),
            InputError,
            "no code is written for",
        ),
        (lambda: space_for(()).gen("c"), KeyError, "c"),
        (lambda: Balls(4).gen("c"), KeyError, "c"),
        (lambda: Balls(4).shift(arb_poly([1])), TypeError, "has no powers of y"),
        (lambda: Balls(4).derivative(arb_poly([1])), TypeError, "has no powers of y"),
        (lambda: Balls(4).paired(arb_poly([1]), [1], 1), TypeError, "the basis has its own rules"),
        (lambda: Balls(4).solve_part(arb_poly([1]), odd=0, shift=0), TypeError, "the basis has its own rules"),
    ],
)
def test_what_has_no_value_is_refused(call: Callable[[], object], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        call()


def linear(slope: float, shift: float = 0.0, width: float = 0.0) -> Callable[[arb], arb]:
    return lambda x: slope * x + arb(shift, width)


@pytest.mark.parametrize(
    "call",
    [
        lambda: walk._halved(linear(1.0, width=9.0), arb(-1), arb(1)),
        lambda: walk.root(linear(1.0, 5.0), lambda _: arb(1), arb(-1), arb(1)),
        lambda: walk.level(
            lambda u: u**2 / 2, linear(1.0, -1e-3, 0.1), lambda _: arb(0, 1), arb(9), step=arb(1), last=arb(9)
        ),
        lambda: turning_points._below(arb(1, 0.5), arb(1), equal=False),
        lambda: separatrix._lower(SimpleNamespace(value=linear(0.0, width=1.0)), arb(1), arb(2)),  # type: ignore[arg-type]
        lambda: analytic_strip._without_trough(SimpleNamespace(quotient=fmpq_poly([2, 1]), trough=arb(5))),  # type: ignore[arg-type]
    ],
)
def test_balls_that_are_too_wide_decide_nothing(call: Callable[[], object]) -> None:
    with pytest.raises(UndecidedError):
        call()


def test_a_mean_that_may_vanish_gives_no_frequency(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quadrature, "_mean", lambda *_: arb(0, 1))
    with pytest.raises(UndecidedError):
        quadrature.frequency(None, None, 64)  # type: ignore[arg-type]


def test_a_number_that_no_precision_rounds_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(codegen_number, "DECIDED", 500)
    with pytest.raises(InputError, match="is not decided in 500 bits"):
        _ = Number(ONE + sympy.Rational(1, 2**53)).nearest


def test_bisections_that_are_spent_leave_the_last_place(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search, "BISECTIONS", 40)
    assert search._refined(lambda a: 2.0 - a, 1.0, 4.0, 1.0, -2.0) == pytest.approx(2.0)
    monkeypatch.setattr(search, "BISECTIONS", 1)
    assert search._refined(lambda a: 8.0 - a**3, 1.0, 4.0, 7.0, -56.0) == pytest.approx(1.0 + 3.0 / 9.0)
    monkeypatch.setattr(passage, "NEWTON_STEPS", 1)
    assert passage._zero(arb_poly([-2, 0, 1]), arb(2)).contains(arb(1.5))


def test_a_field_without_a_value_is_not_followed() -> None:
    bare = SimpleNamespace(slope_u=lambda *_: arb("nan"), slope_v=lambda *_: arb(0))
    with pytest.raises(UndecidedError):
        taylor_step._best_unit(bare, arb(1), arb(0), arb(1), 1.0)  # type: ignore[arg-type]


def test_a_cycle_that_is_refused_stays_refused() -> None:
    row = Refused(Fraction(1), "it is not there", "eps")
    assert _held(row, energy_integral(find("pendulum"), 2)) is row


def test_a_root_whose_polynomial_keeps_its_sign_is_not_enclosed(monkeypatch: pytest.MonkeyPatch) -> None:
    x = sympy.Symbol("x")
    root = Root(x**3 + x - 1, 0)
    with ctx.workprec(64):
        ball = number_ball(sympy.sqrt(root) + root)
        assert (ball - root_ball(root)) ** 2 - root_ball(root) in arb(0, 1e-15)
    assert root.to_dict() == {"name": "r", "decimal": "0.68232780382801932737", "polynomial": "r**3 + r - 1"}
    assert sympy.latex(root**2) == "r^{2}"
    monkeypatch.setattr(sympy, "N", lambda *_: sympy.Rational(3, 2))
    with pytest.raises(ArithmeticError, match="does not change sign"):
        root_ball(root)


def test_a_series_in_roots_of_the_amplitude_has_no_known_range() -> None:
    series = energy_on_each_side(of("u'' + u + sign(u)*sqrt(abs(u)) = 0"), 2)
    assert "no rule is known" in settled_limits("u'' + u = 0", series).sentence()
    assert sympy.latex(series.terms()[0]) in series.latex()
    assert series.mathml().startswith("<math")
    assert series.own_units() == {"decimal": "rad per time unit / A^power"}
    with pytest.raises(InputError, match="gives the frequency only"):
        series.harmonic_rows()


def test_a_product_of_parameters_under_a_root_is_told_factor_by_factor() -> None:
    a, b, c = sympy.symbols("a b c", real=True)
    series = energy_integral(of("u'' + a*b*u + c*u**3 = 0", "a", "b", "c"), 2)
    assert sympy.simplify(series.frequency[2] ** 2 - sympy.Rational(9, 64) * c**2 / (a * b)) == 0


def test_gaps_in_a_long_polynomial_cost_no_addition() -> None:
    """u**5 has powers of A^4 only, written in A^2: the parts of odd powers are empty."""
    series = energy_integral(of("u'' + u + u**5/7 = 0"), 48)
    for mode in ("strict", "accurate"):
        form = form_of(series, up_to=Fraction(1, 2), mode=mode)  # type: ignore[arg-type]
        for x in (0.125, 0.375, 0.5):
            exact = float(series(Fraction(x)))
            assert value_at(form, form.functions[0], (x, 1.0)) == pytest.approx(exact, rel=3e-16)


def test_coefficients_beyond_the_format_are_scaled() -> None:
    text = generate(energy_integral(of("u'' + u + 10**30*u**3 = 0"), 4), "c", real="float32")
    assert "scaled" in text
