"""Processor time and memory of recordings on the command line, of every estimator, and the spectrogram beside SciPy's.

``python -m benchmarks.speed.recordings [--samples 100000 1000000] [--methods auto ...] [--report] [--spectrogram]
[--estimators]`` prints tables for docs/results/speed.md: without options those of 1e5 and 1e6 samples by every method,
6e6 by auto, a report of 4643 samples, and the spectrogram.  Seconds are those of the processor, user and system
together, on one thread.  With ``--estimators`` each method runs on samples in memory in a process of its own, and the
peak of that, what of it is the estimate's, what was predicted, and how much of the truth its interval holds is told.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.signal import spectrogram as scipys
from scipy.signal.windows import hann

from ridgeback.common.errors import InputError
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.estimators.estimate import METHODS, estimate
from ridgeback.numeric.estimators.memory import predicted_bytes

RATE, SLOW_RATE = 2000.0, 32.0
"""Samples per second of records on the command line, of 100 samples a cycle; of those in memory, of 32."""
SIZES, LONGEST, REPORTED = (100_000, 1_000_000), 6_000_000, 4643
PLANES = ((100_000, 257, 16), (100_000, 513, 8), (1_000_000, 1025, 256))
"""Samples, window and hop of the spectrograms."""


def record(size: int, rate: float = RATE, cycle: float = 0.05) -> tuple[np.ndarray, np.ndarray]:
    """Times and samples of a decay to e^-2 whose frequency falls by 5 %, in noise of a hundredth."""
    t = np.arange(size) / rate
    fall = 2.0 / t[-1]
    phase = 2 * np.pi / cycle * (t + 0.05 * (1.0 - np.exp(-2.0 * fall * t)) / (2.0 * fall))
    return t, np.exp(-fall * t) * np.cos(phase) + 0.01 * np.random.default_rng(1).normal(size=size)


def frequency(size: int, rate: float = RATE, cycle: float = 0.05) -> np.ndarray:
    """The angular frequency of the record at its samples."""
    t = np.arange(size) / rate
    return 2 * np.pi / cycle * (1.0 + 0.05 * np.exp(-4.0 * t / t[-1]))


def peak() -> int:
    """Bytes that this process has held at most; without /proc those of the process that started it count too."""
    status = Path("/proc/self/status")
    if status.exists():
        return 1024 * int(re.search(r"VmHWM:\s*(\d+) kB", status.read_text())[1])
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def in_memory(method: str, size: int) -> str:
    """The row of one estimate, in this process."""
    _, x = record(size, SLOW_RATE, 1.0)
    before, begin = peak(), time.process_time()
    try:
        track = estimate(x, SLOW_RATE, method=method)
    except InputError as error:
        return f"| {method}, {size:.0e} samples | | | | | {error} |"
    spent, most, interval = time.process_time() - begin, peak(), track.interval
    inside = str(track.no_interval)
    if interval is not None:
        true = np.interp(track.time, np.arange(size) / SLOW_RATE, frequency(size, SLOW_RATE, 1.0))
        held = (interval.low <= true) & (true <= interval.high)
        inside = f"{100.0 * float(held[track.valid].mean()):.1f} % inside"
    predicted = predicted_bytes(method, size, bias=interval is not None)
    numbers = " | ".join(f"{value / 1e6:.0f}" for value in (most, most - before, predicted))
    return f"| {method}, {size:.0e} samples | {spent:.1f} | {numbers} | {inside} |"


def estimators(sizes: list[int], methods: list[str]) -> None:
    """Every method in a process of its own."""
    print("| method | CPU, s | peak, MB | of the estimate | predicted | |\n|---|---|---|---|---|---|", flush=True)
    for size in sizes:
        for method in methods:
            command = [sys.executable, __file__, "--here", "--samples", str(size), "--methods", method]
            subprocess.run(command, check=True)  # noqa: S603 - our own arguments


def cost(arguments: list[str]) -> tuple[float, float, int]:
    """Seconds and megabytes of one command, and its exit code."""
    surroundings = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "ridgeback", *arguments]
    child = subprocess.Popen(command, env=surroundings, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # noqa: S603 - our own arguments
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    unit = 1.0 if sys.platform == "darwin" else 1024.0
    return used.ru_utime + used.ru_stime, unit * used.ru_maxrss / 1e6, child.returncode


def row(what: str, arguments: list[str]) -> str:
    """A row of the table."""
    seconds, megabytes, code = cost(arguments)
    said = {0: "", 2: "refused, with the reason"}.get(code, f"exit code {code}")
    return f"| {what} | {seconds:.1f} | {megabytes:.0f} | {said} |"


def estimates(folder: Path, sizes: list[int], methods: list[str]) -> None:
    """Rows of ``estimate --backbone``, of CSV by auto and of NPY by every method."""
    for size in sizes:
        t, x = record(size)
        binary, text = folder / f"{size}.npy", folder / f"{size}.csv"
        np.save(binary, x)
        for method in methods:
            options = ["--rate", str(RATE), "--backbone", "--method", method, "-o", str(folder / "out.txt")]
            print(row(f"estimate, {size:.0e} samples, NPY, {method}", ["estimate", str(binary), *options]), flush=True)
        if "auto" in methods:
            np.savetxt(text, np.stack([t, x], axis=1), fmt="%.5f", delimiter=",", header="time_s,u", comments="")
            options = ["--backbone", "-o", str(folder / "out.txt")]
            print(row(f"estimate, {size:.0e} samples, CSV, auto", ["estimate", str(text), *options]), flush=True)


def report(folder: Path) -> None:
    """The row of ``report --recording``."""
    file = folder / "decay.csv"
    columns = np.stack(record(REPORTED, 100.0, 1.0 / 3.0), axis=1)
    np.savetxt(file, columns, fmt="%.5f", delimiter=",", header="time_s,u", comments="")
    arguments = ["report", "--recording", str(file), "-o", str(folder / "report.html")]
    print(row(f"report, {REPORTED} samples", arguments), flush=True)


def least(work: Callable[[], object], rounds: int = 5) -> float:
    """The least seconds of the processor of some rounds."""
    found = []
    for _ in range(rounds):
        began = time.process_time()
        work()
        found.append(time.process_time() - began)
    return min(found)


def planes() -> None:
    """The spectrogram beside SciPy's at the same window, hop and bins, in turn."""
    print("\n| spectrogram: samples, window, hop | Ridgeback, s | SciPy, s | ratio |\n|---|---|---|---|")
    for size, width, hop in PLANES:
        x, bins = np.random.default_rng(1).normal(size=size), 2 * width
        ours = {"window_seconds": (width - 1) / RATE, "hop": hop, "n_fft": bins, "memory": 10**10}
        theirs = {"window": hann(width), "noverlap": width - hop, "nfft": bins, "detrend": False}
        a, b = (least(lambda: spectrogram(x, RATE, **ours)), least(lambda: scipys(x, RATE, **theirs)))  # noqa: B023 - called at once
        print(f"| {size}, {width}, {hop} | {a:.3f} | {b:.3f} | {a / b:.2f} |", flush=True)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, nargs="+", default=None)
    parser.add_argument("--methods", nargs="+", default=list(METHODS))
    parser.add_argument("--report", action="store_true")
    parser.add_argument("--spectrogram", action="store_true")
    parser.add_argument("--estimators", action="store_true")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.here:
        print(in_memory(given.methods[0], given.samples[0]), flush=True)
        return
    if given.estimators:
        estimators(given.samples or list(SIZES), given.methods)
        return
    everything = not (given.samples or given.report or given.spectrogram)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print("| command | CPU, s | peak memory, MB | |\n|---|---|---|---|")
        if everything or given.samples:
            estimates(folder, given.samples or list(SIZES), given.methods)
        if everything:
            estimates(folder, [LONGEST], ["auto"])
        if everything or given.report:
            report(folder)
    if everything or given.spectrogram:
        planes()


if __name__ == "__main__":
    main()
