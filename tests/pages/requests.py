"""What a page of each kind is asked for, and the files that it is made from: for looking at it, and for its tests."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

Run = Callable[..., object]
"""One command of Ridgeback in a folder: ``run(folder, *words)``."""
CUBIC = ("--equation", "u'' + 2*mu*u' + c3*u'**3 + u + g*u**3 = 0", "--set", "mu=0.01", "--set", "c3=0.02")
KINDS: Mapping[str, tuple[str, ...]] = {
    "paper": (),
    "paper-without-noise": ("--trials", "0"),
    "duffing": ("damped-duffing", "--initial", "2,0"),
    "van-der-pol": ("van-der-pol",),
    "bilinear": ("bilinear",),
    "cubic": (*CUBIC, "--set", "g=0.3"),
    "helmholtz-duffing": ("damped-helmholtz-duffing", "--set", "alpha2=1/5", "--set", "alpha3=3/10"),
    "decay": ("--recording", "decay.csv"),
    "degrees": ("pendulum", "--set", "k=3.5", "--recording", "pendulum.csv"),
    "runs": ("--recording", "first.csv", "--recording", "second.csv"),
    "study": ("five.db",),
}
SHORT = ("--trials", "0", "--orders", "2,4,12", "--order", "4", "--duration", "60", "--no-timings")
LESS: Mapping[str, tuple[str, ...]] = {
    "paper": ("--trials", "2"),
    "duffing": SHORT,
    "van-der-pol": (*SHORT, "--amplitudes", "0.5,1,2"),
    "bilinear": SHORT,
    "cubic": SHORT,
    "helmholtz-duffing": SHORT,
    "decay": ("--span", "0,30", "--trials", "2"),
    "degrees": ("--span", "0,30", "--trials", "0"),
    "runs": ("--span", "0,80"),
    "study": (),
}
"""What makes a page in few seconds with all that a page of its kind has: measured times are on that of the paper."""
SIMULATED = ("simulate", "damped-pendulum", "--duration", "160", "--rate", "8")
NEEDED: Mapping[str, tuple[str, ...]] = {
    "decay.csv": ("sample", "decay"),
    "pendulum.csv": ("sample", "pendulum"),
    "first.csv": (*SIMULATED, "--initial", "2.5,0"),
    "second.csv": (*SIMULATED, "--initial", "2,0"),
}
"""The command that writes a file which a page is made from."""


def prepare(kind: str, folder: Path, run: Run, *, less: bool = False) -> None:
    """Write into a folder what the page of a kind is made from, where it is not there."""
    for name in KINDS[kind]:
        if name in NEEDED and not (folder / name).exists():
            run(folder, *NEEDED[name], "-o", name)
            if NEEDED[name][0] == "simulate":
                two_columns(folder / name)
    if kind == "study" and not (folder / "five.db").exists():
        study(folder, run, less=less)


def two_columns(path: Path) -> None:
    """Leave times and samples alone, as most recordings are."""
    rows = path.read_text(encoding="utf-8").splitlines()
    path.write_text("".join(",".join(row.split(",")[:2]) + "\n" for row in rows), encoding="utf-8")


def study(folder: Path, run: Run, *, less: bool) -> None:
    """Run the study of five oscillators, or at few amplitudes."""
    run(folder, "study", "--example", "five-oscillators", "-o", "five.toml")
    if less:
        path = folder / "five.toml"
        few = path.read_text(encoding="utf-8").replace("count = 40", "count = 6").replace("count = 24", "count = 5")
        path.write_text(few, encoding="utf-8")
    run(folder, "study", "five.toml")
