"""Slow flows: any ordering of small parameters, any natural frequency, limit cycles, transients, reconstruction.

The slow twin writes k out and works with monomials z^p zbar^q in SymPy; it shares no code with the engine.
"""

import math
from dataclasses import replace
from itertools import pairwise, product

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.polys.rings import xring

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.expansion.cost import Budget, predict, weighted_monomials
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.fixed_points import cycle_series, fixed_points, frequency_series, root_series
from ridgeback.symbolic.flow.limits import flow_limits
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import ordered, small_parameters
from ridgeback.symbolic.flow.reach import reach_of
from ridgeback.symbolic.flow.reconstruction import PHI, Reconstruction, along
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.transient import PHASE, START, TIME, closed_form, transient
from ridgeback.symbolic.series.trigonometric import harmonic
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V


def make(equation: str, **parameters: object) -> Oscillator:
    return Oscillator.from_equation(equation, parameters=parameters)  # type: ignore[arg-type]


def symbol(name: str) -> sympy.Symbol:
    return sympy.Symbol(name, real=True)


a, c, d, eps, g, mu = (symbol(name) for name in ("a", "c", "d", "eps", "g", "mu"))
R = sympy.Rational


def same(first: sympy.Expr, second: sympy.Expr) -> bool:
    return bool(sympy.expand(first - second) == 0)


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


# -- ordering --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("equation", "names"),
    [
        ("u'' + c*u' + u", ("c",)),
        ("u'' + 2*mu*u' + sin(u)", ("mu",)),
        ("u'' + zeta*w*u' + w**2*u", ("zeta",)),
        ("u'' + c1*u' + c3*u'**3 + u + b*u**2", ("c1", "c3")),
        ("u'' - eps*(1 - b*u**2)*u' + u", ("eps",)),
        ("u'' + p*q*u' + u", ("p",)),
        ("u'' + u + g*u**3", ()),
        ("u'' + u + g*u*u'**2", ()),
        ("u'' + u + e*(u**3 - u')", ("e",)),
    ],
)
def test_parameters_that_are_small_by_default(equation: str, names: tuple[str, ...]) -> None:
    assert small_parameters(make(equation)) == names


def test_weights_say_which_terms_are_kept() -> None:
    own = make("u'' + c*u' + d*u'**3 + u + g*u**3")
    for weights in ({"c": 1, "d": 1}, {"c": 3, "d": 2}, {"c": 2, "d": 1, "g": 1}):
        flow, wide = multiple_scales(own, 6, weights=weights), multiple_scales(own, 12, weights=weights)
        for mine, other in ((flow.frequency, wide.frequency), (flow.growth_rate, wide.growth_rate)):
            degrees = [
                t.powers[0] + sum(w * r for w, r in zip(weights.values(), t.powers[1:], strict=True)) for t in mine
            ]
            assert degrees == sorted(degrees)
            assert max(degrees, default=0) <= 6
            assert mine == other[: len(mine)]


def test_one_ordering_is_contained_in_another() -> None:
    # Whatever the weights, a coefficient that both flows keep is the same number.
    own = make("u'' + c*u' + d*u'**3 + u + u**3")
    flows = [multiple_scales(own, 8, weights={"c": p, "d": q}) for p, q in ((1, 1), (2, 2), (1, 3))]
    tables = [{t.powers: t.coefficient for t in flow.growth_rate} for flow in flows]
    for other in tables[1:]:
        shared = set(tables[0]) & set(other)
        assert len(shared) >= 3
        assert all(tables[0][powers] == other[powers] for powers in shared)


def test_weight_zero_makes_a_coefficient_of_a_parameter() -> None:
    own = make("u'' + c*u' + d*u'**3 + u", c=None, d="1/3")
    flow = multiple_scales(own, 2, weights={"d": 0})
    assert flow.variables == ("a", "c")
    assert same(flow.growth_rate_expression(), -c / 2 - a**2 / 8)


