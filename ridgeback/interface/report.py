"""``ridgeback.study`` and ``ridgeback.report``: how good is which formula, and the whole comparison on one page."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.motion.motion import Setting, setting
from ridgeback.compare.motion.paper_case import paper_case
from ridgeback.compare.report.drift.drift_report import drift_report
from ridgeback.compare.report.noise_part import TRIALS
from ridgeback.compare.report.recording_report import recording_report
from ridgeback.compare.report.results import Report
from ridgeback.compare.report.several.runs_report import runs_report
from ridgeback.compare.report.several.study_report import study_report
from ridgeback.compare.report.system_report import ORDER, TARGET, system_report
from ridgeback.compare.study import study as studies
from ridgeback.compare.study.results import Study
from ridgeback.interface.signals import SignalLike, as_recording
from ridgeback.interface.unused import refuse_unused
from ridgeback.numeric.motion.trajectory import Trajectory
from ridgeback.numeric.recording.recording import Recording
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.parameters import Value

ORDERS = (2, 4, 8, 16)
METHODS = ("lindstedt", "energy-integral")


def study(
    oscillator: OscillatorLike,
    orders: Sequence[int] = ORDERS,
    amplitudes: Any = None,
    *,
    method: str | None = None,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    progress: Wanted = None,
) -> Study:
    """Hold truncated expansions against the exact frequency over a grid of orders and amplitudes.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes; its damping is left out.
    orders : sequence of int
        Highest powers kept.
    amplitudes : array_like of float
        Peak amplitudes, in the unit of u, or values of eps of a limit cycle.
    method : {"lindstedt", "energy-integral"}, optional
        How the expansion is derived; by default the first, and the energy integral for a force with a kink at rest or
        without a linear part.
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Study
        ``omega``, ``reference`` and ``relative_error`` over ``[order, amplitude]``, with the limits of the series.

    Raises
    ------
    InputError
        For orders below 0, amplitudes that are not positive or reach the separatrix, and a grid that is too large.

    Examples
    --------
    >>> result = study("pendulum", (2, 4), [0.5, 1.0])
    >>> bool(abs(result.relative_error[1, 1]) < 1e-4)
    True
    """
    if amplitudes is None:
        raise InputError("a study needs amplitudes; give a list or an array, such as numpy.linspace(0.1, 3, 30)")
    system = as_oscillator(oscillator, parameters=parameters, about=about)
    with showing(progress) as told:
        return studies.study(
            system, orders, amplitudes, method=method and chosen(method, METHODS, "method"), progress=told
        )


def report(
    oscillator: OscillatorLike | None = None,
    *,
    recording: SignalLike = None,
    study: str | os.PathLike[str] | None = None,
    rate: float | None = None,
    time: Any = None,
    column: str | int | None = None,
    band: tuple[float, float] | None = None,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    drift: Mapping[str, str] | None = None,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    order: int | None = None,
    orders: Sequence[int] | None = None,
    amplitudes: Any = None,
    target: float | None = None,
    predict_from: float | None = None,
    trials: int = TRIALS,
    title: str | None = None,
    timed: bool = True,
    progress: Wanted = None,
) -> Report:
    """Compare expansions, models and estimated frequencies of an oscillator, of recordings, or of a study.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr, optional
        What is simulated and derived; by default the damped pendulum of Galleani and Cohen.  With a recording, its
        exact backbone is drawn over the measured one.
    recording : array_like, Series, DataFrame, DataArray, Recording, str or path, optional
        A signal to report on instead; a list of paths, recordings or trajectories for several on one page.
    study : str or path, optional
        The store of a finished study, to report on instead; everything else but ``progress`` is left out.
    rate : float, optional
        Samples per time unit, of the recording or of the simulation.
    time : array_like, optional
        The time of each sample of the recording, in place of a rate.
    column : str or int, optional
        The signal of a table or a file with several.
    band : (float, float), optional
        Lowest and highest frequency of a recording's oscillation, rad per time unit; by default about its strongest
        component.
    parameters, about : optional
        As for :func:`ridgeback.oscillator`.
    drift : mapping of str to str, optional
        Parameters that change slowly with the time t, such as ``{"L": "1+0.01*t"}``: the page then holds omega0 at the
        conserved action against the integrated motion.
    initial : (float, float), optional
        State (u, u') at time 0 of the simulation.
    duration : float, optional
        Time to simulate.
    order : int, optional
        The expansion that formulas and code are about (20 by default).
    orders, amplitudes : optional
        The grid of the accuracy study.
    target : float, optional
        Relative error aimed at (0.001 by default).
    predict_from : float, optional
        Number of first cycles of a recording from which the rest is predicted.
    trials : int
        Noisy records a point of the noise study; 0 leaves it out.
    title : str, optional
        What the oscillator is called on the page.
    timed : bool
        Whether measured times are kept; without them the same request gives the same page, byte for byte.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Report
        Everything that the page shows; ``save(path)`` writes the page.

    Raises
    ------
    InputError
        For what does not go together, and as the parts do.

    Examples
    --------
    >>> made = report("linear", duration=60.0, rate=4.0, orders=(2,), amplitudes=[0.5, 1.0], trials=0)
    >>> made.study.orders
    (2, 20)
    """
    with showing(progress) as told:
        if drift:
            if oscillator is None:
                raise InputError("a drift needs an oscillator whose parameters change; name it")
            refuse("a recording", recording=recording, time=time, column=column, band=band, predict_from=predict_from)
            refuse("the study of a system", order=order, orders=orders, amplitudes=amplitudes, target=target)
            own = as_oscillator(oscillator, parameters=parameters, about=about)
            return drift_report(
                own if title is None else replace(own, title=title),
                drift,
                initial=initial,
                duration=duration,
                rate=rate,
                timed=timed,
                progress=told,
            )
        if study is not None:
            refuse("a system or a recording", oscillator=oscillator, recording=recording, rate=rate, initial=initial)
            return study_report(os.fspath(study), progress=told)
        if recording is not None:
            if oscillator is None:
                refuse_unused("a recording without an oscillator", parameters=parameters, about=about)
            refuse("a simulation", initial=initial, duration=duration)
            refuse("the study of a system", order=order, orders=orders, amplitudes=amplitudes, target=target)
            theory = None if oscillator is None else as_oscillator(oscillator, parameters=parameters, about=about)
            named = theory if theory is None or title is None else replace(theory, title=title)
            if several(recording):
                refuse("one recording", predict_from=predict_from, time=time)
                signals = [as_recording(one, rate, column=column) for one in recording]
                return runs_report(signals, band=band, oscillator=named, timed=timed, progress=told)
            used = as_recording(recording, rate, time=time, column=column)
            return recording_report(
                used,
                band=band,
                oscillator=named,
                cycles=predict_from,
                trials=trials,
                timed=timed,
                progress=told,
            )
        refuse("a recording", time=time, column=column, band=band, predict_from=predict_from)
        case = simulated(oscillator, parameters, about, initial, duration, rate)
        return system_report(
            case if title is None else replace(case, oscillator=replace(case.oscillator, title=title)),
            order=ORDER if order is None else order,
            orders=orders,
            amplitudes=amplitudes,
            target=TARGET if target is None else target,
            trials=trials,
            timed=timed,
            progress=told,
        )


def several(recording: SignalLike) -> bool:
    """Whether a recording is a list of signals, and not the samples of one.

    >>> several(["a.csv", "b.csv"]), several([0.0, 1.0]), several("a.csv")
    (True, False, False)
    """
    whole = (str, os.PathLike, Recording, Trajectory)
    return isinstance(recording, list | tuple) and bool(recording) and isinstance(recording[0], whole)


def refuse(owner: str, **given: object) -> None:
    """Refuse what belongs to something else."""
    for name, value in given.items():
        if value is not None:
            raise InputError(f"{name} belongs to {owner}; leave it out")


def simulated(
    oscillator: OscillatorLike | None,
    parameters: Mapping[str, Value] | None,
    about: str | None,
    initial: tuple[float, float] | None,
    duration: float | None,
    rate: float | None,
) -> Setting:
    """The motion asked for; without an oscillator the paper's, with whatever was said changed."""
    if oscillator is not None:
        system = as_oscillator(oscillator, parameters=parameters, about=about)
        return setting(system, initial=initial, duration=duration, rate=rate)
    paper = paper_case()
    return setting(
        as_oscillator(paper.oscillator, parameters=parameters, about=about),
        initial=initial or paper.initial,
        duration=duration or paper.duration,
        rate=rate or paper.rate,
        time_unit=paper.time_unit,
    )
