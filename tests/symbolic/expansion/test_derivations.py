"""The three routes to omega0 against published coefficients, against each other, and against a slow obvious twin."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import first_harmonic
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.fixed_points import cycle_series
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.series.trigonometric import at_zero
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U


def rationals(*values: str) -> tuple[sympy.Rational, ...]:
    return tuple(sympy.Rational(v) for v in values)


def even(values: tuple[sympy.Expr, ...]) -> tuple[sympy.Expr, ...]:
    assert all(c == 0 for c in values[1::2])
    return values[::2]


PUBLISHED = {
    # Pendulum: the expansion of pi / (2 K(sin(A/2))); Duffing: Nayfeh and Mook (1979), 4.1; van der Pol: Andersen and
    # Geer (1982), table 1.
    "pendulum": ("1", "-1/16", "1/3072", "-23/737280", "-2519/1321205760"),
    "duffing": ("1", "3/8", "-21/256", "81/2048", "-6549/262144"),
    "van-der-pol": ("1", "-1/16", "17/3072", "35/884736", "-678899/5096079360"),
    "rayleigh": ("1", "-1/16", "17/3072", "35/884736", "-678899/5096079360"),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_published_frequency_coefficients(name: str) -> None:
    assert even(lindstedt(find(name), 8).frequency) == rationals(*PUBLISHED[name])


def test_a_series_is_headed_by_its_variable() -> None:
    own = replace(Oscillator.from_equation("u'' - m*(1 - u**2)*u' + u = 0"), small="m", damping=None)
    for oscillator, name in ((find("van-der-pol"), r"\varepsilon"), (own, "m"), (find("duffing"), "A")):
        series = lindstedt(oscillator, 2)
        (formula,) = series.formulas()
        assert formula.startswith(rf"\omega_0({name}) = 1")
        assert series.picture().x_label == {"A": "A (peak)", "m": "m"}.get(name, "eps")


@pytest.mark.parametrize("equation", ["u'' + sin(u) = 0", "u'' + 2*u + u**3 = 0", "u'' + pi**2*u + u**3/3 = 0"])
def test_in_multiple_precision_a_series_is_its_enclosure(equation: str) -> None:
    series = lindstedt(Oscillator.from_equation(equation), 6)
    with mpmath.workdps(40), ctx.workprec(200):
        found = series(mpmath.mpf(1) / 4)
        assert abs(arb(mpmath.nstr(found, 45)) / series.in_balls(arb(1) / 4) - 1) < arb(10) ** -39
    interval = mpmath.iv.mpf(1) / 4
    if equation.startswith("u'' + sin"):
        assert series(interval).a <= series(0.25) <= series(interval).b
    else:
        with pytest.raises(InputError, match="irrational"):
            series(interval)


def test_u_in_other_units_leaves_the_frequency_of_a_limit_cycle() -> None:
    """With w = 4 u/3 it is van der Pol's, also where the first amplitude is a fraction, 3/2."""
    own, slow = lindstedt("u'' - eps*(1 - 16/9*u**2)*u' + u = 0", 4), lindstedt(find("van-der-pol"), 4)
    assert own.frequency == slow.frequency
    assert own.amplitude_series == tuple(sympy.Rational(3, 4) * c for c in slow.amplitude_series or ())
    flow = multiple_scales(Oscillator.from_equation("u'' - eps*(1 - 16/9*u**2)*u' + u = 0"), 6, weight=1)
    assert cycle_series(flow)[0][0] == sympy.Rational(9, 4)


def test_time_in_other_units_leaves_the_amplitude_of_a_limit_cycle() -> None:
    """With tau = 2 t, eps of u'' - 2 eps (1 - u^2) u' + 4 u = 0 is that of van der Pol."""
    own = Oscillator.from_equation("u'' - 2*eps*(1 - u**2)*u' + 4*u = 0")
    fast, slow = lindstedt(own, 4), lindstedt(find("van-der-pol"), 4)
    assert fast.amplitude_series == slow.amplitude_series
    assert fast.frequency == tuple(2 * c for c in slow.frequency)


