"""Every option either leaves a trace in the output or is refused by its name: none is passed over in silence."""

from __future__ import annotations

import shlex
from pathlib import Path

import click
import numpy as np
import pytest

from ridgeback import cli
from tests.ridgeback.conftest import Ridgeback

DERIVING = ("--order 3", "--method energy-integral", "--amplitude trough", "--weight 3", "--weights mu=1")
OF_SYSTEMS = ("--about 0", "--potential u**2/2", "--set k=2")
MODES: dict[str, tuple[str, ...]] = {
    "derive damped-duffing --order 3 --weights mu=1": ("--weight 3", "--growth 1"),
    "derive pendulum --order 4 --resummed pade": ("--growth 0", "--until 3"),
    "derive --equation \"u'' + u**3 = 0\" --at 1": ("--weight 3", "--weights mu=1"),
    "generate pendulum --fit minimax --up-to 1 --degree 2": (*DERIVING, "--budget 1h", "--growth 1", "--terms 2"),
    "generate pendulum --resummed agm --up-to 1": (*DERIVING, "--growth 0", "--degrees 1/1", "--terms 2"),
    "generate pendulum --order 2 --resummed pade": ("--growth 0", "--terms 2", "--motion", "--gappa"),
    "generate pendulum --order 2 -o package/": ("--format json",),
    "study --example five-oscillators": ("--orders 2", "--set k=2", "--format json", "--store a.db"),
    "study file.toml": ("--method energy-integral", "--about 0", "--potential u"),
    "study pendulum --orders 2 --amplitudes 1 --certified": ("--method energy-integral",),
    "report -o page.html": ("--about 0", "--potential u**2/2", "--column u", "--predict-from 3", "--span 0,1"),
    "report pendulum -o -": ("--format json",),
    "report --recording run.csv -o page.html": ("--about 0", "--set k=1", "--order 3", "--target 0.1", "--initial 1,0"),
    "estimate run.csv --method hilbert": (
        *("--window hann", "--smoothing 1", "--harmonics 3", "--order 6", "--band-limited", "--single"),
        *("--seed 3", "--snr 10", "--workers 2", "--combine all", "--free k", "--system linear", "--set k=2"),
    ),
    "estimate run.csv --method wigner": ("--window hann", "--smoothing 1", "--harmonics 3", "--order 4"),
    "estimate run.csv --method zero-crossing": ("--window hann", "--smoothing 1", "--harmonics 3", "--order 4"),
    "estimate run.csv --method pseudo-wigner": ("--smoothing 1", "--harmonics 3", "--order 4"),
    "estimate run.csv --method harmonic-least-squares": ("--window hann", "--smoothing 1", "--order 4", "--single"),
    "estimate run.csv --method model-fit --system linear": ("--lag 2", "--window hann", "--harmonics 3", "--order 4"),
    "estimate run.csv --half-cycles": ("--lag 2", "--window hann", "--method hilbert", "--remove-bias", "--harmonic 2"),
    "estimate --monte-carlo 2": ("--column u", "--rate 2", "--span 0,1", "--detrend linear", "--combine all"),
    "estimate run.csv --monte-carlo 2": ("--run-column u", "--harmonics 3", "--half-cycles", "--backbone", "--single"),
    "simulate linear": ("--digits 20", "--potential u**2/2"),
}
"""A command, and options that mean nothing in it."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    time = np.arange(240) / 12.0
    rows = zip(time, np.exp(-0.05 * time) * np.cos(6.0 * time), strict=True)
    (tmp_path / "run.csv").write_text("t,u\n" + "".join(f"{t!s},{u!s}\n" for t, u in rows))
    (tmp_path / "file.toml").write_text("[study]\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("command", "option"), [(mode, option) for mode in MODES for option in MODES[mode]])
def test_an_option_without_a_meaning_is_refused_by_name(
    command: str, option: str, ridgeback: Ridgeback, folder: Path
) -> None:
    before = sorted(folder.iterdir())
    found = ridgeback(*shlex.split(command), *shlex.split(option))
    assert (found.code, found.out) == (2, "")
    name = option.partition(" ")[0]
    assert name in found.err or name.strip("-") in found.err
    assert found.err.count("\n") == 1
    assert sorted(folder.iterdir()) == before


NEUTRAL = ("--workers", "--budget", "--checkpoint", "--digits", "--check", "--gappa", "--help", "--output", "--plot",
           "--planes")  # fmt: skip
"""Options that change how a result is come by, or what stands beside it."""
BASES = {
    "derive": ("duffing --order 4", "damped-duffing --order 4", "duffing --order 4 --resummed map --at 1/2"),
    "generate": ("duffing --order 4", "damped-duffing --order 3", "pendulum --up-to 1 --fit minimax --degree 2"),
    "simulate": ("linear --duration 2 --rate 4", "duffing --duration 2 --rate 4 --method taylor"),
    "estimate": (
        "run.csv --method hilbert",
        "run.csv --method smoothed-pseudo-wigner",
    ),
}
"""Commands to which every option of their verb is added."""
VALUES = {
    "about": "0", "potential": "u**2/2+u**4/4", "equation": "u'' + u = 0", "assignments": "k=2", "order": "6",
    "method": "energy-integral", "amplitude": "trough", "weight": "3", "weights": "mu=1", "at": "1/3", "degrees": "1/1",
    "growth": "1", "resummed": "pade", "transient": "1/2", "until": "3", "points": "4", "style": "json", "name": "w",
    "mode": "fma", "language": "c", "real": "float32", "terms": "2", "fit": "minimax", "degree": "3", "tolerance": "1",
    "up_to": "1/2", "initial": "1/2,0", "duration": "3", "rate": "8", "digits": "40", "column": "2", "time_column": "1",
    "run_column": "1", "span": "1,18", "resample": "11", "fill": "1", "detrend": "linear", "band": "4,9", "lag": "3",
    "window": "hann", "smoothing": "2", "harmonics": "2", "harmonic": "2", "combine": "all", "snr": "10", "seed": "3",
    "laws": "k=1+t/9", "system": "linear", "free": "k", "workers": "2", "budget": "1h", "monte_carlo": "2",
    "quantity": "velocity", "unit": "cm", "decimal": "comma", "components": "1",
}  # fmt: skip
"""Something to give each option that takes a value."""
FOUND_ANYWAY = ("column", "time_column", "fill", "about", "potential", "components", "monte_carlo")
"""Options whose value is what is found without them, and one that changes everything."""


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("verb", BASES)
def test_an_option_shows_or_is_refused(verb: str, ridgeback: Ridgeback) -> None:
    own = {p.name: p for p in main_command(verb).params if isinstance(p, click.Option)}
    silent = []
    for base in BASES[verb]:
        plain = ridgeback(verb, *shlex.split(base))
        assert plain.code == 0, plain.err
        for name, option in own.items():
            spelled = option.opts[-1]
            if spelled in NEUTRAL or name in FOUND_ANYWAY or f"{spelled} " in f"{base} ":
                continue
            more = [spelled] if option.is_flag else [spelled, VALUES[name]]
            found = ridgeback(verb, *shlex.split(base), *more)
            assert found.code in (0, 2, 3), (base, more, found.err)
            same_series = name == "method" and "--resummed" in base  # by whatever derivation
            if found.code == 0 and found.out == plain.out and not same_series:
                silent.append(f"{verb} {base} {shlex.join(more)}")
    assert silent == []


def main_command(verb: str) -> click.Command:
    group = next(value for value in vars(cli).values() if isinstance(value, click.Group))
    command = group.get_command(click.Context(group), verb)
    assert command is not None
    return command
