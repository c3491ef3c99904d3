"""Names of arguments that are legal and free in every target language."""

from __future__ import annotations

import keyword
import re
from typing import Final

_C: Final = frozenset(
    {
        "auto",
        "break",
        "case",
        "char",
        "const",
        "continue",
        "default",
        "do",
        "double",
        "else",
        "enum",
        "extern",
        "float",
        "for",
        "goto",
        "if",
        "inline",
        "int",
        "long",
        "register",
        "restrict",
        "return",
        "short",
        "signed",
        "sizeof",
        "static",
        "struct",
        "switch",
        "typedef",
        "union",
        "unsigned",
        "void",
        "volatile",
        "while",
        "main",
    }
)
_OWN: Final = frozenset(
    {"k", "omega0", "omega0_slope", "amplitude", "damping", "math", "quotient", "k_inverse", "a"}
) | {
    *("scaled", "rest", "root", "fall", "rise", "inner", "moved", "distance", "vanishing", "grown"),
    *("sqrt", "cos", "A"),
}
# Constants (C4, W2_1), Horner's intermediate results (y, y1_2, z) and what is computed from an argument.
_MADE: Final = re.compile(r"[A-Z]\d+(_\d+)*|[yzwk]\d*(_\d+)*|.*_(squared|(by|times)_k(_\d+)?)|__.*")


def argument_name(name: str) -> str:
    """A parameter's name as an argument's; one that means something else in the code gets an underscore.

    >>> [argument_name(name) for name in ("mu", "lambda", "double", "y", "C4")]
    ['mu', 'lambda_', 'double_', 'y_', 'C4_']
    """
    taken = keyword.iskeyword(name) or name in _C or name in _OWN or _MADE.fullmatch(name)
    return f"{name}_" if taken else name


def variable_name(name: str) -> str:
    """The same for the variable of a series: the amplitude A, or the small parameter of a limit cycle.

    >>> variable_name("A"), variable_name("eps"), variable_name("lambda")
    ('A', 'eps', 'lambda_')
    """
    return name if name == "A" else argument_name(name)
