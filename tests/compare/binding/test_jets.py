"""Taylor recurrences against mpmath's numerical derivatives, known solutions and the equation itself."""

import math

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS
from ridgeback.compare.binding.closures import ARRAY, PRECISE, SCALAR
from ridgeback.compare.binding.taylor_jet import force_jet
from ridgeback.symbolic.arithmetic.ball_ring import REAL_BALLS, at_bits, midpoint
from ridgeback.symbolic.arithmetic.balls import ball
from ridgeback.symbolic.arithmetic.closures import evaluator
from ridgeback.symbolic.arithmetic.expression_series import Program
from ridgeback.symbolic.systems.oscillator import U, V

FUNCTIONS = [
    sympy.sin(U),
    sympy.cos(2 * U),
    sympy.tan(U),
    sympy.sinh(U),
    sympy.cosh(U),
    sympy.tanh(U),
    sympy.exp(-U),
    sympy.log(1 + U),
    sympy.asin(U),
    sympy.acos(U / 2),
    sympy.atan(U),
    sympy.asinh(U),
    sympy.atanh(U),
    sympy.sqrt(1 + U),
    (1 + U) ** sympy.Rational(-5, 3),
    1 / (2 - U),
    U**7,
    U / (1 + U**2),
    sympy.sin(U) * sympy.cos(U) + sympy.exp(sympy.sin(U)),
    (1 + U) ** (U + 1),
    sympy.pi * U,
    sympy.sqrt(2) * U * sympy.sin(sympy.pi * U) / 3,
    U ** sympy.Rational(7, 2) + sympy.acosh(1 + U),
]


def composed(expression, series, *, ring=REAL_BALLS):
    """Coefficients of the expression with a power series in the place of u."""
    if ring is not REAL_BALLS:
        root = Program(expression, ring, {U: series}, U, V).root
        return [root.get(n) for n in range(len(series))]
    with at_bits(mpmath.mp.prec):
        root = Program(expression, ring, {U: [ball(c) for c in series]}, U, V).root
        return [mpmath.mpf(midpoint(root.get(n))) for n in range(len(series))]


@pytest.mark.parametrize("expression", FUNCTIONS, ids=str)
def test_every_recurrence_agrees_with_derivatives_taken_numerically(expression):
    with mpmath.workdps(40):
        function = evaluator(expression, (U,), PRECISE)
        expected = mpmath.taylor(lambda x: function((x,)), mpmath.mpf("0.3"), 8)
        found = composed(expression, [mpmath.mpf("0.3"), mpmath.mpf(1)] + [mpmath.mpf(0)] * 7)
    assert all(abs(a - b) < mpmath.mpf(10) ** -15 * (1 + abs(a)) for a, b in zip(expected, found, strict=True))


@pytest.mark.parametrize("expression", FUNCTIONS, ids=str)
def test_floats_and_multiple_precision_follow_the_same_recurrences(expression):
    with mpmath.workdps(30):
        precise = composed(expression, [mpmath.mpf("0.3"), mpmath.mpf(1)] + [mpmath.mpf(0)] * 7)
    floats = composed(expression, [0.3, 1.0] + [0.0] * 7, ring=FLOATS)
    np.testing.assert_allclose(floats, [float(c) for c in precise], rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("expression", FUNCTIONS, ids=str)
def test_the_three_arithmetics_agree(expression):
    points = np.array([0.1, 0.3, 0.45])
    arrays = evaluator(expression, (U,), ARRAY)((points,))
    precise = evaluator(expression, (U,), PRECISE)
    scalar = evaluator(expression, (U,), SCALAR)
    np.testing.assert_allclose(arrays, [scalar((x,)) for x in points], rtol=1e-14)
    np.testing.assert_allclose(arrays, [float(precise((mpmath.mpf(x),))) for x in points], rtol=1e-14)


def test_the_linear_oscillator_gives_the_cosine():
    jet = force_jet(4 * U)(1, 0, 20)
    for n, coefficient in enumerate(jet):
        expected = 0 if n % 2 else (-4) ** (n // 2) / math.factorial(n)
        assert coefficient == pytest.approx(expected, rel=1e-14, abs=0)


def test_the_soliton_like_solution_of_the_pendulum_separatrix():
    """u = 4 arctan(exp t) - pi, with u(0) = 0 and u'(0) = 2, solves u'' + sin u = 0 on the separatrix."""
    with mpmath.workdps(30):
        expected = mpmath.taylor(lambda t: 4 * mpmath.atan(mpmath.exp(t)) - mpmath.pi, 0, 12)
        found = force_jet(sympy.sin(U))(0, 2, 12)
    assert max(abs(a - b) for a, b in zip(expected, found, strict=True)) < mpmath.mpf(10) ** -14


@settings(deadline=None, max_examples=20)
@given(u0=st.floats(-2, 2), v0=st.floats(-2, 2), mu=st.floats(0, 0.5))
def test_the_jet_satisfies_its_equation(u0, v0, mu):
    """Substituting the polynomial back leaves a remainder of the order of the first neglected power."""
    damping = sympy.Rational(str(round(mu, 3)))
    force = sympy.sin(U) + 2 * damping * V + U**2 * V / 10
    function = evaluator(force, (U, V), PRECISE)
    with mpmath.workdps(50):
        jet = force_jet(force)(u0, v0, 24)

        def residual(t):
            u, slope, curvature = (mpmath.polyval(c, t) for c in _derivatives(jet))
            return abs(curvature + function((u, slope)))

        large, small = residual(mpmath.mpf("0.02")), residual(mpmath.mpf("0.01"))
    assert large < mpmath.mpf(10) ** -25
    assert small <= large / 2**20 or large < mpmath.mpf(10) ** -40


def _derivatives(jet):
    first = [n * c for n, c in enumerate(jet)][1:]
    second = [n * c for n, c in enumerate(first)][1:]
    return [list(reversed(c)) for c in (jet, first, second)]


def test_precision_follows_mpmath():
    with mpmath.workdps(60):
        jet = force_jet(sympy.Rational("0.1") * U)(1, 0, 2)
        assert abs(jet[2] + mpmath.mpf(1) / 20) < mpmath.mpf(10) ** -58


def test_what_cannot_be_expanded_is_named():
    with pytest.raises(InputError, match="Abs"):
        force_jet(U + abs(U))
    with pytest.raises(InputError, match="not analytic"):
        composed(1 / U, [mpmath.mpf(0), mpmath.mpf(1)])
    with pytest.raises(InputError, match="give the parameter a number"):
        evaluator(U + sympy.Symbol("q"), (U,), SCALAR)
