"""Studies from TOML: what is read is what is written, and what cannot run is refused with file, line and key."""

from __future__ import annotations

import itertools
import json
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.compare.studies.examples import NAMES, example
from ridgeback.compare.studies.file import reading
from ridgeback.compare.studies.file.axes import exact_values
from ridgeback.compare.studies.file.lines import keys, line_of
from ridgeback.compare.studies.file.overrides import literal
from ridgeback.compare.studies.file.reading import plan_of
from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import differences, plan_from

TEXT = """\
# a comment, with [brackets] = inside
[study]
title = "small"
ask = ["error"]

[grid]
orders = [2, 4]
amplitudes = [0.5, 1]
methods = [
    "lindstedt",
    "pade",
]

[[oscillator]]
system = "pendulum"
parameters = { mu = [0.01, "1/50"], k = 2 }

[[oscillator]]
name = "own"
equation = "u'' + u + c*u**3 = 0"
[oscillator.parameters]
c = 0.5

[signal]
seed = 3
"""


def test_a_study_is_what_its_file_says() -> None:
    plan = plan_of(TEXT)
    assert plan.orders == (2, 4)
    assert plan.methods == ("lindstedt", "pade")
    assert plan.title == "small"
    assert [s.system.name for s in plan.subjects] == ["pendulum", "pendulum", "own"]
    assert [dict(s.system.parameters) for s in plan.subjects] == [
        {"k": "2", "mu": "1/100"},
        {"k": "2", "mu": "1/50"},
        {"c": "1/2"},
    ]
    assert plan.parameters == ("mu", "k", "c")


