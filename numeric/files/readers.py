"""The columns of a file of samples, whatever its format: names, numbers on demand, and how a row's place is called."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.arrays import from_arrays, held, in_memory
from ridgeback.numeric.files.columns import DAMAGE, FILE_BUDGET, Columns, first_line
from ridgeback.numeric.files.hdf5 import from_hdf5
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.npy import array_of
from ridgeback.numeric.files.text import TEXT_BUDGET, parse_table
from ridgeback.numeric.files.wav import from_wav
from ridgeback.numeric.signal.samples import checked_budget


def from_text(data: bytes, source: str) -> Columns:
    """Columns of a delimited text file."""
    checked_budget(len(data), TEXT_BUDGET, f"{source} as text", "store it as NPZ, MAT or HDF5, or cut it into parts")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{source}: byte {error.start} is not UTF-8 text; save the table as UTF-8") from None
    table = parse_table(text, source=source)
    sizes = (len(table.rows),) * len(table.names)
    return Columns(table.names, sizes, table.column, lambda i: f"line {table.lines[i]}", source)


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
        ".npz": from_npz,
        ".npy": from_npy,
        ".wav": from_wav,
        ".mat": from_mat,
        ".h5": from_hdf5,
        ".hdf5": from_hdf5,
        ".hdf": from_hdf5,
    }
)
