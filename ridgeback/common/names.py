"""Names that a caller may spell with hyphens or underscores, in capitals or not."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from ridgeback.common.errors import InputError


def plain(name: str) -> str:
    """A name without what makes no difference.

    >>> plain("Pseudo_Wigner")
    'pseudo-wigner'
    """
    return name.strip().replace("_", "-").casefold()


def chosen(name: str, known: Sequence[str], what: str) -> str:
    """The one of the known names that is meant; InputError lists them and suggests the nearest.

    >>> chosen("energy_integral", ("lindstedt", "energy-integral"), "method")
    'energy-integral'
    >>> chosen("lindsted", ("lindstedt", "direct"), "method")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: method 'lindsted' is unknown; did you mean lindstedt? (lindstedt, direct)
    """
    by_plain = {plain(one): one for one in known}
    found = by_plain.get(plain(name)) if isinstance(name, str) else None
    if found is not None:
        return found
    close = difflib.get_close_matches(plain(str(name)[:60]), list(by_plain), 1, 0.6)
    if close:
        raise InputError(f"{what} {name!r} is unknown; did you mean {by_plain[close[0]]}? ({', '.join(known)})")
    raise InputError(f"{what} {str(name)[:60]!r} is unknown; use one of {', '.join(known)}")
