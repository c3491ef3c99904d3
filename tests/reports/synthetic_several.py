"""Pages about more than one thing, made up quickly: two runs of a spring, a study of three oscillators."""

from __future__ import annotations

import numpy as np

from ridgeback.common.show.picture import Picture, Stroke
from ridgeback.compare.recording.measurements import measure_recordings
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.several.answered import Answered, Subject
from ridgeback.compare.report.several.runs import Named, Runs
from ridgeback.compare.studies.answer import Answer
from ridgeback.compare.studies.tasks import Column
from ridgeback.numeric.recording.recording import Recording
from tests.reports import synthetic

EMPTY = synthetic.empty_report()


def make_answer(question: str, *, steps: bool = False) -> Answer:
    a = np.geomspace(0.05, 2.0, 20)
    strokes = tuple(
        Stroke(a, np.where(a > 1, n + 2.0, n) if steps else 1e-2 * a ** (n + 2), f"order {n}", steps=steps)
        for n in (2, 4, 8)
    )
    rows = tuple({"oscillator": name, "order": n, "largest": 10.0**-n} for name in ("spring", "swing") for n in (2, 8))
    columns = (Column("oscillator", "", "its name"), Column("order", "1", "power"), Column("largest", "1", "error"))
    drawing = Picture("error", "amplitude", "order" if steps else "relative error", strokes, None, not steps)
    return Answer(question, "what was asked", columns, rows, ("spring: one", "swing: two"), drawing, 1)


def study_report() -> Report:
    answers = (make_answer("error"), make_answer("order-needed", steps=True))
    subjects = tuple(Subject(name, r"\ddot{u} + u + \varepsilon u^{3} = 0", "ε = 1") for name in ("spring", "swing"))
    panels = tuple(make_answer("error").drawing for _ in range(5))
    answered = Answered(subjects, panels, answers, (("no motion of amplitude 4", 2),))
    return Report(
        **{
            **{name: getattr(EMPTY, name) for name in EMPTY.__dataclass_fields__},
            "title": "Three oscillators: order 8 errs at most 1 %",
            "lead": "60 cells.",
            "answered": answered,
            "csv": {"error.csv": "a,b\n"},
        }
    )


def runs_report() -> Report:
    t = np.arange(640) / 32.0
    rng = np.random.default_rng(1)
    recordings = [
        Recording(t, a * np.exp(-0.05 * t) * np.cos(6.0 * t) + 0.001 * rng.normal(size=640), 32.0, "u", "mm", f, "")
        for a, f in ((1.0, "first.csv"), (2.0, "second.csv"))
    ]
    found = measure_recordings(recordings, method="zero-crossing")
    named = (Named("first", synthetic.make_identification()), Named("second", None, "too few cycles"))
    return Report(
        **{
            **{name: getattr(EMPTY, name) for name in EMPTY.__dataclass_fields__},
            "title": "2 signals agree",
            "lead": "first.csv, second.csv",
            "runs": Runs(found, ("first", "second"), None, named),
        }
    )
