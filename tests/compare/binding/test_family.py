"""A symbolic oscillator with free parameters as functions of floats."""

from __future__ import annotations

import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.family import family_of
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


def test_partials_are_derivatives_and_agree_with_the_bound_oscillator() -> None:
    own = Oscillator.from_equation("x'' + 2*c*x' + a*sin(x) + b*x**3*x'**2 = 0", parameters={"c": "0.1"})
    made = family_of(own, ("a", "b"))
    assert made.start.tolist() == [1.0, 1.0]
    p, (u, v), step = (2.0, 0.3), (0.7, -0.4), 1e-6
    partials = made.partials(u, v, p)
    arguments = np.array([u, v, *p])
    for j, value in enumerate(partials):
        shift = step * np.eye(4)[j]
        ends = [made.force(a[0], a[1], a[2:]) for a in (arguments + shift, arguments - shift)]
        assert value == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-7)
    assert made.force(u, v, p) == pytest.approx(made.dynamics(p).force(u, v), rel=1e-15)
    grid = np.linspace(-1, 1, 5)
    assert made.forces(grid, 0 * grid, p).tolist() == pytest.approx([made.force(x, 0.0, p) for x in grid])


@pytest.mark.parametrize(
    ("free", "message"),
    [(("k", "g"), "no parameter g to be freed; it has"), ((), "name each"), (("k", "k"), "name each")],
)
def test_refusals(free: tuple[str, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        family_of(find("pendulum"), free)


def test_what_is_neither_free_nor_set_is_named() -> None:
    own = Oscillator.from_equation("x'' + x + b*x**3 + c*x**5 = 0")
    with pytest.raises(InputError, match="parameter c has no number"):
        family_of(own, ("b",))


def test_a_force_that_jumps_has_no_derivative_and_one_with_a_kink_has() -> None:
    for name in ("coulomb-damping", "bilinear-stops"):
        with pytest.raises(InputError, match="may jump or have no derivative"):
            family_of(find(name), tuple(find(name).parameters)[:1])
    own = Oscillator.from_equation("u'' + u + c*max(u - 1, 0) = 0", parameters={"c": 3})
    assert family_of(own, ("c",)).partials(2.0, 0.0, (3.0,)) == (4.0, 0.0, 1.0)
