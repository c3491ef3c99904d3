"""One command that keeps state, as a process of its own: ``python -m tests.kill.job NAME STATE OUTPUT``.

It is the command line, except that state is saved twenty times a second and a study has three short cases, so that a
random moment meets every kind of moment.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping

JOBS: Mapping[str, tuple[str, ...]] = {
    "balls": ("derive", "van-der-pol", "--order", "90", "--digits", "30", "--format", "json"),
    "primes": ("derive", "van-der-pol", "--order", "36", "--workers", "1", "--format", "json"),
    "primes, two workers": ("derive", "van-der-pol", "--order", "36", "--workers", "2", "--format", "json"),
    "estimator study": ("study", "--estimators", "--trials", "2", "--format", "json"),
}
SAVE_EVERY = 0.05


def main() -> int:
    """Run a job to its end, or until it is stopped."""
    name, state, output = sys.argv[1:]
    if name == "estimator study":
        from ridgeback.compare.noise import estimator_study as study

        cases = tuple(study.Case(axis="length", length=length) for length in (8.0, 9.0, 10.0))
        study.cases = lambda *_: cases  # type: ignore[assignment]
    else:
        from ridgeback.symbolic.high_order import by_primes, in_balls

        by_primes.SAVE_EVERY = in_balls.SAVE_EVERY = SAVE_EVERY  # type: ignore[assignment,misc]
    from ridgeback.cli import main as command_line

    return command_line([*JOBS[name], "--checkpoint", state, "-o", output])


if __name__ == "__main__":
    sys.exit(main())
