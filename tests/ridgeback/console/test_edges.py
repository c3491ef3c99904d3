"""The console where the system gives less than usual: no thread of its own, no buffer, no answer, other versions."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import EntryPoint
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from ridgeback.common import files
from ridgeback.common.elementary import Tangent
from ridgeback.common.errors import InputError
from ridgeback.common.number_ring import FLOATS
from ridgeback.common.numbers import number
from ridgeback.common.plugins import guarded
from ridgeback.common.progress import is_terminal
from ridgeback.common.recurrences import Input
from ridgeback.common.show.displayed import Displayed
from ridgeback.console import browser, cluster, output, processes, stops, surroundings
from ridgeback.console.failure import Exit, verdict
from ridgeback.console.verb import is_file

STUB: Any = SimpleNamespace


def elsewhere(call: Any) -> Any:
    """Call it in a thread that is not the main one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(call).result()


def test_only_the_main_thread_answers_signals() -> None:
    def inside() -> list[object]:
        before = signal.getsignal(signal.SIGTERM)
        with stops.stoppable(), processes._ignoring_interrupts():
            return [before is signal.getsignal(signal.SIGTERM)]

    assert elsewhere(inside) == [True]


def test_a_process_without_a_parent_waits_for_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "parent_process", lambda: None)
    processes._end_after_parent()
    ended = []
    monkeypatch.setattr(processes, "parent_process", lambda: STUB(sentinel=1))
    monkeypatch.setattr(processes, "wait", ended.append)
    monkeypatch.setattr(os, "_exit", ended.append)
    processes._end_after_parent()
    assert ended == [[1], 1]


def test_standard_output_without_a_buffer_is_written_as_text(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = io.StringIO()
    monkeypatch.setattr(sys, "stdout", plain)
    output.print_text("α\n")
    assert plain.getvalue() == "α\n"


def test_a_text_in_parts_is_whole_in_a_file(tmp_path: Path) -> None:
    output.write_parts(str(tmp_path / "whole.txt"), iter(["first\n", "zweite\x1b\n"]))
    assert (tmp_path / "whole.txt").read_text(encoding="utf-8").startswith("first\nzweite")
    assert "\x1b" not in (tmp_path / "whole.txt").read_text(encoding="utf-8")


def test_places_that_may_not_be_written_are_refused_before_the_work(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    for place in ("/dev/tty", str(tmp_path / "x")):
        with pytest.raises(PermissionError, match="No permission to write"):
            output.check_writable(place)


def test_another_writer_that_took_the_file_for_abandoned_costs_a_second_try(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    real, gone = os.fstat, iter([True])
    monkeypatch.setattr(os, "fstat", lambda d: STUB(st_nlink=0) if next(gone, False) else real(d))
    with files.locked_beside(tmp_path / "x") as (_, temporary):
        assert temporary.parent == tmp_path
    monkeypatch.setattr(files, "fcntl", None)
    assert files.held(0, wait=False) is False


def test_a_browser_that_does_not_end(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def hanging(*_: object, **__: object) -> None:
        raise subprocess.TimeoutExpired("chromium", 1.0)

    monkeypatch.setattr(browser.shutil, "which", lambda name: f"/usr/bin/{name}")
    monkeypatch.setattr(subprocess, "run", hanging)
    (tmp_path / "page.html").write_text("<head></head>", encoding="utf-8")
    with pytest.raises(OSError, match="did not print within"):
        browser.print_to_pdf(str(tmp_path / "page.html"), str(tmp_path / "page.pdf"))


def test_workers_that_are_missing_or_of_another_version() -> None:
    def nobody(*_: object, **__: object) -> None:
        raise OSError("timed out")

    with pytest.raises(OSError, match="the scheduler has no worker; start one: dask worker tcp://x"):
        cluster._check_workers(STUB(wait_for_workers=nobody), "tcp://x")
    others = STUB(wait_for_workers=lambda *_, **__: None, run=lambda _: {"tcp://y": "0.0.9"})
    with pytest.raises(InputError, match=r"worker tcp://y has ridgeback 0\.0\.9, this is"):
        cluster._check_workers(others, "tcp://x")


def test_a_number_beyond_the_largest_double_is_bad_input() -> None:
    code, said = verdict(OverflowError("math range error"))
    assert code is Exit.BAD_INPUT
    assert "beyond the largest double" in said


def test_what_is_not_installed_states_no_versions(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(_: str) -> None:
        raise surroundings.PackageNotFoundError

    monkeypatch.setattr(surroundings, "requires", missing)
    assert surroundings.lowest() == {}


def test_small_words_and_rings() -> None:
    assert [number(x) for x in (float("inf"), float("-inf"))] == ["∞", "−∞"]
    assert is_terminal(STUB()) is False
    assert is_file("a\0b") is False
    with pytest.raises(InputError, match="has no picture of its own"):
        Displayed().picture()
    own = InputError("its own word")

    def refusing() -> None:
        raise own

    with pytest.raises(InputError, match="its own word") as kept:
        guarded(EntryPoint("x", "y:z", "g"), refusing)
    assert kept.value is own


def test_recurrences_that_forget_compute_again() -> None:
    ring = FLOATS
    tangent = Tangent(ring, "tan", Input(ring, [0.0, 1.0, 0.0, 0.0]))
    whole = [tangent.get(n) for n in range(4)]
    assert whole == pytest.approx([0.0, 1.0, 0.0, 1.0 / 3.0])
    tangent.forget(2)
    assert [tangent.get(n) for n in range(4)] == pytest.approx(whole)
    assert ring.power(3.0, -2, 1) == pytest.approx(1.0 / 9.0)
    with pytest.raises(AssertionError, match="before it was supplied"):
        Input(ring, [1.0]).get(1)
