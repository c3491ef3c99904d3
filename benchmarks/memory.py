"""Peak memory, processor time and interval of every estimator on long records: ``python benchmarks/memory.py``.

Each method runs in a process of its own, on a decaying chirp of 32 samples to the cycle with a third harmonic in noise.
Prints the peak of the process, what of it is the estimate's, what was predicted, and how much of the truth lies inside
the 95 % interval.
"""

from __future__ import annotations

import argparse
import json
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.estimators.estimate import METHODS, estimate
from ridgeback.numeric.estimators.memory import predicted_bytes

RATE = 32.0


def peak() -> int:
    """Bytes that this process has held at most; without /proc those of the process that started it count too."""
    status = Path("/proc/self/status")
    if status.exists():
        return 1024 * int(re.search(r"VmHWM:\s*(\d+) kB", status.read_text())[1])
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def record(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Samples, and the frequency behind them (rad per time unit)."""
    time, span = np.arange(size) / RATE, size / RATE
    phase = 2.0 * np.pi * (time - 0.05 * span * (1.0 - np.exp(-2.0 * time / span)))
    noise = 0.01 * np.random.default_rng(1).normal(size=size)
    x = np.exp(-time / span) * np.cos(phase) + 0.02 * np.exp(-3.0 * time / span) * np.cos(3.0 * phase) + noise
    return x, 2.0 * np.pi * (1.0 - 0.1 * np.exp(-2.0 * time / span))


def measure(method: str, size: int) -> dict[str, object]:
    """What one estimate takes, in this process."""
    x, truth = record(size)
    before, begin = peak(), time.process_time()
    try:
        track = estimate(x, RATE, method=method)
    except InputError as error:
        return {"method": method, "samples": size, "refused": str(error)}
    interval, inside = track.interval, ""
    if interval is not None:
        true = np.interp(track.time, np.arange(size) / RATE, truth)
        held = (interval.low <= true) & (true <= interval.high)
        inside = f"{100.0 * float(held[track.valid].mean()):.1f} %"
    return {
        "method": method,
        "samples": size,
        "peak MB": round(peak() / 1e6),
        "of the estimate": round((peak() - before) / 1e6),
        "predicted": round(predicted_bytes(method, size, bias=interval is not None) / 1e6),
        "CPU s": round(time.process_time() - begin, 1),
        "inside": inside or str(track.no_interval),
    }


def main() -> None:
    """Measure in one process each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, nargs="+", default=[100_000, 1_000_000])
    parser.add_argument("--methods", nargs="+", default=list(METHODS))
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    for size in given.samples:
        for method in given.methods:
            if given.here:
                print(json.dumps(measure(method, size)), flush=True)
                continue
            command = [sys.executable, __file__, "--here", "--samples", str(size), "--methods", method]
            subprocess.run(command, check=True)  # noqa: S603 - our own arguments


if __name__ == "__main__":
    main()
