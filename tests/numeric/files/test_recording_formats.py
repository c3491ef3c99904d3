"""The same samples through every format; wrong, damaged and hostile files end in one line."""

from __future__ import annotations

import io
import struct
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import savemat

from ridgeback.common.errors import InputError
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.readers import columns_of_file
from ridgeback.numeric.recording.reading import read_recording, read_recordings

h5py = pytest.importorskip("h5py")

TIME = np.arange(64) / 20.0
U = np.sin(3 * TIME) + 0.25
W = np.cos(3 * TIME)


def hdf5(path: Path, **arrays: np.ndarray) -> Path:
    with h5py.File(path, "w") as file:
        for name, values in arrays.items():
            file[name] = values
    return path


def test_a_matlab_file_gives_back_its_vectors_whatever_their_shape(tmp_path: Path) -> None:
    path = tmp_path / "run.mat"
    savemat(path, {"t": TIME, "u": U[:, None], "w": W, "label": "pendulum", "cells": np.array([1, "a"], dtype=object)})
    found = read_recording(path, column="u")
    assert np.array_equal(found.values, U)
    assert found.rate == pytest.approx(20.0)
    assert any("cells (cell)" in note and "label (char)" in note for note in found.notes)
    assert np.array_equal(read_recording(path, column="w").values, W)
    with pytest.raises(InputError, match="no column cells"):
        read_recording(path, column="cells")


def test_structures_become_dotted_names_and_a_stated_rate_is_used(tmp_path: Path) -> None:
    path = tmp_path / "run.mat"
    savemat(path, {"run": {"x": U, "deep": {"w": W}}, "fs": 20.0})
    found = read_recording(path, column="run.deep.w")
    assert np.array_equal(found.values, W)
    assert found.rate == 20.0
    with pytest.raises(InputError, match="states 20 samples per second, not 5"):
        read_recording(path, column="run.x", rate=5.0)


@pytest.mark.parametrize("suffix", [".mat", ".npz", ".h5"])
@pytest.mark.parametrize("across", [False, True])
def test_a_matrix_is_read_along_its_longer_axis(tmp_path: Path, suffix: str, across: bool) -> None:
    matrix = np.stack([U, W], axis=0 if across else 1)
    path = tmp_path / f"run{suffix}"
    if suffix == ".mat":
        savemat(path, {"t": TIME, "x": matrix})
    elif suffix == ".npz":
        np.savez(path, t=TIME, x=matrix)
    else:
        hdf5(path, t=TIME, x=matrix)
    first, second = read_recordings([path], columns="all")
    assert (first.name, second.name) == ("x[1]", "x[2]")
    assert np.array_equal(first.values, U)
    assert np.array_equal(second.values, W)


def test_hdf5_datasets_units_and_rates_from_attributes(tmp_path: Path) -> None:
    path = hdf5(tmp_path / "run.hdf5", **{"lab/u": U, "lab/note": np.array([b"text"])})
    with h5py.File(path, "a") as file:
        file["lab/u"].attrs["units"] = "mm"
        file["lab/u"].attrs["dt"] = 0.05
    found = read_recording(path)
    assert (found.name, found.units, found.rate) == ("lab/u", "mm", 20.0)
    assert np.array_equal(found.values, U)


def test_matlab_7_3_is_read_as_hdf5(tmp_path: Path) -> None:
    """A v7.3 file is an HDF5 file behind a user block of 512 bytes, its matrices transposed."""
    path = tmp_path / "run.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        file["t"], file["u"] = TIME[None, :], U[None, :]
        file["#refs#/a"] = np.zeros(64)
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")
    assert np.array_equal(read_recording(path).values, U)


def test_nothing_outside_an_hdf5_file_is_followed(tmp_path: Path) -> None:
    other = hdf5(tmp_path / "other.h5", secret=W)
    path = hdf5(tmp_path / "run.h5", t=TIME, u=U)
    with h5py.File(path, "a") as file:
        file["link"] = h5py.ExternalLink(str(other), "secret")
        file["soft"] = h5py.SoftLink("/u")
        layout = h5py.VirtualLayout(shape=(64,), dtype=float)
        layout[:] = h5py.VirtualSource(str(other), "secret", shape=(64,))
        file.create_virtual_dataset("virtual", layout)
        file.create_dataset("raw", (64,), dtype=float, external=[(str(tmp_path / "raw.bin"), 0, 512)])
    assert read_recording(path).name == "u"  # the only candidate left


def test_without_the_library_the_environment_is_at_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = hdf5(tmp_path / "run.h5", t=TIME, u=U)
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(OSError, match=r"reading run\.h5 needs h5py, .*pip install 'ridgeback\[hdf5\]'"):
        read_recording(path)


def test_blanks_percent_comments_and_empty_cells_in_text(tmp_path: Path) -> None:
    path = tmp_path / "run.dat"
    rows = [f"  {t:.2f}   {u:.9f} " for t, u in zip(TIME, U, strict=True)]
    path.write_text("% made by hand\n t   u\n" + "\n".join(rows) + "\n", encoding="utf-8")
    assert np.abs(read_recording(path).values - U).max() < 1e-8


