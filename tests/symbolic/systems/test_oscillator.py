"""The oscillator as a value: exact parameters, natural units, potentials, and what is refused at the origin."""

import pickle
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V, W
from ridgeback.symbolic.systems.structure import solved_for_acceleration

QUICK = settings(deadline=None, max_examples=60)
mu, eps, k = (sympy.Symbol(name, real=True) for name in ("mu", "eps", "k"))
make = Oscillator.from_equation


def taylor(force, start, degree):
    """Taylor coefficients of the solution of u'' = -f by repeated total differentiation: slow and obvious."""
    derivative, coefficients = V, [start[U]]
    for n in range(1, degree + 1):
        coefficients.append(sympy.expand(derivative.subs(start) / sympy.factorial(n)))
        derivative = derivative.diff(U) * V - derivative.diff(V) * force
    return coefficients


# --- natural units --------------------------------------------------------------------------------------------------

RATIONAL = [
    ("u'' + 2*mu*u' + k**2*u + eps*u**3", {"k": 3, "mu": "1/7", "eps": "0.4"}),
    ("u'' - eps*(1 - u**2)*u' + k**2*u", {"k": "5/2", "eps": "0.3"}),
    ("u'' - eps*(1 - u'**2/3)*u' + k**2*u", {"k": "5/2", "eps": "0.3"}),
    ("3*u'' + u + u**2*u'**2/5 - k*u*u'**2", {"k": "7/3"}),
    ("(1 + u**2)*u'' + 9*u/4 + u*u'**2", {}),
]


@pytest.mark.parametrize(("text", "values"), RATIONAL, ids=lambda value: str(value)[:24])
def test_natural_units_only_rescale_time(text, values):
    """u(t) = x(k t): the n-th Taylor coefficient of u is k**n times that of x."""
    own = make(text, parameters=values)
    natural = own.normalised
    scale, u0, w0 = natural.scale, sympy.Rational(2, 5), sympy.Rational(-3, 4)
    in_time = taylor(own.substituted_force, {U: u0, V: scale * w0}, 4)
    in_natural_time = taylor(natural.bound, {U: u0, V: w0}, 4)
    for n, (ours, theirs) in enumerate(zip(in_time, in_natural_time, strict=True)):
        assert sympy.expand(ours - scale**n * theirs) == 0


@pytest.mark.parametrize(("text", "values"), RATIONAL, ids=lambda value: str(value)[:24])
def test_in_natural_units_the_linear_frequency_is_one(text, values):
    natural = make(text, parameters=values).normalised
    assert natural.force.diff(U).subs({U: 0, V: 0}) == 1
    assert natural.bound.subs({U: 0, V: 0}) == 0


def test_the_exact_damped_linear_solution_solves_the_equation_before_and_after_scaling():
    t, tau = sympy.symbols("t tau", real=True)
    own = find("damped-linear").with_parameters({"k": "5", "mu": "3"})
    natural = own.normalised
    x = sympy.exp(-3 * t) * sympy.cos(4 * t)
    assert sympy.expand(x.diff(t, 2) + own.substituted_force.subs({U: x, V: x.diff(t)}, simultaneous=True)) == 0
    y = x.subs(t, tau / 5)
    assert sympy.expand(y.diff(tau, 2) + natural.bound.subs({U: y, V: y.diff(tau)}, simultaneous=True)) == 0
    assert natural.damping == sympy.Rational(3, 5)


@pytest.mark.parametrize(
    "system", ["pendulum", "damped-duffing", "damped-helmholtz-duffing", "van-der-pol", "rayleigh"]
)
@pytest.mark.parametrize("value", ["12.566370614359172", "1/3", "7"])
def test_rational_parameters_stay_rational_and_the_small_parameter_stays_a_symbol(system, value):
    natural = find(system).with_parameters({"k": value}).normalised
    assert all(number.is_Rational for number in natural.force.atoms(sympy.Number))
    assert natural.force.free_symbols <= {U, V, mu, eps}
    assert natural.scale == sympy.Rational(value)


def test_an_irrational_natural_frequency_enters_only_through_its_square():
    own = make("u'' + 2*mu*u' + k2*sin(u)", parameters={"k2": 2, "mu": "0.1"})
    natural = own.normalised
    assert natural.scale == sympy.sqrt(2)
    assert natural.force == sympy.sin(U) + 2 * mu * V
    assert natural.damping == sympy.sqrt(2) / 20
    cycle = make("u'' - eps*(1 - u'**2/3)*u' + 2*u", parameters={"eps": 1}).normalised
    assert sympy.expand(cycle.force) == U - eps * V + 2 * eps * V**3 / 3
    assert cycle.small == 1 / sympy.sqrt(2)


