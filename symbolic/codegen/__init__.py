"""Source code from a series, a slow flow or a resummation: one coefficient form, one file per target language.

Knows finished formulas; text from users reaches the source only through a whitelist of characters.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from fractions import Fraction
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import TypeAlias

from ridgeback.common.errors import InputError
from ridgeback.symbolic.codegen.fit.fit import Fit
from ridgeback.symbolic.codegen.formulas.closed_forms import MeanForm, SineSeries
from ridgeback.symbolic.codegen.formulas.flows import slow_flow_form
from ridgeback.symbolic.codegen.formulas.powers import loss_form, power_form
from ridgeback.symbolic.codegen.formulas.resummations import resummation_form
from ridgeback.symbolic.codegen.formulas.series import expansion_form
from ridgeback.symbolic.codegen.formulas.symbolic_mean import SymbolicMean
from ridgeback.symbolic.codegen.languages.registry import find_language, languages
from ridgeback.symbolic.codegen.modes.mode import in_mode
from ridgeback.symbolic.codegen.naming import checked_identifier, identifier
from ridgeback.symbolic.codegen.number import REALS
from ridgeback.symbolic.codegen.program import MODES, Form, Mode
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.flow.loss_flow import LossFlow
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.resummation.resummation import Resummation

__all__ = ["LANGUAGES", "Formula", "form_of", "generate", "packaged", "written"]

Formula: TypeAlias = "Expansion | PowerExpansion | SlowFlow | LossFlow | Resummation | Closed | Fit"
Closed: TypeAlias = "MeanForm | SymbolicMean | SineSeries"
LANGUAGES = tuple(languages())
DIGEST = 16
"""Hexadecimal digits of the input's hash that are printed."""


def generate(
    result: Formula,
    language: str = "python",
    *,
    equation: str = "",
    limit: float | None = None,
    up_to: Fraction | None = None,
    more: tuple[str, ...] = (),
    name: str = "",
    mode: Mode = "strict",
    real: str = "float64",
    motion: bool = False,
) -> str:
    r"""Source text of an expansion (omega0 and its slope), a slow flow (omega0, growth_rate) or a resummation.

    Parameters
    ----------
    result
        What is written; angular frequencies in rad per time unit.
    language
        A target language; see ``LANGUAGES``.
    equation, limit, more
        For the documentation: the equation, the amplitude at which the oscillation ends, further lines.
    up_to
        The end of the domain, beyond which the functions return a number that is none; ``limit`` where it is not given.
    name
        Identifier in front of, or around, all that is generated; by default the system's name.
    mode
        ``strict``: the same bits in every language.  ``fma``: a*b + c in one rounding.  ``accurate``: the last steps
        carry their rounding errors along.
    real
        ``float64`` or, in C and Rust, ``float32``.
    motion
        Whether the motion u(t) and its harmonics are generated as well.

    Raises
    ------
    InputError
        For a language without a writer, a coefficient that has no number in the format, and a formula for which no
        code is written.

    Examples
    --------
    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> print(generate(lindstedt(find("pendulum"), 4)).split("\n\n\n")[3])
    def omega0_unchecked(A, k=1.0):
        ...
        A_squared = A*A
        y = 0.0003255208333333333*A_squared; y -= 0.0625  # 1/3072, -1/16
        y *= A_squared; y += 1.0
        result = k*y
        return result
    """
    form = form_of(
        result, equation=equation, limit=limit, up_to=up_to, more=more, name=name, mode=mode, real=real, motion=motion
    )
    return written(form, language)


def written(form: Form, language: str) -> str:
    """A form as source text; raises InputError for what the language does not have."""
    target = find_language(language)
    target.accept(form)
    return trimmed(target.write(form))


def packaged(form: Form, language: str) -> dict[str, str]:
    """A form as the files of a small package by their paths; errors as for ``written``."""
    target = find_language(language)
    target.accept(form)
    return {path: trimmed(text) for path, text in target.package(form).items()}


def trimmed(text: str) -> str:
    r"""Text whose lines do not end in blanks.

    >>> trimmed("// \nint i;  \n")
    '//\nint i;\n'
    """
    return "\n".join(map(str.rstrip, text.split("\n")))


def form_of(
    result: Formula,
    *,
    equation: str = "",
    limit: float | None = None,
    up_to: Fraction | None = None,
    more: tuple[str, ...] = (),
    name: str = "",
    mode: Mode = "strict",
    real: str = "float64",
    motion: bool = False,
    alone: str = "",
) -> Form:
    """The coefficient form of any of them, with what is proved about it; see ``generate``.

    With ``alone`` it has the function of this name and no other.
    """
    if mode not in MODES:
        raise InputError(f"mode {mode!r} is not known; use {', '.join(MODES)}")
    if real not in REALS:
        raise InputError(f"numbers of kind {real!r} are not known; use {' or '.join(REALS)}")
    request = CodeRequest(
        equation=equation,
        limit=limit,
        up_to=up_to,
        more=more,
        name=name,
        mode=mode,
        real=REALS[real],
        motion=motion,
    )
    form = _built(result, request)
    wanted = form.functions if not alone else tuple(f for f in form.functions if f.name == alone)
    return finished(replace(form, functions=wanted), request)


def _built(result: Formula, request: CodeRequest) -> Form:
    if isinstance(result, MeanForm | SymbolicMean | SineSeries | Fit):
        return result.form(request)
    if isinstance(result, Resummation):
        return resummation_form(result, request)
    if isinstance(result, PowerExpansion):
        return power_form(result, request)
    if isinstance(result, LossFlow):
        return loss_form(result, request)
    return slow_flow_form(result, request) if isinstance(result, SlowFlow) else expansion_form(result, request)


def finished(form: Form, request: CodeRequest) -> Form:
    """A form under its name and in its mode, with its proofs, the version and the hash of all that went into it."""
    name = checked_identifier(request.name) if request.name else identifier(form.name)
    plain = replace(form, name=name, mode=request.mode, real=request.real, version=_version())
    made = replace(plain, functions=tuple(in_mode(plain, f) for f in plain.functions))
    return replace(made, digest=hashlib.sha256(repr(made).encode()).hexdigest()[:DIGEST])


@cache
def _version() -> str:
    try:
        return version("ridgeback")
    except PackageNotFoundError:
        return "(not installed)"
