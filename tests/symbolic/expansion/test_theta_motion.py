"""Motions read off theta series are those of Lindstedt's recursion, coefficient by coefficient."""

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.lindstedt import FROM, conservative_recursion, in_closed_form, lindstedt
from ridgeback.symbolic.expansion.theta_motion import theta_motion, waveform
from ridgeback.symbolic.series.spaces import space_for
from ridgeback.symbolic.systems.any_form import as_oscillator
from ridgeback.symbolic.systems.oscillator import U

numbers = st.fractions(-5, 5, max_denominator=9).filter(bool)


@settings(deadline=None, max_examples=15)
@given(numbers, st.booleans(), st.integers(0, 14))
def test_every_force_has_the_motion_of_the_recursion(value: sympy.Rational, sine: bool, order: int) -> None:
    c = sympy.Rational(value.numerator, value.denominator)
    force = sympy.sin(abs(c) * U) / abs(c) if sine else U + c * U**3
    motion, slow = theta_motion(force, order // 2 + 2), recursion(f"u'' + {force} = 0", order)
    assert motion.omega[: order // 2 + 1] == slow.omega[::2]
    assert waveform(motion, space_for(()), order + 1) == slow.u


@pytest.mark.parametrize("equation", ["u'' + 9*sin(u/2) = 0", "u'' + 2*u - u**3/3 = 0"])
@pytest.mark.parametrize("order", [FROM, FROM + 1])
def test_long_series_are_those_of_the_recursion(equation: str, order: int) -> None:
    assert in_closed_form(as_oscillator(equation), order, "peak")
    found, slow = lindstedt(equation, order), recursion(equation, order)
    assert found.coefficients == tuple(slow.omega)
    assert found.waveform == tuple(slow.u)
    assert found.residual() == []


@pytest.mark.parametrize(
    ("equation", "amplitude"),
    [
        ("u'' + u + u**2 = 0", "peak"),
        ("u'' + u + c*u**3 = 0", "peak"),
        ("u'' + sin(u) + u**3 = 0", "peak"),
        ("u'' + u = 0", "peak"),
        ("u'' + sin(u) = 0", "fundamental"),
    ],
)
def test_all_others_go_the_long_way(equation: str, amplitude: str) -> None:
    assert not in_closed_form(as_oscillator(equation), 200, amplitude)


def test_a_force_without_theta_series_is_refused() -> None:
    with pytest.raises(InputError, match="no theta series"):
        theta_motion(2 * U + U**3, 4)


def recursion(equation: str, order: int):  # type: ignore[no-untyped-def]
    """Order by order, in rationals."""
    found = conservative_recursion(as_oscillator(equation), order, "peak", space_for((), order + 1))
    assert all(isinstance(c, fmpq) for c in found.omega)
    return found
