"""Enclosures of omega0(A): against mpmath, closed forms, each other, exact constants, and values known to be wrong."""

from fractions import Fraction
from itertools import pairwise

import mpmath
import pytest
import sympy
from flint import acb, arb, ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.enclosure.enclosure import enclose, exact_size, rounded_down
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.enclosure.own import near, own, to_ball

ISOTONIC = "u'' + (1 + u - 1/(1 + u)**3)/4 = 0"
"""V = s^2/8 with s = x - 1/x, x = 1 + u > 0.  dx/ds = 1/2 + s/(2 sqrt(s^2 + 4)), whose odd part drops out of
T = 2 * integral of dx / sqrt(2E - 2V) = integral of ds / sqrt(2E - s^2/4) = 2 pi, so omega0 = 1 at every energy."""
MATHEWS_LAKSHMANAN = "(1 + lambda1*u**2)*u'' - lambda1*u*u'**2 + a**2*u = 0"


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
