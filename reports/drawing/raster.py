"""A time-frequency plane as a small grey PNG, used on the page as a mask through which the ink colour shows."""

from __future__ import annotations

import base64
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from ridgeback.numeric.arrays import Array

LEVELS = 48
STEPS = 32
"""Grey steps of a mask: finer ones are not seen and cost bytes."""
MAX_ROWS, MAX_COLUMNS = 320, 480


def shrink(values: Array, rows: int, columns: int) -> Array:
    """Reduce a plane by the maximum over blocks, so that a thin ridge is never lost.

    >>> shrink(np.array([[1.0, 2.0], [3.0, 4.0]]), 1, 2).tolist()
    [[3.0, 4.0]]
    """
    for axis, most in ((0, rows), (1, columns)):
        size = values.shape[axis]
        if size > most:
            starts = np.unique(np.arange(most) * size // most)
            values = np.maximum.reduceat(values, starts, axis=axis)
    return values


def grey(level_db: Array, floor_db: float) -> NDArray[np.uint8]:
    """Map levels from ``floor_db`` (0) to 0 dB (255) onto a few grey steps; what is not finite is floor.

    >>> grey(np.array([[0.0, -60.0, np.nan]]), -60.0).tolist()
    [[255, 0, 0]]
    """
    level = np.nan_to_num(level_db, nan=floor_db, neginf=floor_db, posinf=0.0)
    share = np.clip((level - floor_db) / -floor_db, 0.0, 1.0)
    return np.rint(np.rint(share * (LEVELS - 1)) * (255 / (LEVELS - 1))).astype(np.uint8)


def png(pixels: NDArray[np.uint8]) -> bytes:
    r"""Encode an 8-bit grey image, first row on top (PNG specification, colour type 0).

    >>> png(np.zeros((1, 1), dtype=np.uint8))[:8]
    b'\x89PNG\r\n\x1a\n'
    """
    height, width = pixels.shape
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    rows = b"".join(b"\x00" + row.tobytes() for row in np.ascontiguousarray(pixels))
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, body) for kind, body in chunks)


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def mask_uri(share: Array, *, rows: int = MAX_ROWS, columns: int = MAX_COLUMNS) -> str:
    """Return the ``data:`` URI of shares 0 .. 1, ``[frequency, time]``, as a mask: white shows the ink.

    >>> mask_uri(np.zeros((2, 2)))[:22]
    'data:image/png;base64,'
    """
    small = shrink(np.nan_to_num(np.asarray(share, dtype=np.float64)), rows, columns)
    pixels = np.rint(np.rint(np.clip(small, 0.0, 1.0) * (STEPS - 1)) * (255 / (STEPS - 1))).astype(np.uint8)
    return "data:image/png;base64," + base64.b64encode(png(pixels[::-1])).decode("ascii")