def test_van_der_pol_peak_amplitude_is_the_published_series() -> None:
    series = lindstedt(find("van-der-pol"), 4).amplitude_series
    assert series is not None
    assert series == rationals("2", "0", "1/96", "0", "-1033/552960")


def test_van_der_pol_first_harmonic_amplitude_agrees_with_the_converted_waveform() -> None:
    peak, fundamental = (lindstedt(find("van-der-pol"), 10, amplitude=d) for d in ("peak", "fundamental"))
    assert peak.coefficients == fundamental.coefficients
    # Both waveforms are one orbit, shifted in phase: the squared size of each harmonic agrees.
    for multiple in (1, 3, 5):
        assert squared_size(peak, multiple) == squared_size(fundamental, multiple)


def squared_size(expansion, multiple: int) -> sympy.Expr:
    eps = sympy.Symbol("eps")
    found = next(h for h in expansion.harmonics if h.multiple == multiple)
    sizes = [sum(c * eps**n for n, c in enumerate(part)) for part in (found.cosine, found.sine)]
    square = sympy.expand(sizes[0] ** 2 + sizes[1] ** 2)
    return sum(square.coeff(eps, n) * eps**n for n in range(expansion.order + 1))


def test_slow_flow_of_the_damped_pendulum() -> None:
    flow = multiple_scales(find("pendulum"), 4)
    assert {t.powers: t.coefficient for t in flow.frequency} == {
        (0, 0): 1,
        (2, 0): sympy.Rational(-1, 16),
        (4, 0): sympy.Rational(1, 1024),
        (0, 1 + 1): sympy.Rational(-1, 2),
    }
    assert {t.powers: t.coefficient for t in flow.growth_rate} == {(0, 1): -1, (2, 1): sympy.Rational(-1, 16)}


def test_slow_flow_of_the_damped_duffing_oscillator_is_right_at_third_order() -> None:
    # u'' + u + g u^3 + c u' = 0 with c = 2 mu, g = 1, where non-commuting slow times spoil other derivations.
    flow = multiple_scales(find("duffing"), 6)
    c = sympy.Symbol("c")
    a, mu = (sympy.Symbol(name, real=True) for name in ("a", "mu"))
    expected = (
        1 + 3 * a**2 / 8 - (15 * a**4 + 32 * c**2) / sympy.Integer(256) + 3 * a**2 * (41 * a**4 - 128 * c**2) / 8192
    )
    assert sympy.expand(flow.frequency_expression() - expected.subs(c, 2 * mu)) == 0
    decay = -c / 2 + 3 * c * a**2 / 16 - 195 * c * a**4 / 1024
    assert sympy.expand(flow.growth_rate_expression() - decay.subs(c, 2 * mu)) == 0


def test_linear_damping_gives_the_square_root_of_one_minus_mu_squared() -> None:
    flow = multiple_scales(find("linear"), 12)
    mu = sympy.Symbol("mu", real=True)
    exact = sympy.series(sympy.sqrt(1 - mu**2), mu, 0, 8).removeO()
    assert sympy.expand(flow.frequency_expression() - exact) == 0
    assert flow.growth_rate_expression() == -mu


def test_limit_cycle_is_the_fixed_point_of_its_slow_flow() -> None:
    # a'/a = 0 at the fundamental amplitude of the limit cycle, and phi' there is its frequency.
    flow, cycle = (
        multiple_scales(find("van-der-pol"), 12, weight=1),
        lindstedt(find("van-der-pol"), 4, amplitude="fundamental"),
    )
    eps = sympy.Symbol("eps", real=True)
    a = sum(c * eps**n for n, c in enumerate(cycle.amplitude_series or ()))
    damping = sympy.expand(flow.growth_rate_expression().subs(sympy.Symbol("a", real=True), a))
    frequency = sympy.expand(flow.frequency_expression().subs(sympy.Symbol("a", real=True), a))
    # Terms eps^n a^(2n) have degree 3n: order 12 keeps all of them through eps^4.
    assert [damping.coeff(eps, n) for n in (1, 2, 3)] == [0, 0, 0]
    assert [frequency.coeff(eps, n) for n in range(4)] == list(cycle.frequency[:4])


