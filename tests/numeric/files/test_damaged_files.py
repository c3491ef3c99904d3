"""Damaged files of every format: read, or refused in one line with InputError, never by a crash of the process."""

from __future__ import annotations

import io
import random
import struct
import zlib
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from scipy.io import loadmat, savemat, wavfile

from ridgeback.common.errors import InputError
from ridgeback.numeric.files import level4, level5
from ridgeback.numeric.files.matlab import from_mat
from ridgeback.numeric.files.readers import columns_of_file

h5py = pytest.importorskip("h5py")

TIME = np.arange(48) / 20.0
U = np.sin(3 * TIME)
ROUNDS = 250
"""Damaged files of each kind; together with the seed the same ones every time."""
EXTREMES = (0, 1, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)


def matlab(**options: object) -> bytes:
    stream = io.BytesIO()
    content = {"t": TIME, "u": U, "fs": 20.0}
    if options.get("format") != "4":
        content |= {"s": {"a": U.astype(np.int16), "deep": {"z": U + 1j}}, "label": "text", "flag": U > 0}
    savemat(stream, content, **options)  # type: ignore[arg-type]
    return stream.getvalue()


def archive(save: object) -> bytes:
    stream = io.BytesIO()
    save(stream, t=TIME, u=U, x=np.stack([U, U]).astype("f4"))  # type: ignore[operator]
    return stream.getvalue()


def one_array() -> bytes:
    stream = io.BytesIO()
    np.save(stream, U)
    return stream.getvalue()


def sound(kind: str) -> bytes:
    stream = io.BytesIO()
    wavfile.write(stream, 8000, np.stack([U, -U], axis=1).astype(kind))
    return stream.getvalue()


def tree() -> bytes:
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        file["t"], file["lab/u"] = TIME, U
        file.create_dataset("packed", data=np.stack([U, U]), chunks=(1, 16), compression="gzip")
        file["lab/u"].attrs["units"] = "mm"
        file.attrs["fs"] = 20.0
    return stream.getvalue()


WHOLE = {
    "v5.mat": matlab(),
    "v7.mat": matlab(do_compression=True),
    "v4.mat": matlab(format="4"),
    "stored.npz": archive(np.savez),
    "packed.npz": archive(np.savez_compressed),
    "x.npy": one_array(),
    "int16.wav": sound("i2"),
    "float.wav": sound("f4"),
    "tree.h5": tree(),
    "table.csv": "\n".join(["t,u", *(f"{t!r},{u!r}" for t, u in zip(TIME.tolist(), U.tolist(), strict=True))]).encode(),
}


def damaged(whole: bytes, seed: int) -> Iterator[bytes]:
    """Changed bytes, extreme values in place of words, cuts, and bytes too many."""
    chance = random.Random(seed)  # noqa: S311 - damage, not a secret
    for _ in range(ROUNDS):
        content = bytearray(whole)
        place = chance.randrange(min(len(content), 600) if chance.random() < 0.6 else len(content))
        match chance.randrange(4):
            case 0:
                content[place] ^= 1 << chance.randrange(8)
            case 1:
                form = chance.choice("<>") + chance.choice("HI")
                word = struct.pack(form, chance.choice(EXTREMES) & (0xFFFF if form[1] == "H" else 0xFFFFFFFF))
                content[place : place + len(word)] = word
            case 2:
                del content[place:]
            case _:
                content[place:place] = chance.randbytes(chance.randrange(1, 9))
        yield bytes(content)


@pytest.mark.parametrize("name", sorted(WHOLE))
def test_a_damaged_file_is_read_or_refused_in_one_line(name: str) -> None:
    suffix, refused = name[name.rindex(".") :], list[str]()
    for content in damaged(WHOLE[name], seed=zlib.crc32(name.encode())):
        try:
            columns = columns_of_file(content, suffix, name)
            for index in range(len(columns.names)):
                columns.values(index)
        except InputError as error:
            refused.append(str(error))
    assert len(refused) > ROUNDS // 20
    assert all(message.startswith(name) and "\n" not in message for message in refused)
    columns_of_file(WHOLE[name], suffix, name)


def changed(whole: bytes, place: int, form: str, value: int) -> bytes:
    word = struct.pack(form, value)
    return whole[:place] + word + whole[place + len(word) :]


