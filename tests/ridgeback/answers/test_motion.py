"""``derive --transient`` and ``--harmonics``: two routes to every row, and the keys of their JSON."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
import sympy
from scipy.integrate import solve_ivp

from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.transient import PHASE, START, TIME, closed_form
from ridgeback.symbolic.systems.catalogue import find

Ridgeback = Callable[..., Any]  # the fixture of conftest.py


def output(ridgeback: Ridgeback, words: str) -> Any:
    done = ridgeback("derive", *words.split(), "--format", "json")
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


@pytest.mark.parametrize("words", ["damped-pendulum --order 2", "van-der-pol --order 3 --weight 1 --set eps=1/10"])
def test_the_closed_form_printed_is_the_rows_printed(ridgeback: Ridgeback, words: str) -> None:
    """The formula is evaluated by SymPy, the rows come from a Taylor series in time."""
    public = output(ridgeback, words + " --transient 0.5,0.25 --until 40 --points 5")
    system = public["system"]
    flow = multiple_scales(find(system), public["order"], weight=public["weight"])
    form = closed_form(flow.entire())
    assert form is not None
    assert public["closed_form"] == {"amplitude": str(form.amplitude), "phase": str(form.phase)}
    small = {"damped-pendulum": ("mu", Fraction(1, 100)), "van-der-pol": ("eps", Fraction(1, 10))}[system]
    values = {START: 0.5, PHASE: 0.25, sympy.Symbol(small[0], real=True): float(small[1])}
    for row in public["transient"]:
        at = {**values, TIME: row["time"]}
        assert row["amplitude"] == pytest.approx(float(form.amplitude.subs(at)), rel=1e-11)
        assert row["phase"] == pytest.approx(float(form.phase.subs(at)), rel=1e-10, abs=1e-10)
    assert [row["time"] for row in public["transient"]] == [0, 10, 20, 30, 40]


def test_the_displacement_is_the_motion_of_the_equation(ridgeback: Ridgeback) -> None:
    """Against SciPy: the error of the slow flow falls as its order rises."""
    errors = []
    for order in (2, 4, 6):
        words = f"damped-pendulum --order {order} --set mu=1/100 --transient 0.6 --until 30 --points 301"
        done = ridgeback("derive", *words.split(), "--format", "csv")
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(done.out))]
        u0, u1, u2 = (rows[i]["u"] for i in (0, 1, 2))
        slope = (-3 * u0 + 4 * u1 - u2) / 0.2
        true = solve_ivp(
            lambda _, y: [y[1], -0.02 * y[1] - math.sin(y[0])],
            (0, 30),
            fitted(u0, slope, rows),
            t_eval=[row["time"] for row in rows],
            rtol=1e-11,
            atol=1e-12,
        )
        errors.append(max(abs(row["u"] - y) for row, y in zip(rows, true.y[0], strict=True)))
    assert errors[0] > 10 * errors[1] > 50 * errors[2]


def fitted(u: float, slope: float, rows: list[dict[str, float]]) -> list[float]:
    """The velocity at time 0 of the printed motion by a difference of high order, from seven of its rows."""
    weights = [-49 / 20, 6, -15 / 2, 20 / 3, -15 / 4, 6 / 5, -1 / 6]
    found = sum(w * rows[i]["u"] for i, w in enumerate(weights)) / rows[1]["time"]
    assert found == pytest.approx(slope, abs=1e-2)
    return [u, found]


def test_without_a_closed_form_it_is_said(ridgeback: Ridgeback) -> None:
    words = "van-der-pol --order 12 --weight 1 --set eps=1/10 --transient 0.1 --until 200"
    public = output(ridgeback, words)
    assert public["closed_form"] is None
    (cycle,) = public["fixed_points"]
    assert (cycle["stable"], cycle["square_series"]) == (True, ["4", "0", "1/16", "0"])
    last = public["transient"][-1]
    assert last["amplitude"] == pytest.approx(float(cycle["amplitude"]), rel=1e-6)  # 400 e^-20 of s is left
    assert last["omega0"] == pytest.approx(float(cycle["frequency"]), rel=1e-6)
    text = ridgeback("derive", *words.split()).out
    assert "no closed form at this order" in text
    assert "stable" in text


def test_a_long_transient_ends_on_the_limit_cycle_printed_and_converges_to_the_true_one(ridgeback: Ridgeback) -> None:
    """Truth: the fundamental of the periodic solution at eps = 1/2, by SciPy and a Fourier integral."""
    amplitude, omega = true_cycle(0.5)
    errors = []
    for order in (4, 8, 16, 24):
        public = output(ridgeback, f"van-der-pol --order {order} --transient 0.1 --until 400 --points 2")
        last, (cycle,) = public["transient"][-1], [p for p in public["fixed_points"] if p["square_series"]]
        assert public["complete_powers"] == {"eps": order // 4}
        assert last["amplitude"] == pytest.approx(float(cycle["amplitude"]), rel=1e-13)
        assert last["omega0"] == pytest.approx(float(cycle["frequency"]), rel=1e-13)
        assert all(row["powers"]["eps"] <= order // 4 for row in public["frequency"] + public["growth_rate"])
        errors.append((abs(last["omega0"] / omega - 1), abs(last["amplitude"] / amplitude - 1)))
    frequency = [error for error, _ in errors]
    assert frequency == sorted(frequency, reverse=True)
    assert frequency[0] > 1e-2
    assert frequency[-1] < 2e-6
    assert errors[-1][1] < 1e-4


def test_a_transient_that_leaves_the_reach_of_its_order_says_so(ridgeback: Ridgeback) -> None:
    hardened = ["derive", "--equation", "u'' - eps*(1 - 2*u**2)*u' + u + u**3 = 0", "--set", "eps=1/10"]
    words = [*hardened, "--weight", "1", "--order", "8", "--transient", "0.1", "--until", "100"]
    public = json.loads(ridgeback(*words, "--format", "json").out)
    assert public["beyond_reach"] is True
    assert public["fixed_points"][0]["beyond_reach"] is True
    (cycle,) = public["limit_cycles"]
    assert (cycle["omega0"][:20], cycle["stable"]) == ("1.545303297129122442", True)
    text = ridgeback(*words).out
    assert "The motion runs beyond the reach of this order" in text
    assert f"true limit cycle, enclosed: peak = {cycle['amplitude']}, omega0 = {cycle['omega0']}" in text
    assert text.count("stable") == 1
    near = output(ridgeback, "damped-pendulum --order 4 --transient 0.5 --until 100")
    assert (near["beyond_reach"], "why" in near) == (False, False)


def true_cycle(eps: float) -> tuple[float, float]:
    """Amplitude of the fundamental and frequency of van der Pol's limit cycle."""

    section: Any = lambda _, y: y[0]  # noqa: E731
    section.direction = 1.0
    found: Any = solve_ivp(
        lambda _, y: [y[1], eps * (1 - y[0] ** 2) * y[1] - y[0]],
        (0, 130),
        [2.0, 0.0],
        events=section,
        dense_output=True,
        rtol=1e-11,
        atol=1e-12,
    )
    start, end = found.t_events[0][-2:]
    omega, count = 2 * math.pi / (end - start), 512
    time = [start + (end - start) * i / count for i in range(count)]
    wave = sum(found.sol(t)[0] * complex(math.cos(omega * t), math.sin(omega * t)) for t in time)
    return float(2 * abs(wave) / count), float(omega)


