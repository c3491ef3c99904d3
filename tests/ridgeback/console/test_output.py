"""Files appear whole or not at all, and JSON holds only what JSON knows."""

from __future__ import annotations

import json
import math
import os
import stat
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import click
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.cli import main
from ridgeback.common.files import current_umask, locked_beside
from ridgeback.console import output, tables


def test_a_file_is_replaced_in_one_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "out.csv"
    target.write_text("before", encoding="utf-8")

    def broken(self: Path, _: Path) -> Path:
        raise OSError(28, "No space left on device", str(self))

    monkeypatch.setattr(Path, "replace", broken)
    with pytest.raises(OSError, match="No space"):
        output.write_text(str(target), "after")
    assert target.read_text(encoding="utf-8") == "before"
    assert list(tmp_path.iterdir()) == [target]


def test_an_interrupt_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        output.write_text(str(tmp_path / "out.csv"), "text")
    assert not list(tmp_path.iterdir())


def test_what_a_killed_writer_left_is_cleared_and_a_living_ones_is_not(tmp_path: Path) -> None:
    target, other = tmp_path / "out.csv", tmp_path / ".else.csv.12.part"
    other.write_text("of another target")
    (tmp_path / ".out.csv.dead0.part").write_text("half")
    with locked_beside(target) as (_, alive):
        output.write_text(str(target), "whole")
        assert sorted(tmp_path.iterdir()) == sorted([other, alive, target])
        alive.unlink()
    assert target.read_text() == "whole"


def test_links_and_modes_are_kept(tmp_path: Path) -> None:
    real, link = tmp_path / "real.txt", tmp_path / "link.txt"
    real.write_text("before", encoding="utf-8")
    real.chmod(0o640)
    link.symlink_to(real)
    output.write_text(str(link), "after")
    assert link.is_symlink()
    assert real.read_text(encoding="utf-8") == "after"
    assert stat.S_IMODE(real.stat().st_mode) == 0o640


def test_a_new_file_has_the_usual_mode(tmp_path: Path) -> None:
    output.write_text(str(tmp_path / "new.txt"), "x")
    assert stat.S_IMODE((tmp_path / "new.txt").stat().st_mode) == 0o666 & ~current_umask()


def test_devices_are_written_and_not_replaced() -> None:
    output.write_text(os.devnull, "gone")
    assert not Path(os.devnull).is_file()


@pytest.mark.parametrize(
    ("path", "error"),
    [(".", IsADirectoryError), ("missing/out.csv", FileNotFoundError)],
)
def test_places_that_cannot_be_written_are_refused_before_the_work(
    path: str, error: type[OSError], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error):
        output.check_writable(path)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=4),
    max_leaves=12,
)


@settings(deadline=None, max_examples=100)
@given(JSON)
def test_json_is_strict_whatever_the_value(value: object) -> None:
    text = output.json_text(value)
    assert text.endswith("\n")

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    json.loads(text, parse_constant=refuse)


def test_arrays_and_exact_numbers_become_json() -> None:
    value = {
        "omega": np.array([1.0, np.nan]),
        "n": np.int64(3),
        "ok": np.bool_(True),
        "c": Fraction(-1, 16),
        "t": (1, 2),
    }
    assert output.plain(value) == {"omega": [1.0, None], "n": 3, "ok": True, "c": "-1/16", "t": [1, 2]}


@settings(deadline=None)
@given(st.floats())
def test_csv_floats_are_read_back_the_same(value: float) -> None:
    text = tables.cell(value)
    if math.isfinite(value):
        assert float(text).hex() == value.hex()
    else:
        assert text == ""


def test_outputs_are_kept_apart_by_their_resolved_paths(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "real.csv").touch()
    (tmp_path / "link.csv").symlink_to("real.csv")
    output.keep_apart({"-o": "-", "--plot": None}, ["-", None])
    output.keep_apart({"-o": "a.csv", "--plot": "b.svg"}, ["real.csv"])
    output.keep_apart({"-o": os.devnull, "--checkpoint": os.devnull}, [os.devnull])
    for other in ("link.csv", str(tmp_path / "real.csv")):
        with pytest.raises(click.UsageError, match="is a file that is read too"):
            output.keep_apart({"-o": other}, ["real.csv"])
        with pytest.raises(click.UsageError, match="is the file of -o too"):
            output.keep_apart({"-o": "real.csv", "--plot": other})


