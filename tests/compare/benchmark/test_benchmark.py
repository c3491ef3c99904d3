"""The benchmark: one support, errors by a second route, crossings, verdicts, any damping, an estimator of one's own."""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import brentq

from ridgeback.answers.benchmark_table import COLUMNS, benchmark_text
from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.benchmark import assembled, benchmark
from ridgeback.compare.benchmark.contenders import Reference, Row
from ridgeback.compare.benchmark.crossings import amplitudes_of, by_order
from ridgeback.compare.benchmark.judging import common_support
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import judge
from ridgeback.compare.benchmark.ways.expansions import theory
from ridgeback.compare.benchmark.ways.own_correction import corrected, described, held_beyond
from ridgeback.compare.benchmark.ways.slow_flows import flow_of, powers_of
from ridgeback.compare.motion.motion import Setting, integrate_motion, setting
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.tracking.track import Track
from ridgeback.symbolic.codegen.fit.fit import minimax
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.description import from_text


def flat(x: np.ndarray) -> Track:
    """An outsider that always says 0.9."""
    return Track(np.arange(x.size) / 5.0, np.full(x.size, 0.9), np.ones(x.size, bool), "flat")


@pytest.fixture(scope="module")
def pendulum() -> Benchmark:
    damped = find("damped-pendulum").with_parameters({"mu": "0.01"})
    chosen = setting(damped, initial=(1.5, 0.0), duration=150.0, rate=5.0)
    return benchmark(chosen, orders=(2, 4, 8, 16), estimators={"flat": flat})


def test_every_ranked_row_is_judged_on_the_support_that_is_named(pendulum: Benchmark) -> None:
    inside = (pendulum.time >= pendulum.support[0]) & (pendulum.time <= pendulum.support[1])
    assert pendulum.support[0] < 25
    assert pendulum.support[1] > 120
    for row, error in zip(pendulum.contenders, pendulum.errors, strict=True):
        if row.ranked:
            assert row.support == pytest.approx(pendulum.support)
            assert row.relative_rms_error == pytest.approx(float(np.sqrt(np.mean(error[inside] ** 2))))
            assert abs(row.mean) <= row.relative_rms_error <= row.largest


def test_expansions_converge_to_the_averaged_action_and_the_series_model_follows_more_slowly(
    pendulum: Benchmark,
) -> None:
    errors = {order: pendulum.row(f"lindstedt-{order}-action").relative_rms_error for order in (2, 4, 8, 16)}
    floor = pendulum.row("averaged-action").relative_rms_error
    assert errors[2] > errors[4] > errors[8]
    assert errors[16] == pytest.approx(floor, rel=0.02)
    # at omega0^2 - mu^2 the second order in the damping that both lack is gone: mu^2 / 2 = 5e-5
    assert pendulum.row("averaged-damped").relative_rms_error < 0.5 * floor
    assert pendulum.row("series-3-action").relative_rms_error > 10 * errors[4]
    equal = {(c.terms, c.amplitude_from): c for c in pendulum.crossings.equal_coefficients}
    assert equal[3, "action"].order == 4
    assert equal[3, "action"].expansion_error == errors[4]


def test_generated_c_agrees_with_generated_python_and_both_have_a_cost(pendulum: Benchmark) -> None:
    rows = {row.method: row for row in pendulum.contenders}
    assert rows["lindstedt-8-action"].time_ns_per_value > 0
    assert all(r.time_scatter is not None for r in rows.values() if r.time_ns_per_value is not None)
    if "lindstedt-8-action-c" in rows:
        error = rows["lindstedt-8-action-c"].relative_rms_error
        assert error == pytest.approx(rows["lindstedt-8-action"].relative_rms_error, rel=1e-9)


def test_a_minimax_fit_errs_no_more_than_is_proved_and_less_than_the_series_of_as_many_coefficients(
    pendulum: Benchmark,
) -> None:
    exact = pendulum.errors[[row.method for row in pendulum.contenders].index("averaged-action")]
    fitted = pendulum.errors[[row.method for row in pendulum.contenders].index("minimax-8-action")]
    proved = float(minimax(find("pendulum"), Fraction(3, 2), degree=4).error)
    assert np.nanmax(np.abs((1 + fitted) / (1 + exact) - 1)) < 1.01 * proved
    assert proved < 1e-7
    rows = {row.method: row for row in pendulum.contenders}
    assert rows["minimax-8-action"].coefficients == rows["lindstedt-8-action"].coefficients == 5
    assert all(rows[name].time_ns_per_value > 0 for name in ("minimax-8-action", "pade-16-action", "nome-16-action"))