def test_a_transient_without_a_complete_power_is_refused_and_the_expansion_says_so(ridgeback: Ridgeback) -> None:
    done = ridgeback(*["derive", "van-der-pol", "--order", "3", "--transient", "0.1", "--until", "5"])
    assert (done.code, done.out) == (2, "")
    assert "--order 3" in done.err
    assert "no power of eps with all its terms" in done.err
    assert (
        "No limit cycle is known"
        in ridgeback(*["derive", "van-der-pol", "--method", "multiple-scales", "--order", "3"]).out
    )


def test_late_times_cost_nothing_and_too_late_ones_are_refused_by_the_phase(ridgeback: Ridgeback) -> None:
    words = "van-der-pol --order 12 --transient 0.1 --points 2 --until "
    public = output(ridgeback, words + "1e9")
    last, (cycle,) = public["transient"][-1], [p for p in public["fixed_points"] if p["square_series"]]
    near = output(ridgeback, words + "1000")["transient"][-1]
    assert last["amplitude"] == pytest.approx(float(cycle["amplitude"]), rel=1e-14)
    gained = Fraction(cycle["frequency"]) * (10**9 - 1000)
    assert last["phase"] - near["phase"] == pytest.approx(float(gained), abs=1e-6)
    done = ridgeback("derive", *words.split(), "1e12")
    assert (done.code, done.err.count("\n")) == (2, 1)
    fits = done.err.split("end at t = ")[1].split()[0]
    assert 1e9 < float(fits) < 1e10
    assert ridgeback("derive", *words.split(), fits).code == 0


