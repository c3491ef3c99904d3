"""The mark of the decimals of a table of text, in the verbs that read recordings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.ridgeback.conftest import Ridgeback


@pytest.mark.parametrize(
    "verb", ["estimate run.csv --method hilbert --format csv", "identify run.csv --candidates linear --format csv"]
)
def test_every_verb_that_reads_a_recording_takes_the_mark(
    verb: str, ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Decimals of three digits, all above one: read as thousands, the amplitude is a thousandfold."""
    monkeypatch.chdir(tmp_path)
    time = np.arange(200) / 10.0
    u = 5.0 + 3.0 * np.exp(-0.01 * time) * np.cos(2.0 * time)
    said = "t [ms]\tu\n" + "".join(f"{100 * i}\t{v:.3f}\n".replace(".", ",") for i, v in enumerate(u))
    (tmp_path / "run.csv").write_text(said)
    asked = ridgeback(*verb.split())
    assert (asked.code, "--decimal comma" in asked.err) == (2, True)
    commas = [ridgeback(*verb.split(), "--decimal", mark) for mark in ("comma", ",")]
    (tmp_path / "run.csv").write_text(said.replace(",", "."))
    points = ridgeback(*verb.split())
    assert commas[0].code == points.code == 0
    assert commas[0].out == commas[1].out == points.out


def test_a_report_takes_the_mark_of_its_recording_alone(ridgeback: Ridgeback) -> None:
    found = ridgeback("report", "pendulum", "--decimal", "comma", "-o", "page.html")
    assert (found.code, "--decimal belongs to --recording FILE" in found.err) == (2, True)
