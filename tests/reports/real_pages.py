"""A page of each kind made from its request as a reader makes it, as small as the kind allows, once for all tests."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Mapping
from pathlib import Path

from ridgeback.cli import main

FEW = ("--trials", "0", "--orders", "2,4,12", "--order", "4")
CUBIC = ("--equation", "u'' + 2*mu*u' + c3*u'**3 + u + g*u**3 = 0", "--set", "mu=0.01", "--set", "c3=0.02")
REQUESTS: Mapping[str, tuple[str, ...]] = {
    "paper": ("--trials", "2"),
    "duffing": ("damped-duffing", "--initial", "2,0", *FEW),
    "van-der-pol": ("van-der-pol", *FEW, "--amplitudes", "0.2,0.5,1,1.5,2"),
    "bilinear": ("bilinear", *FEW),
    "cubic": (*CUBIC, "--set", "g=0.3", *FEW),
    "helmholtz-duffing": ("damped-helmholtz-duffing", "--set", "alpha2=1/5", "--set", "alpha3=3/10", *FEW),
    "decay": ("--recording", "decay.csv", "--span", "0,30"),
    "degrees": ("pendulum", "--set", "k=3.5", "--recording", "pendulum.csv", "--span", "0,30"),
    "runs": ("--recording", "first.csv", "--recording", "second.csv"),
    "study": ("five.db",),
}
RUNS = {"first.csv": "2.5,0", "second.csv": "2,0"}


def make(kind: str, folder: Path) -> Path:
    """Write what a kind needs and its page into a folder."""
    with contextlib.chdir(folder):
        match kind:
            case "decay":
                ridgeback("sample", "decay", "-o", "decay.csv")
            case "degrees":
                ridgeback("sample", "pendulum", "-o", "pendulum.csv")
            case "runs":
                for name, start in RUNS.items():
                    run(Path(name), start)
            case "study":
                study(Path("five.toml"))
        ridgeback("report", *REQUESTS[kind], "-o", f"{kind}.html")
    return folder / f"{kind}.html"


def ridgeback(*words: str) -> None:
    """One command, which must end well; what it says is not shown."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said:
        code = main(words)
    assert code in (0, 3), f"{words}: exit code {code}{os.linesep}{said.getvalue()}"


def run(path: Path, start: str) -> None:
    """Times and samples of a pendulum, as most recordings are."""
    words = ("--initial", start, "--duration", "80", "--rate", "8", "-o", str(path))
    ridgeback("simulate", "damped-pendulum", *words)
    rows = path.read_text(encoding="utf-8").splitlines()
    path.write_text("".join(",".join(row.split(",")[:2]) + "\n" for row in rows), encoding="utf-8")


def study(path: Path) -> None:
    """The study of five oscillators at few amplitudes."""
    ridgeback("study", "--example", "five-oscillators", "-o", str(path))
    few = path.read_text(encoding="utf-8").replace("count = 40", "count = 6").replace("count = 24", "count = 5")
    path.write_text(few, encoding="utf-8")
    ridgeback("study", str(path))
