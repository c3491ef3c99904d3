"""Which alphabet the bytes of a text are in."""

from __future__ import annotations

import codecs

from ridgeback.common.errors import InputError

LOOKED_AT = 4096
"""Bytes at the beginning that tell text from something else."""
CONTROL = bytes(code for code in range(32) if code not in b"\t\n\r\f\v\x1a\x1b\x1c\x1d\x1e")
"""Bytes that no text in an alphabet of one byte holds."""


def decoded(data: bytes, source: str) -> tuple[str, str]:
    r"""Text in UTF-8 or UTF-16, else in Windows' or ISO's Latin alphabet, and a note where that was supposed.

    Raises InputError for bytes that are no text.

    >>> decoded("t;u".encode("utf-16"), "run.csv"), decoded(b"\xb5m", "run.csv")[0]
    (('t;u', ''), 'µm')
    >>> decoded(b"t;u" + bytes(9), "run.csv")
    ('t;u', '9 bytes of 0 at the end were left out.')
    """
    if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        return readable(data, "utf-16", source), ""
    if data[1:2] == b"\0" or data[:1] == b"\0":
        return readable(data, "utf-16-le" if data[1:2] == b"\0" else "utf-16-be", source), ""
    body = data.rstrip(b"\0")  # which a logger fills its last block with
    if body[:LOOKED_AT].translate(None, CONTROL) != body[:LOOKED_AT]:
        raise no_text(source)
    if b"\0" in body:
        at = body.index(b"\0")
        raise InputError(f"{source}: byte {at} is 0, which no text holds: the file is damaged; cut it before that byte")
    unfilled = f"{len(data) - len(body)} bytes of 0 at the end were left out." if len(body) < len(data) else ""
    try:
        return body.decode("utf-8-sig"), unfilled
    except UnicodeDecodeError:
        latin = "The text is not UTF-8; it was read in the Latin alphabet of Windows-1252."
        return body.decode("cp1252", "replace"), f"{latin} {unfilled}".strip()


def readable(data: bytes, encoding: str, source: str) -> str:
    """Text in a known encoding; InputError for what is none."""
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        raise no_text(source) from None
    if any(chr(code) in text[:LOOKED_AT] for code in CONTROL):
        raise no_text(source)
    return text


def no_text(source: str) -> InputError:
    """The error for bytes that are no text."""
    return InputError(f"{source} holds no text but binary data; give it the suffix of its format, or export a table")