@pytest.mark.parametrize("name", NAMES)
def test_examples_are_studies_that_survive_json(name: str) -> None:
    plan = plan_of(example(name))
    assert plan_from(json.loads(json.dumps(plan.to_dict()))) == plan
    assert differences(plan.to_dict(), json.loads(json.dumps(plan.to_dict()))) == []


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("orders = [2, 4]", "orders = [2, -4]", "s.toml, line 7, grid.orders: holds -4; give whole numbers"),
        ("orders = [2, 4]", "order = [2, 4]", "s.toml, line 7, grid.order: no such key; [grid] may have amplitudes"),
        ('    "pade",', '    "pode",', "s.toml, line 9, grid.methods: no method 'pode' for this question; there are"),
        ('"error"', '"errors"', "s.toml, line 4, study.ask: no question 'errors'; there are error"),
        ('"pendulum"', '"pendulun"', "s.toml, line 15, oscillator.1.system: no system 'pendulun'; did you mean pendul"),
        ("mu = [0.01", "nu = [0.01", "s.toml, line 16, oscillator.1.parameters.nu: pendulum has no parameter 'nu'"),
        ('"1/50"', '"1/0"', "s.toml, line 16, oscillator.1.parameters.mu: '1/0' is not a number"),
        ("c*u**3", "c*u**", "s.toml, line 20, oscillator.2.equation: "),
        ("c = 0.5", "d = 0.5", "s.toml, line 22, oscillator.2.parameters.d: own has no parameter 'd'"),
        ("c = 0.5", "", "s.toml, line 21, oscillator.2.parameters: own: parameter c has no value; give it one"),
        ("seed = 3", "sead = 3", "s.toml, line 25, signal.sead: no such key; [signal] may have"),
        ("seed = 3", "seed = -3", "s.toml, line 25, signal.seed: -3 is not a whole number from 0"),
        ("seed = 3", "duration = 3.0", "s.toml, line 25, signal.duration: needs rate beside it"),
        ("[signal]", "[signals]", "s.toml, line 24, signals: a study has no table 'signals'"),
        ("amplitudes = [0.5, 1]", "", "s.toml, line 6, grid.amplitudes: is missing; give amplitudes"),
        (
            "[0.5, 1]",
            "{ from = 2, to = 1, count = 3 }",
            "s.toml, line 8, grid.amplitudes: from = 2 is not below to",
        ),
        ("[0.5, 1]", "[0.5, 0.5]", "s.toml, line 8, grid.amplitudes: holds 0.5 twice"),
        ("[0.5, 1]", "[0.5, nan]", "s.toml, line 8, grid.amplitudes: NaN is not a finite number"),
        ("[0.5, 1]", "[0.5, 1", "s.toml is not TOML: "),
        ("[0.5, 1]", "[]", "s.toml, line 8, grid.amplitudes: is an empty list; give"),
        ("[0.5, 1]", "[0.5, true]", "s.toml, line 8, grid.amplitudes: True is not a number"),
        ("[0.5, 1]", "[0.5, 1e500]", "s.toml, line 8, grid.amplitudes: '1E+500' has an exponent beyond 400"),
        ("[0.5, 1]", "[0.5, 1e320]", "s.toml, line 8, grid.amplitudes: holds a number beyond the largest double"),
        ("[0.5, 1]", '[0.5, "1e3"]', "s.toml, line 8, grid.amplitudes: '1e3' is not a number; write it without quotes"),
        ("[0.5, 1]", "{ from = 1, to = 2 }", "s.toml, line 8, grid.amplitudes: lacks 'count'; a range is"),
        (
            "[0.5, 1]",
            "{ from = 1, to = 2, count = 3, step = 1 }",
            "s.toml, line 8, grid.amplitudes: has 'step'; a range is",
        ),
        (
            "[0.5, 1]",
            "{ from = 1, to = 2, count = 1 }",
            "s.toml, line 8, grid.amplitudes: count = 1 is not a whole number from 2",
        ),
        (
            "[0.5, 1]",
            '{ from = 1, to = 2, count = 3, spacing = "cubic" }',
            "s.toml, line 8, grid.amplitudes: spacing = 'cubic' is neither",
        ),
        (
            "[0.5, 1]",
            '{ from = 0, to = 2, count = 3, spacing = "log" }',
            "s.toml, line 8, grid.amplitudes: from = 0 has no logarithm",
        ),
        ('"small"', "5", "s.toml, line 3, study.title: 5 is not text; put it in quotation marks"),
        ('["error"]', "[]", "s.toml, line 4, study.ask: is an empty list; give one or more"),
        (
            '["error"]',
            '["error", "range"]',
            "s.toml, line 4, study.ask: error and range are answered from different cells",
        ),
        ('ask = ["error"]', "", "s.toml, line 2, study.ask: is missing; "),
        ("[signal]", "[[signal]]", "s.toml, signal: write it as a table, [signal]"),
        ('system = "pendulum"', "", "s.toml, line 14, oscillator.1: neither system nor equation"),
        (
            'system = "pendulum"',
            'system = "pendulum"\nequation = "u\'\' + u = 0"',
            "s.toml, line 14, oscillator.1: both system and equation",
        ),
        ('"own"', '"a;b"', "s.toml, line 19, oscillator.2.name: 'a;b' is no name"),
        ('{ mu = [0.01, "1/50"], k = 2 }', "3", "s.toml, line 16, oscillator.1.parameters: 3 is not a table"),
        (
            "k = 2",
            "k = { from = 1, to = 2, count = 10000 }",
            "s.toml, line 16, oscillator.1.parameters: more than 10000 combinations",
        ),
        (
            "[2, 4]",
            "[2, 4]\ndamping = 0.1",
            "s.toml, line 8, grid.damping: the damping mu is among the parameters of oscillator.1",
        ),
        (
            "seed = 3",
            "periods = 5\nduration = 3.0\nrate = 2",
            "s.toml, line 25, signal.periods: stands beside duration",
        ),
        ("seed = 3", "duration = 3.0\nrate = [1, 2]", "s.toml, line 26, signal.rate: has 2 values; give one"),
    ],
)
def test_a_study_that_cannot_run_is_refused_with_its_place(before: str, after: str, message: str) -> None:
    assert before in TEXT
    with pytest.raises(InputError) as refusal:
        plan_of(TEXT.replace(before, after), name="s.toml")
    assert str(refusal.value).startswith(message)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("order", "2", "--set 'order': a study has no such key"),
        ("study.title.x", "1", "--set study.title.x: study.title is a value, not a table"),
        ("oscillator.name", "x", "--set oscillator.name: say which oscillator, as in oscillator.1.name"),
        ("grid.orders", "x", "--set grid.orders: 'x' is not a number"),
        ("oscillator.3.name", "x", "--set oscillator.3.name: '3' is no number from 1 to 2"),
        ("oscillator.1.parameters.zeta", "1", "--set oscillator.1.parameters.zeta: pendulum has no parameter 'zeta'"),
    ],
)
def test_an_override_that_cannot_be_is_refused_by_its_option(key: str, value: str, message: str) -> None:
    with pytest.raises(InputError) as refusal:
        plan_of(TEXT, name="s.toml", overrides=[(key, value)])
    assert str(refusal.value).startswith(message)


