"""A study from a TOML file: everything is checked before any work, and a message names file, line and key."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.files import read_regular
from ridgeback.compare.studies.file.axes import floats, shown, whole_numbers
from ridgeback.compare.studies.file.keys import check_keys, given, text_of, texts, value_of
from ridgeback.compare.studies.file.oscillators import subjects
from ridgeback.compare.studies.file.overrides import overridden
from ridgeback.compare.studies.file.places import Source
from ridgeback.compare.studies.file.signals import signal_of
from ridgeback.compare.studies.measures.by_name import measure_of
from ridgeback.compare.studies.plan import Plan
from ridgeback.compare.studies.tasks import Measure

MAX_BYTES = 1_000_000
MOST_CELLS = 20_000_000


def read_plan(path: str | Path, *, overrides: Sequence[tuple[str, str]] = ()) -> Plan:
    """Read a study from a file.

    Parameters
    ----------
    path : str or Path
        A TOML file with the tables ``[study]``, ``[[oscillator]]``, ``[grid]`` and ``[signal]``.
    overrides : sequence of (str, str)
        Keys, with points between or by their last name alone, and their values as TOML or as a list with commas.

    Returns
    -------
    Plan
        The study, checked whole.

    Raises
    ------
    InputError
        For anything that cannot be run as it stands, with file, line and key.
    OSError
        For a file that cannot be read.
    """
    file = Path(path)
    data = read_regular(file, MAX_BYTES, "a study is a page of text")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"{file} is not text in UTF-8: {error}") from None
    return plan_of(text, name=str(file), overrides=overrides)


def plan_of(text: str, *, name: str = "study", overrides: Sequence[tuple[str, str]] = ()) -> Plan:
    r"""Read a study from TOML text.

    Parameters
    ----------
    text : str
        As in a file.
    name : str
        What the text is called in messages.
    overrides : sequence of (str, str)
        As for :func:`read_plan`.

    Returns
    -------
    Plan
        The study.

    Raises
    ------
    InputError
        As :func:`read_plan`.

    Examples
    --------
    >>> text = '[study]\nask = "error"\n[[oscillator]]\nsystem = "pendulum"\n[grid]\norders = 2\namplitudes = 0'
    >>> plan_of(text)
    Traceback (most recent call last):
        ...
    ridgeback.compare.studies.file.places.LocatedError: study, line 7, grid.amplitudes: holds 0; give numbers above 0
    >>> plan_of(text, overrides=[("amplitudes", "0.5,1")]).subjects[0].amplitudes
    (0.5, 1.0)
    """
    table = parsed(text, name)
    paths = frozenset(overridden(table, key, value) for key, value in overrides)
    source = Source(name, text, paths)
    check_keys(source, table)
    with source.at("study.ask"):
        ask = texts(value_of(table, "study.ask", missing='ask one or more questions, such as ask = ["error"]'))
        measure = measure_of(ask)
    grid, signal = table.get("grid", {}), table.get("signal", {})
    plan = Plan(
        ask=ask,
        subjects=tuple(subjects(source, table)),
        orders=given(source, grid, "grid.orders", lambda v: whole_numbers(v, low=0, high=400), (2, 4, 8, 16)),
        methods=given(source, grid, "grid.methods", lambda v: methods(v, measure), measure.defaults),
        tolerances=given(source, grid, "grid.tolerances", lambda v: floats(v, low=0.0, high=1.0), (1e-3, 1e-6)),
        signal=signal_of(source, signal),
        title=given(source, table["study"], "study.title", text_of, ""),
    )
    check_size(source, plan, measure)
    return plan


def parsed(text: str, name: str) -> dict[str, Any]:
    """The tables of a TOML text, its decimals exact."""
    try:
        return tomllib.loads(text, parse_float=Decimal)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{name} is not TOML: {error}") from None
    except RecursionError:
        raise InputError(f"{name} nests its values too deeply") from None


def is_study(path: Path) -> bool:
    """Whether a file is TOML with a table ``[study]``, or would be if it were whole."""
    try:
        text = read_regular(path, MAX_BYTES, "a study is a page of text").decode("utf-8")
    except (OSError, ValueError):
        return False
    try:
        return isinstance(tomllib.loads(text).get("study"), dict)
    except (tomllib.TOMLDecodeError, RecursionError):
        return re.search(r"^\s*(\[\s*study\s*\]|study\s*[.=])", text, re.MULTILINE) is not None


def methods(value: Any, measure: Measure) -> tuple[str, ...]:
    """Methods that the measure knows."""
    names = texts(value)
    unknown = [name for name in names if name not in measure.methods]
    if unknown:
        raise InputError(f"no method {shown(unknown[0])} for this question; there are {', '.join(measure.methods)}")
    return names


def check_size(source: Source, plan: Plan, measure: Measure) -> None:
    """Refuse what no machine finishes; counted by blocks, before one is computed."""
    cells = 0
    for task in measure.tasks(plan):
        cells += len(task.cells())
        if cells > MOST_CELLS:
            raise InputError(f"{source.name}: more than {MOST_CELLS} cells; give fewer amplitudes, orders or methods")