def test_the_slow_flow_of_a_limit_cycle_is_whole_through_a_power_of_eps() -> None:
    cycle = find("van-der-pol")
    flow, series = flow_of(cycle, 4), lindstedt(cycle, 4)
    for eps in (0.05, 0.1, 0.2):
        amplitude = brentq(lambda a, eps=eps: float(flow.growth_rate_at(a, eps)), 1.5, 2.5, xtol=1e-14)
        # omega0 = 1 - eps^2/16 + 17 eps^4/3072 + O(eps^6)
        assert float(flow.frequency_at(amplitude, eps)) == pytest.approx(float(series(eps)), abs=eps**6)
    assert powers_of(find("pendulum")) is None


def test_an_undamped_motion_has_no_crossing_in_amplitude_and_its_integration_is_a_floor() -> None:
    found = benchmark(setting(find("bilinear"), duration=60.0, rate=8.0), orders=(2, 4))
    assert found.crossings.amplitudes == ()
    assert 1e-14 < found.reference.numerical_error <= found.reference.floor
    text = benchmark_text(found, "text")
    assert "expansion, order 2; 1 up to order 4 alike" in text


def test_beyond_stops_there_is_no_series_and_the_wigner_peak_parts_from_the_smoothed_one_at_the_kink() -> None:
    found = benchmark(setting(find("bilinear-stops"), duration=250.0, rate=4.0))
    why = {row.refused for row in found.contenders if row.kind in ("expansion", "slow-flow")}
    assert all(reason is not None and "no series about rest holds" in reason for reason in why)
    wigner, smooth = (found.row(name).relative_rms_error for name in ("wigner", "smoothed-pseudo-wigner"))
    exact = found.row("averaged-action").relative_rms_error
    assert exact < smooth < 0.1 * wigner
    assert found.verdict.rival_way is None
    assert found.verdict.rival is not None
    assert found.verdict.rival.kind == "averaged"


def test_a_correction_is_by_the_methods_own_track_and_makes_it_better(pendulum: Benchmark) -> None:
    for name in ("pseudo-wigner", "spectrogram"):
        better = pendulum.row(f"{name}-corrected")
        assert better.corrected_by == "its own track"
        assert better.relative_rms_error < 0.5 * pendulum.row(name).relative_rms_error
    assert {row.corrected_by for row in pendulum.contenders} == {None, "its own track"}


def test_an_outsider_takes_part_and_is_placed_by_its_error(pendulum: Benchmark) -> None:
    row = pendulum.row("flat")
    assert row.ranked
    assert row.relative_rms_error > pendulum.row("harmonic-least-squares").relative_rms_error
    crossing = next(c for c in pendulum.crossings.orders if c.estimate == "flat" and c.amplitude_from == "action")
    assert (crossing.before, crossing.after) == (None, 2)


def test_the_verdict_is_made_from_the_rows(pendulum: Benchmark) -> None:
    verdict = pendulum.verdict
    ranked = [
        r for r in pendulum.contenders if r.ranked and r.kind in ("expansion", "slow-flow", "resummation", "estimate")
    ]
    assert verdict.best.relative_rms_error == min(r.relative_rms_error for r in ranked)
    assert verdict.rival_way != verdict.way
    assert f"{verdict.best.label[1:]} errs" in verdict.sentence(pendulum.reference)


def test_json_csv_and_text_say_the_same(pendulum: Benchmark) -> None:
    record = json.loads(benchmark_text(pendulum, "json"))
    assert {"reference", "support", "rows", "crossings", "verdict"} <= set(record)
    wanted = {"method", "kind", "order", "amplitude_from", "language", "relative_rms_error", "largest", "mean"}
    wanted |= {"support", "time_ns_per_value", "time_s_per_track", "time_scatter", "refused"}
    assert all(wanted <= set(row) for row in record["rows"])
    lines = benchmark_text(pendulum, "csv").splitlines()
    assert lines[0] == ",".join(COLUMNS)
    assert len(lines) == len(record["rows"]) + 1
    assert pendulum.verdict.sentence(pendulum.reference) in benchmark_text(pendulum, "text")


def of_theory(chosen: Setting) -> Benchmark:
    """A benchmark of the ways that come from theory alone."""
    motion = integrate_motion(chosen)
    return assembled(motion, list(theory(motion, (2, 8), lambda _: None)))


