"""Signals as they come in: arrays, tables, recordings and files become a ``Recording`` here."""

from __future__ import annotations

import os
import warnings
from typing import Any, TypeAlias

from ridgeback.common.errors import InputError
from ridgeback.numeric.motion.trajectory import Trajectory
from ridgeback.numeric.recording.reading import read_recording
from ridgeback.numeric.recording.recording import Recording

SignalLike: TypeAlias = Any
"""A Recording, a path, a Trajectory, or samples: a list, an array, a masked array, a pandas or xarray object."""


def as_recording(
    x: SignalLike,
    rate: float | None = None,
    *,
    time: Any = None,
    column: str | int | None = None,
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
    span: tuple[float, float] | None = None,
) -> Recording:
    """Make a recording of a signal in any of its forms; of one with gaps the longest stretch, with a warning.

    Parameters
    ----------
    x : array_like, masked array, Series, DataFrame, DataArray, Dataset, Recording, Trajectory, str or path
        The samples, or the file that holds them (CSV, NPZ, NPY, WAV, MAT, HDF5).  NaN, ``None`` and masked samples are
        missing.  Of a trajectory it is u.
    rate : float, optional
        Samples per time unit.
    time : array_like, optional
        The time of each sample, in place of a rate.
    column : str or int, optional
        The signal of a table or a file with several.
    resample, fill : float, optional
        Rate to interpolate uneven times to; longest gap to interpolate across, with samples that enter no fit.
    detrend : {"none", "linear", "slow"}
        What is taken off.
    span : (float, float), optional
        First and last time to keep.

    Returns
    -------
    Recording
        The uniformly sampled signal.

    Raises
    ------
    InputError
        For what is no signal of numbers with a rate or times.
    OSError
        For a file that cannot be read.

    Examples
    --------
    >>> as_recording([0.0, 1.0] * 20, rate=4.0).rate
    4.0
    """
    treatment: dict[str, Any] = {"resample": resample, "fill": fill, "detrend": detrend, "span": span}
    if isinstance(x, Recording):
        taken_off = None if detrend == "none" else detrend
        treated = {"resample": resample, "fill": fill, "detrend": taken_off, "span": span}
        refuse_known("a Recording", rate=rate, time=time, column=column, **treated)
        return x
    if isinstance(x, Trajectory):
        refuse_known("a Trajectory", rate=rate, time=time, column=column)
        return Recording.from_arrays(x.u, x.rate, name="u", **treatment)
    if isinstance(x, str | os.PathLike):
        if time is not None:
            raise InputError(f"{os.fspath(x)} has times of its own; leave time out, or name its column when reading it")
        found = read_recording(os.fspath(x), column=column, rate=rate, **treatment)
    else:
        found = Recording.from_arrays(x, rate, time=time, column=column, **treatment)
    if found.stretch:
        warnings.warn(f"{found.label}: {found.notes[-1]} fill= interpolates across short gaps.", stacklevel=3)
    return found


def refuse_known(owner: str, **given: object) -> None:
    """Refuse what a recording or a trajectory has settled already.

    >>> refuse_known("a Recording", rate=32.0)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: a Recording has its rate already; leave rate out, or give its values alone
    """
    settled = [name for name, value in given.items() if value is not None]
    if settled:
        raise InputError(f"{owner} has its {settled[0]} already; leave {settled[0]} out, or give its values alone")
