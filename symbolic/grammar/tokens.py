"""Text to tokens: ASCII only, every length bounded, every complaint with its column (counted from 1)."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal

from ridgeback.common.errors import InputError

MAX_LENGTH: Final = 2000
MAX_DIGITS: Final = 60
MAX_DECIMAL_EXPONENT: Final = 100
MAX_NAME: Final = 40
MAX_PRIMES: Final = 2

Kind = Literal["number", "name", "operator", "end"]

_NUMBER: Final = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_TOKEN: Final = re.compile(
    rf"(?P<number>{_NUMBER})"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)(?P<primes>'*)"
    r"|(?P<operator>\*\*|[-+*/^()=,])"
)
_SIGNED: Final = re.compile(rf"[+-]?{_NUMBER}")

# Characters that look like, or are meant as, something that can be typed.  Fullwidth forms, superscripts and
# ligatures are found by compatibility normalisation instead.
_MEANT: Final = {
    **dict.fromkeys("−–—‐‑﹣", "-"),
    **dict.fromkeys("×·⋅∙∗", "*"),
    **dict.fromkeys("÷∕⁄", "/"),
    **dict.fromkeys("’‘′ʹʼ`´", "'"),
    **dict.fromkeys('″”“"ʺ', "''"),
    **dict.fromkeys("²", "**2"),
    **dict.fromkeys("³", "**3"),
    **dict.fromkeys("√", "sqrt(...)"),
    **dict.fromkeys("[{", "("),
    **dict.fromkeys("]}", ")"),
    **dict(zip("аеорсухівАВЕКМНОРСТХ", "aeopcyxibABEKMHOPCTX", strict=True)),
}
_GREEK: Final = {"LAMDA": "lambda", "EPSILON": "eps"}


@dataclass(frozen=True, slots=True)
class Token:
    """One lexical unit; ``column`` counts from 1 and ``primes`` counts the derivatives marked on a name."""

    kind: Kind
    text: str
    column: int
    primes: int = 0


def quoted(text: str, limit: int = 40) -> str:
    r"""The text as it may stand in a one-line message: escaped, and cut in the middle when long.

    >>> quoted("u''\n")
    '"u\'\'\\n"'
    """
    shown = text if len(text) <= limit else text[: limit - 13] + "..." + text[-10:]
    return repr(shown)


def tokenize(text: str) -> tuple[Token, ...]:
    """Split text into tokens, the last of which has the kind ``end``.

    Raises InputError for text that is empty or over ``MAX_LENGTH``, for characters outside the grammar and for
    numbers, names and primes beyond their bounds.

    >>> [token.text for token in tokenize("2*u'' ^ .5")]
    ['2', '*', 'u', '^', '.5', '']
    """
    if not isinstance(text, str):
        raise InputError(f"the expression is {type(text).__name__}, not text; give something like u'' + u = 0")
    if len(text) > MAX_LENGTH:
        raise InputError(f"the expression has {len(text)} characters; at most {MAX_LENGTH} are read")
    if not text.strip(" \t\r\n"):
        raise InputError(f"the expression {quoted(text)} is empty; give something like u'' + sin(u) = 0")
    return (*_tokens(text), Token("end", "", len(text.rstrip()) + 1))


def _tokens(text: str) -> list[Token]:
    found: list[Token] = []
    position = 0
    while position < len(text):
        if text[position] in " \t\r\n":
            position += 1
            continue
        match = _TOKEN.match(text, position)
        if match is None:
            raise _bad_character(text, position)
        found.append(_token(match))
        position = match.end()
    return found


def _token(match: re.Match[str]) -> Token:
    column = match.start() + 1
    if (number := match["number"]) is not None:
        _check_number(number, f"at column {column}")
        return Token("number", number, column)
    if (name := match["name"]) is not None:
        primes = len(match["primes"])
        _check_name(name, primes, column)
        return Token("name", name, column, primes)
    return Token("operator", match["operator"], column)


def _check_name(name: str, primes: int, column: int) -> None:
    if len(name) > MAX_NAME:
        raise InputError(
            f"the name {quoted(name)} at column {column} has {len(name)} characters; at most {MAX_NAME} are read"
        )
    if primes > MAX_PRIMES:
        raise InputError(
            f"{quoted(name + chr(39) * min(primes, 5))} at column {column} is a derivative of order {primes}; "
            f"only {name}' and {name}'' are known"
        )


def _check_number(number: str, where: str) -> None:
    mantissa, _, exponent = number.lower().partition("e")
    if len(mantissa) > MAX_DIGITS:
        raise InputError(
            f"the number {quoted(number)} {where} has {len(mantissa)} digits; at most {MAX_DIGITS} are read"
        )
    if len(exponent) > 20 or (exponent and abs(int(exponent)) > MAX_DECIMAL_EXPONENT):
        raise InputError(
            f"the number {quoted(number)} {where} has a decimal exponent beyond {MAX_DECIMAL_EXPONENT}; "
            "choose units in which it is smaller"
        )


def _bad_character(text: str, position: int) -> InputError:
    character, column = text[position], position + 1
    if character == "'":
        return InputError(
            f"the prime at column {column} follows no name; write the derivative as u' with no space before the prime"
        )
    name = unicodedata.name(character, "no name")
    advice = _advice(character)
    return InputError(
        f"the character {quoted(character)} (U+{ord(character):04X}, {name}) at column {column} is not read; {advice}"
    )


def _advice(character: str) -> str:
    greek = unicodedata.name(character, "").removeprefix("GREEK SMALL LETTER ")
    if greek.isalpha() and "GREEK" in unicodedata.name(character):
        return f"write {_GREEK.get(greek, greek.lower())}"
    meant = _MEANT.get(character) or unicodedata.normalize("NFKC", character)
    if meant != character and meant.isascii() and meant.isprintable() and meant.strip():
        return f"type {meant} from the ASCII keyboard"
    return "names, numbers, + - * / ** ^ ( ) = and ' are"


def number_value(text: str) -> Fraction:
    """The exact value of an unsigned decimal literal whose bounds ``tokenize`` has checked.

    >>> number_value("2.50e-1")
    Fraction(1, 4)
    """
    return Fraction(text)


def parse_number(text: str) -> Fraction:
    """Return the exact rational that a command-line value stands for: ``3``, ``-0.01``, ``1e-3`` or ``7/12``.

    Parameters
    ----------
    text : str
        A decimal means exactly what it says (0.1 is 1/10).

    Returns
    -------
    Fraction
        The number.

    Raises
    ------
    InputError
        For anything else, nan and inf included, and for more digits or larger exponents than ``MAX_DIGITS`` and
        ``MAX_DECIMAL_EXPONENT``.

    Examples
    --------
    >>> parse_number("-2.5e-1"), parse_number("7/12")
    (Fraction(-1, 4), Fraction(7, 12))
    """
    if not isinstance(text, str) or len(text) > MAX_LENGTH:
        raise InputError(f"a number cannot be {quoted(str(text))}; give an integer, a decimal or a fraction a/b")
    parts = [part.strip(" \t") for part in text.split("/")]
    if len(parts) > 2 or not all(_SIGNED.fullmatch(part) for part in parts):
        raise InputError(f"{quoted(text)} is not a finite number; give an integer, a decimal or a fraction a/b")
    for part in parts:
        _check_number(part.lstrip("+-"), "is too long:")
    numerator, *denominator = (Fraction(part) for part in parts)
    if not denominator:
        return numerator
    if denominator[0] == 0:
        raise InputError(f"{quoted(text)} divides by zero; give a fraction with another denominator")
    return numerator / denominator[0]
