"""Calls from Python beside the usual ones: other formulas, other kinds of report, what goes with what."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import ridgeback
from ridgeback.common.errors import InputError
from ridgeback.interface import benchmark, report
from ridgeback.interface.derive import in_its_place
from ridgeback.numeric.motion.dynamics import linear
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.catalogue import find

STUB: Any = SimpleNamespace
TIME = np.arange(96) / 8.0
DECAY = np.exp(-0.05 * TIME) * np.cos(6.0 * TIME)


def test_formulas_in_place_of_a_series_agree_where_both_hold() -> None:
    pendulum = find("pendulum")
    series = ridgeback.derive(pendulum, order=12)
    values = []
    for kind, terms in (("agm", 1), ("sine", 40), ("pade", 1)):
        formula = in_its_place(pendulum, series, kind, terms=terms, degrees=None, growth=0, up_to=None)  # type: ignore[arg-type]
        values.append(float(formula(1.0)) if callable(formula) else None)
    known = [value for value in values if value is not None]
    assert known == pytest.approx([float(series(1.0))] * len(known), rel=1e-8)
    with pytest.raises(InputError, match="resummed belongs to a series in one variable"):
        in_its_place(pendulum, STUB(), "pade", terms=1, degrees=None, growth=0, up_to=None)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: ridgeback.report(drift={"L": "1+t/9"}), "a drift needs an oscillator whose parameters change"),
        (lambda: ridgeback.report("pendulum", study="kept.db"), "leave"),
        (
            lambda: ridgeback.simulate(linear(), (1.0, 0.0), duration=9.0, rate=8.0, drift={"k": "1"}),
            "no parameters left",
        ),
        (
            lambda: ridgeback.simulate("linear", (1.0, 0.0), duration=9.0, rate=8.0, drift={"k": "1"}, method="taylor"),
            "taylor follows no drift; use one of",
        ),
    ],
)
def test_what_does_not_go_together_is_refused(call: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        call()


def test_a_report_is_made_of_what_it_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    made = {
        "study_report": lambda store, **_: ("study", store),
        "runs_report": lambda signals, **_: ("runs", len(signals)),
        "recording_report": lambda _, oscillator, **__: ("recording", getattr(oscillator, "title", None)),
    }
    for name, function in made.items():
        monkeypatch.setattr(report, name, function)
    assert ridgeback.report(study="kept.db") == ("study", "kept.db")
    assert ridgeback.report(recording=[Recording.from_arrays(DECAY, 8.0)] * 2) == ("runs", 2)
    assert ridgeback.report(recording=DECAY, rate=8.0) == ("recording", None)
    assert ridgeback.report("duffing", recording=DECAY, rate=8.0, title="own") == ("recording", "own")


def test_the_paper_s_motion_stands_where_no_oscillator_is_named() -> None:
    paper = report.simulated(None, parameters=None, about=None, initial=None, duration=3.0, rate=None)
    assert paper.oscillator.kind == "damped"
    assert paper.duration == 3.0
    assert paper.initial[0] == pytest.approx(0.95 * np.pi)


def test_half_cycles_as_a_backbone_have_the_recording_s_units() -> None:
    found = ridgeback.backbone(DECAY, 8.0, method="half-cycles")
    assert found.omega == pytest.approx(6.0, rel=0.05)
    assert benchmark._at(DECAY, 8.0, lambda x, rate: (x.size, rate)) == (96, 8.0)  # type: ignore[arg-type, return-value]


def test_heyoka_integrates_where_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    from ridgeback.interface import simulate

    monkeypatch.setattr(simulate, "integrate_heyoka", lambda system, start, **_: (system.name, start))
    assert ridgeback.simulate("pendulum", (1.0, 0.0), duration=9.0, method="heyoka") == ("pendulum", (1.0, 0.0))
