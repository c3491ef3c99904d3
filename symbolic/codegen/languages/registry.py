"""Which languages there are: ours, and those that other distributions add by entry points."""

from __future__ import annotations

from functools import cache
from importlib.metadata import entry_points

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.languages import (
    array_api,
    c,
    cpp,
    fortran,
    javascript,
    julia,
    latex,
    matlab,
    numba,
    python,
    rust,
)
from ridgeback.symbolic.codegen.languages.language import Language

GROUP = "ridgeback.languages"
OURS: tuple[Language, ...] = (
    python.language,
    array_api.language,
    numba.language,
    c.language,
    c.header,
    cpp.language,
    rust.language,
    julia.language,
    fortran.language,
    matlab.language,
    javascript.language,
    latex.language,
)


@cache
def languages() -> dict[str, Language]:
    """All languages by their names; ours cannot be replaced."""
    found = {language.name: language for language in OURS}
    for point in entry_points(group=GROUP):
        added = point.load()
        if isinstance(added, Language):
            found.setdefault(added.name, added)
    return found


def find_language(name: str) -> Language:
    """The language of this name; raises InputError for one without a writer.

    >>> find_language("c").suffix
    'c'
    """
    known = languages()
    if name not in known:
        raise InputError(f"no code is generated for {name[:60]!r}; the languages are {', '.join(known)}")
    return known[name]
