"""The columns of a file of samples, whatever its format: names, numbers on demand, and how a row's place is called."""

from __future__ import annotations

import io
import struct
import warnings
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.io import wavfile

from numeric.errors import InputError
from numeric.samples import Array, checked_budget
from numeric.text_table import parse_table

FILE_BUDGET = 1_000_000_000
"""Bytes that a file, unpacked, may hold."""


@dataclass(frozen=True)
class Columns:
    """Named columns of a file; ``rate`` is what the file itself states (WAV), else None."""

    names: tuple[str, ...]
    values: Callable[[int], Array]
    place: Callable[[int], str]
    source: str
    rate: float | None = None
    units: str = ""
    note: str = ""


def from_text(data: bytes, source: str) -> Columns:
    """Columns of a delimited text file."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{source}: byte {error.start} is not UTF-8 text; save the table as UTF-8") from None
    table = parse_table(text, source=source)
    return Columns(table.names, table.column, lambda i: f"line {table.lines[i]}", source)


def from_npz(data: bytes, source: str) -> Columns:
    """The one-dimensional real arrays of an NPZ archive; nothing pickled is loaded."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
        checked_budget(unpacked, FILE_BUDGET, f"{source} unpacked", "cut the recording into parts")
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
    except InputError:
        raise
    except (ValueError, zipfile.BadZipFile, EOFError, KeyError) as error:
        raise InputError(f"{source} is not an NPZ archive of plain numbers: {error}") from None
    vectors = {name: array for name, array in arrays.items() if array.ndim == 1 and array.dtype.kind in "biuf"}
    if not vectors:
        found = ", ".join(f"{name} {array.dtype}{list(array.shape)}" for name, array in arrays.items()) or "nothing"
        raise InputError(f"{source} holds no one-dimensional real array; it has {found}")
    names = tuple(vectors)
    return Columns(names, lambda i: vectors[names[i]].astype(np.float64), lambda i: f"index {i}", source)


def from_wav(data: bytes, source: str) -> Columns:
    """The channels of a WAV file; integers are divided by full scale."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", wavfile.WavFileWarning)  # chunks beside the samples
            rate, samples = wavfile.read(io.BytesIO(data))
    except (ValueError, EOFError, struct.error) as error:
        raise InputError(f"{source} is not a readable WAV file: {error}") from None
    scaled, note = full_scale(samples.reshape(samples.shape[0], -1))
    names = tuple(f"channel {i + 1}" for i in range(scaled.shape[1]))
    units = "full scale" if note else ""
    return Columns(names, lambda i: scaled[:, i], lambda i: f"sample {i}", source, float(rate), units, note)


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
    {".csv": from_text, ".txt": from_text, ".tsv": from_text, ".dat": from_text, ".npz": from_npz, ".wav": from_wav}
)
