"""Print how many faults are tried and how many are handled well: ``python -m tests.faults``.

Exit code 1 when any is not, each with what is wrong.  The project's tests run the same cases.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.faults.catalogue import GROUPS, WARM
from tests.faults.samples import write_samples
from tests.faults.trial import Case, faults, tried


def main() -> int:
    """Run every case, print the table."""
    wrong: list[tuple[Case, tuple[str, ...]]] = []
    print("| about | cases | handled well | most processor time |\n|---|---|---|---|")
    total = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "samples"  # in a folder of its own, beside which there is nothing
        folder.mkdir()
        write_samples(folder)
        for case in WARM:
            tried(case, folder)
        for title, cases in GROUPS.items():
            outcomes = [(case, tried(case, folder)) for case in cases]
            bad = [(case, found) for case, outcome in outcomes if (found := faults(case, outcome))]
            most = max((outcome.cpu for _, outcome in outcomes), default=0.0)
            print(f"| {title} | {len(cases)} | {len(cases) - len(bad)} | {most:.1f} s |", flush=True)
            total, wrong = total + len(cases), wrong + bad
    print(f"| all | {total} | {total - len(wrong)} | |")
    for case, found in wrong:
        print(f"{case.command}: {'; '.join(found)}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
