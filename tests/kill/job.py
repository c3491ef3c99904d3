"""One command that keeps state, as a process of its own: ``python -m tests.kill.job NAME STATE OUTPUT``.

It is the command line, except that state is saved twenty times a second and a study from a file has small blocks, so
that a random moment meets every kind of moment.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

JOBS: Mapping[str, tuple[str, ...]] = {
    "balls of a limit cycle": ("derive", "van-der-pol", "--order", "80", "--digits", "30", "--format", "json"),
    "balls of a pendulum": ("derive", "pendulum", "--order", "120", "--digits", "30", "--format", "json"),
    "study of expansions": ("study", "EXPANSIONS", "--format", "csv"),
    "study of expansions, two workers": ("study", "EXPANSIONS", "--workers", "2", "--format", "csv"),
    "study of estimators": ("study", "ESTIMATORS", "--format", "csv"),
}
SAVE_EVERY = 0.05
STUDIES = {
    "EXPANSIONS": """
[study]
ask = "error"
[grid]
orders = [2, 4]
amplitudes = { from = 0.01, to = 3, count = 60 }
[[oscillator]]
system = "pendulum"
[[oscillator]]
system = "helmholtz-duffing"
""",
    "ESTIMATORS": """
[study]
ask = ["best-estimator", "decay-error"]
[grid]
damping = [0.001, 0.002, 0.005, 0.01]
amplitudes = 1.6
methods = ["hilbert", "zero-crossing"]
[signal]
periods = 12
samples_per_period = 16
snr_db = 20
trials = 2
seed = 1
[[oscillator]]
system = "damped-pendulum"
""",
}


def main() -> int:
    """Run a job to its end, or until it is stopped."""
    name, state, output = sys.argv[1:]
    from ridgeback.symbolic.high_order import in_balls

    in_balls.SAVE_EVERY = SAVE_EVERY  # type: ignore[misc]
    from ridgeback.cli import main as command_line

    if kind := next((word for word in JOBS[name] if word in STUDIES), None):
        file = study_file(Path(state), STUDIES[kind])
        return command_line([*(str(file) if word == kind else word for word in JOBS[name]), "-o", output])
    return command_line([*JOBS[name], "--checkpoint", state, "-o", output])


def study_file(folder: Path, text: str) -> Path:
    """Write a study's file, whole, into the folder that keeps its state: its store lies beside it."""
    from ridgeback.compare.studies.measures import backbone

    backbone.CELLS = 4  # type: ignore[misc]
    folder.mkdir(exist_ok=True)
    file = folder / "study.toml"
    if not file.exists():
        temporary = folder / "study.part"
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(file)
    return file


if __name__ == "__main__":
    sys.exit(main())
