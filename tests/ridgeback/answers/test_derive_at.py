"""``derive --at`` and ``--resummed``: rows, keys, and what does not go together."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Ridgeback = Callable[..., Any]  # the fixture of conftest.py

KEYS = ["amplitude", "amplitude_exact", "omega0", "radius", "certain_digits", "by", "formula_omega0", "relative_error"]


def said(ridgeback: Ridgeback, words: str) -> str:
    done = ridgeback("derive", *words.split())
    assert (done.code, done.err) == (0, "")
    return str(done.out)


def test_the_series_stands_beside_the_exact_frequency(ridgeback: Ridgeback) -> None:
    done = ridgeback("derive", "pendulum", "--order", "4", "--at", "1,2.5", "--format", "json")
    public = json.loads(done.out)
    assert (done.code, done.err) == (0, "")
    assert [list(row) for row in public["at"]] == [[*KEYS, "error_bound"]] * 2
    first = public["at"][0]
    assert float(first["formula_omega0"]) == pytest.approx(1 - 1 / 16 + 1 / 3072, rel=1e-15)
    true = float(first["formula_omega0"]) / 0.93779225805142846725 - 1
    assert float(first["relative_error"]) == pytest.approx(true, rel=1e-5)
    assert public["at"][1]["amplitude_exact"] == "5/2"
    text = ridgeback("derive", "pendulum", "--order", "4", "--at", "1,2.5").out
    assert first["omega0"] in text
    rows = list(csv.DictReader(io.StringIO(said(ridgeback, "pendulum --at 0.5:2.5:5 --format csv"))))
    assert [row["amplitude"] for row in rows] == ["0.5", "1.0", "1.5", "2.0", "2.5"]


def test_a_cubic_force_has_a_frequency_proportional_to_the_amplitude(ridgeback: Ridgeback, tmp_path: Path) -> None:
    words = ["derive", "--equation", "u'' + u**3 = 0"]
    public = json.loads(ridgeback(*words, "--at", "1,2", "--digits", "30", "--format", "json").out)
    one, two = (float(row["omega0"]) for row in public["at"])
    # Gamma(3/4) sqrt(pi/8) / Gamma(5/4)
    assert one == pytest.approx(math.gamma(0.75) / math.gamma(1.25) * math.sqrt(math.pi / 8), rel=1e-15)
    assert two == pytest.approx(2 * one, rel=1e-15)
    (term,) = public["frequency"]
    assert term["powers"] == {"A": 1}
    assert term["decimal"] == pytest.approx(one, rel=1e-15)
    path = tmp_path / "cubic.toml"
    path.write_text("[oscillator]\nequation = \"x'' + x**3 = 0\"\n")
    assert "0.84721308479397908" in ridgeback("derive", str(path), "--at", "1").out
    about = ridgeback("derive", "--equation", "u'' + (u - 1)**3 = 0", "--about", "1", "--at", "1", "--format", "csv")
    assert "0.8472130847939790866" in about.out


def test_resummations_have_their_certified_errors(ridgeback: Ridgeback) -> None:
    words = ["derive", "pendulum", "--order", "16", "--at", "2.5", "--format", "json", "--resummed"]
    found = {kind: json.loads(ridgeback(*words, kind).out) for kind in ("pade", "map", "nome")}
    assert found["pade"]["method"] == "Pade [4/4]"
    assert found["pade"]["pole"] == pytest.approx(3.339538152)
    series = json.loads(ridgeback("derive", "pendulum", "--order", "16", "--at", "2.5", "--format", "json").out)
    assert all(row["at"][0]["error_bound"] < series["at"][0]["error_bound"] for row in (found["pade"], found["nome"]))
    assert found["nome"]["at"][0]["error_bound"] < 1e-7
    text = ridgeback("derive", "pendulum", "--order", "4", "--resummed", "pade").out
    assert "omega0 = (1 - 11*A**2/192)/(A**2/192 + 1)" in text
    assert said(ridgeback, "pendulum --order 4 --resummed pade --format latex").startswith(r"\omega_0(A)")
    assert "1 - 11*A**2/192" in said(ridgeback, "pendulum --order 4 --resummed pade --format python")


@pytest.mark.parametrize(
    ("words", "refused", "why"),
    [
        (["--equation", "u'' + u - 2*u**3 + u**5", "--at", "0.99999,0.5"], 0, "cannot decide"),
        (["pendulum", "--at", "1,4,2"], 1, "separatrix at 3.14159"),
        (["pendulum", "--at", "1,4", "--resummed", "map", "--order", "8"], 1, "separatrix at 3.14159"),
        (["--equation", "u'' + u**3 - u**5", "--at", "0.5,2"], 1, "separatrix at 1"),
    ],
)
def test_an_amplitude_without_an_enclosure_leaves_the_others(
    ridgeback: Ridgeback, words: list[str], refused: int, why: str
) -> None:
    done = ridgeback("derive", *words, "--format", "json")
    assert done.code == 3
    assert done.err.count("\n") == 1
    assert why in done.err
    rows = json.loads(done.out)["at"]
    assert f"A = {rows[refused]['amplitude_exact']}: " in done.err
    assert [row["omega0"] is None for row in rows] == [n == refused for n in range(len(rows))]
    assert why in rows[refused]["refused"]
    table = list(csv.reader(io.StringIO(ridgeback("derive", *words, "--format", "csv").out)))
    assert table[0][-1] == "refused"
    assert [bool(row[-1]) for row in table[1:]] == [n == refused for n in range(len(rows))]
    text = ridgeback("derive", *words)
    assert text.code == 3
    assert all(str(row["omega0"]) in text.out for row in rows if row["omega0"])


def test_a_series_in_eps_stands_beside_the_enclosed_limit_cycle(ridgeback: Ridgeback) -> None:
    row = json.loads(said(ridgeback, "van-der-pol --order 8 --resummed pade --at 1 --format json"))["at"][0]
    assert (row["eps"], row["eps_exact"], row["stable"]) == (1.0, "1", True)
    assert row["omega0"].startswith("0.94295584744161004386124611908")
    assert row["amplitude"].startswith("2.00861986087484313650964018836")
    assert float(row["radius"]) < 1e-25
    assert float(row["amplitude_radius"]) < 1e-25
    assert float(row["relative_error"]) == pytest.approx(
        float(row["formula_omega0"]) / 0.9429558474416100 - 1, rel=1e-3
    )
    text = said(ridgeback, "van-der-pol --order 20 --at 1")
    assert row["omega0"] in text
    certified = ridgeback("derive", "van-der-pol", "--order", "8", "--digits", "20")
    assert "certain digits" in certified.out


def test_a_repelling_limit_cycle_is_enclosed_beside_its_slow_flow(ridgeback: Ridgeback) -> None:
    words = ("--equation", "u'' + eps*(1 - u**2)*u' + u = 0", "--order", "4", "--at", "1/10", "--format", "json")
    done = ridgeback("derive", *words)
    (row,) = json.loads(done.out)["at"]
    assert (done.code, row["stable"], row["multiplier"]) == (0, False, "1.87593")
    assert row["omega0"].startswith("0.99937555342364552401")
    refused = ridgeback("derive", "--equation", "u'' + 2*mu*u' + u + u**3 = 0", "--order", "4", "--at", "1/10")
    assert refused.code == 2
    assert "--at belongs to a series in the amplitude" in refused.err


def test_nested_limit_cycles_that_no_series_describes_are_told_apart(ridgeback: Ridgeback) -> None:
    """Their peaks come back in an integration; likewise an irrational first amplitude and a second parameter."""
    equation = "u'' - eps*(1 - 3*u**2 + u**4)*u' + u + u**2/8 = 0"
    words = ("derive", "--equation", equation, "--at", "1/4", "--order", "2", "--digits", "12", "--format", "json")
    done = ridgeback(*words)
    inner, outer = json.loads(done.out)["at"]
    assert (done.code, inner["stable"], outer["stable"]) == (0, True, False)
    assert inner["amplitude"].startswith("1.33645589600")
    assert outer["amplitude"].startswith("1.78391502139")
    refused = ridgeback("derive", "--equation", equation, "--method", "lindstedt")
    assert (refused.code, "one small parameter" in refused.err) == (2, True)
    for other in ("u'' - eps*(1 - 3*u**2)*u' + u = 0", "u'' - eps*(1 - b*u**2)*u' + u = 0"):
        found = json.loads(ridgeback("derive", "--equation", other, "--order", "2", "--format", "json").out)
        assert found["method"] == "multiple-scales"
        assert "multiple-scales" not in found["limits"]["sentence"]


def test_a_limit_cycle_that_cannot_be_proved_leaves_the_series_standing(ridgeback: Ridgeback) -> None:
    words = ("--equation", "u'' - eps*(1 - u**2)*u' + u - u**3/3 = 0", "--order", "4", "--method", "multiple-scales")
    done = ridgeback("derive", *words, "--at", "1", "--format", "json")
    assert done.code == 3
    public = json.loads(done.out)
    assert public["frequency"]
    assert public["at"][0]["omega0"] is None
    assert "found no limit cycle" in public["at"][0]["refused"]
    assert "values of eps have no enclosure" in done.err


def test_a_study_of_limit_cycles_keeps_its_series_where_nothing_could_be_enclosed(ridgeback: Ridgeback) -> None:
    words = ("--equation", "u'' - eps*(1 - u**2)*u' + u - eps*u**3/4 = 0", "--orders", "4", "--amplitudes", "0.2,2")
    done = ridgeback("study", *words, "--certified", "--format", "json")
    near, far = [row for row in json.loads(done.out) if row["method"] == "truncated series"]
    assert done.code == 3
    assert abs(near["omega"] / near["omega_reference"] - 1 - near["relative_error"]) < 1e-15
    assert (near["eps"], far["eps"], far["omega_reference"], far["relative_error"]) == (0.2, 2.0, None, None)
    assert far["omega"] == pytest.approx(ridgeback_series(2.0), rel=1e-14)
    assert "found no limit cycle" in far["refused"]
    assert "found no limit cycle" in done.err


def ridgeback_series(eps: float) -> float:
    """The series to eps^4 of the equation above, from the library."""
    from ridgeback import derive

    return float(derive("u'' - eps*(1 - u**2)*u' + u - eps*u**3/4 = 0", order=4)(eps))


def test_a_force_with_a_velocity_squared_has_its_enclosure(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = tmp_path / "pdm.toml"
    path.write_text('[oscillator]\nequation = "u\'\' + u + u*u\'**2 = 0"\npotential = "u**2/2"\n')
    row = json.loads(said(ridgeback, f"{path} --at 1 --format json"))["at"][0]
    assert row["omega0"].startswith("1.13677548843054")
    studied = ridgeback("study", str(path), "--amplitudes", "0.5,1", "--orders", "8", "--format", "json")
    assert studied.code == 0
    assert json.loads(studied.out)[1]["relative_error"] == pytest.approx(float(row["relative_error"]), rel=1e-5)


@pytest.mark.parametrize("style", ["text", "json", "python", "latex", "mathml"])
def test_a_parameter_named_like_the_amplitude_is_refused_in_every_form(ridgeback: Ridgeback, style: str) -> None:
    done = ridgeback("derive", "--equation", "u'' + u + A*u**3", "--order", "4", "--format", style)
    assert (done.code, done.out) == (2, "")
    assert "rename it, e.g. A1" in done.err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("pendulum --at 0", "above 0"),
        ("pendulum --at x", "not a finite number"),
        ("pendulum --at 1:2", "START:STOP:COUNT"),
        ("pendulum --at 2:1:5", "START 2 is not below STOP 1"),
        ("pendulum --at 1 --format latex", "text, json or csv"),
        ("pendulum --format csv", "--format csv does not go with an expansion"),
        ("damped-pendulum --at 1", "set the damping to 0"),
        ("damped-pendulum --resummed pade", "slow flow"),
        ("pendulum --resummed pade --order 16 --at 3.5", "pole at A = 3.339"),
        ("pendulum --resummed pade --degrees 2/2 --order 4", "lower a degree"),
        ("pendulum --resummed pade --verify", "--verify"),
        ("pendulum --resummed pade --digits 9", "exclude each other"),
        ("pendulum --degrees 1/1", "needs --resummed"),
        ("pendulum --resummed pade --degrees 1", "write for example 3/2"),
        ("van-der-pol --resummed nome", "peak amplitude"),
        ("helmholtz-duffing --resummed nome", "neither"),
    ],
)
def test_one_line_says_what_does_not_go(ridgeback: Ridgeback, words: str, why: str) -> None:
    done = ridgeback("derive", *words.split())
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert why in done.err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("pendulum --at 4", "separatrix at 3.14159"),
        ("pendulum --at 1 --amplitude energy", "no enclosure"),
    ],
)
def test_where_no_amplitude_has_an_enclosure_the_series_is_printed(ridgeback: Ridgeback, words: str, why: str) -> None:
    done = ridgeback("derive", *words.split())
    assert done.code == 3
    assert "omega0 = sum of" in done.out
    assert why in done.err


def test_a_refused_enclosure_leaves_the_series_standing(ridgeback: Ridgeback) -> None:
    done = ridgeback(
        "derive", "--equation", "u'' + u - u**3 + u*u'**4 = 0", "--at", "1.5", "--order", "4", "--format", "json"
    )
    assert done.code == 3
    public = json.loads(done.out)
    assert public["frequency"][0]["coefficient"] == "1"
    assert public["at"][0]["omega0"] is None
    assert "does not come back" in public["at"][0]["refused"]


@pytest.mark.parametrize(
    ("equation", "omega"),
    [("u'' + u*(1 - u'**2)**(3/2) = 0", "0.9560307576710383910"), ("u'' + u*u' + u = 0", "0.98966500902748735354")],
)
def test_where_no_energy_is_known_the_motion_is_integrated(ridgeback: Ridgeback, equation: str, omega: str) -> None:
    done = ridgeback("derive", "--equation", equation, "--at", "1/2", "--order", "4", "--format", "json")
    (row,) = json.loads(done.out)["at"]
    assert (done.code, row["by"]) == (0, "integration")
    assert row["omega0"].startswith(omega)
    assert abs(float(row["relative_error"])) < 1e-3


def test_a_force_that_no_rule_integrates_is_enclosed(ridgeback: Ridgeback) -> None:
    done = ridgeback("derive", "--equation", "u'' + u/(1 + u) = 0", "--at", "1/2", "--format", "json")
    assert done.code == 0
    assert json.loads(done.out)["at"][0]["omega0"].startswith("0.992168767518171226")


def test_a_potential_beside_the_equation_is_checked(ridgeback: Ridgeback) -> None:
    words = ("derive", "--equation", "u'' + u + u**3 = 0", "--order", "2", "--potential")
    assert ridgeback(*words, "u**2/2 + u**4/4").code == 0
    wrong = ridgeback(*words, "u**2/2 + u**4/3")
    assert (wrong.code, "does not differentiate to the restoring force" in wrong.err) == (2, True)
    assert ridgeback("derive", "pendulum", "--potential", "1 - cos(theta)").code == 2


def test_averaged_losses_are_sent_to_what_they_have(ridgeback: Ridgeback) -> None:
    done = ridgeback("derive", "--equation", "u'' + u + F*sign(u') = 0", "--at", "1")
    assert (done.code, "averaged losses give neither" in done.err, "--transient" in done.err) == (2, True, False)
