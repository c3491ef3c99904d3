"""Certified balls from the command line: what is printed, what an interrupt leaves, what is refused."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from ridgeback.answers import high_order
from ridgeback.options.budget import Watch
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find

Ridgeback = Callable[..., Any]  # the fixture of conftest.py
SPEAKING = (
    "import sys, ridgeback.cli as cli, ridgeback.options.budget as run\n"
    "run.EVERY = 0.0\n"  # progress at every step, so that a test knows when the work is under way
    "if __name__ == '__main__': sys.exit(cli.main(sys.argv[1:]))\n"
)


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """Ctrl-C as a terminal gives it, also where the tests run in the background of a shell, which ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def exact(value: Any) -> Fraction:
    return Fraction(int(value.p), int(value.q))


def interrupt_at(monkeypatch: pytest.MonkeyPatch, step: str) -> None:
    """Ctrl-C, as the terminal sends it, when the recursion says that it has come to a step."""

    class Interrupted(Watch):
        def __call__(self, fraction: float, told: str) -> None:
            super().__call__(fraction, told)
            if told == step:
                signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(high_order, "Watch", Interrupted)


@pytest.mark.parametrize(("system", "variable"), [("van-der-pol", "eps"), ("helmholtz-duffing", "A")])
def test_every_exact_coefficient_is_within_the_printed_radius(ridgeback: Ridgeback, system: str, variable: str) -> None:
    done = ridgeback("derive", system, "--order", "12", "--digits", "9", "--format", "json")
    assert (done.code, done.err) == (0, "")
    public = json.loads(done.out)
    assert (public["arithmetic"], public["digits"], public["variables"]) == ("balls", 9, [variable])
    true = {n: exact(c) for n, c in enumerate(lindstedt(find(system), 12).frequency) if c != 0}
    assert {row["powers"][variable] for row in public["frequency"]} == set(true)
    for row in public["frequency"]:
        error = abs(Fraction(row["coefficient"]) - true[row["powers"][variable]])
        assert error <= Fraction(row["radius"])
        assert Fraction(row["radius"]) <= Fraction(1, 10**8) * abs(Fraction(row["coefficient"]))
        assert row["certain_digits"] is None or row["certain_digits"] >= 9


def test_text_has_the_balls_and_the_limits_that_they_show(ridgeback: Ridgeback) -> None:
    out = ridgeback("derive", "van-der-pol", "--order", "60", "--digits", "12", "--verify").out
    assert "in balls of 12 digits" in out
    assert ["0.00553385416667", "3.34e-15"] in [line.split()[1:3] for line in out.splitlines()]  # 17/3072
    assert "|eps| < 1.849" in out  # Andersen and Geer (1982): |eps^2| about 3.42
    assert "all 49 exact coefficients" in out


def test_limits_of_balls_are_those_of_exact_coefficients() -> None:
    from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
    from ridgeback.symbolic.singularities.settled import settled_limits

    vdp = find("van-der-pol")
    balls = settled_limits(vdp, lindstedt_in_balls(vdp, 60, digits=30))
    rational = settled_limits(vdp, lindstedt(vdp, 60))
    assert balls.radius == pytest.approx(rational.radius, rel=1e-9)
    wide = settled_limits(vdp, lindstedt_in_balls(vdp, 60, digits=4))  # few digits: less sure, but not wrong
    assert wide.radius is not None
    assert rational.radius is not None
    assert wide.uncertainty is not None
    assert balls.uncertainty is not None
    assert rational.uncertainty is not None
    assert abs(wide.radius - rational.radius) <= wide.uncertainty + rational.uncertainty
    assert wide.uncertainty > balls.uncertainty
    hopeless = settled_limits(vdp, lindstedt_in_balls(vdp, 50, digits=1))  # settled by exact coefficients
    assert hopeless.radius == pytest.approx(rational.radius, rel=1e-3)


