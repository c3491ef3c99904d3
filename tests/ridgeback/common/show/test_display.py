"""Results show themselves: short lines, formulas and tables that are safe, pictures with units, frames with units."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from fractions import Fraction

import matplotlib as mpl
import numpy as np
import pytest

import ridgeback
from ridgeback.common.show.columns import QUANTITIES
from ridgeback.common.show.displayed import Displayed
from ridgeback.common.show.table_text import html_table, latex_table

RATE = 32.0
T = np.arange(1280) / RATE
X = 2.0 * np.exp(-0.05 * T) * np.cos(2.5 * np.pi * T)


@pytest.fixture(scope="module")
def results() -> dict[str, Displayed]:
    """One of each kind of result."""
    noisy = X + 0.01 * np.random.default_rng(3).normal(size=X.size)
    recording = ridgeback.Recording.from_arrays(noisy, RATE, units="mm", name="u")
    return {
        "expansion": ridgeback.derive("pendulum", 12),
        "long expansion": ridgeback.derive("pendulum", 60),
        "cycle": ridgeback.derive("van-der-pol", 6),
        "flow": ridgeback.derive("damped_pendulum", 6),
        "recording": recording,
        "trajectory": ridgeback.simulate("pendulum", (1.0, 0.0)),
        "energy": ridgeback.energy_terms("pendulum", ridgeback.simulate("pendulum", (1.0, 0.0), duration=5.0)),
        "components": ridgeback.components("pendulum", initial=(1.0, 0.0), duration=60.0),
        "track": ridgeback.estimate(recording, method="pseudo-wigner"),
        "backbone": ridgeback.backbone(recording, method="hilbert"),
        "half cycles": ridgeback.half_cycles(recording),
        "fit": ridgeback.model_fit(noisy, RATE, oscillator="linear"),
        "plane": ridgeback.pseudo_wigner(X[:200], RATE, lag_seconds=2.0),
        "study": ridgeback.study("pendulum", (2, 4, 8), np.linspace(0.2, 2.0, 10)),
        "cycle study": ridgeback.study("van-der-pol", (2, 4), [0.2, 0.4]),
        "benchmark": ridgeback.benchmark("damped-pendulum", initial=(1.0, 0.0), duration=60.0, rate=5.0, orders=(2, 6)),
        "identification": ridgeback.identify(noisy, RATE, candidates=["linear", "pendulum"], damping="linear"),
        "prediction": ridgeback.predict(noisy, RATE, cycles=15, candidates=["linear"], damping="linear"),
        "report": ridgeback.report("linear", duration=60.0, rate=4.0, orders=(2,), amplitudes=[0.5, 1.0], trials=0),
    }


KINDS = (
    *("expansion", "long expansion", "cycle", "flow", "recording", "trajectory", "energy", "components", "track"),
    *("backbone", "half cycles", "fit", "plane", "study", "cycle study", "benchmark", "identification", "prediction"),
    "report",
)


@pytest.mark.parametrize("kind", KINDS)
def test_a_repr_is_one_short_line(results, kind: str) -> None:
    text = repr(results[kind])
    assert "\n" not in text
    assert text.startswith(f"<{type(results[kind]).__name__}: ")
    assert len(text) <= 400


@pytest.mark.parametrize("kind", KINDS)
def test_a_notebook_shows_little_and_safely(results, kind: str) -> None:
    html, latex = results[kind]._repr_html_(), results[kind]._repr_latex_()
    if kind == "report":  # its own page, in a frame that cannot reach the notebook
        assert html.startswith("<iframe ")
        assert html.count("<") == 2
        assert 'sandbox="allow-scripts allow-downloads"' in html
    else:
        assert 0 < len(html) < 16_000
    assert "<script" not in html
    if kind != "plane":
        assert latex.count("{") == latex.count("}")
        assert len(latex) < 6_000
    if kind in ("expansion", "flow"):
        assert "<math" in html
        assert r"\frac{" in latex


def test_a_long_series_is_cut_with_dots(results) -> None:
    assert results["long expansion"].formulas()[0].endswith(r"+ \cdots")
    assert "cdots" not in results["flow"].formulas()[1]


@pytest.mark.parametrize("kind", KINDS)
def test_a_plot_returns_labelled_axes(results, kind: str) -> None:
    mpl.use("agg")
    from matplotlib import pyplot

    axes = results[kind].plot()
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    assert axes.lines or axes.collections
    assert results[kind].plot(axes) is axes
    axes.figure.canvas.draw()
    pyplot.close("all")


def test_a_plot_draws_the_numbers_that_the_result_has(results) -> None:
    mpl.use("agg")
    from matplotlib import pyplot

    track = results["track"]
    axes = track.plot()
    line = axes.lines[0].get_ydata()
    np.testing.assert_array_equal(line[track.valid], track.omega[track.valid])
    assert np.isnan(line[~track.valid]).all()
    band = axes.collections[0].get_paths()[0].vertices[:, 1]
    assert math.isclose(np.nanmin(band), np.nanmin(track.interval.low))
    pyplot.close("all")
    curve = results["backbone"]
    axes = curve.plot()
    assert "mm" in axes.get_xlabel()
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), curve.curve_omega)
    pyplot.close("all")


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "plane"])
def test_rows_name_known_quantities(results, kind: str) -> None:
    rows = results[kind].rows()
    assert rows
    assert all(list(row) == list(rows[0]) for row in rows)
    unknown = {name for name in rows[0] if name not in QUANTITIES and not name.startswith("power_")}
    assert not unknown


@pytest.mark.parametrize("kind", KINDS)
def test_dataframes_carry_units(results, kind: str) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = results[kind].to_dataframe()
    assert frame.attrs["units"]
    if kind == "plane":
        assert frame.shape == results[kind].values.shape
        return
    rows = results[kind].rows()
    assert len(frame) == len(rows)
    assert set(frame.attrs["units"]) == set(rows[0])
    flat = frame.reset_index() if frame.index.names[0] else frame
    for name in rows[0]:
        given = [row[name] for row in rows]
        assert all(same(a, b) for a, b in zip(flat[name].tolist(), given, strict=True)), name


def same(a: object, b: object) -> bool:
    """Equal, or both no number."""
    return a == b or (isinstance(a, float) and isinstance(b, float) and math.isnan(a) and math.isnan(b))


def test_units_are_those_of_the_signal_where_they_are_known(results) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    assert results["backbone"].to_dataframe().attrs["units"]["amplitude"] == "mm"
    assert results["recording"].to_dataframe().attrs["units"]["value"] == "mm"
    assert results["track"].to_dataframe().attrs["units"]["omega_rad_s"] == "rad/s"
    assert replace(results["backbone"], units="").quantities()["amplitude"].unit == "unit of the signal"


@pytest.mark.parametrize("kind", KINDS)
def test_datasets_carry_units_and_names(results, kind: str) -> None:
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    data = results[kind].to_xarray()
    if kind == "plane":
        assert data.dims == ("omega", "time")
        np.testing.assert_array_equal(data.values, results[kind].values)
        assert data.omega.attrs["units"] == "rad/s"
        return
    assert isinstance(data, xarray.Dataset)
    assert all("units" in variable.attrs and variable.attrs["long_name"] for variable in data.variables.values())


def test_a_study_is_a_grid(results) -> None:
    pytest.importorskip("xarray", reason="xarray is not installed")
    study = results["study"]
    data = study.to_xarray()
    assert dict(data.sizes) == {"order": 3, "amplitude": 10}
    np.testing.assert_array_equal(data.relative_error.values, study.relative_error)
    np.testing.assert_array_equal(data.amplitude.values, study.amplitudes)
    assert dict(results["cycle study"].to_xarray().sizes) == {"order": 2, "eps": 2}


def test_what_is_missing_is_said_with_the_remedy(results, monkeypatch) -> None:
    import importlib

    real = importlib.import_module

    def without(name: str):
        if name in ("pandas", "xarray"):
            raise ModuleNotFoundError(name)
        return real(name)

    monkeypatch.setattr("ridgeback.common.show.optional.import_module", without)
    with pytest.raises(ImportError, match="pip install pandas"):
        results["track"].to_dataframe()
    with pytest.raises(ImportError, match="pip install xarray"):
        results["track"].to_xarray()


def inside(value: object, seen: set[type]) -> Iterator[object]:
    """The value and, one of each type, the results that its fields hold."""
    if isinstance(value, tuple | list):
        for item in value[:1]:
            yield from inside(item, seen)
    elif is_dataclass(value) and type(value) not in seen:
        seen.add(type(value))
        yield value
        for item in fields(value):
            yield from inside(getattr(value, item.name), seen)


@pytest.fixture(scope="module")
def every_result(results) -> list[object]:
    """What the other public functions give, and what the results hold."""
    series, flow = ridgeback.lindstedt("pendulum", 40), ridgeback.multiple_scales("van-der-pol", 8)
    duffing = ridgeback.lindstedt("duffing", 40)
    recording = ridgeback.Recording.from_arrays(X, RATE, name="u")
    given = [
        *results.values(),
        ridgeback.lindstedt_in_balls("pendulum", 40, digits=12),
        ridgeback.resum("pendulum", series, "pade"),
        ridgeback.resum("duffing", duffing, "map"),
        ridgeback.resum("pendulum", series, "nome"),
        ridgeback.limits("pendulum", series),
        ridgeback.fixed_points(flow, {"eps": "1/10"})[0],
        ridgeback.enclose("pendulum", 1, bits=2000),
        ridgeback.certify("pendulum", series)[0],
        ridgeback.certified_frequencies("pendulum", series, [Fraction(1)])[0],
        ridgeback.periodic_orbit("van-der-pol"),
        ridgeback.precise_orbit("van-der-pol", digits=15),
        ridgeback.bind("pendulum"),
        ridgeback.Budget(),
        ridgeback.catalogue()[0],
        ridgeback.measure_recordings([recording], method="zero-crossing"),
    ]
    seen: set[type] = set()
    return [value for result in given for value in inside(result, seen)]


def test_every_result_and_what_it_holds_has_a_repr_of_a_few_lines(every_result) -> None:
    long = {type(v).__name__: repr(v) for v in every_result if len(repr(v)) >= 400 or repr(v).count("\n") > 1}
    assert not long
    assert len(every_result) > 40


def test_resummations_and_limits_show_themselves_in_a_notebook(every_result) -> None:
    shown = {type(value).__name__: value for value in every_result}
    assert "<math" in shown["NomeForm"]._repr_html_()
    assert shown["NomeForm"]._repr_latex_().startswith(r"$\displaystyle \omega_0")
    assert shown["RationalForm"]._repr_latex_() == shown["RationalForm"].headline()  # [10/10]: pages of digits
    assert "converges for |A| &lt; 3.14159 ± " in shown["Limits"]._repr_html_()
    assert repr(shown["FixedPoint"]) == "<FixedPoint: a = 2.00000000000, phi' = 0.999375000000, stable>"


def test_names_cannot_smuggle_markup() -> None:
    rows = [{"a<b>": "<script>alert(1)</script>", "x_1 & 50%": "\\input{secret}"}]
    html, latex = html_table(rows), latex_table(rows)
    assert "<script" not in html
    assert "\\input" not in latex
    assert r"x\_1 \& 50\%" in latex
    hostile = ridgeback.Recording.from_arrays(X, RATE, name="<img src=x onerror=alert(1)>")
    assert "<img" not in hostile._repr_html_()


def test_a_table_without_rows_is_nothing() -> None:
    assert html_table([]) == latex_table([]) == ""


def test_an_oscillator_is_a_line_and_its_equation() -> None:
    pendulum = ridgeback.oscillator("pendulum", parameters={"k": 2})
    assert repr(pendulum) == "<Oscillator: pendulum, theta'' + 2*mu*theta' + k**2*sin(theta) = 0 (mu = 0, k = 2)>"
    assert r"\ddot" in pendulum._repr_latex_()


def test_values_without_tables_are_short_too() -> None:
    recording = ridgeback.Recording.from_arrays(X, RATE, name="u")
    found = ridgeback.measure_recordings([recording], method="zero-crossing")
    balls = ridgeback.lindstedt_in_balls("van-der-pol", 8, digits=12)
    assert repr(ridgeback.bind("pendulum")) == "<Dynamics: pendulum, k = 1, mu = 0>"
    assert repr(balls) == "<BallExpansion: van-der-pol, lindstedt to order 8 in eps, 12 digits of each coefficient>"
    assert repr(found).startswith("<Measurements: ")
    assert repr(found).endswith("; 0 combined backbones, 0 failed>")
