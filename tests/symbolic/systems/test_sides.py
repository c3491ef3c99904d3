"""Where a force begins on each side of rest, beside differentiation."""

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.grammar.kinks import U
from ridgeback.symbolic.systems.sides import halves

K = sympy.Symbol("k", positive=True)
TERMS = st.sampled_from(
    [sympy.sin(K * U), sympy.tanh(U), sympy.exp(U) - 1, U * abs(U), sympy.log(1 + U), U**3 / (1 + K * U), abs(U)]
)


def by_differentiating(force, side):
    """The first nonzero derivative on one side of 0, as Taylor's formula has it."""
    slope = side * force.subs(abs(U), side * U).subs(U, side * U)
    for n in range(8):
        value = sympy.simplify(slope.subs(U, 0) / sympy.factorial(n))
        if value != 0:
            return n, value
        slope = slope.diff(U)
    return None


@given(first=TERMS, second=TERMS, weight=st.sampled_from([1, -1, 2]))
def test_the_first_term_is_the_first_nonzero_derivative(first, second, weight):
    force = first * second + weight * U
    for side, found in zip((1, -1), halves(force), strict=True):
        power, coefficient = by_differentiating(force, side)
        assert (found.power, sympy.simplify(found.coefficient - coefficient)) == (power, 0)


def test_a_tower_of_functions_costs_no_more_than_its_nodes():
    force = U - sympy.tanh(sympy.atanh(U**2) ** 7)  # differentiated term by term, this took 98 s
    assert [(side.power, side.coefficient) for side in halves(force)] == [(1, 1), (1, 1)]
    # tanh(x)^7 cancels to the order of u: the first term that is left is that of u^14
    vanishing = sympy.tanh(sympy.atanh(U**2) ** 7) + U**15
    assert [(side.power, side.sign) for side in halves(vanishing)] == [(14, 1), (14, -1)]


@pytest.mark.parametrize(
    "wrong", [sympy.atanh(sympy.atanh(sympy.sign(U))), sympy.log(sympy.sign(U)), 1 / (1 - sympy.sign(U))]
)
def test_a_side_that_is_not_finite_and_real_is_refused(wrong):
    with pytest.raises(InputError, match="not finite and real"):
        halves(U + wrong)


def test_a_side_with_a_derivative_that_is_not_real_is_refused():
    with pytest.raises(InputError, match="no real number"):
        halves(U + sympy.asin(10 * sympy.sign(U)))
