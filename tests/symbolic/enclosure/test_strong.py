"""Oscillators without a linear restoring force: two routes to their frequency, scaling, and what is refused."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import mpmath
import pytest
from flint import arb, ctx, fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.enclosure.enclosure import enclose, enclose_in
from ridgeback.symbolic.enclosure.no_linear_part import strong_well
from ridgeback.symbolic.enclosure.power_law import PowerLaw, power_law
from ridgeback.symbolic.systems.description import from_text, read_description
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.sides import NoLinearForceError

SIZES = st.fractions(Fraction(1, 20), 20, max_denominator=60)


def strong(equation: str, about: str = "0") -> Oscillator:
    found = from_text(equation, about=about)
    with pytest.raises(NoLinearForceError):
        assert found.natural_frequency
    return found


@pytest.mark.parametrize("power", [3, 5, 7, 11])
@pytest.mark.parametrize("amplitude", ["1/3", "2"])
def test_the_gamma_function_and_the_quadrature_agree(power: int, amplitude: str) -> None:
    well = strong_well(strong(f"u'' + 3*u**{power}/7 = 0"))
    assert well is not None
    by_gamma, by_quadrature = (
        enclose_in(well, amplitude, bits=200, method=how) for how in ("closed form", "quadrature")
    )
    assert by_gamma.omega.overlaps(by_quadrature.omega)
    assert min(e.omega.rel_accuracy_bits() for e in (by_gamma, by_quadrature)) > 190
    assert (by_gamma.method, by_quadrature.method) == ("closed form", "quadrature")


def test_the_cubic_force_has_three_routes() -> None:
    """The arithmetic-geometric mean of the quartic potential, the gamma function, and cn's quarter period.

    u = A cn(A t | 1/2): the period is 4 K(1/2)/A (DLMF 22.13, for u'' = -u^3).
    """
    own = strong("u'' + u**3 = 0")
    law = PowerLaw(fmpq(1, 4), 4)
    with ctx.workprec(160):
        by_mean, by_gamma = enclose(own, 2, bits=120).omega, law.frequency(arb(2))
        assert by_mean.overlaps(by_gamma)
    with mpmath.workdps(40):
        elliptic = 2 * mpmath.pi / (4 * mpmath.ellipk(mpmath.mpf(1) / 2) / 2)
        assert mpmath.almosteq(mpmath.mpf(by_mean.str(36, radius=False)), elliptic, 1e-33)


@settings(deadline=None, max_examples=15)
@given(SIZES, st.integers(2, 5), SIZES)
def test_scaling_is_exact(amplitude: Fraction, half: int, stretch: Fraction) -> None:
    """u = s w turns u'' + u^p = 0 into w'' + s^(p-1) w^p = 0: omega(s A; 1) = omega(A; s^(p-1))."""
    p = 2 * half - 1
    factor = stretch ** (p - 1)
    first = enclose(strong(f"u'' + u**{p} = 0"), amplitude * stretch, bits=80)
    second = enclose(strong(f"u'' + {factor.numerator}/{factor.denominator}*u**{p} = 0"), amplitude, bits=80)
    assert first.omega.overlaps(second.omega)


def test_mixed_powers_tend_to_the_lower_one_at_small_amplitudes_and_to_the_higher_one_at_large() -> None:
    mixed = strong("u'' + u**3 + u**7 = 0")
    for amplitude, exponent in (("1/10000", 4), ("10000", 8)):
        law = PowerLaw(fmpq(1, exponent), exponent)
        with ctx.workprec(120):
            size = arb(fmpq(1, 10000)) if "/" in amplitude else arb(10000)
            ratio = enclose(mixed, amplitude, bits=80).omega / law.frequency(size)
            assert abs(ratio - 1) < 1e-7


def test_unequal_turning_points() -> None:
    found = enclose(strong("u'' + u**3 + u**4/2 = 0"), 1, bits=80)
    other = enclose(strong("u'' + u**3 - u**4/2 = 0"), 1, bits=80, definition="trough")
    assert found.omega.overlaps(other.omega)  # u -> -u
    assert found.trough < -1
    with ctx.workprec(100):  # both at one height of V = u^4/4 + u^5/10
        assert (found.trough**4 / 4 + found.trough**5 / 10 - arb(fmpq(7, 20))).contains(0)


@pytest.mark.parametrize(
    ("equation", "amplitude", "said"),
    [
        ("u'' + u**3 - u**5 = 0", 1, "separatrix at 1; use less"),
        ("u'' + u**3 - u**5 = 0", 2, "separatrix"),
        ("u'' + u**2 = 0", 1, "does not restore"),
        ("u'' - u**3 = 0", 1, "does not restore"),
        ("u'' + u'*u**2 + u**3 = 0", 1, "terms in u'"),
        ("u'' + c*u**3 = 0", 1, "c has none"),
    ],
)
def test_what_has_no_enclosure_is_refused_by_name(equation: str, amplitude: int, said: str) -> None:
    with pytest.raises(InputError, match=said):
        enclose(strong(equation), amplitude)


def test_the_law_is_one_even_power_only() -> None:
    assert power_law(fmpq_poly([0, 0, 0, 1])) is None
    assert power_law(fmpq_poly([0, 0, 0, 0, -1])) is None


def test_files_and_other_equilibria_lead_to_the_same(tmp_path: Path) -> None:
    moved = strong("u'' + (u - 1)**3 = 0", about="1")
    path = tmp_path / "cubic.toml"
    path.write_text("[oscillator]\nequation = \"x'' + x**3 = 0\"\n")
    assert enclose(moved, 1).omega.overlaps(enclose(read_description(path), 1).omega)