@pytest.mark.parametrize("until", ["50", "3000", "1e8"])
def test_the_decay_to_rest_is_the_closed_form_at_any_time(ridgeback: Ridgeback, until: str) -> None:
    """phi of the damped pendulum, order 2: t + a_0^2 (exp(-2 mu t) - 1)/(32 mu)."""
    (*_, last) = output(ridgeback, f"damped-pendulum --order 4 --transient 1 --until {until} --points 3")["transient"]
    end, mu = float(until), 0.01
    rows = output(ridgeback, f"damped-pendulum --order 2 --transient 1 --until {until} --points 3")["transient"]
    assert rows[-1]["amplitude"] == pytest.approx(math.exp(-mu * end), rel=1e-11, abs=1e-300)
    assert rows[-1]["phase"] == pytest.approx(end + math.expm1(-2 * mu * end) / (32 * mu), rel=1e-12)
    assert abs(last["phase"] - rows[-1]["phase"]) < 0.1 + mu**2 * end


def test_a_vanishing_small_parameter_has_no_limit_cycle(ridgeback: Ridgeback) -> None:
    for words in ("", " --method multiple-scales", " --transient 0.1 --until 5 --points 2"):
        still = f"van-der-pol --order 4 --set eps=0{words}"
        assert "At eps = 0 there is no limit cycle" in ridgeback("derive", *still.split()).out
        assert "eps = 0" in output(ridgeback, still)["no_limit_cycle"]
    assert "no_limit_cycle" not in output(ridgeback, "van-der-pol --order 4")


def test_the_limits_are_in_the_json_of_every_expansion(ridgeback: Ridgeback) -> None:
    assert output(ridgeback, "pendulum --order 8")["limits"]["radius"] == pytest.approx(math.pi, abs=1e-4)
    text = ridgeback(*["derive", "pendulum", "--order", "8"]).out
    assert output(ridgeback, "pendulum --order 8")["limits"]["sentence"] in text
    assert output(ridgeback, "van-der-pol --method multiple-scales")["limits"]["radius"] == pytest.approx(
        1.849, abs=5e-3
    )
    unknown = output(ridgeback, "--equation u''+2*m*u'+u+c*u**3=0 --order 4")["limits"]
    assert unknown["radius"] is None
    assert "symbols" in unknown["sentence"]


def test_the_limits_of_a_slow_flow_are_those_of_its_undamped_frequency(ridgeback: Ridgeback) -> None:
    """At the separatrix of the pendulum u is a square wave between -pi and pi, whose fundamental is (4/pi) pi = 4."""
    found = output(ridgeback, "damped-pendulum --order 4")["limits"]
    assert found["of"] == "the frequency with mu = 0"
    assert abs(found["radius"] - 4) < found["uncertainty"] < 0.2
    flow, longer = (multiple_scales(find("damped-pendulum"), order) for order in (4, 24))
    edge = found["range_of_use"]
    assert abs(flow.frequency_at(edge, 0.0) / longer.frequency_at(edge, 0.0) - 1) < 1e-3
    assert found["sentence"] in ridgeback(*["derive", "damped-pendulum", "--order", "4"]).out
    unsettled = output(ridgeback, "duffing --method multiple-scales --order 4")["limits"]
    assert unsettled["radius"] is None
    assert "fundamental amplitude do not settle" in unsettled["sentence"]
    words = (
        "--equation u''-c*u'+d*u'**3+u=0 --set c=1/10 --set d=1/10 --order 4 --weights c=2,d=0 --method multiple-scales"
    )
    assert "still loses or gains energy" in output(ridgeback, words)["limits"]["sentence"]


