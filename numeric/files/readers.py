"""The columns of a file of samples, whatever its format: names, numbers on demand, and how a row's place is called."""

from __future__ import annotations

import io
import struct
import warnings
import zipfile
from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.io import wavfile

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.arrays import Stored, from_arrays, in_memory
from ridgeback.numeric.files.columns import FILE_BUDGET, Columns
from ridgeback.numeric.files.hdf5 import from_hdf5
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.text import TEXT_BUDGET, parse_table
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
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
    except InputError:
        raise
    except (ValueError, zipfile.BadZipFile, EOFError, KeyError, OSError, NotImplementedError, RuntimeError) as error:
        raise InputError(f"{source} is not an NPZ archive of plain numbers: {error}") from None
    return from_arrays(in_memory(arrays), source, kind="NPZ archive")


def from_npy(data: bytes, source: str) -> Columns:
    """The one array of an NPY file; nothing pickled is loaded."""
    try:
        array = np.load(io.BytesIO(data), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise InputError(f"{source} is not an NPY file of plain numbers: {error}") from None
    if not isinstance(array, np.ndarray):
        raise InputError(f"{source} is not an NPY file but an archive; name it .npz")
    return from_arrays((Stored("x", array.shape, array.dtype, lambda: array),), source, kind="NPY file")


def from_wav(data: bytes, source: str) -> Columns:
    """The channels of a WAV file; integers are divided by full scale."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", wavfile.WavFileWarning)  # chunks beside the samples
            rate, samples = wavfile.read(io.BytesIO(data))
    except (ValueError, EOFError, struct.error) as error:
        raise InputError(f"{source} is not a readable WAV file: {error}") from None
    channels = samples.reshape(samples.shape[0], -1)
    note = full_scale(channels[:0])[1]
    names = tuple(f"channel {i + 1}" for i in range(channels.shape[1]))
    return Columns(
        names=names,
        sizes=(channels.shape[0],) * len(names),
        values=lambda i: full_scale(channels[:, i])[0],
        place=lambda row: f"sample {row}",
        source=source,
        rate=float(rate),
        units="full scale" if note else "",
        note=note,
    )


# An unsigned 8-bit sample is centred on 128; scipy hands 24-bit samples over in the high bytes of 32.
def full_scale(samples: NDArray[np.generic]) -> tuple[Array, str]:
    """Integer samples as shares of full scale, -1 .. 1, and the sentence that says so; floats as they are.

    >>> full_scale(np.array([-32768, 16384], dtype=np.int16))[0].tolist()
    [-1.0, 0.5]
    """
    numbers = samples.astype(np.float64)
    if samples.dtype.kind == "f":
        return numbers, ""
    bits = 8 * samples.dtype.itemsize
    middle = 2.0 ** (bits - 1) if samples.dtype.kind == "u" else 0.0
    return (numbers - middle) / 2.0 ** (bits - 1), f"{bits}-bit integer samples were divided by full scale"


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