def test_terms_odd_in_the_velocity_need_no_small_parameter() -> None:
    flow = multiple_scales(make("u'' + u + u'**3 = 0"), 4)
    assert flow.variables == ("a",)
    assert same(flow.growth_rate_expression(), -3 * a**2 / 8)
    assert flow.growth_rate_at(0.5) == -0.09375
    assert flow.to_dict()["weights"] == {}


def test_json_of_one_small_parameter_keeps_its_keys() -> None:
    public = multiple_scales(find("damped-pendulum"), 2).to_dict()
    assert list(public) == ["system", "method", "amplitude", "order", "weight", "variables", "frequency", "growth_rate"]
    assert public["growth_rate"] == [{"powers": {"a": 0, "mu": 1}, "coefficient": "-1"}]
    two = multiple_scales(make("u'' + c*u' + d*u'**3 + u"), 4).to_dict()
    assert (two["variables"], two["weights"]) == (["a", "c", "d"], {"c": 2, "d": 2})


@pytest.mark.parametrize(
    ("equation", "options", "words"),
    [
        ("u'' + c*u' + u", {"weights": {"b": 1}}, "no parameter 'b'"),
        ("u'' + c*u' + u", {"weights": {"c": -1}}, "weight -1 of c"),
        ("u'' + c*u' + u", {"weights": {"c": 1.5}}, "weight 1.5 of c"),
        ("u'' + c*u' + u", {"weight": 0}, "weight 0"),
        ("u'' + c*u' + u", {"weights": {"c": 0}}, "linear damping that does not vanish"),
        ("u'' + s*u + u**3", {"weights": {"s": 1}}, "weight 0"),
    ],
)
def test_bad_orderings_are_refused(equation: str, options: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        multiple_scales(make(equation), 4, **options)  # type: ignore[arg-type]


def test_values_are_asked_for_by_name_and_number() -> None:
    flow = multiple_scales(make("u'' + c*u' + d*u'**3 + u"), 2)
    assert flow.values({"c": 1, "d": 2}) == (1, 2)
    with pytest.raises(InputError, match="d has no value"):
        flow.values({"c": 1, "d": None})
    with pytest.raises(InputError, match="1 values were given"):
        flow.growth_rate_at(0.5, 0.1)
    with pytest.raises(InputError, match="one small parameter"):
        _ = flow.small


def test_code_has_the_arguments_that_the_flow_has() -> None:
    text = generate(multiple_scales(make("u'' + u + u'**3 = 0"), 4))
    assert "def omega0(a, k=1.0)" in text
    assert "def growth_rate(a, k=1.0)" in text
    text = generate(multiple_scales(make("u'' + c*u' + d*u'**3 + u"), 4))
    assert "def omega0(a, c, d, k=1.0)" in text
    assert "d_times_k" in generate(multiple_scales(make("u'' + d*u'**3 + u"), 4))  # cubic damping falls like 1/k
    assert "def omega0(a)" in generate(multiple_scales(make("u'' + 2*u + u'**3 = 0"), 4))  # sqrt(2) stays where it is


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


def runge_kutta(force, state: tuple[float, float], end: float, count: int) -> tuple[float, float]:  # type: ignore[no-untyped-def]
    h, (u, v) = end / count, state
    for _ in range(count):
        k1 = v, -force(u, v)
        k2 = v + h / 2 * k1[1], -force(u + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = v + h / 2 * k2[1], -force(u + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = v + h * k3[1], -force(u + h * k3[0], v + h * k3[1])
        u, v = (x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip((u, v), k1, k2, k3, k4, strict=True))
    return u, v


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


# -- limit cycles ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["van-der-pol", "rayleigh"])
@pytest.mark.parametrize("k", [1, 2, "3/2"])
def test_series_of_the_fixed_point_is_lindstedts_amplitude(name: str, k: object) -> None:
    oscillator = find(name).with_parameters({"k": k})  # type: ignore[dict-item]
    flow = multiple_scales(oscillator, 18, weight=1)
    cycle = fixed_points(flow, {"eps": "1/10"})[0]
    series = lindstedt(oscillator, 5, amplitude="fundamental").amplitude_series
    assert cycle.amplitude_series == series
    value = sum(coefficient * R(1, 10) ** n for n, coefficient in enumerate(series or ()))
    assert abs(float(cycle.amplitude) - float(value)) < 1e-6
    assert cycle.stable is True


def test_unstable_cycle_of_the_backward_van_der_pol_equation() -> None:
    own = make("u'' + e*(1 - u**2)*u' + u = 0")
    (cycle,) = fixed_points(multiple_scales(own, 3, weight=1), {"e": "0.1"})
    assert (cycle.amplitude == 2, cycle.stable) == (True, False)
    assert float(cycle.slope) == pytest.approx(0.1)


def test_two_cycles_of_a_fifth_order_damping() -> None:
    # a'/a = (eps/2)(-1 + 5 a^2/4 - a^4/4) = (eps/8)(a^2 - 1)(4 - a^2): an unstable cycle at 1, a stable one at 2,
    # since u^2 u' averages to a^2/4 and u^4 u' to a^4/8.
    own = make("u'' + eps*(1 - 5*u**2 + 2*u**4)*u' + u = 0")
    flow = multiple_scales(own, 5, weight=1)
    assert same(flow.growth_rate_expression().coeff(eps, 1), (a**2 - 1) * (4 - a**2) / 8)
    assert [s[0] for s in cycle_series(multiple_scales(own, 20, weight=1))] == [1, 4]
    found = fixed_points(flow, {"eps": "1/50"})
    assert [(round(float(p.amplitude), 3), p.stable) for p in found[:2]] == [(1, False), (2, True)]


def test_hopf_bifurcation_has_an_exact_series_of_the_square() -> None:
    own = make("u'' - 2*m*u' + u + u**2 + u'**3 = 0")
    low, high = cycle_series(multiple_scales(own, 8))[0], cycle_series(multiple_scales(own, 12))[0]
    assert (len(low), len(high)) == (5, 7)
    assert high[:5] == low
    assert low[:2] == (0, R(8, 3))
    flow = multiple_scales(own, 12)
    cycle = fixed_points(flow, {"m": "1/100"})[0]
    assert cycle.stable
    assert cycle.square_series == high
    assert cycle.amplitude_series is None
    value = sum(c * R(1, 100) ** n for n, c in enumerate(high))
    assert float(cycle.amplitude**2) == pytest.approx(float(value), abs=1e-9)
    # The motion itself settles on it: after a turn from a state on the cycle the state is back.
    wave = Reconstruction(flow)
    state = wave(float(cycle.amplitude), 0.0, 0.01), wave.velocity(float(cycle.amplitude), 0.0, 0.01)
    end = runge_kutta(lambda u, v: -0.02 * v + u + u**2 + v**3, state, 2 * math.pi / float(cycle.frequency), 2000)
    assert end == pytest.approx(state, abs=2e-7)


def test_series_stop_where_the_kept_terms_stop() -> None:
    # Through higher orders the same coefficients come back: none of them is an artefact of the truncation.
    for name in ("van-der-pol", "rayleigh"):
        series = [cycle_series(multiple_scales(find(name), order, weight=1))[0] for order in (6, 9, 12, 16)]
        assert [len(s) for s in series] == [2, 3, 4, 5]
        assert all(longer[: len(s)] == s for s, longer in pairwise(series))


def test_every_zero_is_enclosed_and_a_true_zero() -> None:
    flow = multiple_scales(find("van-der-pol"), 24, weight=1)
    for value in ("0.05", "0.5", "1", "1.5"):
        cycle = fixed_points(flow, {"eps": value})[0]
        assert cycle.square_series is not None  # followed from 4 all the way
        terms = tuple(t for t in flow.growth_rate if t.powers[1] <= flow.complete)  # type: ignore[operator]
        delta = sum(flow.expressions(terms)).subs(eps, R(value))
        radius = R(1, 10**10)
        middle = R(str(float(cycle.amplitude)))
        assert delta.subs(a, middle - radius) > 0 > delta.subs(a, middle + radius)


def test_a_cycle_of_irrational_frequency_is_that_of_the_scaled_equation() -> None:
    """u'' - m (1 - u^2) u' + k^2 u in the time k t has m/k for m: here k = sqrt(2); phi' is even in m."""
    wide = multiple_scales(make("u'' - m*(1 - u**2)*u' + 2*u = 0"), 6, weight=1)
    (square,) = cycle_series(wide)
    expected = [R(4), *([0] * (len(square) - 1))]
    assert list(square) == expected
    unit = frequency_series(multiple_scales(find("van-der-pol"), 6, weight=1), (R(4), R(0)))
    scaled = [sympy.sqrt(2) * c / sympy.sqrt(2) ** n for n, c in enumerate(unit)]
    assert [sympy.simplify(a - b) for a, b in zip(frequency_series(wide, square), scaled, strict=True)] == [0] * len(
        unit
    )
    cycle = fixed_points(wide, {"m": "0.1"})[0]
    assert float(cycle.frequency) == pytest.approx(
        float(sum(c * R(1, 10) ** n for n, c in enumerate(scaled))), abs=1e-7
    )


def test_no_cycle_and_no_numbers() -> None:
    assert fixed_points(multiple_scales(find("damped-pendulum"), 4), {"mu": "0.1"}) == ()
    assert cycle_series(multiple_scales(make("u'' + c*u' + d*u'**3 + u"), 4)) == ()
    assert root_series((sympy.S.Zero, sympy.S.One)) is None
    flow = multiple_scales(make("u'' - 2*m*u' + u + b*u'**3 = 0"), 4, weights={"b": 0})
    with pytest.raises(InputError, match="no rational number"):
        fixed_points(flow, {"m": "0.1"})
    assert cycle_series(flow) == ()  # nor is there a series without the number of b
    bent = multiple_scales(make("u'' - m*(1 - u**2)*u' + u + b*u**5 = 0"), 4, weights={"b": 0, "m": 1})
    with pytest.raises(InputError, match=r"coefficient .*b.* has no number for b"):
        fixed_points(bent, {"m": "0.1"})
    with pytest.raises(InputError, match="hold symbols; give every parameter a number"):
        frequency_series(bent, (R(4), R(0)))
    with pytest.raises(InputError, match="m has no value"):
        fixed_points(flow, {})
    with pytest.raises(InputError, match="no parameter 'q'"):
        fixed_points(flow, {"m": 1, "q": 2})


# -- the reach of an order -------------------------------------------------------------------------------------------


def hardened(share: int) -> Oscillator:
    """Van der Pol's excitation on a hardening spring; its cycle grows with 1/share."""
    return Oscillator.from_equation(f"u'' - eps*(1 - {share}*u**2)*u' + u + u**3 = 0", parameters={"eps": "1/10"})


@pytest.mark.parametrize("order", [4, 8, 12])
def test_a_zero_beyond_the_reach_of_its_order_is_no_limit_cycle(order: int) -> None:
    """The true cycle of share 2 has the first harmonic 1.3432 and omega0 1.5453; the zero is at a = 1.05, 1.35."""
    (found,) = fixed_points(multiple_scales(hardened(2), order, weight=1), {"eps": "1/10"})
    assert found.reach.beyond
    assert found.stable is None
    public = found.to_dict()
    assert (public["beyond_reach"], public["stable"], public["slope"]) == (True, None, None)


@pytest.mark.parametrize(("share", "omega"), [(12, 1.1139), (20, 1.0707)])
def test_a_zero_within_reach_is_near_the_true_limit_cycle(share: int, omega: float) -> None:
    (found,) = fixed_points(multiple_scales(hardened(share), 8, weight=1), {"eps": "1/10"})
    assert not found.reach.beyond
    assert found.stable is True
    assert float(found.frequency) == pytest.approx(omega, rel=1e-3)


def test_the_limits_of_the_frequency_are_the_limits_of_its_fixed_points() -> None:
    own = find("van-der-pol").with_parameters({"eps": 3})
    flow = multiple_scales(own, 4, weight=1)
    assert not fixed_points(flow, {"eps": 3})[0].reach.beyond  # one power alone has nothing to judge by
    (found,) = fixed_points(flow, {"eps": 3}, limits=flow_limits(own, flow).limits)
    assert "outside the circle of convergence" in found.reach.why
    assert found.stable is None


def test_states_of_a_decay_are_judged_by_the_terms_that_change_them() -> None:
    flow = multiple_scales(find("damped-pendulum"), 6)
    assert not reach_of(flow, 1.0, (0.01,)).beyond
    assert reach_of(flow, 3.0, (0.01,)).beyond
    assert reach_of(multiple_scales(find("linear"), 4), 100.0, (0.0,)).change in (None, 0.0)


def test_the_limits_of_a_self_excited_flow_are_those_of_its_conservative_part() -> None:
    own = Oscillator.from_equation("u'' - eps*(1 - u**2)*u' + sin(u) = 0", parameters={"eps": "1/10"})
    found = flow_limits(own, multiple_scales(own, 4, weight=1))
    assert found.limits is not None
    assert found.limits.radius == pytest.approx(4.0, rel=0.05)


# -- transients ------------------------------------------------------------------------------------------------------


CLOSED = {
    "linear decay": ("u'' + c*u' + u + u**3", 2, 2),
    "linear decay of small weight": ("u'' + c*u' + u + u**3", 4, 4),
    "decay that depends on the amplitude": ("u'' + 2*mu*u' + sin(u)", 4, 2),
    "van der Pol": ("u'' - eps*(1 - u**2)*u' + u + u**3", 3, 1),
    "cubic damping alone": ("u'' + eps*u'**3 + u + u**3", 4, 2),
    "conservative": ("u'' + u + u**3", 6, 2),
}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_forms_solve_the_slow_flow_and_meet_the_taylor_steps(name: str) -> None:
    equation, order, weight = CLOSED[name]
    flow = multiple_scales(make(equation), order, weight=weight)
    found = closed_form(flow)
    assert found is not None
    small = {symbol(n): R(1, 10) for n in flow.small_parameters}
    numbers = {START: R(4, 5), PHASE: R(1, 3), **small}
    amplitude, phase = found.amplitude.subs(numbers), found.phase.subs(numbers)
    for t in (R(0), R(3), R(17, 2)):
        now = {a: amplitude.subs(TIME, t), **small}
        rate = (flow.growth_rate_expression() * a).subs(now), flow.frequency_expression().subs(now)
        assert abs((amplitude.diff(TIME).subs(TIME, t) - rate[0]).evalf(40)) < 1e-35
        assert abs((phase.diff(TIME).subs(TIME, t) - rate[1]).evalf(40)) < 1e-35
    assert (amplitude.subs(TIME, 0), sympy.simplify(phase.subs(TIME, 0))) == (R(4, 5), R(1, 3))
    for part, first in ((0.1, 0.8), (1e-6, 0.03)):  # weak damping takes its time and is no smaller against the rest
        numbers = {START: R(first), PHASE: R(1, 3), **{symbol(n): R(part) for n in flow.small_parameters}}
        times = [0.0, *(t * 0.1 / part for t in (3.0, 8.5, 50.0, 600.0))]
        steps = transient(flow, times, [part] * len(small), amplitude=first, phase=1 / 3)
        for t, size, angle in zip(times, steps.amplitude, steps.phase, strict=True):
            now = {**numbers, TIME: R(t)}
            assert size == pytest.approx(float(found.amplitude.subs(now).evalf(30)), rel=1e-11)
            assert angle == pytest.approx(float(found.phase.subs(now).evalf(30)), rel=1e-12, abs=1e-11)
    assert all(text.startswith(start) for text, start in zip(found.latex(), ("a(t) =", r"\varphi(t) ="), strict=True))


def test_a_flow_of_higher_degree_has_no_closed_form_but_steps() -> None:
    flow = multiple_scales(find("damped-duffing"), 8)
    assert closed_form(flow) is None
    coarse = transient(flow, [0.0, 20.0], [0.05], amplitude=0.6)
    fine = transient(flow, [0.05 * n for n in range(401)], [0.05], amplitude=0.6)
    assert coarse.amplitude[1] == pytest.approx(fine.amplitude[-1], rel=1e-12)
    assert coarse.phase[1] == pytest.approx(fine.phase[-1], abs=1e-11)


@pytest.mark.parametrize("eps", [-1e-6, -0.1, 0.1, 1e-6])
@pytest.mark.parametrize("start", [0.01, 0.5, 1.99])
def test_a_transient_of_any_speed_is_bernoullis(eps: float, start: float) -> None:
    """a' = eps a (1 - a^2/4)/2: a^2/(4 - a^2) grows as exp(eps t), at rest and next to the cycle as well."""
    flow, time = multiple_scales(find("van-der-pol"), 4), 2 / abs(eps)
    found = transient(flow, [0.0, time], [eps], amplitude=start)
    grown = start**2 / (4 - start**2) * math.exp(eps * time)
    assert found.amplitude[1] == pytest.approx(math.sqrt(4 * grown / (1 + grown)), rel=1e-11)
    assert found.phase[1] == pytest.approx((1 - eps**2 / 8) * time, rel=1e-11)


def test_without_damping_a_transient_keeps_its_amplitude() -> None:
    found = transient(multiple_scales(find("damped-pendulum"), 2), [0.0, 10.0], [0.0], amplitude=0.5)
    assert found.amplitude == (0.5, 0.5)
    assert found.phase[1] == pytest.approx(10.0 * (1 - 0.5**2 / 16), rel=1e-15)


def test_the_time_said_to_fit_fits_and_is_not_far_from_the_last_one() -> None:
    flow, most = multiple_scales(make("u'' + sin(u)"), 2), 2.0**52 * 1e-6
    with pytest.raises(InputError, match="too large for its cosine") as refused:
        transient(flow, [0.0, 1e9, 1e10], [], amplitude=0.1)
    fits = float(str(refused.value).split("t = ")[2].split()[0])
    found = transient(flow, [0.0, 1e9, fits], [], amplitude=0.1)
    assert 0.85 * most < found.phase[-1] <= most


def test_bad_transients_are_refused() -> None:
    flow = multiple_scales(make("u'' + u + u'**3 - u'**5 = 0"), 4)
    with pytest.raises(InputError, match="runs away"):
        transient(flow, [0.0, 1e6], [], amplitude=2.0)
    with pytest.raises(InputError, match="rise"):
        transient(flow, [1.0, 0.0], [], amplitude=0.1)
    with pytest.raises(InputError, match="finite"):
        transient(flow, [0.0, math.inf], [], amplitude=0.1)
    with pytest.raises(InputError, match="not a positive number"):
        transient(flow, [0.0, 1.0], [], amplitude=-1.0)


def test_the_share_that_is_told_rises_with_the_fourth_power_of_the_degree() -> None:
    told: list[tuple[float, str]] = []
    multiple_scales(find("damped-pendulum"), 5, progress=lambda share, step: told.append((share, step)))
    assert [share for share, _ in told] == [(n / 6) ** 4 for n in range(2, 7)]
    assert told[0][1] == "weighted degree 2 of 5"


# -- cost ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("weights", [(2,), (1, 1), (2, 3), (2, 2, 1)])
def test_monomials_are_counted_well_enough(weights: tuple[int, ...]) -> None:
    powers = product(*(range(30 // w + 1) for w in weights))
    exact = sum(sum(w * r for w, r in zip(weights, rs, strict=True)) <= 30 for rs in powers)
    assert weighted_monomials(30, weights) == pytest.approx(exact, rel=0.06)


def test_more_small_parameters_cost_more_and_are_refused_before_the_work() -> None:
    one, two = (predict("multiple-scales", 40, weights=w).seconds for w in ((2,), (2, 2)))
    assert two > 4 * one
    with pytest.raises(InputError, match=r"order 1000000 by multiple-scales"):
        multiple_scales(make("u'' + c*u' + d*u'**3 + b*u**2*u' + u + g*u**3"), 10**6)
    with pytest.raises(InputError, match=r"order 60 by multiple-scales .* order \d+ fits"):
        multiple_scales(make("u'' + c*u' + d*u'**3 + b*u**2*u' + u + g*u**3"), 60, budget=Budget(seconds=1))