def test_symbolic_parameters_pass_through_natural_units():
    own = make("u'' + 2*mu*u' + k**2*u + a2*u**2 + a3*u**3")
    natural = own.normalised
    a2, a3 = sympy.symbols("a2 a3", real=True)
    assert natural.scale == own.natural_frequency == k
    assert natural.force == U + 2 * mu * V + a2 * U**2 / k**2 + a3 * U**3 / k**2
    assert natural.damping == mu / k
    assert natural.potential == U**2 / 2 + a2 * U**3 / (3 * k**2) + a3 * U**4 / (4 * k**2)


# --- parameters -----------------------------------------------------------------------------------------------------


def test_parameters_are_exact_whatever_they_are_given_as():
    pendulum = find("pendulum")
    for value in ("0.1", 0.1, Fraction(1, 10), sympy.Rational(1, 10), "1/10", "1e-1"):
        assert pendulum.with_parameters({"mu": value}).parameters["mu"] == sympy.Rational(1, 10)
    exact = pendulum.with_parameters({"k": "12.566370614359172"})
    assert exact.natural_frequency == sympy.Rational(12566370614359172, 10**15)
    assert exact.defaults["k"] == pendulum.parameters["k"] == 1
    assert pendulum.with_parameters({"k": None}).natural_frequency == k


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"g": 1}, "pendulum has no parameter 'g'; its parameters: mu, k"),
        ({"k": "nan"}, "parameter k: 'nan' is not a finite number"),
        ({"k": float("inf")}, "parameter k: 'inf' is not a finite number"),
        ({"k": float("nan")}, "parameter k: 'nan' is not a finite number"),
        ({"k": True}, "parameter k: True is a bool"),
        ({"k": 1 + 2j}, "is a complex, not a number"),
        ({"k": sympy.pi}, "not a number; give an integer"),
        ({"k": 10**700}, "more than 2000 bits"),
        ({"k": 0}, "the force does not restore"),
    ],
)
def test_bad_parameters_are_refused(values, said):
    with pytest.raises(InputError) as caught:
        find("pendulum").with_parameters(values)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_oscillator_is_a_value():
    one, two = find("pendulum").with_parameters({"k": 2}), find("pendulum").with_parameters({"k": "2"})
    assert one == two
    assert hash(one) == hash(two)
    assert one != find("pendulum")
    assert pickle.loads(pickle.dumps(one)) == two  # noqa: S301
    with pytest.raises(TypeError):
        one.parameters["k"] = 3
    with pytest.raises(AttributeError):
        one.name = "other"


# --- kind -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("own", "kind"),
    [
        (find("pendulum"), "conservative"),
        (find("pendulum").with_parameters({"mu": "0.01"}), "damped"),
        (find("pendulum").with_parameters({"mu": None}), "damped"),
        (find("damped-pendulum").with_parameters({"mu": 0}), "conservative"),
        (find("van-der-pol"), "limit-cycle"),
        (make("u'' + u + u*u'**2"), "conservative"),
        (make("u'' + u + u'**3"), "damped"),
        (make("u'' + u - u'/5 + u'**3"), "limit-cycle"),
        (make("u'' + u + 0.1*u'"), "damped"),
        (make("u'' + c*(u**2 - 1)*u' + u"), "limit-cycle"),
    ],
    ids=lambda value: getattr(value, "name", value),
)
def test_the_kind_follows_from_the_force(own, kind):
    assert own.kind == kind
    assert own.is_conservative == (kind == "conservative")


def test_damping_and_small_parameters_are_recognised_under_any_name():
    assert make("u'' + 2*c*u' + u").damping == "c"
    assert make("u'' + 2*c*u' + u + c*u**3").damping is None
    assert make("u'' + c*u' + u").damping is None
    assert make("u'' + 0.2*u' + u").linear_damping == sympy.Rational(1, 10)
    assert make("u'' - h*(1 - u**4)*u' + u").small == "h"
    assert make("u'' - h*(1 - u**4)*u' + (1 + h)*u").small is None
    assert make("u'' - h**2*(1 - u**4)*u' + u").small is None


