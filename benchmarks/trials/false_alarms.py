"""How often noise passes for an oscillation, and how often a tone is missed: trials behind numeric/signal/presence.py.

    python -m benchmarks.trials.false_alarms [TRIALS]

prints, for white and 1/f^a noise of 200 to 5000 samples, the share of records below each probability, and for tones at
0 dB the share that is found.  With 10,000 trials of the shortest records it takes about ten minutes.
"""

from __future__ import annotations

import sys

import numpy as np

from ridgeback.numeric.arrays import Array
from ridgeback.numeric.signal.presence import FALSE_ALARM, presence

SIZES = (200, 500, 1500, 5000)
SLOPES = (0.0, 0.5, 1.0, 1.5, 2.0)
CYCLES = (10.0, 12.4, 50.0)
DECAYS = (0.0, 1.0, 2.0)
"""The amplitude falls by exp(-decay) over the record."""


def coloured(size: int, slope: float, rng: np.random.Generator) -> Array:
    """Gaussian noise with the spectrum f^(-slope): the middle of a record four times as long, of unit variance."""
    frequency = np.fft.rfftfreq(4 * size)
    frequency[0] = frequency[1]
    spectrum = (rng.standard_normal(frequency.size) + 1j * rng.standard_normal(frequency.size)) * frequency ** (
        -0.5 * slope
    )
    x = np.fft.irfft(spectrum)[size : 2 * size]
    return np.asarray((x - x.mean()) / x.std())


def tone(size: int, cycles: float, decay: float, rng: np.random.Generator) -> Array:
    """A tone of random phase that decays by exp(-decay), of unit mean square."""
    t = np.arange(size) / size
    x = np.exp(-decay * t) * np.cos(2 * np.pi * cycles * t + rng.uniform(0.0, 2.0 * np.pi))
    return np.asarray(x / np.sqrt(np.mean(x**2)))


def false_alarms(size: int, slope: float, trials: int, rng: np.random.Generator) -> Array:
    """The probabilities that records of noise are given."""
    return np.array([presence(coloured(size, slope, rng), 1.0).probability for _ in range(trials)])


def share_found(size: int, cycles: float, decay: float, trials: int, rng: np.random.Generator) -> float:
    """The share of records of a tone in white noise of the same power that are found to hold an oscillation."""
    records = (tone(size, cycles, decay, rng) + rng.standard_normal(size) for _ in range(trials))
    return float(np.mean([presence(x, 1.0).found for x in records]))


def main(trials: int) -> None:
    """Print both tables."""
    rng = np.random.default_rng(1)
    print("samples  slope  records  below 0.001  below 0.01  below 0.1")
    for size in SIZES:
        for slope in SLOPES:
            count = max(200, trials * SIZES[0] // size)
            p = false_alarms(size, slope, count, rng)
            shares = "  ".join(f"{np.mean(p <= level):.5f}" for level in (FALSE_ALARM, 0.01, 0.1))
            print(f"{size:7d}  {slope:5.1f}  {count:7d}  {shares}", flush=True)
    print("samples  cycles  decay  found at 0 dB")
    for size in SIZES[:2]:
        for cycles in CYCLES:
            for decay in DECAYS:
                found = share_found(size, cycles, decay, min(trials, 1000), rng)
                print(f"{size:7d}  {cycles:6.1f}  {decay:5.1f}  {found:.3f}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
