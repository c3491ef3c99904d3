"""Which frequency estimator is best where: damping, amplitude, sampling, noise and length, one at a time from one case.

Each case is a damped pendulum of natural frequency 1 per time unit, released from rest, in seeded white noise; errors
are those of ``noise.monte_carlo``.  The study can be interrupted and taken up again: a checkpoint file is written whole
after every case and holds what it was made with.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import reading_signed, write_signed
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.noise.monte_carlo import monte_carlo
from ridgeback.compare.noise.results import NoiseCell, NoiseStudy, read_study
from ridgeback.compare.noise.truth import Truth, dynamics_truth
from ridgeback.numeric.motion.dynamics import pendulum

METHODS = (
    "harmonic-least-squares",
    "harmonic-least-squares/local",
    "pseudo-wigner",
    "smoothed-pseudo-wigner",
    "polynomial-wigner",
    "spectrogram",
    "reassigned-spectrogram",
    "synchrosqueezed",
    "hilbert",
    "zero-crossing",
    "wigner",
)
TRIALS = 6
FORMAT = "ridgeback estimator study"
VERSION = 2


@dataclass(frozen=True)
class Case:
    """One setting; times in natural periods."""

    axis: str = "base"
    """What differs from the base case."""
    damping: float = 0.003
    """mu / k."""
    amplitude: float = 0.5 * math.pi
    """Initial angle, rad."""
    sampling: float = 16.0
    """Samples per natural period."""
    snr_db: float = 30.0
    length: float = 24.0
    """Natural periods in the record."""

    @property
    def label(self) -> str:
        """What is varied, and to which value.

        >>> Case(axis="length", length=12.0).label, Case(axis="amplitude", amplitude=0.3 * math.pi).label
        ('length = 12 periods', 'amplitude = 0.3 pi')
        """
        if self.axis == "base":
            return "base case"
        value = getattr(self, self.axis)
        shown = f"{value / math.pi:.3g} pi" if self.axis == "amplitude" else f"{value:g}"
        name = {"damping": "damping mu/k", "sampling": "samples per period", "snr_db": "SNR"}.get(self.axis, self.axis)
        return f"{name} = {shown}" + {"snr_db": " dB", "length": " periods"}.get(self.axis, "")

    def truth(self) -> Truth:
        """The noise-free record and its frequency."""
        k = 2.0 * math.pi
        return dynamics_truth(
            pendulum(k=k, mu=self.damping * k),
            (self.amplitude, 0.0),
            duration=self.length,
            rate=self.sampling,
            title=self.label,
        )


AXES: Mapping[str, tuple[float, ...]] = {
    "damping": (0.0, 0.001, 0.01, 0.02),
    "amplitude": (0.05 * math.pi, 0.25 * math.pi, 0.8 * math.pi, 0.95 * math.pi),
    "sampling": (4.0, 8.0, 64.0),
    "snr_db": (0.0, 10.0, 20.0, 40.0, 60.0),
    "length": (8.0, 12.0, 48.0, 96.0),
}


def cases(axes: Mapping[str, Sequence[float]] = AXES) -> tuple[Case, ...]:
    """The base case, and each value of each axis on its own.

    >>> [case.label for case in cases({"snr_db": (0.0, 20.0)})]
    ['base case', 'SNR = 0 dB', 'SNR = 20 dB']
    """
    varied = [dataclasses.replace(Case(), axis=axis, **{axis: v}) for axis, values in axes.items() for v in values]
    return (Case(), *varied)


@dataclass(frozen=True)
class CaseResult:
    """The cells of one case, one per method, the best first; methods that refused come last."""

    case: Case
    cells: tuple[NoiseCell, ...]

    @property
    def best(self) -> NoiseCell:
        """The method with the least rms error."""
        return self.cells[0]

    def tied(self) -> tuple[NoiseCell, ...]:
        """Methods whose rms error is within two standard deviations of the best one's, the best first."""
        return tuple(cell for cell in self.cells if cell is self.best or _tied(cell, self.best))

    def of(self, method: str) -> NoiseCell | None:
        """The cell of a method, None when it was not run."""
        return next((cell for cell in self.cells if cell.method == method), None)


def _tied(cell: NoiseCell, best: NoiseCell) -> bool:
    if cell.rms is None or best.rms is None:
        return False
    return cell.rms - best.rms <= 2.0 * math.hypot(cell.rms_sd or 0.0, best.rms_sd or 0.0)


