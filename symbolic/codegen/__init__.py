"""Source code from a series, a slow flow or a resummation: one coefficient form, one file per target language.

Knows finished formulas; text from users reaches the source only through a whitelist of characters.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen import c99, python
from ridgeback.symbolic.codegen.build import expansion_form, slow_flow_form
from ridgeback.symbolic.codegen.form import Form
from ridgeback.symbolic.codegen.resummations import resummation_form
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.resummation.resummation import Resummation

# A further language is a function from the form to its text, and a line here.
WRITERS: dict[str, Callable[[Form], str]] = {
    "python": python.write,
    "c": c99.write,
    "c-header": c99.write_header,
}

LANGUAGES = tuple(WRITERS)


def generate(
    result: Expansion | SlowFlow | Resummation,
    language: str = "python",
    *,
    equation: str = "",
    limit: float | None = None,
    up_to: Fraction | None = None,
    more: tuple[str, ...] = (),
) -> str:
    r"""Source text of an expansion (omega0 and its slope), a slow flow (omega0 and damping) or a resummation (omega0).

    Angular frequency in rad per time unit.  ``equation``, ``limit`` (the amplitude at which the oscillation ends) and
    ``more`` lines go into the documentation, with a proved bound of the rounding error; ``up_to`` is the end of the
    range of a resummation.  Raises InputError for a language without a writer, for a coefficient that has no double,
    and for a resummation that is no quotient of polynomials.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
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
    return WRITERS[language](form_of(result, equation=equation, limit=limit, up_to=up_to, more=more))


def form_of(
    result: Expansion | SlowFlow | Resummation,
    *,
    equation: str = "",
    limit: float | None = None,
    up_to: Fraction | None = None,
    more: tuple[str, ...] = (),
) -> Form:
    """The coefficient form of any of them; a resummation without ``up_to`` is bounded for values up to 1."""
    if isinstance(result, Resummation):
        return resummation_form(result, up_to=up_to or Fraction(1), equation=equation, limit=limit, more=more)
    build = slow_flow_form if isinstance(result, SlowFlow) else expansion_form
    form = build(result, equation=equation, limit=limit)  # type: ignore[arg-type]
    return replace(form, facts=(*form.facts, *more))