CONSERVATIVE = ("pendulum", "duffing-hardening", "duffing-softening", "helmholtz-duffing", "linear")


@pytest.mark.parametrize("name", CONSERVATIVE)
def test_energy_integral_certifies_lindstedt(name: str) -> None:
    assert energy_integral(find(name), 14).frequency == lindstedt(find(name), 14).frequency


@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("name", CONSERVATIVE)
def test_the_lowest_orders_are_the_natural_frequency(name: str, order: int) -> None:
    expected = (1, *[0] * order)
    for definition in ("peak", "trough", "action", "energy"):
        assert energy_integral(find(name), order, amplitude=definition).frequency == expected
        assert lindstedt(find(name), order, amplitude=definition).frequency == expected
    assert multiple_scales(find(name), order).frequency_expression() == 1


@pytest.mark.parametrize("name", CONSERVATIVE)
def test_multiple_scales_without_damping_is_lindstedt_in_the_fundamental_amplitude(name: str) -> None:
    flow = multiple_scales(find(name), 10)
    undamped = {t.powers[0]: t.coefficient for t in flow.frequency if t.powers[1] == 0}
    series = lindstedt(find(name), 10, amplitude="fundamental").frequency
    assert undamped == {n: c for n, c in enumerate(series) if c != 0}


@pytest.mark.parametrize("name", CONSERVATIVE)
def test_conversion_of_amplitudes_is_exact_both_ways(name: str) -> None:
    peak, fundamental = (lindstedt(find(name), 9, amplitude=d) for d in ("peak", "fundamental"))
    assert peak.convert("fundamental").coefficients == fundamental.coefficients
    assert fundamental.convert("peak").coefficients == peak.coefficients
    assert peak.convert("fundamental").waveform == fundamental.waveform
    assert peak.convert("fundamental").residual() == []


@pytest.mark.parametrize("name", ["pendulum", "duffing", "helmholtz-duffing", "van-der-pol", "rayleigh"])
def test_residual_vanishes_and_notices_a_wrong_coefficient(name: str) -> None:
    expansion = lindstedt(find(name), 6)
    assert expansion.residual() == []
    wrong = list(expansion.coefficients)
    wrong[2] = wrong[2] + fmpq(1, 10**9)
    assert replace(expansion, coefficients=tuple(wrong)).residual() != []


@pytest.mark.parametrize("name", ["pendulum", "helmholtz-duffing", "van-der-pol"])
def test_slow_flow_residual_vanishes_and_notices_a_wrong_coefficient(name: str) -> None:
    flow = multiple_scales(find(name), 6)
    assert flow.residual() == []
    wrong = list(flow.delta)
    wrong[-1] = wrong[-1] + fmpq(1, 10**9)
    assert replace(flow, delta=tuple(wrong)).residual() != []


@pytest.mark.parametrize("name", CONSERVATIVE)
def test_initial_conditions_hold_at_every_order(name: str) -> None:
    peak = lindstedt(find(name), 8)
    fundamental = lindstedt(find(name), 8, amplitude="fundamental")
    assert peak.waveform is not None
    assert fundamental.waveform is not None
    assert [at_zero(p) for p in peak.waveform[2:]] == [0] * 8
    assert [at_zero(p.derivative()) for p in peak.waveform] == [0] * 10
    assert [first_harmonic(p) for p in fundamental.waveform[2:]] == [0] * 8


