"""Small functions of the numeric room at the ends of their ranges: known values, or a refusal that says what helps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest

from ridgeback.common.errors import InputError
from ridgeback.numeric.backbone.backbone import check_enough, total_deviation
from ridgeback.numeric.distributions.distribution import Distribution
from ridgeback.numeric.distributions.short_time import short_time_spectra
from ridgeback.numeric.estimators import auto, global_harmonics
from ridgeback.numeric.files.arrays import in_memory, stated_rate
from ridgeback.numeric.files.hdf5 import attribute_numbers
from ridgeback.numeric.harmonics.spline_basis import ROWS, SplineBasis
from ridgeback.numeric.model_fit.start import matched
from ridgeback.numeric.motion import limit_cycle
from ridgeback.numeric.motion.dynamics import duffing, linear, van_der_pol
from ridgeback.numeric.motion.events import Switches
from ridgeback.numeric.motion.integration import Drift
from ridgeback.numeric.orbits import action_loss, adiabatic
from ridgeback.numeric.recording.clipping import quantum
from ridgeback.numeric.recording.drift import MOST_SAMPLES, wandering
from ridgeback.numeric.recording.file_signals import runs_of
from ridgeback.numeric.recording.uniform import resampled
from ridgeback.numeric.signal.decimation import LONG, Samples, decimated
from ridgeback.numeric.signal.presence import parts_of
from ridgeback.numeric.signal.search_band import find_search_band, guide_path
from ridgeback.numeric.tracking.choices import Scope
from ridgeback.numeric.tracking.clear_stretch import followed_stretch
from ridgeback.numeric.tracking.request import check_valid
from ridgeback.numeric.tracking.track import Track

STUB: Any = SimpleNamespace
TIME = np.arange(64) / 8.0
TONE = np.cos(6.0 * TIME)


def track(**more: Any) -> Track:
    return Track(TIME, np.full(64, 6.0), np.ones(64, dtype=np.bool_), "example", **more)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: check_enough(np.zeros(9, bool), np.zeros(9, bool)), "0 points are clear of the noise and of clipped"),
        (lambda: Distribution(np.ones((1, 2)), np.ones(1), np.arange(2.0), "one").spacing, "needs two points on it"),
        (lambda: find_search_band(np.zeros(64), 8.0), "shows no oscillation in the band"),
        (lambda: runs_of(COLUMNS, 1, 3), "run column run has 2 rows, the signal 3"),
        (lambda: check_valid(np.zeros(9, bool), "x", 0.0, SHORT), "holds only 0.5 steps of 0.1"),
        (lambda: adiabatic.adiabatic_motion(linear(), STUB(), (1.0, 0.0), [-1.0]), "finite and not before 0"),
    ],
)
def test_what_cannot_be_done_is_refused(call: Callable[[], object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()


COLUMNS: Any = STUB(values=lambda _: np.arange(2.0), source="x.csv", names=("u", "run"))
SHORT: Any = STUB(lag_given=True, plan=STUB(lag_seconds=0.05), signal=STUB(rate=10.0, search=STUB(centre=6.0)))


def test_values_at_the_ends() -> None:
    assert total_deviation(track()) is None
    assert quantum(np.full(4, 0.3)) == 0.0
    law = Switches((-1.0, 0.0, 1.0), False, lambda _, __: lambda u, _: u)
    assert [law.stretch(u, 0.0) for u in (-1.5, -1.0, -0.5, 0.5, 1.0, 1.5)] == [0, 1, 1, 2, 2, 3]
    single = short_time_spectra(np.array([1.0, 2.0 + 0j]), np.array([1.0]), 0, 2, 4)
    assert np.allclose(single, np.array([[1.0] * 4, [2.0] * 4]))
    even = np.column_stack([TONE, TONE])
    assert stated_rate(in_memory({"dt": np.array([[math.nan]]), "rate": np.array([[8.0]]), "x": even})) == 8.0
    assert math.isnan(wandering(np.zeros(MOST_SAMPLES + 1), 8.0))
    same: Any = STUB(rate=8.0)
    assert resampled(same, 8.0) is same
    assert list(parts_of(TONE[:4])) == []
    assert guide_path(TONE, 8.0, 6.0, 6.0001, 6.0002).tolist() == [6.0] * 64
    still: Any = STUB(signal=STUB(search=STUB(guide=np.geomspace(1e-3, 1e-1, 64)), rate=8.0))
    assert followed_stretch(still) is None


def test_a_long_record_of_few_samples_a_cycle_is_not_thinned() -> None:
    t = np.arange(LONG + 64) / 8.0
    samples = Samples(np.cos(6.0 * t), 8.0, 0.0)
    few, search = decimated(samples, band=(5.0, 7.0))
    assert few is samples
    assert search is not None


def test_splines_over_few_samples_a_knot_are_read_in_parts_of_rows() -> None:
    """Beside the same in one part: every row of B_k(t_n) is a partition of 1."""
    size = 2 * ROWS + 17
    time = np.linspace(0.0, 1.0, size)
    inner = np.linspace(0.0, 1.0, size // 16)
    basis = SplineBasis(time, np.concatenate([[0.0] * 3, inner, [1.0] * 3]))
    parts = list(basis.parts())
    assert [part.rows.stop - part.rows.start for part in parts] == [ROWS, ROWS, 17]
    assert all(np.allclose(part.entries.sum(axis=1), 1.0) for part in parts)


def test_one_model_claims_no_interval() -> None:
    model: Any = STUB()
    request: Any = STUB(models=STUB(best=model, fine=model, coarse=model))
    assert global_harmonics.with_spline_interval(track(), request).no_interval == global_harmonics.ONE_MODEL


def test_least_squares_asked_for_globally_are_refused_not_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: object, **__: object) -> None:
        raise InputError("no model settles")

    monkeypatch.setattr(auto, "with_plan", none)
    asked: Any = STUB(options=STUB(scope=Scope.GLOBAL), lag_given=False)
    with pytest.raises(InputError, match="no model settles"):
        auto.for_least_squares(asked)

    class Blind:
        signal, margin = STUB(cycle=1.0), 0.0

        @property
        def models(self) -> None:
            raise InputError("no model")

    blind: Any = Blind()
    assert auto.in_best_window(blind) is blind


def test_attributes_that_are_no_lone_number_state_no_rate() -> None:
    with h5py.File("memory", "w", driver="core", backing_store=False) as file:
        file.attrs["rate"] = "eight"
        file.attrs["Sampling Rate"] = np.array([8.0, 9.0])
        assert list(attribute_numbers(file)) == []
        file.attrs["dt"] = 0.125
        assert [array.load() for array in attribute_numbers(file)] == [0.125]


# --- motions ---


def test_a_cycle_that_no_step_leads_to_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    away = STUB(time=1.0, peak=1.0, trough=-1.0)
    monkeypatch.setattr(limit_cycle, "_return", lambda _, peak, __: replace_peak(away, peak * math.exp(0.3)))
    with pytest.raises(InputError, match="no limit cycle found from peak 2"):
        limit_cycle._fixed_point(van_der_pol(1.0), 2.0, 1e-8)
    growing = iter(range(10**6))
    monkeypatch.setattr(
        limit_cycle, "_return", lambda _, peak, __: replace_peak(away, peak ** (1.5 + 0 * next(growing)))
    )
    with pytest.raises(InputError, match="no limit cycle found"):
        limit_cycle._fixed_point(van_der_pol(1.0), 9.0, 0.0)
    still: Any = STUB(turnings=STUB(time=np.zeros(0), value=np.zeros(0)))
    monkeypatch.undo()
    monkeypatch.setattr(limit_cycle, "integrate", lambda *_, **__: still)
    with pytest.raises(InputError, match="fewer than two peaks within 20 natural periods"):
        limit_cycle._settle(linear(mu=3.0), 1.0)
    with pytest.raises(InputError, match="no return to a peak within 64 natural periods"):
        limit_cycle._return(linear(mu=3.0), 1.0, 1e-8)
    assert limit_cycle._next_peak(STUB(turnings=STUB(time=np.arange(2.0), value=np.array([1.0, -1.0])))) is None


def replace_peak(orbit: Any, peak: float) -> Any:
    return STUB(**{**vars(orbit), "peak": peak})


def test_a_loss_that_changes_too_fast_is_not_tabulated(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(1)
    monkeypatch.setattr(action_loss, "cycles_of", lambda _, peaks: [STUB(rate=rng.normal()) for _ in peaks])
    monkeypatch.setattr(action_loss, "peak_of_action", lambda _, levels: levels)
    with pytest.raises(InputError, match="changes too fast with amplitude to be tabulated"):
        action_loss._table(duffing(eps=1.0), 0.0, 1.0)


def test_a_drift_of_a_nonlinear_oscillator_follows_its_averaged_loss() -> None:
    """With the parameters at rest, ln J falls by the averaged loss of action, here 2 mu of the linear oscillator."""
    own = linear(mu=0.02)
    drift = Drift(lambda *state: state[1], lambda _, u: 0.0 * u, lambda _: own, False, "k = 1")
    assert adiabatic._levels(drift, 0.0, 5.0)(np.array([0.0, 5.0])) == pytest.approx([0.0, -0.2], abs=1e-5)
    plain = replace(drift, linear=True)
    assert adiabatic._levels(plain, 0.0, 5.0)(np.array([5.0])) == pytest.approx([-0.2], abs=1e-6)


def test_a_force_without_a_value_along_the_signal_starts_no_fit() -> None:
    signal = STUB(
        rate_of_change=lambda: signal, values=lambda: TONE, omega=np.full(64, 6.0), rate=8.0, offset=np.zeros(64)
    )
    family = STUB(name="own", start=np.array([1.0]), forces=lambda u, *_: np.full(u.size, np.nan))
    with pytest.raises(InputError, match="own: the force has no value along this signal"):
        matched(family, signal, free_offset=False)
