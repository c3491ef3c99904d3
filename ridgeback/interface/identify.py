"""``ridgeback.identify`` and ``ridgeback.predict``: which oscillator made a decay, and what it will do next."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen, plain
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.identification import identify as identification
from ridgeback.compare.identification import prediction
from ridgeback.compare.identification.candidates import ALL_LAWS, LAWS, NAMES
from ridgeback.compare.identification.preparation import prepared
from ridgeback.compare.identification.ranking import CRITERIA
from ridgeback.compare.identification.results import Identification, Prediction
from ridgeback.interface.signals import SignalLike, as_recording
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator

DAMPING = tuple(law.split(" + ")[-1] for law in ALL_LAWS)


def identify(
    x: SignalLike,
    rate: float | None = None,
    *,
    time: Any = None,
    column: str | int | None = None,
    candidates: Iterable[str | Oscillator] | None = None,
    damping: str | None = None,
    criterion: str = "bic",
    span: tuple[float, float] | None = None,
    band: tuple[float, float] | None = None,
    predict_from: float | None = None,
    progress: Wanted = None,
) -> Identification:
    """Say which oscillator made a free decay: every class fitted to the samples, ranked, and told apart or not.

    Parameters
    ----------
    x, rate, time, column
        The signal, as for :func:`ridgeback.estimate`.
    candidates : iterable of str or Oscillator, optional
        Classes to try, by name or alias; by default all.
    damping : {"linear", "quadratic", "cubic", "coulomb"}, optional
        Linear damping alone, or with one more term; by default what the criterion prefers of the first three.
    criterion : {"bic", "aicc"}
        What ranks them.
    span : (float, float), optional
        Times to use.
    band : (float, float), optional
        Lowest and highest frequency of the oscillation, rad per time unit; by default about the strongest component.
    predict_from : float, optional
        Number of first cycles that are also fitted by themselves, to predict the rest.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Identification
        The candidates, best first, with parameters, intervals and backbones, and the verdict in words.

    Raises
    ------
    InputError
        For unknown names, fewer than six cycles, and when no candidate can be fitted.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(400) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=400)
    >>> found = identify(np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, time=t, candidates=["linear", "duffing"])
    >>> found.best.name
    'linear'
    """
    used = as_recording(x, rate, time=time, column=column)
    wanted = how(candidates, damping, criterion)
    with showing(progress) as told:
        told(0.0, "frequency track")
        ready, ahead = prepared(used, span=span, band=band), None
        if predict_from is not None:
            ahead = prediction.predict(ready, cycles=predict_from, progress=told, **wanted)
        return identification.identify(ready, prediction=ahead, progress=told, **wanted)


def predict(
    x: SignalLike,
    rate: float | None = None,
    *,
    cycles: float,
    time: Any = None,
    column: str | int | None = None,
    candidates: Iterable[str | Oscillator] | None = None,
    damping: str | None = None,
    criterion: str = "bic",
    span: tuple[float, float] | None = None,
    band: tuple[float, float] | None = None,
    progress: Wanted = None,
) -> Prediction:
    """Fit the first cycles of a decay and predict the rest, held against what was measured.

    Parameters
    ----------
    cycles : float
        How many of the first cycles the fit sees.
    x, rate, time, column, candidates, damping, criterion, span, band, progress
        As for :func:`identify`.

    Returns
    -------
    Prediction
        Amplitude, frequency and phase of the rest with 95 % bands, and how often these hold.

    Raises
    ------
    InputError
        As :func:`identify`, and when too few cycles are left on either side.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(600) / 4.0
    >>> noise = 0.01 * np.random.default_rng(1).normal(size=600)
    >>> ahead = predict(np.exp(-0.01 * t) * np.cos(1.1 * t) + noise, 4.0, cycles=10, candidates=["linear"])
    >>> ahead.errors["phase"] < 0.1
    True
    """
    used = as_recording(x, rate, time=time, column=column)
    with showing(progress) as told:
        wanted = how(candidates, damping, criterion)
        return prediction.predict(used, cycles=cycles, span=span, band=band, progress=told, **wanted)


def how(
    candidates: Iterable[str | Oscillator] | None,
    damping: str | None,
    criterion: str,
) -> dict[str, Any]:
    """The settings in the words of the fits."""
    return {
        "candidates": NAMES if candidates is None else tuple(candidate_name(one) for one in candidates),
        "laws": LAWS if damping is None else (ALL_LAWS[DAMPING.index(chosen(damping, DAMPING, "damping"))],),
        "kind": chosen(criterion, CRITERIA, "criterion"),
    }


def candidate_name(given: str | Oscillator) -> str:
    """The class that a name, an alias or an oscillator of the catalogue stands for.

    >>> candidate_name("Duffing"), candidate_name("backbone_polynomial"), candidate_name(find("pendulum"))
    ('duffing-hardening', 'backbone-polynomial', 'pendulum')
    """
    if isinstance(given, Oscillator):
        return chosen(given.name, NAMES, "candidate")
    if plain(given) in NAMES:
        return plain(given)
    try:
        return chosen(find(given).name, NAMES, "candidate")
    except InputError:
        return chosen(given, NAMES, "candidate")