# --- potentials -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "force",
    [
        "k**2*u + a*u**2 - b*u**7",
        "u*(1 + u)**3",
        "sin(u)",
        "3*sin(2*u + 1) - 3*sin(1)",
        "sinh(u/2)",
        "tan(u)",
        "tanh(3*u)",
        "1 - exp(-u)",
        "cos(u) - 1 + u",
        "cosh(u) - 1 + u",
        "u/(1 + u**2)",
        "u/sqrt(1 + u**2)",
        "sin(u)*cos(u)",
        "u/(1 + u**2)**(3/2) + k*u",
        "log(1 + u)/(1 + u)",
        "(1 + u)**(1/3) - 1",
        "(u + k*u**3)/(1 + 2*u**2 + k*u**4)**(1/2)",
        "3*(u + u**2)/(2 + 3*u**2 + 2*u**3)**2 + u",
        "(1 + u)**-2 - 1/(1 + u)**3",
    ],
)
def test_potentials_by_rule_differentiate_to_the_force_and_vanish_at_rest(force):
    own = make(f"u'' + {force}")
    assert own.potential is not None, own.potential_note
    assert own.potential.subs(U, 0) == 0
    slope = own.potential.diff(U) - own.force
    assert sympy.simplify(slope.rewrite(sympy.exp) if slope.has(sympy.tanh, sympy.tan) else slope) == 0


@QUICK
@given(st.lists(st.fractions(min_value=-5, max_value=5, max_denominator=9), min_size=1, max_size=6))
def test_the_potential_of_any_polynomial_force_is_its_integral(coefficients):
    text = "u'' + u" + "".join(f" + ({c})*u**{n}" for n, c in enumerate(coefficients, start=2))
    own = make(text)
    assert sympy.expand(own.potential.diff(U) - own.force) == 0
    assert own.potential == sympy.integrate(own.force, (U, 0, U))


@pytest.mark.parametrize("force", ["u*sin(u) + u", "sin(u)*sinh(u) + u", "exp(u**2) - 1 + u", "sin(sin(u))", "atan(u)"])
def test_without_a_rule_there_is_no_potential_and_a_reason(force):
    own = make(f"u'' + {force}")
    assert own.potential is None
    assert own.potential_note.startswith("no rule integrates")


def test_a_given_potential_is_checked_by_differentiation():
    given_one = make("x'' + atan(x)", potential="x*atan(x) - log(1 + x**2)/2 + 7")
    assert sympy.expand(given_one.potential.diff(U) - sympy.atan(U)).equals(0)
    assert given_one.potential.subs(U, 0) == 0
    with pytest.raises(InputError, match="does not differentiate to the restoring force"):
        make("x'' + sin(x)", potential="cos(x)")


def test_conservative_velocity_terms_and_limit_cycles_have_no_potential():
    assert make("u'' + u + u*u'**2").potential is None
    assert find("van-der-pol").potential is None
    assert make("u'' + u + u'**3").potential == U**2 / 2


# --- the acceleration -----------------------------------------------------------------------------------------------


def test_the_factor_of_the_acceleration_is_divided_out_exactly():
    own = make("(1 + a*u**2)*u'' + a*u*u'**2 + w**2*u = 0", parameters={"a": "1/3", "w": 2})
    a, w = sympy.symbols("a w", real=True)
    assert sympy.cancel(own.force * (1 + a * U**2) - (a * U * V**2 + w**2 * U)) == 0
    assert own.natural_frequency == 2


@given(st.fractions(max_denominator=50), st.integers(2, 5))
@QUICK
def test_multiplying_the_equation_by_a_number_changes_nothing(factor, power):
    if factor == 0:
        return
    left = W + U + U**power + V
    scale = sympy.Rational(factor.numerator, factor.denominator)
    assert solved_for_acceleration(sympy.expand(scale * left)) == U + U**power + V


