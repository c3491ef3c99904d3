"""Slow flows: any ordering of small parameters, any natural frequency, limit cycles, transients, reconstruction.

The slow twin writes k out and works with monomials z^p zbar^q in SymPy; it shares no code with the engine.
"""

import math
from dataclasses import replace

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.polys.rings import xring

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.fixed_points import cycle_series, frequency_series
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import ordered
from ridgeback.symbolic.flow.reconstruction import PHI, Reconstruction, along
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.transient import START, TIME, closed_form, transient
from ridgeback.symbolic.series.trigonometric import harmonic
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import U, V
from tests.symbolic.flow.own import R, a, c, d, eps, g, make, runge_kutta, same, symbol


# -- the slow twin ---------------------------------------------------------------------------------------------------
def slow_twin(force: sympy.Expr, k: int, weights: dict[str, int], order: int) -> sympy.Expr:
    """h of z' = z h by undetermined monomials z^p zbar^q m^r, k written out; theory: normal form of a centre."""
    names = sorted(s.name for s in force.free_symbols - {U, V})
    ring, (z, w, t, *parameters) = xring(["z", "w", "t", *names], sympy.QQ_I)  # w = conj(z), t counts degrees
    weighted = {n: p * t ** weights.get(n, 0) for n, p in zip(names, parameters, strict=True)}
    terms = sympy.Poly(force, U, V, *map(symbol, names)).terms()
    i, u, h, conjugate_h = ring(sympy.I), t * (z + w), ring(sympy.I * k), ring(-sympy.I * k)

    def cut(p):  # type: ignore[no-untyped-def]
        return ring.from_dict({powers: value for powers, value in p.items() if powers[2] <= order + 1})

    def rate(p):  # type: ignore[no-untyped-def]
        return cut(z * h * p.diff(z) + w * conjugate_h * p.diff(w))

    for n in range(2, order + 2):
        v = rate(u)
        total = rate(v)
        for powers, value in terms:
            product = ring(value)
            for factor, power in zip((u, v, *weighted.values()), powers, strict=True):
                for _ in range(power):
                    product = cut(product * factor)
            total += product
        for powers, value in total.items():
            p, q, degree, *_ = powers
            term = ring.from_dict({powers: value})
            if degree == n and abs(p - q) != 1:
                u -= term * ring(R(1, k**2 * (1 - (p - q) ** 2)))
            elif degree == n and p - q == 1:  # D D z brings 2 i k h_n z
                h += i * term.quo(z * t) * ring(R(1, 2 * k))
            elif degree == n:
                conjugate_h -= i * term.quo(w * t) * ring(R(1, 2 * k))
    return sympy.expand(h.as_expr(a / 2, a / 2, sympy.S.One, *map(symbol, names)))


TWINS = {
    "linear and cubic damping, k = 2": ("u'' + c*u' + d*u'**3 + 4*u + g*u**3", {"c": 2, "d": 1}, 2, 5),
    "linear and cubic damping, k = 3": ("u'' + c*u' + d*u'**3 + 9*u + u**3 + u**2", {"c": 1, "d": 2}, 3, 4),
    "van der Pol, k = 2": ("u'' - eps*(1 - u**2)*u' + 4*u", {"eps": 1}, 2, 6),
    "small quadratic term, k = 2": ("u'' + 2*mu*u' + 4*u + b*u**2 + g*u**3", {"mu": 2, "b": 1}, 2, 4),
    "no small parameter": ("u'' + u + u'**3 + u**2*u' + u**2", {}, 1, 5),
    "conservative velocity term, k = 2": ("u'' + 4*u + c*u' + u*u'**2", {"c": 2}, 2, 4),
}


@pytest.mark.parametrize("name", TWINS)
def test_slow_twin_with_k_written_out(name: str) -> None:
    equation, weights, k, order = TWINS[name]
    oscillator = make(equation)
    flow = multiple_scales(oscillator, order, weights=weights)
    assert flow.variables == ("a", *weights)
    h = slow_twin(oscillator.force, k, weights, order)
    assert same(flow.growth_rate_expression() + sympy.I * flow.frequency_expression(), h)
    assert flow.residual() == []