def test_a_study_of_nothing_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match=r"s\.toml: no oscillator; write \[\[oscillator\]\]"):
        plan_of(TEXT[: TEXT.index("[[oscillator]]")], name="s.toml")
    with pytest.raises(InputError, match="own has no parameter mu"):
        plan_of(TEXT.replace('mu = [0.01, "1/50"], ', "").replace("[2, 4]", "[2, 4]\ndamping = 0.1"))
    with pytest.raises(InputError, match="nothing is asked; ask one of error"):
        measure_of(())
    with pytest.raises(InputError, match="no example 'six-oscillators'; there are"):
        example("six-oscillators")
    monkeypatch.setattr(reading, "MOST_CELLS", 23)
    with pytest.raises(InputError, match=r"s\.toml: more than 23 cells; give fewer"):
        plan_of(TEXT, name="s.toml")


def test_overrides_take_the_place_of_the_file() -> None:
    plan = plan_of(TEXT, overrides=[("orders", "2,8"), ("oscillator.1.parameters.mu", "0.5"), ("methods", "map")])
    assert plan.orders == (2, 8)
    assert plan.methods == ("map",)
    assert [dict(s.system.parameters).get("mu") for s in plan.subjects] == ["1/2", None]
    assert differences(plan_of(TEXT).to_dict(), plan.to_dict())[:2] == [
        "subjects.1.system.parameters was [['k', '2'], ['mu', '1/100']], is [['k', '2'], ['mu', '1/2']]",
        "subjects.2.system.name was pendulum, is own",
    ]


@given(st.lists(st.sampled_from(["[grid]", "[[oscillator]]", "a = 1", 'b = """', '"""', "c.d = 2", "# e = 3", ""])))
def test_lines_are_found_whatever_the_text(lines: list[str]) -> None:
    text = "\n".join(lines)
    for path, number in keys(text):
        assert 1 <= number <= len(lines)
        assert line_of(text, path) is not None


@given(st.fractions(0, 10), st.fractions(11, 20), st.integers(2, 40))
def test_a_linear_range_is_exact_and_holds_both_ends(start: Fraction, stop: Fraction, count: int) -> None:
    given_range = {"from": f"{start}", "to": f"{stop}", "count": count}
    values = exact_values(given_range)
    assert values[0] == start
    assert values[-1] == stop
    assert len({b - a for a, b in itertools.pairwise(values)}) == 1


@given(st.text(max_size=30))
def test_a_literal_is_a_value_and_never_runs(text: str) -> None:
    assert isinstance(literal(text), bool | int | float | str | list | dict | object)


def test_an_oscillator_may_have_a_signal_of_its_own() -> None:
    own = TEXT.replace("k = 2 }", "k = 2 }\nsignal = { duration = 9, rate = 8, trials = 4 }")
    shared = own.replace("seed = 3", "seed = 3\nperiods = 20")
    first, _, last = plan_of(shared).subjects
    assert (first.signal.lengths, first.signal.periods, first.signal.trials, first.signal.seed) == ((9.0,), False, 4, 3)
    assert (last.signal.lengths, last.signal.periods, last.signal.seed) == ((20.0,), True, 3)
    for wrong, message in (
        ("trials = 1", "oscillator.1.signal.trials: 1 is not"),
        ("trial = 4", "oscillator.1.signal: "),
    ):
        with pytest.raises(InputError) as refusal:
            plan_of(shared.replace("trials = 4", wrong), name="s.toml")
        assert str(refusal.value).startswith("s.toml, line 17, " + message)
