"""The wide confusion matrix: ``python -m benchmarks.trials.confusion --trials 10 --snr 40 30 20``, about 3 s per trial.

Every class that can be drawn against every candidate; the same seed gives the same trials.
"""

from __future__ import annotations

import argparse
import sys

from ridgeback.compare.identification.confusion import DRAWS, Confusion, confusion


def shown(found: Confusion) -> str:
    """One matrix: rows are true classes, the columns in use only."""
    used = [j for j in range(len(found.candidates)) if found.counts[:, j].any()]
    width = max(map(len, found.classes))
    names = [found.candidates[j] for j in used]
    lines = [
        f"{found.snr_db:g} dB, {found.trials} trials: {found.recovered:.0%} recovered, {found.tolerated} with the "
        f"true class in reach of the best, {found.separable} with no other class in reach; "
        f"{found.inside} of {found.intervals} parameters inside their 95 % interval ({found.coverage:.0%})",
        " " * width + "  " + "  ".join(names),
    ]
    for i, name in enumerate(found.classes):
        cells = "  ".join(f"{found.counts[i, j]:.0f}".rjust(len(n)) for j, n in zip(used, names, strict=True))
        lines.append(f"{name.ljust(width)}  {cells}")
    return "\n".join(lines)


def main() -> None:
    """Read the options, run, print a matrix per level of noise as soon as it is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--snr", type=float, nargs="+", default=[40.0, 30.0, 20.0])
    parser.add_argument("--classes", nargs="+", default=list(DRAWS), choices=list(DRAWS))
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    for level in given.snr:
        found = confusion(classes=given.classes, trials=given.trials, snr_db=level, seed=given.seed)
        sys.stdout.write(shown(found) + "\n\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
