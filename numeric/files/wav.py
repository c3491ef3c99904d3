"""The channels of a WAV file, its chunks held against the bytes that there are."""

from __future__ import annotations

import io
import struct
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.files.columns import DAMAGE, Columns, first_line
from ridgeback.numeric.late import wavfile

ORDERS = {b"RIFF": "<", b"RF64": "<", b"RIFX": ">"}
MOST_BITS = 64
MOST_CHANNELS = 4096


def from_wav(data: bytes, source: str) -> Columns:
    """The channels of a WAV file; integers are divided by full scale.

    Raises InputError with the place of the damage.
    """
    check_format(data, source)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # chunks beside the samples
            rate, samples = wavfile.read(io.BytesIO(data))
    except DAMAGE as error:
        raise InputError(f"{source} is not a readable WAV file: {first_line(error)}") from None
    if samples.size == 0:
        raise InputError(f"{source} is not a readable WAV file: it holds no samples")
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


# WAVE: "fmt " holds format, channels (u2 each), rate, bytes per second (u4 each), bytes per frame, bits (u2 each).
def check_format(data: bytes, source: str) -> None:
    """Refuse a file without a format or samples, and a format that no samples can have."""
    order = ORDERS.get(data[:4])
    if order is None or data[8:12] != b"WAVE":
        raise InputError(f"{source} is not a readable WAV file: it does not begin with RIFF and WAVE")
    found = dict(reversed(list(chunks(data, order))))
    for name, what in ((b"fmt ", "format"), (b"data", "samples")):
        if name not in found:
            raise InputError(f"{source} is not a readable WAV file: it has no chunk '{name.decode()}' with its {what}")
    begin, length = found[b"fmt "]
    if length < 16 or begin + 16 > len(data):
        raise InputError(f"{source}, byte {begin}: the format has {length} bytes, fewer than 16; the file is damaged")
    _, channels, rate, _, frame, bits = struct.unpack(f"{order}HHIIHH", data[begin : begin + 16])
    for value, at, what, least, most in (
        (channels, 2, "channels", 1, MOST_CHANNELS),
        (rate, 4, "samples per second", 1, 2**32),
        (bits, 14, "bits a sample", 1, MOST_BITS),
        (frame, 12, "bytes a frame", channels * -(-bits // 8), channels * -(-bits // 8)),
    ):
        if not least <= value <= most:
            wanted = f"{least}" if least == most else f"{least} to {most}"
            raise InputError(f"{source}, byte {begin + at}: {value} {what}, not {wanted}; the file is damaged")


def chunks(data: bytes, order: str) -> Iterator[tuple[bytes, tuple[int, int]]]:
    """Name, first byte and length of every chunk, as far as they can be followed."""
    at = 12
    while at + 8 <= len(data):
        name, length = struct.unpack(f"{order}4sI", data[at : at + 8])
        yield name, (at + 8, length)
        at += 8 + length + length % 2


# An unsigned 8-bit sample is centred on 128; scipy hands 24-bit samples over in the high bytes of 32.
def full_scale(samples: NDArray[np.generic]) -> tuple[Array, str]:
    """Integer samples as shares of full scale, -1 .. 1, and the sentence that says so; floats as they are.

    >>> full_scale(np.array([-32768, 16384], dtype=np.int16))[0].tolist()
    [-1.0, 0.5]
    """
    with np.errstate(invalid="ignore"):  # damaged numbers, which are none in the result either
        numbers: NDArray[Any] = samples.astype(np.float64)
    if samples.dtype.kind == "f":
        return numbers, ""
    bits = 8 * samples.dtype.itemsize
    middle = 2.0 ** (bits - 1) if samples.dtype.kind == "u" else 0.0
    return (numbers - middle) / 2.0 ** (bits - 1), f"{bits}-bit integer samples were divided by full scale"
