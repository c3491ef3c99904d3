"""Which languages there are: ours, and those that other distributions add by entry points."""

from __future__ import annotations

from contextlib import suppress
from functools import cache

from ridgeback.common.errors import InputError
from ridgeback.common.plugins import loaded, plugins
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
    """All languages by their names; ours cannot be replaced, and a plugin that cannot be loaded is left out."""
    found = {language.name: language for language in OURS}
    for point in plugins(GROUP, found).values():
        with suppress(InputError):
            found[point.name] = loaded(point, Language)  # type: ignore[type-abstract]
    return found


def find_language(name: str) -> Language:
    """The language of this name; raises InputError for one without a writer.

    >>> find_language("c").suffix
    'c'
    """
    known = languages()
    if name not in known and (point := plugins(GROUP).get(name)) is not None:
        return loaded(point, Language)  # type: ignore[type-abstract]  # says what is wrong with it
    if name not in known:
        raise InputError(f"no code is generated for {name[:60]!r}; the languages are {', '.join(known)}")
    return known[name]
