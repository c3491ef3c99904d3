"""The elliptic nome: published coefficients, quotient of periods, observed order, convergence near the separatrix."""

from functools import cache

import mpmath
import pytest
from flint import arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.resummation.elliptic_nome import nome, nome_series, theta_3
from ridgeback.symbolic.resummation.pade import pade
from ridgeback.symbolic.resummation.resummation import Resummation, relative_error
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@cache
def expansion(name: str, order: int) -> Expansion:
    return energy_integral(find(name), order)


def pendulum(A: arb) -> arb:
    return arb(1).agm((A / 2).cos())


def duffing(A: arb) -> arb:
    return (1 + A * A).sqrt().agm((1 + A * A / 2).sqrt())


def error(form: Resummation, A: arb, exact: arb) -> float:
    with ctx.workprec(200):
        return float(form.error_against(A, exact))


def test_the_nome_series_is_the_published_one() -> None:
    # DLMF 19.5.5 prints four terms; those beyond are held by the quotient of the periods below
    assert nome_series(7) == (0, 1, 8, 84, 992, 12514, 164688, 2232200)
    assert theta_3(9) == (1, 2, 0, 0, 2, 0, 0, 0, 0, 2)


def test_the_nome_series_inverts_the_quotient_of_the_periods() -> None:
    with mpmath.workdps(40):
        m = mpmath.mpf("0.01")
        q = mpmath.exp(-mpmath.pi * mpmath.ellipk(1 - m) / mpmath.ellipk(m))
        total = sum(mpmath.mpf(int(c)) * (m / 16) ** n for n, c in enumerate(nome_series(16)))
        assert abs(total / q - 1) < 1e-28


@pytest.mark.parametrize("steps", [0, 1, 2, 3])
@pytest.mark.parametrize("order", [0, 6, 16, 33])
@pytest.mark.parametrize(("name", "exact"), [("pendulum", pendulum), ("duffing", duffing)])
def test_the_nome_form_agrees_with_the_exact_frequency_through_its_order(
    name: str, exact, order: int, steps: int
) -> None:
    form = nome(find(name), order, steps=steps)
    with ctx.workprec(4000):
        gaps = [abs(form.in_balls(A) / exact(A) - 1) for A in (arb(2) ** -20, arb(2) ** -21)]
        observed = float((gaps[0] / gaps[1]).log() / arb(2).log())
    assert observed == pytest.approx(2 ** (steps + 1) * (order // 2 ** (steps + 1) + 1), abs=1e-3)
    assert observed > order


@pytest.mark.parametrize(("order", "bound"), [(8, 2e-3), (16, 1e-4), (40, 5e-8), (80, 4e-13)])
def test_near_the_separatrix_the_nome_is_far_better_than_series_and_pade(order: int, bound: float) -> None:
    with ctx.workprec(200):
        A = arb.pi() * arb(fmpq(95, 100))
        by_nome, by_pade = (
            error(nome(find("pendulum"), order), A, pendulum(A)),
            error(pade(expansion("pendulum", order)), A, pendulum(A)),
        )
        plain = float(relative_error(expansion("pendulum", order).in_balls(A), pendulum(A)))
    assert by_nome < bound
    assert by_nome < by_pade < plain


def test_the_nome_is_recognised_by_the_force() -> None:
    swing = Oscillator.from_equation("x'' + 12*sin(3*x/2) = 0")  # k^2 = 18, c = 3/2
    A = arb(1)
    with ctx.workprec(200):
        exact = arb(18).sqrt() * arb(1).agm((A * 3 / 4).cos())
    assert error(nome(swing, 48), A, exact) < 1e-24
    stiff = Oscillator.from_equation("y'' + 4*y - y**3/2 = 0")
    with ctx.workprec(200):
        exact = 2 * (1 - A / 8).sqrt().agm((1 - A / 16).sqrt())
    assert error(nome(stiff, 24), A, exact) < 1e-24
    for equation in ("u'' + u + u**2", "u'' + u + u**5", "u'' + sin(u) + u**3", "u'' + tan(u)", "u'' + u"):
        with pytest.raises(InputError, match="neither k\\^2 sin"):
            nome(Oscillator.from_equation(equation), 8)


@pytest.mark.parametrize("steps", [-1, 7, 2.0, True])
def test_steps_of_the_nome_are_a_small_whole_number(steps: object) -> None:
    with pytest.raises(InputError, match=r"steps .* is not a whole number from 0 to 6; use 2"):
        nome(find("pendulum"), 8, steps=steps)  # type: ignore[arg-type]


def test_the_nome_form_ends_with_the_oscillation() -> None:
    for name, beyond in (("pendulum", 3.1416), ("pendulum", 6.0), ("duffing-softening", 1.01)):
        with pytest.raises(InputError, match="does not hold at A"):
            nome(find(name), 16)(beyond)
    assert nome(find("pendulum"), 16)(3.1415) > 0
