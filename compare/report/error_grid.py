"""What the sliders of a page move over: omega0 of every order at every amplitude, with an error that is proved.

The value is that of the generated code, the double itself; its error against the exact omega0 is enclosed in ball
arithmetic where there is an enclosure.  Elsewhere the study's reference with its own uncertainty takes its place, and
nothing is called certified.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.generated_code import python_module
from ridgeback.compare.study.derived import Derived
from ridgeback.compare.study.results import Study
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.symbolic.certificates.accuracy import certified_error
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.enclosure.enclosure import enclose

BITS = 128
FINE_BITS = 512
"""Of the errors at small amplitudes, which shrink like A^(n + 2)."""
PAIRS = ((0.02, 0.04), (0.16, 0.32))
"""Pairs of amplitudes between which the power of the error is read, as shares of the radius or of the largest one."""


@dataclass(frozen=True)
class ErrorGrid:
    """omega0 by generated code over order and amplitude, and its relative error against the exact one."""

    orders: tuple[int, ...]
    amplitudes: Array
    """Shape (M,), the doubles that the code is given."""
    exact: Array
    """Exact omega0, shape (M,), rad per time unit."""
    values: Array
    """Shape (N, M), rad per time unit: what the code returns."""
    errors: Array
    """Shape (N, M), signed."""
    bounds: Array
    """Shape (N, M): the size of the error is certainly at most this; or the study's estimate of that."""
    certified: bool
    code: Mapping[int, str]
    """The JavaScript of each order."""
    scale: float
    """The argument k of the code."""
    observed: tuple[tuple[float, float, Array], ...] = ()
    """Smaller and larger amplitude of a pair, and the power of A with which each order's error grows between."""

    def __post_init__(self) -> None:
        freeze(self)


def error_grid(derived: Derived, study: Study) -> ErrorGrid:
    """Evaluate every order of a study at its amplitudes, and enclose the errors.

    Parameters
    ----------
    derived
        The series, at least of the study's highest order.
    study
        Orders and amplitudes, and the reference where nothing can be enclosed.

    Examples
    --------
    >>> from ridgeback.compare.study.derived import derive
    >>> from ridgeback.compare.study.study import study_of
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = derive(find("pendulum"), 8)
    >>> grid = error_grid(found, study_of(found.undamped, (2, 8), [0.5, 1.0]))
    >>> grid.certified, bool((abs(grid.errors) <= grid.bounds).all()), [round(p, 1) for p in grid.observed[0][2]]
    (True, True, [4.0, 10.0])
    """
    parts = [derived.expansion.truncated(order) for order in study.orders]
    k = float(derived.expansion.scale)
    values = np.array([np.asarray(python_module(part).omega0(study.amplitudes), dtype=float) for part in parts])
    code = {order: function(generate(part, "javascript")) for order, part in zip(study.orders, parts, strict=True)}
    balls = _balls(derived, study.amplitudes)
    if balls is None:
        errors = values / study.reference - 1
        exact, bounds = study.reference, np.abs(errors) + study.reference_error
    else:
        exact = np.array([float(ball.mid()) for ball in balls])
        errors, bounds = _enclosed(values, balls)
    return ErrorGrid(
        orders=study.orders,
        amplitudes=study.amplitudes,
        exact=exact,
        values=values,
        errors=errors,
        bounds=bounds,
        certified=balls is not None,
        code=code,
        scale=k,
        observed=_observed(derived, study) if balls is not None else (),
    )


def function(text: str) -> str:
    r"""The function of one number in generated JavaScript, without what belongs to a module.

    >>> function("// x\nexport function omega0_unchecked(A, k = 1.0) {\n  return k;\n}\n\n// rest")
    'function omega0(A, k = 1.0) {\n  return k;\n}'
    """
    found = re.search(r"export function omega0_unchecked\(.*?\n}\n", text, flags=re.DOTALL)
    if found is None:
        raise ValueError("the generated JavaScript holds no function omega0_unchecked")
    return found[0].strip().replace("export function omega0_unchecked", "function omega0", 1)


def _balls(derived: Derived, amplitudes: Array) -> list[arb] | None:
    """Exact omega0 at each amplitude; None where there is no enclosure at one of them."""
    if derived.expansion.variable != "A":
        return None
    try:
        return [enclose(derived.undamped.oscillator, Fraction(a), bits=BITS).omega for a in amplitudes.tolist()]
    except InputError:
        return None


def _enclosed(values: Array, balls: Sequence[arb]) -> tuple[Array, Array]:
    errors, bounds = np.full(values.shape, np.nan), np.full(values.shape, np.nan)
    with ctx.workprec(BITS + 40):
        for i, row in enumerate(values.tolist()):
            for j, value in enumerate(row):
                ball = arb(value) / balls[j] - 1
                errors[i, j] = float(ball.mid())
                bounds[i, j] = float(abs(ball).upper())
    return errors, np.nextafter(bounds, np.inf)


def _observed(derived: Derived, study: Study) -> tuple[tuple[float, float, Array], ...]:
    """The power of A with which each order's error grows between two amplitudes, from enclosed errors."""
    top = derived.limits.radius or float(study.amplitudes[-1])
    oscillator = derived.undamped.oscillator
    found = []
    for low, high in PAIRS:
        a, b = (Fraction(f"{share * top:.3g}") for share in (low, high))
        powers = []
        for order in study.orders:
            part = derived.expansion.truncated(order)
            try:
                small, large = (certified_error(oscillator, part, x, bits=FINE_BITS) for x in (a, b))
            except InputError:
                return ()
            powers.append(_power(small, large, float(b / a)))
        found.append((float(a), float(b), np.array(powers)))
    return tuple(found)


def _power(small: arb, large: arb, ratio: float) -> float:
    if small.contains(0) or large.contains(0):
        return float("nan")
    with ctx.workprec(FINE_BITS):
        return float((abs(large / small).log() / arb(ratio).log()).mid())