def test_mean_offset_of_a_quadratic_force() -> None:
    # u'' + u + alpha2 u^2: mean -alpha2 a^2 / 2 (Nayfeh and Mook 1979, 2.3.1).
    own = Oscillator.from_equation("u'' + u + alpha2*u**2", parameters={"alpha2": 3})
    mean = lindstedt(own, 4, amplitude="fundamental").harmonics[0]
    assert mean.multiple == 0
    assert mean.cosine[2] == sympy.Rational(-3, 2)


def test_symbolic_parameters_stay_exact() -> None:
    own = Oscillator.from_equation("u'' + u + alpha2*u**2 + alpha3*u**3")
    a2, a3 = (sympy.Symbol(name, real=True) for name in ("alpha2", "alpha3"))
    series = lindstedt(own, 4)
    assert sympy.expand(series.frequency[2] - (3 * a3 / 8 - 5 * a2**2 / 12)) == 0
    assert series.residual() == []
    assert series.frequency == energy_integral(own, 4).frequency
    assert series.convert("fundamental").coefficients == lindstedt(own, 4, amplitude="fundamental").coefficients


def test_natural_frequency_scales_every_coefficient() -> None:
    # u'' + 4 u + eps u^3: 2 + 3 eps/16 A^2 - 21 eps^2/2048 A^4 (a natural frequency other than 1 must not be ignored).
    own = Oscillator.from_equation("u'' + 4*u + eps*u**3", parameters={"eps": 1})
    assert even(lindstedt(own, 4).frequency) == rationals("2", "3/16", "-21/2048")
    doubled = find("van-der-pol").with_parameters({"k": 2})
    assert even(lindstedt(doubled, 4).frequency) == rationals("2", "-1/32", "17/24576")


def test_conservative_velocity_terms_carry_omega() -> None:
    # u'' + u + u u'^2 at peak amplitude A: 1 + A^2/8 + 3 A^4/256 + A^6/6144.
    own = Oscillator.from_equation("u'' + u + u*u'**2")
    assert even(lindstedt(own, 6).frequency) == rationals("1", "1/8", "3/256", "1/6144")


def test_frequency_in_action_amplitude_of_the_pendulum() -> None:
    # J = A^2/2 - A^4/64 + ...: dJ/dE = 1/omega.  Check d E/d J = omega by series, E = 1 - cos A.
    action = energy_integral(find("pendulum"), 12, amplitude="action").frequency
    j = sympy.Symbol("J")
    omega_of_j = sum(c * (2 * j) ** sympy.Rational(n, 2) for n, c in enumerate(action) if c)
    energy = sympy.integrate(sympy.expand(omega_of_j), j)
    # Known: E(J) = J - J^2/16 - J^3/256 - 5 J^4/8192 - ... for H = p^2/2 + 1 - cos q.
    assert [energy.coeff(j, n) for n in (1, 2, 3, 4)] == list(rationals("1", "-1/16", "-1/256", "-5/8192"))


@pytest.mark.parametrize("name", CONSERVATIVE)
@pytest.mark.parametrize("definition", ["peak", "trough", "action", "energy"])
def test_every_definition_agrees_with_the_energy_integral_and_converts_back(name: str, definition: str) -> None:
    converted = lindstedt(find(name), 8, amplitude=definition)
    assert converted.difference(energy_integral(find(name), 8, amplitude=definition)) == (0,) * 9
    assert converted.residual() == []
    assert converted.convert("peak").coefficients == lindstedt(find(name), 8).coefficients


def test_trough_is_the_mirrored_oscillator() -> None:
    own = Oscillator.from_equation("u'' + u + u**2/3 + u**3/5")
    mirrored = Oscillator.from_equation("u'' + u - u**2/3 + u**3/5")
    assert energy_integral(own, 9, amplitude="trough").frequency == lindstedt(mirrored, 9).frequency


