"""Enclosures of omega0(A): against mpmath, closed forms, each other, exact constants, and values known to be wrong."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import mpmath
import pytest
import sympy
from flint import acb, arb, ctx, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.certificates.accuracy import certified_error
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure.analytic_strip import Strip, covered_strip, polynomial_strip, strip_of
from ridgeback.symbolic.enclosure.enclosure import enclose, exact_size, rounded_down, separatrix
from ridgeback.symbolic.enclosure.integrand import GeneralIntegrand, OrbitBall, integrand_of
from ridgeback.symbolic.enclosure.quadrature import adaptive_mean, midpoint_mean, midpoints, nodes_needed
from ridgeback.symbolic.enclosure.turning_points import orbit
from ridgeback.symbolic.enclosure.walk import UndecidedError, level
from ridgeback.symbolic.enclosure.well import Well, curves, well_of
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

ISOTONIC = "u'' + (1 + u - 1/(1 + u)**3)/4 = 0"
"""V = s^2/8 with s = x - 1/x, x = 1 + u > 0.  dx/ds = 1/2 + s/(2 sqrt(s^2 + 4)), whose odd part drops out of
T = 2 * integral of dx / sqrt(2E - 2V) = integral of ds / sqrt(2E - s^2/4) = 2 pi, so omega0 = 1 at every energy."""

MATHEWS_LAKSHMANAN = "(1 + lambda1*u**2)*u'' - lambda1*u*u'**2 + a**2*u = 0"


def own(text: str, **parameters: str) -> Oscillator:
    return Oscillator.from_equation(text, parameters=parameters)


def to_ball(value: mpmath.mpf, digits: int) -> arb:
    """The value with an uncertainty of one unit in its last digit but a few."""
    with ctx.workprec(600):
        centre = arb(mpmath.nstr(value, digits + 5))
        return centre + arb(0, abs(centre) * arb(10) ** -digits)


def mp_frequency(potential, force, peak: str, trough_near: str, digits: int = 40) -> arb:
    """omega0 by mpmath: root finding and tanh-sinh on the plain singular integrand, nothing shared with the balls.

    The ends are subtracted as V(A) - V(u) at twice the digits, and u = mid + half*sin(phi) is mpmath's own doing.
    """
    with mpmath.workdps(2 * digits):
        A = mpmath.mpf(peak)
        E = potential(A)
        B = mpmath.findroot(lambda u: potential(u) - E, mpmath.mpf(trough_near))
        middle, half = (A + B) / 2, (A - B) / 2

        def integrand(phi):
            c = half * mpmath.cos(phi)
            return c / mpmath.sqrt(2 * (E - potential(middle + half * mpmath.sin(phi))))

        total = mpmath.quad(integrand, mpmath.linspace(-mpmath.pi / 2, mpmath.pi / 2, 5))
        assert force(A) > 0 > force(B)
        return to_ball(mpmath.pi / total.real, digits - 10)  # a last node may see a negative rounding error


def near(ball: arb, other: arb, bits: int) -> bool:
    """Overlap, and the ball is tight."""
    return ball.overlaps(other) and ball.rel_accuracy_bits() >= bits


@pytest.mark.parametrize("amplitude", ["1e-8", "0.5", "2", "3.1", "3.14159"])
def test_pendulum_contains_the_elliptic_integral(amplitude: str) -> None:
    with mpmath.workdps(60):
        expected = mpmath.pi / (2 * mpmath.ellipk(mpmath.sin(mpmath.mpf(amplitude) / 2) ** 2))
        expected = to_ball(expected, 40)
    assert near(enclose(find("pendulum"), amplitude).omega, expected, 125)


@pytest.mark.parametrize(("eps", "amplitude"), [("1", "1"), ("1", "40"), ("-1", "0.5"), ("-1", "0.999"), ("3/7", "2")])
def test_duffing_contains_the_complete_elliptic_integral(eps: str, amplitude: str) -> None:
    """omega0 = pi sqrt(1 + e A^2) / (2 K(m)), m = e A^2 / (2 (1 + e A^2)) (Kovacic and Brennan 2011, chapter 2)."""
    with mpmath.workdps(60):
        h = mpmath.mpf(Fraction(eps).numerator) / Fraction(eps).denominator * mpmath.mpf(amplitude) ** 2
        expected = mpmath.pi * mpmath.sqrt(1 + h) / (2 * mpmath.ellipk(h / (2 * (1 + h))))
        expected = to_ball(expected, 40)
    duffing = find("duffing").with_parameters({"eps": eps})
    assert near(enclose(duffing, amplitude).omega, expected, 125)
    assert near(enclose(duffing, amplitude, method="quadrature").omega, expected, 125)


def test_duffing_by_the_elliptic_integral_of_flint() -> None:
    with ctx.workprec(200):
        expected = arb.pi() * arb(2).sqrt() / (2 * acb(arb(1) / 4).elliptic_k().real)
    assert near(enclose(find("duffing"), 1, bits=160).omega, expected, 155)


ASYMMETRIC = {
    "helmholtz-duffing": (
        "u'' + u + u**2 + u**3",
        lambda u: u**2 / 2 + u**3 / 3 + u**4 / 4,
        lambda u: u + u**2 + u**3,
        "1",
        "-1.4257",
    ),
    "helmholtz": (
        "u'' + u + u**2",
        lambda u: u**2 / 2 + u**3 / 3,
        lambda u: u + u**2,
        "0.4",
        "-0.6",
    ),
    "degree 6": (
        "u'' + u - u**2/3 + u**5",
        lambda u: u**2 / 2 - u**3 / 9 + u**6 / 6,
        lambda u: u - u**2 / 3 + u**5,
        "0.9",
        "-0.8",
    ),
    "Toda": ("u'' + exp(u) - 1", lambda u: mpmath.exp(u) - 1 - u, lambda u: mpmath.exp(u) - 1, "1.5", "-2.9"),
    "tilted": (
        "u'' + sin(u) + u**2/10",
        lambda u: 1 - mpmath.cos(u) + u**3 / 30,
        lambda u: mpmath.sin(u) + u**2 / 10,
        "1",
        "-1.09",
    ),
    "tanh": ("u'' + tanh(u)", lambda u: mpmath.log(mpmath.cosh(u)), mpmath.tanh, "3", "-3"),
    "root": (
        "u'' + u/sqrt(1 + u**2)",
        lambda u: mpmath.sqrt(1 + u**2) - 1,
        lambda u: u / mpmath.sqrt(1 + u**2),
        "1",
        "-1",
    ),
}


@pytest.mark.parametrize("name", ASYMMETRIC)
def test_potentials_of_every_kind_against_mpmath(name: str) -> None:
    text, potential, force, peak, trough = ASYMMETRIC[name]
    assert near(enclose(own(text), peak).omega, mp_frequency(potential, force, peak, trough), 125)


@pytest.mark.parametrize(
    ("text", "amplitude"),
    [
        ("u'' + 4*sin(u)", "3"),
        ("u'' + 2*sin(3*u)", "1"),
        ("u'' + u + 5*u**3", "2"),
        ("u'' + u - u**3", "0.9999999"),
        ("u'' + u + u**2", "0.4999"),
        ("u'' + u + u**2 + u**3", "3"),
        ("u'' + u - u**2/5 - u**3/7", "1"),
        ("u'' + 2*u", "1"),
    ],
)
def test_closed_form_and_quadrature_overlap(text: str, amplitude: str) -> None:
    closed, integral = (enclose(own(text), amplitude, method=method) for method in ("closed form", "quadrature"))
    assert (closed.method, integral.method) == ("closed form", "quadrature")
    assert near(closed.omega, integral.omega, 125)
    assert integral.omega.rel_accuracy_bits() >= 125


def test_the_default_takes_the_closed_form_where_the_force_has_the_structure() -> None:
    forces = {
        "sin(u/2)": "closed form",
        "u + 3*u**3": "closed form",
        "sin(u) + u**2": "quadrature",
        "u + u**5": "quadrature",
    }
    for force, method in forces.items():
        assert enclose(own(f"u'' + {force}"), "0.1").method == method


@pytest.mark.parametrize("text", ["u'' + sin(u)", "u'' + u + u**2 + u**3", "u'' + exp(u) - 1", "u'' + u + u**5"])
def test_more_bits_lie_inside(text: str) -> None:
    balls = [enclose(own(text), "0.7", bits=bits).omega for bits in (16, 17, 53, 128, 300)]
    for wide, narrow in pairwise(balls):
        assert wide.contains(narrow)
        assert narrow.rad() < wide.rad()


def test_a_wrong_value_is_outside() -> None:
    exact = enclose(find("duffing"), 1)
    with ctx.workprec(300):
        wrong = exact.middle * (1 + arb(2) ** -120)
    assert not exact.omega.overlaps(wrong)
    assert not exact.omega.contains(arb(11) / 8)  # the first-order series 1 + 3/8


@pytest.mark.parametrize("amplitude", ["0.1", "1", "7"])
def test_isochronous_potentials_have_a_constant_frequency(amplitude: str) -> None:
    assert near(enclose(own(ISOTONIC), amplitude).omega, arb(1), 120)
    assert near(enclose(own(ISOTONIC.replace("/4", "*9/4")), amplitude).omega, arb(3), 120)


@pytest.mark.parametrize("amplitude", ["0.25", "2"])
@pytest.mark.parametrize("strength", ["1/2", "3", "-1/9"])
def test_position_dependent_mass_has_the_published_frequency(strength: str, amplitude: str) -> None:
    """omega0 = a / sqrt(1 + lambda A^2) (Mathews and Lakshmanan 1974)."""
    system = own(MATHEWS_LAKSHMANAN, lambda1=strength, a="2")
    with ctx.workprec(200):
        expected = 2 / (1 + arb(fmpq(strength)) * arb(amplitude) ** 2).sqrt()
    assert near(enclose(system, amplitude).omega, expected, 120)


def test_an_algebraic_natural_frequency() -> None:
    system = own("u'' + 2*u + u**3")
    with ctx.workprec(200):
        expected = (arb(2) + arb(1) / 2).sqrt().agm(arb(3).sqrt())
    assert near(enclose(system, 1).omega, expected, 125)
    assert enclose(system, 0).omega.overlaps(arb(2).sqrt())


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


def test_trough_is_the_peak_of_the_mirrored_oscillator() -> None:
    system = own("u'' + u + u**2 + u**3")
    first = enclose(system, "0.9", definition="trough")
    second = enclose(own("u'' + u - u**2 + u**3"), "0.9")
    assert first.omega.overlaps(second.omega)
    assert first.trough == -arb(fmpq(9, 10)) or first.trough.overlaps(-arb(fmpq(9, 10)))
    back = enclose(system, rounded_down(first.peak), bits=48)
    assert back.omega.overlaps(first.omega)


@pytest.mark.parametrize("sign", [1, -1])
def test_amplitudes_are_taken_to_their_limits(sign: int) -> None:
    last = Fraction(2) ** (sign * 1000)
    assert exact_size(last) == last
    with pytest.raises(InputError, match="not within"):
        exact_size(last * Fraction(2) ** sign)


def test_amplitudes_mean_what_they_say() -> None:
    duffing = find("duffing")
    assert enclose(duffing, "0.1").amplitude == sympy.Rational(1, 10)
    assert enclose(duffing, 0.1).amplitude == sympy.Rational(0.1) != sympy.Rational(1, 10)
    assert not enclose(duffing, "0.1").omega.overlaps(enclose(duffing, 0.1, bits=200).omega)
    assert enclose(duffing, Fraction(1, 3)).omega.overlaps(enclose(duffing, "1/3").omega)


def test_bounds_in_floats_are_outward_and_adjacent() -> None:
    exact = enclose(find("duffing"), 1)
    assert arb(exact.lower) < exact.omega < arb(exact.upper)
    assert exact.upper - exact.lower <= 2**-51
    third = arb(1) / 3
    assert Fraction(rounded_down(third)) < Fraction(1, 3) < Fraction(-rounded_down(-third))


# --- separatrix -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "peak", "trough"),
    [
        ("u'' + sin(u)", "3.14159265358979323846", "-3.14159265358979323846"),
        ("u'' + u - 4*u**3", "0.5", "-0.5"),
        ("u'' + u + u**2", "0.5", "-1"),
        ("u'' + u - u**2", "1", "-0.5"),
        ("u'' + u*(1 - u)**2", "1", "-0.33333333333333333333"),
        ("u'' + u + u**3", None, None),
        ("u'' + sinh(u)", None, None),
        ("u'' + u*(1 - u)*(u + 2)/2", "1", "-0.61257411327721"),
    ],
)
def test_separatrix(text: str, peak: str | None, trough: str | None) -> None:
    found = separatrix(own(text))
    assert (found.peak is None) == (peak is None)
    if peak is not None and trough is not None:
        assert near(found.peak, arb(peak) + arb(0, "1e-12"), 50)
        assert near(found.trough, arb(trough) + arb(0, "1e-12"), 50)
        assert found.saddle.overlaps(found.peak) or found.saddle.overlaps(found.trough)


@pytest.mark.parametrize(
    ("text", "below", "at"),
    [
        ("u'' + u - u**3", "0.999999999999", "1"),
        ("u'' + u + u**2", "0.499999999999", "0.5"),
        ("u'' + u*(1 - u)**2", "0.9999", "1"),
        ("u'' + sin(u)", "3.141592653589", "3.1416"),
        ("u'' + sin(u) + u**2/10", "1.6905", "1.7"),
    ],
)
def test_amplitudes_are_taken_up_to_the_separatrix_and_refused_at_it(text: str, below: str, at: str) -> None:
    system = own(text)
    slow = enclose(system, below, bits=53)
    assert slow.omega > 0
    assert slow.omega < enclose(system, "0.1").omega
    limit = float(separatrix(system).peak)
    for beyond in (at, "1000"):
        with pytest.raises(InputError, match=rf"at or beyond the separatrix at {limit:.10g}; use less"):
            enclose(system, beyond)


def test_a_barrier_on_the_far_side_counts() -> None:
    """Left of the well of u + u^2 the saddle at -1 is met first, though the peak side has no barrier at all."""
    assert separatrix(own("u'' + u + u**2")).saddle == -1
    with pytest.raises(InputError, match=r"separatrix at 0\.5"):
        enclose(own("u'' + u + u**2"), "0.75")


def test_a_singular_force_ends_the_family() -> None:
    assert enclose(own("u'' + tan(u)"), "1.57").omega > 3
    with pytest.raises(InputError, match="not analytic on the way"):
        enclose(own("u'' + tan(u)"), "1.6")


def test_a_potential_that_saturates_turns_nothing_back() -> None:
    """Morse: V < 1/2 on the right, so an orbit from the left returns only from above u = -log 2."""
    morse = own("u'' + (1 - exp(-u))*exp(-u)")
    assert enclose(morse, "3").omega > 0
    assert enclose(morse, "0.69", definition="trough").omega > 0
    with pytest.raises(InputError, match="does not rise as high on the other side"):
        enclose(morse, "2", definition="trough")


def test_what_cannot_be_decided_is_said_to_be() -> None:
    """sin(u)(1 - sin(u)) touches 0 at pi/2 without crossing it: no interval test can prove that."""
    with pytest.raises(InputError, match="cannot decide"):
        separatrix(own("u'' + sin(u) + cos(2*u)/2 - 1/2"))


# --- certified error of a series --------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [2, 4, 8, 20])
def test_the_error_of_a_series_is_its_first_omitted_term(order: int) -> None:
    """At small amplitude; the sign is proved, since the ball excludes zero."""
    pendulum, small = find("pendulum"), Fraction(1, 50)
    error = certified_error(pendulum, lindstedt(pendulum, order), small, bits=256)
    omitted = -lindstedt(pendulum, order + 2).coefficients[order + 2] * fmpq(1, 50) ** (order + 2)
    assert not error.contains(0)
    assert abs(error / arb(omitted) - 1) < arb("0.01")


def test_the_error_grows_beyond_the_radius_of_convergence() -> None:
    """Duffing's series converges for eps A^2 < 1."""
    duffing = find("duffing")
    errors = [[abs(certified_error(duffing, lindstedt(duffing, n), A)) for n in (10, 30)] for A in ("0.8", "1.2")]
    assert errors[0][1] < errors[0][0]
    assert errors[1][1] > errors[1][0]


