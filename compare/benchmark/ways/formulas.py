"""The contenders that are formulas of the amplitude: truncated series, resummations and minimax fits.

Each is run as the code that Ridgeback generates for it, in Python over a NumPy array and in C, at every amplitude that
the motion has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.polynomial import chebyshev

from ridgeback.common.errors import InputError
from ridgeback.compare.benchmark.contenders import Kind, Row, Source
from ridgeback.compare.benchmark.ways.contender import Contender, refused
from ridgeback.compare.benchmark.ways.timing import NOT_TIMED, Cost, per_value
from ridgeback.compare.binding.compiled_code import NotCompiled, OfAmplitude, Vectorised, compiled_together
from ridgeback.compare.binding.generated_code import as_module, omega0_of
from ridgeback.compare.motion.motion import Motion, exact_omega
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.symbolic.codegen.fit.fit import Fit, minimax
from ridgeback.symbolic.codegen.fit.surrogate import Surrogate, surrogate
from ridgeback.symbolic.codegen.program import Form
from ridgeback.symbolic.enclosure.well import well_of
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.resummation.by_name import resum
from ridgeback.symbolic.systems.oscillator import Oscillator

RESUMMATIONS = ("pade", "map", "nome")
RESUMMED = 24
"""Order of the series that is resummed, at most."""
DEGREES = (2, 4, 10)
"""Degrees in A^2 of the minimax fits: as many coefficients as 3, 5 and 11 terms of the paper's series have."""
RESOLVED = 32
SMOOTH = 1e-9
"""A fit is tried where so many Chebyshev coefficients of omega0(A) come down to this share of the first: towards a
separatrix they do not, and proving a fit takes minutes."""

At = Mapping[Source | None, Array]
"""What a formula is evaluated at: A(t) by source, or the eps of a limit cycle, the same at all times."""


@dataclass(frozen=True)
class Named:
    """What the rows of one formula have in common."""

    method: str
    label: str
    kind: Kind
    order: int
    coefficients: int | None = None


@dataclass(frozen=True)
class Generated:
    """The code of a formula, and its Python loaded."""

    form: Form
    named: Named
    python: Vectorised


Tried: TypeAlias = "Generated | Contender"
"""What there is of a formula: it, or why it is refused."""


def generated(formula: OfAmplitude, named: Named) -> Generated:
    """A formula as code."""
    form = omega0_of(formula)
    return Generated(form, named, as_module(form).omega0)


def evaluated(tried: Iterable[Tried], at: At, *, timed: bool = True) -> Iterator[Contender]:
    """Formulas as generated code: one contender for each, its language and amplitude; what was refused as it is."""
    found = list(tried)
    with compiled_together([one.form for one in found if isinstance(one, Generated)]) as compiled:
        in_c = iter(compiled)
        for one in found:
            if isinstance(one, Generated):
                yield from _by_language(one, next(in_c), at, timed=timed)
            else:
                yield one


def _by_language(one: Generated, native: Vectorised | NotCompiled, at: At, *, timed: bool) -> Iterator[Contender]:
    ways = {"python": one.python} | ({} if isinstance(native, NotCompiled) else {"c": native})
    for language, function in ways.items():
        cost = per_value(function, next(iter(at.values()))) if timed else NOT_TIMED
        for source, x in at.items():
            yield Contender(_row(one.named, source, language, cost), np.asarray(function(x), dtype=float))


def _row(named: Named, source: Source | None, language: str, cost: Cost) -> Row:
    parts = (named.method, *((source,) if source else ()), *(() if language == "python" else (language,)))
    return Row(
        "-".join(parts),
        named.label + (f", A(t) from the {source}" if source else ""),
        named.kind,
        order=named.order,
        coefficients=named.coefficients,
        amplitude_from=source,
        language=language,
        time_ns_per_value=1e9 * cost.seconds,
        time_scatter=cost.scatter,
    )


def arguments(motion: Motion, expansion: Expansion, sources: Mapping[Source, Array]) -> At:
    """What the expansion is evaluated at."""
    if expansion.variable != "eps":
        return {source: x for source, x in sources.items()}  # noqa: C416 - the keys widen to those of a limit cycle
    name = motion.setting.oscillator.small or "eps"
    eps = motion.setting.case().parameters[name]
    return {None: np.full(motion.time.size, float(eps))}


def series(expansion: Expansion, orders: Iterable[int]) -> Iterator[Tried]:
    """The truncated series by order."""
    for order in orders:
        part = expansion.truncated(order)
        count = sum(1 for c in part.coefficients if c != 0)
        named = Named(f"{expansion.method}-{order}", f"expansion, order {order}", "expansion", order, count)
        yield generated(part, named)


def resummations(rest: Oscillator, expansion: Expansion, at: At) -> Iterator[Tried]:
    """Other formulas from the same coefficients, where they exist; of an oscillator without its damping."""
    part = expansion.truncated(min(expansion.order, RESUMMED))
    for name in RESUMMATIONS:
        try:
            formula = resum(rest, part, name, up_to=_largest(at))
            yield generated(formula, Named(f"{name}-{part.order}", formula.method, "resummation", part.order))
        except (InputError, ValueError, ZeroDivisionError) as error:
            label = f"{name}, order {part.order}"
            yield refused(f"{name}-{part.order}", label, "resummation", str(error), order=part.order)


def fits(motion: Motion, rest: Oscillator, at: At) -> Iterator[Tried]:
    """Minimax polynomials in A^2, fitted to the exact omega0 over the amplitudes of this motion."""
    largest = _largest(at)
    exact = cache(lambda: surrogate(well_of(rest), largest))
    for degree in DEGREES:
        label = f"minimax fit of degree {degree} in A^2"
        try:
            fit = fitted(rest, motion.dynamics, largest, degree, exact)
            yield generated(fit, Named(f"minimax-{2 * degree}", label, "minimax", 2 * degree, degree + 1))
        except InputError as error:
            yield refused(f"minimax-{2 * degree}", label, "minimax", str(error), order=2 * degree)


def fitted(
    rest: Oscillator,
    dynamics: Dynamics,
    largest: Fraction,
    degree: int,
    exact: Callable[[], Surrogate | None] = lambda: None,
) -> Fit:
    """The minimax fit of a degree; InputError where proving one would take minutes, or there is none."""
    if not is_smooth(dynamics, float(largest)):
        raise InputError("the exact omega0 is not smooth enough in A^2 over these amplitudes for a proved fit")
    return minimax(rest, largest, degree=degree, exact=exact())


def is_smooth(dynamics: Dynamics, largest: float) -> bool:
    """Whether ``RESOLVED`` Chebyshev coefficients in A^2 resolve the exact omega0 up to an amplitude."""
    count = 2 * RESOLVED
    nodes = chebyshev.chebpts1(count)
    omega = exact_omega(dynamics, largest * np.sqrt((1.0 + nodes) / 2.0))
    size = np.abs(chebyshev.chebfit(nodes, omega, count - 1))
    return bool(np.isfinite(size).all() and size[RESOLVED - 4 : RESOLVED + 4].max() <= SMOOTH * size[0])


def _largest(at: At) -> Fraction:
    return Fraction(max(float(np.nanmax(x)) for x in at.values()))
