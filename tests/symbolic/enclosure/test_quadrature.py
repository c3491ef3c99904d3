"""Strips, quotients and means of an enclosure, each a bound of what it stands for."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import sympy
from flint import acb, arb, ctx, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.symbolic.enclosure.analytic_strip import Strip, covered_strip, polynomial_strip, strip_of
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.enclosure.integrand import GeneralIntegrand, OrbitBall, integrand_of
from ridgeback.symbolic.enclosure.quadrature import adaptive_mean, midpoint_mean, midpoints, nodes_needed
from ridgeback.symbolic.enclosure.turning_points import orbit
from ridgeback.symbolic.enclosure.walk import UndecidedError, level
from ridgeback.symbolic.enclosure.well import Well, curves, well_of
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.symbolic.enclosure.own import own, to_ball


@given(
    st.lists(st.fractions(-2, 2, max_denominator=9), min_size=1, max_size=5),
    st.fractions("0.02", "1.5", max_denominator=50),
)
@settings(max_examples=60, deadline=None)
def test_polynomial_wells_by_their_roots_and_by_boxes(tail: list[Fraction], amplitude: Fraction) -> None:
    """Exact roots and the proved strip, against the walks, divided differences and boxes of the general route."""
    exact = polynomial_well(tail)
    path = usable_orbit(exact, amplitude)
    general = replace(exact, polynomial=None)
    with ctx.workprec(200):
        other = orbit(general, fmpq(amplitude.numerator, amplitude.denominator), 200)
        assert other is not None
        assert other.trough.overlaps(path.trough)
        first, second = integrand_of(exact, path), GeneralIntegrand(general, other)
        mean = midpoint_mean(first, polynomial_strip(path), 256)
        assert mean.overlaps(midpoint_mean(second, covered(general, other), 256))


def covered(well: Well, path) -> Strip:
    strip = covered_strip(well, path)
    assume(strip is not None)
    return strip


def polynomial_well(tail: list[Fraction]) -> Well:
    u = sympy.Symbol("u", real=True)
    force = u + sum(sympy.Rational(c.numerator, c.denominator) * u ** (n + 2) for n, c in enumerate(tail))
    return well_of(Oscillator.from_equation("u'' + " + str(force).replace("u", "(u)"), name="random"))


def usable_orbit(well: Well, amplitude: Fraction):
    try:
        path = orbit(well, fmpq(amplitude.numerator, amplitude.denominator), 200)
    except ArithmeticError:
        path = None
    assume(path is not None)
    return path


@given(
    st.lists(st.fractions(-1, 1, max_denominator=6), min_size=2, max_size=4),
    st.fractions("0.05", "0.9", max_denominator=40),
)
@settings(max_examples=15, deadline=None)
def test_the_ball_holds_what_plain_midpoints_approach(tail: list[Fraction], amplitude: Fraction) -> None:
    """A slow obvious twin: midpoints of 1/sqrt(2 V(A) - 2 V(u)) itself in mpmath, no factor divided out."""
    well = polynomial_well(tail)
    path = usable_orbit(well, amplitude)
    assume(polynomial_strip(path).width > arb("0.1"))
    exact = enclose(Oscillator.from_equation(f"u'' + {well.restoring}", name="random"), amplitude, bits=64)
    with mpmath.workdps(50):
        coefficients = [mpmath.mpf(int(c.p)) / int(c.q) for c in reversed(well.polynomial.coeffs())]
        A = mpmath.mpf(amplitude.numerator) / amplitude.denominator
        E = mpmath.polyval(coefficients, A)
        near_trough = mpmath.mpf(path.trough.str(20, radius=False))
        B = mpmath.findroot(lambda u: mpmath.polyval(coefficients, u) - E, near_trough)
        nodes, total = 200, mpmath.mpf(0)
        for j in range(nodes):
            theta = (2 * j + 1) * mpmath.pi / (2 * nodes)
            u = (A + B) / 2 + (A - B) / 2 * mpmath.cos(theta)
            total += (A - B) / 2 * mpmath.sin(theta) / mpmath.sqrt(2 * (E - mpmath.polyval(coefficients, u)))
        assert exact.omega.overlaps(to_ball(nodes / total, 15))


def test_the_two_quadratures_overlap() -> None:
    for text, amplitude in (("u'' + u + u**5", 1), ("u'' + sinh(u)", 2), ("u'' + exp(u) - 1", 1)):
        well = well_of(own(text))
        with ctx.workprec(200):
            path = orbit(well, fmpq(amplitude), 200)
            integrand, strip = integrand_of(well, path), strip_of(well, path)
            nodes = nodes_needed(strip, integrand.typical(), 120)
            trapezoid, adaptive = midpoint_mean(integrand, strip, nodes), adaptive_mean(integrand, 120)
        assert trapezoid.overlaps(adaptive)
        assert min(trapezoid.rel_accuracy_bits(), adaptive.rel_accuracy_bits()) > 110


def test_the_error_bound_is_one() -> None:
    """With too few midpoints the plain sum is off, and its distance from the truth stays below the bound."""
    well = well_of(find("duffing"))
    with ctx.workprec(200):
        path = orbit(well, fmpq(3), 200)
        integrand, strip = integrand_of(well, path), strip_of(well, path)
        truth = midpoint_mean(integrand, strip, 512)
        for nodes in (2, 4, 8, 16):
            claimed = midpoint_mean(integrand, strip, nodes)
            bare = sum(integrand.values(list(midpoints(nodes, 200))), arb(0)) / (nodes // 2)
            assert claimed.overlaps(truth)
            assert not bare.overlaps(truth)
            assert claimed.rad() < abs(bare - truth) * 10**4  # not vacuous either


@given(st.integers(1, 8), st.sampled_from([-30, 0, 30]), st.integers(8, 300))
def test_midpoints_are_even_and_as_many_as_the_bits_take(width: int, size: int, bits: int) -> None:
    """Their bound 2 M/(e^(2 a n) - 1) is below the last bit, and would not be with an eighth fewer."""
    strip, typical = Strip(arb(width) / 4, arb(2) ** size), arb(3)
    nodes = nodes_needed(strip, typical, bits)
    assert nodes is not None
    assert nodes % 2 == 0

    def error(count: int) -> arb:
        return 2 * strip.bound / ((2 * strip.width * count).exp() - 1)

    assert error(nodes) < typical * arb(2) ** -bits
    fewer = nodes * 7 // 8 - 3
    assert fewer <= 0 or error(fewer) > typical * arb(2) ** -(bits + 2)


def test_a_level_is_met_where_it_lies() -> None:
    """u^2/2 reaches c^2/2 at c, before the first step ends, on it or after it; 1 - cos(u) never reaches 3."""
    for place in (fmpq(1, 8), fmpq(1), fmpq(7, 2)):
        energy = arb(place) ** 2 / 2
        found = level(lambda u: u**2 / 2, lambda u: u, lambda _: arb(1), energy, step=arb(1), last=arb(9))
        assert found is not None
        assert found.contains(place)
    assert level(lambda u: u**2 / 2, lambda u: u, lambda _: arb(1), arb(50), step=arb(1), last=arb(9)) is None
    assert level(lambda u: 1 - u.cos(), arb.sin, arb.cos, arb(3), step=arb(1), last=arb(9)) is None
    assert (
        level(lambda u: -u.cos().log(), arb.tan, lambda u: 1 + u.tan() ** 2, arb(99), step=arb(1), last=arb(9)) is None
    )
    with pytest.raises(UndecidedError):  # sin(u)(1 - sin(u)) touches 0 at pi/2
        level(
            lambda u: 1 - u.cos() - u / 2 + (2 * u).sin() / 4,
            lambda u: u.sin() * (1 - u.sin()),
            lambda u: u.cos() - (2 * u).sin(),
            arb(9),
            step=arb(1),
            last=arb(9),
        )


@given(
    st.sampled_from(["sin(u)", "exp(u) - 1", "tanh(u) + u**2/9", "u/sqrt(1 + u**2)"]),
    st.floats(0, 3.1),
    st.floats(0, 0.5),
    st.tuples(st.floats(1e-6, 0.2), st.sampled_from([0, 1e-6, 0.2])),
    st.tuples(st.sampled_from([-1, -0.4, 0, 1]), st.sampled_from([-1, 0.7, 1])),
)
@settings(max_examples=150, deadline=None)
def test_every_enclosure_of_the_quotient_holds_every_point(
    force: str, real: float, imaginary: float, size: tuple[float, float], place: tuple[float, float]
) -> None:
    """The divided differences over a box of theta, against the plain quotient at its corners and inside."""
    well = well_of(own(f"u'' + {force}"))
    with ctx.workprec(300):
        integrand = GeneralIntegrand(well, orbit(well, fmpq(1), 300))
        box = integrand.ball(acb(arb(real, size[0]), arb(imaginary, size[1])))
        right, up = (arb(share) * arb(radius) for share, radius in zip(place, size, strict=True))
        inside = integrand.ball(acb(arb(real) + right, arb(imaginary) + up))
        assume(not (inside.fall * inside.rise).contains(0))
        value = next(inside.small(integrand.energy))
        assume(value.rel_accuracy_bits() > 60)
        enclosures = [*box.small(integrand.energy), *box.wide(integrand.energy)]
        assert all(q.overlaps(value) for q in enclosures if q.is_finite())


def test_the_mean_value_form_holds_its_ends() -> None:
    well = well_of(find("pendulum"))
    with ctx.workprec(200):
        box = arb(fmpq(1, 2), fmpq(1, 4))
        ball = OrbitBall(curves(well, 200, complex_=True), orbit(well, fmpq(1), 200), acb(box), acb(1), acb(1), True)
        for end in (fmpq(1, 4), fmpq(1, 2), fmpq(3, 4)):
            assert ball.centred().overlaps(acb(1 - arb(end).cos()))


@pytest.mark.parametrize(
    ("text", "amplitude"),
    [("u'' + u - u**3", "9/10"), ("u'' + u + u**2 + u**5", "1"), ("u'' + sin(u)", "3"), ("u'' + exp(u) - 1", "2")],
)
def test_the_bound_in_the_strip_is_one(text: str, amplitude: str) -> None:
    """|F| on a grid over the strip, its corners above the turning points included, stays below the claim."""
    well = well_of(own(text))
    with ctx.workprec(200):
        path = orbit(well, fmpq(Fraction(amplitude).numerator, Fraction(amplitude).denominator), 200)
        integrand, strip = integrand_of(well, path), strip_of(well, path)
        heights = [strip.width * k / 4 for k in range(5)]
        sizes = [
            abs(integrand.on_ball(acb(arb.pi() * j / 16, height), analytic=False))
            for j in range(17)
            for height in heights
            if height > 0 or 0 < j < 16
        ]
        finite = [size for size in sizes if size.is_finite()]
        assert len(finite) > 60
        assert all(size < strip.bound for size in finite)
