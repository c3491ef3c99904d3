"""The public contract of the command line: names, keys and values that others build on."""

from __future__ import annotations

import csv
import io
import itertools
import json
import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from ridgeback.cli import main

Ridgeback = Callable[..., Any]  # the fixture of conftest.py

PENDULUM = {"0": "1", "2": "-1/16", "4": "1/3072", "6": "-23/737280", "8": "-2519/1321205760"}
DUFFING = {"0": "1", "2": "3/8", "4": "-21/256", "6": "81/2048", "8": "-6549/262144"}
VAN_DER_POL = {"0": "1", "2": "-1/16", "4": "17/3072", "6": "35/884736", "8": "-678899/5096079360"}


def table(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def by_power(terms: list[dict[str, Any]], variable: str) -> dict[str, str]:
    return {str(term["powers"][variable]): term["coefficient"] for term in terms}


@pytest.fixture(scope="module")
def run_csv(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The paper's damped pendulum, simulated by the command of the contract."""
    path = tmp_path_factory.mktemp("run") / "run.csv"
    arguments = (
        "simulate pendulum --set mu=0.01 --set k=12.566370614359172 --initial 2.984513,0 --duration 20 --rate 64"
    )
    assert main([*arguments.split(), "-o", str(path)]) == 0
    return path


def test_version(ridgeback: Ridgeback) -> None:
    import ridgeback as package

    done = ridgeback("--version")
    assert done.out == f"ridgeback {package.__version__}\n"
    assert package.__version__.count(".") >= 2


@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"]])
def test_help_names_every_verb(ridgeback: Ridgeback, arguments: list[str]) -> None:
    done = ridgeback(*arguments)
    assert done.code == 0
    for verb in ("systems", "derive", "generate", "simulate", "estimate", "identify", "study", "report"):
        assert verb in done.out
        help_text = ridgeback(verb, "--help")
        assert help_text.code == 0
        assert f"\n  ridgeback {verb}" in help_text.out, "each verb's help has an example on a line of its own"


@pytest.mark.parametrize(
    ("arguments", "system", "variable", "coefficients"),
    [
        ("pendulum --method lindstedt --amplitude peak", "pendulum", "A", PENDULUM),
        ("pendulum --method energy-integral", "pendulum", "A", PENDULUM),
        ("duffing --method lindstedt", "duffing-hardening", "A", DUFFING),
        ("van-der-pol", "van-der-pol", "eps", VAN_DER_POL),
        ("rayleigh", "rayleigh", "eps", VAN_DER_POL),
    ],
)
def test_derive_prints_the_known_values(
    ridgeback: Ridgeback, arguments: str, system: str, variable: str, coefficients: dict[str, str]
) -> None:
    done = ridgeback("derive", *arguments.split(), "--order", "8", "--format", "json")
    assert (done.code, done.err) == (0, "")
    public = json.loads(done.out)
    assert public["system"] == system
    assert public["order"] == 8
    assert public["variables"] == [variable]
    assert by_power(public["frequency"], variable) == coefficients


def test_derive_json_is_the_contract_key_by_key(ridgeback: Ridgeback) -> None:
    done = ridgeback(
        *["derive", "pendulum", "--method", "lindstedt", "--order", "2", "--amplitude", "peak", "--format", "json"]
    )
    assert done.out.endswith("}\n")
    public = json.loads(done.out)
    keys = {"radius", "uncertainty", "range_of_use", "step", "singularities", "sentence"}
    assert set(public.pop("limits")) == keys
    assert public == {
        "system": "pendulum",
        "method": "lindstedt",
        "amplitude": "peak",
        "order": 2,
        "variables": ["A"],
        "frequency": [{"powers": {"A": 0}, "coefficient": "1"}, {"powers": {"A": 2}, "coefficient": "-1/16"}],
    }


def test_limit_cycles_have_their_amplitude_series(ridgeback: Ridgeback) -> None:
    """Andersen and Geer (1982): the peak of the van der Pol cycle is 2 + eps^2/96 - 1033 eps^4/552960."""
    public = json.loads(ridgeback(*["derive", "van-der-pol", "--order", "4", "--format", "json"]).out)
    assert by_power(public["amplitude_series"], "eps") == {"0": "2", "2": "1/96", "4": "-1033/552960"}


def test_slow_flow_keeps_the_terms_of_its_order(ridgeback: Ridgeback) -> None:
    done = ridgeback(*["derive", "damped-pendulum", "--method", "multiple-scales", "--order", "4", "--format", "json"])
    public = json.loads(done.out)
    assert public["variables"] == ["a", "mu"]
    frequency = {(t["powers"]["a"], t["powers"]["mu"]): t["coefficient"] for t in public["frequency"]}
    growth = {(t["powers"]["a"], t["powers"]["mu"]): t["coefficient"] for t in public["growth_rate"]}
    assert frequency == {(0, 0): "1", (2, 0): "-1/16", (4, 0): "1/1024", (0, 2): "-1/2"}
    assert growth == {(0, 1): "-1", (2, 1): "-1/16"}
    for weight, order in itertools.product((1, 3), (5, 6)):
        arguments = f"derive damped-pendulum --weight {weight} --order {order} --format json"
        terms = json.loads(ridgeback(*arguments.split()).out)["frequency"]
        assert all(t["powers"]["a"] + weight * t["powers"]["mu"] <= order for t in terms)


def test_set_gives_the_oscillators_own_units(ridgeback: Ridgeback) -> None:
    public = json.loads(ridgeback(*["derive", "pendulum", "--order", "2", "--set", "k=0.5", "--format", "json"]).out)
    assert by_power(public["frequency"], "A") == {"0": "1/2", "2": "-1/32"}


@pytest.mark.parametrize("system", ["pendulum", "van-der-pol", "damped-pendulum"])
@pytest.mark.parametrize("style", ["text", "latex", "mathml", "python"])
def test_derive_in_every_form(ridgeback: Ridgeback, system: str, style: str) -> None:
    done = ridgeback("derive", system, "--order", "4", "--format", style)
    assert (done.code, done.err) == (0, "")
    assert done.out.endswith("\n")
    sign = {"text": "-1/16", "latex": "\\frac", "mathml": "<math", "python": "/16"}[style]
    assert sign in done.out


def test_python_form_is_exact(ridgeback: Ridgeback) -> None:
    from ridgeback.symbolic.grammar.parse import parse_expression, to_sympy

    text = ridgeback(*["derive", "pendulum", "--order", "4", "--format", "python"]).out.replace("A", "u")
    expression = to_sympy(parse_expression(text.strip(), unknown="u"))
    symbol = next(iter(expression.free_symbols))
    assert expression.coeff(symbol, 4) == Fraction(1, 3072)


def test_generated_file_agrees_with_the_printed_series(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = tmp_path / "pendulum.py"
    assert ridgeback("generate", "pendulum", "--order", "8", "-o", str(path)).code == 0
    text = path.read_text(encoding="utf-8")
    for power, coefficient in PENDULUM.items():
        value = abs(float(Fraction(coefficient)))
        assert power == 0 or (repr(value) in text and coefficient.lstrip("-") in text)
    assert "below 3.14159" in text


def test_simulated_columns(run_csv: Path) -> None:
    rows = table(run_csv.read_text(encoding="utf-8"))
    assert list(rows[0]) == ["time_s", "u", "velocity"]
    assert len(rows) == 20 * 64 + 1
    assert [rows[i]["time_s"] for i in (0, 1, -1)] == ["0.0", "0.015625", "20.0"]
    assert rows[0]["u"] == "2.984513"
    # theory: A(20) is about 0.659 pi, and the motion never leaves the envelope it started with
    assert max(abs(float(row["u"])) for row in rows) == 2.984513
    last = max(abs(float(row["u"])) for row in rows[-80:])
    assert last == pytest.approx(0.659 * math.pi, rel=0.02)


def test_two_integrators_agree(ridgeback: Ridgeback) -> None:
    arguments = ["simulate", "pendulum", "--initial", "2,0", "--duration", "10", "--rate", "8", "--format", "json"]
    runs = [json.loads(ridgeback(*arguments, *more).out) for more in ([], ["--method", "taylor", "--digits", "25"])]
    first, second = ([row["u"] for row in run["samples"]] for run in runs)
    assert np.allclose(first, second, rtol=0, atol=1e-10)
    assert first != second
    assert "aylor" in runs[1]["method"]


def test_study_rows(ridgeback: Ridgeback) -> None:
    arguments = ["study", "pendulum", "--orders", "2,4,8,16", "--amplitudes", "0.1:3.0:30"]
    rows = json.loads(ridgeback(*arguments, "--format", "json").out)
    assert len(rows) == 4 * 30
    columns = ["order", "amplitude", "method", "omega", "omega_reference", "relative_error"]
    assert all(list(row) == columns for row in rows)
    for row in rows:
        # omega0 = agm(1, cos(A/2)) for k = 1
        exact = float(mpmath.agm(1, mpmath.cos(mpmath.mpf(row["amplitude"]) / 2)))
        assert row["omega_reference"] == pytest.approx(exact, rel=1e-14)
        assert row["relative_error"] == pytest.approx(row["omega"] / exact - 1, abs=1e-13)
    at_one = {row["order"]: abs(row["relative_error"]) for row in rows if row["amplitude"] == rows[9]["amplitude"]}
    assert at_one[16] < at_one[8] < at_one[4] < at_one[2]
    in_csv = table(ridgeback(*arguments, "--format", "csv").out)
    assert [float(row["omega"]) for row in in_csv] == [row["omega"] for row in rows]
    assert "order" in ridgeback(*arguments).out


def cycle_hz(rows: list[dict[str, str]], time: float) -> float:
    """Frequency of the full cycle round a time, from the zero crossings of the printed samples: a slow twin."""
    t, u = ([float(row[name]) for row in rows] for name in ("time_s", "u"))
    crossings = [t[i] - u[i] * (t[i + 1] - t[i]) / (u[i + 1] - u[i]) for i in range(len(u) - 1) if u[i] * u[i + 1] < 0]
    cycles = [(0.5 * (a + b), 1 / (b - a)) for a, b in zip(crossings, crossings[2:], strict=False)]
    return float(np.interp(time, *zip(*cycles, strict=True)))


@pytest.mark.parametrize(
    ("method", "tolerance"),
    [
        ("wigner", 2e-2),
        ("pseudo-wigner", 1e-3),
        ("smoothed-pseudo-wigner", 1e-3),
        ("spectrogram", 1e-3),
        ("auto", 5e-4),
    ],
)
def test_estimate_follows_the_pendulum(ridgeback: Ridgeback, run_csv: Path, method: str, tolerance: float) -> None:
    """Every estimator agrees with the cycles counted in the samples; the full Wigner peak within its known bias."""
    done = ridgeback("estimate", str(run_csv), "--column", "u", "--method", method, "--format", "json")
    assert (done.code, done.err) == (0, "")
    public = json.loads(done.out)
    assert set(public) >= {"method", "settings", "notes", "track", "backbone"}
    rows = [row for row in public["track"] if row["valid"]]
    for row in rows:
        assert list(row)[:3] == ["time_s", "omega_rad_s", "frequency_hz"]
        assert row["frequency_hz"] == pytest.approx(row["omega_rad_s"] / (2 * math.pi), rel=1e-15)
    samples = table(run_csv.read_text(encoding="utf-8"))
    for time in (6.0, 10.0, 14.0):
        found = np.interp(time, [row["time_s"] for row in rows], [row["frequency_hz"] for row in rows])
        assert found == pytest.approx(cycle_hz(samples, time), rel=tolerance)


def test_estimate_csv_and_rate(ridgeback: Ridgeback, run_csv: Path, tmp_path: Path) -> None:
    """A sampling rate in place of the time column gives the same track."""
    arguments = ["--method", "pseudo-wigner", "--format", "csv"]
    by_column = ridgeback("estimate", str(run_csv), "--column", "u", *arguments)
    rows = table(by_column.out)
    assert list(rows[0])[:3] == ["time_s", "omega_rad_s", "frequency_hz"]
    bare = tmp_path / "bare.csv"
    values = [row["u"] for row in table(run_csv.read_text(encoding="utf-8"))]
    bare.write_text("u\n" + "\n".join(values) + "\n", encoding="utf-8")
    by_rate = table(ridgeback("estimate", str(bare), "--rate", "64", *arguments).out)
    assert [row["omega_rad_s"] for row in by_rate] == [row["omega_rad_s"] for row in rows]


def test_third_harmonic_is_three_times_the_fundamental(ridgeback: Ridgeback, run_csv: Path) -> None:
    arguments = ["estimate", str(run_csv), "--column", "velocity", "--method", "pseudo-wigner", "--format", "json"]
    first = json.loads(ridgeback(*arguments).out)["track"]
    third = json.loads(ridgeback(*arguments, "--harmonic", "3").out)["track"]
    fundamental = {row["time_s"]: row["omega_rad_s"] for row in first if row["valid"]}
    ratios = [row["omega_rad_s"] / fundamental[row["time_s"]] for row in third if row["valid"]]
    assert np.median(ratios) == pytest.approx(3, rel=2e-3)


def test_backbone_of_a_recording(ridgeback: Ridgeback, run_csv: Path) -> None:
    """The pendulum softens: the frequency falls as the amplitude grows, near the exact backbone."""
    done = ridgeback("estimate", str(run_csv), "--column", "u", "--backbone", "--format", "json")
    assert (done.code, done.err) == (0, "")
    rows = json.loads(done.out)["backbone"]
    amplitudes = [row["amplitude"] for row in rows]
    frequencies = [row["frequency_hz"] for row in rows]
    assert np.corrcoef(amplitudes, frequencies)[0, 1] < -0.9


def test_systems_lists_the_catalogue(ridgeback: Ridgeback) -> None:
    listed = json.loads(ridgeback("systems", "--format", "json").out)
    names = {entry["name"] for entry in listed}
    assert {"linear", "pendulum", "helmholtz-duffing", "van-der-pol", "rayleigh"} <= names
    assert all(entry["reference"] and entry["equation"] for entry in listed)
    text = ridgeback("systems").out
    assert all(name in text for name in names)
    one = json.loads(ridgeback("systems", "pendulum", "--format", "json").out)
    assert one in listed


def test_progress_speaks_only_to_terminals() -> None:
    from ridgeback.common.progress import Bar

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    terminal, pipe = Terminal(), io.StringIO()
    for stream in (terminal, pipe):
        bar = Bar(stream)
        bar(0.5, "Wigner distribution")
        bar.close()
    assert " 50% " in terminal.getvalue()
    assert terminal.getvalue().count("Wigner") == 1
    assert terminal.getvalue().endswith(" \r")
    assert pipe.getvalue() == ""


def test_a_certified_study_proves_each_error(ridgeback: Ridgeback) -> None:
    done = ridgeback("study", "pendulum", "--orders", "8", "--amplitudes", "1,2", "--certified", "--format", "json")
    rows = json.loads(done.out)
    assert done.code == 0
    assert {"order", "amplitude", "method", "omega", "omega_reference", "relative_error", "error_radius"} == set(
        rows[0]
    )
    series = [row for row in rows if row["method"] == "truncated series"]
    exact = [math.pi / (2 * float(mpmath.ellipk(math.sin(a / 2) ** 2))) for a in (1.0, 2.0)]
    assert [row["omega_reference"] for row in series] == pytest.approx(exact, rel=1e-14)
    assert all(row["error_radius"] < 1e-30 for row in rows)
    cycle = ridgeback("study", "van-der-pol", "--orders", "4", "--amplitudes", "1", "--certified", "--format", "json")
    assert [row["omega_reference"] for row in json.loads(cycle.out)] == pytest.approx([0.94295584744161] * 3, rel=1e-14)


def test_the_range_of_use_is_printed_with_every_expansion(ridgeback: Ridgeback) -> None:
    assert "converges for |A| < 3.14" in ridgeback("derive", "pendulum", "--order", "4").out
    assert "converges for |eps| < 1.849" in ridgeback("derive", "van-der-pol", "--order", "4").out


def test_generated_code_as_json_carries_the_series_it_is_made_from(ridgeback: Ridgeback) -> None:
    found = json.loads(ridgeback("generate", "pendulum", "--order", "4", "--format", "json").out)
    assert found["language"] == "python"
    assert found["frequency"][1] == {"powers": {"A": 2}, "coefficient": "-1/16"}
    assert found["source"] == ridgeback("generate", "pendulum", "--order", "4").out


def test_a_study_of_a_damped_system_says_that_it_is_undamped(ridgeback: Ridgeback) -> None:
    assert "mu = 0" in ridgeback("study", "damped-pendulum", "--orders", "4", "--amplitudes", "1").out
    assert "mu = 0" not in ridgeback("study", "pendulum", "--orders", "4", "--amplitudes", "1").out


def test_weights_order_several_small_parameters(ridgeback: Ridgeback) -> None:
    equation = "u'' + 2*mu*u' + c3*u'**3 + u = 0"
    words = ["--method", "multiple-scales", "--weights", "mu=2,c3=1", "--order", "4", "--format", "json"]
    found = json.loads(ridgeback("derive", "--equation", equation, *words).out)
    assert found["variables"] == ["a", "mu", "c3"]
    assert found["weights"] == {"mu": 2, "c3": 1}
    # Cubic damping alone: a' = -3/8 c3 a^3 (averaging of u'^3 over cos).
    assert {"powers": {"a": 2, "mu": 0, "c3": 1}, "coefficient": "-3/8"} in found["growth_rate"]
    assert ridgeback("derive", "pendulum", "--weights", "mu=2").code == 2
    assert ridgeback("derive", "damped-pendulum", "--weights", "mu").code == 2


def test_a_self_excited_slow_flow_names_its_limit_cycle(ridgeback: Ridgeback) -> None:
    words = ["--set", "eps=1/10", "--method", "multiple-scales", "--weight", "1", "--order", "12"]
    line = ridgeback("derive", "van-der-pol", *words).out.splitlines()[-1]
    amplitude, omega = (float(line.split(f"{name} = ")[1].split(",")[0]) for name in ("a", "omega0"))
    assert line.endswith("stable")
    assert amplitude == pytest.approx(2 + 0.1**2 / 64, abs=1e-7)  # first harmonic, through eps^2
    assert omega == pytest.approx(1 - 0.1**2 / 16 + 17 * 0.1**4 / 3072, abs=1e-9)


@pytest.mark.parametrize("proved", [(), ("--certified",)])
@pytest.mark.parametrize(("style", "where"), [("text", "out"), ("csv", "err"), ("json", "err")])
def test_a_study_says_what_damping_it_leaves_out(
    ridgeback: Ridgeback, proved: tuple[str, ...], style: str, where: str
) -> None:
    done = ridgeback("study", "damped-pendulum", "--orders", "2", "--amplitudes", "1", *proved, "--format", style)
    assert done.code == 0
    assert "the study is of the undamped motion, mu = 0" in getattr(done, where)
    assert "undamped" not in ridgeback("study", "pendulum", "--orders", "2", "--amplitudes", "1", *proved).out