@pytest.mark.parametrize("style", ["latex", "mathml", "python"])
def test_a_form_without_a_certificate_refuses_verify(ridgeback: Ridgeback, style: str) -> None:
    done = ridgeback("derive", "pendulum", "--verify", "--format", style)
    assert (done.code, done.out) == (2, "")
    assert f"--format {style} shows no certificate" in done.err


def test_fixed_points_are_in_the_json_of_a_self_excited_flow(ridgeback: Ridgeback) -> None:
    public = output(ridgeback, "van-der-pol --method multiple-scales --weight 1 --order 6 --set eps=1/10")
    (cycle,) = public["fixed_points"]
    assert float(cycle["slope"]) == pytest.approx(-0.1)  # d/da of (eps a/2)(1 - a^2/4) at a = 2
    assert "fixed_points" not in output(ridgeback, "damped-pendulum --order 4")


def test_harmonics_of_the_undamped_duffing_oscillator_are_the_textbook_ones(ridgeback: Ridgeback) -> None:
    """Nayfeh and Mook (1979), 2.3: u = a cos phi + (a^3/32) cos 3 phi + ... for u'' + u + u^3 = 0."""
    flow = output(ridgeback, "duffing --method multiple-scales --order 2 --harmonics")
    assert flow["harmonics"] == [
        {"multiple": 1, "cosine": [{"powers": {"a": 1, "mu": 0}, "coefficient": "1"}], "sine": []},
        {"multiple": 3, "cosine": [{"powers": {"a": 3, "mu": 0}, "coefficient": "1/32"}], "sine": []},
    ]
    series = output(ridgeback, "duffing --order 2 --amplitude fundamental --harmonics")
    assert series["harmonics"][1]["cosine"] == [{"powers": {"A": 3}, "coefficient": "1/32"}]
    text = ridgeback(*["derive", "duffing", "--order", "2", "--amplitude", "fundamental", "--harmonics"]).out
    assert ["cos(3*omega0*t)", "A^3", "0.03125", "1/32"] in [line.split() for line in text.splitlines()]


def test_harmonics_as_formulas(ridgeback: Ridgeback) -> None:
    words = ["derive", "duffing", "--method", "multiple-scales", "--order", "2", "--harmonics", "--format"]
    assert ridgeback(*words, "python").out == "a**3*cos(3*phi)/32 + a*cos(phi)\n"
    assert r"C_{3} = \frac{a^{3}}{32}" in ridgeback(*words, "latex").out
    assert ridgeback(*words, "mathml").out.startswith("<math")


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("pendulum --transient 1", "needs --until"),
        ("pendulum --until 5", "needs --transient"),
        ("pendulum --points 5", "needs --transient"),
        ("pendulum --transient 1 --until 5 --method lindstedt", "multiple-scales"),
        ("pendulum --transient 0 --until 5", "above 0"),
        ("pendulum --transient 1 --until 5 --at 1", "exclude"),
        ("pendulum --transient 1 --until 5 --harmonics", "exclude"),
        ("pendulum --transient 1 --until 5 --verify", "--verify"),
        ("pendulum --transient 1 --until 5 --format latex", "text, json or csv"),
        ("pendulum --harmonics --method energy-integral", "lindstedt"),
        ("pendulum --harmonics --format latex", "text or json"),
        ("pendulum --harmonics --format csv", "csv does not go"),
        (
            "van-der-pol --order 4 --weight 1 --method multiple-scales --set eps=-1/2 --transient 3 --until 99",
            "runs away at t = 1.17557;",  # 2 ln(9/5): the zero of G = 1 - (9/4)(1 - exp(-t/2))
        ),
    ],
)
def test_one_line_says_what_does_not_go(ridgeback: Ridgeback, words: str, why: str) -> None:
    done = ridgeback("derive", *words.split())
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert why in done.err