def element(kind: int, data: bytes) -> bytes:
    """An element of a MAT file of level 5, padded to eight bytes."""
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def of_level_5(of_class: int, *parts: bytes, name: bytes = b"u", shape: tuple[int, ...] = (1, 1)) -> bytes:
    """A variable: its flags, its dimensions, its name, and what follows."""
    head = element(6, struct.pack("<II", of_class, 0)), element(5, struct.pack(f"<{len(shape)}i", *shape))
    return element(14, b"".join([*head, element(1, name), *parts]))


def nested(depth: int) -> bytes:
    """Structures in structures."""
    inner = of_level_5(6, element(9, struct.pack("<d", 1.0)))
    for _ in range(depth):
        inner = of_level_5(2, element(5, struct.pack("<i", 4)), element(1, b"a\0\0\0"), inner, name=b"s")
    return inner


HEAD = WHOLE["v5.mat"][:128]
WAV = WHOLE["int16.wav"]
WIDTH_4 = element(5, struct.pack("<i", 4))


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.wav", changed(WHOLE["int16.wav"], 22, "<H", 0), "byte 22: 0 channels, not 1 to 4096"),
        ("a.wav", changed(WHOLE["int16.wav"], 34, "<H", 0), "byte 34: 0 bits a sample"),
        ("a.wav", changed(WHOLE["int16.wav"], 24, "<I", 0), "byte 24: 0 samples per second"),
        ("a.wav", changed(WHOLE["int16.wav"], 32, "<H", 3), "byte 32: 3 bytes a frame, not 4"),
        ("a.wav", WHOLE["int16.wav"].replace(b"fmt ", b"fmx "), "no chunk 'fmt ' with its format"),
        ("a.wav", WHOLE["int16.wav"].replace(b"data", b"dada"), "no chunk 'data' with its samples"),
        ("a.npy", WHOLE["x.npy"].replace(b"(48,)", b"(9e9,"), "not an NPY file of plain numbers"),
        ("a.npy", WHOLE["x.npy"].replace(b"(48,)", b"(99,)"), "shape (99,) and type float64 needs 792 bytes, 384 are"),
        ("a.npy", WHOLE["x.npy"].replace(b"'<f8'", b"'<f9'"), "not an NPY file of plain numbers"),
        ("a.mat", changed(WHOLE["v5.mat"], 132, "<I", 2**31), "byte 128: 2147483648 bytes are announced"),
        ("a.mat", WHOLE["v5.mat"][:-3], "the file is damaged"),
        ("a.mat", HEAD + element(15, zlib.compress(b"")), "byte 128: unpacks to nothing"),
        ("a.mat", HEAD + element(14, element(6, struct.pack("<II", 6, 0))), "byte 128: no dimensions or no name"),
        ("a.mat", HEAD + of_level_5(6, shape=()), "byte 128: the dimensions () are none"),
        ("a.mat", HEAD + of_level_5(6, shape=(-1, 4)), "byte 128: the dimensions (-1, 4) are none"),
        ("a.mat", HEAD + of_level_5(6, shape=(4, 1)), "byte 128: u has no numbers"),
        ("a.mat", HEAD + of_level_5(2), "byte 128: structure u has no field names"),
        ("a.mat", HEAD + of_level_5(2, WIDTH_4, element(1, b"")[:-1] + b"\1"), "the file is damaged"),
        (
            "a.mat",
            HEAD + of_level_5(2, WIDTH_4, element(1, b"a\0\0\0")),
            "has 0 fields and names of 4 bytes in steps of 4",
        ),
        ("a.mat", HEAD + of_level_5(2, WIDTH_4, element(1, b"a\0\0\0"), element(9, bytes(8))), "field a has type 9"),
        ("a.mat", HEAD + nested(level5.DEEPEST + 2), "nested deeper than"),
        ("a.mat", WHOLE["v4.mat"] + WHOLE["v4.mat"][:10], "the file ends within the head of a matrix"),
        ("a.npy", WHOLE["stored.npz"], "a.npy is not an NPY file but an archive; name it .npz"),
        ("a.wav", WAV[:16] + struct.pack("<I", 12) + WAV[20:32] + WAV[36:], "the format has 12 bytes, fewer than 16"),
        ("a.wav", WAV[:40] + struct.pack("<I", 0), "it holds no samples"),
        ("a.csv", b't,u\n0,1\n1,2\n2,"3\n4"\n', "a quoted cell that runs over several lines"),
        ("a.mat", changed(WHOLE["v4.mat"], 4, "<i", 2**30), "byte 0: a matrix of 1073741824 x 48 ends at byte"),
    ],
)
def test_the_place_of_the_damage_is_named(name: str, content: bytes, said: str) -> None:
    suffix = name[-4:]
    with pytest.raises(InputError) as caught:
        columns_of_file(content, suffix, name)
    assert said in str(caught.value)


