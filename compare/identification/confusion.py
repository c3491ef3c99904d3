"""Which class is found for which: seeded trials of known oscillators in noise, and how often intervals hold the truth.

Each trial draws its parameters, integrates its own equation (DOP853, or closed form for the bilinear ones, never the
slow flow that is fitted), adds white noise and is identified among all candidates given.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.common.show.displayed import Displayed
from ridgeback.compare.identification.candidates import LAWS, NAMES
from ridgeback.compare.identification.identify import identify
from ridgeback.compare.identification.results import Candidate
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.bilinear import Bilinear
from ridgeback.numeric.motion.bilinear_motion import bilinear_motion
from ridgeback.numeric.motion.dynamics import Dynamics, duffing, helmholtz_duffing, linear, pendulum, van_der_pol
from ridgeback.numeric.motion.trajectory import integrate
from ridgeback.numeric.recording.recording import Recording

CYCLES = 40.0
PER_CYCLE = 8.0
RTOL = 1e-9


@dataclass(frozen=True)
class Trial:
    """A drawn oscillator: its parameters by the names of its candidate, and its noise-free samples."""

    name: str
    truth: Mapping[str, float]
    time: Array
    u: Array


@dataclass(frozen=True, repr=False)
class Confusion(Displayed):
    """Counts ``[true class, found class]`` of identifications at one signal-to-noise ratio (dB, at the start).

    ``inside`` and ``intervals`` count the true parameters that lie in their 95 % interval, and all of them;
    ``separable`` counts trials in which no other class came within reach of the best.
    """

    INDEX: ClassVar[tuple[str, ...]] = ("true",)

    classes: tuple[str, ...]
    candidates: tuple[str, ...]
    snr_db: float
    counts: Array
    tolerated: int
    """Trials whose true class is the best or cannot be told apart from it."""
    separable: int
    inside: int
    intervals: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "counts", frozen(self.counts))

    @property
    def trials(self) -> int:
        """All trials."""
        return int(self.counts.sum())

    @property
    def recovered(self) -> float:
        """Share of trials whose true class came first."""
        right = sum(self.counts[i, self.candidates.index(name)] for i, name in enumerate(self.classes))
        return float(right) / self.trials

    @property
    def coverage(self) -> float:
        """Share of true parameters inside their 95 % interval."""
        return self.inside / max(1, self.intervals)

    def headline(self) -> str:
        """The shares found and covered in one line."""
        return (
            f"{self.trials} trials at {self.snr_db:g} dB, {self.recovered:.0%} with their true class first; "
            f"{self.inside} of {self.intervals} parameters inside their 95 % interval"
        )

    def rows(self) -> list[dict[str, object]]:
        """One row per true class: how often each candidate came first."""
        return [
            {"snr_db": self.snr_db, "true": name}
            | {found: int(n) for found, n in zip(self.candidates, self.counts[i], strict=True)}
            for i, name in enumerate(self.classes)
        ]


def _smooth(name: str, dynamics: Dynamics, start: float, truth: Mapping[str, float]) -> Trial:
    k = dynamics.natural_frequency
    run = integrate(
        dynamics, (start, 0.0), duration=CYCLES * 2 * np.pi / k, rate=PER_CYCLE * k / (2 * np.pi), rtol=RTOL
    )
    return Trial(name, truth, run.time, run.u)


def _bilinear(name: str, oscillator: Bilinear, truth: Mapping[str, float]) -> Trial:
    k = oscillator.inner
    run = bilinear_motion(oscillator, (1.0, 0.0), duration=CYCLES * 2 * np.pi / k, rate=PER_CYCLE * k / (2 * np.pi))
    return Trial(name, truth, run.time, run.u)


def _draw_linear(rng: np.random.Generator) -> Trial:
    mu = rng.uniform(0.005, 0.01)
    return _smooth("linear", linear(mu=mu), 1.0, {"k": 1.0, "mu": mu})


def _draw_pendulum(rng: np.random.Generator) -> Trial:
    mu = rng.uniform(0.003, 0.006)
    return _smooth("pendulum", pendulum(mu=mu), rng.uniform(1.9, 2.3), {"k": 1.0, "b": 1.0, "mu": mu})


def _draw_hardening(rng: np.random.Generator) -> Trial:
    mu, eps = rng.uniform(0.005, 0.01), rng.uniform(0.2, 0.8)
    return _smooth("duffing-hardening", duffing(eps=eps, mu=mu), 1.0, {"k": 1.0, "eps": eps, "mu": mu})


def _draw_softening(rng: np.random.Generator) -> Trial:
    mu, eps = rng.uniform(0.003, 0.006), -rng.uniform(0.45, 0.65)
    return _smooth("duffing-softening", duffing(eps=eps, mu=mu), 1.0, {"k": 1.0, "eps": eps, "mu": mu})


def _draw_helmholtz(rng: np.random.Generator) -> Trial:
    mu, alpha, eps = rng.uniform(0.005, 0.01), rng.uniform(0.2, 0.35), rng.uniform(0.1, 0.4)
    oscillator = helmholtz_duffing(alpha=alpha, eps=eps, mu=mu)
    return _smooth("helmholtz-duffing", oscillator, 1.0, {"k": 1.0, "alpha": alpha, "eps": eps, "mu": mu})


def _draw_bilinear(rng: np.random.Generator) -> Trial:
    mu, ratio = rng.uniform(0.005, 0.01), rng.uniform(1.3, 1.8)
    return _bilinear("bilinear", Bilinear(1.0, ratio, 0.0, mu), {"k1": 1.0, "k2": ratio, "mu": mu})


def _draw_stop(rng: np.random.Generator) -> Trial:
    mu, ratio, s = rng.uniform(0.005, 0.01), rng.uniform(1.4, 2.0), rng.uniform(0.3, 0.6)
    return _bilinear("bilinear-stop", Bilinear(1.0, ratio, s, mu), {"k1": 1.0, "k2": ratio, "s": s, "mu": mu})


def _draw_van_der_pol(rng: np.random.Generator) -> Trial:
    eps = rng.uniform(0.02, 0.06)
    return _smooth("van-der-pol", van_der_pol(eps), rng.uniform(0.3, 0.8), {"k": 1.0, "eps": eps, "b": 1.0})


DRAWS: Mapping[str, Callable[[np.random.Generator], Trial]] = {
    "linear": _draw_linear,
    "pendulum": _draw_pendulum,
    "duffing-hardening": _draw_hardening,
    "duffing-softening": _draw_softening,
    "helmholtz-duffing": _draw_helmholtz,
    "bilinear": _draw_bilinear,
    "bilinear-stop": _draw_stop,
    "van-der-pol": _draw_van_der_pol,
}
"""Classes that trials can be drawn from."""


def noisy(trial: Trial, snr_db: float, rng: np.random.Generator) -> Recording:
    """The samples of a trial with white noise, whose ratio to the largest sample's sine is ``snr_db``.

    >>> trial = Trial("linear", {}, np.arange(4000.0), np.cos(np.arange(4000.0)))
    >>> added = noisy(trial, 20.0, np.random.default_rng(0)).values - trial.u
    >>> bool(abs(added.std() / (0.1 / np.sqrt(2)) - 1) < 0.05)
    True
    """
    sigma = float(np.abs(trial.u).max()) / np.sqrt(2) * 10 ** (-snr_db / 20)
    values = trial.u + sigma * rng.normal(size=trial.u.size)
    rate = (trial.time.size - 1) / float(trial.time[-1])
    return Recording(trial.time, values, rate, "u", "", f"{trial.name}, drawn", "")


def confusion(
    *,
    classes: Sequence[str] = tuple(DRAWS),
    candidates: Sequence[str] = NAMES,
    laws: Sequence[str] = LAWS,
    trials: int = 10,
    snr_db: float = 30.0,
    seed: int = 1,
    progress: Wanted = None,
) -> Confusion:
    """Draw oscillators of known classes in noise and identify them: how often the true class comes first.

    Each trial takes about three seconds with all candidates.

    Parameters
    ----------
    classes : sequence of str
        Classes that are drawn.
    candidates, laws : sequence of str
        Classes and damping laws that are fitted to each trial.
    trials : int
        Oscillators drawn of each class.
    snr_db : float
        Ratio of a sine of the largest sample's amplitude to the noise, in decibels of power.
    seed : int
        The same seed gives the same trials.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Confusion
        Counts ``[true class, found class]``, and how many true parameters lie in their 95 % interval.

    Raises
    ------
    InputError
        For a class that has no draw or is not among the candidates.

    Examples
    --------
    >>> found = confusion(classes=["linear"], candidates=["linear", "pendulum"], laws=["linear"], trials=1)
    >>> found.recovered
    1.0
    """
    wrong = [name for name in classes if name not in DRAWS or name not in candidates]
    if wrong:
        raise InputError(f"class {wrong[0]!r} cannot be drawn; use candidates among {', '.join(DRAWS)}")
    counts = np.zeros((len(classes), len(candidates)))
    tolerated = separable = inside = intervals = 0
    with showing(progress) as told:
        for i, name in enumerate(classes):
            for j in range(trials):
                told((i + j / trials) / len(classes), f"{name}, trial {j + 1}")
                rng = np.random.default_rng([seed, i, j, round(10 * snr_db) + 1000])
                trial = DRAWS[name](rng)
                found = identify(noisy(trial, snr_db, rng), candidates=candidates, laws=laws)
                counts[i, list(candidates).index(found.best.name)] += 1
                tolerated += name in found.indistinguishable
                separable += len(found.indistinguishable) == 1
                own = next(c for c in found.candidates if c.name == name)
                inside += held(own, trial)
                intervals += len(trial.truth)
    return Confusion(tuple(classes), tuple(candidates), snr_db, counts, tolerated, separable, inside, intervals)


def held(own: Candidate, trial: Trial) -> int:
    """True parameters inside their 95 % intervals."""
    pairs = [(own.parameter(name).interval(), value) for name, value in trial.truth.items()]
    return sum(low <= value <= high for (low, high), value in pairs)
