"""LabVIEW's files: TDMS by npTDMS, and LVM, a table of text below two headers."""

from __future__ import annotations

import io
import logging
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import Stored, from_arrays, held
from ridgeback.numeric.files.columns import DAMAGE, Columns, first_line
from ridgeback.numeric.files.tables.numbers import AUTO

Parsed = Callable[[str, str, str], Columns]
END = re.compile(r"^\*\*\*End_of_Header\*\*\*.*$", re.MULTILINE)
COMMA = re.compile(r"^Decimal_Separator[\t;]+,", re.MULTILINE)
STEP, UNITS = "Delta_X", "Y_Unit_Label"
"""Lines of the second header: a value for each channel."""
EMPTY_X, REMARKS = "x_value", "comment"
"""Columns that LabVIEW writes always, and often leaves empty."""
SAME = 1e-9
"""Relative difference below which two steps are one."""


def of_lvm(parsed: Parsed, text: str, source: str, decimal: str) -> Columns:
    """Columns of the first segment of an LVM file: what no number stands in is no column, and Delta_X may be the step.

    Parameters
    ----------
    parsed : callable
        Makes columns of a table in text, its name and the mark of its decimals.
    text : str
        The file.
    source : str
        Its name.
    decimal : {"auto", ".", ","}
        The mark of the decimals; the file's own header states it by default.

    Raises
    ------
    InputError
        For a table that cannot be read.
    """
    headers = list(END.finditer(text))
    if len(headers) < 2:
        return parsed(text, source, decimal)
    begin, end = headers[1].end(), len(text) if len(headers) < 3 else headers[2].start()
    lines = text[begin:end].strip("\r\n").splitlines()
    if len(headers) > 2:
        lines = lines[: next((i for i, line in enumerate(lines) if not line.strip()), len(lines))]
    header, comma = text[headers[0].end() : headers[1].start()], COMMA.search(text, 0, headers[0].start()) is not None
    mark = decimal if decimal != AUTO else "," if comma else "."
    table = replace(parsed("\n".join(lines), source, mark), note="")
    steps = stated(header, STEP, comma=comma)
    named = with_units(without_empty(table), stated(header, UNITS, comma=comma))
    return with_step(named, steps[0] if steps else None, len(headers) - 1)


def stated(header: str, name: str, *, comma: bool) -> list[str]:
    r"""What a header says of each channel; a ``comma`` may be a decimal one.

    >>> stated("Delta_X\t0,01\t\n", "Delta_X", comma=True), stated("Y_Unit_Label,mm,V", "Y_Unit_Label", comma=False)
    (['0,01'], ['mm', 'V'])
    """
    line = next((line for line in header.splitlines() if line.startswith(name)), "")
    cells = [cell.strip() for cell in re.split(r"[\t;]" if comma else r"[\t,;]", line)[1:]]
    return cells[:-1] if cells and not cells[-1] else cells


def with_units(table: Columns, units: list[str]) -> Columns:
    """The columns with their units, where there is one for each that holds samples."""
    samples = [i for i, name in enumerate(table.names) if name.strip().lower() not in (EMPTY_X, REMARKS)]
    if len(samples) != len(units):
        return table
    unit = dict(zip(samples, units, strict=True))
    names = (f"{name} [{unit[i]}]" if unit.get(i) else name for i, name in enumerate(table.names))
    return replace(table, names=tuple(names))


def without_empty(table: Columns) -> Columns:
    """The columns less those of LabVIEW's own that hold no number."""
    names = [name.strip().lower() for name in table.names]
    empty = {
        i for i, name in enumerate(names) if name in (EMPTY_X, REMARKS) and not np.isfinite(numbers(table, i)).any()
    }
    kept = [i for i in range(len(names)) if i not in empty]
    return replace(
        table,
        names=tuple(table.names[i] for i in kept),
        sizes=tuple(table.sizes[i] for i in kept),
        values=lambda i: table.values(kept[i]),
        words=tuple(at for at, i in enumerate(kept) if i in table.words),
    )


def numbers(table: Columns, index: int) -> Any:
    """A column's numbers; none where it holds words."""
    try:
        return table.values(index)
    except InputError:
        return np.empty(0)


def with_step(table: Columns, step: str | None, segments: int) -> Columns:
    """The columns with the rate of a header, where they hold no times, and a note where more of the file was left."""
    note = f"The first of {segments} segments was read." if segments > 1 else ""
    table = replace(table, note=" ".join(part for part in (table.note, note) if part))
    if step is None or any(name.strip().lower() == EMPTY_X for name in table.names):
        return table
    try:
        seconds = float(step.replace(",", "."))
    except ValueError:
        return table
    return replace(table, rate=1.0 / seconds) if seconds > 0.0 else table


def from_tdms(data: bytes, source: str) -> Columns:
    """Columns of a TDMS file's channels, by npTDMS, with the step and the unit that their properties state.

    Raises OSError without npTDMS, InputError for a damaged file, and for channels of different steps.
    """
    try:
        from nptdms import TdmsFile  # noqa: PLC0415 - only TDMS files need it
    except ImportError:
        raise OSError(
            f"reading {source} needs npTDMS, which is not installed; pip install 'ridgeback[tdms]' brings it"
        ) from None
    try:
        with quiet("nptdms"):
            file = TdmsFile.read(io.BytesIO(data))
        channels = [channel for group in file.groups() for channel in group.channels()]
        steps = {channel.path: increment(channel.properties) for channel in channels}
        arrays = tuple(stored(channels))
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable TDMS file: {first_line(error)}") from None
    known = [step for step in steps.values() if step is not None]
    if known and max(known) - min(known) > SAME * max(known):
        raise InputError(
            f"{source}: its channels have different steps, {min(known):g} to {max(known):g} s; export them apart"
        )
    rate = (held("dt", np.array([known[0]])),) if known else ()
    return from_arrays((*arrays, *rate), source, kind="TDMS file")


@contextmanager
def quiet(name: str) -> Iterator[None]:
    """Keep a library's warnings off the terminal: what cannot be read is said in one line."""
    logger = logging.getLogger(name)
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before


def stored(channels: list[Any]) -> Iterator[Stored]:
    """The channels that hold samples, named by group and channel, without the group where there is but one."""
    groups = {channel.group_name for channel in channels}
    for channel in channels:
        unit = str(channel.properties.get("unit_string", "")).strip()
        name = channel.name if len(groups) == 1 else f"{channel.group_name}/{channel.name}"
        if len(channel):
            yield held(f"{name} [{unit}]" if unit else name, np.asarray(channel[:]))


def increment(properties: Any) -> float | None:
    """The step of a waveform in seconds, None for what is none."""
    value = properties.get("wf_increment")
    return float(value) if value is not None and float(value) > 0.0 else None
