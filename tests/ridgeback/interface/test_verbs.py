"""The verbs as functions: every form of an oscillator and of a signal, and the same numbers as the command line."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import sympy

import ridgeback
from ridgeback.cli import main

RATE = 32.0
T = np.arange(1280) / RATE
X = 2.0 * np.exp(-0.05 * T) * np.cos(2.5 * np.pi * T)
t = sympy.Symbol("t")
u = sympy.Function("u")
PENDULUM = {
    "a name": "pendulum",
    "an oscillator": ridgeback.oscillator("pendulum"),
    "text": "u'' + sin(u) = 0",
    "an Eq": sympy.Eq(u(t).diff(t, 2), -sympy.sin(u(t))),
    "a force": sympy.sin(sympy.Symbol("u")),
}


@pytest.mark.parametrize("form", PENDULUM.values(), ids=PENDULUM)
def test_every_function_takes_every_form_of_an_oscillator(form) -> None:
    exact = (1, 0, sympy.Rational(-1, 16), 0, sympy.Rational(1, 3072))
    assert ridgeback.lindstedt(form, 4).frequency == exact
    assert ridgeback.derive(form, 4, method="energy_integral").frequency == exact
    assert ridgeback.energy_integral(form, 4).frequency == exact
    assert str(ridgeback.multiple_scales(form, 2).frequency_expression()) == "1 - a**2/16"
    assert "omega0" in ridgeback.generate(form, order=4)
    assert ridgeback.study(form, (2,), [0.5]).relative_error.shape == (1, 1)
    assert abs(ridgeback.simulate(form, (0.5, 0.0), duration=7.0).crossings.time[0] - 1.5957) < 1e-4
    assert abs(float(ridgeback.enclose(form, 1).omega.mid()) - 0.93779225) < 1e-7
    assert ridgeback.bind(form).natural_frequency == 1.0
    series = ridgeback.lindstedt(form, 8)
    assert ridgeback.resum(form, series, "pade").method.startswith("Pad")
    assert len(ridgeback.certified_frequencies(form, series, [1])) == 1


def test_a_toml_path_is_an_oscillator(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("[oscillator]\nequation = \"u'' + k**2*u + u**3 = 0\"\nparameters = {k = 2}\n", encoding="utf-8")
    assert ridgeback.derive(file, 2).frequency[0] == 2
    assert ridgeback.derive(str(file), 2, parameters={"k": 3}).frequency[0] == 3


def test_derive_chooses_by_the_oscillator_and_refuses_what_has_no_use() -> None:
    assert ridgeback.derive("damped_pendulum", 2).method == "multiple-scales"
    assert ridgeback.derive("van_der_pol", 2).variable == "eps"
    assert ridgeback.derive("u'' - u + u**3 = 0", 2, about="1").frequency[0] == sympy.sqrt(2)
    with pytest.raises(ridgeback.InputError, match="leave it out"):
        ridgeback.derive("pendulum", 2, weight=3)
    with pytest.raises(ridgeback.InputError, match="did you mean lindstedt"):
        ridgeback.derive("pendulum", 2, method="lindsted")


def test_generate_takes_what_has_been_derived() -> None:
    series = ridgeback.derive("pendulum", 8)
    assert ridgeback.generate(series, "c") == ridgeback.generate("pendulum", "c", order=8)
    resummed = ridgeback.resum("pendulum", series, "pade")
    assert "omega0" in ridgeback.generate(resummed)


def test_generate_asks_for_the_equation_of_a_formula_without_a_name() -> None:
    equation = "u'' + u + u**3/7 = 0"
    series = ridgeback.derive(equation, 4)
    with pytest.raises(ridgeback.InputError, match="name its equation"):
        ridgeback.generate(series, "c")
    assert ridgeback.generate(series, "c", oscillator=equation) == ridgeback.generate(equation, "c", order=4)


def test_simulate_is_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    how = {"duration": 3.0, "rate": 8.0, "parameters": {"mu": "0.1"}}
    run = ridgeback.simulate("pendulum", (0.5, 0.0), **how)
    arguments = ["--set", "mu=0.1", "--initial", "0.5,0", "--duration", "3", "--rate", "8"]
    assert main(["simulate", "pendulum", *arguments]) == 0
    table = np.loadtxt(capsys.readouterr().out.splitlines(), delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table, np.column_stack([run.time, run.u, run.velocity]))
    taylor = ridgeback.simulate("pendulum", (0.5, 0.0), **how, method="Taylor")
    np.testing.assert_allclose(taylor.u, run.u, atol=1e-9)
    bound = ridgeback.bind(ridgeback.oscillator("pendulum", parameters={"mu": "0.1"}))
    np.testing.assert_array_equal(ridgeback.simulate(bound, (0.5, 0.0), duration=3.0, rate=8.0).u, run.u)


def test_estimate_is_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "run.csv"
    np.savetxt(file, np.column_stack([T, X]), delimiter=",", header="t_s,u [mm]", comments="", fmt="%.17g")
    assert main(["estimate", str(file), "--method", "pseudo-wigner", "--format", "json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    track = ridgeback.estimate(X, time=T, method="pseudo_wigner")
    assert [row["omega_rad_s"] for row in printed["track"]] == track.omega.tolist()
    read = ridgeback.estimate(file, method="pseudo_wigner")
    np.testing.assert_array_equal(read.omega, track.omega)
    curve = ridgeback.backbone(file, method="pseudo-wigner")
    assert curve.units == "mm"
    assert [row["omega_rad_s"] for row in printed["backbone"]] == curve.curve_omega.tolist()


def test_arrays_of_every_kind_give_the_same_track() -> None:
    plain = ridgeback.estimate(X, RATE, method="hilbert", bias=False).omega
    recording = ridgeback.Recording.from_arrays(X, RATE)
    for given in (X.tolist(), recording, np.ma.array(X)):
        rate = None if given is recording else RATE
        np.testing.assert_array_equal(ridgeback.estimate(given, rate, method="hilbert", bias=False).omega, plain)
    shifted = ridgeback.estimate(X, time=T + 5.0, method="hilbert", bias=False)
    assert shifted.time[0] == 5.0


def test_a_masked_sample_is_missing_and_never_read() -> None:
    """What lies under the mask must not reach the result, and that the signal was cut is said."""
    holed = np.ma.array(X.copy(), mask=T == 35.0)
    holed.data[holed.mask] = 1e9
    with pytest.warns(UserWarning, match="longest of 2 stretches"):
        track = ridgeback.estimate(holed, RATE, method="hilbert", bias=False)
    assert track.time[-1] < 35.0
    filled = ridgeback.estimate(holed, RATE, method="hilbert", bias=False, fill=0.1)
    assert filled.time[-1] == T[-1]
    with pytest.raises(ridgeback.InputError, match="nan"):
        ridgeback.wigner(holed, RATE)


def test_a_model_is_fitted_by_name() -> None:
    made = ridgeback.simulate("damped_pendulum", (1.0, 0.0), duration=40.0, rate=16.0, parameters={"mu": "0.02"})
    fitted = ridgeback.model_fit(made.u, 16.0, oscillator="pendulum", free=["k", "mu"])
    assert fitted.parameters["k"] == pytest.approx(1.0, abs=1e-6)
    assert fitted.parameters["mu"] == pytest.approx(0.02, abs=1e-6)
    track = ridgeback.estimate(made.u, 16.0, method="model_fit", oscillator="pendulum", parameters={"k": 1})
    assert track.method == "model-fit"
    with pytest.raises(ridgeback.InputError, match="name it by oscillator"):
        ridgeback.estimate(X, RATE, method="model-fit")
    with pytest.raises(ridgeback.InputError, match="belong to method 'model-fit'"):
        ridgeback.estimate(X, RATE, method="hilbert", oscillator="pendulum")


def test_identify_takes_arrays_and_aliases() -> None:
    noise = 0.01 * np.random.default_rng(1).normal(size=T.size)
    found = ridgeback.identify(X + noise, RATE, candidates=["linear", "Duffing", ridgeback.oscillator("pendulum")])
    assert found.best.name == "linear"
    assert {candidate.name for candidate in found.candidates} == {"linear", "duffing-hardening", "pendulum"}


def test_planes_give_a_ridge() -> None:
    chirp = np.cos(2.0 * np.pi * (2.0 * T + 0.02 * T**2))
    truth = 2.0 * np.pi * (2.0 + 0.04 * T)
    window = {"spectrogram": "window_seconds", "reassigned_spectrogram": "window_seconds"}
    for name in ("pseudo_wigner", "spectrogram"):
        plane = getattr(ridgeback, name)(chirp, RATE, **{window.get(name, "lag_seconds"): 4.0})
        assert isinstance(plane, ridgeback.Distribution)
        assert plane.values.shape == (plane.omega.size, plane.time.size)
        track = ridgeback.ridge(plane)
        inside = track.valid
        assert np.abs(track.omega - np.interp(track.time, T, truth))[inside].max() < 0.05


def test_progress_is_told_where_work_takes_long() -> None:
    told: list[float] = []
    ridgeback.derive("pendulum", 8, progress=lambda share, _: told.append(share))
    ridgeback.estimate(X, RATE, method="hilbert", progress=lambda share, _: told.append(share))
    ridgeback.study("pendulum", (2,), [0.5], progress=lambda share, _: told.append(share))
    assert len(told) > 10
    assert all(0.0 <= share <= 1.0 for share in told)


def test_a_bar_is_shown_when_asked_for_and_somebody_looks(capsys: pytest.CaptureFixture[str], monkeypatch) -> None:
    ridgeback.derive("pendulum", 8, progress=True)
    assert capsys.readouterr().err == ""  # a pipe
    monkeypatch.setattr("ridgeback.common.progress.is_terminal", lambda _: True)
    ridgeback.derive("pendulum", 8, progress=True)
    shown = capsys.readouterr().err
    assert "order 5 of 8" in shown
    assert "[###" in shown
    assert shown.endswith("\r")


def test_a_report_is_saved_whole_or_not_at_all(tmp_path: Path, monkeypatch) -> None:
    made = ridgeback.report("linear", duration=60.0, rate=4.0, orders=(2,), amplitudes=[0.5, 1.0], trials=0)
    place = made.save(tmp_path / "page.html")
    page = place.read_text(encoding="utf-8")
    assert page == made.to_html()
    assert page.startswith("<!DOCTYPE html>")
    monkeypatch.setattr("ridgeback.reports.page.html_page", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        made.save(place)
    assert place.read_text(encoding="utf-8") == page
    assert [file.name for file in tmp_path.iterdir()] == ["page.html"]


def test_a_trajectory_is_a_signal() -> None:
    run = ridgeback.simulate("pendulum", (1.0, 0.0), duration=40.0, rate=16.0)
    track = ridgeback.estimate(run, method="zero-crossing", bias=False)
    assert np.array_equal(track.omega, ridgeback.estimate(run.u, run.rate, method="zero-crossing", bias=False).omega)
    with pytest.raises(ridgeback.InputError, match="a Trajectory has its rate already"):
        ridgeback.estimate(run, 8.0)


def test_a_single_thing_is_no_signal() -> None:
    with pytest.raises(ridgeback.InputError, match=r"int, not samples; give a sequence of numbers"):
        ridgeback.estimate(7, 8.0)


def test_checks_limits_and_orbits_take_any_form_of_an_oscillator() -> None:
    series = ridgeback.derive("pendulum", 6)
    u = sympy.Symbol("u")
    assert all(check.passed for check in ridgeback.certify(sympy.sin(u), series))
    assert ridgeback.limits("u'' + sin(u) = 0", series).radius == pytest.approx(math.pi, abs=1e-3)
    orbit = ridgeback.periodic_orbit("u'' + eps*(u**2 - 1)*u' + u = 0", parameters={"eps": 1})
    assert ridgeback.precise_orbit("van_der_pol", digits=15, parameters={"eps": 1}).peak == pytest.approx(orbit.peak)


def test_integrations_fits_and_proofs_tell_their_progress() -> None:
    def shares(work: Callable[..., object], *given: object, **more: object) -> list[float]:
        told: list[float] = []
        work(*given, progress=lambda share, _: told.append(share), **more)
        return told

    runs = (
        shares(ridgeback.simulate, "pendulum", (0.5, 0.0), duration=60.0),
        shares(ridgeback.simulate, "pendulum", (0.5, 0.0), duration=5.0, method="taylor"),
        shares(ridgeback.model_fit, X, RATE, oscillator="linear", free=["k"], parameters={"k": 2}),
        shares(ridgeback.certified_rows, "pendulum", [2, 4], [0.5]),
    )
    for told in runs:
        assert told == sorted(told)
        assert len(told) > 1
        assert 0 <= told[0] <= told[-1] <= 1


def test_high_orders_tell_their_progress() -> None:
    seen: list[float] = []
    ridgeback.lindstedt_in_balls("pendulum", 8, progress=lambda share, _: seen.append(share))
    assert seen


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: ridgeback.ridge([1.0, 2.0]), "list is no distribution; make one of samples first"),
        (lambda: ridgeback.study("pendulum", 2, [0.5]), r"orders 2 are not a list .* such as \(2, 4, 8\)"),
        (lambda: ridgeback.simulate("pendulum", 1.0), r"initial state 1.0 is not two numbers; give \(u, u'\)"),
        (lambda: ridgeback.wigner(ridgeback.simulate("pendulum"), 64.0), "signal is of type Trajectory; use an array"),
        (lambda: ridgeback.wigner(["a", "b"], 64.0), "signal is of type <U1; use an array"),
        (lambda: ridgeback.oscillator(3), "int is no oscillator; give a name such as 'pendulum'"),
        (lambda: ridgeback.derive("pendulum", "four"), "order 'four' is not a whole number; use e.g. 8"),
    ],
)
def test_what_is_of_the_wrong_kind_is_refused_in_one_line(call, said: str) -> None:
    with pytest.raises(ridgeback.InputError, match=said) as refused:
        call()
    assert "\n" not in str(refused.value)


def test_one_path_is_read_like_a_list_of_one(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("t_s,u\n" + "".join(f"{i / 10},{i % 4}\n" for i in range(40)), encoding="utf-8")
    (one,), (same,) = ridgeback.read_recordings(path), ridgeback.read_recordings([str(path)])
    assert np.array_equal(one.values, same.values)
