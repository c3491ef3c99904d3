"""``ridgeback.derive`` and ``ridgeback.generate``: an exact series by any method, and its source text."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import cast

from ridgeback.common.errors import InputError
from ridgeback.common.names import chosen
from ridgeback.common.progress import Wanted
from ridgeback.interface.derivation import derivation
from ridgeback.interface.source import known_form
from ridgeback.interface.unused import refuse_unused
from ridgeback.symbolic.codegen import Formula, written
from ridgeback.symbolic.codegen.formulas.closed_forms import sine_series
from ridgeback.symbolic.codegen.formulas.symbolic_mean import closed_form
from ridgeback.symbolic.codegen.program import MODES as ARITHMETIC
from ridgeback.symbolic.codegen.program import Mode
from ridgeback.symbolic.expansion.cost import Budget
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.flow.loss_flow import LossFlow
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.resummation.resummation import Resummation
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.parameters import Value


def derive(
    oscillator: OscillatorLike,
    order: int = 8,
    *,
    method: str | None = None,
    amplitude: str | None = None,
    weight: int | None = None,
    weights: Mapping[str, int] | None = None,
    parameters: Mapping[str, Value] | None = None,
    about: str | None = None,
    budget: Budget | None = None,
    progress: Wanted = None,
) -> Expansion | PowerExpansion | LossFlow | SlowFlow:
    """Derive the fundamental frequency as an exact series.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        The oscillator, in any of the forms that :func:`ridgeback.oscillator` takes.
    order : int
        Highest power of the amplitude, or of eps, that is kept; for multiple scales the highest weighted degree.
    method : {"lindstedt", "multiple-scales", "energy-integral"}, optional
        The derivation; by default multiple scales for a damped oscillator, the energy integral for a force with a kink
        at rest or without a linear part, else Lindstedt's.
    amplitude : {"peak", "trough", "fundamental", "action", "energy"}, optional
        Which amplitude the series is in; ``"peak"`` by default, and ``"fundamental"`` for multiple scales.
    weight : int, optional
        Multiple scales: mu counts as this power of the amplitude (2 by default).
    weights : mapping of str to int, optional
        Multiple scales: the weight of each small parameter; 0 makes one a coefficient.
    parameters : mapping, optional
        Values of parameters, exact as they are written.
    about : str, optional
        Equilibrium to expand about.
    budget : Budget, optional
        Time and memory that it may take; a derivation beyond them is refused with the order that fits.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the step.

    Returns
    -------
    Expansion, PowerExpansion, SlowFlow or LossFlow
        The series; one in rational powers of A for a force that begins with another power than the first; a slow flow
        (phi' and a'/a) by multiple scales, averaged where losses are not analytic at rest.

    Raises
    ------
    InputError
        For options that the method does not have, and for what the derivation refuses.

    Examples
    --------
    >>> derive("pendulum", 4).frequency
    (1, 0, -1/16, 0, 1/3072)
    >>> derive("damped_pendulum", 2).growth_rate_expression()
    -mu
    """
    return derivation(
        as_oscillator(oscillator, parameters=parameters, about=about),
        order,
        method=method,
        amplitude=amplitude,
        weight=weight,
        weights=weights,
        budget=budget,
        progress=progress,
    )


def generate(
    formula: OscillatorLike | Expansion | PowerExpansion | SlowFlow | LossFlow | Resummation,
    language: str = "python",
    *,
    oscillator: OscillatorLike | None = None,
    order: int = 8,
    method: str | None = None,
    amplitude: str | None = None,
    parameters: Mapping[str, Value] | None = None,
    resummed: str | None = None,
    degrees: tuple[int, int] | None = None,
    growth: Fraction = Fraction(0),
    terms: int = 1,
    up_to: Fraction | None = None,
    name: str = "",
    mode: str = "strict",
    real: str = "float64",
    motion: bool = False,
    progress: Wanted = None,
) -> str:
    """Write an expansion as source text in one of eleven languages, its rounding error proved.

    Parameters
    ----------
    formula : Oscillator, str, path, sympy.Eq, sympy.Expr, Expansion, SlowFlow or Resummation
        What has been derived, or the oscillator to derive it of.
    language : str
        ``"python"``, ``"c"``, ``"rust"`` ...; an unknown name lists them.
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr, optional
        The oscillator of a formula that has been derived, when that is not in the catalogue.
    order, method, amplitude, parameters : optional
        The derivation, as for :func:`derive`.
    resummed : {"pade", "map", "nome", "agm", "sine"}, optional
        Another formula in place of the series.
    degrees, growth : optional
        Of the resummation, as for :func:`ridgeback.resum`.
    terms : int
        Terms of ``"sine"``.
    up_to : Fraction, optional
        End of the domain: no pole, and a bounded rounding error, up to there.
    name : str
        Identifier of what is written; by default the system's name.
    mode : {"strict", "fma", "accurate"}
        The same bits in every language; fused; with the last steps compensated.
    real : {"float64", "float32"}
        Numbers of the code.
    motion : bool
        Whether u(t) and its harmonics are written, too.
    progress : bool or callable, optional
        As for :func:`derive`.

    Returns
    -------
    str
        The source text.

    Raises
    ------
    InputError
        For an unknown language and for what the derivation or the resummation refuses.

    Examples
    --------
    >>> source = generate("pendulum", "c", order=4)
    >>> "double pendulum_omega0(double" in source
    True
    """
    series: Expansion | PowerExpansion | SlowFlow | LossFlow
    result: Formula
    check_formula(resummed, degrees, growth, terms)
    if isinstance(formula, Expansion | PowerExpansion | SlowFlow | LossFlow | Resummation):
        refuse_unused("a formula that has been derived", method=method, amplitude=amplitude, parameters=parameters)
        system, result = (_system_of(formula) if oscillator is None else as_oscillator(oscillator)), formula
        series = lindstedt(system, formula.order) if isinstance(formula, Resummation) else formula
    else:
        refuse_unused("an oscillator to derive the formula of", oscillator=oscillator)
        system = as_oscillator(formula, parameters=parameters)
        result = series = derive(system, order, method=method, amplitude=amplitude, progress=progress)
    if resummed is not None:
        if isinstance(series, PowerExpansion | LossFlow):
            raise InputError(series.refusal())
        result = in_its_place(system, series, resummed, degrees=degrees, growth=growth, terms=terms, up_to=up_to)
    how = cast(Mode, chosen(mode, ARITHMETIC, "mode"))
    form = known_form(system, series, result, up_to=up_to, name=name, mode=how, real=real, motion=motion)
    return written(form, language)


def _system_of(formula: Expansion | PowerExpansion | SlowFlow | LossFlow | Resummation) -> Oscillator:
    """The oscillator that a formula names, which the catalogue must know."""
    try:
        return find(formula.system)
    except InputError as unknown:
        raise InputError(
            f"a formula of {formula.system!r}, which the catalogue does not have: name its equation, oscillator=..."
        ) from unknown


def check_formula(resummed: str | None, degrees: tuple[int, int] | None, growth: Fraction, terms: int) -> None:
    """Refuse what the formula asked for has no use for."""
    what = "a series" if resummed is None else f"resummed {resummed!r}"
    if resummed in (None, "agm", "sine"):
        refuse_unused(what, degrees=degrees)
    if resummed != "map":
        refuse_unused(what, growth=growth or None)
    if resummed != "sine":
        refuse_unused(what, terms=None if terms == 1 else terms)


def in_its_place(
    oscillator: Oscillator,
    series: Expansion | SlowFlow,
    kind: str,
    *,
    degrees: tuple[int, int] | None,
    growth: Fraction,
    terms: int,
    up_to: Fraction | None,
) -> Formula:
    """Another formula in place of the series: a closed form, or one from the same coefficients."""
    if kind == "agm":
        return closed_form(oscillator)
    if kind == "sine":
        return sine_series(oscillator, terms)
    if not isinstance(series, Expansion):
        raise InputError("resummed belongs to a series in one variable; leave it out")
    return resum(oscillator, series, kind, degrees=degrees, growth=growth, up_to=up_to)
