"""Recordings from files: one signal, or every stretch of every channel of every run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ridgeback.common.errors import InputError
from ridgeback.numeric.recording.file_signals import Places, Wanted, signals
from ridgeback.numeric.recording.recording import Recording, longest_of, recordings_of
from ridgeback.numeric.recording.treatment import Treatment


def read_recording(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
    span: tuple[float, float] | None = None,
    unit: str = "",
    decimal: str = "auto",
) -> Recording:
    r"""Read one signal from a CSV (.csv, .txt, .tsv, .dat), NPZ, NPY, WAV, MAT or HDF5 (.h5, .hdf5) file.

    Of a signal with gaps the longest stretch without one is taken, and ``notes`` says so; for all stretches, channels
    or runs see :func:`read_recordings`.

    Parameters
    ----------
    path : str or Path
        The file.
    column : str or int, optional
        A name or a number from 1 (WAV: the channel); it may be left out when there is only one candidate.
    time_column : str or int, optional
        The times; by default found by name (time, t, time_s, ...).
    rate : float, optional
        Samples per second, in place of a time column.
    resample : float, optional
        The rate to interpolate uneven times to.
    fill : float, optional
        Interpolate missing values where neighbouring samples are at most so many time units apart.
    detrend : str
        ``"none"``, ``"linear"`` or ``"slow"``.
    span : (float, float), optional
        First and last time to keep, such as the free decay after a release.
    unit : str, optional
        Of the samples, in place of the one in the header; angles in degrees are converted to radians.
    decimal : {"auto", "point", "comma", ".", ","}
        The mark of the decimals in a table of text; by default what each column's cells prove.

    Returns
    -------
    Recording
        Integer WAV samples are divided by full scale.

    Raises
    ------
    OSError
        When the file cannot be read.
    InputError
        For everything in it that is not a signal of numbers: the message names the line, the column and the value.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     _ = path.write_text("t_s,u [mm]\n" + "".join(f"{i / 10},{i % 3}\n" for i in range(20)))
    ...     recording = read_recording(path)
    >>> recording.name, recording.units, round(recording.rate, 9), recording.values[:4].tolist()
    ('u', 'mm', 10.0, [0.0, 1.0, 2.0, 0.0])
    """
    found = read_recordings(
        [path],
        columns=column,
        time_column=time_column,
        rate=rate,
        resample=resample,
        fill=fill,
        detrend=detrend,
        span=span,
        unit=unit,
        decimal=decimal,
    )
    return longest_of(found)


def read_recordings(
    paths: str | Path | Sequence[str | Path],
    *,
    columns: Wanted = None,
    time_column: str | int | None = None,
    rate: float | None = None,
    run_column: str | int | None = None,
    resample: float | None = None,
    fill: float | None = None,
    detrend: str = "none",
    span: tuple[float, float] | None = None,
    unit: str = "",
    decimal: str = "auto",
) -> tuple[Recording, ...]:
    """Read every stretch of every channel of every run: of several files, or by the values of a ``run_column``.

    Parameters
    ----------
    paths : str, Path or sequence of them
        The files.
    columns : str, int or sequence of them, optional
        Names or numbers from 1, or ``"all"``.
    time_column : str or int, optional
        The times.  A unit of time in the header, such as "t [ms]", is converted to seconds.
    rate : float, optional
        Samples per second, in place of a time column.
    run_column : str or int, optional
        The column that tells the runs of one file apart.
    resample : float, optional
        The rate to interpolate uneven times to (a lower rate than that of even samples filters them first); without it
        they are refused, unless they are nearly even.
    fill : float, optional
        Where values or times are missing (an empty cell, NaN) the signal is cut; ``fill`` interpolates instead where
        neighbouring samples are at most so many time units apart; what is interpolated so enters no fit.
    detrend : str
        ``"none"``, ``"linear"`` or ``"slow"``.
    span : (float, float), optional
        First and last time to keep, such as the free decay after a release.
    unit : str, optional
        Of the samples, in place of the one in the header; angles in degrees are converted to radians.
    decimal : {"auto", "point", "comma", ".", ","}
        The mark of the decimals in a table of text; by default what each column's cells prove.

    Returns
    -------
    tuple of Recording
        In the order of the files, their runs, channels and stretches.

    Raises
    ------
    OSError, InputError
        As :func:`read_recording` does.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.csv"
    ...     rows = [f"{i / 10},{i % 3},{'' if i == 20 else i % 4}" for i in range(50)]
    ...     _ = path.write_text("t_s,u,w" + chr(10) + chr(10).join(rows))
    ...     found = read_recordings([path], columns="all")
    >>> [(recording.name, recording.stretch, recording.values.size) for recording in found]
    [('u', 0, 50), ('w', 1, 20), ('w', 2, 29)]
    """
    treatment = Treatment(resample, fill, detrend, span, unit)
    files = [paths] if isinstance(paths, str | Path) else paths
    names = [Path(path).name for path in files]
    places = Places(columns, time_column, rate, run_column, decimal)
    found: list[Recording] = []
    for path, name in zip(files, names, strict=True):
        run = "" if len(files) == 1 else name if names.count(name) == 1 else str(path)
        for signal in signals(Path(path), places, run):
            found.extend(recordings_of(signal, rate, treatment))
    if not found:
        raise InputError("no file is given; name at least one")
    return tuple(found)
