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
    """
    if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        return readable(data, "utf-16", source), ""
    if data[1:2] == b"\0" or data[:1] == b"\0":
        return readable(data, "utf-16-le" if data[1:2] == b"\0" else "utf-16-be", source), ""
    if data[:LOOKED_AT].translate(None, CONTROL) != data[:LOOKED_AT]:
        raise no_text(source)
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError as error:
        if b"\0" in data[:10_000]:
            raise InputError(f"{source}: byte {error.start} is not UTF-8 text; save the table as UTF-8") from None
    return data.decode("cp1252", "replace"), "The text is not UTF-8; it was read in the Latin alphabet of Windows-1252."


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