def test_dates_with_times_of_day_are_seconds_since_the_first(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    stamps = [f"2026-11-22T23:59:{58 + i // 20:02d}.{50 * (i % 20):03d}" for i in range(40)]
    stamps += [f"2026-11-23T00:00:{i // 20:02d}.{50 * (i % 20):03d}" for i in range(24)]
    path.write_text("\n".join(f"{t},{u!r}" for t, u in zip(stamps, U.tolist(), strict=True)), encoding="utf-8")
    found = read_recording(path, time_column=1, column=2)
    assert found.rate == pytest.approx(20.0)
    assert np.array_equal(found.values, U)
    path.write_text("time,u\n2026-11-22T10:00:00,1\n2026-11-22T10:00:01Z,1\n" + "3,1\n" * 20, encoding="utf-8")
    with pytest.raises(InputError, match="line 3, column time: '2026-11-22T10:00:01Z' is not a number"):
        read_recording(path)


def test_plain_arrays_and_pickles(tmp_path: Path) -> None:
    np.save(tmp_path / "x.npy", U)
    assert np.array_equal(read_recording(tmp_path / "x.npy", rate=20.0).values, U)
    np.save(tmp_path / "bad.npy", np.array([{}], dtype=object), allow_pickle=True)
    with pytest.raises(InputError, match="not an NPY file of plain numbers"):
        read_recording(tmp_path / "bad.npy")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("empty.mat", b"", "not a readable MATLAB file"),
        ("empty.h5", b"", "not a readable HDF5 file"),
        ("empty.npz", b"", "not an NPZ archive"),
        ("empty.npy", b"", "not an NPY file"),
        ("empty.wav", b"", "not a readable WAV"),
        ("words.mat", b"t,u\n1,2\n" * 40, "not a readable MATLAB file"),
        ("words.h5", b"t,u\n1,2\n" * 40, "not a readable HDF5 file"),
        ("cut.mat", b"\x89HDF\r\n\x1a\n" + b"\x00" * 40, "not a readable HDF5 file"),
    ],
)
def test_files_that_are_not_what_they_are_called(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=message) as caught:
        read_recording(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_a_file_without_numbers_says_what_it_has(tmp_path: Path) -> None:
    savemat(tmp_path / "a.mat", {"label": "text"})
    with pytest.raises(InputError, match=r"holds no real array.*Not read.*label \(char\)"):
        read_recording(tmp_path / "a.mat")
    with pytest.raises(InputError, match=r"HDF5 file holds no real array of one or two axes; it has z complex128\[4\]"):
        read_recording(hdf5(tmp_path / "a.h5", z=np.zeros(4, dtype=complex)))
    np.savez(tmp_path / "lengths.npz", t=TIME, u=U[:50], w=W)
    with pytest.raises(InputError, match="u has 50 samples, the time column t 64"):
        read_recording(tmp_path / "lengths.npz", column="u")
    assert read_recording(tmp_path / "lengths.npz").name == "w"


def test_a_number_too_large_to_hold_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("u", (400_000_000,), dtype=float, chunks=(1000,))  # nothing is stored
    with pytest.raises(InputError, match=r"column u has 400000000 samples, over 50000000"):
        read_recording(path, rate=20.0)


def samples_of(suffix: str) -> bytes:
    if suffix == ".mat":
        stream = io.BytesIO()
        savemat(stream, {"t": TIME, "u": U, "s": {"a": W}}, do_compression=False)
        return stream.getvalue()
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file["t"], file["u"] = TIME, U
    return stream.getvalue()


WHOLE = {suffix: samples_of(suffix) for suffix in (".mat", ".h5")}


@pytest.mark.parametrize("suffix", sorted(WHOLE))
@given(data=st.data())
@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_damaged_file_is_read_or_refused_in_one_line(suffix: str, data: st.DataObject) -> None:
    content = bytearray(WHOLE[suffix])
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    del content[data.draw(st.integers(100, len(content))) :]
    message = ""
    try:
        columns = columns_of_file(bytes(content), suffix, f"run{suffix}")
        for index in range(len(columns.names)):
            columns.values(index)
    except InputError as error:
        message = str(error)
    assert "\n" not in message


def matlab_element(kind: int, payload: bytes) -> bytes:
    return struct.pack("<II", kind, len(payload)) + payload + b"\x00" * (-len(payload) % 8)


def test_a_function_handle_is_not_read() -> None:
    """Class 16 of the MAT-file format, level 5, holds a function; here one named f beside the samples u."""
    stream = io.BytesIO()
    savemat(stream, {"u": U})
    parts = [(6, struct.pack("<II", 16, 0)), (5, struct.pack("<ii", 1, 1)), (1, b"f"), (14, b"")]
    handle = matlab_element(14, b"".join(matlab_element(kind, payload) for kind, payload in parts))
    columns = from_mat(stream.getvalue() + handle, "run.mat")
    assert columns.names == ("u",)
    assert columns.note == "Not read, because it holds no plain numbers: f (function)."


@pytest.mark.parametrize("name", ["SamplingRate", "fs", "Sample Rate"])
def test_a_rate_among_the_attributes_of_a_group_is_used(tmp_path: Path, name: str) -> None:
    with h5py.File(tmp_path / "run.h5", "w") as file:
        group = file.create_group("run1")
        group.attrs[name] = 20.0
        group["u"] = U
    assert read_recording(tmp_path / "run.h5", column="run1/u").rate == 20.0