@given(
    st.lists(st.integers(-3, 3), min_size=5, max_size=5),
    st.sampled_from([(1, 1), (2, 1), (1, 2), (2, 2)]),
    st.integers(1, 3),
)
@settings(max_examples=25, deadline=None)
def test_any_cubic_force_agrees_with_the_slow_twin(values: list[int], weights: tuple[int, int], k: int) -> None:
    b2, b3, cross, damping, velocity = values
    equation = (
        f"u'' + {k * k}*u + ({b2})*u**2 + ({b3})*u**3 + ({cross})*u*u'**2"
        f" + c*u' + d*(({damping})*u**2*u' + ({velocity})*u'**3 + u'**5)"
    )
    oscillator = make(equation)
    chosen = dict(zip(("c", "d"), weights, strict=True))
    flow = multiple_scales(oscillator, 4, weights=chosen)
    h = slow_twin(oscillator.force, k, chosen, 4)
    assert same(flow.growth_rate_expression() + sympy.I * flow.frequency_expression(), h)


# -- published slow flows --------------------------------------------------------------------------------------------
def test_damped_duffing_oscillator_with_both_parameters_symbolic() -> None:
    # Where slow times that are taken to commute give other numbers from the third order on.
    flow = multiple_scales(make("u'' + u + g*u**3 + c*u' = 0"), 6)
    decay = -c / 2 + 3 * c * g * a**2 / 16 - R(195, 1024) * c * g**2 * a**4
    frequency = (
        1
        + 3 * g * a**2 / 8
        - (15 * g**2 * a**4 + 32 * c**2) / 256
        + 3 * g * a**2 * (41 * g**2 * a**4 - 128 * c**2) / 8192
    )
    assert same(flow.growth_rate_expression(), decay)
    assert same(flow.frequency_expression(), frequency)


def test_quadratic_and_cubic_stiffness() -> None:
    # Nayfeh and Mook (1979), 2.3: omega = omega0 [1 + (9 alpha3 omega0^2 - 10 alpha2^2) a^2 / (24 omega0^4)].
    flow = multiple_scales(make("u'' + w**2*u + p*u**2 + q*u**3 = 0"), 2)
    w, p, q = (symbol(name) for name in "wpq")
    assert same(flow.frequency_expression(), w * (1 + (9 * q * w**2 - 10 * p**2) / (24 * w**4) * a**2))
    assert flow.variables == ("a",)


def test_negative_damping() -> None:
    # Nayfeh and Mook (1979), chapter 3: u'' + w^2 u = eps (u' - u'^3) has a' = eps a (1 - 3 w^2 a^2/4)/2 and
    # a^2 = a0^2 / [3 w^2 a0^2/4 + (1 - 3 w^2 a0^2/4) exp(-eps t)].
    flow = multiple_scales(make("u'' + w**2*u = eps*(u' - u'**3)"), 3, weight=1)
    w = symbol("w")
    assert same(flow.growth_rate_expression(), eps / 2 * (1 - R(3, 4) * w**2 * a**2))
    found = closed_form(flow)
    assert found is not None
    quarter = R(3, 4) * w**2 * START**2
    published = START**2 / (quarter + (1 - quarter) * sympy.exp(-eps * TIME))
    assert sympy.simplify(found.amplitude**2 / published) == 1


def test_cubic_damping_decays_algebraically() -> None:
    # u'' + u + eps u'^3 = 0: a' = -3 eps a^3/8, a = a0 / sqrt(1 + 3 eps a0^2 t/4).
    flow = multiple_scales(make("u'' + u + eps*u'**3 = 0"), 4)
    found = closed_form(flow)
    assert found is not None
    assert same(flow.growth_rate_expression(), -3 * eps * a**2 / 8)
    assert sympy.simplify(found.amplitude * sympy.sqrt(1 + R(3, 4) * eps * START**2 * TIME) / START) == 1


@pytest.mark.parametrize("k", [1, "3/2"])
@pytest.mark.parametrize("name", ["van-der-pol", "rayleigh"])
def test_frequency_on_the_cycle_is_lindstedts_series(name: str, k: object) -> None:
    # Van der Pol: 1 - eps^2/16 + 17 eps^4/3072 (Andersen and Geer 1982); slow times that commute give 5 or 7/3072.
    oscillator = find(name).with_parameters({"k": k})  # type: ignore[dict-item]
    flow = multiple_scales(oscillator, 18, weight=1)
    series = frequency_series(flow, cycle_series(flow)[0])
    assert series == lindstedt(oscillator, 6).frequency
    assert k != 1 or series[4] == R(17, 3072)