@dataclass(frozen=True)
class EstimatorStudy:
    """All cases of a study, with what is needed to run it again."""

    methods: tuple[str, ...]
    trials: int
    seed: int
    results: tuple[CaseResult, ...]
    complete: bool = True
    """False when it was interrupted; ``results`` then holds the cases done."""

    def rows(self) -> list[dict[str, Any]]:
        """One row per case and method: the case, then every field of its cell."""
        return [
            {"case": result.case.label, **dataclasses.asdict(cell)} for result in self.results for cell in result.cells
        ]

    def as_dict(self) -> dict[str, Any]:
        """The study as JSON knows it."""
        return dataclasses.asdict(self)


def estimator_study(
    chosen: Sequence[Case] | None = None,
    *,
    methods: Sequence[str] = METHODS,
    trials: int = TRIALS,
    seed: int = 1,
    checkpoint: str | Path | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> EstimatorStudy:
    """Run every method on every case.

    An interrupt (KeyboardInterrupt) returns the cases done with ``complete=False``, or passes through before the first.

    Parameters
    ----------
    chosen
        Cases; by default the base case and each value of each axis on its own.
    methods, trials, seed, executor
        As for :func:`ridgeback.compare.noise.monte_carlo.monte_carlo`.
    checkpoint
        File that holds the cases done: it is written whole after each, proves itself whole by a digest, and is read
        when it exists.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Raises
    ------
    InputError
        For what ``monte_carlo`` refuses, and for a checkpoint of another study.

    Examples
    --------
    >>> study = estimator_study([Case(length=10.0)], methods=("hilbert", "wigner"), trials=2)
    >>> [cell.method for cell in study.results[0].cells]
    ['wigner', 'hilbert']
    """
    wanted = cases() if chosen is None else tuple(chosen)
    settings = {"methods": list(methods), "trials": trials, "seed": seed}
    done = {} if checkpoint is None else _read(Path(checkpoint), settings)
    results: list[CaseResult] = []
    try:
        for i, case in enumerate(wanted):
            key = _key(case)
            if key not in done:
                share = _part(progress, i / len(wanted), 1.0 / len(wanted), case.label)
                done[key] = _run(case, methods, trials, seed, executor, share)
                if checkpoint is not None:
                    write_signed(Path(checkpoint), _lines(settings, done))
            results.append(CaseResult(case, tuple(sorted(done[key].cells, key=_rank))))
    except KeyboardInterrupt:
        if not results:
            raise
        return EstimatorStudy(tuple(methods), trials, seed, tuple(results), complete=False)
    return EstimatorStudy(tuple(methods), trials, seed, tuple(results))


def _rank(cell: NoiseCell) -> float:
    return math.inf if cell.rms is None else cell.rms


def _part(progress: Progress, begin: float, width: float, label: str) -> Progress:
    """Progress of one case as a part of the whole."""
    return lambda fraction, step: progress(begin + width * fraction, f"{label}: {step}")


def _run(
    case: Case, methods: Sequence[str], trials: int, seed: int, executor: Executor | None, progress: Progress
) -> NoiseStudy:
    study = monte_carlo(
        case.truth(),
        methods=methods,
        snr_db=(case.snr_db,),
        trials=trials,
        seed=seed,
        intervals=False,
        executor=executor,
        progress=progress,
    )
    if not study.complete:
        raise KeyboardInterrupt
    return study


def _key(case: Case) -> str:
    """A name for the numbers of a case: two axes may share one."""
    numbers = dataclasses.asdict(dataclasses.replace(case, axis=""))
    return hashlib.sha256(json.dumps(numbers, sort_keys=True).encode()).hexdigest()[:16]


def _read(path: Path, settings: Mapping[str, Any]) -> dict[str, NoiseStudy]:
    """The cases done, none when there is no file yet."""
    if not path.exists():
        return {}
    with reading_signed(path, FORMAT, VERSION) as (head, lines):
        if head["settings"] != settings:
            raise InputError(f"{path} was made with {head['settings']}, not {settings}; name another file or remove it")
        done = {key: read_study(next(lines)) for key in head["done"]}
    if not all(_made_with(study, settings) for study in done.values()):
        raise InputError(f"{path} claims other settings than its own cases have; remove it and start again")
    return done


def _made_with(study: NoiseStudy, settings: Mapping[str, Any]) -> bool:
    """Whether the numbers of a case are those of the settings."""
    own = {"methods": list(study.methods), "trials": study.trials, "seed": study.seed}
    return own == settings and all(cell.trials == study.trials for cell in study.cells)


def _lines(settings: Mapping[str, Any], done: Mapping[str, NoiseStudy]) -> Iterator[str]:
    """What was asked for and which cases are done, then the cases, one a line."""
    yield json.dumps({"format": FORMAT, "version": VERSION, "settings": settings, "done": list(done)}) + "\n"
    yield from (json.dumps(study.as_dict(), allow_nan=False) + "\n" for study in done.values())