@pytest.mark.parametrize(
    "equation",
    ["u'' + u**2 + u", "u'' + sin(u) + u**2*cos(u)/4", "u'' + tanh(u)", "u'' + u/(1 + u**2)", "u'' + log(1 + u)",
     "u'' + exp(u) - 1", "u'' + sinh(u)*cosh(u)", "u'' + sqrt(1 + u) - 1", "u'' + tan(u)", "u'' + u*(1 + u)**(-3/2)",
     "u'' + asin(u)", "u'' + atan(u + u**2)", "u'' + asinh(u)*exp(u)", "u'' + atanh(u)"],
)  # fmt: skip
def test_every_function_rule_agrees_between_the_routes(equation: str) -> None:
    own = Oscillator.from_equation(equation)
    series = lindstedt(own, 8)
    assert series.frequency == energy_integral(own, 8).frequency
    assert series.residual() == []


@pytest.mark.parametrize("force", ["asin(u)", "atan(u)", "asinh(u)", "atanh(u)", "tan(u)", "tanh(u)"])
def test_a_function_and_its_taylor_polynomial_by_sympy_have_one_expansion(force: str) -> None:
    own = Oscillator.from_equation(f"u'' + {force}")
    polynomial = sympy.series(own.force, U, 0, 8).removeO()
    twin = Oscillator.from_equation(f"u'' + {polynomial}")
    assert lindstedt(own, 6).frequency == lindstedt(twin, 6).frequency


coefficient = st.fractions(min_value=-2, max_value=2, max_denominator=6)


@given(st.lists(coefficient, min_size=1, max_size=5))
@settings(max_examples=25, deadline=None)
def test_any_polynomial_force_agrees_between_the_routes(values: list[Fraction]) -> None:
    text = "u'' + u" + "".join(f" + ({c.numerator}/{c.denominator})*u**{n}" for n, c in enumerate(values, 2))
    own = Oscillator.from_equation(text)
    peak = lindstedt(own, 7)
    assert peak.frequency == energy_integral(own, 7).frequency
    flow = multiple_scales(own, 7)
    converted = peak.convert("fundamental").frequency
    assert {t.powers[0]: t.coefficient for t in flow.frequency} == {n: c for n, c in enumerate(converted) if c != 0}


def slow_twin(force_series: list[sympy.Rational], order: int) -> list[sympy.Expr]:
    """Textbook Lindstedt-Poincaré by SymPy with complex exponentials: one order at a time, all products expanded."""
    e, amp = sympy.symbols("e A")  # e = exp(i tau)
    u = amp * (e + 1 / e) / 2
    square = sympy.Integer(1)

    def second(p: sympy.Expr) -> sympy.Expr:
        return sympy.expand(-e * sympy.diff(e * sympy.diff(p, e), e))

    for n in range(2, order + 2):
        w = sympy.Symbol("w")
        trial = square + w * amp ** (n - 1)
        total = sympy.expand(trial * second(u) + sum(c * u**m for m, c in enumerate(force_series)))
        now = total.coeff(amp, n)
        (root,) = sympy.solve(now.coeff(e, 1), w)
        square, now = square + root * amp ** (n - 1), sympy.expand(now.subs(w, root))
        new = sum(now.coeff(e, m) / sympy.Integer(m * m - 1) * e**m for m in range(-n, n + 1) if abs(m) != 1)
        offset = -new.subs(e, 1) / 2 if new != 0 else 0
        u = sympy.expand(u + amp**n * (new + offset * (e + 1 / e)))
    root = sympy.series(sympy.sqrt(square), amp, 0, order + 1).removeO()
    return [sympy.expand(root).coeff(amp, n) for n in range(order + 1)]


@pytest.mark.parametrize("values", [["0", "1", "0", "-1/6", "0", "1/120"], ["0", "1", "1/2", "2/3"]])
def test_slow_twin_by_complex_exponentials(values: list[str]) -> None:
    names = " + ".join(f"({c})*u**{n}" for n, c in enumerate(values) if n)
    own = Oscillator.from_equation(f"u'' + {names}")
    assert list(lindstedt(own, 5).frequency) == slow_twin([sympy.Rational(v) for v in values], 5)