def test_what_is_beside_the_numbers_is_passed_over() -> None:
    """An object of a newer kind, text and complex numbers in old files; NPY headers of version 2."""
    objects = HEAD + of_level_5(17, name=b"o") + WHOLE["v5.mat"][128:]
    assert from_mat(objects, "a.mat").names == from_mat(WHOLE["v5.mat"], "a.mat").names
    stream = io.BytesIO()
    savemat(stream, {"t": TIME, "word": "text", "z": U + 2j * U, "u": U}, format="4")
    read = from_mat(stream.getvalue(), "a.mat")
    assert [name for name in read.names if name in ("t", "u")] == ["t", "u"]
    assert np.array_equal(read.values(read.names.index("u")), U)
    (complex_one,) = (stored for stored in level4.matrices(stream.getvalue(), "a.mat") if stored.name == "z")
    assert np.array_equal(np.ravel(complex_one.load()), U + 2j * U)
    newer = io.BytesIO()
    np.lib.format.write_array(newer, U, version=(2, 0))
    assert np.array_equal(columns_of_file(newer.getvalue(), ".npy", "a.npy").values(0), U)


NUMBERS = st.sampled_from(["f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "?", "c16"])


@settings(deadline=None, max_examples=80)
@given(
    st.dictionaries(
        st.text("abcxyz_", min_size=1, max_size=9).filter(lambda name: name[0] != "_"),
        arrays.arrays(NUMBERS, st.tuples(st.integers(2, 9), st.integers(1, 3))),
        min_size=1,
        max_size=4,
    ),
    st.booleans(),
)
def test_every_number_is_that_of_an_independent_reader(content: dict[str, np.ndarray], packed: bool) -> None:
    stream = io.BytesIO()
    savemat(stream, {**content, "deep": content}, do_compression=packed)
    other = loadmat(io.BytesIO(stream.getvalue()), simplify_cells=True)
    real = {name: value for name, value in content.items() if value.dtype.kind != "c"}
    if not real:
        return
    columns = from_mat(stream.getvalue(), "run.mat")
    found = {name: columns.values(index) for index, name in enumerate(columns.names)}
    for name in real:
        for place, expected in ((name, other[name]), (f"deep.{name}", other["deep"][name])):
            lanes = [found[key] for key in found if key == place or key.startswith(f"{place}[")]
            flat = np.asarray(expected, dtype=np.float64)
            if flat.ndim == 2 and flat.shape[0] < flat.shape[1]:
                flat = flat.T
            assert np.array_equal(np.stack(lanes, axis=1).ravel(), flat.ravel(), equal_nan=True)


def test_bytes_in_the_other_order_are_read() -> None:
    """One matrix of level 5 and one of level 4, written here from the description of the format, largest byte first."""

    def element(kind: int, payload: bytes) -> bytes:
        return struct.pack(">II", kind, len(payload)) + payload + b"\0" * (-len(payload) % 8)

    parts = (element(6, struct.pack(">II", 6, 0)), element(5, struct.pack(">ii", 48, 1)), element(1, b"u"))
    body = b"".join((*parts, element(9, U.astype(">f8").tobytes())))
    level5 = b"MATLAB 5.0".ljust(124) + b"\x01\x00MI" + element(14, body)
    level4 = struct.pack(">iiiii", 1000, 48, 1, 0, 2) + b"u\0" + U.astype(">f8").tobytes()
    for content in (level5, level4):
        columns = from_mat(content, "run.mat")
        assert columns.names == ("u",)
        assert np.array_equal(columns.values(0), U)


def test_a_bomb_is_refused_before_it_is_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(level5, "FILE_BUDGET", 1_000_000)
    packed = zlib.compress(bytes(1_200_000), 9)
    whole = WHOLE["v5.mat"][:128] + struct.pack("<II", 15, len(packed)) + packed
    with pytest.raises(InputError, match="unpacks to more than 1 MB"):
        from_mat(whole, "run.mat")