def test_damping_of_any_form_and_a_motion_without_a_potential() -> None:
    values = {"mu": Fraction(1, 100), "c3": Fraction(1, 50), "g": Fraction(1, 2)}
    cubic = from_text("u'' + 2*mu*u' + c3*u'**3 + u + g*u**3 = 0", parameters=values)
    found = of_theory(setting(cubic, initial=(1.2, 0.0), duration=120.0, rate=5.0))
    assert found.row("lindstedt-8-action").relative_rms_error < 1.5e-4
    assert found.row("multiple-scales-8").relative_rms_error < 1.5e-3
    inertial = from_text("u'' + u*u'**2 + u + 2*mu*u' = 0", parameters={"mu": Fraction(1, 100)})
    found = of_theory(setting(inertial, initial=(0.9, 0.0), duration=120.0, rate=5.0))
    assert found.row("lindstedt-8-fit").relative_rms_error < 2e-4
    assert found.row("multiple-scales-8").refused is None
    assert next(row for row in found.contenders if row.method.startswith("nome")).refused is not None


def test_the_described_signal_has_the_frequency_that_was_asked_and_not_that_of_the_samples() -> None:
    time = np.arange(1200) / 8.0
    x = np.exp(-0.004 * time) * np.cos(1.02 * time)
    made = described(x, np.full(time.size, 1.0), 8.0)
    track = estimate(made, 8.0, method="zero-crossing", bias=False).inside()
    assert float(np.median(track.omega)) == pytest.approx(1.0, abs=2e-4)


def test_a_steady_tone_is_not_made_worse() -> None:
    time = np.arange(1200) / 8.0
    x = np.cos(time)

    def method(samples: np.ndarray) -> Track:
        return estimate(samples, 8.0, method="pseudo-wigner", bias=False)

    track = method(x)
    better = corrected(track, method, x, 8.0)
    before, after = (np.abs(found.omega[track.valid] - 1.0) for found in (track, better))
    assert after.max() < before.max()
    assert np.sqrt(np.mean(after**2)) < 2e-5


def test_crossings_and_verdicts_of_given_errors() -> None:
    reference = Reference("given", 1e-6, 1e-5)
    series = [
        Row(f"e{n}", f"e{n}", "expansion", order=n, amplitude_from="action", language="python", ranked=True,
            relative_rms_error=error)
        for n, error in ((2, 1e-2), (4, 2e-2), (6, 1e-3), (8, 1e-4))
    ]  # fmt: skip
    rival = Row("p", "p", "estimate", ranked=True, relative_rms_error=5e-3)
    (crossing,) = by_order([*series, rival], reference)
    assert (crossing.before, crossing.after, crossing.settled) == (4, 6, True)
    verdict = judge([*series, rival], reference)
    assert (verdict.way, verdict.ratio, verdict.decided) == ("expansions", pytest.approx(50.0), True)
    close = Row("q", "q", "estimate", ranked=True, relative_rms_error=9e-6)
    undecided = judge([close, Row("s", "s", "series-model", ranked=True, relative_rms_error=2e-6)], reference)
    assert not undecided.decided
    with pytest.raises(InputError, match="could be ranked"):
        judge([], reference)


def test_bad_requests_are_refused() -> None:
    chosen = setting(find("pendulum"))
    with pytest.raises(InputError, match=r"orders \[\] hold none"):
        benchmark(chosen, orders=())
    with pytest.raises(InputError, match="below 0"):
        benchmark(chosen, orders=(-2,))


def test_contenders_without_a_common_stretch_are_refused() -> None:
    time, inside = np.arange(8.0), np.ones(8, bool)
    hardly = np.where(time < 2, 0.0, np.nan)[None]
    with pytest.raises(InputError, match="no contender covers enough of the motion"):
        common_support(time, hardly, inside)
    apart = np.array([np.where(time % 4 == i, np.nan, 0.0) for i in range(4)])
    with pytest.raises(InputError, match="the contenders share no stretch of the motion"):
        common_support(time, apart, inside)


def test_a_track_of_few_values_is_held_as_their_mean() -> None:
    track = Track(np.arange(5.0), np.array([1.0, 2.0, 9.0, 9.0, 9.0]), np.arange(5) < 2, "flat")
    assert held_beyond(track, np.arange(3.0)).tolist() == [1.5, 1.5, 1.5]


def test_the_series_of_a_limit_cycle_passes_estimates_by_order_and_not_by_amplitude() -> None:
    errors = {2: 1e-3, 4: 1e-5, 8: 1e-7}
    rows = [
        Row(f"l-{n}", "", "expansion", order=n, language="python", relative_rms_error=e, ranked=True)
        for n, e in errors.items()
    ]
    rows.append(Row("wigner", "wigner", "estimate", relative_rms_error=1e-4, ranked=True))
    (found,) = by_order(rows, Reference("", 1e-9, 1e-8))
    assert (found.amplitude_from, found.before, found.after, found.settled) == (None, 2, 4, True)
    assert found.sentence() == "expansion in eps passes wigner between orders 2 and 4"
    assert amplitudes_of(rows) == []
    assert "expansion in eps passes wigner between orders 2 and 4" in judge(rows, Reference("", 1e-9, 1e-8)).limit
