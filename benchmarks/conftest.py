"""After the run: the paired measurements of ``docs/results/speed.md``, written to ``benchmarks/table.md``."""

from __future__ import annotations

import os
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest

TABLE = Path(__file__).with_name("table.md")
HEAD = "| series | by hand | Ridgeback | ratio |\n|---|---|---|---|\n"


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Pair the best times of each (series, who) and write them as Markdown, when any pair was measured."""
    benchmarks = getattr(getattr(session.config, "_benchmarksession", None), "benchmarks", [])
    best: dict[str, dict[str, float]] = {}
    for item in benchmarks:
        if "series" in item.extra_info and item.stats.data:
            best.setdefault(item.extra_info["series"], {})[item.extra_info["who"]] = item.stats.min
    rows = [row(series, found) for series, found in best.items() if len(found) == 2]
    if rows:
        TABLE.write_text(f"{HEAD}{''.join(rows)}\n{surroundings()}\n", encoding="utf-8")


def surroundings() -> str:
    """With what it was measured, and how to measure it again."""
    versions = ", ".join(f"{name} {version(name)}" for name in ("ridgeback", "python-flint", "sympy"))
    machine = f"{platform.machine()} with {os.cpu_count()} cores"
    return f"Python {platform.python_version()}, {versions}; {machine}; by `python -m pytest benchmarks`."


def row(series: str, found: dict[str, Any]) -> str:
    """One line: both times in seconds and their ratio."""
    hand, ours = found["by hand"], found["Ridgeback"]
    return f"| {series} | {seconds(hand)} | {seconds(ours)} | {ours / hand:.2g} |\n"


def seconds(value: float) -> str:
    """Two digits.

    >>> seconds(0.1234), seconds(437.2)
    ('0.12 s', '440 s')
    """
    return f"{float(f'{value:.2g}'):g} s"
