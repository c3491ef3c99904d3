"""Generated numeric code: one coefficient form, one file per target language."""

from __future__ import annotations

from collections.abc import Callable

from symbolic.codegen import c99, python
from symbolic.codegen.build import expansion_form, slow_flow_form
from symbolic.codegen.form import Form
from symbolic.errors import InputError
from symbolic.expansion import Expansion
from symbolic.slow_flow import SlowFlow

# A further language is a function from the form to its text, and a line here.
WRITERS: dict[str, Callable[[Form], str]] = {
    "python": python.write,
    "c": c99.write,
    "c-header": c99.write_header,
}

LANGUAGES = tuple(WRITERS)


def generate(
    result: Expansion | SlowFlow, language: str = "python", *, equation: str = "", limit: float | None = None
) -> str:
    r"""Source text that evaluates an expansion (omega0 and its slope) or a slow flow (omega0 and damping).

    Angular frequency in rad per time unit.  ``equation`` and ``limit`` (the amplitude at which the oscillation
    ends) go into the documentation.  Raises InputError for a language without a writer and for a coefficient that
    has no double.

    >>> from symbolic.lindstedt import lindstedt
    >>> from symbolic.systems import find
    >>> print(generate(lindstedt(find("pendulum"), 4)).split("\n\n\n")[2])
    def omega0(A, k=1.0):
        ...
        A_squared = A*A
        y = C4
        y = A_squared*y + C2
        y = A_squared*y + C0
        return k*y
    """
    if language not in WRITERS:
        raise InputError(f"no code is generated for '{language}'; the languages are {', '.join(WRITERS)}")
    return WRITERS[language](form_of(result, equation=equation, limit=limit))


def form_of(result: Expansion | SlowFlow, *, equation: str = "", limit: float | None = None) -> Form:
    """The coefficient form of either result."""
    if isinstance(result, SlowFlow):
        return slow_flow_form(result, equation=equation, limit=limit)
    return expansion_form(result, equation=equation, limit=limit)
