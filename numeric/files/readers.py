"""The columns of a file of samples, whatever its format: names, numbers on demand, and how a row's place is called."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import datetime, timedelta
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import from_arrays, held, in_memory
from ridgeback.numeric.files.columns import DAMAGE, FILE_BUDGET, Columns, first_line
from ridgeback.numeric.files.hdf5 import from_hdf5
from ridgeback.numeric.files.labview import from_tdms, of_lvm
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.npy import array_of
from ridgeback.numeric.files.tables.encoding import decoded
from ridgeback.numeric.files.tables.numbers import AUTO, COMMA, POINT
from ridgeback.numeric.files.tables.text import parse_table
from ridgeback.numeric.files.wav import from_wav
from ridgeback.numeric.signal.samples import checked_budget

TEXT_BUDGET = 300_000_000
"""Bytes of text: at about 20 bytes a sample, some ten million of them."""


def from_text(data: bytes, source: str, decimal: str) -> Columns:
    """Columns of a delimited text file."""
    checked_budget(len(data), TEXT_BUDGET, f"{source} as text", "store it as NPZ, MAT or HDF5, or cut it into parts")
    text, note = decoded(data, source)
    return with_note(of_table(text, source, decimal), note)


def of_table(text: str, source: str, decimal: str) -> Columns:
    """Columns of a table in text."""
    table = parse_table(text, source=source, decimal=decimal)
    sizes = (len(table.rows),) * len(table.names)
    return Columns(
        names=table.names,
        sizes=sizes,
        values=table.column,
        place=lambda i: f"line {table.rows.number[i]}",
        source=source,
        note=table.note,
        hinted=table.hinted,
        words=table.words,
        stamps=table.stamps,
    )


def with_note(columns: Columns, note: str) -> Columns:
    """The columns with a note before their own."""
    return replace(columns, note=" ".join(part for part in (note, columns.note) if part))


def from_lvm(data: bytes, source: str, decimal: str) -> Columns:
    """Columns of a LabVIEW measurement file."""
    checked_budget(len(data), TEXT_BUDGET, f"{source} as text", "store it as TDMS or HDF5, or cut it into parts")
    text, note = decoded(data, source)
    return with_note(of_lvm(of_table, text, source, decimal), note)


def from_excel(data: bytes, source: str, decimal: str) -> Columns:
    """Columns of the first sheet of an Excel workbook, by openpyxl: values, no formula is evaluated.

    The ``decimal`` mark is that of cells that hold text.
    """
    try:
        from openpyxl import load_workbook  # noqa: PLC0415 - only Excel's files need it
    except ImportError:
        raise OSError(
            f"reading {source} needs openpyxl, which is not installed; pip install 'ridgeback[excel]' brings it"
        ) from None
    try:
        sheet = load_workbook(io.BytesIO(data), read_only=True, data_only=True).worksheets[0]
        lines = ["\t".join(cell_text(cell, decimal) for cell in row) for row in sheet.iter_rows(values_only=True)]
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable Excel workbook: {first_line(error)}") from None
    return from_text("\n".join(lines).encode(), source, decimal)


def cell_text(cell: object, decimal: str) -> str:
    """A cell as text: dates as stamps, nothing for an empty one.

    >>> cell_text(timedelta(days=1, seconds=1.5), ".")
    '24:00:01.500000'
    >>> cell_text(1.5, "auto"), cell_text(1.5, ","), cell_text(None, "."), cell_text(datetime(2026, 1, 2, 3, 4), ".")
    ('1.5', '1,5', '', '2026-01-02T03:04:00')
    """
    if isinstance(cell, datetime):
        return cell.isoformat()
    if isinstance(cell, timedelta):
        hours, rest = divmod(cell, timedelta(hours=1))
        minutes, rest = divmod(rest, timedelta(minutes=1))
        return f"{hours}:{minutes:02d}:{rest.total_seconds():09.6f}"
    if isinstance(cell, float) and decimal == COMMA:
        return str(cell).replace(POINT, COMMA)
    return "" if cell is None else str(cell).replace("\t", " ").replace("\n", " ")


def from_npz(data: bytes, source: str) -> Columns:
    """The real arrays of an NPZ archive, each column of a matrix by itself; nothing pickled is loaded."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
            checked_budget(unpacked, FILE_BUDGET, f"{source} unpacked", "cut the recording into parts")
            members = {e.filename: archive.read(e) for e in archive.infolist() if e.filename.endswith(".npy")}
    except InputError:
        raise
    except DAMAGE as error:
        raise InputError(f"{source} is not an NPZ archive of plain numbers: {first_line(error)}") from None
    arrays = {name.removesuffix(".npy"): array_of(data, f"{source}, {name}") for name, data in members.items()}
    return from_arrays(in_memory(arrays), source, kind="NPZ archive")


def from_npy(data: bytes, source: str) -> Columns:
    """The one array of an NPY file; nothing pickled is loaded."""
    if data.startswith(b"PK"):
        raise InputError(f"{source} is not an NPY file but an archive; name it .npz")
    return from_arrays((held("x", array_of(data, source)),), source, kind="NPY file")


def columns_of_file(data: bytes, suffix: str, source: str, decimal: str = AUTO) -> Columns:
    """The columns of a file of a known suffix.

    Raises InputError for a file that cannot be read, and for a decimal mark stated where numbers are no text.
    """
    if suffix in OF_TEXT:
        return OF_TEXT[suffix](data, source, decimal)
    if decimal != AUTO:
        raise InputError(f"{source} holds numbers, no text with a decimal mark; leave --decimal out")
    return BINARY[suffix](data, source)


OF_TEXT: Mapping[str, Callable[[bytes, str, str], Columns]] = MappingProxyType(
    {
        ".csv": from_text,
        ".txt": from_text,
        ".tsv": from_text,
        ".dat": from_text,
        ".asc": from_text,
        ".lvm": from_lvm,
        ".xlsx": from_excel,
    }
)
BINARY: Mapping[str, Callable[[bytes, str], Columns]] = MappingProxyType(
    {
        ".tdms": from_tdms,
        ".npz": from_npz,
        ".npy": from_npy,
        ".wav": from_wav,
        ".mat": from_mat,
        ".h5": from_hdf5,
        ".hdf5": from_hdf5,
        ".hdf": from_hdf5,
    }
)
SUFFIXES = (*OF_TEXT, *BINARY)