# -- natural frequency -----------------------------------------------------------------------------------------------
def at_k(flow: SlowFlow, k: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    both = flow.frequency_expression(), flow.growth_rate_expression()
    return tuple(sympy.expand(e.subs(symbol("k"), k)) for e in both)  # type: ignore[return-value]


@pytest.mark.parametrize("square", ["4", "9/4", "2", "1/3"])
def test_symbolic_natural_frequency_is_the_numeric_one_written_out(square: str) -> None:
    equation = "u'' + c*u' + d*u'**3 + {}*u + g*u**3 + b*u**2"
    written = multiple_scales(make(equation.format("k**2")), 4)
    numeric = multiple_scales(make(equation.format(f"({square})")), 4)
    assert at_k(written, sympy.sqrt(R(square))) == at_k(numeric, sympy.S.One)
    assert numeric.residual() == []


def test_irrational_frequency_with_a_plain_cubic_damping() -> None:
    flow, named = multiple_scales(make("u'' + 2*u + u'**3"), 4), multiple_scales(make("u'' + 2*u + d*u'**3"), 8)
    assert same(flow.growth_rate_expression(), sum(e for e in named.expressions(named.growth_rate[:1])).subs(d, 1))
    # a'/a = -3 k^2 a^2/8 and phi' = k + 9 k^3 a^4/256 with k^2 = 2.
    assert same(flow.growth_rate_expression(), -3 * a**2 / 4)
    assert same(flow.frequency_expression(), sympy.sqrt(2) * (1 + R(9, 128) * a**4))


@pytest.mark.parametrize("term", ["u*u'/3", "u*u'**3/2", "u*u'/3 + u'**3/10"])
def test_irrational_frequency_with_odd_powers_of_it_in_natural_units(term: str) -> None:
    numeric, written = (
        multiple_scales(make(f"u'' + 2*u + {term}"), 4),
        multiple_scales(make(f"u'' + k**2*u + {term}"), 4),
    )
    assert at_k(written, sympy.sqrt(2)) == at_k(numeric, sympy.S.One)


def test_symbolic_frequency_that_does_not_scale_out() -> None:
    k = symbol("k")
    flow = multiple_scales(make("u'' + k**2*u + u**3"), 4)
    assert same(flow.frequency_expression(), k + 3 * a**2 / (8 * k) - 15 * a**4 / (256 * k**3))
    assert flow.residual() == []
    damped = multiple_scales(make("u'' + k**2*u + u'**3"), 4)
    assert same(damped.growth_rate_expression(), -3 * k**2 * a**2 / 8)
    assert same(damped.frequency_expression(), k + 9 * k**3 * a**4 / 256)


def test_units_of_linear_and_cubic_damping() -> None:
    natural = ordered(make("u'' + c*u' + d*u'**3 + e*u'**5 + 4*u + g*u**3"))
    assert dict(natural.dimensions) == {"c": 1, "d": -1, "e": -3, "g": 2}
    assert natural.scale == 2


# -- no secular term is left -----------------------------------------------------------------------------------------
@pytest.mark.parametrize("equation", [value[0] for value in TWINS.values()])
def test_no_secular_term_survives_and_a_wrong_number_is_noticed(equation: str) -> None:
    flow = multiple_scales(make(equation), 4)
    first = [harmonic(p, 1) for p in flow.waveform]
    assert first[1] == (1, 0)
    assert all(pair == (0, 0) for n, pair in enumerate(first) if n != 1)
    for name in ("omega", "delta"):
        wrong = list(getattr(flow, name))
        wrong[2] = wrong[2] + fmpq(1, 10**12)
        assert replace(flow, **{name: tuple(wrong)}).residual()[0] == 3


# -- reconstruction --------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("equation", "weights", "order", "slope"),
    [
        ("u'' + c*u' + u + u**3", {"c": 2}, 3, 5),
        ("u'' + c*u' + u + u**3", {"c": 2}, 4, 7),  # odd force and even weights: there are odd weighted degrees only
        ("u'' + c*u' + d*u'**3 + u + u**2 + u**3", {"c": 2, "d": 1}, 3, 5),
        ("u'' + c*u' + d*u'**3 + 4*u + u**2", {"c": 1, "d": 1}, 2, 4),
    ],
)
def test_residual_in_the_equation_has_the_predicted_order(
    equation: str, weights: dict[str, int], order: int, slope: int
) -> None:
    oscillator = make(equation)
    flow = multiple_scales(oscillator, order, weights=weights)
    u = Reconstruction(flow).expression()
    v = along(flow, u)
    left = along(flow, v) + oscillator.force.subs({U: u, V: v}, simultaneous=True)
    sizes = []
    for h in (R(1, 200), R(1, 400)):
        at = {a: h, PHI: R(7, 10), **{symbol(n): h**w * R(3, 4) for n, w in weights.items()}}
        sizes.append(abs(left.subs(at).evalf(60)))
    assert float(sympy.log(sizes[0] / sizes[1], 2)) == pytest.approx(slope, abs=0.1)


