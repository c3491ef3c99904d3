"""The catalogue: each entry's mathematics, and finding them by name."""

import pytest
import sympy
from flint import ctx, fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball
from ridgeback.symbolic.cycles.found import limit_cycles
from ridgeback.symbolic.cycles.orbit import exact_frequency
from ridgeback.symbolic.expansion.ball_expansion import holds
from ridgeback.symbolic.grammar.parse import parse_equation, parse_expression, to_sympy
from ridgeback.symbolic.systems.catalogue import catalogue, find
from ridgeback.symbolic.systems.entries.every import known_frequency, listed, names
from ridgeback.symbolic.systems.oscillator import U, V
from ridgeback.symbolic.systems.sides import is_kinked

EXPECTED = [
    "linear",
    "pendulum",
    "duffing-hardening",
    "duffing-softening",
    "helmholtz-duffing",
    "van-der-pol",
    "rayleigh",
    "damped-linear",
    "damped-pendulum",
    "damped-duffing-hardening",
    "damped-duffing-softening",
    "damped-helmholtz-duffing",
]
OTHERS = [system.name for system in catalogue()[len(EXPECTED) :]]
classical = pytest.mark.parametrize("system", catalogue()[: len(EXPECTED)], ids=lambda system: system.name)
every = pytest.mark.parametrize("system", catalogue(), ids=lambda system: system.name)


def test_the_catalogue_holds_the_promised_systems():
    assert [system.name for system in catalogue()[: len(EXPECTED)]] == EXPECTED
    assert len(OTHERS) >= 25
    assert list(names()) == EXPECTED + OTHERS


def test_the_list_is_what_the_equations_say():
    for row, system in zip(listed(), catalogue(), strict=True):
        values = " ".join(f"{name}={value}" for name, value in system.parameters.items())
        assert row == {"name": system.name, "kind": system.kind, "equation": system.equation, "parameters": values}


KNOWN = [name for name in names() if known_frequency(name) and find(name).kind != "limit-cycle"]


@pytest.mark.parametrize("name", KNOWN)
@pytest.mark.parametrize("amplitude", ["1/5", "2/3"])
def test_a_frequency_known_in_closed_form_is_in_the_certified_ball(name, amplitude):
    oscillator = find(name)
    with ctx.workprec(120):
        values = {n: str(v) for n, v in oscillator.parameters.items()}
        expected = closed_form(known_frequency(name), {**values, "A": amplitude})
        found = exact_frequency(oscillator, amplitude, bits=80)
        assert found.omega.overlaps(expected)
        assert expected.rel_accuracy_bits() > 90


def test_the_hybrid_has_a_circle_for_a_limit_cycle():
    (cycle,) = limit_cycles(find("hybrid"), bits=64)
    assert known_frequency("rayleigh-van-der-pol") == "1"
    assert holds(cycle.omega, fmpq(1))
    assert holds(cycle.peak, fmpq(1))


def closed_form(text, values):
    """The formula in balls; agm(x, y) may stand outermost, after a factor."""
    before, is_mean, after = text.partition("agm(")
    if not is_mean:
        return ball_of(text, values)
    factor = ball_of(before.rstrip("*") or "1", values)
    depth, cut = 0, 0
    for place, sign in enumerate(after):
        depth += (sign == "(") - (sign == ")")
        cut = place if sign == "," and depth == 0 else cut
    return factor * ball_of(after[:cut], values).agm(ball_of(after[cut + 1 : -1], values))


def ball_of(text, values):
    inserted = {sympy.Symbol(name, real=True): sympy.Rational(value) for name, value in values.items()}
    return number_ball(to_sympy(parse_expression(text, unknown="u")).subs(inserted))


@every
def test_an_entry_says_what_it_is_and_whence(system):
    assert system.title
    assert system.description.endswith(".")
    assert any(mark in system.reference for mark in ("19", "18", "20", "Galleani"))
    assert system.unit == ("rad" if "pendulum" in system.name else "")
    assert system.symbol == (r"\theta" if "pendulum" in system.name else "u")


@every
def test_the_force_is_that_of_the_equation_and_natural_units_are_the_default(system):
    equation = parse_equation(system.equation)
    assert to_sympy(equation.left) - sympy.Symbol("u''", real=True) == system.force
    if is_kinked(system.force) or system.by_sides:
        with pytest.raises(InputError):
            assert system.normalised
        return
    assert system.natural_frequency == system.stiffness == 1
    assert system.normalised.bound == system.substituted_force


