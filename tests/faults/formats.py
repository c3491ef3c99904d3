"""A decaying oscillation, and the bytes of a file of every kind that is read."""

from __future__ import annotations

import io
import struct
import zipfile

import numpy as np
from scipy.io import savemat, wavfile

RATE = 32.0
TIME = np.arange(400) / RATE
U = np.exp(-0.05 * TIME) * np.cos(2.0 * np.pi * TIME + 0.3 * np.exp(-0.1 * TIME))


def table(rows: object, *, head: str = "time_s,u") -> str:
    """A table of text with one line per row."""
    return "\n".join([head, *(",".join(str(cell) for cell in row) for row in rows)]) + "\n"  # type: ignore[attr-defined]


def decay(columns: int = 1, *, head: str = "time_s,u", mark: str = ",") -> str:
    """The decay as text."""
    return table(
        ([repr(float(t)), *[repr(float(x))] * columns] for t, x in zip(TIME, U, strict=True)), head=head
    ).replace(",", mark)


def npz(**arrays: object) -> bytes:
    """An archive of arrays, written as a user's NumPy would."""
    stream = io.BytesIO()
    np.savez(stream, **arrays)  # type: ignore[arg-type]
    return stream.getvalue()


def npz_of_nothing() -> bytes:
    """An archive without a member."""
    stream = io.BytesIO()
    zipfile.ZipFile(stream, "w").close()
    return stream.getvalue()


def bomb() -> bytes:
    """An archive that says it unpacks to far more than it holds."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("u.npy", npy(U))
    data = stream.getvalue()
    true, lie = struct.pack("<I", len(npy(U))), struct.pack("<I", 0xFFFFFF00)
    return data.replace(true, lie)


def npy(array: object) -> bytes:
    """One array as a file."""
    stream = io.BytesIO()
    np.save(stream, array)  # type: ignore[arg-type]
    return stream.getvalue()


def wav() -> bytes:
    """The decay in 16 bits."""
    stream = io.BytesIO()
    wavfile.write(stream, int(RATE), np.round(30000 * U).astype(np.int16))
    return stream.getvalue()


def mat(**arrays: object) -> bytes:
    """A MATLAB file of version 5, not compressed, so that a changed byte meets its reader."""
    stream = io.BytesIO()
    savemat(stream, arrays or {"t": TIME, "u": U})
    return stream.getvalue()


def hdf5(**arrays: object) -> bytes:
    """An HDF5 file; nothing at all where h5py is not installed, which the cases then say."""
    try:
        import h5py
    except ImportError:
        return b""
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        for name, array in (arrays or {"t": TIME, "u": U}).items():
            if array is not None:
                file[name] = array
    return stream.getvalue()


def patched(data: bytes, at: int, new: bytes) -> bytes:
    """The bytes with some replaced."""
    return data[:at] + new + data[at + len(new) :]