@pytest.mark.parametrize("order", [3, 4, 5])
def test_flow_and_waveform_follow_the_motion(order: int) -> None:
    # The first frequency term left out, of degree order + 1, moves u = O(a) by O(a^(order + 2)) at a fixed time.
    own = make("u'' + c*u' + 4*u + u**2 + u**3 + d*u'**3")
    flow, errors = multiple_scales(own, order, weights={"c": 2, "d": 1}), []
    wave = Reconstruction(flow)
    for size in (0.1, 0.05):
        c, d = small = (size**2 / 4, size / 4)
        exact = runge_kutta(lambda u, v, c=c, d=d: c * v + 4 * u + u**2 + u**3 + d * v**3, (size, 0.0), 10.0, 8000)
        start = wave.start(size, 0.0, *small)
        assert wave(*start, *small) == pytest.approx(size, abs=1e-15)
        assert wave.velocity(*start, *small) == pytest.approx(0, abs=1e-15)
        found = transient(flow, [0.0, 10.0], small, amplitude=start[0], phase=start[1])
        end = found.amplitude[1], found.phase[1]
        errors.append(math.hypot(wave(*end, *small) - exact[0], (wave.velocity(*end, *small) - exact[1]) / 2))
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order + 2, abs=0.2)


def test_harmonics_of_the_damped_duffing_oscillator() -> None:
    # At weighted degree 3: u_3 = a^3 cos(3 phi)/32 (Nayfeh and Mook 1979, 2.3); damping brings a sine at degree 5.
    wave = Reconstruction(multiple_scales(make("u'' + c*u' + 4*u + 4*u**3"), 4))
    third = next(h for h in wave.harmonics if h.multiple == 3)
    assert third.cosine[0].powers == (3, 0)
    assert third.cosine[0].coefficient == R(1, 32)
    assert [t.powers for t in third.sine] == [(3, 1)]
    assert wave.latex()[0] == (
        r"u = a \cos \varphi + C_{3} \cos 3 \varphi + S_{3} \sin 3 \varphi + C_{5} \cos 5 \varphi"
    )
    assert all(text.startswith("<math") for text in wave.mathml())
    assert wave.to_dict()["harmonics"][0]["cosine"] == [{"powers": {"a": 1, "c": 0}, "coefficient": "1"}]  # type: ignore[index]


def test_evaluation_is_the_expression() -> None:
    flow = multiple_scales(make("u'' + c*u' + d*u'**3 + 4*u + u**2 + u**3"), 4)
    wave, at = Reconstruction(flow), (0.3, 1.1, 0.02, 0.05)
    names = dict(zip((a, PHI, c, d), at, strict=True))
    assert wave(*at) == pytest.approx(float(wave.expression().subs(names)), rel=1e-14)
    assert wave.velocity(*at) == pytest.approx(float(wave.velocity_expression().subs(names)), rel=1e-14)
    with pytest.raises(InputError, match="start closer to rest"):
        wave.start(50.0, 0.0, 0.0, 0.0)


def test_every_state_within_reach_leads_back_to_its_amplitude_and_phase() -> None:
    """All round, and where the iteration stops at a step of rounding that it repeats for ever."""
    wave = Reconstruction(multiple_scales(make("u'' + u/4 + u**3"), 6))
    for size, phase in [(0.2590584296583863, 3.1229387039284706), *((n / 700, n - 100.0) for n in range(7, 200))]:
        found = wave.start(wave(size, phase), wave.velocity(size, phase))
        assert found[0] == pytest.approx(size, rel=1e-14)
        assert math.remainder(found[1] - phase, 2 * math.pi) == pytest.approx(0, abs=1e-13)


def test_complex_slow_flow_is_both_equations() -> None:
    flow = multiple_scales(make("u'' + c*u' + u + u**2 + u**3"), 4)
    z = sympy.Symbol("z")
    value = R(1, 5) * (1 + 2 * sympy.I)
    found = sympy.expand(flow.complex_expression().subs(z, value))
    size = 2 * sympy.Abs(value)
    assert same(found, (flow.growth_rate_expression() + sympy.I * flow.frequency_expression()).subs(a, size))
