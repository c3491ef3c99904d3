"""Our estimators in the public benchmark ``mcsm-benchs`` (task ``inst_frequency``), beside ``ssqueezepy``'s ridges.

    pip install mcsm-benchs ssqueezepy
    python -m benchmarks.peers.public [--trials 20] [--signals LinearChirp,ToneDamped] [--plot public.svg]

Signals are those of its bank, cut to where they are not zero; it adds noise, calls the methods and compares.  Prints
the rms error of the frequency in cycles per sample, and the Cramer-Rao bound of a polynomial phase and amplitude of the
least degrees that describe the signal; both libraries are used here only, and are no dependency.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any

import numpy as np
from matplotlib import pyplot
from numpy.polynomial import Legendre

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.ways.own_correction import held_beyond
from ridgeback.console.tables import aligned
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.estimators.estimate import estimate
from ridgeback.numeric.harmonics.cramer_rao import Order, local_bound
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal

SIGNALS = ("LinearChirp", "CosChirp", "ToneDamped")
OURS = ("harmonic-least-squares", "pseudo-wigner", "polynomial-wigner", "spectrogram", "synchrosqueezed")
RATIOS = (0, 10, 20, 30)
DESCRIBED = 1e-3
"""A polynomial describes phase (rad) and amplitude (of its largest) when it is within this."""
MOST_DEGREE = 40

Method = Callable[[Array], Array]


def ours(x: Array, method: str) -> Array:
    """The frequency of one component in cycles per sample, continued to the ends; a refusal is no value."""
    samples = np.asarray(x, dtype=float).ravel()
    try:
        track = estimate(samples, 1.0, method=method, bias=False)
    except InputError:
        return np.full((1, samples.size), np.nan)
    return held_beyond(track, np.arange(samples.size, dtype=float))[None, :] / (2 * np.pi)


def theirs(x: Array, transform: str) -> Array:
    """The ridge of a synchrosqueezed transform by ssqueezepy."""
    ssqueezepy = import_module("ssqueezepy")
    samples = np.asarray(x, dtype=float).ravel()
    if transform == "cwt":
        plane, _, frequency, scales = ssqueezepy.ssq_cwt(samples, fs=1.0)[:4]
        row = ssqueezepy.extract_ridges(plane, scales, penalty=4, n_ridges=1, bw=4, transform="cwt")
    else:
        plane, _, frequency, _ = ssqueezepy.ssq_stft(samples, fs=1.0)[:4]
        row = ssqueezepy.extract_ridges(plane, frequency, penalty=4, n_ridges=1, bw=4, transform="stft")
    return np.asarray(frequency)[np.asarray(row).ravel()][None, :]


def methods() -> Mapping[str, Method]:
    """All that take part."""
    known: dict[str, Method] = {name: partial(ours, method=name) for name in OURS}
    return known | {f"ssqueezepy ssq_{way}": partial(theirs, transform=way) for way in ("cwt", "stft")}


def bank(wanted: Sequence[str]) -> dict[str, Any]:
    """The signals with their frequencies, of an odd number of samples."""
    own = import_module("mcsm_benchs.SignalBank")
    found = {}
    for name, signal in own.SignalBank(N=512, return_signal=True).signalDict.items():
        if name in wanted:
            frequency = np.asarray(signal.instf[0])
            inside = np.flatnonzero(np.abs(frequency) > 0)
            keep = inside[: inside.size - 1 + inside.size % 2]
            found[name] = own.Signal(np.asarray(signal)[keep], instf=frequency[keep])
    return found


def bound(x: Array, frequency: Array, snr_db: float) -> float:
    """Root mean square over the record of the least standard deviation of the frequency, in cycles per sample."""
    time = np.arange(x.size, dtype=float)
    omega = 2 * np.pi * frequency
    phase = np.concatenate(([0.0], np.cumsum(0.5 * (omega[1:] + omega[:-1]))))
    size, turn = envelope(x, phase)
    orders = Order(phase_degree=degree(time, phase, 1.0), amplitude_degree=degree(time, size, float(size.max())))
    waves = HarmonicSignal(1.0, phase + turn, omega, (1,), size[None, :], np.zeros((1, x.size)), np.zeros(x.size))
    noise = math.sqrt(float(np.mean(x**2)) / 10 ** (snr_db / 10))
    least = local_bound(waves, noise, half=x.size // 2, order=orders, centres=np.arange(x.size))
    return float(np.sqrt(np.mean(least**2))) / (2 * np.pi)


def envelope(x: Array, phase: Array) -> tuple[Array, float]:
    """The slow amplitude of x = a(t) cos(phase + turn), by a polynomial of degree 12, and the turn."""
    basis = np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, x.size), 12)
    parts = np.hstack((basis * np.cos(phase)[:, None], basis * np.sin(phase)[:, None]))
    found = np.linalg.lstsq(parts, x, rcond=None)[0].reshape(2, -1) @ basis.T
    return np.hypot(*found), -math.atan2(float(found[1].mean()), float(found[0].mean()))


def degree(time: Array, values: Array, scale: float) -> int:
    """The least degree of a polynomial that describes values."""
    for n in range(MOST_DEGREE):
        if np.abs(Legendre.fit(time, values, n)(time) - values).max() < DESCRIBED * scale:
            return n
    return MOST_DEGREE


def rows(trials: int, wanted: Sequence[str]) -> list[dict[str, Any]]:
    """One row for each signal, ratio and method."""
    signals, known = bank(wanted), methods()
    count = len(next(iter(signals.values())))
    made = import_module("mcsm_benchs.Benchmark").Benchmark(
        task="inst_frequency",
        methods=dict(known),
        N=count,
        SNRin=list(RATIOS),
        repetitions=trials,
        signal_ids=signals,
        verbosity=0,
        write_log=False,
    )
    results = made.run()
    table = []
    for name, signal in signals.items():
        x, frequency = np.asarray(signal), np.asarray(signal.instf[0])
        for snr in RATIOS:
            least = bound(x, frequency, snr)
            for method in known:
                errors = squares(results, name, method, snr)
                kept = [error for error in errors if math.isfinite(error)]
                place = {"signal": name, "SNR, dB": snr, "method": method}
                table.append({**place, "rms": rms(kept), "bound": least, "refused": len(errors) - len(kept)})
    return table


def squares(results: Mapping[str, Any], signal: str, method: str, snr: float) -> list[float]:
    """Mean squared errors of the trials, as the benchmark keeps them; without a component there is no value."""
    (kept,) = results["perf_metric"][signal][snr][method].values()
    errors = kept["Comp.0"] if isinstance(kept, dict) else kept
    return [float(value) for value in errors]


def rms(errors: list[float]) -> float:
    """Root of the mean; not a number where no trial gave one."""
    return math.sqrt(sum(errors) / len(errors)) if errors else math.nan


def draw(table: list[dict[str, Any]], path: str) -> None:
    """Error over the noise, a panel for each signal, the bound dashed."""
    names = list(dict.fromkeys(row["signal"] for row in table))
    figure, grid = pyplot.subplots(
        1, len(names), figsize=(1 + 4 * len(names), 4.2), sharey=True, layout="constrained", squeeze=False
    )
    panels = grid[0]
    for panel, name in zip(panels, names, strict=True):
        mine = [row for row in table if row["signal"] == name]
        for method in methods():
            panel.semilogy(RATIOS, [row["rms"] for row in mine if row["method"] == method], "o-", label=method)
        panel.semilogy(RATIOS, [row["bound"] for row in mine][:: len(methods())], "k--", label="Cramer-Rao bound")
        panel.set(title=name, xlabel="SNR, dB")
    panels[0].set_ylabel("rms error, cycles per sample")
    panels[0].legend(fontsize=7)
    figure.savefig(path)


def main() -> None:
    """Run, print, and draw where that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--signals", default=",".join(SIGNALS))
    parser.add_argument("--plot")
    asked = parser.parse_args()
    np.random.seed(1)  # noqa: NPY002 - the benchmark draws its noise from NumPy's global generator
    table = rows(asked.trials, asked.signals.split(","))
    shown = [{**row, "rms": f"{row['rms']:.2e}", "bound": f"{row['bound']:.2e}"} for row in table]
    print(aligned(list(table[0]), shown))
    if asked.plot:
        draw(table, asked.plot)


if __name__ == "__main__":
    main()
