"""CPU time of the Wigner family against its bound, N Hermitian FFTs of length N in blocks, and against tftb 0.2.0.

Outside the test run, and without asserting a time.  Each line gives the ratio of two CPU times taken by turns in one
run (the least of several rounds each), so that the machine's speed drops out; its load does not quite.  tftb is used
where it is installed (``pip install --no-deps tftb==0.2.0``), else its lines are skipped.
"""

from __future__ import annotations

import os
import time
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy import fft

from ridgeback.numeric.distributions.reassigned_spectrogram import reassigned_spectrogram, synchrosqueezed_spectrogram
from ridgeback.numeric.distributions.ridge import follow
from ridgeback.numeric.distributions.spectrogram import spectrogram
from ridgeback.numeric.distributions.wigner import smoothed_pseudo_wigner, wigner, wigner_kernel

RATE = 32.0
BAND = (9.0, 25.0)
ROUNDS = 7
Work = Callable[[], object]


def chirp(size: int) -> np.ndarray:
    """From 2 to 3 cycles per unit at 32 samples per unit."""
    t = np.arange(size) / RATE
    return np.exp(2j * np.pi * (2.0 * t + 0.5 * t * t / t[-1]))


def bounds(size: int) -> list[Work]:
    """N Hermitian FFTs of length N, in blocks of several sizes: the quickest counts."""

    def in_blocks(rows: int) -> Work:
        block = np.full((rows, size // 2 + 1), 1.0 + 0.5j)

        def work() -> None:
            for _ in range(size // rows):
                fft.hfft(block, n=size, axis=1)

        return work

    return [in_blocks(max(1, min(size, room // (16 * size)))) for room in (500_000, 1_000_000, 2_000_000, 4_000_000)]


def least(works: list[Work], rounds: int = ROUNDS) -> list[float]:
    """Least CPU time of each, taken by turns."""
    best = [float("inf")] * len(works)
    for _ in range(rounds):
        for i, work in enumerate(works):
            since = time.process_time()
            work()
            best[i] = min(best[i], time.process_time() - since)
    return best


def show(capsys: Any, line: str) -> None:
    with capsys.disabled():
        print(f"\n  {line}   [load {os.getloadavg()[0]:.1f}]", end="")


def against_bound(capsys: Any, benchmark: Any, name: str, size: int, work: Work, goal: str) -> None:
    own, *bound = least([work, *bounds(size)])
    ratio = benchmark.extra_info["ratio"] = own / min(bound)
    benchmark.pedantic(work, rounds=3)
    show(capsys, f"{name}, N = {size}: {ratio:.2f} times the bound of {1e3 * min(bound):.1f} ms CPU ({goal})")


@pytest.mark.parametrize("size", [1024, 2048, 4096])
@pytest.mark.parametrize("single", [False, True], ids=["complex128", "complex64"])
def test_full_plane(benchmark: Any, capsys: Any, size: int, single: bool) -> None:
    z = chirp(size)
    name = "full Wigner plane" + (", complex64" if single else "")
    against_bound(capsys, benchmark, name, size, lambda: wigner(z, RATE, single=single), "goal 2.2")


@pytest.mark.parametrize("size", [1024, 2048, 4096, 8192])
@pytest.mark.parametrize("way", ["plain", "complex64", "band-limited"])
def test_peak_track(benchmark: Any, capsys: Any, size: int, way: str) -> None:
    z, low, high = chirp(size), np.full(size, BAND[0]), np.full(size, BAND[1])
    options: dict[str, Any] = {"plain": {}, "complex64": {"single": True}, "band-limited": {"band": BAND}}[way]

    def work() -> object:
        return follow(wigner_kernel(z, RATE, **options), low, high)

    tracemalloc.start()
    work()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    goal = f"goal {1 if way == 'band-limited' else 2}; {peak / 1e6:.1f} MB at most"
    against_bound(capsys, benchmark, f"refined peak track, {way}", size, work, goal)


def smoothed(z: np.ndarray, *, single: bool = False) -> object:
    """With tftb's default windows: Hamming over N / 4 lags and N / 10 samples, N bins."""
    lag, smooth = 2 * (z.size // 8), 2 * (z.size // 20)
    windows = {"lag_window": "hamming", "smoothing_window": "hamming"}
    return smoothed_pseudo_wigner(
        z, 1.0, lag_seconds=lag, smoothing_seconds=smooth, n_fft=z.size, single=single, **windows
    )


@pytest.mark.parametrize("single", [False, True], ids=["complex128", "complex64"])
def test_smoothed_pseudo_wigner(benchmark: Any, capsys: Any, single: bool) -> None:
    z = chirp(4096)
    own = least([lambda: smoothed(z, single=single)])[0]
    benchmark.pedantic(smoothed, args=(z,), kwargs={"single": single}, rounds=3)
    show(capsys, f"smoothed pseudo-Wigner, N = 4096{', complex64' * single}: {own:.3f} s CPU (goal 0.22)")


@pytest.mark.parametrize("size", [512, 1024])
def test_beside_tftb(benchmark: Any, capsys: Any, size: int) -> None:
    other = pytest.importorskip("tftb.processing", reason="tftb is not installed: pip install --no-deps tftb==0.2.0")
    z, long = chirp(size), chirp(4096)
    plane, theirs_plane = least([lambda: wigner(z, RATE), lambda: other.WignerVilleDistribution(z).run()])
    theirs = least([lambda: other.smoothed_pseudo_wigner_ville(z)], rounds=1)[0]
    own, own_long = least([lambda: smoothed(z), lambda: smoothed(long)])
    benchmark.pedantic(smoothed, args=(z,), rounds=3)
    scale = (4096 / size) ** 2
    show(capsys, f"Wigner, N = {size}: {theirs_plane / plane:.0f} times faster than tftb (goal 5)")
    show(capsys, f"smoothed pseudo-Wigner, N = {size}: {theirs / own:.0f} times faster than tftb ({theirs:.2f} s)")
    note = f"tftb's {theirs:.2f} s at N = {size} times {scale:.0f}, over {own_long:.3f} s measured"
    show(capsys, f"smoothed pseudo-Wigner, N = 4096: about {scale * theirs / own_long:.0f} times ({note}; goal 250)")


@pytest.mark.parametrize("transform", [spectrogram, reassigned_spectrogram, synchrosqueezed_spectrogram])
def test_short_time(benchmark: Any, transform: Any) -> None:
    plane = benchmark.pedantic(transform, args=(chirp(2048).real, RATE), kwargs={"window_seconds": 4.0}, rounds=3)
    assert plane.time.size == 2048