VERBS = ("derive", "generate", "simulate", "study", "report", "systems")


@pytest.mark.parametrize("verb", VERBS)
def test_no_verb_writes_over_the_description_it_reads(
    verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = "[oscillator]\nequation = \"u'' + u + u**3 = 0\"\n"
    source = tmp_path / "mine.toml"
    source.write_text(text)
    (tmp_path / "link").symlink_to(source)
    (tmp_path / "hard").hardlink_to(source)
    (tmp_path / "folder").mkdir()
    for name in ("mine.toml", "./mine.toml", str(source), "folder/../mine.toml", "link", "hard"):
        assert main([verb, "mine.toml", "-o", name]) == 2
        assert "is a file that is read too" in capsys.readouterr().err
    assert source.read_text() == text


def test_a_read_only_file_is_not_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kept = tmp_path / "kept.txt"
    kept.write_text("kept")
    kept.chmod(0o444)
    assert main(["systems", "-o", str(kept)]) == 4
    assert "read-only" in capsys.readouterr().err
    assert kept.read_text() == "kept"


def test_names_of_open_files_are_written_to_and_never_replaced(tmp_path: Path) -> None:
    script = """
        write() { "$PYTHON" -c 'import sys; from ridgeback.console.output import write_text
write_text(sys.argv[1], "text")' "$1"; }
        write /dev/stdout > plain.txt
        echo before > more.txt; write /dev/stdout >> more.txt
        write /dev/stdout | cat > piped.txt
        write >(cat > substituted.txt); sleep 1
        write /dev/stderr 2> error.txt
        mkfifo pipe; cat pipe > fifo.txt & write pipe; wait
        write /dev/fd/77 2>/dev/null; echo $?
    """
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3]), "PYTHON": sys.executable}
    done = subprocess.run(
        ["bash", "-c", script], cwd=tmp_path, env=environment, stdout=subprocess.PIPE, text=True, check=False
    )
    for name in ("plain.txt", "piped.txt", "substituted.txt", "error.txt", "fifo.txt"):
        assert (tmp_path / name).read_text() == "text", name
    assert (tmp_path / "more.txt").read_text() == "before\ntext"
    assert done.stdout.strip() == "1"


def test_links_that_lead_to_each_other_are_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    (tmp_path / "a.toml").symlink_to("b.toml")
    (tmp_path / "b.toml").symlink_to("a.toml")
    for words in (
        ["systems", "-o", str(tmp_path / "a")],
        ["derive", "pendulum", "--digits", "5", "--checkpoint", str(tmp_path / "a")],
        ["derive", str(tmp_path / "a.toml")],
        ["derive", str(tmp_path / "a.toml"), "-o", str(tmp_path / "a")],
        ["estimate", str(tmp_path / "a")],
    ):
        assert main(words) == 4
        assert "Too many levels of symbolic links" in capsys.readouterr().err


@pytest.mark.parametrize("suffix", [".toml", ".csv", ".mat", ""])
def test_pipes_and_devices_are_no_input(suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    verb = "derive" if suffix == ".toml" else "estimate"
    endless, pipe = tmp_path / f"endless{suffix}", tmp_path / f"pipe{suffix}"
    endless.symlink_to("/dev/zero")
    os.mkfifo(pipe)
    for path, kind in ((endless, "device"), (pipe, "pipe")) if suffix or verb == "estimate" else ():
        assert main([verb, str(path)]) == 2
        assert f"is a {kind}, not a file" in capsys.readouterr().err


def test_a_checkpoint_is_no_pipe(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(tmp_path / "pipe")
    words = ["derive", "van-der-pol", "--order", "4", "--digits", "5", "--checkpoint"]
    for path in (tmp_path / "pipe", Path("/dev/zero"), Path("/dev/stdout")):
        assert main([*words, str(path)]) == 2
        assert "a checkpoint is a file that is read again" in capsys.readouterr().err
