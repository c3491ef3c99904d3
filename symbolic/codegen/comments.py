"""Text inside comments and documentation: only characters that mean nothing in any target language."""

from __future__ import annotations

import re
from typing import Final

_SPELLED: Final = {"**": "^", "*": " "}
_OPERATOR: Final = re.compile(r"\*\*|\*|/(?=/)")
_UNSAFE: Final = re.compile(r"[^A-Za-z0-9 .,;:+=()\[\]<>^_'|&/-]")


def comment_text(text: str) -> str:
    r"""Text on one line that cannot end the comment or docstring it stands in, whatever the language.

    A product is written with a space, a power with ^; every other character that is not in a small set of letters,
    digits and marks becomes a full stop.  No ``*``, ``//``, ``?``, ``\\``, quotation mark, line end, trigraph or
    direction mark is left; a single ``/`` means nothing without them.

    >>> comment_text("u'' + 2*mu*u' + u**3/6 = 0"), comment_text("a *" + chr(92) + " int x;" + chr(0x2028))
    ("u'' + 2 mu u' + u^3/6 = 0", 'a . int x;')
    """
    spelled = _OPERATOR.sub(lambda found: _SPELLED.get(found[0], "/ "), " ".join(text.split()))
    quoted = re.sub(r"'{3,}", "''", spelled)
    return " ".join(_UNSAFE.sub(".", quoted).split())