def test_an_interrupt_leaves_a_checkpoint_and_the_rerun_gives_the_same_bits(
    ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    state, words = tmp_path / "vdp.state", ["derive", "van-der-pol", "--order", "40", "--digits", "25"]
    whole = ridgeback(*words, "--format", "json")
    with monkeypatch.context() as patch:
        interrupt_at(patch, "order 30 of 40")
        stopped = ridgeback(*words, "--checkpoint", str(state), "--format", "json")
    assert (stopped.code, stopped.out) == (130, "")
    assert stopped.err.count("\n") == 1
    assert "interrupted before order 30 of 40" in stopped.err
    assert f"the state is in {state}" in stopped.err
    resumed = ridgeback(*words, "--checkpoint", str(state), "--format", "json")
    assert resumed.out == whole.out
    assert not state.exists()


def test_without_a_checkpoint_an_interrupt_says_what_would_have_helped(
    ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch
) -> None:
    interrupt_at(monkeypatch, "order 7 of 10")
    done = ridgeback("derive", "van-der-pol", "--order", "10", "--digits", "5")
    assert (done.code, done.out) == (130, "")
    assert "--checkpoint FILE" in done.err


def test_a_checkpoint_of_another_problem_is_refused(
    ridgeback: Ridgeback, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    state = tmp_path / "state"
    words = ["derive", "van-der-pol", "--digits", "5", "--checkpoint", str(state), "--order"]
    with monkeypatch.context() as patch:
        interrupt_at(patch, "order 15 of 20")
        assert ridgeback(*words, "20").code == 130
    before = state.read_bytes()
    for other in (
        [*words, "21"],
        ["derive", "rayleigh", *words[2:], "20"],
        [*words, "20", "--amplitude", "fundamental"],
    ):
        done = ridgeback(*other)
        assert done.code == 2
        assert "belongs to the" in done.err
    assert state.read_bytes() == before
    state.write_text("not a checkpoint")
    assert ridgeback(*words, "20").code == 2
    assert state.read_text() == "not a checkpoint"


def test_work_over_the_budget_is_refused_beforehand_and_allowed_when_asked_for(ridgeback: Ridgeback) -> None:
    order859 = ridgeback("derive", "van-der-pol", "--order", "859", "--digits", "30")
    assert order859.code == 2
    assert "GB, over the --budget" in order859.err
    tight = ridgeback("derive", "van-der-pol", "--order", "40", "--digits", "5", "--budget", "20MB,1s")
    assert tight.code == 0
    assert ridgeback("derive", "van-der-pol", "--order", "80", "--digits", "5", "--budget", "1MB").code == 2
    assert ridgeback("derive", "pendulum", "--order", "100", "--budget", "1MB").code == 2
    assert ridgeback("generate", "pendulum", "--order", "100", "--budget", "1MB").code == 2


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["pendulum", "--checkpoint", "state"], "needs --digits"),
        (["pendulum", "--digits", "0"], "--digits"),
        (["pendulum", "--digits", "5", "--checkpoint", "-"], "file"),
        (["pendulum", "--digits", "5", "--method", "energy-integral"], "lindstedt"),
        (["pendulum", "--digits", "5", "--weight", "2"], "weight belongs to multiple-scales"),
        (["pendulum", "--digits", "5", "--format", "latex"], "text or json"),
        (["damped-pendulum", "--digits", "5"], "multiple-scales"),
        (["pendulum", "--digits", "5", "--amplitude", "energy"], "energy"),
        (["pendulum", "--harmonics", "--digits", "5"], "exclude each other"),
        (["pendulum", "--budget", "2 parsecs"], "not a budget"),
        (["pendulum", "--budget", "0h"], "not a budget"),
        (["pendulum", "--budget", "1h,2h"], "not a budget"),
        (["--equation", "u'' + u + c*u**3 = 0", "--digits", "5"], "c is no number"),
    ],
)
def test_what_balls_cannot_do_is_said_in_one_line(ridgeback: Ridgeback, words: list[str], said: str) -> None:
    done = ridgeback("derive", *words)
    assert (done.code, done.out) == (2, "")
    assert done.err.count("\n") == 1
    assert said in done.err


@pytest.mark.parametrize(
    ("arithmetic", "output"), [(("--digits", "5"), "/dev/full"), (("--digits", "6"), "closed pipe")]
)
def test_a_checkpoint_outlives_an_output_that_cannot_be_written(
    arithmetic: tuple[str, str], output: str, tmp_path: Path
) -> None:
    command = [sys.executable, "-m", "ridgeback", "derive", "van-der-pol", "--order", "20", *arithmetic]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    run = partial(subprocess.run, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    wanted = run(command).stdout
    (tmp_path / "disk").mkdir()
    (tmp_path / "link").symlink_to("disk/state")
    command += ["--checkpoint", "link"]
    if output == "closed pipe":
        with subprocess.Popen(
            command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as process:
            assert process.stdout is not None
            assert process.stderr is not None
            process.stdout.close()
            said = process.stderr.read()
            assert process.wait(60) == 141
    else:
        lost = run([*command, "-o", output])
        assert lost.returncode == 4
        said = lost.stderr
    assert "the state is in link" in said
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "disk/state").is_file()
    again = run(command)
    assert (again.returncode, again.stdout) == (0, wanted)
    assert (tmp_path / "link").is_symlink()
    assert list((tmp_path / "disk").iterdir()) == []


@pytest.mark.parametrize(
    ("stop", "arithmetic"),
    [
        (signal.SIGTERM, ("--order", "400", "--digits", "20")),
        (signal.SIGHUP, ("--order", "400", "--digits", "20")),
    ],
)
def test_every_request_to_stop_leaves_a_state_and_no_process(
    stop: signal.Signals, arithmetic: tuple[str, str], tmp_path: Path
) -> None:
    """To the process alone, as a shell's kill sends it; the work is of minutes, so that none is done before."""
    (tmp_path / "run.py").write_text(SPEAKING)
    command = [
        sys.executable,
        "run.py",
        "derive",
        "van-der-pol",
        *arithmetic,
        "--checkpoint",
        "state",
    ]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])}
    with subprocess.Popen(
        command, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stderr is not None
        while not re.search("order [2-9] of", process.stderr.readline()):
            assert process.poll() is None
        process.send_signal(stop)
        said = process.stderr.read()
        assert process.wait(60) == 130
    assert "the state is in state: run the same command again" in said.splitlines()[-1]
    assert (tmp_path / "state").is_file()
    assert gone(process.pid)


def gone(group: int) -> bool:
    """Whether no process of a group is left, the tracker of shared memory a moment after its parent."""
    for _ in range(200):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


def test_a_missing_folder_for_the_checkpoint_is_an_error_before_the_work(ridgeback: Ridgeback) -> None:
    done = ridgeback("derive", "pendulum", "--digits", "5", "--checkpoint", "no/such/folder/state")
    assert (done.code, done.out) == (4, "")


def test_a_long_run_speaks_where_nobody_looks(capsys: pytest.CaptureFixture[str]) -> None:
    from ridgeback.symbolic.expansion.cost import Cost

    with Watch("order 9", Cost(1500.0, 3.0), stream=sys.stderr) as watch:
        watch(0.1, "order 1 of 9")
        watch.said -= 61.0
        watch(0.5, "order 2 of 9")
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "ridgeback: order 9: about 25 min and 3 GB are predicted"
    assert len(lines) == 2
    assert lines[1].endswith("50%, order 2 of 9")
