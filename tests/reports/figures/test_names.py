"""Names of users in pictures: characters that act, and such that no XML may hold, are drawn as their escapes."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from ridgeback.compare.recording.measurements import measure_recordings
from ridgeback.numeric.recording.recording import Recording
from ridgeback.reports.figures.recordings.measurement import plot_file

ACTING = "\x00\x07\x1b\x9f\u202e\u2066\ufffe\udcff"


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_no_character_of_a_name_acts(kind: str) -> None:
    time = np.arange(400) / 20.0
    values = np.exp(-0.05 * time) * np.cos(6.0 * time)
    first = Recording(time, values, 20.0, f"a{ACTING}", "", "one.csv", "")
    found = measure_recordings([first, replace(first, name="b", source=f"two{ACTING}.csv")], method="hilbert")
    data = plot_file(found, kind)
    assert data
    if kind == "svg":
        text = data.decode()
        assert not re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ufffe\uffff]", text)
        assert r"a\x00\x07\x1b\x9f\u202e" in " ".join(e.text or "" for e in ElementTree.fromstring(text).iter())  # noqa: S314 - ours
