"""``study FILE --format markdown``: whole tables that say what JSON says."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.ridgeback.conftest import Ridgeback

STUDY = '[study]\nask = "error"\n[grid]\norders = [2, 4]\namplitudes = [0.5, 1]\n[[oscillator]]\nsystem = "pendulum"\n'


def test_a_markdown_answer_has_every_row(ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.toml").write_text(STUDY, encoding="utf-8")
    lines = ridgeback("study", "s.toml", "--format", "markdown").out.splitlines()
    answer = json.loads(ridgeback("study", "s.toml", "--format", "json").out)["answers"][0]
    table = [[cell.strip() for cell in line.strip("| ").split("|")] for line in lines if line.startswith("| ")]
    assert len(table) == 2 + len(answer["rows"])
    column = table[0].index("largest")
    assert [float(row[column]) for row in table[2:]] == pytest.approx([r["largest"] for r in answer["rows"]], rel=1e-5)
    assert ridgeback("study", "pendulum", "--amplitudes", "1", "--format", "markdown").code == 2