def test_errors_know_the_definition_and_the_scale() -> None:
    system = own("u'' + 2*u + u**2 + u**3")
    for definition in ("peak", "trough"):
        series = energy_integral(system, 12, amplitude=definition)
        error = certified_error(system, series, "0.05")
        assert not error.contains(0)
        assert abs(error) < arb("1e-13")


@pytest.mark.parametrize(
    ("system", "series", "match"),
    [
        ("duffing", lambda: lindstedt(find("pendulum"), 4), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing").with_parameters({"eps": "2"}), 4), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing").with_parameters({"k": "2"}), 0), "not one of duffing"),
        ("duffing", lambda: lindstedt(find("duffing"), 4, amplitude="fundamental"), "fundamental"),
        ("duffing", lambda: energy_integral(find("duffing"), 4, amplitude="action"), "action"),
        ("van-der-pol", lambda: lindstedt(find("van-der-pol"), 4), "in eps"),
    ],
)
def test_errors_of_foreign_series_are_refused(system: str, series, match: str) -> None:
    with pytest.raises(InputError, match=match):
        certified_error(find(system), series(), 1)


# --- refusals ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "match"),
    [
        ("van-der-pol", "enclosed at values of the small parameter"),
        ("rayleigh", "self-excited"),
        ("damped-pendulum", "use --method multiple-scales"),
    ],
)
def test_oscillators_without_an_energy_are_refused(name: str, match: str) -> None:
    with pytest.raises(InputError, match=match):
        enclose(find(name), 1)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("u'' + u + eps*u**3", "eps has none"),
        ("u'' + u + u*u'**4", "velocity terms other than"),
        ("u'' + u + u**200", "degree 201"),
        ("u'' + u + c*u*abs(u)", "c has none"),
        ("u'' + u'/10 + u + u*abs(u)", "no energy with terms in u' beside a kink"),
        ("u'' + u - 2*u*abs(u)", "amplitude 0.5 has no closed orbit"),
        ("u'' + u - u*abs(u) + 2*u**2/3", "amplitude 0.5 has no closed orbit"),
    ],
)
def test_equations_that_cannot_be_enclosed_say_why(text: str, match: str) -> None:
    with pytest.raises(InputError, match=match):
        enclose(own(text), "0.5")


