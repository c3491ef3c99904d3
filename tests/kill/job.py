"""One command that keeps state, as a process of its own: ``python -m tests.kill.job NAME STATE OUTPUT``.

It is the command line, except that state is saved twenty times a second and a study from a file has small blocks, so
that a random moment meets every kind of moment.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

JOBS: Mapping[str, tuple[str, ...]] = {
    "balls": ("derive", "van-der-pol", "--order", "90", "--digits", "30", "--format", "json"),
    "study of a file": ("study", "FILE", "--format", "csv"),
    "study of a file, two workers": ("study", "FILE", "--workers", "2", "--format", "csv"),
}
SAVE_EVERY = 0.05
STUDY = """
[study]
ask = "error"
[grid]
orders = [2, 4]
amplitudes = { from = 0.01, to = 3, count = 300 }
[[oscillator]]
system = "pendulum"
[[oscillator]]
system = "helmholtz-duffing"
"""


def main() -> int:
    """Run a job to its end, or until it is stopped."""
    name, state, output = sys.argv[1:]
    from ridgeback.symbolic.high_order import in_balls

    in_balls.SAVE_EVERY = SAVE_EVERY  # type: ignore[misc]
    from ridgeback.cli import main as command_line

    if "FILE" in JOBS[name]:
        return command_line(study_of_a_file(name, Path(state), output))
    return command_line([*JOBS[name], "--checkpoint", state, "-o", output])


def study_of_a_file(name: str, state: Path, output: str) -> list[str]:
    """The study's file lies in the folder ``state``, and its store beside it."""
    from ridgeback.compare.studies.measures import backbone

    backbone.CELLS = 8  # type: ignore[misc]
    state.mkdir(exist_ok=True)
    file = state / "study.toml"
    if not file.exists():
        temporary = state / "study.part"
        temporary.write_text(STUDY, encoding="utf-8")
        temporary.replace(file)
    return [str(file) if word == "FILE" else word for word in JOBS[name]] + ["-o", output]


if __name__ == "__main__":
    sys.exit(main())