# --- what is refused ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("u'' + u**2", "does not restore for u < 0"),
        ("u'' + abs(u)", "does not restore for u < 0"),
        ("u'' + abs(u**2 - 1) + u", "may change sign where nobody can tell"),
        ("u'' - u + u**3", "the origin is a saddle, since the linear restoring coefficient -1 is negative"),
        ("u'' - k**2*u", "the origin is a saddle"),
        ("u'' + (3 - pi)*u", "is negative"),
        ("u'' + u + 1", "f(0, 0) = 1 and not 0"),
        ("u'' + cos(u) + k*u", "is not at rest"),
        ("u'' + sqrt(u) + u", "sqrt(u) is not analytic on both sides"),
        ("u'' + u**(5/2) + u", "u**(5/2) is not analytic on both sides"),
        ("u'' + 1/u + u", "1/u is not analytic on both sides"),
        ("u'' + log(u) + u", "log(u) is not finite and real at the origin"),
        ("u'' + u*(u - 2)**(1/2)", "is not real at the origin"),
        ("u'' + asin(2 + u)*u", "is not finite and real at the origin"),
        ("u'' + u/(sin(1)**2 + cos(1)**2 - 1)", "divides by 0"),
        ("u''**2 + u", "it must enter linearly"),
        ("sin(u'') + u", "it must enter linearly"),
        ("u*u'' + u", "the factor u of u'' vanishes at rest"),
        ("u'' - u'' + u", "cancels out of the equation"),
    ],
)
def test_equations_without_an_analytic_centre_are_refused_by_name(text, said):
    with pytest.raises(InputError) as caught:
        make(text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_square_that_cancels_leaves_a_linear_acceleration():
    assert make("(1 + u'')**2 - u''**2 - 1 + 2*sin(u)").force == sympy.sin(U)


@pytest.mark.parametrize("term", ["tan(exp(exp(5 + u**2))**2)", "exp(20000 + u)", "sin(10**9 + u)"])
def test_towers_of_functions_are_refused_before_they_are_evaluated(term):
    with pytest.raises(InputError, match="beyond 10000 in magnitude"):
        make(f"u'' + u + u*{term}")
    with pytest.raises(InputError, match="beyond 10000 in magnitude"):
        make("u'' + u", potential=f"u**2/2 + u*{term}")


def test_a_parameter_that_is_divided_by_is_not_zero():
    with pytest.raises(InputError, match="1/Q divides by 0 with the values given"):
        Oscillator.from_equation("u'' + u'/Q + u = 0", parameters={"Q": 0})
    with pytest.raises(InputError, match="Q = 0 is divided by; give a number other than 0"):
        Oscillator.from_equation("u'' + u'/Q + u = 0").with_parameters({"Q": 0})


def test_parameters_cannot_make_a_tower_that_hangs():
    own = make("u'' + u + asin(sin(exp(exp(p))))*u**2")
    with pytest.raises(InputError, match="beyond 10000 in magnitude"):
        own.with_parameters({"p": 100})


# --- LaTeX ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("own", "latex"),
    [
        (find("damped-pendulum"), r"\ddot{\theta} + 2 \mu \dot{\theta} + k^{2} \sin{\left(\theta \right)} = 0"),
        (find("pendulum"), r"\ddot{\theta} + k^{2} \sin{\left(\theta \right)} = 0"),
        (find("damped-duffing"), r"\ddot{u} + 2 \mu \dot{u} + k^{2} u + \varepsilon u^{3} = 0"),
        (find("helmholtz-duffing"), r"\ddot{u} + k^{2} u + \alpha_{2} u^{2} + \alpha_{3} u^{3} = 0"),
        (find("rayleigh"), r"\ddot{u} - \varepsilon \left(1 - \frac{\dot{u}^{2}}{3}\right) \dot{u} + k^{2} u = 0"),
        (find("van-der-pol"), r"\ddot{u} - \varepsilon \left(1 - u^{2}\right) \dot{u} + k^{2} u = 0"),
        (make("x'' + zeta*x' + 4*x"), r"\ddot{x} + \zeta \dot{x} + 4 x = 0"),
        (
            make("m*y'' + w*y**2 + (w + 2)*y - y' - 3*y'*(1 - y**3)", parameters={"m": 1, "w": 1}),
            r"\ddot{y} - \frac{4}{m} \dot{y} + \frac{3}{m} y^{3} \dot{y}"
            r" + \frac{2}{m} y + \frac{w}{m} y + \frac{w}{m} y^{2} = 0",
        ),
        (make("x'' = -x*(1 - x)"), r"\ddot{x} + x \left(1 - x\right) = 0"),
    ],
    ids=lambda value: getattr(value, "name", "")[:20],
)
def test_the_equation_reads_acceleration_damping_restoring(own, latex):
    assert own.equation_latex == latex
