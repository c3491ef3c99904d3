"""Weights of small parameters: which terms are kept, what they cost, and what is asked for by name."""

from itertools import product

import pytest

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.expansion.cost import Budget, predict, weighted_monomials
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import small_parameters
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.flow.own import a, c, make, same


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


def test_the_share_that_is_told_rises_with_the_fourth_power_of_the_degree() -> None:
    told: list[tuple[float, str]] = []
    multiple_scales(find("damped-pendulum"), 5, progress=lambda share, step: told.append((share, step)))
    assert [share for share, _ in told] == [(n / 6) ** 4 for n in range(2, 7)]
    assert told[0][1] == "weighted degree 2 of 5"


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