@classical
def test_every_conservative_system_and_its_damped_twin_has_a_potential_of_its_restoring_force(system):
    if system.kind == "limit-cycle":
        assert system.potential is None
        return
    assert sympy.expand(system.potential.diff(U) - system.force.subs(V, 0)) == 0
    assert system.potential.subs(U, 0) == 0
    assert system.potential.diff(U, 2).subs(U, 0) == sympy.Symbol("k", real=True) ** 2


@pytest.mark.parametrize("name", ["linear", "pendulum", "duffing-hardening", "duffing-softening", "helmholtz-duffing"])
def test_each_conservative_system_has_a_twin_that_differs_by_mu_alone(name):
    plain, damped = find(name), find(f"damped-{name}")
    assert (plain.kind, damped.kind) == ("conservative", "damped")
    assert damped.force == plain.force
    assert damped.parameters["mu"] == damped.linear_damping == sympy.Rational(1, 100)
    assert damped.with_parameters({"mu": 0}).parameters == plain.parameters
    assert sympy.expand(damped.substituted_force - plain.substituted_force) == V / 50


def test_the_velocity_of_rayleighs_equation_obeys_van_der_pols():
    """v = u': d/dt of Rayleigh's equation is v'' - eps (1 - v^2) v' + k^2 v = 0."""
    k = sympy.Symbol("k", real=True)
    rayleigh, van_der_pol = find("rayleigh").force, find("van-der-pol").force
    jerk_terms = rayleigh.diff(U) * V + rayleigh.diff(V) * sympy.Symbol("a", real=True)
    expected = van_der_pol.subs({U: V, V: sympy.Symbol("a", real=True)}, simultaneous=True)
    assert sympy.expand(jerk_terms - expected) == 0
    assert sympy.expand(rayleigh.diff(U) - k**2) == 0


def test_the_wells_are_as_described():
    softening = find("duffing-softening").with_parameters({"k": 3, "eps": "-4"})
    saddle = sympy.Rational(3, 2)  # k / sqrt(-eps)
    assert softening.substituted_force.subs({U: saddle, V: 0}) == 0
    assert softening.substituted_potential.diff(U, 2).subs(U, saddle) < 0
    helmholtz = sympy.Poly(find("helmholtz-duffing").substituted_force, U)
    assert helmholtz.count_roots() == 1
    pendulum = find("pendulum")
    assert pendulum.substituted_potential.subs(U, sympy.pi) == 2
    assert pendulum.substituted_force.subs(U, sympy.pi) == 0


@every
def test_the_default_start_lies_inside_the_well_and_is_at_rest(system):
    start, velocity = system.initial
    assert velocity == 0
    if system.potential is not None:
        path = [system.substituted_force.subs({U: start * i / 20, V: 0}) for i in range(1, 21)]
        assert all(force > 0 for force in path)


@pytest.mark.parametrize(
    ("asked", "name"),
    [
        ("pendulum", "pendulum"),
        ("PENDULUM", "pendulum"),
        ("Van der Pol", "van-der-pol"),
        ("van_der_pol", "van-der-pol"),
        ("vdp", "van-der-pol"),
        ("vanderpol", "van-der-pol"),
        ("duffing", "duffing-hardening"),
        ("Damped Duffing", "damped-duffing-hardening"),
        ("duffing softening", "duffing-softening"),
        ("helmholtz", "helmholtz-duffing"),
        ("harmonic", "linear"),
    ],
)
def test_names_are_found_in_any_spelling(asked, name):
    assert find(asked) is find(name)
    assert find(asked).name == name


def test_no_two_entries_answer_to_one_name():
    keys = [alias.replace("-", "") for system in catalogue() for alias in (system.name, *system.aliases)]
    assert len(set(keys)) == len(keys)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("pendulmu", "did you mean pendulum"),
        ("raleigh", "did you mean rayleigh"),
        ("xyz", "for instance pendulum"),
        ("", "for instance pendulum"),
        ("\n" * 200, "ridgeback systems lists all"),
    ],
)
def test_an_unknown_name_is_answered_with_near_ones(asked, said):
    with pytest.raises(InputError) as caught:
        find(asked)
    assert said in str(caught.value)
    assert "ridgeback systems lists all" in str(caught.value)
    assert str(caught.value).isprintable()