@pytest.mark.parametrize(
    ("amplitude", "options", "match"),
    [
        ("nan", {}, "not a finite number"),
        (float("inf"), {}, "not finite"),
        (-1, {}, "negative"),
        (True, {}, "bool"),
        (None, {}, "NoneType"),
        (Fraction(1, 2**1100), {}, "2\\*\\*-1000"),
        (1, {"bits": 8}, "bits 8"),
        (1, {"bits": 10**6}, "bits 1000000"),
        (1, {"bits": True}, "bits True"),
        (1, {"definition": "action"}, "'action' has no enclosure"),
    ],
)
def test_bad_values_are_named(amplitude: object, options: dict[str, object], match: str) -> None:
    with pytest.raises(InputError, match=match):
        enclose(find("duffing"), amplitude, **options)


def test_a_closed_form_that_is_not_there_is_not_made_up() -> None:
    with pytest.raises(InputError, match="no closed form"):
        enclose(own("u'' + u + u**5"), 1, method="closed form")
    with pytest.raises(InputError, match="no closed form"):
        enclose(own("u'' + u + u*abs(u)"), 1, method="closed form")


def test_at_rest_a_kink_does_not_count() -> None:
    """Half a cycle with the stiffness of each side: k = 2 k1 k2/(k1 + k2); it is also the root of the stiffness."""
    bilinear = own("u'' + 4*max(u, 0) + min(u, 0)")
    rest = enclose(bilinear, 0)
    assert (rest.omega.overlaps(arb(4) / 3), rest.peak, rest.method) == (True, 0, "closed form")
    assert bilinear.stiffness == sympy.Rational(16, 9)
    assert exact_frequency("u'' + u*u'**4 + 4*u", 0).omega.contains(2)


def test_a_far_side_that_never_turns_the_motion_back_is_given_up_soon() -> None:
    """V -> 1 for u < 0, and the quick decay of the force is seen on short stretches only."""
    with pytest.raises(InputError, match="does not rise as high on the other side"):
        enclose(own("u'' + u*exp(-abs(u)) + u**2*abs(u)/5 + u**3/5"), 10)
