"""The columns of a file of samples, whatever its format: names, numbers on demand, and how a row's place is called."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import datetime
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import from_arrays, held, in_memory
from ridgeback.numeric.files.columns import DAMAGE, FILE_BUDGET, Columns, first_line
from ridgeback.numeric.files.hdf5 import from_hdf5
from ridgeback.numeric.files.labview import from_tdms, of_lvm
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.npy import array_of
from ridgeback.numeric.files.tables.text import TEXT_BUDGET, decoded, parse_table
from ridgeback.numeric.files.wav import from_wav
from ridgeback.numeric.signal.samples import checked_budget


def from_text(data: bytes, source: str) -> Columns:
    """Columns of a delimited text file."""
    checked_budget(len(data), TEXT_BUDGET, f"{source} as text", "store it as NPZ, MAT or HDF5, or cut it into parts")
    text, note = decoded(data, source)
    return with_note(of_table(text, source), note)


def of_table(text: str, source: str) -> Columns:
    """Columns of a table in text."""
    table = parse_table(text, source=source)
    sizes = (len(table.rows),) * len(table.names)
    return Columns(table.names, sizes, table.column, lambda i: f"line {table.rows.number[i]}", source, note=table.note)


def with_note(columns: Columns, note: str) -> Columns:
    """The columns with a note before their own."""
    return replace(columns, note=" ".join(part for part in (note, columns.note) if part))


def from_lvm(data: bytes, source: str) -> Columns:
    """Columns of a LabVIEW measurement file."""
    checked_budget(len(data), TEXT_BUDGET, f"{source} as text", "store it as TDMS or HDF5, or cut it into parts")
    text, note = decoded(data, source)
    return with_note(of_lvm(of_table, text, source), note)


def from_excel(data: bytes, source: str) -> Columns:
    """Columns of the first sheet of an Excel workbook, by openpyxl: values, no formula is evaluated."""
    try:
        from openpyxl import load_workbook  # noqa: PLC0415 - only Excel's files need it
    except ImportError:
        raise OSError(
            f"reading {source} needs openpyxl, which is not installed; pip install 'ridgeback[excel]' brings it"
        ) from None
    try:
        sheet = load_workbook(io.BytesIO(data), read_only=True, data_only=True).worksheets[0]
        lines = ["\t".join(cell_text(cell) for cell in row) for row in sheet.iter_rows(values_only=True)]
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable Excel workbook: {first_line(error)}") from None
    return from_text("\n".join(lines).encode(), source)


def cell_text(cell: object) -> str:
    """A cell as text: dates as stamps, nothing for an empty one.

    >>> cell_text(1.5), cell_text(None), cell_text(datetime(2026, 1, 2, 3, 4, 5))
    ('1.5', '', '2026-01-02T03:04:05')
    """
    if isinstance(cell, datetime):
        return cell.isoformat()
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


READERS: Mapping[str, Callable[[bytes, str], Columns]] = MappingProxyType(
    {
        ".csv": from_text,
        ".txt": from_text,
        ".tsv": from_text,
        ".dat": from_text,
        ".lvm": from_lvm,
        ".tdms": from_tdms,
        ".asc": from_text,
        ".xlsx": from_excel,
        ".npz": from_npz,
        ".npy": from_npy,
        ".wav": from_wav,
        ".mat": from_mat,
        ".h5": from_hdf5,
        ".hdf5": from_hdf5,
        ".hdf": from_hdf5,
    }
)
